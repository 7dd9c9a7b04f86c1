#include "report/sweep_report.h"

#include "base/units.h"
#include "report/figure.h"
#include "report/figure_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LABEL_SIZE = 48, CORNERS = 3 };

/// The last of the values as typed: its unit is the unit of the table.
static const char* last_item(const char* values) {
    const char* comma = strrchr(values, ',');
    const char* item = comma ? comma + 1 : values;
    return item + strspn(item, " ");
}

static void value_label(const bt_sweep_plan* plan, double value, char* label) {
    char number[32];
    const char* unit = "";
    bt_unit_print_as(value, last_item(plan->values), number, sizeof number, &unit);
    snprintf(label, LABEL_SIZE, "%s%s%s", number, *unit ? " " : "", unit);
}

// --- table ------------------------------------------------------------------------------------

static const bt_column columns[] = {
    {.name = "key", .head = NULL, .unit = ""},
    {.name = "value", .head = "value", .unit = ""},
    {.name = "outcome", .head = NULL, .unit = ""},
    {.name = "mode", .head = NULL, .unit = ""},
    {.name = "height_m", .head = "first bounce", .unit = "mm", .scale = 1e3, .decimals = 1},
    {.name = "distance_m", .head = "length", .unit = "m", .decimals = 2},
    {.name = "impact_force_N", .head = "impact load", .unit = "kN", .scale = 1e-3},
    {.name = "margin_m", .head = NULL, .unit = ""},
};

bt_report_table* bt_sweep_table_create(void) {
    return bt_report_table_create(NULL, columns, (int)(sizeof columns / sizeof columns[0]));
}

static void add_row(bt_report_table* table, const bt_sweep_plan* plan, const bt_sweep_row* row) {
    const bt_landing_result* result = &row->result;
    const bt_bounce bounce = bt_first_bounce(result);
    char label[LABEL_SIZE];
    value_label(plan, row->value, label);
    bt_report_table_row(table);
    bt_report_table_text(table, plan->key);
    bt_report_table_said(table, row->value, label);
    bt_report_table_text(table, bt_outcome_name(result->outcome));
    bt_report_table_text(table, bt_mode_name(result->mode));
    if (isfinite(bounce.height_m))
        bt_report_table_number(table, bounce.height_m);
    else
        bt_report_table_said(table, NAN, "none before the cable");
    bt_report_table_number(table, bounce.distance_m);
    bt_report_table_number(table, bounce.impact_force_N);
    bt_report_table_number(table, result->margin_m);
    if (result->outcome == BT_FAILED)
        bt_report_table_remark(table, "%s failed: %s, %s at %.4g s", label, result->failed_element,
                               result->failed_quantity, result->failed_time_s);
}

void bt_sweep_table_add(bt_report_table* table, const bt_sweep_plan* plan, const bt_sweep* sweep) {
    for (int i = 0; i < sweep->count; ++i)
        add_row(table, plan, &sweep->rows[i]);
}

// --- figure -----------------------------------------------------------------------------------

/// Where the figure ends: a little after the longest first bounce.
static double figure_end_m(const bt_sweep* sweep) {
    double longest = 0;
    for (int i = 0; i < sweep->count; ++i)
        longest = fmax(longest, bt_first_bounce(&sweep->rows[i].result).distance_m);
    return ceil(1.3 * longest + 0.5);
}

/// The heights of all paths, one after the other, mm.
static double* heights_mm(const bt_sweep* sweep) {
    size_t total = 1, at = 0;
    for (int i = 0; i < sweep->count; ++i)
        total += (size_t)sweep->rows[i].path.count;
    double* height = malloc(total * sizeof *height);
    for (int i = 0; i < sweep->count && height; ++i)
        for (int k = 0; k < sweep->rows[i].path.count; ++k)
            height[at++] = 1e3 * sweep->rows[i].path.height_m[k];
    return height;
}

static void figure_title(const bt_study* study, const bt_sweep_plan* plan, char* title,
                         size_t size) {
    snprintf(title, size, "%s%s%s%s", study->title, plan->title ? ": " : "",
             plan->title ? plan->title : "",
             plan->title && bt_study_is_reference(study) ? plan->paper : "");
}

bt_status bt_sweep_draw(const bt_study* study, const bt_sweep_plan* plan, const bt_sweep* sweep,
                        const char* folder, FILE* text, bt_diag* diag) {
    char title[400], labels[BT_SWEEP_VALUES_MAX][LABEL_SIZE];
    bt_series series[BT_SWEEP_VALUES_MAX + 1];
    const double x[CORNERS] = {0, plan->said_distance_m, plan->said_distance_m};
    const double y[CORNERS] = {1e3 * plan->said_height_m, 1e3 * plan->said_height_m, 0};
    double *heights = heights_mm(sweep), *height = heights;
    if (!heights)
        return BT_ERR_MEMORY;
    int count = 0;
    for (; count < sweep->count; ++count) {
        const bt_hook_path* path = &sweep->rows[count].path;
        value_label(plan, sweep->rows[count].value, labels[count]);
        series[count] = (bt_series){
            .label = labels[count], .count = path->count, .x = path->travelled_m, .y = height};
        height += path->count;
    }
    if (plan->said && bt_study_is_reference(study) && count < BT_SERIES_MAX) {
        series[count] = (bt_series){.label = plan->said_label,
                                    .style = BT_SERIES_REFERENCE,
                                    .count = CORNERS,
                                    .x = x,
                                    .y = y};
        ++count;
    }
    figure_title(study, plan, title, sizeof title);
    const bt_figure figure = {.name = plan->name,
                              .title = title,
                              .x_label = "distance travelled from first contact, m",
                              .y_label = "height of the hook above the deck, mm",
                              .key_title = plan->title ? NULL : plan->key,
                              .ordered = true,
                              .from_zero = true,
                              .x_max = figure_end_m(sweep),
                              .series_count = count,
                              .series = series};
    if (text)
        bt_figure_print(&figure, text);
    const bt_status status = bt_figure_write(&figure, folder, diag);
    free(heights);
    return status;
}
