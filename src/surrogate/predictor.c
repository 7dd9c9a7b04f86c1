#include "surrogate/predictor.h"

#include "surrogate/predict_kernel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK = 128 }; ///< points scaled and summed together; a multiple of BT_PREDICT_TILE

/// What bounds the rounding of one pass, float or double.
typedef struct error_bound {
    double unit;       ///< u: 2^-24 or 2^-53
    double exponent;   ///< Y: terms up to 2^-Y are bounded relatively, smaller ones absolutely
    double coordinate; ///< u-units by which a stored coordinate may be off
} error_bound;

static const error_bound float_bound = {0x1p-24, 16, 1.01};
static const error_bound double_bound = {0x1p-53, 40, 4};

struct bt_predictor {
    const bt_surrogate* surrogate;
    bt_predict_float* sums_float;
    bt_predict_double* sums_double;
    bt_predict_set set_float, set_double;
    double factor[BT_INPUT_MAX]; ///< sqrt(gamma log2 e) / scale
    double sv_radius;            ///< largest |s_i| in kernel coordinates
    double coef_sum;             ///< A
    int longest;                 ///< groups of the longer sign: terms in one running sum
};

bt_isa_level bt_isa_best(void) {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
        return BT_ISA_V4;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
        __builtin_cpu_supports("bmi2"))
        return BT_ISA_V3;
#endif
    return BT_ISA_V1;
}

static void choose_kernels(bt_predictor* p, bt_isa_level level) {
    p->sums_float = bt_predict_float_v1;
    p->sums_double = bt_predict_double_v1;
#if defined(__x86_64__)
    if (level == BT_ISA_V3) {
        p->sums_float = bt_predict_float_v3;
        p->sums_double = bt_predict_double_v3;
    } else if (level == BT_ISA_V4) {
        p->sums_float = bt_predict_float_v4;
        p->sums_double = bt_predict_double_v4;
    }
#else
    (void)level;
#endif
}

/// Copies the support vectors of both signs into groups, in kernel coordinates
/// s' = s sqrt(gamma log2 e), so that a term is |coef| 2^-(|x' - s'|^2).
static void fill_groups(bt_predictor* p, float* in_float, double* in_double) {
    const bt_surrogate* s = p->surrogate;
    const double width = sqrt(s->gamma * M_LOG2E);
    const int dims = s->dims, stride = (dims + 1) * BT_PREDICT_GROUP;
    int place[2] = {0, p->set_float.group_count[0] * BT_PREDICT_GROUP};
    for (int i = 0; i < s->sv_count; ++i) {
        const int at = place[s->coef[i] < 0]++;
        const int start = at / BT_PREDICT_GROUP * stride + at % BT_PREDICT_GROUP;
        double square = 0;
        for (int k = 0; k <= dims; ++k) {
            const double value = k < dims ? s->sv[i * dims + k] * width : fabs(s->coef[i]);
            in_float[start + k * BT_PREDICT_GROUP] = (float)value;
            in_double[start + k * BT_PREDICT_GROUP] = value;
            square += k < dims ? value * value : 0;
        }
        p->sv_radius = fmax(p->sv_radius, sqrt(square));
        p->coef_sum += fabs(s->coef[i]);
    }
    for (int k = 0; k < dims; ++k)
        p->factor[k] = width / s->scale[k];
}

bt_status bt_predictor_create(const bt_surrogate* surrogate, bt_isa_level level,
                              bt_predictor** predictor) {
    bt_predictor* p = calloc(1, sizeof *p);
    *predictor = NULL;
    if (!p)
        return BT_ERR_MEMORY;
    int count[2] = {0, 0};
    for (int i = 0; i < surrogate->sv_count; ++i)
        ++count[surrogate->coef[i] < 0];
    p->surrogate = surrogate;
    p->set_float.dims = surrogate->dims;
    for (int sign = 0; sign < 2; ++sign)
        p->set_float.group_count[sign] = (count[sign] + BT_PREDICT_GROUP - 1) / BT_PREDICT_GROUP;
    p->set_double = p->set_float;
    const int *groups = p->set_float.group_count, total = groups[0] + groups[1];
    p->longest = groups[0] > groups[1] ? groups[0] : groups[1];

    // One group more than needed: the size is then never 0.
    const size_t numbers = (size_t)(total + 1) * (size_t)(surrogate->dims + 1) * BT_PREDICT_GROUP;
    float* in_float = aligned_alloc(64, numbers * sizeof *in_float);
    double* in_double = aligned_alloc(64, numbers * sizeof *in_double);
    p->set_float.block = in_float;
    p->set_double.block = in_double;
    if (!in_float || !in_double) {
        bt_predictor_destroy(p);
        return BT_ERR_MEMORY;
    }
    memset(in_float, 0, numbers * sizeof *in_float);
    memset(in_double, 0, numbers * sizeof *in_double);
    fill_groups(p, in_float, in_double);
    choose_kernels(p, level);
    *predictor = p;
    return BT_OK;
}

void bt_predictor_destroy(bt_predictor* predictor) {
    if (!predictor)
        return;
    free((void*)predictor->set_float.block);
    free((void*)predictor->set_double.block);
    free(predictor);
}

