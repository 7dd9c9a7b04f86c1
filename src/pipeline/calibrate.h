/// Calibration as a stage: a calibration file against a study, and an overlay with what was found.
#ifndef BT_PIPELINE_CALIBRATE_H
#define BT_PIPELINE_CALIBRATE_H

#include "base/directory.h"
#include "calibration/calibration.h"

/// What to calibrate, and who is told.
typedef struct bt_calibrate_stage {
    const char* file; ///< the calibration file
    const char*
        overlay; ///< where the values found go; NULL: calibrated.yaml in the study directory
    const atomic_int* stop;    ///< may be NULL; once not 0: BT_ERR_INTERRUPTED, nothing is written
    bt_fit_progress* progress; ///< may be NULL
    void* user;
} bt_calibrate_stage;

typedef struct bt_calibrate_result {
    bt_calibration calibration;
    bt_fit fit; ///< as far as it came when the stage was interrupted
    double seconds;
    char overlay[BT_FILE_PATH_MAX]; ///< the file that was written
} bt_calibrate_result;

/// Reads the calibration file, finds the values and writes the overlay. The study directory is
/// locked while it is written in.
///
/// @param result  the caller's: bt_calibrate_destroy after BT_OK
/// @return BT_OK; what bt_calibration_read, bt_calibration_fit and bt_file_replace return, said in
///         diag
BT_CHECKED bt_status bt_stage_calibrate(const bt_study* study, const bt_calibrate_stage* stage,
                                        bt_calibrate_result* result, bt_diag* diag);
void bt_calibrate_destroy(bt_calibrate_result* result);

/// Whether every target is met.
bool bt_calibrate_met(const bt_calibrate_result* result);

#endif
