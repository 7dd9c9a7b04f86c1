#include "surrogate/relevance.h"

#include "surrogate/tasks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// How far one step goes, nearest first: of two steps that gain alike the shorter is taken.
enum { STEPS = 4, TURNS = 3 };
static const double step[STEPS] = {2, 0.5, 4, 0.25};
static const double weight_least = 0.125, weight_greatest = 16;

/// Several sets of weights to compare.
typedef struct batch {
    const bt_relevance* relevance;
    const double* weight; ///< [sets * dims]
    int* correct;         ///< [sets * folds]
} batch;

static bt_status run_trial(void* user, int task, int worker) {
    (void)worker;
    const batch* b = user;
    const bt_relevance* r = b->relevance;
    const double* weight = b->weight + (size_t)(task / r->folds) * (size_t)r->dims;
    return r->trial(r->user, weight, task % r->folds, &b->correct[task]);
}

/// Right answers of each set of weights, all folds together.
static bt_status count_correct(const bt_relevance* r, int sets, const double* weight,
                               int* correct) {
    batch b = {r, weight, calloc((size_t)(sets * r->folds), sizeof *b.correct)};
    if (!b.correct)
        return BT_ERR_MEMORY;
    const bt_status status = bt_tasks_run(r->threads, sets * r->folds, run_trial, &b);
    for (int i = 0; i < sets; ++i) {
        correct[i] = 0;
        for (int fold = 0; fold < r->folds; ++fold)
            correct[i] += b.correct[i * r->folds + fold];
    }
    free(b.correct);
    return status;
}

/// Half a standard error of a number of right answers.
static double half_error(int correct, int count) {
    const double right = (double)correct / count;
    return 0.5 * sqrt(right * (1 - right) * count);
}

/// Tries the steps of one input and takes the best that gains enough.
static bt_status move_input(const bt_relevance* r, int input, double* weight, double* sets,
                            int* correct, bool* moved) {
    const size_t dims = (size_t)r->dims;
    int count = 0, scores[STEPS] = {0};
    for (int i = 0; i < STEPS; ++i) {
        const double value = weight[input] * step[i];
        if (value < weight_least || value > weight_greatest)
            continue;
        double* set = sets + (size_t)count++ * dims;
        memcpy(set, weight, dims * sizeof *set);
        set[input] = value;
    }
    BT_TRY(count_correct(r, count, sets, scores));
    int best = 0;
    for (int i = 1; i < count; ++i)
        if (scores[i] > scores[best])
            best = i;
    *moved = scores[best] > *correct && scores[best] >= *correct + half_error(*correct, r->count);
    if (*moved) {
        weight[input] = sets[(size_t)best * dims + (size_t)input];
        *correct = scores[best];
    }
    return BT_OK;
}

static bt_status search(const bt_relevance* r, double* weight, double* sets) {
    int correct, still = 0;
    BT_TRY(count_correct(r, 1, weight, &correct));
    for (int i = 0; i < TURNS * r->dims && still < r->dims; ++i) {
        bool moved = false;
        if (r->varies[i % r->dims])
            BT_TRY(move_input(r, i % r->dims, weight, sets, &correct, &moved));
        still = moved ? 0 : still + 1;
    }
    return BT_OK;
}

bt_status bt_relevance_search(const bt_relevance* relevance, double* weight) {
    int varying = 0;
    for (int k = 0; k < relevance->dims; ++k) {
        weight[k] = 1;
        varying += relevance->varies[k];
    }
    if (varying < 2)
        return BT_OK;
    double* sets = malloc(STEPS * (size_t)relevance->dims * sizeof *sets);
    if (!sets)
        return BT_ERR_MEMORY;
    const bt_status status = search(relevance, weight, sets);
    free(sets);
    return status;
}
