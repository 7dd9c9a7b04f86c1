#include "reliability/check.h"

#include "base/rng.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double LEVEL = 0.95;
static const double NORMAL_LIMIT = 1.959963984540054; ///< 97.5 % quantile of the normal
static const double POISSON_LIMIT =
    3.688879454113936; ///< -log 0.025: 97.5 % limit when none is seen

enum { STREAM_PICK = 0x52500000u };

int bt_check_stratum(const bt_check* check, int8_t label, float decision) {
    return 2 * (label > 0) + (fabsf(decision) <= check->layer);
}

/* ---- the plan ---- */

/// The bits of |decision|: they sort as the numbers do.
static uint32_t size_bits(float decision) {
    uint32_t bits;
    memcpy(&bits, &decision, sizeof bits);
    return bits & 0x7fffffffu;
}

/// The rank-th smallest |decision| (from 0), by two histograms of 16 bits.
static bt_status smallest(const bt_pool* pool, int64_t rank, float* value) {
    int64_t* histogram = calloc(65536, sizeof *histogram);
    if (!histogram)
        return BT_ERR_MEMORY;
    for (int i = 0; i < pool->count; ++i)
        ++histogram[size_bits(pool->decision[i]) >> 16];
    uint32_t high = 0;
    while (rank >= histogram[high])
        rank -= histogram[high++];
    memset(histogram, 0, 65536 * sizeof *histogram);
    for (int i = 0; i < pool->count; ++i) {
        const uint32_t bits = size_bits(pool->decision[i]);
        if (bits >> 16 == high)
            ++histogram[bits & 0xffffu];
    }
    uint32_t low = 0;
    while (rank >= histogram[low])
        rank -= histogram[low++];
    free(histogram);
    const uint32_t bits = high << 16 | low;
    memcpy(value, &bits, sizeof bits);
    return BT_OK;
}

/// Half-width to be expected when a share `boundary_part` of the runs goes to the boundary strata
/// and the surrogate errs there only: the interior ones will be bounded by having shown nothing.
static double expected_width(const double share[BT_STRATA], double boundary_part, int runs,
                             double expected_error) {
    const double boundary = share[1] + share[3], interior = share[0] + share[2];
    const double rate = boundary > 0 ? fmin(0.5, expected_error / boundary) : 0;
    double square = 0;
    for (int k = 0; k < BT_STRATA; ++k) {
        if (share[k] <= 0)
            continue;
        const double part =
            k & 1 ? boundary_part * share[k] / boundary : (1 - boundary_part) * share[k] / interior;
        const double m = fmax(part * runs, 1e-3);
        const double width =
            fmax(POISSON_LIMIT / m, k & 1 ? NORMAL_LIMIT * sqrt(rate * (1 - rate) / m) : 0);
        square += share[k] * fmin(width, 1) * share[k] * fmin(width, 1);
    }
    return square;
}

/// Plans as many of `wanted` more runs as the stratum has samples for; returns how many.
static int plan_more(bt_stratum* s, int wanted) {
    const int64_t room = s->pool - s->planned;
    const int more = wanted < room ? wanted : (int)room;
    s->planned += more;
    return more;
}

/// Shares out the runs: in proportion within boundary and interior, between them for the least
/// width.
static void share_out(bt_check* check, int64_t pool, int runs, double expected_error) {
    double share[BT_STRATA];
    for (int k = 0; k < BT_STRATA; ++k)
        share[k] = (double)check->stratum[k].pool / (double)pool;
    const double boundary = share[1] + share[3];
    double best_part = boundary, best = INFINITY;
    for (double part = boundary; part <= 0.8 && boundary > 0 && boundary < 1; part += 0.02) {
        const double width = expected_width(share, part, runs, expected_error);
        if (width < best) {
            best = width;
            best_part = part;
        }
    }
    // One for every stratum that has a sample (the estimate is without bias only if each has a
    // run), the rest by share in whole numbers, and what a small stratum cannot take goes to the
    // others.
    int left = runs;
    for (int k = 0; k < BT_STRATA && runs >= BT_STRATA; ++k)
        left -= check->stratum[k].planned = check->stratum[k].pool > 0;
    const int shared = left;
    double due = 0;
    for (int k = 0; k < BT_STRATA; ++k)
        if (share[k] > 0) {
            due += shared * (k & 1 ? best_part * share[k] / boundary
                                   : (1 - best_part) * share[k] / (1 - boundary));
            left -= plan_more(&check->stratum[k], (int)floor(due + 0.5) - (shared - left));
        }
    for (int k = BT_STRATA - 1; k >= 0; --k)
        left -= plan_more(&check->stratum[k], left);
}

