#include "cli/chain.h"
#include "report/reliability_report.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// What the table depends on, as a text (to be freed): the surrogate, the distributions, the
/// conditions, the settings, and the model that checks it.
static char* table_key(const bt_chain* chain, const bt_surrogate* surrogate) {
    const bt_study* study = &chain->study;
    const bt_reliability_params* p = &study->reliability;
    char* text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fprintf(out,
            "training %016" PRIx64 " C %a gamma %a rho %a samples %lld truth %lld others %d "
            "seed %lld\n",
            surrogate->training_hash, surrogate->C, surrogate->gamma, surrogate->rho,
            (long long)p->samples, (long long)p->truth_runs, p->others, (long long)p->seed);
    for (int i = 0; i < study->input_count; ++i) {
        const bt_distribution* d = &study->inputs[i].distribution;
        if (study->inputs[i].random)
            fprintf(out, "%s %d %a %a %a %a %a %a %a\n", study->inputs[i].path, d->kind, d->mean,
                    d->sd, d->lower, d->upper, d->mode, d->scale, d->shape);
    }
    for (int i = 0; i < study->condition_count; ++i)
        fprintf(out, "%d %a\n", study->conditions[i].input, study->conditions[i].mean);
    if (fclose(out) != 0) {
        free(text);
        return NULL;
    }
    return text;
}

static void show(void* user, int done, int total) {
    bt_progress_show(user, done == total, "%d of %d conditions", done, total);
}

static bt_status compute(bt_chain* chain, const bt_surrogate* surrogate,
                         bt_reliability_result* result) {
    const int threads = (int)chain->study.campaign.threads;
    bt_progress line =
        bt_progress_start("reliability", chain->command->quiet || chain->command->json);
    bt_truth* truth = NULL;
    BT_TRY(bt_truth_create(&chain->study, threads, &bt_interrupted, &truth));
    const bt_reliability_options options = {.truth = bt_truth_run,
                                            .truth_user = truth,
                                            .threads = threads,
                                            .stop = &bt_interrupted,
                                            .watch = show,
                                            .watch_user = &line};
    const bt_status status =
        bt_reliability_run(&chain->study, surrogate, &options, result, &chain->diag);
    bt_truth_destroy(truth);
    return status;
}

static void append(void* user, const char* text) {
    fputs(text, user);
}

/// Writes one of the two forms of the table into the study directory.
static bt_status store(bt_chain* chain, const char* name, bool as_json,
                       const bt_reliability_result* result) {
    char path[BT_FILE_PATH_MAX], *text = NULL;
    size_t size = 0;
    BT_TRY(bt_chain_file(chain, name, path));
    FILE* out = open_memstream(&text, &size);
    if (!out)
        return BT_ERR_MEMORY;
    if (as_json) {
        bt_json json = {.out = out};
        bt_reliability_write_json(&json, result);
    } else
        bt_reliability_print(result, append, out);
    const bt_status status =
        fclose(out) == 0 ? bt_file_write(path, text, size, &chain->diag) : BT_ERR_MEMORY;
    free(text);
    return status;
}

static bt_status renew(bt_chain* chain, const bt_surrogate* surrogate, const char* key) {
    bt_reliability_result* result = calloc(1, sizeof *result);
    bt_status status = result ? compute(chain, surrogate, result) : BT_ERR_MEMORY;
    if (status == BT_OK)
        status = store(chain, "reliability.txt", false, result);
    if (status == BT_OK)
        status = store(chain, "reliability.json", true, result);
    if (status == BT_OK)
        status = bt_ledger_set_remark(chain->ledger, "reliability", key, &chain->diag);
    free(result);
    return status;
}

/// Copies a file of the study directory to stdout. False when it is not there.
static bool copy_out(bt_chain* chain, const char* name) {
    char path[BT_FILE_PATH_MAX], *text = NULL;
    if (bt_chain_file(chain, name, path) != BT_OK || bt_file_read(path, &text, NULL, NULL) != BT_OK)
        return false;
    fputs(text, stdout);
    free(text);
    return true;
}

bt_status bt_chain_reliability(bt_chain* chain, bool again, const bt_surrogate* surrogate) {
    const char* form = chain->command->json ? "reliability.json" : "reliability.txt";
    char* key = table_key(chain, surrogate);
    if (!key)
        return BT_ERR_MEMORY;
    char* stored = bt_ledger_remark(chain->ledger, "reliability");
    const bool current = !again && stored && strcmp(stored, key) == 0;
    bt_status status = BT_OK;
    if (!current || (!chain->command->quiet && !copy_out(chain, form))) {
        status = renew(chain, surrogate, key);
        if (status == BT_OK && !chain->command->quiet)
            copy_out(chain, form);
    }
    free(stored);
    free(key);
    return status;
}

static bt_status run_with(bt_chain* chain) {
    bt_surrogate surrogate;
    bool fresh = false;
    BT_TRY(bt_chain_fit(chain, false, &surrogate, &fresh));
    const bt_status status =
        bt_chain_reliability(chain, chain->command->option[0] != NULL, &surrogate);
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
    {"again", BT_OPTION, 0, 0, "compute the table even if it is up to date", 1},
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
            "reliability.txt.",
    .options = options,
    .least_words = 1,
    .most_words = 1,
    .run = run,
};
