#include "report/noise_report.h"

#include "statistics/intervals.h"

static const bt_column columns[] = {
    {.name = "name", .head = NULL, .unit = ""},
    {.name = "computation", .head = "computation", .unit = ""},
    {.name = "flips", .head = "outcomes changed", .unit = ""},
    {.name = "flips_share",
     .head = "share",
     .unit = "%",
     .scale = 100,
     .decimals = 2,
     .interval = true},
    {.name = "margin_median_m",
     .head = "margin moved: median",
     .unit = "mm",
     .scale = 1e3,
     .decimals = 2},
    {.name = "margin_p90_m", .head = "90 %", .unit = "mm", .scale = 1e3, .decimals = 2},
    {.name = "margin_p99_m", .head = "99 %", .unit = "mm", .scale = 1e3, .decimals = 2},
    {.name = "wrong_side", .head = "margin on the wrong side", .unit = ""},
    {.name = "wrong_side_share",
     .head = "share",
     .unit = "%",
     .scale = 100,
     .decimals = 2,
     .interval = true},
    {.name = "failed", .head = "failed", .unit = ""},
    {.name = "wall_s", .head = "per landing", .unit = "ms", .scale = 1e3, .decimals = 1},
};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0] };

bt_report_table* bt_noise_table_create(void) {
    return bt_report_table_create(NULL, columns, COLUMN_COUNT);
}

/// How many of all, and their share with its 95 % Clopper-Pearson limits.
static void add_share(bt_report_table* table, int64_t hits, int64_t count) {
    const bt_interval limits = bt_clopper_pearson(hits, count, 0.95);
    bt_report_table_count(table, hits);
    bt_report_table_interval(table, (double)hits / (double)count, &limits);
}

void bt_noise_table_add(bt_report_table* table, const bt_noise_variant* variant, int64_t count,
                        const bt_noise_difference* difference) {
    bt_report_table_row(table);
    bt_report_table_text(table, variant ? variant->name : "as_set");
    bt_report_table_text(table, variant ? variant->text : "as the study sets it");
    if (variant) {
        add_share(table, difference->flips, count);
        bt_report_table_number(table, difference->margin_median_m);
        bt_report_table_number(table, difference->margin_p90_m);
        bt_report_table_number(table, difference->margin_p99_m);
    } else
        for (int i = 0; i < 5; ++i)
            bt_report_table_empty(table);
    add_share(table, difference->wrong_side, count);
    bt_report_table_count(table, difference->failed);
    bt_report_table_number(table, difference->wall_s);
}
