/// The table of `bolter noise`: a row per computation.
#ifndef BT_REPORT_NOISE_REPORT_H
#define BT_REPORT_NOISE_REPORT_H

#include "pipeline/noise.h"
#include "report/table.h"

/// An empty table; NULL when out of memory (see report/table.h).
bt_report_table* bt_noise_table_create(void);

/// Adds the row of a computation; `variant` NULL: as the study sets it, with which nothing is
/// compared.
void bt_noise_table_add(bt_report_table* table, const bt_noise_variant* variant, int64_t count,
                        const bt_noise_difference* difference);

#endif
