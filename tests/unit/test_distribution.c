#include "near.h"

#include "base/distribution.h"
#include "base/rng.h"

static const bt_distribution samples[] = {
    {.kind = BT_NORMAL, .mean = 3.6, .sd = 0.9},
    {.kind = BT_TRUNCATED_NORMAL, .mean = 6, .sd = 2, .lower = 0.5, .upper = 9},
    {.kind = BT_TRUNCATED_NORMAL, .mean = 0, .sd = 1, .lower = 6, .upper = 9}, // far tail
    {.kind = BT_TRUNCATED_NORMAL, .mean = 0, .sd = 1, .lower = -9, .upper = -6},
    {.kind = BT_LOGNORMAL, .mean = 5, .sd = 2},
    {.kind = BT_UNIFORM, .lower = -3, .upper = 7},
    {.kind = BT_TRIANGULAR, .lower = 1, .mode = 2, .upper = 6},
    {.kind = BT_TRIANGULAR, .lower = 1, .mode = 1, .upper = 6},
    {.kind = BT_WEIBULL, .scale = 3, .shape = 1.7, .lower = 0.4},
    {.kind = BT_GUMBEL, .mode = 40, .scale = 5},
    {.kind = BT_EXPONENTIAL, .mean = 4, .lower = 1},
    {.kind = BT_TRUNCATED_NORMAL, .mean = 0, .sd = 1, .lower = 8, .upper = INFINITY},
    {.kind = BT_TRUNCATED_NORMAL, .mean = 2, .sd = 3, .lower = -INFINITY, .upper = 4},
    {.kind = BT_BETA, .mean = 2, .sd = 0.7, .lower = -1, .upper = 6},
    {.kind = BT_BETA, .mean = 3, .sd = 1.1, .lower = 0, .upper = 4}, // piles up at both ends
    {.kind = BT_GAMMA, .mean = 4, .sd = 1.5, .lower = 0.5},
    {.kind = BT_GAMMA, .mean = 1, .sd = 1.8}, // shape below 1: no bound at its lower end
    {.kind = BT_GAMMA, .mean = 400, .sd = 4},
    {.kind = BT_RAYLEIGH, .scale = 2, .lower = 1},
    {.kind = BT_LOGISTIC, .mean = 3, .sd = 0.8},
    {.kind = BT_STUDENT, .mean = 1, .scale = 0.5, .shape = 6},
    {.kind = BT_STUDENT, .mean = 1, .scale = 0.5, .shape = 4.5},
    {.kind = BT_LOG_UNIFORM, .lower = 0.2, .upper = 5},
};
enum { SAMPLES = sizeof samples / sizeof samples[0] };

static void quantile_and_probability_are_inverse(void** state) {
    (void)state;
    for (int i = 0; i < SAMPLES; ++i) {
        assert_null(bt_distribution_check(&samples[i]));
        for (int k = 1; k < 1000; ++k) {
            const double u = k / 1000.0;
            const double x = bt_distribution_quantile(&samples[i], u);
            BT_ASSERT_NEAR(bt_distribution_cdf(&samples[i], x), u, 1e-9, 1e-12);
        }
    }
}

static void quantiles_rise_and_stay_finite_to_the_ends_of_the_generator(void** state) {
    (void)state;
    for (int i = 0; i < SAMPLES; ++i) {
        double last = bt_distribution_quantile(&samples[i], 0x1p-53);
        assert_true(isfinite(last));
        for (int k = 1; k < 1000; ++k) {
            const double x = bt_distribution_quantile(&samples[i], k / 1000.0);
            assert_true(x > last);
            last = x;
        }
        const double top = bt_distribution_quantile(&samples[i], 1 - 0x1p-53);
        assert_true(isfinite(top) && top > last);
    }
}

/// Mean and standard deviation as integrals over u by the midpoint rule in t, u = t^3 (10 - 15 t +
/// 6 t^2): flat at both ends, where quantiles may go to infinity.
static void integrate(const bt_distribution* d, double* mean, double* sd) {
    enum { STEPS = 20000 };
    double sum = 0, square = 0;
    const double middle = bt_distribution_quantile(d, 0.5);
    for (int k = 0; k < STEPS; ++k) {
        const double t = (k + 0.5) / STEPS, u = t * t * t * (10 - 15 * t + 6 * t * t);
        const double weight = 30 * t * t * (1 - t) * (1 - t) / STEPS;
        const double x = bt_distribution_quantile(d, u) - middle;
        sum += x * weight, square += x * x * weight;
    }
    *mean = middle + sum;
    *sd = sqrt(square - sum * sum);
}

