#include "reliability/pooled.h"

#include "base/rng.h"

#include <math.h>
#include <stdlib.h>

enum { CUT_STEPS = 48, VARIABLE_CUT = 0x70000 };

static double square(double x) {
    return x * x;
}

/* ---- weights ---- */

void bt_pooled_weigh(const bt_mixture* mixture, const bt_evidence* e, double* weight) {
    double log_p[BT_COMPONENT_MAX];
    for (int i = 0; i < e->count; ++i) {
        bt_mixture_log_density(mixture, e->x + (size_t)i * (size_t)e->dims, log_p);
        for (int c = 0; c < mixture->components; ++c)
            weight[(size_t)c * (size_t)e->count + (size_t)i] = exp(log_p[c] - e->log_density[i]);
    }
}

static int compare_doubles(const void* a, const void* b) {
    const double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

/// E_p[(1 - cap / w)+] over the sorted weights, with two of its standard errors.
static double mass_beyond(const double* sorted, int n, double cap) {
    double sum = 0, squares = 0;
    for (int i = n - 1; i >= 0 && sorted[i] > cap; --i) {
        const double part = 1 - cap / sorted[i];
        sum += part;
        squares += part * part;
    }
    return sum / n + 2 * sqrt(squares) / n;
}

void bt_pooled_law(const bt_mixture* mixture, const bt_design* design, int component, double least,
                   uint64_t seed, bt_weight_law* law) {
    const bool mixed = !design || bt_design_mixture(design);
    // weights of a mixture end at the inverse of the share
    law->bound = (bt_cut){.cap = 1 / (least * mixture->share[component]), .cut = mixed ? 0 : 1};
    double u[BT_INPUT_MAX], x[BT_INPUT_MAX], log_p[BT_COMPONENT_MAX];
    for (int i = 0; i < BT_LAW_POINTS; ++i) {
        for (int k = 0; k < mixture->dims; ++k)
            u[k] = bt_rng_uniform(seed, (uint64_t)i, (uint32_t)(VARIABLE_CUT + k));
        bt_mixture_point(mixture, component, u, x);
        double log_q = bt_mixture_log_density(mixture, x, log_p);
        if (!mixed)
            log_q = bt_design_log_density(design, x);
        law->weight[i] = exp(log_p[component] - log_q) / least;
    }
    qsort(law->weight, BT_LAW_POINTS, sizeof *law->weight, compare_doubles);
}

/// -log tail: the limit of a count of none.
static double none_seen(double tail) {
    return -log(tail);
}

bt_cut bt_pooled_cut(const bt_weight_law* law, int n, double tail) {
    bt_cut best = law->bound;
    double bound = none_seen(tail) * best.cap / n + best.cut;
    for (int i = 0; i < CUT_STEPS; ++i) {
        const double cap =
            law->weight[BT_LAW_POINTS - 1 - (BT_LAW_POINTS / 8 >> i / 4) * (8 - i % 4) / 8];
        if (isinf(cap))
            continue;
        const double cut = mass_beyond(law->weight, BT_LAW_POINTS, cap);
        if (none_seen(tail) * cap / n + cut < bound) {
            bound = none_seen(tail) * cap / n + cut;
            best = (bt_cut){.cap = cap, .cut = cut};
        }
    }
    best.tail = tail;
    return best;
}

/* ---- estimates ---- */

static void count_event(bt_weighted_count* c, double v) {
    c->sum += v;
    c->square += v * v;
}

/// Distances from an estimate value + (up) - (down) to its limits: up and down are weighted counts
/// with their limits, `apart` the limits of what is added, relative to its value.
typedef struct parts {
    bt_weighted_count up, down;           ///< what was seen, for the value
    bt_weighted_count up_most, down_most; ///< failed landings as events
    double below, above;                  ///< distances to the limits of the value
    double cut_up, cut_down;              ///< masses that were cut off
    double tail;
} parts;

/// Half-widths below and above, with the greatest weights given.
static void widths(const parts* p, double greatest_up, double greatest_down, double* below,
                   double* above) {
    bt_weighted_count up = p->up_most, down = p->down_most;
    up.greatest = greatest_up;
    down.greatest = greatest_down;
    const double more_down = bt_weighted_upper(&down, p->tail) - p->down.sum,
                 less_down = p->down.sum - bt_weighted_lower(&p->down, p->tail),
                 more_up = bt_weighted_upper(&up, p->tail) - p->up.sum,
                 less_up = p->up.sum - bt_weighted_lower(&p->up, p->tail);
    *below = sqrt(square(more_down) + square(less_up) + square(p->below));
    *above = sqrt(square(more_up) + square(less_down) + square(p->above));
}

/// Fills value, interval and widths; least and greatest are what the quantity can be at all.
static void conclude(const parts* p, double value, double least, double greatest, bt_pooled* out) {
    double below, above, seen_below, seen_above;
    widths(p, p->up.greatest, p->down.greatest, &below, &above);
    widths(p, 0, 0, &seen_below, &seen_above);
    out->value = fmin(fmax(value, least), greatest);
    out->ci95.least = fmax(least, fmin(value - below - p->cut_down, out->value));
    out->ci95.greatest = fmin(greatest, fmax(value + above + p->cut_up, out->value));
    out->sampling = 0.5 * (seen_below + seen_above);
    out->unseen = fmax(0, 0.5 * (out->ci95.greatest - out->ci95.least) - out->sampling);
}

static double effective_number(const bt_evidence* e, const double* weight, double cap) {
    double sum = 0, squares = 0;
    for (int i = 0; i < e->count; ++i) {
        const double w = fmin(weight[i], cap);
        sum += w;
        squares += w * w;
    }
    return squares > 0 ? sum * sum / squares : 0;
}

/// Counts one landing, whose error moves the estimate by v (either sign).
static void count_landing(parts* p, int label, int judged, double v) {
    if (v == 0)
        return;
    if (label < 0) { // either outcome: an error, or none
        const int sign = judged ? -1 : 1;
        count_event(sign * v > 0 ? &p->up_most : &p->down_most, fabs(v));
        return;
    }
    if (label == judged)
        return;
    const double moved = (label - judged) * v;
    count_event(moved > 0 ? &p->up : &p->down, fabs(v));
    count_event(moved > 0 ? &p->up_most : &p->down_most, fabs(v));
}

static int count_judged(const bt_evidence* e, const int8_t* judged) {
    int n = 0;
    for (int i = 0; i < e->count; ++i)
        n += judged[i] >= 0;
    return n;
}

bt_pooled bt_pooled_estimate(const bt_evidence* e, const int8_t* judged, const double* weight,
                             const bt_cut* cut, int64_t hits, int64_t samples) {
    bt_pooled out = {.judged = count_judged(e, judged),
                     .effective = effective_number(e, weight, cut->cap)};
    if (out.judged == 0 || samples <= 0)
        return (bt_pooled){.value = NAN, .ci95 = {0, 1}, .sampling = NAN, .unseen = NAN};
    parts p = {.cut_up = cut->cut, .cut_down = cut->cut, .tail = cut->tail};
    for (int i = 0; i < e->count; ++i) {
        if (judged[i] < 0)
            continue;
        const double v = fmin(weight[i], cut->cap) / out.judged;
        count_landing(&p, e->label[i], judged[i], v);
        if (e->label[i] >= 0 && e->label[i] != judged[i]) {
            ++out.disagreed;
            out.disagreement += v;
        }
    }
    const double mean = (double)hits / (double)samples;
    const bt_interval limits = bt_clopper_pearson(hits, samples, 1 - 2 * cut->tail);
    p.up.greatest = p.down.greatest = cut->cap / out.judged;
    p.below = mean - limits.least;
    p.above = limits.greatest - mean;
    conclude(&p, mean + p.up.sum - p.down.sum, 0, 1, &out);
    return out;
}

bt_pooled bt_reweighted_estimate(const bt_evidence* e, const double* weight, const bt_cut* cut) {
    bt_pooled out = {.judged = e->count, .effective = effective_number(e, weight, cut->cap)};
    if (e->count == 0)
        return (bt_pooled){.value = NAN, .ci95 = {0, 1}, .sampling = NAN, .unseen = NAN};
    parts p = {.cut_down = cut->cut, .tail = cut->tail};
    const double level = 1 - 2 * cut->tail;
    int64_t engaged = 0, done = 0;
    double failed = 0;
    bool equal = cut->cut == 0;
    for (int i = 0; i < e->count; ++i) {
        const double v = fmin(weight[i], cut->cap) / e->count;
        count_landing(&p, e->label[i], 1, v);
        equal = equal && weight[i] == 1;
        engaged += e->label[i] == 1;
        done += e->label[i] >= 0;
        failed += e->label[i] < 0 ? v : 0;
    }
    p.down.greatest = cut->cap / e->count;
    conclude(&p, 1 - p.down.sum / fmax(1 - failed, 1e-300), 0, 1, &out);
    out.disagreement = p.down.sum;
    if (equal) {
        out.value = done > 0 ? (double)engaged / (double)done : NAN;
        out.ci95.least = bt_clopper_pearson(engaged, e->count, level).least;
        out.ci95.greatest = bt_clopper_pearson(engaged + e->count - done, e->count, level).greatest;
        out.sampling = 0.5 * (out.ci95.greatest - out.ci95.least);
        out.unseen = 0;
    }
    return out;
}

bt_pooled bt_pooled_difference(const bt_evidence* e, const int8_t* judged, const double* weight_a,
                               const double* weight_b, const bt_cut* cut_a, const bt_cut* cut_b,
                               double means, bt_interval apart) {
    bt_pooled out = {.judged = count_judged(e, judged)};
    if (out.judged == 0)
        return (bt_pooled){.value = NAN, .ci95 = {-1, 1}, .sampling = NAN, .unseen = NAN};
    parts p = {.cut_up = cut_a->cut + cut_b->cut,
               .cut_down = cut_a->cut + cut_b->cut,
               .tail = cut_a->tail};
    for (int i = 0; i < e->count; ++i)
        if (judged[i] >= 0)
            count_landing(&p, e->label[i], judged[i],
                          (fmin(weight_a[i], cut_a->cap) - fmin(weight_b[i], cut_b->cap)) /
                              out.judged);
    p.up.greatest = p.down.greatest = fmax(cut_a->cap, cut_b->cap) / out.judged;
    p.below = means - apart.least;
    p.above = apart.greatest - means;
    conclude(&p, means + p.up.sum - p.down.sum, -1, 1, &out);
    return out;
}
