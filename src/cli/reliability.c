#include "cli/chain.h"
#include "cli/output.h"
#include "report/reliability_report.h"

#include <stdio.h>
#include <stdlib.h>

static void show(void* user, int done, int total) {
    bt_progress_show(user, done == total, "%d of %d conditions", done, total);
}

/// Copies a file of the study directory to stdout.
static bt_status copy_out(bt_chain* chain, const char* name) {
    char path[BT_FILE_PATH_MAX], *text = NULL;
    BT_TRY(bt_study_directory_file(&chain->directory, name, path));
    BT_TRY(bt_file_read(path, &text, NULL, &chain->diag));
    fputs(text, stdout);
    free(text);
    return BT_OK;
}

bt_status bt_chain_reliability(bt_chain* chain, bool again, const bt_surrogate* surrogate) {
    const bt_command* command = chain->command;
    bt_progress line = bt_progress_start("reliability", command->quiet || command->json);
    const bt_reliability_stage stage = {.again = again,
                                        .files = bt_reliability_files,
                                        .stop = &bt_interrupted,
                                        .watch = show,
                                        .watch_user = &line};
    BT_TRY(bt_stage_reliability(&chain->directory, surrogate, &stage, NULL));
    return copy_out(chain, command->json ? "reliability.json" : "reliability.txt");
}

// --- indices ----------------------------------------------------------------------------------

static void print_indices(const bt_study* study, const bt_sobol_result* r) {
    printf("%-26s %-26s %s\n", "input", "alone", "with all its interactions");
    for (int k = 0; k < r->dims; ++k)
        if (study->inputs[k].random)
            printf("%-26s %6.3f [%6.3f, %6.3f]    %6.3f [%6.3f, %6.3f]\n", study->inputs[k].path,
                   r->first[k].value, r->first[k].ci95.least, r->first[k].ci95.greatest,
                   r->total[k].value, r->total[k].ci95.least, r->total[k].ci95.greatest);
    printf("shares of the variance of the surrogate's outcomes, R = %.4f, %lld samples; 95 %% "
           "intervals of the sampling alone\n",
           r->mean, (long long)r->evaluations);
}

static void write_index(bt_json* json, const char* key, const bt_index* index) {
    char limits[32];
    snprintf(limits, sizeof limits, "%s_ci95", key);
    bt_json_number(json, key, index->value);
    bt_json_begin_array(json, limits);
    bt_json_number(json, NULL, index->ci95.least);
    bt_json_number(json, NULL, index->ci95.greatest);
    bt_json_end_array(json);
}

static void write_indices(const bt_study* study, const bt_sobol_result* r) {
    bt_json json = {.out = stdout};
    bt_json_begin_object(&json, NULL);
    bt_json_number(&json, "mean", r->mean);
    bt_json_integer(&json, "evaluations", r->evaluations);
    bt_json_begin_array(&json, "inputs");
    for (int k = 0; k < r->dims; ++k) {
        if (!study->inputs[k].random)
            continue;
        bt_json_begin_object(&json, NULL);
        bt_json_string(&json, "path", study->inputs[k].path);
        write_index(&json, "first", &r->first[k]);
        write_index(&json, "total", &r->total[k]);
        bt_json_end_object(&json);
    }
    bt_json_end_array(&json);
    bt_json_end_object(&json);
}

static bt_status run_indices(bt_chain* chain, const bt_surrogate* surrogate) {
    bt_sobol_result result;
    BT_TRY(bt_stage_indices(&chain->directory, surrogate, &result));
    if (chain->command->json)
        write_indices(&chain->study, &result);
    else
        print_indices(&chain->study, &result);
    return BT_OK;
}

// --- verb -------------------------------------------------------------------------------------

enum { OPTION_AGAIN, OPTION_INDICES };

static bt_status run_with(bt_chain* chain) {
    const char* const* option = chain->command->option;
    bt_surrogate surrogate;
    BT_TRY(bt_stage_fit(&chain->directory, false, &surrogate, NULL));
    const bt_status status =
        option[OPTION_INDICES]
            ? run_indices(chain, &surrogate)
            : bt_chain_reliability(chain, option[OPTION_AGAIN] != NULL, &surrogate);
    bt_surrogate_destroy(&surrogate);
    return status;
}

static bt_status run(const bt_command* command) {
    bt_chain chain;
    bt_status status = bt_chain_open(command, BT_LEDGER_WRITE, &chain);
    if (status == BT_OK)
        status = run_with(&chain);
    bt_chain_close(&chain);
    return status;
}

static const struct argp_option options[] = {
    {"again", BT_OPTION + OPTION_AGAIN, 0, 0, "compute the table even if it is up to date", 1},
    {"indices", BT_OPTION + OPTION_INDICES, 0, 0,
     "instead of the table: which input drives the scatter of outcomes (Sobol' indices)", 1},
    {0},
};

const bt_verb bt_verb_reliability = {
    .name = "reliability",
    .summary = "probability of engagement for every condition, with intervals",
    .arguments = "STUDY.yaml",
    .text = "Draws the study's samples for every condition, asks the surrogate, and checks it "
            "with fresh landings of the full model drawn from the same distributions. Each "
            "condition has the surrogate's estimate with its sampling interval, the "
            "disagreements, and the corrected estimate with an interval that covers both. Trains "
            "the surrogate first when it is out of date. Writes STUDY/reliability.json and "
            "reliability.txt.\n\n"
            "With --indices: for every input, the share of the variance of the surrogate's "
            "outcomes that it alone explains, and its share with all its interactions. Nothing is "
            "written.",
    .options = options,
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_DIRECTORY,
    .run = run,
};