static void mean_is_that_of_the_quantiles(void** state) {
    (void)state;
    for (int i = 0; i < SAMPLES; ++i) {
        double mean, sd;
        integrate(&samples[i], &mean, &sd);
        BT_ASSERT_NEAR(mean, bt_distribution_mean(&samples[i]), 1e-7, 1e-7);
    }
}

/// Bounds so near to each other that the formula's difference of densities has no digits left.
static void a_narrow_truncated_normal_has_its_mean_in_the_middle(void** state) {
    (void)state;
    for (double width = 1e-9; width < 1e-2; width *= 10) {
        const bt_distribution d = {
            .kind = BT_TRUNCATED_NORMAL, .mean = 0, .sd = 1, .lower = 1, .upper = 1 + width};
        assert_null(bt_distribution_check(&d));
        // the density falls by the factor 1 - z (z - middle) over the range
        const double middle = 1 + width / 2;
        BT_ASSERT_NEAR((bt_distribution_mean(&d) - 1) / width, 0.5 - middle * width / 12, 0, 1e-5);
    }
}

/// The density is the slope of the cumulative probability.
static void density_is_the_derivative_of_the_probability(void** state) {
    (void)state;
    for (int i = 0; i < SAMPLES; ++i)
        for (int k = 1; k < 100; ++k) {
            const double a = bt_distribution_quantile(&samples[i], (k - 1e-3) / 100),
                         b = bt_distribution_quantile(&samples[i], (k + 1e-3) / 100);
            const double slope = 2e-5 / (b - a);
            BT_ASSERT_NEAR(exp(bt_distribution_log_density(&samples[i], a + (b - a) / 2)), slope,
                           2e-5, 0);
        }
    assert_true(isinf(bt_distribution_log_density(&samples[4], -1)));
    assert_true(isinf(bt_distribution_log_density(&samples[5], -3.1)));
    assert_true(isinf(bt_distribution_log_density(&samples[10], 0.9)));
    const bt_distribution constant = {.kind = BT_CONSTANT, .mean = 2};
    assert_true(bt_distribution_log_density(&constant, 2) == 0);
    assert_true(isinf(bt_distribution_log_density(&constant, 2.1)));
}

static void known_quantiles(void** state) {
    (void)state;
    BT_ASSERT_NEAR(bt_distribution_quantile(&samples[0], 0.975), 3.6 + 0.9 * 1.959963984540054,
                   1e-15, 0);
    BT_ASSERT_NEAR(bt_distribution_quantile(&samples[0], 0.5), 3.6, 1e-15, 0);
    // lognormal: median = mean / sqrt(1 + (sd/mean)^2)
    BT_ASSERT_NEAR(bt_distribution_quantile(&samples[4], 0.5), 5 / sqrt(1 + 4.0 / 25), 1e-14, 0);
    // Weibull with shape 1 is exponential
    const bt_distribution weibull = {.kind = BT_WEIBULL, .scale = 3, .shape = 1, .lower = 1};
    const bt_distribution exponential = {.kind = BT_EXPONENTIAL, .mean = 4, .lower = 1};
    BT_ASSERT_NEAR(bt_distribution_quantile(&weibull, 0.9),
                   bt_distribution_quantile(&exponential, 0.9), 1e-15, 0);
    // Gumbel: median = mode - scale ln ln 2
    BT_ASSERT_NEAR(bt_distribution_quantile(&samples[9], 0.5), 40 - 5 * log(log(2)), 1e-15, 0);
}

