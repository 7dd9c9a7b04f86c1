#include "surrogate/training.h"

#include "base/rng.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Stream of the keyed random numbers that the split draws from, apart from a run's own variables.
enum { STREAM_HOLDOUT = 0x53500001u };

/* ---- the split ---- */

typedef struct keyed {
    uint64_t key;
    int index;
} keyed;

static int compare_keyed(const void* a, const void* b) {
    const keyed *x = a, *y = b;
    if (x->key != y->key)
        return x->key < y->key ? -1 : 1;
    return (x->index > y->index) - (x->index < y->index);
}

/// Shuffles each class by key; its first landings are held out, the others learnt from.
static bt_status split(bt_training* t, double holdout, uint64_t seed) {
    const bt_training_set* set = t->set;
    keyed* draw = malloc((size_t)set->count * sizeof *draw);
    if (!draw)
        return BT_ERR_MEMORY;
    int listed = 0;
    for (int class = 0; class < 2; ++class) {
        int n = 0;
        for (int i = 0; i < set->count; ++i)
            if ((set->label[i] > 0) == (class == 0))
                draw[n++] = (keyed){bt_rng_bits(seed, (uint64_t)i, STREAM_HOLDOUT), i};
        qsort(draw, (size_t)n, sizeof *draw, compare_keyed);
        int held = (int)floor(holdout * n + 0.5);
        if (held >= n)
            held = n > 0 ? n - 1 : 0;
        for (int i = 0; i < n; ++i) {
            if (i < held)
                t->holdout[t->holdout_count++] = draw[i].index;
            else
                t->list[listed++] = draw[i].index;
        }
        t->train[class] = n - held;
    }
    free(draw);
    return BT_OK;
}

/* ---- standardisation ---- */

/// Centre, scale and box of the training landings.
static void measure(bt_training* t) {
    const bt_training_set* set = t->set;
    const int n = t->train[0] + t->train[1], dims = t->dims;
    for (int k = 0; k < dims; ++k) {
        double sum = 0, square = 0, least = INFINITY, greatest = -INFINITY;
        for (int i = 0; i < n; ++i) {
            const double x = set->x[(size_t)t->list[i] * (size_t)dims + (size_t)k];
            sum += x;
            least = fmin(least, x);
            greatest = fmax(greatest, x);
        }
        const double centre = sum / n;
        for (int i = 0; i < n; ++i) {
            const double x = set->x[(size_t)t->list[i] * (size_t)dims + (size_t)k] - centre;
            square += x * x;
        }
        const double deviation = sqrt(square / n);
        t->centre[k] = centre;
        // An input that never varied says nothing; it must not be blown up.
        t->scale[k] = greatest > least && deviation > 0 ? deviation : 1;
        t->least[k] = least;
        t->greatest[k] = greatest;
    }
}

/// z of every landing.
static void standardise(bt_training* t) {
    const bt_training_set* set = t->set;
    const int dims = t->dims;
    for (int i = 0; i < set->count; ++i) {
        struct svm_node* node = t->nodes + (size_t)i * (size_t)(dims + 1);
        for (int k = 0; k < dims; ++k) {
            const size_t at = (size_t)i * (size_t)dims + (size_t)k;
            t->z[at] = (set->x[at] - t->centre[k]) / t->scale[k];
            node[k] = (struct svm_node){k + 1, t->z[at]};
        }
        node[dims].index = -1;
    }
}

void bt_training_weigh(bt_training* t, const double* weight) {
    for (int k = 0; k < t->dims; ++k)
        t->scale[k] /= weight[k];
    standardise(t);
}

/* ---- creation ---- */

static bt_status check_set(const bt_training_set* set, bt_diag* diag) {
    if (set->count < 1) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "no landings to train on");
        return BT_ERR_ARG;
    }
    if (set->dims < 1 || set->dims > BT_INPUT_MAX) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%d inputs; a surrogate takes 1 .. %d", set->dims,
                    BT_INPUT_MAX);
        return BT_ERR_ARG;
    }
    for (int i = 0; i < set->count; ++i) {
        bool sound = set->label[i] == 1 || set->label[i] == -1;
        for (int k = 0; k < set->dims; ++k)
            sound = sound && isfinite(set->x[(size_t)i * (size_t)set->dims + (size_t)k]);
        if (!sound) {
            bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                        "training landing %d: an input is not finite, or its label is neither +1 "
                        "nor -1",
                        i);
            return BT_ERR_ARG;
        }
    }
    return BT_OK;
}

