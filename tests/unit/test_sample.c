// Values given one by one: discrete and empirical distributions.
#include "near.h"

#include "base/distribution.h"

#include <stdlib.h>

static const double gusts[] = {3, 1, 2, 2, 8, 5, 4, 4, 4, 7};
enum { GUSTS = sizeof gusts / sizeof gusts[0] };

static bt_distribution make(bt_distribution_kind kind, const double* value, const double* weight,
                            int count, double bandwidth) {
    bt_sample* s;
    assert_int_equal(bt_sample_create(value, weight, count, bandwidth, &s), BT_OK);
    return (bt_distribution){.kind = kind, .mean = bt_sample_mean(s), .sample = s};
}

static void a_discrete_variable_takes_its_values_with_their_probabilities(void** state) {
    (void)state;
    static const double value[] = {6, 2, 4}, weight[] = {0.5, 0.2, 0.3};
    const bt_distribution d = make(BT_DISCRETE, value, weight, 3, 0);
    assert_null(bt_distribution_check(&d));
    assert_true(bt_distribution_has_atoms(&d));
    assert_true(bt_distribution_quantile(&d, 0.19) == 2);
    assert_true(bt_distribution_quantile(&d, 0.21) == 4);
    assert_true(bt_distribution_quantile(&d, 0.49) == 4);
    assert_true(bt_distribution_quantile(&d, 0.51) == 6);
    assert_true(bt_distribution_quantile(&d, 1 - 0x1p-53) == 6);
    BT_ASSERT_NEAR(bt_distribution_cdf(&d, 1.9), 0, 0, 0);
    BT_ASSERT_NEAR(bt_distribution_cdf(&d, 2), 0.2, 1e-15, 0);
    BT_ASSERT_NEAR(bt_distribution_cdf(&d, 5), 0.5, 1e-15, 0);
    BT_ASSERT_NEAR(bt_distribution_cdf(&d, 6), 1, 0, 0);
    BT_ASSERT_NEAR(bt_distribution_mean(&d), 4.6, 1e-15, 0);
    BT_ASSERT_NEAR(exp(bt_distribution_log_density(&d, 4)), 0.3, 1e-15, 0);
    assert_true(isinf(bt_distribution_log_density(&d, 4.1)));
    bt_sample_destroy(d.sample);
}

/// A moved value is rounded; its mass must be found all the same.
static void a_moved_sample_finds_its_own_values(void** state) {
    (void)state;
    double value[97];
    for (int i = 0; i < 97; ++i)
        value[i] = sqrt(i + 1) / 7;
    const bt_distribution d = make(BT_EMPIRICAL, value, NULL, 97, 0);
    for (double to = -3; to < 9; to += 0.37) {
        const bt_distribution moved = bt_distribution_moved(&d, to);
        double sum = 0;
        for (int k = 0; k < 97; ++k) {
            const double x = bt_distribution_quantile(&moved, (k + 0.5) / 97);
            BT_ASSERT_NEAR(exp(bt_distribution_log_density(&moved, x)), 1.0 / 97, 1e-14, 0);
            sum += x / 97;
        }
        BT_ASSERT_NEAR(sum, to, 1e-13, 1e-14);
    }
    bt_sample_destroy(d.sample);
}

static void an_empirical_variable_has_the_shares_of_its_values(void** state) {
    (void)state;
    const bt_distribution d = make(BT_EMPIRICAL, gusts, NULL, GUSTS, 0);
    BT_ASSERT_NEAR(exp(bt_distribution_log_density(&d, 4)), 0.3, 1e-15, 0);
    BT_ASSERT_NEAR(exp(bt_distribution_log_density(&d, 2)), 0.2, 1e-15, 0);
    BT_ASSERT_NEAR(bt_distribution_mean(&d), 4, 1e-15, 0);
    assert_int_equal(bt_sample_count(d.sample), 7);
    bt_sample_destroy(d.sample);
}

