/// What can be known of a study before anything is run.
#ifndef BT_PIPELINE_CHECK_H
#define BT_PIPELINE_CHECK_H

#include "landing/stable_step.h"
#include "study/study.h"

/// What the study will do, and how near its steps are to the largest stable ones.
typedef struct bt_check_result {
    int64_t runs; ///< landings of the campaign
    int step_count;
    bt_stable_step steps[BT_STABLE_STEP_MAX];
} bt_check_result;

/// Checks a study that describes a landing: its design, its steps, and whether a landing can begin
/// with each input at either end of its range. Says in diag, as warnings, what is allowed but
/// seldom meant: inputs without a range, distributions outside theirs, settings coarser than those
/// that the label-noise study has shown to be good, ends of a range at which no landing can begin,
/// landings that pass beside the wire.
///
/// @return BT_OK; BT_ERR_INPUT (said in diag: a step above the stable one, no landing can begin);
///         BT_ERR_MEMORY
BT_CHECKED bt_status bt_stage_check(const bt_study* study, bt_check_result* result, bt_diag* diag);

#endif
