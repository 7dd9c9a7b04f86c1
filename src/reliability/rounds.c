#include "reliability/rounds.h"

#include "base/rng.h"
#include "base/threads.h"
#include "surrogate/predictor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    FIRST = 128, ///< landings of the first round
    CANDIDATES = 65536,
    BATCH = 1024, ///< points predicted together
    VARIABLE_COMPONENT = 0x40000,
    VARIABLE_CANDIDATE = 0x50000,
    VARIABLE_START = 0x60000,
};

int64_t bt_round_end(int64_t run) {
    int64_t power = FIRST;
    while (2 * power <= run)
        power *= 2;
    return run < power ? power : run < power + power / 2 ? power + power / 2 : 2 * power;
}

int bt_round_first(int n) {
    int64_t first = FIRST;
    while (bt_round_end(first) <= n / 8)
        first = bt_round_end(first);
    return (int)first;
}

/* ---- the classifiers ---- */

static int extended_dims(const bt_rounds* r, int dims) {
    return dims + (r->features ? r->features->count : 0);
}

static void extend(const bt_rounds* r, const double* x, int dims, double* extended) {
    if (r->features)
        bt_features_extend(r->features, x, 1, extended);
    else
        memcpy(extended, x, (size_t)dims * sizeof *extended);
}

/// The landings before `begin` that have an outcome, as a training set (x and label to be freed).
static bt_status gather(const bt_rounds* r, const bt_evidence* e, int begin, bt_training_set* set,
                        double** x, int** label) {
    const int dims = extended_dims(r, e->dims);
    *x = malloc(((size_t)begin * (size_t)dims + 1) * sizeof **x);
    *label = malloc(((size_t)begin + 1) * sizeof **label);
    if (!*x || !*label)
        return BT_ERR_MEMORY;
    int n = 0;
    for (int i = 0; i < begin; ++i) {
        if (e->label[i] < 0)
            continue;
        extend(r, e->x + (size_t)i * (size_t)e->dims, e->dims, *x + (size_t)n * (size_t)dims);
        (*label)[n++] = e->label[i] ? 1 : -1;
    }
    *set = (bt_training_set){dims, n, *x, *label};
    return BT_OK;
}

/// What is taken when no landing has an outcome to select on.
static bt_hyperparameters unselected(int dims) {
    bt_hyperparameters chosen = {.C = 1, .gamma = 0.1};
    for (int k = 0; k < dims; ++k)
        chosen.weight[k] = 1;
    return chosen;
}

/// A classifier that calls everything engaged.
static bt_surrogate constant_of(int dims) {
    bt_surrogate s = {.dims = dims, .constant = true, .C = 1, .gamma = 0.1, .rho = -1};
    for (int k = 0; k < dims; ++k)
        s.scale[k] = s.weight[k] = 1;
    return s;
}

static bt_status select_before(bt_rounds* r, const bt_evidence* e, int begin, bt_diag* diag) {
    int power = FIRST;
    while (4 * power <= begin)
        power *= 4;
    if (!r->params || r->selected_at == power)
        return BT_OK;
    bt_training_set set;
    double* x = NULL;
    int* label = NULL;
    bt_status status = gather(r, e, power, &set, &x, &label);
    if (status == BT_OK && set.count == 0)
        r->chosen = unselected(set.dims);
    else if (status == BT_OK)
        status =
            bt_surrogate_select(&set, r->params, 0, r->seed, r->threads, &r->chosen, NULL, diag);
    r->selected_at = status == BT_OK ? power : 0;
    free(x);
    free(label);
    return status;
}

bt_status bt_rounds_classifier(bt_rounds* r, const bt_evidence* e, int begin, bt_surrogate* out,
                               bt_diag* diag) {
    *out = (bt_surrogate){0};
    BT_TRY(select_before(r, e, begin, diag));
    bt_training_set set;
    double* x = NULL;
    int* label = NULL;
    bt_status status = gather(r, e, begin, &set, &x, &label);
    if (status == BT_OK && set.count == 0)
        *out = constant_of(set.dims);
    else if (status == BT_OK)
        status = bt_surrogate_fit(&set, &r->chosen, 0, r->seed, out, NULL);
    free(x);
    free(label);
    return status;
}

