#include "near.h"

#include "base/rng.h"
#include "statistics/weighted.h"

/// P(X <= k) of a Poisson count.
static double poisson_cdf(int k, double mean) {
    double sum = 0;
    for (int i = 0; i <= k; ++i)
        sum += exp(i * log(mean) - mean - lgamma(i + 1.0));
    return sum;
}

/// Equal weights: the exact limits of a Poisson count, times the weight.
static void equal_weights_give_the_exact_poisson_limits(void** state) {
    (void)state;
    const double w = 0.25;
    for (int k = 0; k <= 40; ++k) {
        const bt_weighted_count count = {k * w, k * w * w, w};
        BT_ASSERT_NEAR(poisson_cdf(k, bt_weighted_upper(&count, 0.025) / w), 0.025, 1e-10, 0);
        if (k == 0)
            assert_true(bt_weighted_lower(&count, 0.025) == 0);
        else
            BT_ASSERT_NEAR(1 - poisson_cdf(k - 1, bt_weighted_lower(&count, 0.025) / w), 0.025,
                           1e-9, 0);
    }
}

static void nothing_seen_is_bounded_by_the_greatest_weight(void** state) {
    (void)state;
    const bt_weighted_count none = {0, 0, 0.01}, nothing = {0, 0, 0};
    BT_ASSERT_NEAR(bt_weighted_upper(&none, 0.025), -log(0.025) * 0.01, 1e-12, 0);
    assert_true(bt_weighted_upper(&nothing, 0.025) == 0);
}

/// Many events: the normal limits, sum -+ 1.96 sqrt(square).
static void many_events_give_the_normal_limits(void** state) {
    (void)state;
    bt_weighted_count count = {0, 0, 2};
    for (int i = 0; i < 100000; ++i) {
        const double w = 2 * bt_rng_uniform(1, (uint64_t)i, 0);
        count.sum += w;
        count.square += w * w;
    }
    const double sd = sqrt(count.square);
    BT_ASSERT_NEAR((bt_weighted_upper(&count, 0.025) - count.sum) / sd, 1.959964, 0.02, 0);
    BT_ASSERT_NEAR((count.sum - bt_weighted_lower(&count, 0.025)) / sd, 1.959964, 0.02, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_weights_give_the_exact_poisson_limits),
        cmocka_unit_test(nothing_seen_is_bounded_by_the_greatest_weight),
        cmocka_unit_test(many_events_give_the_normal_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