/// Bound on |f_computed - bt_surrogate_decision|; derived in docs/theory/surrogate.md.
///
/// @param terms   S+ + S- as computed
/// @param radius  |x'|, the point in kernel coordinates
static double error_of(const bt_predictor* p, const error_bound* b, double terms, double radius) {
    const double Y = b->exponent, dims = p->set_float.dims, n = p->surrogate->sv_count;
    const double exponent_error =
        2 * sqrt(Y) * b->coordinate * (radius + p->sv_radius) + (dims + 2) * Y;
    const double term = b->unit * (M_LN2 * exponent_error + 8);
    const double sum = b->unit * (p->longest + 6);
    // The definition rounds too: n additions, and (dims + 4) roundings of an exponent.
    const double size = terms + fabs(p->surrogate->rho) + p->coef_sum * exp2(-Y);
    const double definition = 0x1p-53 * (n + 16 + (dims + 4) * 2 * Y) * size;
    return 1.01 * ((term + sum) * terms + p->coef_sum * (term * exp2(-Y) + 0x1p-125) + definition);
}

/// Standardised points in kernel coordinates, and their distances from the origin. `index` names
/// the points to take (NULL: the first n); the last is repeated up to a whole tile.
#define DEFINE_SCALE(name, real)                                                                   \
    static int name(const bt_predictor* p, const double* x, const int* index, int n, real* scaled, \
                    double* radius) {                                                              \
        const bt_surrogate* s = p->surrogate;                                                      \
        const int whole = (n + BT_PREDICT_TILE - 1) / BT_PREDICT_TILE * BT_PREDICT_TILE;           \
        for (int i = 0; i < whole; ++i) {                                                          \
            const int from = i < n ? i : n - 1;                                                    \
            const double* point = x + (size_t)(index ? index[from] : from) * (size_t)s->dims;      \
            double square = 0;                                                                     \
            for (int k = 0; k < s->dims; ++k) {                                                    \
                const double value = (point[k] - s->centre[k]) * p->factor[k];                     \
                scaled[i * s->dims + k] = (real)value;                                             \
                square += value * value;                                                           \
            }                                                                                      \
            radius[i] = sqrt(square);                                                              \
        }                                                                                          \
        return whole;                                                                              \
    }
DEFINE_SCALE(scale_float, float)
DEFINE_SCALE(scale_double, double)

/// The points (of at most CHUNK) that the float pass left open, once more in double. Returns how
/// many needed the definition.
static int decide_in_double(const bt_predictor* p, const double* x, const int* open, int n,
                            int8_t* label, float* decision) {
    double scaled[CHUNK * BT_INPUT_MAX], radius[CHUNK], sums[2 * CHUNK];
    const int whole = scale_double(p, x, open, n, scaled, radius);
    p->sums_double(&p->set_double, scaled, whole, sums);
    int plain = 0;
    for (int i = 0; i < n; ++i) {
        double f = sums[2 * i] - sums[2 * i + 1] - p->surrogate->rho;
        if (!(fabs(f) > error_of(p, &double_bound, sums[2 * i] + sums[2 * i + 1], radius[i]))) {
            f = bt_surrogate_decision(p->surrogate,
                                      x + (size_t)open[i] * (size_t)p->set_double.dims);
            ++plain;
        }
        label[open[i]] = f > 0 ? 1 : -1;
        decision[open[i]] = (float)f;
    }
    return plain;
}

/// At most CHUNK points; count[] as in bt_predictor_count.
static void label_chunk(const bt_predictor* p, const double* x, int n, int8_t* label,
                        float* decision, int64_t count[3]) {
    float scaled[CHUNK * BT_INPUT_MAX], sums[2 * CHUNK];
    double radius[CHUNK];
    int open[CHUNK], open_count = 0;
    const int whole = scale_float(p, x, NULL, n, scaled, radius);
    p->sums_float(&p->set_float, scaled, whole, sums);
    for (int i = 0; i < n; ++i) {
        const double plus = sums[2 * i], minus = sums[2 * i + 1];
        const double f = plus - minus - p->surrogate->rho;
        label[i] = f > 0 ? 1 : -1;
        decision[i] = (float)f;
        if (!(fabs(f) > error_of(p, &float_bound, plus + minus, radius[i])))
            open[open_count++] = i;
    }
    const int plain = open_count ? decide_in_double(p, x, open, open_count, label, decision) : 0;
    count[0] += n - open_count;
    count[1] += open_count - plain;
    count[2] += plain;
}

static void label_all(const bt_predictor* p, const double* x, int n, int8_t* label, float* decision,
                      int64_t count[3]) {
    int8_t own_label[CHUNK];
    float own_decision[CHUNK];
    for (int i = 0; i < n; i += CHUNK) {
        const int m = n - i < CHUNK ? n - i : CHUNK;
        label_chunk(p, x + (size_t)i * (size_t)p->set_float.dims, m, label ? label + i : own_label,
                    decision ? decision + i : own_decision, count);
    }
}

void bt_predictor_label(const bt_predictor* predictor, const double* x, int n, int8_t* label,
                        float* decision) {
    int64_t count[3] = {0, 0, 0};
    label_all(predictor, x, n, label, decision, count);
}

void bt_predictor_count(const bt_predictor* predictor, const double* x, int n, int64_t count[3]) {
    count[0] = count[1] = count[2] = 0;
    label_all(predictor, x, n, NULL, NULL, count);
}
