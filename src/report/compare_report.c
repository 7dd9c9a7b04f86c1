#include "report/compare_report.h"

#define SHARE .unit = "%", .scale = 100, .decimals = 2, .interval = true

static const bt_column columns[] = {
    {.name = "pairs", .head = "landings", .unit = ""},
    {.name = "first", .head = "first", SHARE},
    {.name = "second", .head = "second", SHARE},
    {.name = "difference", .head = "second - first", SHARE},
    {.name = "p_value", .head = "p", .unit = "", .decimals = 4},
    {.name = "gained", .head = "gained", .unit = ""},
    {.name = "lost", .head = "lost", .unit = ""},
    {.name = "failed", .head = "failed", .unit = ""},
};

static const bt_column key_columns[] = {
    {.name = "key", .head = "key", .unit = ""},
    {.name = "first", .head = "first", .unit = ""},
    {.name = "second", .head = "second", .unit = ""},
};

bt_report_table* bt_compare_table(const bt_comparison* c) {
    bt_report_table* table =
        bt_report_table_create(NULL, columns, sizeof columns / sizeof columns[0]);
    const bt_paired* p = &c->pairs;
    bt_report_table_row(table);
    bt_report_table_count(table, p->both + p->first_only + p->second_only + p->neither);
    bt_report_table_interval(table, c->engaged[0], &c->engaged_ci95[0]);
    bt_report_table_interval(table, c->engaged[1], &c->engaged_ci95[1]);
    bt_report_table_interval(table, c->difference.value, &c->difference.ci95);
    bt_report_table_number(table, c->difference.p_value);
    bt_report_table_count(table, p->second_only);
    bt_report_table_count(table, p->first_only);
    bt_report_table_count(table, c->failed);
    bt_report_table_remark(table,
                           "gained, lost: landings that only the second, only the first study "
                           "engages; p: McNemar's exact test of gained against lost.");
    return table;
}

bt_report_table* bt_compare_keys_table(const bt_comparison* c) {
    bt_report_table* table =
        bt_report_table_create(NULL, key_columns, sizeof key_columns / sizeof key_columns[0]);
    for (int i = 0; i < c->key_count && i < BT_DIFFERENT_KEYS_MAX; ++i) {
        bt_report_table_row(table);
        bt_report_table_text(table, c->key[i].path);
        bt_report_table_text(table, c->key[i].first);
        bt_report_table_text(table, c->key[i].second);
    }
    if (c->key_count > BT_DIFFERENT_KEYS_MAX)
        bt_report_table_remark(table, "and %d more", c->key_count - BT_DIFFERENT_KEYS_MAX);
    return table;
}
