/// What a calibration found: tables of targets, parameters, sensitivities, combinations of
/// parameters and correlations.
#ifndef BT_REPORT_CALIBRATION_REPORT_H
#define BT_REPORT_CALIBRATION_REPORT_H

#include "pipeline/calibrate.h"
#include "report/table.h"

/// The targets: wanted, before and after, residual, met. To be destroyed by the caller; NULL when
/// out of memory (see report/table.h). So are the others.
bt_report_table* bt_calibrate_targets(const bt_calibrate_result* result);

/// The parameters: bounds, start, value, standard error, identified; a letter for each.
bt_report_table* bt_calibrate_parameters(const bt_calibrate_result* result);

/// All tables for people, and what became of the fit.
BT_CHECKED bt_status bt_calibrate_print(const bt_calibrate_result* result, FILE* out);

/// One object: `parameters`, `targets`, `sensitivity` [target][parameter], `correlation`,
/// `singular_directions`, `converged`, `met`, `start_cost`,
/// `cost`, `steps`, `runs`, `seconds`, `overlay`.
BT_CHECKED bt_status bt_calibrate_write_json(const bt_calibrate_result* result, FILE* out);

#endif