bt_status bt_training_create(const bt_training_set* set, double holdout, uint64_t seed,
                             bt_training* t, bt_diag* diag) {
    *t = (bt_training){.set = set, .dims = set->dims};
    BT_TRY(check_set(set, diag));
    const size_t n = (size_t)set->count, dims = (size_t)set->dims;
    t->nodes = malloc(n * (dims + 1) * sizeof *t->nodes);
    t->z = malloc(n * dims * sizeof *t->z);
    t->list = malloc(n * sizeof *t->list);
    t->holdout = malloc(n * sizeof *t->holdout);
    if (!t->nodes || !t->z || !t->list || !t->holdout)
        return BT_ERR_MEMORY;
    BT_TRY(split(t, holdout, seed));
    measure(t);
    standardise(t);
    return BT_OK;
}

void bt_training_destroy(bt_training* t) {
    free(t->nodes);
    free(t->z);
    free(t->list);
    free(t->holdout);
    *t = (bt_training){0};
}

/* ---- one support-vector classifier ---- */

// LIBSVM gives up after 10^7 iterations (and says so where nobody should print).
static const double libsvm_iterations = 1e7;

// How many iterations this thread's last training took. LIBSVM tells it in its messages only, and
// their receiver is given nothing but the text.
static _Thread_local long iterations;

static void listen(const char* text) {
    const char* count = strstr(text, "#iter = ");
    if (count)
        iterations = strtol(count + strlen("#iter = "), NULL, 10);
}

/// Copies what LIBSVM found. Landings of class +1 come first in every problem, so that its first
/// label is +1 and its decision value needs no change of sign.
static bt_status take_model(const struct svm_model* model, int dims, bt_surrogate* out) {
    out->rho = model->rho[0];
    out->sv_count = model->l;
    out->sv = malloc(((size_t)model->l * (size_t)dims + 1) * sizeof *out->sv);
    out->coef = malloc(((size_t)model->l + 1) * sizeof *out->coef);
    if (!out->sv || !out->coef)
        return BT_ERR_MEMORY;
    for (int i = 0; i < model->l; ++i) {
        out->coef[i] = model->sv_coef[0][i];
        for (int k = 0; k < dims; ++k)
            out->sv[i * dims + k] = model->SV[i][k].value;
    }
    return BT_OK;
}

static bt_status solve(const bt_training* t, const int* list, int n, double tolerance,
                       bt_surrogate* out) {
    struct svm_parameter param = {.svm_type = C_SVC,
                                  .kernel_type = RBF,
                                  .gamma = out->gamma,
                                  .C = out->C,
                                  .cache_size = 200,
                                  .eps = tolerance,
                                  .shrinking = 1};
    struct svm_problem problem = {.l = n};
    problem.y = malloc((size_t)n * sizeof *problem.y);
    problem.x = malloc((size_t)n * sizeof *problem.x);
    bt_status status = BT_ERR_MEMORY;
    if (problem.y && problem.x) {
        for (int i = 0; i < n; ++i) {
            problem.y[i] = t->set->label[list[i]];
            problem.x[i] = t->nodes + (size_t)list[i] * (size_t)(t->dims + 1);
        }
        struct svm_model* model = svm_train(&problem, &param);
        status = take_model(model, t->dims, out);
        svm_free_and_destroy_model(&model);
    }
    free(problem.y);
    free(problem.x);
    return status;
}

bt_status bt_svm_train(const bt_training* t, const int* list, int n, double C, double gamma,
                       double tolerance, bt_surrogate* out, bt_svm_effort* effort) {
    *out = (bt_surrogate){.dims = t->dims, .C = C, .gamma = gamma};
    *effort = (bt_svm_effort){0};
    int engaged = 0;
    for (int i = 0; i < n; ++i)
        engaged += t->set->label[list[i]] > 0;
    for (int k = 0; k < t->dims; ++k)
        out->scale[k] = out->weight[k] = 1;
    out->constant = engaged == 0 || engaged == n;
    if (out->constant) {
        out->rho = engaged ? -1 : 1;
        return BT_OK;
    }
    iterations = 0;
    svm_set_print_string_function(listen);
    const bt_status status = solve(t, list, n, tolerance, out);
    effort->iterations = iterations;
    effort->gave_up = (double)iterations >= fmax(libsvm_iterations, 100.0 * n);
    if (status != BT_OK)
        bt_surrogate_destroy(out);
    return status;
}