/// Closed forms, and tables of the t and chi-square distributions.
static void known_quantiles_of_beta_gamma_student_and_their_kin(void** state) {
    (void)state;
    // beta(2, 1) on 0 .. 1: sqrt(u); beta(1, 3): 1 - (1 - u)^(1/3)
    const bt_distribution rising = {.kind = BT_BETA,
                                    .mean = 2.0 / 3,
                                    .sd = sqrt(1.0 / 18),
                                    .upper = 1},
                          falling = {
                              .kind = BT_BETA, .mean = 0.25, .sd = sqrt(3.0 / 80), .upper = 1};
    // chi-square with 3 degrees of freedom
    const bt_distribution chi = {.kind = BT_GAMMA, .mean = 3, .sd = sqrt(6)};
    const bt_distribution t2 = {.kind = BT_STUDENT, .scale = 1, .shape = 2},
                          t5 = {.kind = BT_STUDENT, .scale = 1, .shape = 5},
                          t10 = {.kind = BT_STUDENT, .mean = 1, .scale = 2, .shape = 10};
    for (int k = 1; k < 100; ++k) {
        const double u = k / 100.0;
        BT_ASSERT_NEAR(bt_distribution_quantile(&rising, u), sqrt(u), 1e-13, 0);
        BT_ASSERT_NEAR(bt_distribution_quantile(&falling, u), 1 - cbrt(1 - u), 1e-13, 0);
        BT_ASSERT_NEAR(bt_distribution_quantile(&t2, u), (2 * u - 1) / sqrt(2 * u * (1 - u)), 1e-13,
                       1e-15);
    }
    BT_ASSERT_NEAR(bt_distribution_quantile(&chi, 0.95), 7.814727903251179, 1e-13, 0);
    BT_ASSERT_NEAR(bt_distribution_quantile(&chi, 0.05), 0.3518463177492723, 1e-13, 0);
    BT_ASSERT_NEAR(bt_distribution_quantile(&t5, 0.975), 2.570581835636314, 1e-12, 0);
    BT_ASSERT_NEAR(bt_distribution_quantile(&t10, 0.995), 1 + 2 * 3.16927267261695, 1e-12, 0);
    BT_ASSERT_NEAR(bt_distribution_quantile(&samples[18], 0.5), 1 + 2 * sqrt(2 * log(2)), 1e-15, 0);
    BT_ASSERT_NEAR(bt_distribution_quantile(&samples[19], 0.75), 3 + 0.8 * sqrt(3) / M_PI * log(3),
                   1e-15, 0);
    BT_ASSERT_NEAR(bt_distribution_quantile(&samples[22], 0.5), 1, 1e-15, 0);
}

/// What users give as sd is the standard deviation.
static void given_standard_deviations_are_those_of_the_quantiles(void** state) {
    (void)state;
    for (int i = 13; i < SAMPLES; ++i) {
        double mean, sd;
        if (!(samples[i].sd > 0))
            continue;
        integrate(&samples[i], &mean, &sd);
        BT_ASSERT_NEAR(sd, samples[i].sd, 1e-5, 0);
    }
}

static void scores_are_those_of_the_standard_normal(void** state) {
    (void)state;
    for (int i = 0; i < SAMPLES; ++i)
        for (double z = -3; z <= 3; z += 0.5)
            BT_ASSERT_NEAR(
                bt_distribution_score(&samples[i], bt_distribution_at_score(&samples[i], z)), z, 0,
                1e-7);
    // beyond what a probability near 1 can tell
    BT_ASSERT_NEAR(bt_distribution_score(&samples[0], bt_distribution_at_score(&samples[0], 12)),
                   12, 1e-14, 0);
    BT_ASSERT_NEAR(bt_distribution_score(&samples[4], bt_distribution_at_score(&samples[4], 12)),
                   12, 1e-13, 0);
}

static void probabilities_outside_the_support_are_zero_and_one(void** state) {
    (void)state;
    static const struct {
        int sample;
        double below, above;
    } rows[] = {{1, 0.4, 9.1}, {5, -3.1, 7.1}, {6, 0.9, 6.1}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        assert_true(bt_distribution_cdf(&samples[rows[i].sample], rows[i].below) == 0);
        assert_true(bt_distribution_cdf(&samples[rows[i].sample], rows[i].above) == 1);
    }
    assert_true(bt_distribution_cdf(&samples[4], -1) == 0);
    assert_true(bt_distribution_cdf(&samples[8], 0.3) == 0);
    assert_true(bt_distribution_cdf(&samples[10], 0.9) == 0);
}

static void moving_changes_the_mean_and_nothing_else(void** state) {
    (void)state;
    for (int i = 0; i < SAMPLES; ++i) {
        const double to = bt_distribution_mean(&samples[i]) + 1.25;
        const bt_distribution moved = bt_distribution_moved(&samples[i], to);
        assert_null(bt_distribution_check(&moved));
        BT_ASSERT_NEAR(bt_distribution_mean(&moved), to, 1e-9, 0);
        double mean, before, after;
        integrate(&samples[i], &mean, &before);
        integrate(&moved, &mean, &after);
        if (samples[i].kind == BT_LOG_UNIFORM) // keeps upper / lower
            before *= to / bt_distribution_mean(&samples[i]);
        BT_ASSERT_NEAR(after, before, 1e-5, 0);
    }
}

static void a_constant_does_not_scatter(void** state) {
    (void)state;
    const bt_distribution c = {.kind = BT_CONSTANT, .mean = 2.5};
    assert_true(bt_distribution_quantile(&c, 0.01) == 2.5);
    assert_true(bt_distribution_quantile(&c, 0.99) == 2.5);
    assert_true(bt_distribution_cdf(&c, 2.4) == 0 && bt_distribution_cdf(&c, 2.5) == 1);
    assert_true(bt_distribution_mean(&c) == 2.5);
    assert_true(bt_distribution_moved(&c, 4).mean == 4);
}

