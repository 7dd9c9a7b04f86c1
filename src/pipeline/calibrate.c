#include "pipeline/calibrate.h"

#include "base/clock.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bt_status write_overlay(const bt_calibrate_result* result, bt_diag* diag) {
    char* text = NULL;
    size_t size = 0;
    BT_TRY(bt_calibration_overlay(&result->calibration, &result->fit, &text, &size));
    const bt_status status =
        bt_file_replace(result->overlay, text, size, strlen("# Calibrated by bolter"), diag);
    free(text);
    return status;
}

static bt_status fit_and_write(const bt_calibrate_stage* stage, bt_calibrate_result* result,
                               bt_diag* diag) {
    const double start_s = bt_clock_s();
    const bt_status status = bt_calibration_fit(&result->calibration, &result->fit, stage->stop,
                                                stage->progress, stage->user, diag);
    result->seconds = bt_clock_s() - start_s;
    return status == BT_OK ? write_overlay(result, diag) : status;
}

/// Into the file that the stage names, or calibrated.yaml of the study directory.
static bt_status calibrate_into(const bt_study* study, const bt_calibrate_stage* stage,
                                bt_calibrate_result* result, bt_diag* diag) {
    if (stage->overlay) {
        snprintf(result->overlay, sizeof result->overlay, "%s", stage->overlay);
        return fit_and_write(stage, result, diag);
    }
    bt_directory directory;
    BT_TRY(bt_file_path(result->overlay, study->directory, "calibrated.yaml"));
    BT_TRY(bt_directory_open(&directory, study->directory, diag));
    const bt_status status = fit_and_write(stage, result, diag);
    bt_directory_close(&directory);
    return status;
}

bt_status bt_stage_calibrate(const bt_study* study, const bt_calibrate_stage* stage,
                             bt_calibrate_result* result, bt_diag* diag) {
    BT_TRY(bt_calibration_read(stage->file, study, &result->calibration, diag));
    const bt_status status = calibrate_into(study, stage, result, diag);
    if (status != BT_OK)
        bt_calibrate_destroy(result);
    return status;
}

void bt_calibrate_destroy(bt_calibrate_result* result) {
    bt_calibration_destroy(&result->calibration);
}

bool bt_calibrate_met(const bt_calibrate_result* result) {
    for (int i = 0; i < result->calibration.target_count; ++i)
        if (!result->fit.targets[i].met)
            return false;
    return true;
}
