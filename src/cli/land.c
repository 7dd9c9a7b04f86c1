#include "base/directory.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "cli/version.h"
#include "report/history.h"
#include "report/landing_report.h"
#include "report/page.h"
#include "report/paraview.h"

#include <stdio.h>

/// What is kept of the landing for -o; both NULL: nothing.
typedef struct recorder {
    bt_history* history;
    bt_playback* playback;
} recorder;

static bt_status start(const bt_command* command, recorder* r, bt_diag* diag) {
    if (!command->output)
        return command->option[0]
                   ? bt_playback_create(BT_PLAYBACK_ROWS_ALONE, BT_PLAYBACK_NODES, &r->playback)
                   : BT_OK;
    switch (bt_output_kind(command->output)) {
    case BT_OUTPUT_PAGE:
        return bt_page_available(diag)
                   ? bt_playback_create(BT_PLAYBACK_ROWS_ALONE, BT_PLAYBACK_NODES, &r->playback)
                   : BT_ERR_INPUT;
    case BT_OUTPUT_PARAVIEW:
        return bt_playback_create(BT_PARAVIEW_ROWS, BT_LANDING_SEGMENTS_MAX, &r->playback);
    default:
        BT_TRY(bt_history_create(&r->history));
        return command->option[0]
                   ? bt_playback_create(BT_PLAYBACK_ROWS_ALONE, BT_PLAYBACK_NODES, &r->playback)
                   : BT_OK;
    }
}

static void observe(void* user, const bt_landing_view* view) {
    const recorder* r = user;
    if (r->history)
        bt_history_observe(r->history, view);
    if (r->playback)
        bt_playback_observe(r->playback, view);
}

/// Into the file of -o, or as landing.h5 into its directory.
static bt_status write(const bt_command* command, const bt_study* study, const recorder* r,
                       const bt_landing_result* result, bt_diag* diag) {
    char path[BT_FILE_PATH_MAX];
    if (!command->output)
        return BT_OK;
    BT_TRY(bt_output_path(command, "landing.h5", path, diag));
    if (r->history)
        return bt_history_write(r->history, path, study, result, diag);
    if (bt_output_kind(command->output) == BT_OUTPUT_PARAVIEW)
        return bt_paraview_write(path, r->playback, &study->model, diag);
    const bt_page_subject subject = {study, command->words[0], bt_version_build(), NULL};
    return bt_page_landing(&subject, path, r->playback, result, diag);
}

static bt_status land(const bt_command* command, const bt_study* study, recorder* r) {
    bt_diag diag = bt_stderr_diag();
    bt_lander* lander = NULL;
    bt_landing_result result;
    BT_TRY(start(command, r, &diag));
    BT_TRY(bt_lander_create(&lander));
    bt_lander_obey(lander, &bt_interrupted);
    bt_status status = bt_lander_run(lander, &study->model, &result, observe, r, &diag);
    bt_lander_destroy(lander);
    if (status == BT_OK)
        status = write(command, study, r, &result, &diag);
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
    recorder r = {0};
    BT_TRY(bt_command_study(command, &study));
    const bt_status status = land(command, &study, &r);
    bt_history_destroy(r.history);
    bt_playback_destroy(r.playback);
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
