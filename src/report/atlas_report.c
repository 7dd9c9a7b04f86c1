#include "report/atlas_report.h"

#include "report/display.h"

#include <stdio.h>

static const bt_column columns[] = {
    {.name = "share", .head = "of misses", .unit = "%", .scale = 100, .decimals = 1},
    {.name = "probability", .unit = "", .interval = true},
    {.name = "of_landings", .head = "of landings, %", .unit = ""},
    {.name = "mode", .unit = "", .head = "how"},
    {.name = "region", .unit = "", .head = "where"},
    {.name = "after_first_bounce", .unit = "", .flag = true},
    {.name = "input", .unit = ""},
    {.name = "least", .unit = ""},
    {.name = "greatest", .unit = ""},
    {.name = "landings", .unit = "", .head = "landings"},
    {.name = "run", .unit = "", .head = "typical run"},
};

void bt_atlas_region(const bt_study* study, const bt_landings* landings, const bt_miss_group* group,
                     char* text, size_t size) {
    const bt_input* input = &study->inputs[landings->axes.input[group->axis]];
    char label[BT_PATH_MAX];
    double factor;
    const char* unit = bt_display_unit(input->field, &factor);
    bt_display_label(input->path, label, sizeof label);
    snprintf(text, size, "%s; %s %.3g to %.3g %s",
             group->bounced ? "after the first bounce" : "in or before the first bounce", label,
             factor * group->least, factor * group->greatest, unit);
}

static void add_group(bt_report_table* table, const bt_study* study, const bt_landings* l,
                      const bt_miss_group* g) {
    char region[BT_PATH_MAX + 96], share[64];
    bt_atlas_region(study, l, g, region, sizeof region);
    bt_report_table_row(table);
    bt_report_table_number(table, g->share);
    bt_report_table_interval(table, g->probability, &g->ci95);
    snprintf(share, sizeof share, "%.2f [%.2f, %.2f]", 100 * g->probability, 100 * g->ci95.least,
             100 * g->ci95.greatest);
    bt_report_table_text(table, share);
    bt_report_table_text(table, bt_mode_name(g->mode));
    bt_report_table_text(table, region);
    bt_report_table_flag(table, g->bounced);
    bt_report_table_text(table, study->inputs[l->axes.input[g->axis]].path);
    bt_report_table_number(table, g->least);
    bt_report_table_number(table, g->greatest);
    bt_report_table_count(table, g->count);
    bt_report_table_count(table, l->run[g->typical]);
}

bt_report_table* bt_atlas_table(const bt_study* study, const bt_landings* l,
                                const bt_atlas* atlas) {
    bt_report_table* table =
        bt_report_table_create(study->title, columns, sizeof columns / sizeof columns[0]);
    int missed = 0;
    for (int i = 0; i < atlas->count; ++i) {
        add_group(table, study, l, &atlas->group[i]);
        missed += atlas->group[i].count;
    }
    bt_report_table_remark(table,
                           "%d misses in %d landings; 1 - R from them alone: %.2f %% (95 %% "
                           "interval %.2f to %.2f %%).",
                           missed, l->count, 100 * atlas->missed, 100 * atlas->missed_ci95.least,
                           100 * atlas->missed_ci95.greatest);
    if (!l->weighted)
        bt_report_table_remark(table, "The design is no sample of the study's distributions: these "
                                      "are shares of the design's own landings.");
    return table;
}
