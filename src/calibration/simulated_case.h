/// Running one simulated case: a landing or a rig, what it reports, and its history beside a
/// measured curve.
#ifndef BT_CALIBRATION_SIMULATED_CASE_H
#define BT_CALIBRATION_SIMULATED_CASE_H

#include "calibration/calibration.h"

enum { BT_CASE_METRIC_MAX = 64 };

typedef struct bt_metric_name {
    const char* name;  ///< "bounce_height"
    const char* token; ///< unit of its value
} bt_metric_name;

/// How many metrics a kind of simulated case has room for; at most BT_CASE_METRIC_MAX.
int bt_simulated_case_metric_count(bt_simulated_case_kind kind);

/// One of them; false when this place is no metric. Those of a landing are the numbers of the table
/// of results (landing/result.h) by their quantity ("bounce_height"), those of the first bounce
/// with `bounce_`, of the second with `second_bounce_` before them.
bool bt_simulated_case_metric(bt_simulated_case_kind kind, int index, bt_metric_name* metric);

/// "", "nose_drop.", "main_drop.", "hook_rebound.", "nose_static.", "main_static.": what stands
/// before a metric's name.
const char* bt_simulated_case_prefix(bt_simulated_case_kind kind);

/// What a simulated case is run on.
bt_parameter_set_part bt_simulated_case_part(bt_simulated_case_kind kind);

/// A measured curve to follow and where its model values go.
typedef struct bt_followed {
    const bt_measured* measured;
    double* got; ///< [measured->count]; NAN where the run did not reach
} bt_followed;

/// Runs one simulated case on a checked parameter set.
/// @param metric   [BT_CASE_METRIC_MAX]; NAN where there is none (no bounce, run failed)
/// @return BT_OK also for a run that diverged (said in diag as a warning, all metrics NAN);
///         BT_ERR_MEMORY
BT_CHECKED bt_status bt_simulated_case_run(bt_lander* lander, bt_simulated_case_kind kind,
                                           const bt_parameter_set* set, double* metric,
                                           const bt_followed* followed, int followed_count,
                                           bt_diag* diag);

/// No value anywhere: what a run that was not possible reports.
void bt_simulated_case_void(double* metric, const bt_followed* followed, int followed_count);

/// Finds the columns of a measured curve in the history of a simulated case (bt_measured_bind).
BT_CHECKED bt_status bt_simulated_case_bind(bt_simulated_case_kind kind, bt_measured* measured,
                                            bt_diag* diag);

#endif
