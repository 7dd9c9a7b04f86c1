#include "cli/chain.h"
#include "cli/output.h"
#include "report/why_report.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/// A landing in question.
typedef struct question {
    bt_chain* chain;
    int64_t run;            ///< -1: the study's own landing
    double x[BT_INPUT_MAX]; ///< in the order of the design's axes
    bt_model_params model;
    bt_playback* playback;
    bt_landing_result result;
    bt_timeline timeline;
    bt_flips flips;
} question;

/// The inputs of the run, from the ledger or from the study.
static bt_status find(question* q) {
    const bt_study* study = &q->chain->study;
    const bt_axes axes = bt_design_axes(study);
    bt_ledger_row row;
    if (q->run < 0) {
        for (int i = 0; i < axes.count; ++i) {
            const bt_input* input = &study->inputs[axes.input[i]];
            q->x[i] = bt_field_get(input->field, &study->model, input->offset);
        }
        return BT_OK;
    }
    const bt_status status = bt_ledger_get(q->chain->ledger, q->run, &row, &q->chain->diag);
    if (status == BT_ERR_ARG)
        return bt_usage_error(q->chain->command, "the ledger has no run %lld", (long long)q->run);
    for (int i = 0; i < axes.count && status == BT_OK; ++i)
        q->x[i] = row.x[i];
    return status;
}

static bt_status land(question* q) {
    const bt_study* study = &q->chain->study;
    const bt_axes axes = bt_design_axes(study);
    bt_lander* lander = NULL;
    BT_TRY(bt_playback_create(BT_PLAYBACK_ROWS_ALONE, BT_PLAYBACK_NODES, &q->playback));
    BT_TRY(bt_lander_create(&lander));
    bt_lander_obey(lander, &bt_interrupted);
    q->model = study->model;
    const bt_status status = bt_landing_at(lander, &q->model, study->inputs, &axes, q->x,
                                           &q->result, bt_playback_observe, q->playback);
    bt_lander_destroy(lander);
    if (status == BT_OK)
        bt_timeline_make(q->playback, &q->model, &q->result, &q->timeline);
    return status;
}

/// With the study directory's classifier to say where to look first, when it has one.
static bt_status find_flips(question* q) {
    char path[BT_FILE_PATH_MAX];
    bt_surrogate surrogate;
    bt_flip_search search = {.study = &q->chain->study,
                             .x = q->x,
                             .outcome = q->result.outcome,
                             .stop = &bt_interrupted};
    if (q->result.outcome == BT_FAILED)
        return BT_OK;
    BT_TRY(bt_file_path(path, q->chain->study.directory, "surrogate.model"));
    const bool asked =
        access(path, F_OK) == 0 && bt_surrogate_load(path, &surrogate, NULL) == BT_OK;
    search.surrogate = asked ? &surrogate : NULL;
    const bt_status status = bt_flips_find(&search, &q->flips, &q->chain->diag);
    if (asked)
        bt_surrogate_destroy(&surrogate);
    return status;
}

static bt_status answer(question* q) {
    BT_TRY(find(q));
    BT_TRY(land(q));
    BT_TRY(find_flips(q));
    const bt_why why = {&q->chain->study, q->run, q->x, &q->result, &q->timeline, &q->flips};
    return q->chain->command->json ? bt_why_json(&why, stdout) : bt_why_print(&why, stdout);
}

static bt_status ask(bt_chain* chain, int64_t run) {
    question* q = calloc(1, sizeof *q);
    if (!q)
        return BT_ERR_MEMORY;
    q->chain = chain;
    q->run = run;
    const bt_status status = answer(q);
    bt_playback_destroy(q->playback);
    free(q);
    return status;
}

/// The study's own landing needs no ledger.
static bt_status open(const bt_command* command, bool ledger, bt_chain* chain) {
    if (ledger)
        return bt_chain_open(command, BT_LEDGER_READ, chain);
    *chain = (bt_chain){.command = command};
    chain->directory.lock.lock = -1;
    chain->diag = bt_stderr_diag();
    return bt_command_study(command, &chain->study);
}

static bt_status run_why(const bt_command* command) {
    int64_t run = -1;
    bt_chain chain;
    if (command->word_count > 1 && !bt_whole_number(command, "N", command->words[1], 0, &run))
        return BT_ERR_ARG;
    bt_status status = open(command, run >= 0, &chain);
    if (status == BT_OK)
        status = ask(&chain, run);
    bt_chain_close(&chain);
    return status;
}

const bt_verb bt_verb_why = {
    .name = "why",
    .summary = "why landing N ended as it did: its timeline, and what would have changed it",
    .arguments = "STUDY.yaml [N]",
    .text = "Repeats landing N of the ledger (without N: the landing of the study itself) and says "
            "in words what happened when. Then it looks for the nearest flip: for each input, the "
            "smallest change of it alone, in standard deviations, at which the outcome is another, "
            "by bisection with real landings; the classifier of the study directory, when there is "
            "one, says where to look.\n\n"
            "  bolter why study.yaml 17\n"
            "  bolter why study.yaml --set landing.distance='8 m'",
    .least_words = 1,
    .most_words = 2,
    .outputs = BT_OUTPUT_DIRECTORY,
    .run = run_why,
};
