#include "report/page_parts.h"

#include "pipeline/sweep.h"

#include <stdlib.h>

/// How the hook bounces over one key, as the paper's Figs. 14 to 16 show it.
static const struct {
    const char *key, *caption, *paper;
    int count;
    double values[5]; ///< SI
} plans[] = {
    {"landing.sink_speed",
     "The hook's first bounces at four sinking velocities",
     " (the paper's Fig. 14: 53 mm and at most 4 m at 6.3 m/s)",
     4,
     {3.6, 4, 5, 6.3}},
    {"landing.pitch",
     "The hook's first bounces at five pitch angles",
     " (the paper's Fig. 15: 81 mm and 4.57 m at 8 deg)",
     5,
     {0, 0.03490658503988659, 0.06981317007977318, 0.10471975511965977, 0.13962634015954636}},
    {"landing.horizontal_speed",
     "The hook's first bounces at four horizontal velocities",
     " (the paper's Fig. 16)",
     4,
     {40, 45, 50, 55}},
};
enum { PLAN_COUNT = sizeof plans / sizeof plans[0], POINTS_MOST = 160 };

static const double shown_m = 10; ///< length of the way along the deck

static void write_curve(bt_json* json, const bt_sweep_row* row, double factor, const char* unit) {
    char label[64];
    const bt_hook_path* path = &row->path;
    int count = 0;
    while (count < path->count && path->travelled_m[count] <= shown_m)
        ++count;
    const int stride = 1 + count / POINTS_MOST;
    snprintf(label, sizeof label, "%.3g %s", factor * row->value, unit);
    bt_json_begin_object(json, NULL);
    bt_json_string(json, "label", label);
    bt_json_begin_array(json, "travelled");
    for (int i = 0; i < count; i += stride)
        bt_json_rounded(json, NULL, path->travelled_m[i], 5);
    bt_json_end_array(json);
    bt_json_begin_array(json, "height");
    for (int i = 0; i < count; i += stride)
        bt_json_rounded(json, NULL, path->height_m[i], 5);
    bt_json_end_array(json);
    bt_json_end_object(json);
}

static void write_sweep(bt_json* json, const bt_sweep* sweep, int plan, bool reference) {
    double factor;
    char caption[256];
    snprintf(caption, sizeof caption, "%s%s.", plans[plan].caption,
             reference ? plans[plan].paper : "");
    const char* unit = bt_display_unit(sweep->field, &factor);
    bt_json_begin_object(json, NULL);
    bt_json_string(json, "key", plans[plan].key);
    bt_json_string(json, "caption", caption);
    bt_json_begin_array(json, "curves");
    for (int i = 0; i < sweep->count; ++i)
        if (sweep->rows[i].result.outcome != BT_FAILED)
            write_curve(json, &sweep->rows[i], factor, unit);
    bt_json_end_array(json);
    bt_json_end_object(json);
}

bt_status bt_page_bounces_write(bt_page* page) {
    bt_model_params* model = malloc(sizeof *model);
    if (!model)
        return BT_ERR_MEMORY;
    *model = page->subject->study->model;
    if (model->landing.distance_m < BT_CLEAR_DISTANCE_M)
        model->landing.distance_m = BT_CLEAR_DISTANCE_M;
    bt_status status = BT_OK;
    bt_json_begin_array(page->json, "bounces");
    for (int i = 0; i < PLAN_COUNT && status == BT_OK; ++i) {
        bt_sweep sweep;
        status = bt_sweep_run(model, plans[i].key, plans[i].values, plans[i].count,
                              (int)page->subject->study->campaign.threads, page->subject->stop,
                              &sweep, page->diag);
        if (status != BT_OK)
            break;
        write_sweep(page->json, &sweep, i, bt_study_is_reference(page->subject->study));
        bt_sweep_destroy(&sweep);
    }
    bt_json_end_array(page->json);
    free(model);
    return status;
}
