/// What sweeps found, as tables and figures.
#ifndef BT_REPORT_SWEEP_REPORT_H
#define BT_REPORT_SWEEP_REPORT_H

#include "pipeline/rig_stage.h"
#include "pipeline/sweep.h"
#include "report/table.h"

#include <stdio.h>

/// An empty table of sweeps of a landing, and the rows of one of them: the first bounce per value,
/// in the unit typed. Failed landings are told below. See report/table.h.
bt_report_table* bt_sweep_table_create(void);
void bt_sweep_table_add(bt_report_table* table, const bt_sweep_plan* plan, const bt_sweep* sweep);

/// The way of the hook, one line per value, into a folder (bt_figure_write), and as text where
/// `text` is not NULL. It bears the study's title; what the paper says is in the reference study's.
BT_CHECKED bt_status bt_sweep_draw(const bt_study* study, const bt_sweep_plan* plan,
                                   const bt_sweep* sweep, const char* folder, FILE* text,
                                   bt_diag* diag);

enum { BT_RIG_SWEEP_COLUMNS = 17 };

/// The metrics of a rig, one row per value. `columns` must outlive the table. NULL when out of
/// memory.
bt_report_table* bt_rig_sweep_table(const bt_rig_sweep* sweep,
                                    bt_column columns[BT_RIG_SWEEP_COLUMNS]);

/// Load over stroke (the hook: height over time), one line per value, into a folder. `name`
/// receives the figure's name.
BT_CHECKED bt_status bt_rig_sweep_draw(const bt_study* study, const bt_rig_sweep* sweep,
                                       const char* folder, char name[160], bt_diag* diag);

#endif