static void predict(const bt_rounds* r, const bt_predictor* predictor, const double* x, int dims,
                    int n, int8_t* label, float* decision) {
    double extended[BATCH * BT_INPUT_MAX];
    const size_t wide = (size_t)extended_dims(r, dims);
    for (int i = 0; i < n; ++i)
        extend(r, x + (size_t)i * (size_t)dims, dims, extended + (size_t)i * wide);
    bt_predictor_label(predictor, extended, n, label, decision);
}

bt_status bt_rounds_predict(const bt_rounds* r, const bt_surrogate* classifier, const double* x,
                            int n, int8_t* engaged, float* decision) {
    const int dims = classifier->dims - (r->features ? r->features->count : 0);
    bt_predictor* predictor;
    BT_TRY(bt_predictor_create(classifier, bt_isa_best(), &predictor));
    for (int at = 0; at < n; at += BATCH) {
        const int count = n - at < BATCH ? n - at : BATCH;
        predict(r, predictor, x + (size_t)at * (size_t)dims, dims, count,
                engaged ? engaged + at : NULL, decision ? decision + at : NULL);
    }
    for (int i = 0; engaged && i < n; ++i)
        engaged[i] = engaged[i] > 0;
    bt_predictor_destroy(predictor);
    return BT_OK;
}

/* ---- the points ---- */

typedef struct drawing {
    const bt_rounds* rounds;
    const bt_mixture* mixture;
    const bt_predictor* predictor;
    int begin;
    int candidates;
    double* x;     ///< [candidates * dims]
    float* margin; ///< [candidates] decision values
    double* need;  ///< [candidates] see need_of
} drawing;

/// Point i of the mixture, keyed by (seed, i + offset, kind).
static void draw_point(const drawing* d, uint64_t run, uint32_t kind, double* x) {
    double u[BT_INPUT_MAX];
    const uint64_t seed = d->rounds->seed;
    const int component =
        bt_mixture_pick(d->mixture, bt_rng_uniform(seed, run, VARIABLE_COMPONENT + kind));
    for (int k = 0; k < d->mixture->dims; ++k)
        u[k] = bt_rng_uniform(seed, run, kind + (uint32_t)k);
    bt_mixture_point(d->mixture, component, u, x);
}

/// What an error at a point costs all conditions together: the root of sum_c (p_c / q)^2, by which
/// its share in the variances goes. At least 1 / sqrt(components), at most the sum of the 1 /
/// share.
static double need_of(const bt_mixture* m, const double* x) {
    double log_p[BT_COMPONENT_MAX], sum = 0;
    const double log_q = bt_mixture_log_density(m, x, log_p);
    for (int c = 0; c < m->components; ++c)
        sum += exp(2 * (log_p[c] - log_q));
    return sqrt(sum);
}

static bt_status draw_candidates(void* user, int task, int worker) {
    (void)worker;
    const drawing* d = user;
    const int dims = d->mixture->dims;
    int8_t label[BATCH];
    const int begin = task * BATCH,
              n = d->candidates - begin < BATCH ? d->candidates - begin : BATCH;
    for (int i = begin; i < begin + n; ++i) {
        double* x = d->x + (size_t)i * (size_t)dims;
        draw_point(d, (uint64_t)d->begin << 32 | (uint64_t)i, VARIABLE_CANDIDATE, x);
        d->need[i] = need_of(d->mixture, x);
    }
    predict(d->rounds, d->predictor, d->x + (size_t)begin * (size_t)dims, dims, n, label,
            d->margin + begin);
    return BT_OK;
}

static int compare_floats(const void* a, const void* b) {
    const float x = *(const float*)a, y = *(const float*)b;
    return (x > y) - (x < y);
}

/// The |f| within which the share of the candidates lies.
static bt_status width_of(const drawing* d, double share, double* width) {
    float* sorted = malloc((size_t)d->candidates * sizeof *sorted);
    if (!sorted)
        return BT_ERR_MEMORY;
    for (int i = 0; i < d->candidates; ++i)
        sorted[i] = fabsf(d->margin[i]);
    qsort(sorted, (size_t)d->candidates, sizeof *sorted, compare_floats);
    *width = sorted[(int)(share * (d->candidates - 1))];
    free(sorted);
    return BT_OK;
}

