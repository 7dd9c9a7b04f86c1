#include "cli/chain.h"
#include "cli/output.h"
#include "report/table.h"

#include <stdio.h>

static void print_holdout(FILE* out, const bt_surrogate_scores* scores) {
    char count[32];
    if (scores->holdout_count == 0) {
        fprintf(out, "hold-out      none: too few landings to keep any apart, so the accuracy is "
                     "not known\n");
        return;
    }
    const bt_interval ci95 = {100 * scores->holdout_ci95.least,
                              100 * scores->holdout_ci95.greatest};
    const double accuracy = 100 * bt_surrogate_holdout_accuracy(scores);
    const int n = bt_interval_decimals(accuracy, &ci95, 2);
    fprintf(out,
            "hold-out      correct on %.*f %% of %s held-out landings, 95 %% interval %.*f to "
            "%.*f %%\n",
            n, accuracy, bt_count_text(scores->holdout_count, count), n, ci95.least, n,
            ci95.greatest);
    fprintf(out,
            "confusion     engaged: %d correct, %d predicted missed; missed: %d correct, %d "
            "predicted engaged\n",
            scores->confusion[1][1], scores->confusion[1][0], scores->confusion[0][0],
            scores->confusion[0][1]);
}

void bt_surrogate_print(FILE* out, const bt_surrogate* s) {
    const bt_surrogate_scores* scores = &s->scores;
    char count[32];
    if (s->constant)
        fprintf(out, "surrogate     all landings have the same outcome: so has every prediction\n");
    else
        fprintf(out, "surrogate     C %g, gamma %g, %d support vectors, %.1f s\n", s->C, s->gamma,
                s->sv_count, scores->seconds);
    fprintf(out, "weights      ");
    for (int k = 0; k < s->dims; ++k)
        fprintf(out, "%s %s %g", k ? "," : "", s->path[k], s->weight[k]);
    fprintf(out, "\n");
    print_holdout(out, scores);
    fprintf(out,
            "training      correct on %.2f %% of %s training landings (no evidence of "
            "accuracy)\n",
            100 * bt_surrogate_train_accuracy(scores), bt_count_text(scores->train_count, count));
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
    BT_TRY(bt_stage_fit(&chain->directory, chain->command->option[0] != NULL, &surrogate, NULL));
    if (chain->command->json)
        write_json(&surrogate);
    else
        bt_surrogate_print(stdout, &surrogate);
    bt_surrogate_destroy(&surrogate);
    return BT_OK;
}

static bt_status run_fit(const bt_command* command) {
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
    .outputs = BT_OUTPUT_DIRECTORY,
    .run = run_fit,
};
