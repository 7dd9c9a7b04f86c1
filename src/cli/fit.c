#include "cli/chain.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// What a fit depends on, as a text: landings and settings.
static bt_status fit_key(bt_chain* chain, char* text, size_t size) {
    uint64_t hash = 0;
    BT_TRY(bt_ledger_hash(chain->ledger, &hash, &chain->diag));
    const bt_surrogate_params* p = &chain->study.surrogate;
    FILE* out = fmemopen(text, size, "w");
    if (!out)
        return BT_ERR_MEMORY;
    fprintf(out, "weighted by loss %016" PRIx64 " folds %lld holdout %a C", hash, (long long)p->folds,
            p->holdout);
    for (int i = 0; i < p->C.count; ++i)
        fprintf(out, " %a", p->C.value[i]);
    fprintf(out, " gamma");
    for (int i = 0; i < p->gamma.count; ++i)
        fprintf(out, " %a", p->gamma.value[i]);
    return fclose(out) == 0 ? BT_OK : BT_ERR_INTERNAL;
}

/// The model on disk, if it is the one that the landings and settings give.
static bool load_current(bt_chain* chain, const char* key, const char* path,
                         bt_surrogate* surrogate) {
    char* stored = bt_ledger_remark(chain->ledger, "fit");
    const bool same = stored && strcmp(stored, key) == 0;
    free(stored);
    return same && bt_surrogate_load(path, surrogate, NULL) == BT_OK;
}

static bt_status train(bt_chain* chain, const char* path, bt_surrogate* surrogate) {
    const bt_study* study = &chain->study;
    const bt_axes axes = bt_design_axes(study);
    bt_labels labels;
    BT_TRY(bt_labels_read(chain->ledger, axes.count, &labels, &chain->diag));
    const bt_training_set set = {
        .dims = axes.count, .count = labels.count, .x = labels.x, .label = labels.label};
    bt_status status =
        bt_surrogate_train(&set, &study->surrogate, (uint64_t)study->campaign.seed,
                           (int)study->campaign.threads, surrogate, NULL, &chain->diag);
    bt_labels_destroy(&labels);
    if (status != BT_OK)
        return status;
    for (int i = 0; i < axes.count; ++i)
        memcpy(surrogate->path[i], study->inputs[axes.input[i]].path, BT_PATH_MAX);
    surrogate->study_hash = study->hash;
    status = bt_surrogate_save(surrogate, path, &chain->diag);
    if (status != BT_OK)
        bt_surrogate_destroy(surrogate);
    return status;
}

bt_status bt_chain_fit(bt_chain* chain, bool again, bt_surrogate* surrogate, bool* fresh) {
    char path[BT_FILE_PATH_MAX], key[4096] = "";
    BT_TRY(bt_chain_file(chain, "surrogate.model", path));
    BT_TRY(fit_key(chain, key, sizeof key));
    *fresh = again || !load_current(chain, key, path, surrogate);
    if (!*fresh)
        return BT_OK;
    BT_TRY(train(chain, path, surrogate));
    const bt_status status = bt_ledger_set_remark(chain->ledger, "fit", key, &chain->diag);
    if (status != BT_OK)
        bt_surrogate_destroy(surrogate);
    return status;
}

void bt_surrogate_print(FILE* out, const bt_surrogate* s) {
    const bt_surrogate_scores* scores = &s->scores;
    if (s->constant)
        fprintf(out, "surrogate     all landings are of one kind: it always answers the same\n");
    else
        fprintf(out, "surrogate     C %g, gamma %g, %d support vectors, %.1f s\n", s->C, s->gamma,
                s->sv_count, scores->seconds);
    fprintf(out, "weights      ");
    for (int k = 0; k < s->dims; ++k)
        fprintf(out, "%s %s %g", k ? "," : "", s->path[k], s->weight[k]);
    fprintf(out, "\n");
    fprintf(
        out,
        "hold-out      %.2f %% of %d landings it never saw right, 95 %% interval %.2f .. %.2f %%\n",
        100 * bt_surrogate_holdout_accuracy(scores), scores->holdout_count,
        100 * scores->holdout_ci95.least, 100 * scores->holdout_ci95.greatest);
    fprintf(out, "training      %.2f %% of %d (its own points: no evidence of accuracy)\n",
            100 * bt_surrogate_train_accuracy(scores), scores->train_count);
    fprintf(out,
            "confusion     engaged: %d right, %d taken for missed; missed: %d right, %d taken for "
            "engaged\n",
            scores->confusion[1][1], scores->confusion[1][0], scores->confusion[0][0],
            scores->confusion[0][1]);
}

static void write_json(const bt_surrogate* s) {
    bt_json json = {.out = stdout};
    const bt_surrogate_scores* scores = &s->scores;
    bt_json_begin_object(&json, NULL);
    bt_json_number(&json, "train_accuracy", bt_surrogate_train_accuracy(scores));
    bt_json_integer(&json, "train_n", scores->train_count);
    bt_json_number(&json, "holdout_accuracy", bt_surrogate_holdout_accuracy(scores));
    bt_json_integer(&json, "holdout_n", scores->holdout_count);
    bt_json_begin_array(&json, "holdout_ci95");
    bt_json_number(&json, NULL, scores->holdout_ci95.least);
    bt_json_number(&json, NULL, scores->holdout_ci95.greatest);
    bt_json_end_array(&json);
    bt_json_begin_object(&json, "confusion");
    bt_json_integer(&json, "engaged_engaged", scores->confusion[1][1]);
    bt_json_integer(&json, "engaged_missed", scores->confusion[1][0]);
    bt_json_integer(&json, "missed_engaged", scores->confusion[0][1]);
    bt_json_integer(&json, "missed_missed", scores->confusion[0][0]);
    bt_json_end_object(&json);
    bt_json_integer(&json, "support_vectors", s->sv_count);
    bt_json_bool(&json, "constant", s->constant);
    bt_json_number(&json, "C", s->C);
    bt_json_number(&json, "gamma", s->gamma);
    bt_json_begin_object(&json, "weights");
    for (int k = 0; k < s->dims; ++k)
        bt_json_number(&json, s->path[k], s->weight[k]);
    bt_json_end_object(&json);
    bt_json_number(&json, "seconds", scores->seconds);
    bt_json_end_object(&json);
}

static bt_status fit(bt_chain* chain) {
    bt_surrogate surrogate;
    bool fresh = false;
    BT_TRY(bt_chain_fit(chain, chain->command->option[0] != NULL, &surrogate, &fresh));
    if (chain->command->json)
        write_json(&surrogate);
    else if (!chain->command->quiet)
        bt_surrogate_print(stdout, &surrogate);
    bt_surrogate_destroy(&surrogate);
    return BT_OK;
}

static bt_status run(const bt_command* command) {
    bt_chain chain;
    bt_status status = bt_chain_open(command, BT_LEDGER_WRITE, &chain);
    if (status == BT_OK)
        status = fit(&chain);
    bt_chain_close(&chain);
    return status;
}

static const struct argp_option options[] = {
    {"again", BT_OPTION, 0, 0, "train even if the model on disk is up to date", 1},
    {0},
};

const bt_verb bt_verb_fit = {
    .name = "fit",
    .summary = "train and validate the surrogate on the landings of the ledger",
    .arguments = "STUDY.yaml",
    .text = "Trains a support-vector classifier on the finished landings, chooses its two "
            "parameters by cross-validation, keeps a share of the landings apart to measure the "
            "accuracy on, and writes STUDY/surrogate.model. Failed runs are never labels.",
    .options = options,
    .least_words = 1,
    .most_words = 1,
    .run = run,
};
