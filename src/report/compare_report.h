/// Two studies against each other, for people and for programs.
#ifndef BT_REPORT_COMPARE_REPORT_H
#define BT_REPORT_COMPARE_REPORT_H

#include "pipeline/compare.h"
#include "report/table.h"

/// One row: shares, difference with interval, McNemar's p, outcomes changed each way.
bt_report_table* bt_compare_table(const bt_comparison* comparison);
/// The keys that differ, with both values, SI.
bt_report_table* bt_compare_keys_table(const bt_comparison* comparison);

#endif
