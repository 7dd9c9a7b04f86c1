/// Tables as data: columns with name, unit and digits, rows of cells, remarks below. Written as a
/// text for people, as Markdown, as CSV and as JSON, each from the same table.
#ifndef BT_REPORT_TABLE_H
#define BT_REPORT_TABLE_H

#include "base/status.h"
#include "report/json.h"
#include "statistics/intervals.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/// One column. Programs (CSV, JSON) get the value as it is given, in SI, under `name`; people get
/// value * scale with `decimals` digits after the point under `head`.
typedef struct bt_column {
    const char* name; ///< "height_m"; in CSV and JSON
    const char* head; ///< "height"; NULL: a column that people do not see
    const char* unit; ///< "mm", "%"; "" for none. Belongs to value * scale
    double scale;     ///< 0 is 1
    int decimals;  ///< digits after the point that people read; for an interval the least number of
                   ///< them
    bool interval; ///< its cells have 95 % limits: NAME_least and NAME_greatest in CSV,
                   ///< [least, greatest] under NAME_ci95 in JSON
    bool flag;     ///< its cells are yes or no: true or false in JSON
} bt_column;

typedef struct bt_report_table bt_report_table;

/// An empty table. The columns and texts must outlive it; `title` may be NULL. NULL when out of
/// memory: every call below accepts it, and the writers return BT_ERR_MEMORY.
bt_report_table* bt_report_table_create(const char* title, const bt_column* columns, int count);
void bt_report_table_destroy(bt_report_table* table);

/// Begins a row; the calls below fill its cells from left to right.
void bt_report_table_row(bt_report_table* table);
void bt_report_table_text(bt_report_table* table, const char* text); ///< copied
void bt_report_table_number(bt_report_table* table, double value);   ///< not finite: empty
void bt_report_table_count(bt_report_table* table, int64_t value);
void bt_report_table_flag(bt_report_table* table, bool value);
void bt_report_table_interval(bt_report_table* table, double value, const bt_interval* limits);
void bt_report_table_empty(bt_report_table* table);

/// As a number, but people read the text in its place ("refused"); NAN for no number.
void bt_report_table_said(bt_report_table* table, double value, const char* text);
/// As a flag, but people read the text in the place of "yes" or "no".
void bt_report_table_flag_said(bt_report_table* table, bool value, const char* text);

/// A line below the table, for people only.
void bt_report_table_remark(bt_report_table* table, const char* format, ...)
    __attribute__((format(printf, 2, 3)));

/// The writers. BT_ERR_MEMORY when the table was not made completely; errors of writing stay with
/// the file (ferror).
BT_CHECKED bt_status bt_report_table_print(const bt_report_table* table, FILE* out);
BT_CHECKED bt_status bt_report_table_markdown(const bt_report_table* table, FILE* out);
BT_CHECKED bt_status bt_report_table_csv(const bt_report_table* table, FILE* out);
/// An array of objects, one per row, under `key`.
BT_CHECKED bt_status bt_report_table_json(const bt_report_table* table, bt_json* json,
                                          const char* key);

/// "1,639": a count with its thousands apart. Returns text.
const char* bt_count_text(int64_t count, char text[32]);

/// Digits after the point that an estimate and its limits need: two significant ones of the
/// smaller part of the interval, so that a share near 1 does not read as 1; at most 9.
int bt_interval_decimals(double value, const bt_interval* limits, int least);

#endif
