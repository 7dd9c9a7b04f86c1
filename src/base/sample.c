#include "base/sample.h"

#include "base/families.h"
#include "base/hash.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS_MAX = 1 << 16 };
static const double points_per_bandwidth = 5, reach_bandwidths = 5;

struct bt_sample {
    int count;      ///< different values
    double* value;  ///< [count] ascending
    double* weight; ///< [count] as given, those of equal values added
    double sum;     ///< of the weights
    double* up_to;  ///< [count] probability up to and with each
    double mean, bandwidth;
    int points; ///< smooth: density and probability at begin + i step
    double begin, step;
    double *density, *below;
};

typedef struct weighted {
    double value, weight;
} weighted;

static int by_value(const void* a, const void* b) {
    const double x = ((const weighted*)a)->value, y = ((const weighted*)b)->value;
    return (x > y) - (x < y);
}

/// Sorted, equal values one. The sums run over what is then there, so that it reads back to the
/// same bits.
static bt_status gather(bt_sample* s, const double* value, const double* weight, int count) {
    weighted* rows = malloc((size_t)count * sizeof *rows);
    s->value = calloc((size_t)count, sizeof *s->value);
    s->weight = calloc((size_t)count, sizeof *s->weight);
    s->up_to = calloc((size_t)count, sizeof *s->up_to);
    if (!rows || !s->value || !s->weight || !s->up_to) {
        free(rows);
        return BT_ERR_MEMORY;
    }
    double running = 0;
    for (int i = 0; i < count; ++i)
        rows[i] = (weighted){value[i], weight ? weight[i] : 1};
    qsort(rows, (size_t)count, sizeof *rows, by_value);
    for (int i = 0; i < count; ++i) {
        if (s->count == 0 || rows[i].value != s->value[s->count - 1])
            s->value[s->count++] = rows[i].value;
        s->weight[s->count - 1] += rows[i].weight;
    }
    for (int i = 0; i < s->count; ++i)
        s->sum += s->weight[i];
    for (int i = 0; i < s->count; ++i) {
        running += s->weight[i];
        s->up_to[i] = running / s->sum;
        s->mean += s->weight[i] / s->sum * s->value[i];
    }
    s->up_to[s->count - 1] = 1;
    free(rows);
    return BT_OK;
}

/// Kernels at the points, brought to an integral of 1 over the straight pieces between them.
static bt_status smooth(bt_sample* s) {
    const double h = s->bandwidth;
    const double reach = reach_bandwidths * h,
                 width = s->value[s->count - 1] - s->value[0] + 2 * reach;
    const double wanted = ceil(width / h * points_per_bandwidth);
    if (!(wanted < POINTS_MAX))
        return BT_ERR_ARG;
    s->points = (int)wanted + 1;
    s->begin = s->value[0] - reach;
    s->step = width / (s->points - 1);
    s->density = calloc((size_t)s->points, sizeof *s->density);
    s->below = calloc((size_t)s->points, sizeof *s->below);
    if (!s->density || !s->below)
        return BT_ERR_MEMORY;
    for (int i = 0; i < s->points; ++i)
        for (int k = 0; k < s->count; ++k) {
            const double t = (s->begin + i * s->step - s->value[k]) / h;
            s->density[i] += fabs(t) < reach_bandwidths ? s->weight[k] * exp(-0.5 * t * t) : 0;
        }
    for (int i = 1; i < s->points; ++i)
        s->below[i] = s->below[i - 1] + 0.5 * s->step * (s->density[i - 1] + s->density[i]);
    const double all = s->below[s->points - 1];
    s->mean = 0;
    for (int i = 0; i < s->points; ++i) {
        s->density[i] /= all;
        s->below[i] /= all;
        if (i == 0)
            continue;
        const double x = s->begin + (i - 1) * s->step, f = s->density[i - 1], g = s->density[i];
        s->mean += s->step * (x * (f + g) / 2 + s->step * (f + 2 * g) / 6);
    }
    s->below[s->points - 1] = 1;
    return BT_OK;
}

bt_status bt_sample_create(const double* value, const double* weight, int count, double bandwidth,
                           bt_sample** made) {
    *made = NULL;
    if (count < 1 || count > BT_SAMPLE_MAX)
        return BT_ERR_ARG;
    bt_sample* s = calloc(1, sizeof *s);
    if (!s)
        return BT_ERR_MEMORY;
    s->bandwidth = bandwidth;
    bt_status status = gather(s, value, weight, count);
    if (status == BT_OK && bandwidth > 0)
        status = smooth(s);
    if (status == BT_OK)
        *made = s;
    else
        bt_sample_destroy(s);
    return status;
}

void bt_sample_destroy(const bt_sample* sample) {
    if (!sample)
        return;
    free(sample->value);
    free(sample->weight);
    free(sample->up_to);
    free(sample->density);
    free(sample->below);
    free((void*)sample);
}