static void unsound_parameters_are_named(void** state) {
    (void)state;
    static const struct {
        bt_distribution d;
        const char* says;
    } rows[] = {
        {{.kind = BT_NORMAL, .mean = 1}, "sd must be positive"},
        {{.kind = BT_NORMAL, .mean = NAN, .sd = 1}, "a parameter is not finite"},
        {{.kind = BT_TRUNCATED_NORMAL, .sd = -1}, "sd must be positive"},
        {{.kind = BT_TRUNCATED_NORMAL, .sd = 1, .lower = 2, .upper = 2},
         "lower must be below upper"},
        {{.kind = BT_TRUNCATED_NORMAL, .sd = 1, .lower = 40, .upper = 50},
         "the bounds leave nothing of the normal"},
        {{.kind = BT_TRUNCATED_NORMAL, .sd = 1, .lower = -INFINITY, .upper = INFINITY},
         "lower or upper is missing; one of them is needed"},
        {{.kind = BT_LOGNORMAL, .mean = 0, .sd = 1}, "mean must be positive"},
        {{.kind = BT_LOGNORMAL, .mean = 1, .sd = 0}, "sd must be positive"},
        {{.kind = BT_UNIFORM, .lower = 1, .upper = 0}, "lower must be below upper"},
        {{.kind = BT_TRIANGULAR, .lower = 1, .upper = 0}, "lower must be below upper"},
        {{.kind = BT_TRIANGULAR, .lower = 0, .upper = 1, .mode = 2},
         "mode must lie in lower .. upper"},
        {{.kind = BT_WEIBULL, .shape = 1}, "scale must be positive"},
        {{.kind = BT_WEIBULL, .scale = 1}, "shape must be positive"},
        {{.kind = BT_GUMBEL}, "scale must be positive"},
        {{.kind = BT_EXPONENTIAL, .mean = 1, .lower = 1}, "mean must be above lower"},
        {{.kind = BT_BETA, .mean = 2, .sd = 1, .lower = 0, .upper = 2},
         "mean must lie between lower and upper"},
        {{.kind = BT_BETA, .mean = 1, .sd = 1, .lower = 0, .upper = 2},
         "sd is too large for the bounds; it must be below the root of (mean - lower) (upper - "
         "mean)"},
        {{.kind = BT_GAMMA, .mean = 1, .sd = 1, .lower = 1}, "mean must be above lower"},
        {{.kind = BT_RAYLEIGH}, "scale must be positive"},
        {{.kind = BT_LOGISTIC}, "sd must be positive"},
        {{.kind = BT_LOG_UNIFORM, .lower = 0, .upper = 1}, "lower must be positive"},
        {{.kind = BT_STUDENT, .scale = 1, .shape = 1},
         "freedom must be above 1; with less there is no mean"},
        {{.kind = BT_DISCRETE}, "values are missing"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i)
        assert_string_equal(bt_distribution_check(&rows[i].d), rows[i].says);
}

static void names_and_parameters_are_complete(void** state) {
    (void)state;
    for (int kind = 0; kind < BT_DISTRIBUTION_KINDS; ++kind) {
        assert_non_null(bt_distribution_names[kind]);
        assert_non_null(bt_distribution_parameters((bt_distribution_kind)kind)[0]);
    }
    assert_null(bt_distribution_names[BT_DISTRIBUTION_KINDS]);
    assert_string_equal(bt_distribution_names[BT_CONSTANT], "constant");
    assert_string_equal(bt_distribution_names[BT_WEIBULL], "weibull");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quantile_and_probability_are_inverse),
        cmocka_unit_test(quantiles_rise_and_stay_finite_to_the_ends_of_the_generator),
        cmocka_unit_test(mean_is_that_of_the_quantiles),
        cmocka_unit_test(a_narrow_truncated_normal_has_its_mean_in_the_middle),
        cmocka_unit_test(density_is_the_derivative_of_the_probability),
        cmocka_unit_test(known_quantiles),
        cmocka_unit_test(known_quantiles_of_beta_gamma_student_and_their_kin),
        cmocka_unit_test(given_standard_deviations_are_those_of_the_quantiles),
        cmocka_unit_test(scores_are_those_of_the_standard_normal),
        cmocka_unit_test(probabilities_outside_the_support_are_zero_and_one),
        cmocka_unit_test(moving_changes_the_mean_and_nothing_else),
        cmocka_unit_test(a_constant_does_not_scatter),
        cmocka_unit_test(unsound_parameters_are_named),
        cmocka_unit_test(names_and_parameters_are_complete),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
