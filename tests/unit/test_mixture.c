#define _GNU_SOURCE
#include "near.h"

#include "base/rng.h"
#include "campaign/design.h"
#include "toy_study.h"

/// Two normal inputs and conditions that move the first one.
static void make_study(bt_study* s, int conditions) {
    memset(s, 0, sizeof *s);
    bt_group_set_defaults(&bt_campaign_group, &s->campaign);
    s->campaign.design = BT_DESIGN_CONDITIONS;
    s->campaign.samples = 4096;
    s->input_count = 3;
    s->inputs[0].random = s->inputs[2].random = true;
    s->inputs[0].distribution = (bt_distribution){.kind = BT_NORMAL, .mean = 0, .sd = 1};
    s->inputs[2].distribution = (bt_distribution){.kind = BT_NORMAL, .mean = 5, .sd = 2};
    for (int c = 0; c < conditions; ++c)
        s->conditions[s->condition_count++] = (bt_condition){0, 2.0 * (c + 1)};
}

static bt_mixture* mixture_of(const bt_study* study) {
    bt_mixture* m = NULL;
    assert_int_equal(bt_mixture_create(study, &m, NULL), BT_OK);
    return m;
}

static void shares_add_up_and_no_condition_is_left_out(void** state) {
    (void)state;
    bt_study study;
    make_study(&study, 4);
    bt_mixture* m = mixture_of(&study);
    double sum = 0;
    for (int c = 0; c < m->components; ++c) {
        sum += m->share[c];
        assert_true(m->share[c] >= 0.1 / m->components);
    }
    BT_ASSERT_NEAR(sum, 1, 1e-12, 0);
    free(m);
}

/// Conditions that are one and the same need no more landings than one of them.
static void equal_conditions_share_their_landings(void** state) {
    (void)state;
    bt_study study;
    make_study(&study, 0);
    for (int c = 0; c < 5; ++c) // five times the study as it stands, and one far away
        study.conditions[study.condition_count++] = (bt_condition){0, c < 4 ? 0.0 : 20.0};
    bt_mixture* m = mixture_of(&study);
    // minimise 5 / a^2 + 1 / b^2, a + b = 1: b = 1 / (1 + cbrt 5)
    const double best = 1 / (1 + cbrt(5)), floor_share = 0.1 / 6;
    BT_ASSERT_NEAR(m->share[5], 0.9 * best + floor_share, 0.03, 0);
    free(m);
}

/// Every condition's share of the density: the mean of p_c / q under q is 1.
static void weights_have_the_mean_one_in_every_condition(void** state) {
    (void)state;
    enum { N = 200000 };
    bt_study study;
    make_study(&study, 4);
    bt_mixture* m = mixture_of(&study);
    double sum[BT_COMPONENT_MAX] = {0}, x[2], log_p[BT_COMPONENT_MAX];
    for (int i = 0; i < N; ++i) {
        const double u[2] = {bt_rng_uniform(3, (uint64_t)i, 0), bt_rng_uniform(3, (uint64_t)i, 1)};
        bt_mixture_point(m, bt_mixture_pick(m, bt_rng_uniform(3, (uint64_t)i, 2)), u, x);
        const double log_q = bt_mixture_log_density(m, x, log_p);
        for (int c = 0; c < m->components; ++c) {
            const double w = exp(log_p[c] - log_q);
            assert_true(w <= 1.0000001 / m->share[c]);
            sum[c] += w;
        }
    }
    for (int c = 0; c < m->components; ++c)
        BT_ASSERT_NEAR(sum[c] / N, 1, 0, 4.5 * sqrt(1 / m->share[c] / N));
    free(m);
}

/// Runs of the design: every component's number of runs is within one of its share; the first
/// 2^m of the base have one point in each of 2^m strata; any order gives the same points.
static void the_design_is_a_net_inside_each_component(void** state) {
    (void)state;
    enum { N = 256 };
    bt_study study;
    make_study(&study, 0);
    bt_design* design = NULL;
    assert_int_equal(bt_design_create(&study, &design, NULL), BT_OK);
    assert_int_equal(bt_design_get_axes(design)->count, 2);
    int hits[N] = {0};
    double x[2], first[2], again[2];
    for (int run = 0; run < N; ++run) {
        bt_design_point(design, run, x);
        if (run == 7)
            memcpy(first, x, sizeof x);
        ++hits[(int)(N * bt_distribution_cdf(&study.inputs[0].distribution, x[0]))];
    }
    for (int i = 0; i < N; ++i)
        assert_int_equal(hits[i], 1);
    bt_design_point(design, 7, again);
    assert_memory_equal(first, again, sizeof first);
    BT_ASSERT_NEAR(bt_design_log_density(design, first),
                   bt_distribution_log_density(&study.inputs[0].distribution, first[0]) +
                       bt_distribution_log_density(&study.inputs[2].distribution, first[1]),
                   1e-14, 0);
    bt_design_destroy(design);
}

static void what_has_no_density_is_refused(void** state) {
    (void)state;
    bt_study study;
    bt_mixture* m = NULL;
    toy_messages said;
    bt_diag diag = toy_diag(&said);
    make_study(&study, 2);
    study.reliability.others = BT_OTHERS_FROZEN;
    assert_int_equal(bt_mixture_create(&study, &m, &diag), BT_ERR_INPUT);
    assert_non_null(strstr(said.last, "reliability.others: scatter"));
    make_study(&study, 0);
    study.inputs[0].random = study.inputs[2].random = false;
    assert_int_equal(bt_mixture_create(&study, &m, &diag), BT_ERR_INPUT);
    assert_non_null(strstr(said.last, "no random input"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shares_add_up_and_no_condition_is_left_out),
        cmocka_unit_test(equal_conditions_share_their_landings),
        cmocka_unit_test(weights_have_the_mean_one_in_every_condition),
        cmocka_unit_test(the_design_is_a_net_inside_each_component),
        cmocka_unit_test(what_has_no_density_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
