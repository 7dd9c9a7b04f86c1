#include "report/sweep_report.h"

#include "base/text.h"
#include "report/figure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bt_report_table* bt_rig_sweep_table(const bt_rig_sweep* sweep,
                                    bt_column columns[BT_RIG_SWEEP_COLUMNS]) {
    const bt_rig_result* first = &sweep->rows[0].test.result;
    int count = 1;
    columns[0] = (bt_column){.name = "value", .head = "value", .unit = ""};
    for (int m = 0; m < first->metric_count && count < BT_RIG_SWEEP_COLUMNS; ++m) {
        const bt_metric* metric = &first->metrics[m];
        const bool plain = strcmp(metric->unit, "1") == 0;
        columns[count++] = (bt_column){
            .name = metric->name, .head = metric->name, .unit = plain ? "" : metric->unit};
    }
    bt_report_table* table = bt_report_table_create(NULL, columns, count);
    for (int i = 0; i < sweep->count; ++i) {
        const bt_rig_result* result = &sweep->rows[i].test.result;
        bt_report_table_row(table);
        bt_report_table_text(table, sweep->rows[i].value);
        for (int m = 0; m + 1 < count; ++m) {
            char text[40] = "none";
            if (isfinite(result->metrics[m].value))
                bt_text_print_rounded(result->metrics[m].value, 5, text, sizeof text);
            bt_report_table_said(table, result->metrics[m].value, text);
        }
    }
    return table;
}

// --- figure -----------------------------------------------------------------------------------

/// What is drawn of each kind of rig: one line per value.
static const struct {
    const char *x, *y, *x_label, *y_label;
    double x_scale, y_scale;
} drawn[BT_RIG_COUNT] = {
    [BT_RIG_NOSE_DROP] = {"stroke_m", "strut_force_N", "stroke, mm", "load of the strut, kN", 1e3,
                          1e-3},
    [BT_RIG_MAIN_DROP] = {"stroke_m", "strut_force_N", "stroke, mm", "load of the strut, kN", 1e3,
                          1e-3},
    [BT_RIG_HOOK_REBOUND] = {"time_s", "hook_height_m", "time from first contact, ms",
                             "height of the head, mm", 1e3, 1e3},
    [BT_RIG_NOSE_STATIC] = {"stroke_m", "strut_force_N", "stroke, mm", "load, kN", 1e3, 1e-3},
    [BT_RIG_MAIN_STATIC] = {"stroke_m", "strut_force_N", "stroke, mm", "load, kN", 1e3, 1e-3},
};

/// A column of a record by its name, scaled, into `to`, which is returned.
static double* scaled(const bt_rig_record* record, const char* name, double scale, double* to) {
    int column = 0;
    for (int i = 0; i < record->column_count; ++i)
        if (strcmp(record->names[i], name) == 0)
            column = i;
    for (int i = 0; i < record->count; ++i)
        to[i] = scale * record->columns[column][i];
    return to;
}

static double* room_for(const bt_rig_sweep* sweep) {
    size_t total = 1;
    for (int i = 0; i < sweep->count; ++i)
        total += 2 * (size_t)sweep->rows[i].test.record.count;
    return malloc(total * sizeof(double));
}

bt_status bt_rig_sweep_draw(const bt_study* study, const bt_rig_sweep* sweep, const char* folder,
                            char name[160], bt_diag* diag) {
    bt_series series[BT_RIG_SWEEP_MAX];
    char title[400];
    double *room = room_for(sweep), *at = room;
    if (!room)
        return BT_ERR_MEMORY;
    const bt_sweep_plan plan = bt_sweep_plan_of(sweep->key, "");
    memcpy(name, plan.name, sizeof plan.name);
    snprintf(title, sizeof title, "%s: %s", study->title, sweep->key);
    for (int i = 0; i < sweep->count; ++i) {
        const bt_rig_record* record = &sweep->rows[i].test.record;
        series[i] =
            (bt_series){.label = sweep->rows[i].value,
                        .count = record->count,
                        .x = scaled(record, drawn[sweep->kind].x, drawn[sweep->kind].x_scale, at),
                        .y = scaled(record, drawn[sweep->kind].y, drawn[sweep->kind].y_scale,
                                    at + record->count)};
        at += 2 * (size_t)record->count;
    }
    const bt_figure figure = {.name = name,
                              .title = title,
                              .x_label = drawn[sweep->kind].x_label,
                              .y_label = drawn[sweep->kind].y_label,
                              .ordered = true,
                              .series_count = sweep->count,
                              .series = series};
    const bt_status status = bt_figure_write(&figure, folder, diag);
    free(room);
    return status;
}
