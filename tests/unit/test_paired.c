/// The difference of two proportions on the same trials: limit cases, exact coverage, McNemar.
#include "near.h"

#include "statistics/paired.h"

static double log_choose(int n, int k) {
    return lgamma(n + 1.0) - lgamma(k + 1.0) - lgamma(n - k + 1.0);
}

/// P(k of n) with probability p.
static double binomial(int n, int k, double p) {
    if (p <= 0 || p >= 1)
        return (p <= 0 && k == 0) || (p >= 1 && k == n);
    return exp(log_choose(n, k) + k * log(p) + (n - k) * log1p(-p));
}

/// Summed over everything that can happen, the interval holds the difference at least 95 times in
/// a hundred.
static void the_interval_covers(void** state) {
    (void)state;
    enum { N = 60 };
    static const double worlds[][2] = {{0, 0.01},   {0.01, 0.01}, {0.02, 0.1}, {0.1, 0.1},
                                       {0.3, 0.02}, {0.25, 0.3},  {0.05, 0}};
    for (size_t w = 0; w < sizeof worlds / sizeof *worlds; ++w) {
        const double first = worlds[w][0], second = worlds[w][1];
        double covered = 0;
        for (int a = 0; a <= N; ++a)
            for (int b = 0; a + b <= N; ++b) {
                const bt_paired counts = {N - a - b, a, b, 0};
                const bt_paired_difference d = bt_paired_compare(&counts);
                assert_true(d.ci95.least <= d.value && d.value <= d.ci95.greatest);
                if (d.ci95.least <= second - first && second - first <= d.ci95.greatest)
                    covered += binomial(N, a, first) * binomial(N - a, b, second / (1 - first));
            }
        if (!(covered >= 0.95))
            fail_msg("covers %g at %g, %g", covered, first, second);
    }
}

static void mcnemar_is_that_of_fair_coins(void** state) {
    (void)state;
    // 2 (1 + 6 + 15) / 64 for two of six heads; 2 / 1024 for none of ten
    BT_ASSERT_NEAR(bt_paired_compare(&(bt_paired){100, 2, 4, 7}).p_value, 44.0 / 64, 1e-12, 0);
    BT_ASSERT_NEAR(bt_paired_compare(&(bt_paired){100, 0, 10, 7}).p_value, 2.0 / 1024, 1e-12, 0);
    BT_ASSERT_NEAR(bt_paired_compare(&(bt_paired){100, 10, 0, 7}).p_value, 2.0 / 1024, 1e-12, 0);
    BT_ASSERT_NEAR(bt_paired_compare(&(bt_paired){100, 3, 3, 7}).p_value, 1, 0, 0);
    BT_ASSERT_NEAR(bt_paired_compare(&(bt_paired){5, 0, 0, 5}).p_value, 1, 0, 0);
}

static void nothing_seen_is_nothing_known(void** state) {
    (void)state;
    const bt_paired_difference d = bt_paired_compare(&(bt_paired){0});
    assert_true(isnan(d.value) && d.ci95.least == -1 && d.ci95.greatest == 1);
    // no discordant trial of 1000: the difference is below some 0.4 %, not known to be 0
    const bt_paired_difference e = bt_paired_compare(&(bt_paired){900, 0, 0, 100});
    assert_true(e.value == 0 && e.ci95.greatest > 0.003 && e.ci95.greatest < 0.0045);
    BT_ASSERT_NEAR(e.ci95.least, -e.ci95.greatest, 1e-12, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_interval_covers),
        cmocka_unit_test(mcnemar_is_that_of_fair_coins),
        cmocka_unit_test(nothing_seen_is_nothing_known),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