/// Picks the planned number of each stratum's members, every subset equally likely: the first
/// steps of a Fisher-Yates shuffle.
static void pick(const bt_pool* pool, uint64_t seed, uint32_t stream, int* members,
                 bt_check* check) {
    int at = 0;
    for (int k = 0; k < BT_STRATA; ++k) {
        int count = 0;
        for (int i = 0; i < pool->count; ++i)
            if (bt_check_stratum(check, pool->label[i], pool->decision[i]) == k)
                members[count++] = i;
        for (int i = 0; i < check->stratum[k].planned; ++i) {
            const double u = bt_rng_uniform(seed, (uint64_t)at, STREAM_PICK + stream);
            int j = i + (int)(u * (count - i));
            j = j < count ? j : count - 1;
            const int chosen = members[j];
            members[j] = members[i];
            members[i] = chosen;
            check->picked[at++] = chosen;
        }
    }
    check->picked_count = at;
}

bt_status bt_check_plan(const bt_pool* pool, int runs, double expected_error, uint64_t seed,
                        uint32_t stream, bt_check* check) {
    *check = (bt_check){0};
    // Boundary: four times as many as are expected to be wrong.
    const double boundary_share = fmin(fmax(4 * expected_error, 0.02), 0.25);
    BT_TRY(smallest(pool, (int64_t)(boundary_share * (pool->count - 1)), &check->layer));
    for (int i = 0; i < pool->count; ++i)
        ++check->stratum[bt_check_stratum(check, pool->label[i], pool->decision[i])].pool;
    share_out(check, pool->count, runs, expected_error);

    check->picked = malloc(((size_t)runs + 1) * sizeof *check->picked);
    int* members = malloc(((size_t)pool->count + 1) * sizeof *members);
    bt_status status = BT_ERR_MEMORY;
    if (check->picked && members) {
        pick(pool, seed, stream, members, check);
        status = BT_OK;
    } else {
        free(check->picked);
        check->picked = NULL;
    }
    free(members);
    return status;
}

/* ---- the estimate ---- */

/// Limits of one stratum's disagreement rate; failed runs may be either.
static bt_interval rate_limits(const bt_stratum* s) {
    return (bt_interval){bt_clopper_pearson(s->disagreed, s->runs, LEVEL).least,
                         bt_clopper_pearson(s->disagreed + s->failed, s->runs, LEVEL).greatest};
}

static double rate(const bt_stratum* s) {
    return s->runs > s->failed ? (double)s->disagreed / (s->runs - s->failed) : 0;
}

static double square(double x) {
    return x * x;
}

bt_check_result bt_check_estimate(const bt_stratum stratum[BT_STRATA]) {
    double pool = 0;
    for (int k = 0; k < BT_STRATA; ++k)
        pool += (double)stratum[k].pool;
    bt_check_result r = {0};
    double below = 0, above = 0, fewer = 0, more = 0; // sums of squared distances to the limits
    for (int k = 0; k < BT_STRATA; ++k) {
        const bt_stratum* s = &stratum[k];
        if (s->pool == 0)
            continue;
        const double share = (double)s->pool / pool, e = rate(s);
        const bt_interval limits = rate_limits(s);
        const double down = square(share * (e - limits.least)),
                     up = square(share * (limits.greatest - e));
        const bool says_engaged = k >= BT_STRATA / 2;
        r.corrected += share * (says_engaged ? 1 - e : e);
        r.disagreement += share * e;
        below += says_engaged ? up : down;
        above += says_engaged ? down : up;
        fewer += down;
        more += up;
    }
    r.corrected = fmin(r.corrected, 1);
    const bt_interval sampling =
        bt_clopper_pearson((int64_t)floor(r.corrected * pool + 0.5), (int64_t)pool, LEVEL);
    below += square(r.corrected - sampling.least);
    above += square(sampling.greatest - r.corrected);
    r.corrected_ci95 =
        (bt_interval){fmax(0, r.corrected - sqrt(below)), fmin(1, r.corrected + sqrt(above))};
    r.disagreement_ci95 =
        (bt_interval){fmax(0, r.disagreement - sqrt(fewer)), fmin(1, r.disagreement + sqrt(more))};
    return r;
}
