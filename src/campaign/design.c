#include "campaign/design.h"

#include "base/rng.h"

#include <gsl/gsl_qrng.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SOBOL_AXES_MAX = 40 };
static const int64_t count_max = 1000000000;

/* Keys of random numbers that are not samples of an input lie above every input's number. */
enum { VARIABLE_SHIFT = 0x10000, VARIABLE_PERMUTATION = 0x20000 };

struct bt_design {
    const bt_study* study;
    bt_axes axes;
    int64_t count;
    int64_t levels[BT_INPUT_MAX];
    gsl_qrng* sobol;
    int64_t sobol_next; ///< index that the generator gives next; it leaves out 0, the origin
    double sobol_point[SOBOL_AXES_MAX];
    uint64_t shift[BT_INPUT_MAX];
    bt_copula copula;    ///< of the axes, monte_carlo
    bt_mixture* mixture; ///< conditions only, with a sequence for each component
    gsl_qrng* sequence[BT_COMPONENT_MAX];
    int64_t drawn[BT_COMPONENT_MAX]; ///< points given so far
    int64_t mixture_next;            ///< run that comes next
};

bt_axes bt_design_axes(const bt_study* study) {
    bt_axes axes = {0};
    const bool by_distribution = bt_design_is_random(study->campaign.design);
    for (int i = 0; i < study->input_count; ++i) {
        const bt_input* input = &study->inputs[i];
        if (by_distribution ? input->random : input->bounded)
            axes.input[axes.count++] = i;
    }
    return axes;
}

static int64_t product(const int64_t* levels, int count) {
    int64_t p = 1;
    for (int i = 0; i < count; ++i)
        p = p > count_max ? p : p * levels[i];
    return p;
}

/// Explicit levels stay; the others grow one by one, the smallest first, until samples is reached.
static void choose_levels(bt_design* d) {
    int open[BT_INPUT_MAX], open_count = 0; /* axes whose levels are chosen here */
    for (int i = 0; i < d->axes.count; ++i) {
        const int levels = d->study->inputs[d->axes.input[i]].levels;
        d->levels[i] = levels > 0 ? levels : 1;
        if (levels <= 0)
            open[open_count++] = i;
    }
    while (open_count > 0 && product(d->levels, d->axes.count) < d->study->campaign.samples) {
        int smallest = open[0];
        for (int k = 1; k < open_count; ++k)
            if (d->levels[open[k]] < d->levels[smallest])
                smallest = open[k];
        ++d->levels[smallest];
    }
}

/// A study that asks for a width may go on beyond its samples.
static int64_t most_landings(const bt_study* study) {
    const bool stops = study->reliability.half_width > 0 || study->reliability.cov > 0;
    return stops && study->campaign.max_landings > 0 ? study->campaign.max_landings
                                                     : study->campaign.samples;
}

static bt_status prepare_mixture(bt_design* d, bt_diag* diag) {
    BT_TRY(bt_mixture_create(d->study, &d->mixture, diag));
    for (int c = 0; c < d->mixture->components; ++c) {
        d->sequence[c] = gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)d->axes.count);
        if (!d->sequence[c])
            return BT_ERR_MEMORY;
    }
    return BT_OK;
}

static bt_status prepare(bt_design* d, bt_diag* diag) {
    const char* const name = bt_design_names[d->study->campaign.design];
    if (d->axes.count == 0) {
        bt_diag_add(
            diag, BT_ERROR, BT_NOWHERE,
            bt_design_is_random(d->study->campaign.design)
                ? "campaign: design %s has no random input; give at least one in uncertainty"
                : "campaign: design %s has no axis; give at least one range in "
                  "campaign.bounds",
            name);
        return BT_ERR_INPUT;
    }
    d->count = most_landings(d->study);
    const uint64_t seed = (uint64_t)d->study->campaign.seed;
    for (int i = 0; i < d->axes.count; ++i)
        d->shift[i] = bt_rng_bits(seed, 0, (uint32_t)(VARIABLE_SHIFT + i)) >> 12;

    if (d->study->campaign.design == BT_DESIGN_FULL_FACTORIAL) {
        choose_levels(d);
        d->count = product(d->levels, d->axes.count);
        if (d->count > count_max) {
            bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                        "campaign: a full factorial of these levels has more than %lld runs; lower "
                        "samples or the levels",
                        (long long)count_max);
            return BT_ERR_INPUT;
        }
    }
    if (d->study->campaign.design == BT_DESIGN_SOBOL) {
        if (d->axes.count > SOBOL_AXES_MAX) {
            bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                        "campaign: design sobol takes at most %d axes and has %d; use "
                        "latin_hypercube",
                        SOBOL_AXES_MAX, d->axes.count);
            return BT_ERR_INPUT;
        }
        d->sobol = gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)d->axes.count);
        if (!d->sobol)
            return BT_ERR_MEMORY;
        d->sobol_next = 1;
    }
    return d->study->campaign.design == BT_DESIGN_CONDITIONS ? prepare_mixture(d, diag) : BT_OK;
}

