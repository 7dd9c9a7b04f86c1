/// Verification rigs: drop of a leg, static test of a strut, rebound of the hook.
#ifndef BOLTER_RIG_H
#define BOLTER_RIG_H

#include "bolter/study.h"

#ifdef __cplusplus
extern "C" {
#endif

/// One number that a rig reports. The texts are static.
typedef struct bt_rig_metric {
    const char* name;     ///< with its unit: "stroke_max_m"
    const char* unit;     ///< SI, as written: "m"; "" for ratios
    double value;         ///< NAN where it does not exist
    double reference;     ///< measured value that the study gives; NAN where it gives none
    double error_percent; ///< difference of value from reference; NAN without a reference
    bool accepted;        ///< no reference, or an error within the study's tolerance
} bt_rig_metric;

/// One line of the histories. Arrays and names are valid during the call only.
typedef struct bt_rig_line {
    double time_s;
    int count;
    const char* const* names; ///< [count] with their units: "stroke_m", "strut_force_N"
    const double* values;     ///< [count] SI
} bt_rig_line;

/// Called at the start and after every step.
typedef void bt_rig_watch(void* user, const bt_rig_line* line);

/// What to run. Set size to sizeof(bt_rig_def); what is zero is the default.
typedef struct bt_rig_def {
    size_t size;
    const char* rig;     ///< "nose_drop", "main_drop", "hook_rebound", "nose_static", "main_static"
    bt_rig_watch* watch; ///< may be NULL
    void* user;
} bt_rig_def;

/// Runs a rig of the study.
///
/// @param metrics  [room] receives the metrics; may be NULL when room is 0
/// @param count    how many metrics the rig has, also when room is less
/// @return BT_OK; BT_ERR_ARG (no such rig, or the study does not describe it); BT_ERR_INPUT (it
///         cannot be assembled); BT_ERR_NUMERIC (it diverged); BT_ERR_MEMORY; each said to the
///         case's message function
BT_PUBLIC BT_CHECKED bt_status bt_case_rig(bt_case* opened, const bt_rig_def* def,
                                           bt_rig_metric* metrics, int room, int* count);

#ifdef __cplusplus
}
#endif

#endif
