#include "base/clock.h"
#include "base/hash.h"
#include "surrogate/predictor.h"
#include "surrogate/training.h"

#include <math.h>
#include <string.h>

// LIBSVM's stopping tolerance for the classifier that is kept: on the slopes of the dual, where the
// margin is 1.
static const double final_tolerance = 1e-3;

/// FNV-1a over dims, count, inputs and labels.
static uint64_t hash_set(const bt_training_set* set) {
    const size_t count = (size_t)set->count;
    uint64_t hash = bt_hash_bytes(BT_HASH_START, &set->dims, sizeof set->dims);
    hash = bt_hash_bytes(hash, &set->count, sizeof set->count);
    hash = bt_hash_bytes(hash, set->x, count * (size_t)set->dims * sizeof *set->x);
    return bt_hash_bytes(hash, set->label, count * sizeof *set->label);
}

/// Right answers among n landings of the list; the classifier takes standardised points.
static bt_status count_correct(const bt_training* t, const bt_surrogate* classifier,
                               const int* list, int n, int confusion[2][2]) {
    bt_predictor* predictor;
    BT_TRY(bt_predictor_create(classifier, bt_isa_best(), &predictor));
    memset(confusion, 0, sizeof(int[2][2]));
    for (int i = 0; i < n; ++i) {
        int8_t label;
        bt_predictor_label(predictor, t->z + (size_t)list[i] * (size_t)t->dims, 1, &label, NULL);
        ++confusion[t->set->label[list[i]] > 0][label > 0];
    }
    bt_predictor_destroy(predictor);
    return BT_OK;
}

static bt_status score(const bt_training* t, bt_surrogate* out) {
    bt_surrogate_scores* s = &out->scores;
    int confusion[2][2];
    s->train_count = t->train[0] + t->train[1];
    BT_TRY(count_correct(t, out, t->list, s->train_count, confusion));
    s->train_correct = confusion[0][0] + confusion[1][1];
    s->holdout_count = t->holdout_count;
    BT_TRY(count_correct(t, out, t->holdout, t->holdout_count, s->confusion));
    s->holdout_correct = s->confusion[0][0] + s->confusion[1][1];
    s->holdout_ci95 = bt_clopper_pearson(s->holdout_correct, s->holdout_count, 0.95);
    return BT_OK;
}

/// The classifier of everything that was not held out. Should LIBSVM give up, a softer one is
/// taken.
static bt_status fit_all(const bt_training* t, double C, double gamma, bt_surrogate* out) {
    const int n = t->train[0] + t->train[1];
    bt_svm_effort effort;
    BT_TRY(bt_svm_train(t, t->list, n, C, gamma, final_tolerance, out, &effort));
    while (effort.gave_up) {
        bt_surrogate_destroy(out);
        C /= 10;
        BT_TRY(bt_svm_train(t, t->list, n, C, gamma, final_tolerance, out, &effort));
    }
    return BT_OK;
}

/// The warnings of a set that has next to nothing to say.
static void warn(const bt_training* t, double holdout, bt_diag* diag) {
    if (!t->train[0] || !t->train[1])
        bt_diag_add(diag, BT_WARNING, BT_NOWHERE,
                    "all %d landings were %s; the surrogate is constant and knows no boundary",
                    t->set->count, t->train[0] ? "engaged" : "missed");
    if (holdout > 0 && t->holdout_count == 0)
        bt_diag_add(diag, BT_WARNING, BT_NOWHERE,
                    "%d landings are too few to hold any out: the surrogate's error on others is "
                    "not known",
                    t->set->count);
    else if (holdout > 0 && t->train[0] && t->train[1]) {
        int held[2] = {0, 0};
        for (int i = 0; i < t->holdout_count; ++i)
            ++held[t->set->label[t->holdout[i]] < 0];
        if (!held[0] || !held[1])
            bt_diag_add(diag, BT_WARNING, BT_NOWHERE,
                        "no %s landing is among the %d held out: the surrogate's error on those "
                        "is not known",
                        held[0] ? "missed" : "engaged", t->holdout_count);
    }
}

static void take_scaling(const bt_training* t, const double* weight, bt_surrogate* out) {
    for (int k = 0; k < t->dims; ++k) {
        out->centre[k] = t->centre[k];
        out->scale[k] = t->scale[k];
        out->weight[k] = weight[k];
        out->least[k] = t->least[k];
        out->greatest[k] = t->greatest[k];
    }
}

bt_status bt_surrogate_fit(const bt_training_set* set, const bt_hyperparameters* chosen,
                           double holdout, uint64_t seed, bt_surrogate* out, bt_diag* diag) {
    *out = (bt_surrogate){0};
    const double begun_s = bt_clock_s();
    bt_training t;
    bt_status status = bt_training_create(set, holdout, seed, &t, diag);
    if (status == BT_OK) {
        bt_training_weigh(&t, chosen->weight);
        warn(&t, holdout, diag);
        status = fit_all(&t, chosen->C, chosen->gamma, out);
    }
    if (status == BT_OK)
        status = score(&t, out);
    if (status == BT_OK) {
        take_scaling(&t, chosen->weight, out);
        out->scores.cv_count = chosen->cv_count;
        out->scores.cv_correct = chosen->cv_correct;
        out->training_hash = hash_set(set);
        out->scores.seconds = bt_clock_s() - begun_s;
    } else {
        bt_surrogate_destroy(out);
    }
    bt_training_destroy(&t);
    return status;
}

bt_status bt_surrogate_train(const bt_training_set* set, const bt_surrogate_params* params,
                             uint64_t seed, int threads, bt_surrogate* out, bt_grid* grid,
                             bt_diag* diag) {
    *out = (bt_surrogate){0};
    const double begun_s = bt_clock_s();
    bt_hyperparameters chosen;
    BT_TRY(bt_surrogate_select(set, params, params->holdout, seed, threads, &chosen, grid, diag));
    BT_TRY(bt_surrogate_fit(set, &chosen, params->holdout, seed, out, diag));
    out->scores.seconds = bt_clock_s() - begun_s;
    return BT_OK;
}
