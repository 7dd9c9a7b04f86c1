#include "cli/chain.h"
#include "cli/output.h"
#include "cluster/cluster.h"
#include "report/reliability_figure.h"
#include "report/reliability_report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

/// reliability.csv of the study directory to the file of -o.
static bt_status export_table(bt_chain* chain) {
    char path[BT_FILE_PATH_MAX], *text = NULL;
    size_t size = 0;
    BT_TRY(bt_study_directory_file(&chain->directory, "reliability.csv", path));
    BT_TRY(bt_file_read(path, &text, &size, &chain->diag));
    const bt_status status =
        bt_file_replace(chain->command->output, text, size, strcspn(text, "\n") + 1, &chain->diag);
    free(text);
    return status;
}

bt_status bt_chain_reliability(bt_chain* chain, bool again, const bt_surrogate* surrogate) {
    const bt_command* command = chain->command;
    bool fresh = false;
    bt_progress line = bt_progress_start("reliability", command->quiet || command->json);
    const bt_reliability_stage stage = {.again = again,
                                        .files = bt_reliability_files,
                                        .stop = &bt_interrupted,
                                        .backend = bt_cluster_backend(),
                                        .watch = show,
                                        .watch_user = &line};
    BT_TRY(bt_stage_reliability(&chain->directory, surrogate, &stage, &fresh));
    if (bt_output_kind(command->output) == BT_OUTPUT_TABLE)
        BT_TRY(export_table(chain));
    BT_TRY(copy_out(chain, command->json ? "reliability.json" : "reliability.txt"));
    if (!fresh)
        return BT_OK;
    char folder[BT_FILE_PATH_MAX];
    BT_TRY(bt_study_directory_file(&chain->directory, "figures", folder));
    return bt_reliability_draw(&chain->study, folder, &chain->diag);
}

// --- indices ----------------------------------------------------------------------------------

static const bt_column columns[] = {
    {.name = "path", .head = "input", .unit = ""},
    {.name = "first", .head = "alone", .unit = "", .decimals = 3, .interval = true},
    {.name = "total",
     .head = "with all its interactions",
     .unit = "",
     .decimals = 3,
     .interval = true},
};

static bt_report_table* index_table(const bt_study* study, const bt_sobol_result* r) {
    char samples[32];
    bt_report_table* table = bt_report_table_create(NULL, columns, 3);
    for (int k = 0; k < r->dims; ++k) {
        if (!study->inputs[k].random)
            continue;
        bt_report_table_row(table);
        bt_report_table_text(table, study->inputs[k].path);
        bt_report_table_interval(table, r->first[k].value, &r->first[k].ci95);
        bt_report_table_interval(table, r->total[k].value, &r->total[k].ci95);
    }
    bt_report_table_remark(table,
                           "shares of the variance of the surrogate's outcomes, R = %.4f, %s "
                           "samples; 95 %% intervals of the sampling alone",
                           r->mean, bt_count_text((int64_t)r->evaluations, samples));
    return table;
}

static bt_status show_indices(bt_chain* chain, const bt_sobol_result* r,
                              const bt_report_table* table) {
    BT_TRY(bt_output_table(chain->command, table, &chain->diag));
    if (!chain->command->json)
        return bt_report_table_print(table, stdout);
    bt_json json = {.out = stdout};
    bt_json_begin_object(&json, NULL);
    bt_json_number(&json, "mean", r->mean);
    bt_json_integer(&json, "evaluations", (int64_t)r->evaluations);
    BT_TRY(bt_report_table_json(table, &json, "inputs"));
    bt_json_end_object(&json);
    return BT_OK;
}

static bt_status run_indices(bt_chain* chain, const bt_surrogate* surrogate) {
    bt_sobol_result result;
    BT_TRY(bt_stage_indices(&chain->directory, surrogate, &result));
    bt_report_table* table = index_table(&chain->study, &result);
    const bt_status status = show_indices(chain, &result, table);
    bt_report_table_destroy(table);
    return status;
}

// --- verb -------------------------------------------------------------------------------------

enum { OPTION_AGAIN, OPTION_INDICES, OPTION_PLOT };

static bt_status run_with(bt_chain* chain) {
    const char* const* option = chain->command->option;
    bt_surrogate surrogate;
    BT_TRY(bt_stage_fit(&chain->directory, false, &surrogate, NULL));
    bt_status status = option[OPTION_INDICES]
                           ? run_indices(chain, &surrogate)
                           : bt_chain_reliability(chain, option[OPTION_AGAIN] != NULL, &surrogate);
    bt_surrogate_destroy(&surrogate);
    if (status == BT_OK && option[OPTION_PLOT] && !option[OPTION_INDICES] && !chain->command->json)
        status = bt_reliability_print(&chain->study, stdout, &chain->diag);
    return status;
}

static bt_status run_reliability(const bt_command* command) {
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
    {"plot", BT_OPTION + OPTION_PLOT, 0, 0, "draw the curves in the terminal too", 1},
    {0},
};

const bt_verb bt_verb_reliability = {
    .name = "reliability",
    .summary = "probability of engagement for every condition, with intervals",
    .arguments = "STUDY.yaml",
    .text =
        "Draws the study's samples for every condition, predicts their outcomes with the "
        "surrogate, and checks it "
        "with fresh landings of the full model drawn from the same distributions. Each "
        "condition has the surrogate's estimate with its sampling interval, the "
        "disagreements, and the corrected estimate with an interval that covers both. Trains "
        "the surrogate first when it is out of date. Writes STUDY/reliability.json, .csv and .txt "
        "and draws reliability over each input, and half-width over landings, into "
        "STUDY/figures.\n\n"
        "With --indices: for every input, the share of the variance of the surrogate's "
        "outcomes that it alone explains, and its share with all its interactions. Nothing is "
        "written.",
    .options = options,
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_TABLE | BT_OUTPUT_DIRECTORY,
    .run = run_reliability,
};
