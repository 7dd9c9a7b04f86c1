#include "near.h"

#include "statistics/intervals.h"

/// P(X <= k) of a binomial, summed term by term.
static double binomial_cdf(int k, int n, double p) {
    double sum = 0;
    for (int i = 0; i <= k; ++i)
        sum += exp(lgamma(n + 1.0) - lgamma(i + 1.0) - lgamma(n - i + 1.0) + i * log(p) +
                   (n - i) * log1p(-p));
    return sum;
}

static void clopper_pearson_satisfies_the_binomial_definition(void** state) {
    (void)state;
    static const int trials[] = {1, 2, 7, 30, 200, 1000};
    for (size_t t = 0; t < sizeof trials / sizeof *trials; ++t)
        for (int k = 0; k <= trials[t]; k += trials[t] > 50 ? 37 : 1) {
            const int n = trials[t];
            const bt_interval ci = bt_clopper_pearson(k, n, 0.95);
            if (k == 0)
                assert_true(ci.least == 0);
            else // k or more has probability 2.5 % at the lower limit
                BT_ASSERT_NEAR(1 - binomial_cdf(k - 1, n, ci.least), 0.025, 0, 1e-11);
            if (k == n)
                assert_true(ci.greatest == 1);
            else
                BT_ASSERT_NEAR(binomial_cdf(k, n, ci.greatest), 0.025, 0, 1e-11);
        }
}

static void clopper_pearson_has_its_closed_forms_at_the_ends(void** state) {
    (void)state;
    for (int64_t n = 1; n <= 1000000000; n *= 10) {
        // none of n: (1 - p)^n = 0.025. The limit is found through 1 - p, so p = 3.7e-9 has eight
        // digits.
        const double limit = -expm1(log(0.025) / (double)n);
        BT_ASSERT_NEAR(bt_clopper_pearson(0, n, 0.95).greatest, limit, 1e-11, 1e-16);
        BT_ASSERT_NEAR(bt_clopper_pearson(n, n, 0.95).least, 1 - limit, 0, 1e-12);
    }
}

static void clopper_pearson_equals_published_values(void** state) {
    (void)state;
    // Clopper and Pearson's own example, 3 of 10, and 1 of 20 and 81 of 263 as in textbooks
    // (Agresti and Coull 1998; Newcombe 1998: 81/263 0.2527..0.3676, 15/148 0.0578..0.1617).
    const bt_interval a = bt_clopper_pearson(3, 10, 0.95);
    BT_ASSERT_NEAR(a.least, 0.0667, 0, 5e-5);
    BT_ASSERT_NEAR(a.greatest, 0.6525, 0, 5e-5);
    const bt_interval b = bt_clopper_pearson(81, 263, 0.95);
    BT_ASSERT_NEAR(b.least, 0.2527, 0, 5e-5);
    BT_ASSERT_NEAR(b.greatest, 0.3676, 0, 5e-5);
    const bt_interval c = bt_clopper_pearson(15, 148, 0.95);
    BT_ASSERT_NEAR(c.least, 0.0578, 0, 5e-5);
    BT_ASSERT_NEAR(c.greatest, 0.1617, 0, 5e-5);
}

static void clopper_pearson_of_many_trials_tends_to_the_normal_interval(void** state) {
    (void)state;
    for (int64_t n = 10000000; n <= 10000000000; n *= 1000) {
        const bt_interval ci = bt_clopper_pearson(3 * n / 10, n, 0.95);
        const double half = 1.959963984540054 * sqrt(0.21 / (double)n);
        BT_ASSERT_NEAR(0.3 - ci.least, half, 1e-3, 0);
        BT_ASSERT_NEAR(ci.greatest - 0.3, half, 1e-3, 0);
    }
}

static void clopper_pearson_is_never_of_zero_width_and_grows_with_the_count(void** state) {
    (void)state;
    for (int n = 1; n < 60; ++n)
        for (int k = 0; k < n; ++k) {
            const bt_interval here = bt_clopper_pearson(k, n, 0.95);
            const bt_interval next = bt_clopper_pearson(k + 1, n, 0.95);
            assert_true(here.greatest > here.least);
            assert_true(next.least > here.least && next.greatest > here.greatest);
            assert_true(here.least <= (double)k / n && (double)k / n <= here.greatest);
            // hit and miss exchanged
            const bt_interval mirror = bt_clopper_pearson(n - k, n, 0.95);
            BT_ASSERT_NEAR(mirror.least, 1 - here.greatest, 0, 1e-13);
        }
    const bt_interval unknown = bt_clopper_pearson(0, 0, 0.95);
    assert_true(unknown.least == 0 && unknown.greatest == 1);
}

static void beta_cdf_equals_its_closed_forms(void** state) {
    (void)state;
    for (double x = 0; x <= 1; x += 0.0625) {
        BT_ASSERT_NEAR(bt_beta_cdf(x, 1, 1), x, 1e-14, 0);
        BT_ASSERT_NEAR(bt_beta_cdf(x, 5, 1), pow(x, 5), 1e-13, 0);
        BT_ASSERT_NEAR(bt_beta_cdf(x, 1, 7), 1 - pow(1 - x, 7), 1e-13, 0);
        BT_ASSERT_NEAR(bt_beta_cdf(x, 0.5, 0.5), 2 / M_PI * asin(sqrt(x)), 1e-13, 0);
        BT_ASSERT_NEAR(bt_beta_cdf(x, 3.5, 9) + bt_beta_cdf(1 - x, 9, 3.5), 1, 1e-14, 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clopper_pearson_satisfies_the_binomial_definition),
        cmocka_unit_test(clopper_pearson_has_its_closed_forms_at_the_ends),
        cmocka_unit_test(clopper_pearson_equals_published_values),
        cmocka_unit_test(clopper_pearson_of_many_trials_tends_to_the_normal_interval),
        cmocka_unit_test(clopper_pearson_is_never_of_zero_width_and_grows_with_the_count),
        cmocka_unit_test(beta_cdf_equals_its_closed_forms),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
