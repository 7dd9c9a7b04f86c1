/// One test on a rig as a study describes it, one key of it over several values.
#ifndef BT_PIPELINE_RIG_STAGE_H
#define BT_PIPELINE_RIG_STAGE_H

#include "rigs/record.h"
#include "study/study.h"

/// The measured curves of one rig, bound to the columns of its record.
typedef struct bt_rig_curves {
    int count;
    bt_measured* measured[BT_CURVES_MAX]; ///< owned
} bt_rig_curves;

/// Reads the curves that the study names for a rig and checks their columns and units. Every
/// mistake is said in diag with its place in the CSV file; a file that cannot be read at the place
/// that names it. BT_ERR_INPUT, BT_ERR_IO, BT_ERR_MEMORY.
BT_CHECKED bt_status bt_rig_curves_read(const bt_study* study, bt_rig_kind kind,
                                        bt_rig_curves* curves, bt_diag* diag);
void bt_rig_curves_destroy(bt_rig_curves* curves);

/// What a test gave, beside what was measured.
typedef struct bt_rig_test {
    bt_rig_curves curves;
    bt_rig_record record;
    bt_rig_result result;
} bt_rig_test;

/// Reads the measured curves that the study names for a rig and runs it.
///
/// @param test  the caller's: bt_rig_test_destroy after BT_OK
/// @return BT_OK; BT_ERR_INPUT (the study does not describe this rig, curves, masses); BT_ERR_IO;
///         BT_ERR_FAILED_RUNS (the motion diverges or leaves a law); BT_ERR_MEMORY; said in diag
BT_CHECKED bt_status bt_stage_rig(const bt_study* study, bt_rig_kind kind, bt_rig_test* test,
                                  bt_diag* diag);
void bt_rig_test_destroy(bt_rig_test* test);

enum { BT_RIG_SWEEP_MAX = 64 };

typedef struct bt_rig_sweep_row {
    char value[64];   ///< of the key, as typed
    bt_rig_test test; ///< without measured curves
} bt_rig_sweep_row;

typedef struct bt_rig_sweep {
    bt_rig_kind kind;
    const char* key; ///< the caller's
    int count;
    bt_rig_sweep_row* rows; ///< [count] in the order of the values
} bt_rig_sweep;

/// Runs a rig once per value of a key: the study is read again with KEY=VALUE as a last --set.
///
/// @param path, sets  of the study, as for bt_study_read_rigs
/// @param values      "A, B, C": at most BT_RIG_SWEEP_MAX, each with its unit
/// @param sweep       the caller's: bt_rig_sweep_destroy after BT_OK
/// @return as bt_stage_rig; BT_ERR_INPUT also for too many values
BT_CHECKED bt_status bt_stage_rig_sweep(const char* path, const char* const* sets, int set_count,
                                        bt_rig_kind kind, const char* key, const char* values,
                                        bt_rig_sweep* sweep, bt_diag* diag);
void bt_rig_sweep_destroy(bt_rig_sweep* sweep);

#endif