/// One kernel is a normal, but for what lies beyond 5 bandwidths and for straight pieces between
/// points a fifth of a bandwidth apart: h^2 / 8 of the curvature.
static void one_kernel_is_a_normal(void** state) {
    (void)state;
    static const double value[] = {10};
    const bt_distribution d = make(BT_EMPIRICAL, value, NULL, 1, 2),
                          normal = {.kind = BT_NORMAL, .mean = 10, .sd = 2};
    assert_false(bt_distribution_has_atoms(&d));
    for (double x = 2; x <= 18; x += 0.13)
        BT_ASSERT_NEAR(exp(bt_distribution_log_density(&d, x)),
                       exp(bt_distribution_log_density(&normal, x)), 0, 0.2 * 0.04 / 8);
    BT_ASSERT_NEAR(bt_distribution_mean(&d), 10, 1e-12, 0);
    bt_sample_destroy(d.sample);
}

/// Density, probability and quantile of a smoothed sample belong together exactly.
static void a_smoothed_sample_is_one_distribution(void** state) {
    (void)state;
    const bt_distribution all = make(BT_EMPIRICAL, gusts, NULL, GUSTS, 0.4);
    const bt_distribution d = bt_distribution_moved(&all, 6.5);
    double last = -INFINITY, integral = 0, mean = 0;
    BT_ASSERT_NEAR(bt_distribution_mean(&all), 4, 1e-6, 0); // what a kernel loses at its ends
    for (int k = 1; k < 2000; ++k) {
        const double u = k / 2000.0, x = bt_distribution_quantile(&d, u);
        assert_true(x > last);
        last = x;
        BT_ASSERT_NEAR(bt_distribution_cdf(&d, x), u, 0, 1e-13);
        BT_ASSERT_NEAR(bt_distribution_at_score(&d, bt_distribution_score(&d, x)), x, 1e-9, 0);
    }
    for (double x = 0.005; x < 16; x += 0.01) { // the midpoint rule is exact but for the kinks
        integral += 0.01 * exp(bt_distribution_log_density(&d, x));
        mean += 0.01 * x * exp(bt_distribution_log_density(&d, x));
    }
    BT_ASSERT_NEAR(integral, 1, 1e-4, 0);
    BT_ASSERT_NEAR(mean, 6.5, 1e-4, 0);
    assert_true(bt_distribution_cdf(&d, -10) == 0 && bt_distribution_cdf(&d, 30) == 1);
    bt_sample_destroy(all.sample);
}

/// 0.9 min(sd, IQR / 1.34) n^(-1/5)  [Silverman 1986, Eq. 3.31]
static void bandwidth_by_silvermans_rule(void** state) {
    (void)state;
    double value[GUSTS], same[] = {2, 2, 2};
    memcpy(value, gusts, sizeof value);
    // sd 2.211 and quartiles 2.25 and 4.75 of 1 2 2 3 4 4 4 5 7 8
    BT_ASSERT_NEAR(bt_sample_bandwidth(value, GUSTS), 0.9 * 2.5 / 1.34 * pow(10, -0.2), 1e-14, 0);
    assert_true(bt_sample_bandwidth(same, 3) == 0);
}

static void what_no_sample_can_be_is_refused(void** state) {
    (void)state;
    bt_sample* s;
    static const double far[] = {0, 1};
    assert_int_equal(bt_sample_create(far, NULL, 0, 0, &s), BT_ERR_ARG);
    assert_int_equal(bt_sample_create(far, NULL, 2, 1e-6, &s), BT_ERR_ARG);
    assert_null(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_discrete_variable_takes_its_values_with_their_probabilities),
        cmocka_unit_test(a_moved_sample_finds_its_own_values),
        cmocka_unit_test(an_empirical_variable_has_the_shares_of_its_values),
        cmocka_unit_test(one_kernel_is_a_normal),
        cmocka_unit_test(a_smoothed_sample_is_one_distribution),
        cmocka_unit_test(bandwidth_by_silvermans_rule),
        cmocka_unit_test(what_no_sample_can_be_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