bt_status bt_design_create(const bt_study* study, bt_design** design, bt_diag* diag) {
    bt_design* d = calloc(1, sizeof *d);
    if (!d)
        return BT_ERR_MEMORY;
    d->study = study;
    d->axes = bt_design_axes(study);
    if (study->campaign.design == BT_DESIGN_MONTE_CARLO)
        bt_mixture_copula(study, &d->copula);
    const bt_status status = prepare(d, diag);
    if (status != BT_OK) {
        bt_design_destroy(d);
        return status;
    }
    *design = d;
    return BT_OK;
}

void bt_design_destroy(bt_design* design) {
    if (!design)
        return;
    if (design->sobol)
        gsl_qrng_free(design->sobol);
    for (int c = 0; c < BT_COMPONENT_MAX; ++c)
        if (design->sequence[c])
            gsl_qrng_free(design->sequence[c]);
    free(design->mixture);
    free(design);
}

const bt_axes* bt_design_get_axes(const bt_design* design) {
    return &design->axes;
}

int64_t bt_design_count(const bt_design* design) {
    return design->count;
}

/// Advances the sequence to the point of index `run` (from its start when that lies behind). Index
/// 0 is the origin, so that the first 2^m points are a net.
static void sobol_seek(bt_design* d, int64_t run) {
    if (run < d->sobol_next - 1) {
        gsl_qrng_init(d->sobol);
        memset(d->sobol_point, 0, sizeof d->sobol_point);
        d->sobol_next = 1;
    }
    for (; d->sobol_next <= run; ++d->sobol_next)
        gsl_qrng_get(d->sobol, d->sobol_point);
}

/// The sequence's binary digits, those of the shift added without carry, half a last digit more:
/// never 0 or 1.
static double shifted(double u, uint64_t shift) {
    const uint64_t digits = (uint64_t)(u * 0x1p52) ^ shift;
    return ((double)digits + 0.5) * 0x1p-52;
}

/* ---- the mixture of the conditions ---- */

static void restart_mixture(bt_design* d) {
    for (int c = 0; c < d->mixture->components; ++c)
        gsl_qrng_init(d->sequence[c]);
    memset(d->drawn, 0, sizeof d->drawn);
    d->mixture_next = 0;
}

/// The next point of the mixture: index 0 of a component's sequence is the origin.
static void mixture_next(bt_design* d, double* x) {
    const bt_mixture* m = d->mixture;
    double behind = -INFINITY, u[SOBOL_AXES_MAX] = {0};
    int c = 0;
    for (int k = 0; k < m->components; ++k) {
        const double lack = m->share[k] * (double)(d->mixture_next + 1) - (double)d->drawn[k];
        if (lack > behind) {
            behind = lack;
            c = k;
        }
    }
    if (d->drawn[c]++ > 0)
        gsl_qrng_get(d->sequence[c], u);
    for (int k = 0; k < m->dims; ++k) {
        const uint64_t bits = bt_rng_bits((uint64_t)d->study->campaign.seed, (uint64_t)c,
                                          (uint32_t)(VARIABLE_SHIFT + k));
        u[k] = shifted(u[k], bits >> 12);
    }
    bt_mixture_point(m, c, u, x);
    ++d->mixture_next;
}

static void mixture_point(bt_design* d, int64_t run, double* x) {
    if (run < d->mixture_next)
        restart_mixture(d);
    while (d->mixture_next <= run)
        mixture_next(d, x);
}

