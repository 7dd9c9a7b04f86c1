#define _GNU_SOURCE
#include "near.h"

#include "campaign/design.h"
#include "toy_study.h"

#include <stdlib.h>

static bt_design* made(const bt_study* study) {
    bt_design* design = NULL;
    assert_int_equal(bt_design_create(study, &design, NULL), BT_OK);
    return design;
}

static void every_design_stays_in_the_box(void** state) {
    (void)state;
    static const int designs[] = {BT_DESIGN_SOBOL, BT_DESIGN_LATIN_HYPERCUBE,
                                  BT_DESIGN_FULL_FACTORIAL};
    for (size_t k = 0; k < 3; ++k) {
        bt_study study;
        toy_study(&study, designs[k], 300);
        bt_design* design = made(&study);
        for (int64_t run = 0; run < bt_design_count(design); ++run) {
            double x[BT_INPUT_MAX];
            bt_design_point(design, run, x);
            for (int i = 0; i < 4; ++i)
                assert_true(x[i] >= study.inputs[i].lower && x[i] <= study.inputs[i].upper);
        }
        bt_design_destroy(design);
    }
}

static void a_point_depends_on_its_number_only(void** state) {
    (void)state;
    for (int kind = BT_DESIGN_SOBOL; kind <= BT_DESIGN_MONTE_CARLO; ++kind) {
        bt_study study;
        toy_study(&study, kind, 100);
        bt_design *forward = made(&study), *backward = made(&study);
        double there[100][BT_INPUT_MAX] = {{0}}, back[100][BT_INPUT_MAX] = {{0}};
        for (int run = 0; run < 100; ++run)
            bt_design_point(forward, run, there[run]);
        for (int run = 99; run >= 0; --run)
            bt_design_point(backward, run, back[run]);
        assert_memory_equal(there, back, sizeof there);
        bt_design_destroy(forward);
        bt_design_destroy(backward);
    }
}

/// A ledger goes on when a key that the design does not vary becomes random.
static void an_input_that_is_no_axis_leaves_the_points_alone(void** state) {
    (void)state;
    for (int kind = BT_DESIGN_SOBOL; kind <= BT_DESIGN_MONTE_CARLO; ++kind) {
        bt_study with, without;
        toy_study(&with, kind, 50);
        without = with;
        without.input_count = 3;
        with.inputs[3] = with.inputs[2];
        with.inputs[2].bounded = with.inputs[2].random = false; // idle, before the third axis
        with.inputs[3].bounded = with.inputs[3].random = true;
        bt_design *a = made(&with), *b = made(&without);
        for (int run = 0; run < 50; ++run) {
            double x[BT_INPUT_MAX], y[BT_INPUT_MAX];
            bt_design_point(a, run, x);
            bt_design_point(b, run, y);
            assert_memory_equal(x, y, 3 * sizeof *x);
        }
        bt_design_destroy(a);
        bt_design_destroy(b);
    }
}

static int stratum_of(double x, const bt_input* input, int count) {
    return (int)((x - input->lower) / (input->upper - input->lower) * count);
}

/// Each of N equal strata of each axis holds one of N points.
static void check_strata(int kind, int count) {
    bt_study study;
    toy_study(&study, kind, count);
    bt_design* design = made(&study);
    int* hits = calloc((size_t)count * 4, sizeof *hits);
    for (int run = 0; run < count; ++run) {
        double x[BT_INPUT_MAX];
        bt_design_point(design, run, x);
        for (int i = 0; i < 4; ++i)
            ++hits[i * count + stratum_of(x[i], &study.inputs[i], count)];
    }
    for (int i = 0; i < 4 * count; ++i)
        assert_int_equal(hits[i], 1);
    free(hits);
    bt_design_destroy(design);
}

static void latin_hypercube_has_one_point_in_every_stratum(void** state) {
    (void)state;
    check_strata(BT_DESIGN_LATIN_HYPERCUBE, 1);
    check_strata(BT_DESIGN_LATIN_HYPERCUBE, 97);
    check_strata(BT_DESIGN_LATIN_HYPERCUBE, 1000);
}

