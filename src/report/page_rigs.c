#include "report/page_parts.h"

#include "base/units.h"
#include "report/rig_report.h"

#include <math.h>
#include <string.h>

enum { TRACES_MAX = 2, POINTS_MOST = 240 };

/// A figure of a rig: channels over time or over the stroke.
typedef struct rig_plot {
    bt_rig_kind kind;
    const char *name, *caption, *paper, *label;
    double scale;
    bool over_stroke;
    struct {
        const char *channel, *label;
    } trace[TRACES_MAX];
} rig_plot;

static const rig_plot plots[] = {
    {BT_RIG_NOSE_DROP,
     "stroke",
     "Nose gear: stroke and sinkage",
     " (the paper\'s Fig. 9).",
     "mm",
     1e3,
     false,
     {{"stroke_m", "stroke"}, {"sinkage_m", "sinkage"}}},
    {BT_RIG_NOSE_DROP,
     "tyre",
     "Nose gear: load of the tyre",
     " (the paper\'s Fig. 10).",
     "kN",
     1e-3,
     false,
     {{"tyre_force_N", "tyre"}}},
    {BT_RIG_MAIN_DROP,
     "stroke",
     "Main gear: stroke and sinkage",
     " (the paper\'s Fig. 11).",
     "mm",
     1e3,
     false,
     {{"stroke_m", "stroke"}, {"sinkage_m", "sinkage"}}},
    {BT_RIG_MAIN_DROP,
     "tyre",
     "Main gear: load of the tyre",
     " (the paper\'s Fig. 12).",
     "kN",
     1e-3,
     false,
     {{"tyre_force_N", "tyre"}}},
    {BT_RIG_HOOK_REBOUND,
     "height",
     "Hook: height of the head above the disc",
     ".",
     "mm",
     1e3,
     false,
     {{"hook_height_m", "height"}}},
    {BT_RIG_NOSE_STATIC,
     "load",
     "Nose gear: load over stroke, pressed slowly",
     ".",
     "kN",
     1e-3,
     true,
     {{"strut_force_N", "shortening"}, {"opening_force_N", "extending"}}},
    {BT_RIG_MAIN_STATIC,
     "load",
     "Main gear: load over stroke, pressed slowly",
     ".",
     "kN",
     1e-3,
     true,
     {{"strut_force_N", "shortening"}, {"opening_force_N", "extending"}}},
};
enum { PLOT_COUNT = sizeof plots / sizeof plots[0] };

static int column_of(const bt_rig_record* record, const char* name) {
    for (int i = 0; i < record->column_count; ++i)
        if (strcmp(record->names[i], name) == 0)
            return i;
    return 0;
}

static void write_values(bt_json* json, const char* key, const bt_rig_record* record, int column,
                         double scale) {
    const int stride = 1 + record->count / POINTS_MOST;
    bt_json_begin_array(json, key);
    for (int i = 0; i < record->count; i += stride)
        bt_json_rounded(json, NULL, scale * record->columns[column][i], 5);
    bt_json_end_array(json);
}

static void write_measured(bt_json* json, const rig_plot* plot, const bt_rig_record* record,
                           const bt_rig_curves* curves, int across, double x_scale) {
    bt_json_begin_array(json, "measured");
    for (int i = 0; i < curves->count; ++i) {
        const bt_measured* m = curves->measured[i];
        const int stride = 1 + m->count / POINTS_MOST;
        bool shown = false;
        for (int t = 0; t < TRACES_MAX && plot->trace[t].channel; ++t)
            shown = shown || m->y_column == column_of(record, plot->trace[t].channel);
        for (int k = 0; shown && m->x_column == across && k < m->count; k += stride) {
            bt_json_begin_object(json, NULL);
            bt_json_rounded(json, "x", x_scale * m->x[k], 6);
            bt_json_rounded(json, "y", plot->scale * m->y[k], 6);
            bt_json_end_object(json);
        }
    }
    bt_json_end_array(json);
}

static void write_plot(bt_json* json, const rig_plot* plot, bool reference,
                       const bt_rig_record* record, const bt_rig_curves* curves) {
    char caption[160];
    snprintf(caption, sizeof caption, "%s%s", plot->caption, reference ? plot->paper : ".");
    const int across = plot->over_stroke ? column_of(record, "stroke_m") : 0;
    const double x_scale = plot->over_stroke ? 1e3 : 1;
    bt_json_begin_object(json, NULL);
    bt_json_string(json, "name", plot->name);
    bt_json_string(json, "caption", caption);
    bt_json_string(json, "label", plot->label);
    bt_json_begin_object(json, "x");
    bt_json_string(json, "label", plot->over_stroke ? "stroke, mm" : "time from first contact, s");
    write_values(json, "values", record, across, x_scale);
    bt_json_end_object(json);
    bt_json_begin_array(json, "y");
    for (int t = 0; t < TRACES_MAX && plot->trace[t].channel; ++t) {
        bt_json_begin_object(json, NULL);
        bt_json_string(json, "label", plot->trace[t].label);
        write_values(json, "values", record, column_of(record, plot->trace[t].channel),
                     plot->scale);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
    write_measured(json, plot, record, curves, across, x_scale);
    bt_json_end_object(json);
}

static void write_metrics(bt_json* json, const bt_rig_result* result) {
    bt_json_begin_array(json, "metrics");
    for (int i = 0; i < result->metric_count; ++i) {
        const bt_metric* m = &result->metrics[i];
        bt_json_begin_object(json, NULL);
        bt_json_string(json, "name", m->name);
        bt_json_rounded(json, "value", m->value, 5);
        bt_json_string(json, "unit", bt_unit_text(m->unit));
        bt_json_rounded(json, "reference", m->reference, 5);
        bt_json_rounded(json, "error_percent", m->error_percent, 4);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}

static void write_rig(bt_json* json, bt_rig_kind kind, bool reference, const bt_rig_record* record,
                      const bt_rig_result* result, const bt_rig_curves* curves) {
    static const char* const titles[] = {"Drop of the nose gear", "Drop of the main gear",
                                         "Rebound of the hook", "Static test of the nose gear",
                                         "Static test of the main gear"};
    bt_json_begin_object(json, NULL);
    bt_json_string(json, "name", bt_rig_keys[kind]);
    bt_json_string(json, "title", titles[kind]);
    write_metrics(json, result);
    bt_json_begin_array(json, "figures");
    for (int i = 0; i < PLOT_COUNT; ++i)
        if (plots[i].kind == kind)
            write_plot(json, &plots[i], reference, record, curves);
    bt_json_end_array(json);
    bt_json_end_object(json);
}

/// A rig that diverges is left out, with what it said in diag.
static bt_status run_rig(bt_page* page, bt_rig_kind kind) {
    const bt_study* study = page->subject->study;
    bt_rig_test test;
    const bt_status status = bt_stage_rig(study, kind, &test, page->diag);
    if (status != BT_OK)
        return status == BT_ERR_FAILED_RUNS ? BT_OK : status;
    write_rig(page->json, kind, bt_study_is_reference(study), &test.record, &test.result,
              &test.curves);
    bt_rig_test_destroy(&test);
    return BT_OK;
}

bt_status bt_page_rigs_write(bt_page* page) {
    bt_status status = BT_OK;
    bt_json_begin_array(page->json, "rigs");
    for (int kind = 0; kind < BT_RIG_COUNT && status == BT_OK; ++kind)
        if (page->subject->study->rig_inputs[kind].given)
            status = run_rig(page, (bt_rig_kind)kind);
    bt_json_end_array(page->json);
    return status;
}
