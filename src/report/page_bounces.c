#include "report/page_parts.h"

#include "pipeline/sweep.h"

#include <stdio.h>

/// Under the drawings of the paper's sweeps, Figs. 14 to 16, and what is added in the reference
/// study.
static const struct {
    const char *caption, *paper;
} captions[BT_PAPER_SWEEPS] = {
    {"The hook's first bounces at four sinking velocities",
     " (the paper's Fig. 14: 53 mm and at most 4 m at 6.3 m/s)"},
    {"The hook's first bounces at five pitch angles",
     " (the paper's Fig. 15: 81 mm and 4.57 m at 8 deg)"},
    {"The hook's first bounces at four horizontal velocities", " (the paper's Fig. 16)"},
};
enum { POINTS_MOST = 160 };

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
    snprintf(caption, sizeof caption, "%s%s.", captions[plan].caption,
             reference ? captions[plan].paper : "");
    const char* unit = bt_display_unit(sweep->field, &factor);
    bt_json_begin_object(json, NULL);
    bt_json_string(json, "key", bt_paper_sweeps[plan].key);
    bt_json_string(json, "caption", caption);
    bt_json_begin_array(json, "curves");
    for (int i = 0; i < sweep->count; ++i)
        if (sweep->rows[i].result.outcome != BT_FAILED)
            write_curve(json, &sweep->rows[i], factor, unit);
    bt_json_end_array(json);
    bt_json_end_object(json);
}

bt_status bt_page_bounces_write(bt_page* page) {
    const bt_study* study = page->subject->study;
    bt_status status = BT_OK;
    bt_json_begin_array(page->json, "bounces");
    for (int i = 0; i < BT_PAPER_SWEEPS && status == BT_OK; ++i) {
        bt_sweep sweep;
        status =
            bt_stage_sweep(study, &bt_paper_sweeps[i], page->subject->stop, &sweep, page->diag);
        if (status != BT_OK)
            break;
        write_sweep(page->json, &sweep, i, bt_study_is_reference(study));
        bt_sweep_destroy(&sweep);
    }
    bt_json_end_array(page->json);
    return status;
}
