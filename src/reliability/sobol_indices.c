#include "reliability/sobol_indices.h"

#include "base/rng.h"
#include "base/threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BATCH = 512, STREAM_BOOTSTRAP = 0x53420000u };

/// Values of f: column 0 at A, 1 at B, 2 + k at A_k; taken from their mean.
typedef struct work {
    const bt_sampler* a;
    bt_sampler b;
    bt_function* f;
    void* user;
    int samples, dims, bootstrap;
    double* value; ///< [(dims + 2) * samples]
    double* drawn; ///< [bootstrap * 2 dims] indices of each resample
} work;

static double* column(const work* w, int c) {
    return w->value + (size_t)c * (size_t)w->samples;
}

static bt_status evaluate(void* user, int task, int worker) {
    (void)worker;
    work* w = user;
    const int first = task * BATCH, dims = w->dims;
    const int n = w->samples - first < BATCH ? w->samples - first : BATCH;
    const size_t size = (size_t)n * (size_t)dims;
    double* x = malloc(3 * size * sizeof *x);
    if (!x)
        return BT_ERR_MEMORY;
    double *a = x, *b = x + size, *mixed = x + 2 * size;
    bt_sampler_draw(w->a, (uint64_t)first, n, a);
    bt_sampler_draw(&w->b, (uint64_t)first, n, b);
    w->f(w->user, a, n, column(w, 0) + first);
    w->f(w->user, b, n, column(w, 1) + first);
    for (int k = 0; k < dims; ++k) {
        memcpy(mixed, a, size * sizeof *mixed);
        for (int i = 0; i < n; ++i)
            mixed[i * dims + k] = b[i * dims + k];
        w->f(w->user, mixed, n, column(w, 2 + k) + first);
    }
    free(x);
    return BT_OK;
}

/// Variance over A and B; then S_k into index[k] and ST_k into index[dims + k]. With a resample
/// number the rows are drawn with replacement by key; -1 takes each row once. Returns the variance.
static double estimate(const work* w, int resample, double* index) {
    const int n = w->samples;
    const double *fa = column(w, 0), *fb = column(w, 1);
    double sum = 0, square = 0, product[BT_INPUT_MAX] = {0}, apart[BT_INPUT_MAX] = {0};
    for (int i = 0; i < n; ++i) {
        int row = i;
        if (resample >= 0) {
            row = (int)(n * bt_rng_uniform(w->a->seed, (uint64_t)i,
                                           STREAM_BOOTSTRAP + (uint32_t)resample));
            row = row < n ? row : n - 1;
        }
        const double a = fa[row], b = fb[row];
        sum += a + b;
        square += a * a + b * b;
        for (int k = 0; k < w->dims; ++k) {
            const double mixed = column(w, 2 + k)[row];
            product[k] += b * (mixed - a);
            apart[k] += (a - mixed) * (a - mixed);
        }
    }
    const double mean = sum / (2.0 * n), variance = square / (2.0 * n) - mean * mean;
    for (int k = 0; k < w->dims; ++k) {
        index[k] = product[k] / n / variance;
        index[w->dims + k] = apart[k] / (2.0 * n) / variance;
    }
    return variance;
}

static bt_status resample(void* user, int task, int worker) {
    (void)worker;
    work* w = user;
    estimate(w, task, w->drawn + (size_t)task * 2 * (size_t)w->dims);
    return BT_OK;
}

static int compare_doubles(const void* a, const void* b) {
    const double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

/// 2.5 % and 97.5 % of the resampled values of one index; resamples in which f did not vary are
/// left out.
static bt_interval percentiles(const work* w, int which, double* sorted) {
    int n = 0;
    for (int i = 0; i < w->bootstrap; ++i) {
        const double value = w->drawn[(size_t)i * 2 * (size_t)w->dims + (size_t)which];
        if (isfinite(value))
            sorted[n++] = value;
    }
    if (n == 0)
        return (bt_interval){NAN, NAN};
    qsort(sorted, (size_t)n, sizeof *sorted, compare_doubles);
    return (bt_interval){sorted[(int)(0.025 * (n - 1))], sorted[(int)ceil(0.975 * (n - 1))]};
}

/// Takes the mean of A and B from every value.
static double centre(const work* w) {
    double sum = 0;
    for (int i = 0; i < 2 * w->samples; ++i)
        sum += w->value[i];
    const double mean = sum / (2.0 * w->samples);
    for (size_t i = 0; i < (size_t)(w->dims + 2) * (size_t)w->samples; ++i)
        w->value[i] -= mean;
    return mean;
}

static bt_status compute_indices(work* w, int threads, double* sorted, bt_sobol_result* r) {
    double index[2 * BT_INPUT_MAX];
    BT_TRY(bt_tasks_run(threads, (w->samples + BATCH - 1) / BATCH, evaluate, w));
    r->mean = centre(w);
    r->variance = estimate(w, -1, index);
    const bool varies = r->variance > 0;
    if (varies)
        BT_TRY(bt_tasks_run(threads, w->bootstrap, resample, w));
    const bt_interval unknown = {NAN, NAN};
    for (int k = 0; k < w->dims; ++k) {
        r->first[k] = (bt_index){varies ? index[k] : NAN, unknown};
        r->total[k] = (bt_index){varies ? index[w->dims + k] : NAN, unknown};
        if (varies && w->bootstrap > 0) {
            r->first[k].ci95 = percentiles(w, k, sorted);
            r->total[k].ci95 = percentiles(w, w->dims + k, sorted);
        }
    }
    return varies ? BT_OK : BT_ERR_NUMERIC;
}

bt_status bt_sobol_indices(const bt_sampler* sampler, bt_function* f, void* user, int samples,
                           int bootstrap, int threads, bt_sobol_result* result) {
    const int dims = sampler->dims;
    *result = (bt_sobol_result){.dims = dims, .evaluations = (int64_t)samples * (dims + 2)};
    if (samples < 16 || samples > 10000000 || bootstrap < 0 || bootstrap > 10000 || dims < 1 ||
        dims > BT_INPUT_MAX)
        return BT_ERR_ARG;
    work w = {.a = sampler,
              .b = *sampler,
              .f = f,
              .user = user,
              .samples = samples,
              .dims = dims,
              .bootstrap = bootstrap};
    // The sampler's streams lie below 2^23; B has its own half.
    w.b.stream |= 1u << 23;
    w.value = malloc((size_t)(dims + 2) * (size_t)samples * sizeof *w.value);
    w.drawn = malloc(((size_t)bootstrap * 2 * (size_t)dims + 1) * sizeof *w.drawn);
    double* sorted = malloc(((size_t)bootstrap + 1) * sizeof *sorted);
    bt_status status = BT_ERR_MEMORY;
    if (w.value && w.drawn && sorted)
        status = compute_indices(&w, threads, sorted, result);
    free(w.value);
    free(w.drawn);
    free(sorted);
    return status;
}

void bt_engaged(void* classifier, const double* x, int n, double* f) {
    const bt_classifier* c = classifier;
    int8_t label[BATCH];
    float decision[BATCH];
    for (int at = 0; at < n; at += BATCH) {
        const int count = n - at < BATCH ? n - at : BATCH;
        c->classify(c->user, x + (size_t)at * (size_t)c->dims, count, label, decision);
        for (int i = 0; i < count; ++i)
            f[at + i] = label[i] > 0;
    }
}
