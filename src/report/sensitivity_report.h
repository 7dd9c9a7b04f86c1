/// The table of `bolter sensitivity`: a row per key and distance.
#ifndef BT_REPORT_SENSITIVITY_REPORT_H
#define BT_REPORT_SENSITIVITY_REPORT_H

#include "pipeline/sensitivity.h"
#include "report/table.h"

/// An empty table; NULL when out of memory (see report/table.h).
bt_report_table* bt_sensitivity_table_create(void);

/// Adds a row per key.
void bt_sensitivity_table_add(bt_report_table* table, const bt_sensitivity_result* result);

#endif
