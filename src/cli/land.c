#include "base/directory.h"
#include "cli/output.h"
#include "cli/recorder.h"
#include "report/landing_report.h"

#include <stdio.h>

/// Into the file of -o, or as landing.h5 into its directory.
static bt_status output_path(const bt_command* command, char* path, bt_diag* diag) {
    *path = 0;
    return command->output ? bt_output_path(command, "landing.h5", path, diag) : BT_OK;
}

static bt_status land(const bt_command* command, const bt_study* study, bt_recorder* r) {
    bt_diag diag = bt_stderr_diag();
    bt_lander* lander = NULL;
    bt_landing_result result;
    char path[BT_FILE_PATH_MAX];
    BT_TRY(output_path(command, path, &diag));
    BT_TRY(bt_recorder_start(path, command->option[0] != NULL, r, &diag));
    BT_TRY(bt_lander_create(&lander));
    bt_lander_obey(lander, &bt_interrupted);
    const bt_page_landing_of of = {-1, "landing", &study->model, &result};
    bt_status status = bt_lander_run(lander, &study->model, &result, bt_recorder_observe, r, &diag);
    bt_lander_destroy(lander);
    if (status == BT_OK)
        status = bt_recorder_write(r, command, study, path, &of, &diag);
    if (status != BT_OK)
        return status;
    if (command->json) {
        bt_json json = {.out = stdout};
        bt_landing_write_json(&json, &result);
    } else
        bt_landing_print(stdout, &result);
    if (command->option[0] && r->playback && !command->json)
        bt_playback_print(r->playback, study->title, stdout);
    if (result.outcome != BT_FAILED)
        return BT_OK;
    bt_say_error(command, "the landing failed: %s, %s at %.4g s", result.failed_element,
                 result.failed_quantity, result.failed_time_s);
    return BT_ERR_FAILED_RUNS;
}

static bt_status run_land(const bt_command* command) {
    bt_study study;
    bt_recorder r = {0};
    BT_TRY(bt_command_study(command, &study));
    const bt_status status = land(command, &study, &r);
    bt_recorder_end(&r);
    bt_study_destroy(&study);
    return status;
}

static const struct argp_option options[] = {
    {"plot", BT_OPTION, 0, 0, "draw the heights of hook and cable in the terminal", 1},
    {0},
};

const bt_verb bt_verb_land = {
    .name = "land",
    .summary = "simulate one landing: outcome, bounces, peak loads",
    .arguments = "STUDY.yaml",
    .text = "Simulates the landing of the study's `landing:' and says whether the hook caught the "
            "wire, how, by which margin, how the hook bounced, and the peak loads. Loads of the "
            "hook on the deck are not calibrated; loads after a catch hold for 50 ms.\n\n"
            "  bolter land study.yaml --set landing.distance='7 m'\n"
            "  bolter land study.yaml -o landing.h5     time histories (HDF5, with units; .csv: "
            "CSV)\n"
            "  bolter land study.yaml -o landing.html   a page that plays it in three dimensions\n"
            "  bolter land study.yaml -o landing.pvd    for ParaView\n\n"
            "The exit code is 4 when the computation diverged.",
    .options = options,
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_HISTORIES | BT_OUTPUT_TABLE | BT_OUTPUT_PAGE | BT_OUTPUT_PARAVIEW |
               BT_OUTPUT_DIRECTORY,
    .run = run_land,
};
