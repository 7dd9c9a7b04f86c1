// Correlated inputs: the copula, its points, and densities of mixtures with it.
#include "near.h"

#include "base/copula.h"
#include "base/rng.h"
#include "campaign/design.h"
#include "reliability/sampler.h"

#include <stdlib.h>

enum { N = 4000 };

static int compare(const void* a, const void* b) {
    const double x = **(double*const*)a, y = **(double*const*)b;
    return (x > y) - (x < y);
}

/// Replaces values by their ranks.
static void rank(double* x, int stride) {
    double* order[N];
    for (int i = 0; i < N; ++i)
        order[i] = x + i * stride;
    qsort(order, N, sizeof *order, compare);
    for (int i = 0; i < N; ++i)
        *order[i] = i;
}

static double correlation(const double* x, const double* y, int stride) {
    double mx = 0, my = 0, xx = 0, yy = 0, xy = 0;
    for (int i = 0; i < N; ++i) {
        mx += x[i * stride] / N;
        my += y[i * stride] / N;
    }
    for (int i = 0; i < N; ++i) {
        const double a = x[i * stride] - mx, b = y[i * stride] - my;
        xx += a * a;
        yy += b * b;
        xy += a * b;
    }
    return xy / sqrt(xx * yy);
}

static void make_study(bt_study* s) {
    memset(s, 0, sizeof *s);
    bt_group_set_defaults(&bt_campaign_group, &s->campaign);
    s->campaign.design = BT_DESIGN_CONDITIONS;
    s->input_count = 3;
    for (int k = 0; k < 3; ++k)
        s->inputs[k].random = true;
    s->inputs[0].distribution = (bt_distribution){.kind = BT_NORMAL, .mean = 3, .sd = 2};
    s->inputs[1].distribution = (bt_distribution){.kind = BT_GAMMA, .mean = 2, .sd = 1};
    s->inputs[2].distribution = (bt_distribution){.kind = BT_NORMAL, .mean = -1, .sd = 0.5};
    s->correlations[0] = (bt_correlation){0, 2, 0.7};
    s->correlations[1] = (bt_correlation){1, 2, -0.4};
    s->correlation_count = 2;
    assert_int_equal(bt_copula_make(s->correlations, 2, 3, &s->copula), 2);
    s->conditions[s->condition_count++] = (bt_condition){2, 1};
    s->conditions[s->condition_count++] = (bt_condition){1, 4};
}

/// Ranks of samples are correlated as was asked, also in a condition that moves an input; those of
/// inputs in no pair are not. 3.5 standard errors of N samples.
static void samples_have_the_rank_correlations_asked_for(void** state) {
    (void)state;
    bt_study s;
    make_study(&s);
    bt_sampler sampler = {.dims = 3, .copula = &s.copula, .seed = 5};
    for (int k = 0; k < 3; ++k)
        sampler.distribution[k] = s.inputs[k].distribution;
    double* x = malloc(3 * N * sizeof *x);
    double one[3];
    bt_sampler_draw(&sampler, 0, N, x);
    bt_sampler_draw(&sampler, 1234, 1, one); // any sample alone
    assert_memory_equal(one, x + 3 * 1234, sizeof one);
    for (int k = 0; k < 3; ++k)
        rank(x + k, 3);
    BT_ASSERT_NEAR(correlation(x, x + 2, 3), 0.7, 0, 3.5 / sqrt(N));
    BT_ASSERT_NEAR(correlation(x + 1, x + 2, 3), -0.4, 0, 3.5 / sqrt(N));
    BT_ASSERT_NEAR(correlation(x, x + 1, 3), 0, 0, 3.5 / sqrt(N));
    free(x);
}

/// Two normals: the bivariate normal density, with the correlation of the scores.
static void two_normals_have_the_bivariate_normal_density(void** state) {
    (void)state;
    bt_study s;
    bt_mixture* m;
    make_study(&s);
    s.correlation_count = 1;
    s.condition_count = 0;
    assert_int_equal(bt_mixture_create(&s, &m, NULL), BT_OK);
    const double r = 2 * sin(M_PI / 6 * 0.7);
    for (int i = 0; i < 50; ++i) {
        const double a = -2 + 0.09 * i, b = 1.5 - 0.05 * i, x[] = {3 + 2 * a, 2, -1 + 0.5 * b};
        const double want = -log(2 * M_PI) - log(2 * 0.5) - 0.5 * log(1 - r * r) -
                            (a * a - 2 * r * a * b + b * b) / (2 * (1 - r * r)) +
                            bt_distribution_log_density(&s.inputs[1].distribution, 2);
        BT_ASSERT_NEAR(bt_mixture_log_density(m, x, NULL), want, 1e-12, 1e-12);
    }
    free(m);
}