static void latin_hypercube_axes_are_shuffled_apart(void** state) {
    (void)state;
    enum { N = 2000 };
    bt_study study;
    toy_study(&study, BT_DESIGN_LATIN_HYPERCUBE, N);
    bt_design* design = made(&study);
    double xy = 0;
    for (int run = 0; run < N; ++run) {
        double x[BT_INPUT_MAX];
        bt_design_point(design, run, x);
        xy += ((x[0] - 4) / 4) * ((x[3] - 6) / 8);
    }
    /* the mean of N products of two independent uniforms on +-1/2 has sd 1 / (12 sqrt N) */
    assert_true(fabs(xy / N) < 4.0 / (12 * sqrt(N)));
    bt_design_destroy(design);
}

/// The first 2^m points have one point in each of 2^m strata of every axis.
static void sobol_has_one_point_in_every_stratum(void** state) {
    (void)state;
    check_strata(BT_DESIGN_SOBOL, 1);
    check_strata(BT_DESIGN_SOBOL, 16);
    check_strata(BT_DESIGN_SOBOL, 256);
    check_strata(BT_DESIGN_SOBOL, 4096);
}

/// Any order of asking gives the same points.
static void sobol_points_do_not_depend_on_the_order(void** state) {
    (void)state;
    bt_study study;
    toy_study(&study, BT_DESIGN_SOBOL, 16);
    bt_design* design = made(&study);
    double first[16][BT_INPUT_MAX], again[BT_INPUT_MAX];
    for (int run = 0; run < 16; ++run)
        bt_design_point(design, run, first[run]);
    for (int run = 15; run >= 0; --run) {
        bt_design_point(design, run, again);
        assert_memory_equal(again, first[run], 4 * sizeof *again);
    }
    bt_design_destroy(design);
}

static void the_seed_moves_sobol_points(void** state) {
    (void)state;
    bt_study study;
    toy_study(&study, BT_DESIGN_SOBOL, 8);
    bt_design* design = made(&study);
    double a[BT_INPUT_MAX], b[BT_INPUT_MAX];
    bt_design_point(design, 3, a);
    bt_design_destroy(design);
    study.campaign.seed = 12;
    design = made(&study);
    bt_design_point(design, 3, b);
    bt_design_destroy(design);
    for (int i = 0; i < 4; ++i)
        assert_true(a[i] != b[i]);
}

static void a_sobol_campaign_may_grow(void** state) {
    (void)state;
    bt_study small, large;
    toy_study(&small, BT_DESIGN_SOBOL, 10);
    toy_study(&large, BT_DESIGN_SOBOL, 1000);
    bt_design *a = made(&small), *b = made(&large);
    for (int run = 0; run < 10; ++run) {
        double x[BT_INPUT_MAX] = {0}, y[BT_INPUT_MAX] = {0};
        bt_design_point(a, run, x);
        bt_design_point(b, run, y);
        assert_memory_equal(x, y, sizeof x);
    }
    bt_design_destroy(a);
    bt_design_destroy(b);
}

static void full_factorial_reaches_samples_with_nearly_equal_levels(void** state) {
    (void)state;
    bt_study study;
    toy_study(&study, BT_DESIGN_FULL_FACTORIAL, 100);
    bt_design* design = made(&study);
    assert_int_equal(bt_design_count(design), 4 * 3 * 3 * 3);
    double x[BT_INPUT_MAX];
    bt_design_point(design, 0, x);
    for (int i = 0; i < 4; ++i)
        BT_ASSERT_NEAR(x[i], study.inputs[i].lower, 0, 0);
    bt_design_point(design, bt_design_count(design) - 1, x);
    for (int i = 0; i < 4; ++i)
        BT_ASSERT_NEAR(x[i], study.inputs[i].upper, 0, 0);
    bt_design_point(design, 1, x); /* the last axis turns fastest */
    BT_ASSERT_NEAR(x[3], 6.0, 1e-15, 0);
    BT_ASSERT_NEAR(x[0], 2.0, 0, 0);
    bt_design_destroy(design);
}

