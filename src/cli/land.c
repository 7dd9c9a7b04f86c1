#include "base/directory.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "report/history.h"
#include "report/landing_report.h"

#include <stdio.h>

/// Into the file of -o, or as landing.h5 into its directory.
static bt_status write_history(const bt_command* command, const bt_study* study,
                               const bt_history* history, const bt_landing_result* result,
                               bt_diag* diag) {
    char path[BT_FILE_PATH_MAX];
    BT_TRY(bt_output_path(command, "landing.h5", path, diag));
    return bt_history_write(history, path, study, result, diag);
}

static bt_status land(const bt_command* command, const bt_study* study, bt_history* history) {
    bt_diag diag = bt_stderr_diag();
    bt_lander* lander = NULL;
    bt_landing_result result;
    BT_TRY(bt_lander_create(&lander));
    bt_lander_obey(lander, &bt_interrupted);
    bt_status status = bt_lander_run(lander, &study->model, &result,
                                     history ? bt_history_observe : NULL, history, &diag);
    bt_lander_destroy(lander);
    if (status == BT_OK && history)
        status = write_history(command, study, history, &result, &diag);
    if (status != BT_OK)
        return status;
    if (command->json) {
        bt_json json = {.out = stdout};
        bt_landing_write_json(&json, &result);
    } else
        bt_landing_print(stdout, &result);
    if (result.outcome != BT_FAILED)
        return BT_OK;
    bt_say_error(command, "the landing failed: %s, %s at %.4g s", result.failed_element,
                 result.failed_quantity, result.failed_time_s);
    return BT_ERR_FAILED_RUNS;
}

static bt_status run(const bt_command* command) {
    bt_study study;
    bt_history* history = NULL;
    BT_TRY(bt_command_study(command, &study));
    bt_status status = command->output ? bt_history_create(&history) : BT_OK;
    if (status == BT_OK)
        status = land(command, &study, history);
    bt_history_destroy(history);
    bt_study_destroy(&study);
    return status;
}

const bt_verb bt_verb_land = {
    .name = "land",
    .summary = "simulate one landing: outcome, bounces, peak loads",
    .arguments = "STUDY.yaml",
    .text = "Simulates the landing of the study's `landing:' and says whether the hook caught the "
            "wire, how, by which margin, how the hook bounced, and the peak loads. Loads of the "
            "hook on the deck are not calibrated; loads after a catch hold for 50 ms.\n\n"
            "  bolter land study.yaml --set landing.distance='7 m'\n"
            "  bolter land study.yaml -o landing.h5     time histories (HDF5, with units; .csv: "
            "CSV)\n\n"
            "The exit code is 4 when the computation diverged.",
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_HISTORIES | BT_OUTPUT_TABLE | BT_OUTPUT_DIRECTORY,
    .run = run,
};