/// Weights p_c / q have the mean 1 under q, and move means as the conditions ask: the weights stay
/// right. Five standard errors.
static void weights_of_correlated_inputs_are_those_of_the_conditions(void** state) {
    (void)state;
    enum { POINTS = 40000 };
    bt_study s;
    bt_mixture* m;
    make_study(&s);
    assert_int_equal(bt_mixture_create(&s, &m, NULL), BT_OK);
    double sum[3] = {0}, square[3] = {0}, mean[3][3] = {{0}};
    for (int i = 0; i < POINTS; ++i) {
        double u[3], x[3], log_p[3];
        for (uint32_t k = 0; k < 3; ++k)
            u[k] = bt_rng_uniform(1, (uint64_t)i, k);
        bt_mixture_point(m, bt_mixture_pick(m, bt_rng_uniform(1, (uint64_t)i, 9)), u, x);
        const double q = bt_mixture_log_density(m, x, log_p);
        for (int c = 0; c < 3; ++c) {
            const double w = exp(log_p[c] - q);
            sum[c] += w / POINTS;
            square[c] += w * w / POINTS;
            for (int k = 0; k < 3; ++k)
                mean[c][k] += w * x[k] / POINTS;
        }
    }
    static const double want[3][3] = {{3, 2, -1}, {3, 2, 1}, {3, 4, -1}};
    for (int c = 0; c < 3; ++c) {
        const double error = sqrt(square[c] / POINTS);
        BT_ASSERT_NEAR(sum[c], 1, 0, 5 * error);
        for (int k = 0; k < 3; ++k)
            BT_ASSERT_NEAR(mean[c][k], want[c][k], 0, 5 * error * 5);
    }
    free(m);
}

/// Points of monte_carlo have the density that the design says: its mean inverse over a box is the
/// box's volume.
static void monte_carlo_knows_its_density(void** state) {
    (void)state;
    bt_study s;
    bt_design* d;
    make_study(&s);
    s.campaign.design = BT_DESIGN_MONTE_CARLO;
    assert_int_equal(bt_design_create(&s, &d, NULL), BT_OK);
    double sum = 0, square = 0;
    enum { POINTS = 40000 };
    for (int i = 0; i < POINTS; ++i) {
        double x[3];
        bt_design_point(d, i, x);
        const bool inside = fabs(x[0] - 3) < 1 && fabs(x[1] - 2) < 0.5 && fabs(x[2] + 1) < 0.25;
        const double w = inside ? exp(-bt_design_log_density(d, x)) : 0;
        sum += w / POINTS;
        square += w * w / POINTS;
    }
    BT_ASSERT_NEAR(sum, 2 * 1 * 0.5, 0, 4 * sqrt(square / POINTS));
    bt_design_destroy(d);
}

static void pairs_that_do_not_fit_together_are_found(void** state) {
    (void)state;
    static const bt_correlation pairs[] = {{0, 1, 0.9}, {0, 2, 0.8}, {1, 2, 0.9}};
    bt_copula c;
    assert_int_equal(bt_copula_make(pairs, 3, 3, &c), 3); // the third pair makes it possible
    assert_int_equal(bt_copula_make(pairs, 2, 3, &c), 1);
    assert_int_equal(bt_copula_make(pairs, 1, 3, &c), 1);
    static const bt_correlation whole[] = {{0, 1, 1}};
    assert_int_equal(bt_copula_make(whole, 1, 2, &c), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_have_the_rank_correlations_asked_for),
        cmocka_unit_test(two_normals_have_the_bivariate_normal_density),
        cmocka_unit_test(weights_of_correlated_inputs_are_those_of_the_conditions),
        cmocka_unit_test(monte_carlo_knows_its_density),
        cmocka_unit_test(pairs_that_do_not_fit_together_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