static double unsureness(double f, double width) {
    const double t = f / width, square = t * t;
    return 1 / (1 + square * square);
}

/// The errors that cross-validation found, on the landings of the last selection.
static double expected_error(const bt_hyperparameters* chosen) {
    return (chosen->cv_count - chosen->cv_correct + 0.5) / (chosen->cv_count + 1.0);
}

/// How much a landing at candidate i is worth.
static double wish(const drawing* d, int i, double width) {
    return unsureness((double)d->margin[i], width) * d->need[i];
}

/// Picks m candidates with probabilities in proportion to that, by equal steps through their
/// running sum from a keyed start.
static void pick(const drawing* d, double width, double sum, int m, int* picked) {
    const double step = sum / m;
    double next = step * bt_rng_uniform(d->rounds->seed, (uint64_t)d->begin, VARIABLE_START);
    double running = 0;
    int count = 0;
    for (int i = 0; i < d->candidates && count < m; ++i) {
        running += wish(d, i, width);
        while (count < m && running > next) {
            picked[count++] = i;
            next += step;
        }
    }
    while (count < m) // rounding of the running sum
        picked[count++] = d->candidates - 1;
}

static bt_status fill(const drawing* d, int n, double unsure, double* x, double* log_density) {
    const size_t dims = (size_t)d->mixture->dims;
    double width, sum = 0;
    const double error = expected_error(&d->rounds->chosen);
    BT_TRY(width_of(d, fmin(0.25, fmax(0.02, 2 * error)), &width));
    for (int i = 0; i < d->candidates; ++i)
        sum += wish(d, i, width);
    const int m = (int)floor(unsure * n);
    int* picked = malloc(((size_t)m + 1) * sizeof *picked);
    if (!picked)
        return BT_ERR_MEMORY;
    pick(d, width, sum, m, picked);
    int taken = 0;
    for (int i = 0; i < n; ++i) {
        double* point = x + (size_t)i * dims;
        int8_t label;
        float f;
        // The unsure ones are spread evenly among the others.
        if (taken < m && (int64_t)(i + 1) * m >= (int64_t)(taken + 1) * n)
            memcpy(point, d->x + (size_t)picked[taken++] * dims, dims * sizeof *point);
        else
            draw_point(d, (uint64_t)(d->begin + i), 0, point);
        predict(d->rounds, d->predictor, point, (int)dims, 1, &label, &f);
        const double share = (double)m / n;
        log_density[i] = bt_mixture_log_density(d->mixture, point, NULL) +
                         log1p(share * (unsureness((double)f, width) * need_of(d->mixture, point) *
                                            d->candidates / sum -
                                        1));
    }
    free(picked);
    return BT_OK;
}

bt_status bt_rounds_draw(const bt_rounds* rounds, const bt_mixture* mixture,
                         const bt_surrogate* classifier, int begin, int n, double unsure, double* x,
                         double* log_density) {
    bt_predictor* predictor;
    BT_TRY(bt_predictor_create(classifier, bt_isa_best(), &predictor));
    drawing d = {.rounds = rounds,
                 .mixture = mixture,
                 .predictor = predictor,
                 .begin = begin,
                 .candidates = rounds->candidates > 0 ? rounds->candidates : CANDIDATES};
    d.x = malloc((size_t)d.candidates * (size_t)mixture->dims * sizeof *d.x);
    d.margin = malloc((size_t)d.candidates * sizeof *d.margin);
    d.need = malloc((size_t)d.candidates * sizeof *d.need);
    bt_status status = BT_ERR_MEMORY;
    if (d.x && d.margin && d.need)
        status =
            bt_tasks_run(rounds->threads, (d.candidates + BATCH - 1) / BATCH, draw_candidates, &d);
    if (status == BT_OK)
        status = fill(&d, n, classifier->constant ? 0 : unsure, x, log_density);
    free(d.x);
    free(d.margin);
    free(d.need);
    bt_predictor_destroy(predictor);
    return status;
}