static void full_factorial_keeps_given_levels(void** state) {
    (void)state;
    bt_study study;
    toy_study(&study, BT_DESIGN_FULL_FACTORIAL, 100);
    study.inputs[0].levels = 7;
    study.inputs[1].levels = 1;
    bt_design* design = made(&study);
    assert_int_equal(bt_design_count(design), 7 * 1 * 4 * 4);
    double x[BT_INPUT_MAX];
    bt_design_point(design, 5, x);
    BT_ASSERT_NEAR(x[1], 47.5, 1e-15, 0); /* a single level lies in the middle */
    bt_design_destroy(design);
}

static void full_factorial_refuses_a_billion_runs(void** state) {
    (void)state;
    bt_study study;
    bt_design* design = NULL;
    toy_messages messages;
    bt_diag diag = toy_diag(&messages);
    toy_study(&study, BT_DESIGN_FULL_FACTORIAL, 10);
    for (int i = 0; i < 4; ++i)
        study.inputs[i].levels = 1000;
    assert_int_equal(bt_design_create(&study, &design, &diag), BT_ERR_INPUT);
    assert_non_null(strstr(messages.last, "full factorial"));
}

static void a_design_without_axes_is_refused(void** state) {
    (void)state;
    bt_study study;
    bt_design* design = NULL;
    toy_messages messages;
    bt_diag diag = toy_diag(&messages);
    toy_study(&study, BT_DESIGN_SOBOL, 10);
    study.input_count = 0;
    assert_int_equal(bt_design_create(&study, &design, &diag), BT_ERR_INPUT);
    assert_non_null(strstr(messages.last, "campaign.bounds"));
}

static void monte_carlo_follows_the_distributions(void** state) {
    (void)state;
    enum { N = 20000 };
    bt_study study;
    toy_study(&study, BT_DESIGN_MONTE_CARLO, N);
    study.inputs[1].random = false; /* no axis then */
    bt_design* design = made(&study);
    assert_int_equal(bt_design_get_axes(design)->count, 3);
    double sum = 0, squares = 0;
    for (int run = 0; run < N; ++run) {
        double x[BT_INPUT_MAX];
        bt_design_point(design, run, x);
        sum += x[2];
        squares += x[2] * x[2];
    }
    const bt_distribution* d = &study.inputs[3].distribution; /* axis 2 is input 3 */
    const double mean = sum / N, sd = sqrt(squares / N - mean * mean);
    BT_ASSERT_NEAR(mean, d->mean, 0, 4 * d->sd / sqrt(N));
    BT_ASSERT_NEAR(sd, d->sd, 0, 4 * d->sd / sqrt(2.0 * N));
    bt_design_destroy(design);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_design_stays_in_the_box),
        cmocka_unit_test(a_point_depends_on_its_number_only),
        cmocka_unit_test(an_input_that_is_no_axis_leaves_the_points_alone),
        cmocka_unit_test(latin_hypercube_has_one_point_in_every_stratum),
        cmocka_unit_test(latin_hypercube_axes_are_shuffled_apart),
        cmocka_unit_test(sobol_has_one_point_in_every_stratum),
        cmocka_unit_test(sobol_points_do_not_depend_on_the_order),
        cmocka_unit_test(the_seed_moves_sobol_points),
        cmocka_unit_test(a_sobol_campaign_may_grow),
        cmocka_unit_test(full_factorial_reaches_samples_with_nearly_equal_levels),
        cmocka_unit_test(full_factorial_keeps_given_levels),
        cmocka_unit_test(full_factorial_refuses_a_billion_runs),
        cmocka_unit_test(a_design_without_axes_is_refused),
        cmocka_unit_test(monte_carlo_follows_the_distributions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