/// A keyed permutation of 0 .. count - 1 at one place: a Feistel network over the next even number
/// of bits, walked until it lands inside (four times at most on average).
static uint64_t permuted(uint64_t seed, uint32_t variable, uint64_t place, uint64_t count) {
    enum { ROUNDS = 6 };
    int half_bits = 1;
    while (((uint64_t)1 << (2 * half_bits)) < count)
        ++half_bits;
    const uint64_t mask = ((uint64_t)1 << half_bits) - 1;
    do {
        uint64_t left = place >> half_bits, right = place & mask;
        for (uint64_t round = 0; round < ROUNDS; ++round) {
            const uint64_t mixed = left ^ (bt_rng_bits(seed, round << 56 | right, variable) & mask);
            left = right;
            right = mixed;
        }
        place = left << half_bits | right;
    } while (place >= count);
    return place;
}

/// Position of a run along an axis, 0 .. 1 of its range (monte_carlo: the probability).
static double fraction(bt_design* d, int64_t run, int axis, const int64_t* level) {
    const uint64_t seed = (uint64_t)d->study->campaign.seed;
    const uint32_t variable = (uint32_t)axis;
    switch (d->study->campaign.design) {
    case BT_DESIGN_SOBOL:
        return shifted(d->sobol_point[axis], d->shift[axis]);
    case BT_DESIGN_LATIN_HYPERCUBE: {
        const uint64_t stratum =
            permuted(seed, VARIABLE_PERMUTATION + variable, (uint64_t)run, (uint64_t)d->count);
        return ((double)stratum + bt_rng_uniform(seed, (uint64_t)run, variable)) / (double)d->count;
    }
    case BT_DESIGN_FULL_FACTORIAL:
        return d->levels[axis] > 1 ? (double)level[axis] / (double)(d->levels[axis] - 1) : 0.5;
    default:
        return bt_rng_uniform(seed, (uint64_t)run, variable);
    }
}

void bt_design_point(bt_design* design, int64_t run, double* x) {
    int64_t level[BT_INPUT_MAX] = {0};
    if (design->mixture) {
        mixture_point(design, run, x);
        return;
    }
    if (design->study->campaign.design == BT_DESIGN_SOBOL)
        sobol_seek(design, run);
    if (design->study->campaign.design == BT_DESIGN_FULL_FACTORIAL) {
        int64_t rest = run;
        for (int i = design->axes.count - 1; i >= 0; --i) {
            level[i] = rest % design->levels[i];
            rest /= design->levels[i];
        }
    }
    double u[BT_INPUT_MAX];
    for (int i = 0; i < design->axes.count; ++i)
        u[i] = fraction(design, run, i, level);
    bt_copula_bind(&design->copula, u);
    for (int i = 0; i < design->axes.count; ++i) {
        const bt_input* input = &design->study->inputs[design->axes.input[i]];
        x[i] = design->study->campaign.design == BT_DESIGN_MONTE_CARLO
                   ? bt_distribution_quantile(&input->distribution, u[i])
                   : input->lower + u[i] * (input->upper - input->lower);
    }
}

static double box_log_density(const bt_input* input, double x) {
    return x < input->lower || x > input->upper ? -INFINITY : -log(input->upper - input->lower);
}

double bt_design_log_density(const bt_design* design, const double* x) {
    const int kind = design->study->campaign.design;
    double z[BT_INPUT_MAX] = {0};
    if (design->mixture)
        return bt_mixture_log_density(design->mixture, x, NULL);
    double sum = kind == BT_DESIGN_FULL_FACTORIAL ? NAN : 0;
    for (int i = 0; i < design->axes.count; ++i) {
        const bt_input* input = &design->study->inputs[design->axes.input[i]];
        sum += kind == BT_DESIGN_MONTE_CARLO
                   ? bt_distribution_log_density(&input->distribution, x[i])
                   : box_log_density(input, x[i]);
        if (design->copula.bound[i])
            z[i] = bt_distribution_score(&input->distribution, x[i]);
    }
    return design->copula.dims > 0 && !isinf(sum) ? sum + bt_copula_log_density(&design->copula, z)
                                                  : sum;
}

const bt_mixture* bt_design_mixture(const bt_design* design) {
    return design->mixture;
}
