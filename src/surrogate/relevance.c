#include "surrogate/relevance.h"

#include "base/threads.h"

#include <math.h>
#include <stdlib.h>

// Weights are kept as whole powers of sqrt 2, so that there and back is the same weight.
enum { STRIDES = 2, MOVES = 12, POWER_MAX = 8 };
static const int stride[STRIDES] = {2, 1};
static const double least_gain = 0.01;

/// A search: where it stands, and the neighbours that it looks at.
typedef struct search {
    const bt_relevance* relevance;
    int* power;     ///< [dims] of sqrt 2
    double loss;    ///< there
    double* weight; ///< [2 * dims * dims] of each neighbour
    int* moved;     ///< [2 * dims] which input it differs in
    int* to;        ///< [2 * dims] that input's power
    double* losses; ///< [2 * dims * folds]
    int back, from; ///< the input moved last and its power before: known to be worse
} search;

static bt_status run_trial(void* user, int task, int worker) {
    (void)worker;
    const search* s = user;
    const bt_relevance* r = s->relevance;
    const double* weight = s->weight + (size_t)(task / r->folds) * (size_t)r->dims;
    return r->trial(r->user, weight, task % r->folds, &s->losses[task]);
}

static double weight_of(int power) {
    return (power % 2 ? M_SQRT2 : 1) * exp2(floor(0.5 * power));
}

/// Losses of `sets` sets of weights, all folds together, into the first of each set's.
static bt_status measure(search* s, int sets) {
    const int folds = s->relevance->folds;
    BT_TRY(bt_tasks_run(s->relevance->threads, sets * folds, run_trial, s));
    for (int i = 0; i < sets; ++i) {
        double sum = 0;
        for (int fold = 0; fold < folds; ++fold)
            sum += s->losses[i * folds + fold];
        s->losses[i * folds] = sum;
    }
    return BT_OK;
}

static void write_weights(const search* s, double* weight) {
    for (int k = 0; k < s->relevance->dims; ++k)
        weight[k] = weight_of(s->power[k]);
}

/// Lists the neighbours at a stride; returns how many.
static int list_neighbours(search* s, int length) {
    const int dims = s->relevance->dims;
    int count = 0;
    for (int task = 0; task < 2 * dims; ++task) {
        const int k = task / 2, power = s->power[k] + (task % 2 ? -length : length);
        if (!s->relevance->varies[k] || abs(power) > POWER_MAX ||
            (k == s->back && power == s->from))
            continue;
        double* weight = s->weight + (size_t)count * (size_t)dims;
        write_weights(s, weight);
        weight[k] = weight_of(power);
        s->moved[count] = k;
        s->to[count++] = power;
    }
    return count;
}

/// Goes to the best neighbour, if that gains enough.
static bt_status move(search* s, int length, bool* moved) {
    const int count = list_neighbours(s, length), folds = s->relevance->folds;
    BT_TRY(measure(s, count));
    int best = 0;
    for (int i = 1; i < count; ++i)
        if (s->losses[i * folds] < s->losses[best * folds])
            best = i;
    *moved = count > 0 && s->losses[best * folds] < (1 - least_gain) * s->loss;
    if (*moved) {
        s->back = s->moved[best];
        s->from = s->power[s->back];
        s->power[s->back] = s->to[best];
        s->loss = s->losses[best * folds];
    }
    return BT_OK;
}

static bt_status descend(search* s) {
    write_weights(s, s->weight);
    BT_TRY(measure(s, 1));
    s->loss = s->losses[0];
    for (int i = 0; i < STRIDES; ++i) {
        bool moved = true;
        for (int moves = 0; moves < MOVES && moved; ++moves)
            BT_TRY(move(s, stride[i], &moved));
    }
    return BT_OK;
}

bt_status bt_relevance_search(const bt_relevance* relevance, double* weight) {
    const size_t dims = (size_t)relevance->dims, sets = 2 * dims;
    int varying = 0;
    for (size_t k = 0; k < dims; ++k) {
        weight[k] = 1;
        varying += relevance->varies[k];
    }
    if (varying < 2)
        return BT_OK;
    search s = {.relevance = relevance, .back = -1};
    s.power = calloc(dims, sizeof *s.power);
    s.weight = malloc(sets * dims * sizeof *s.weight);
    s.moved = malloc(sets * sizeof *s.moved);
    s.to = malloc(sets * sizeof *s.to);
    s.losses = malloc(sets * (size_t)relevance->folds * sizeof *s.losses);
    bt_status status = BT_ERR_MEMORY;
    if (s.power && s.weight && s.moved && s.to && s.losses)
        status = descend(&s);
    if (status == BT_OK)
        write_weights(&s, weight);
    free(s.power);
    free(s.weight);
    free(s.moved);
    free(s.to);
    free(s.losses);
    return status;
}
