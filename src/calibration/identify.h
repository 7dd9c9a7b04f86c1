/// What the data tell about the parameters.
#ifndef BT_CALIBRATION_IDENTIFY_H
#define BT_CALIBRATION_IDENTIFY_H

#include "calibration/calibration.h"

/// Fills sensitivity, singular values and directions, standard errors and correlations of a fit.
/// A bound or a trend that is kept tells nothing: its rows count as 0.
///
/// @param rows      [row_count] at the fitted parameters
/// @param jacobian  [row_count][parameter_count] of the rows over the scaled parameters
/// @param weight    [row_count]
/// @return BT_OK, BT_ERR_MEMORY, BT_ERR_NUMERIC (the decomposition failed)
BT_CHECKED bt_status bt_fit_identify(const bt_calibration* calibration, const double* rows,
                                     const double* jacobian, const double* weight, bt_fit* fit);

#endif
