#include "report/sensitivity_report.h"

#include <math.h>

static const bt_column columns[] = {
    {.name = "distance_m", .head = NULL, .unit = ""},
    {.name = "engaged", .head = NULL, .unit = ""},
    {.name = "path", .head = "key", .unit = ""},
    {.name = "value", .head = "value", .unit = ""},
    {.name = "low", .head = "low", .unit = ""},
    {.name = "high", .head = "high", .unit = ""},
    {.name = "unit", .head = "unit", .unit = ""},
    {.name = "engaged_lower", .head = "engaged at low", .unit = "%", .scale = 100, .decimals = 2},
    {.name = "engaged_higher", .head = "at high", .unit = "%", .scale = 100, .decimals = 2},
    {.name = "margin_lower_m", .head = "margin moves at low, mm", .unit = ""},
    {.name = "margin_higher_m", .head = "at high, mm", .unit = ""},
    {.name = "flips", .head = "outcomes changed", .unit = ""},
};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0] };

bt_report_table* bt_sensitivity_table_create(void) {
    return bt_report_table_create(NULL, columns, COLUMN_COUNT);
}

/// A number of a key with four digits, or another for people with its sign.
static void add_said(bt_report_table* table, double value, const char* format, double shown) {
    char text[32] = "-";
    if (isfinite(value))
        snprintf(text, sizeof text, format, shown);
    bt_report_table_said(table, value, text);
}

static void add_effect(bt_report_table* table, const bt_sensitivity_result* result,
                       const bt_sensitivity_effect* e) {
    bt_report_table_row(table);
    bt_report_table_number(table, result->distance_m);
    bt_report_table_number(table, result->engaged);
    bt_report_table_text(table, e->key->path);
    add_said(table, e->key->value, "%.4g", e->key->value);
    add_said(table, e->key->end[0], "%.4g", e->key->end[0]);
    add_said(table, e->key->end[1], "%.4g", e->key->end[1]);
    bt_report_table_text(table, e->key->unit);
    for (int side = 0; side < 2; ++side)
        if (e->refused[side])
            bt_report_table_said(table, NAN, "refused");
        else
            bt_report_table_number(table, e->engaged[side]);
    for (int side = 0; side < 2; ++side)
        add_said(table, e->margin_m[side], "%+.2f", 1e3 * e->margin_m[side]);
    bt_report_table_count(table, e->flips);
}

void bt_sensitivity_table_add(bt_report_table* table, const bt_sensitivity_result* result) {
    for (int i = 0; i < result->count; ++i)
        add_effect(table, result, &result->effects[i]);
}
