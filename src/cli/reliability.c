#include "cli/chain.h"
#include "reliability/sobol_indices.h"
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
    bt_high_fidelity* truth = NULL;
    BT_TRY(bt_high_fidelity_create(&chain->study, threads, &bt_interrupted, &truth));
    const bt_reliability_options options = {.truth = bt_high_fidelity_run,
                                            .truth_user = truth,
                                            .threads = threads,
                                            .stop = &bt_interrupted,
                                            .watch = show,
                                            .watch_user = &line};
    const bt_status status =
        bt_reliability_run(&chain->study, surrogate, &options, result, &chain->diag);
    bt_high_fidelity_destroy(truth);
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

/// Sobol's indices of the study as it stands, on the surrogate.
static bt_status run_indices(bt_chain* chain, const bt_surrogate* surrogate) {
    enum { SAMPLES_MAX = 200000, BOOTSTRAP = 200 };
    const bt_study* study = &chain->study;
    const int64_t wanted = study->reliability.samples;
    const bt_sampler sampler = bt_reliability_sampler(study, -1);
    bt_surrogate_classifier* made = NULL;
    bt_sobol_result result;
    BT_TRY(bt_surrogate_classifier_create(study, surrogate, &made, &chain->diag));
    bt_classifier classifier = *bt_surrogate_classifier_get(made);
    const bt_status status = bt_sobol_indices(&sampler, bt_engaged, &classifier,
                                              (int)(wanted < SAMPLES_MAX ? wanted : SAMPLES_MAX),
                                              BOOTSTRAP, (int)study->campaign.threads, &result);
    bt_surrogate_classifier_destroy(made);
    if (status == BT_ERR_NUMERIC) {
        bt_diag_add(&chain->diag, BT_ERROR, BT_NOWHERE,
                    "reliability: the surrogate's outcomes are all the same, there is no variance "
                    "to share out");
        return BT_ERR_INPUT;
    }
    if (status == BT_OK && chain->command->json)
        write_indices(study, &result);
    else if (status == BT_OK && !chain->command->quiet)
        print_indices(study, &result);
    return status;
}

// --- verb -------------------------------------------------------------------------------------

enum { OPTION_AGAIN, OPTION_INDICES };

static bt_status run_with(bt_chain* chain) {
    const char* const* option = chain->command->option;
    bt_surrogate surrogate;
    bool fresh = false;
    BT_TRY(bt_chain_fit(chain, false, &surrogate, &fresh));
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
    .run = run,
};
