#include "cli/cli.h"
#include "cli/output.h"
#include "report/calibration_report.h"

#include <stdlib.h>

static void show_progress(void* user, int step, double cost) {
    bt_progress_show(user, false, "step %d, cost %.4g", step, cost);
}

/// The table of parameters to -o FILE.csv, and everything to the user.
static bt_status show(const bt_command* command, const bt_calibrate_result* result, bt_diag* diag) {
    bt_report_table* parameters = bt_calibrate_parameters(result);
    const bt_status status = bt_output_table(command, parameters, diag);
    bt_report_table_destroy(parameters);
    if (status != BT_OK)
        return status;
    return command->json ? bt_calibrate_write_json(result, stdout)
                         : bt_calibrate_print(result, stdout);
}

static bt_status calibrate(const bt_command* command, const bt_study* study,
                           bt_calibrate_result* result) {
    bt_diag diag = bt_stderr_diag();
    bt_progress progress = bt_progress_start("calibrate", command->quiet);
    const bool named = bt_output_kind(command->output) == BT_OUTPUT_VALUES;
    const bt_calibrate_stage stage = {.file = command->words[1],
                                      .overlay = named ? command->output : NULL,
                                      .stop = &bt_interrupted,
                                      .progress = show_progress,
                                      .user = &progress};
    bt_status status = bt_stage_calibrate(study, &stage, result, &diag);
    if (status == BT_ERR_INTERRUPTED)
        fprintf(stderr, "calibrate: interrupted after %d steps, nothing was written\n",
                result->fit.steps);
    if (status != BT_OK)
        return status;
    bt_progress_show(&progress, true, "step %d, cost %.4g", result->fit.steps, result->fit.cost);
    status = show(command, result, &diag);
    bt_calibrate_destroy(result);
    return status;
}

static bt_status run_calibrate(const bt_command* command) {
    bt_study study;
    BT_TRY(bt_command_rigs(command, &study));
    bt_calibrate_result* result = malloc(sizeof *result);
    const bt_status status = result ? calibrate(command, &study, result) : BT_ERR_MEMORY;
    free(result);
    bt_study_destroy(&study);
    return status;
}

const bt_verb bt_verb_calibrate = {
    .name = "calibrate",
    .summary = "find keys that meet measurements, and say which the data tell",
    .arguments = "STUDY.yaml CALIBRATION.yaml",
    .text =
        "Finds values of chosen keys, within bounds, with which landings and rigs meet the targets "
        "of a calibration file (see studies/reference/calibration.yaml): values with tolerances, "
        "bounds, trends, measured curves. Prints the fit, how sensitive each target is, and which "
        "parameters and combinations of them the data do not identify.\n\n"
        "  bolter calibrate study.yaml calibration.yaml           writes what it found\n"
        "  bolter land study.yaml --set @study/calibrated.yaml    uses it\n\n"
        "What is found goes into calibrated.yaml in the study directory, or where -o says; "
        "-o FILE.csv takes the table of parameters.",
    .least_words = 2,
    .most_words = 2,
    .outputs = BT_OUTPUT_VALUES | BT_OUTPUT_TABLE | BT_OUTPUT_DIRECTORY,
    .run = run_calibrate,
};
