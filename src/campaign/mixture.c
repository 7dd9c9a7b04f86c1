#include "campaign/mixture.h"

#include "base/rng.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Points per component, and steps, of the search for the shares.
enum { POINTS = 256, STEPS = 100, VARIABLE_SHARES = 0x30000 };
static const double least_share = 0.1; ///< of the equal one

/// Scores of a point by the variables' own distributions.
static void score(const bt_mixture* m, const double* x, double* z) {
    for (int k = 0; k < m->copula.dims; ++k)
        z[k] = m->copula.bound[k] ? bt_distribution_score(&m->base[k], x[k]) : 0;
}

/// Log density of the copula in a component, whose own variable has another score.
static double bound_log_density(const bt_mixture* m, int component, const double* x,
                                const double* z) {
    double own[BT_INPUT_MAX];
    const int k = m->moved[component];
    if (k < 0 || !m->copula.bound[k])
        return bt_copula_log_density(&m->copula, z);
    memcpy(own, z, sizeof own);
    own[k] = bt_distribution_score(&m->to[component], x[k]);
    return bt_copula_log_density(&m->copula, own);
}

double bt_mixture_log_density(const bt_mixture* m, const double* x, double* log_p) {
    double own[BT_COMPONENT_MAX], log_base[BT_INPUT_MAX], all = 0, greatest = -INFINITY;
    double z[BT_INPUT_MAX] = {0};
    score(m, x, z);
    double* p = log_p ? log_p : own;
    for (int k = 0; k < m->dims; ++k)
        all += log_base[k] = bt_distribution_log_density(&m->base[k], x[k]);
    for (int c = 0; c < m->components; ++c) {
        const int k = m->moved[c];
        p[c] = all;
        if (k >= 0) {
            p[c] = bt_distribution_log_density(&m->to[c], x[k]);
            for (int j = 0; j < m->dims; ++j)
                p[c] += j == k ? 0 : log_base[j];
        }
        if (m->copula.dims > 0 && !isinf(p[c]))
            p[c] += bound_log_density(m, c, x, z);
        greatest = fmax(greatest, p[c]);
    }
    if (isinf(greatest))
        return -INFINITY;
    double sum = 0;
    for (int c = 0; c < m->components; ++c)
        sum += m->share[c] * exp(p[c] - greatest);
    // cppcheck-suppress invalidFunctionArg ; there is a component, or greatest were infinite
    return greatest + log(sum);
}

void bt_mixture_point(const bt_mixture* m, int component, const double* u, double* x) {
    double bound[BT_INPUT_MAX];
    memcpy(bound, u, (size_t)m->dims * sizeof *u);
    bt_copula_bind(&m->copula, bound);
    for (int k = 0; k < m->dims; ++k)
        x[k] = bt_distribution_quantile(k == m->moved[component] ? &m->to[component] : &m->base[k],
                                        bound[k]);
}

int bt_mixture_pick(const bt_mixture* m, double u) {
    int component = 0;
    for (double above = m->share[0]; component + 1 < m->components && u >= above; ++component)
        above += m->share[component + 1];
    return component;
}

/* ---- the shares ---- */

/// The ratio of every component's density to the mixture's, at points of every component.
typedef struct search {
    int components, points; ///< of each component
    double* density;        ///< [components * points][components], relative to the greatest
} search;

static void place(const bt_mixture* m, uint64_t seed, search* s) {
    double u[BT_INPUT_MAX], x[BT_INPUT_MAX];
    for (int c = 0; c < s->components; ++c)
        for (int i = 0; i < s->points; ++i) {
            double* p = s->density + (size_t)(c * s->points + i) * (size_t)s->components;
            for (int k = 0; k < m->dims; ++k)
                u[k] = bt_rng_uniform(seed, (uint64_t)i, (uint32_t)(VARIABLE_SHARES + k));
            bt_mixture_point(m, c, u, x);
            const double log_q = bt_mixture_log_density(m, x, p);
            for (int k = 0; k < s->components; ++k)
                p[k] = exp(p[k] - log_q);
        }
}