static int compare_doubles(const void* a, const void* b) {
    const double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

/// The sample's quantile, straight between its order statistics.
static double order_quantile(const double* sorted, int count, double u) {
    const double at = u * (count - 1);
    const int i = (int)fmin(floor(at), count - 2);
    return sorted[i] + (at - i) * (sorted[i + 1] - sorted[i]);
}

double bt_sample_bandwidth(double* value, int count) {
    double mean = 0, square = 0;
    qsort(value, (size_t)count, sizeof *value, compare_doubles);
    for (int i = 0; i < count; ++i)
        mean += value[i] / count;
    for (int i = 0; i < count; ++i)
        square += (value[i] - mean) * (value[i] - mean) / (count - 1);
    const double quartiles =
        order_quantile(value, count, 0.75) - order_quantile(value, count, 0.25);
    const double sd = sqrt(square);
    const double spread = quartiles > 0 ? fmin(sd, quartiles / 1.34) : sd;
    return value[0] < value[count - 1] ? 0.9 * spread * pow(count, -0.2) : 0;
}

bool bt_sample_is_smooth(const bt_sample* sample) {
    return sample->bandwidth > 0;
}

double bt_sample_mean(const bt_sample* sample) {
    return sample->mean;
}

/// The first place in an ascending array that is not below `wanted`; at most count - 1.
static int first_not_below(const double* array, int count, double wanted) {
    int low = 0, high = count - 1;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (array[middle] < wanted)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

double bt_sample_quantile(const bt_sample* s, double u) {
    if (!bt_sample_is_smooth(s))
        return s->value[first_not_below(s->up_to, s->count, u)];
    const int above = first_not_below(s->below, s->points, u), i = above > 0 ? above - 1 : 0;
    // probability f t + (g - f) t^2 / 2 of the piece, t in 0 .. 1, in units of the step
    const double f = s->density[i], g = s->density[i + 1], c = (u - s->below[i]) / s->step;
    const double root = sqrt(fmax(f * f + 2 * (g - f) * c, 0)), sum = f + root;
    return s->begin + s->step * (i + (sum > 0 ? fmin(fmax(2 * c / sum, 0), 1) : 0));
}

double bt_sample_cdf(const bt_sample* s, double x) {
    if (!bt_sample_is_smooth(s)) {
        const int i = first_not_below(s->value, s->count, x);
        return s->value[i] <= x ? s->up_to[i] : i > 0 ? s->up_to[i - 1] : 0;
    }
    const double at = (x - s->begin) / s->step;
    if (at <= 0 || at >= s->points - 1)
        return at > 0;
    const int i = (int)at;
    const double t = at - i, f = s->density[i], g = s->density[i + 1];
    return s->below[i] + s->step * t * (f + 0.5 * (g - f) * t);
}

double bt_sample_density(const bt_sample* s, double x, double shift) {
    if (!bt_sample_is_smooth(s)) {
        // x is one of the values plus the shift, rounded: the value may lie beside x - shift
        const int i = first_not_below(s->value, s->count, x - shift);
        for (int k = i > 0 ? i - 1 : 0; k <= i + 1 && k < s->count; ++k)
            if (s->value[k] + shift == x)
                return s->weight[k] / s->sum;
        return 0;
    }
    const double at = (x - shift - s->begin) / s->step;
    if (!(at >= 0 && at <= s->points - 1))
        return 0;
    const int i = (int)fmin(at, s->points - 2);
    return s->density[i] + (at - i) * (s->density[i + 1] - s->density[i]);
}

int bt_sample_count(const bt_sample* sample) {
    return sample->count;
}

void bt_sample_get(const bt_sample* sample, int i, double* value, double* weight) {
    *value = sample->value[i];
    *weight = sample->weight[i];
}

double bt_sample_bandwidth_of(const bt_sample* sample) {
    return sample->bandwidth;
}

uint64_t bt_sample_hash(const bt_sample* s) {
    const size_t size = (size_t)s->count * sizeof *s->value;
    uint64_t hash = bt_hash_bytes(BT_HASH_START, s->value, size);
    hash = bt_hash_bytes(hash, s->weight, size);
    return bt_hash_bytes(hash, &s->bandwidth, sizeof s->bandwidth);
}

// --- the families ---------------------------------------------------------------------------

/// By which all values were moved.
static double shift_of(const bt_distribution* d) {
    return d->mean - d->sample->mean;
}

static const char* check(const bt_distribution* d) {
    return d->sample ? NULL : "values are missing";
}

static double quantile(const bt_distribution* d, double u) {
    return bt_sample_quantile(d->sample, u) + shift_of(d);
}

static double cdf(const bt_distribution* d, double x) {
    return bt_sample_cdf(d->sample, x - shift_of(d));
}

static double log_density(const bt_distribution* d, double x) {
    return log(bt_sample_density(d->sample, x, shift_of(d)));
}

static double mean(const bt_distribution* d) {
    return d->mean;
}

const bt_family bt_family_discrete = {
    {"values", "probabilities"}, check, quantile, cdf, log_density, mean, BT_MOVE_MEAN};

const bt_family bt_family_empirical = {{"file", "column", "values", "bandwidth"},
                                       check,
                                       quantile,
                                       cdf,
                                       log_density,
                                       mean,
                                       BT_MOVE_MEAN};
