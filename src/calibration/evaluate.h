/// The residuals of a calibration at several sets of parameters at once, on several threads.
#ifndef BT_CALIBRATION_EVALUATE_H
#define BT_CALIBRATION_EVALUATE_H

#include "calibration/calibration.h"

/// @param u      [points][parameter_count] scaled parameters, 0..1
/// @param stop   may be NULL; once not 0 no more runs begin
/// @param rows   [points][row_count] c_i in tolerances, before max(0, .) of bounds and trends; NAN
///               where a run failed or the parameters do not go together (said in diag)
/// @param got    [points][target_count] what the targets compare, SI; may be NULL
/// @return BT_OK, BT_ERR_INTERRUPTED, BT_ERR_MEMORY
BT_CHECKED bt_status bt_calibration_evaluate(const bt_calibration* calibration, const double* u,
                                             int points, const atomic_int* stop, double* rows,
                                             double* got, bt_diag* diag);

/// Whether a residual counts only while it is positive.
bool bt_target_is_one_sided(const bt_target* target);

#endif