/// One multiplicative step: share_k times the cube root of -d/d share_k of sum_c E_c[p_c / q]^2.
static void step(const search* s, double* share) {
    const int n = s->components;
    double gain[BT_COMPONENT_MAX] = {0}, sum = 0;
    for (int c = 0; c < n; ++c) {
        double own[BT_COMPONENT_MAX] = {0}, factor = 0;
        for (int i = 0; i < s->points; ++i) {
            const double* p = s->density + (size_t)(c * s->points + i) * (size_t)n;
            double q = 0;
            for (int k = 0; k < n; ++k)
                q += share[k] * p[k];
            factor += p[c] / q / s->points;
            for (int k = 0; k < n; ++k)
                own[k] += p[c] / q * (p[k] / q) / s->points;
        }
        for (int k = 0; k < n; ++k)
            gain[k] += factor * own[k];
    }
    for (int k = 0; k < n; ++k)
        sum += share[k] *= cbrt(gain[k]);
    for (int k = 0; k < n; ++k)
        share[k] /= sum;
}

static bt_status choose_shares(bt_mixture* m, uint64_t seed) {
    const int n = m->components;
    for (int c = 0; c < n; ++c)
        m->share[c] = 1.0 / n;
    search s = {n, POINTS, malloc((size_t)(n * POINTS) * (size_t)n * sizeof(double))};
    if (!s.density)
        return BT_ERR_MEMORY;
    place(m, seed, &s);
    for (int i = 0; i < STEPS; ++i)
        step(&s, m->share);
    for (int c = 0; c < n; ++c)
        m->share[c] = (1 - least_share) * m->share[c] + least_share / n;
    free(s.density);
    return BT_OK;
}

/* ---- creation ---- */

/// The variable of a study's input; -1 when it has no distribution.
static int variable_of(const bt_study* study, int input) {
    int variable = 0;
    for (int i = 0; i < input; ++i)
        variable += study->inputs[i].random;
    return study->inputs[input].random ? variable : -1;
}

void bt_mixture_copula(const bt_study* study, bt_copula* copula) {
    bt_correlation pairs[BT_CORRELATION_MAX];
    int dims = 0;
    for (int i = 0; i < study->input_count; ++i)
        dims += study->inputs[i].random;
    for (int i = 0; i < study->correlation_count; ++i) {
        const bt_correlation* c = &study->correlations[i];
        pairs[i] =
            (bt_correlation){variable_of(study, c->first), variable_of(study, c->second), c->rank};
    }
    bt_copula_make(pairs, study->correlation_count, dims, copula);
}

static void lay(const bt_study* study, bt_mixture* m) {
    bt_mixture_copula(study, &m->copula);
    for (int i = 0; i < study->input_count; ++i)
        if (study->inputs[i].random)
            m->base[m->dims++] = study->inputs[i].distribution;
    m->moved[0] = -1;
    m->components = 1;
    for (int c = 0; c < study->condition_count; ++c) {
        const int k = m->moved[m->components] = variable_of(study, study->conditions[c].input);
        m->to[m->components++] = bt_distribution_moved(&m->base[k], study->conditions[c].mean);
    }
}

bt_status bt_mixture_create(const bt_study* study, bt_mixture** made, bt_diag* diag) {
    *made = NULL;
    int random = 0;
    for (int i = 0; i < study->input_count; ++i)
        random += study->inputs[i].random;
    const char* fault = NULL;
    if (!random)
        fault = "has no random input; give at least one in uncertainty";
    else if (study->reliability.others == BT_OTHERS_FROZEN && study->condition_count > 0)
        fault = "needs reliability.others: scatter (frozen inputs have no density)";
    if (fault) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "campaign: design conditions %s", fault);
        return BT_ERR_INPUT;
    }
    bt_mixture* m = calloc(1, sizeof *m);
    if (!m)
        return BT_ERR_MEMORY;
    lay(study, m);
    const bt_status status = choose_shares(m, (uint64_t)study->campaign.seed);
    if (status == BT_OK)
        *made = m;
    else
        free(m);
    return status;
}
