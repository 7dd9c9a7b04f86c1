/// Sobol' indices against closed forms: Ishigami, the g-function, a linear sum of normals; and the
/// bootstrap intervals against repetition.
#include "near.h"

#include "reliability/sobol_indices.h"

static void ishigami(void* user, const double* x, int n, double* f) {
    (void)user;
    for (int i = 0; i < n; ++i, x += 3)
        f[i] = sin(x[0]) + 7 * sin(x[1]) * sin(x[1]) + 0.1 * pow(x[2], 4) * sin(x[0]);
}

typedef struct g_function {
    int dims;
    double a[8];
} g_function;

static void g_value(void* user, const double* x, int n, double* f) {
    const g_function* g = user;
    for (int i = 0; i < n; ++i, x += g->dims) {
        f[i] = 1;
        for (int k = 0; k < g->dims; ++k)
            f[i] *= (fabs(4 * x[k] - 2) + g->a[k]) / (1 + g->a[k]);
    }
}

static void weighted_sum(void* user, const double* x, int n, double* f) {
    (void)user;
    for (int i = 0; i < n; ++i, x += 3)
        f[i] = 100 + 1 * x[0] + 2 * x[1] + 3 * x[2];
}

static bt_sampler uniform_sampler(int dims, double lower, double upper, uint64_t seed) {
    bt_sampler s = {.dims = dims, .seed = seed};
    for (int k = 0; k < dims; ++k)
        s.distribution[k] = (bt_distribution){.kind = BT_UNIFORM, .lower = lower, .upper = upper};
    return s;
}

/// Estimates within `tolerance`, and the exact values within intervals widened by their own width.
static void check(const bt_sobol_result* r, const double* first, const double* total,
                  double tolerance) {
    for (int k = 0; k < r->dims; ++k) {
        BT_ASSERT_NEAR(r->first[k].value, first[k], 0, tolerance);
        BT_ASSERT_NEAR(r->total[k].value, total[k], 0, tolerance);
        const bt_index* both[] = {&r->first[k], &r->total[k]};
        const double exact[] = {first[k], total[k]};
        for (int j = 0; j < 2; ++j) {
            const bt_interval ci = both[j]->ci95;
            const double width = ci.greatest - ci.least;
            assert_true(width > 0 && width < 4 * tolerance);
            assert_true(exact[j] > ci.least - width && exact[j] < ci.greatest + width);
        }
    }
}

static void ishigami_has_its_closed_form_indices(void** state) {
    (void)state;
    const bt_sampler s = uniform_sampler(3, -M_PI, M_PI, 1);
    bt_sobol_result r;
    assert_int_equal(bt_sobol_indices(&s, ishigami, NULL, 200000, 100, 2, &r), BT_OK);
    assert_true(r.evaluations == 1000000);
    BT_ASSERT_NEAR(r.mean, 3.5, 0, 0.03);
    BT_ASSERT_NEAR(r.variance, 13.84458794071926, 0.02, 0);
    static const double first[] = {0.3139051911478115, 0.4424111447900408, 0};
    static const double total[] = {0.5575888552099592, 0.4424111447900408, 0.2436836640621477};
    check(&r, first, total, 0.012);
}

static void g_function_has_its_closed_form_indices(void** state) {
    (void)state;
    g_function three = {3, {0, 9, 99}}, eight = {8, {0, 1, 4.5, 9, 99, 99, 99, 99}};
    bt_sobol_result r;
    bt_sampler s = uniform_sampler(3, 0, 1, 2);
    assert_int_equal(bt_sobol_indices(&s, g_value, &three, 200000, 100, 2, &r), BT_OK);
    BT_ASSERT_NEAR(r.mean, 1, 0, 0.01);
    BT_ASSERT_NEAR(r.variance, 0.33782237037037, 0.02, 0);
    static const double first3[] = {0.986711842, 0.00986711842, 9.86711842e-5};
    static const double total3[] = {0.9900338815, 0.01315659643, 0.0001320001175};
    check(&r, first3, total3, 0.012);

    s = uniform_sampler(8, 0, 1, 3);
    assert_int_equal(bt_sobol_indices(&s, g_value, &eight, 200000, 100, 2, &r), BT_OK);
    BT_ASSERT_NEAR(r.variance, 0.46542443190221, 0.02, 0);
    static const double first8[] = {0.7161921689,   0.1790480422,   0.02367577418,  0.007161921689,
                                    7.161921689e-5, 7.161921689e-5, 7.161921689e-5, 7.161921689e-5};
    static const double total8[] = {0.7871441267,    0.2421981928,    0.03431691015,
                                    0.01046038707,   0.0001049490519, 0.0001049490519,
                                    0.0001049490519, 0.0001049490519};
    check(&r, first8, total8, 0.012);
}

static void a_sum_of_normals_divides_its_variance_by_the_squares(void** state) {
    (void)state;
    bt_sampler s = {.dims = 3, .seed = 4};
    for (int k = 0; k < 3; ++k)
        s.distribution[k] = (bt_distribution){.kind = BT_NORMAL, .mean = 5, .sd = 1};
    bt_sobol_result r;
    assert_int_equal(bt_sobol_indices(&s, weighted_sum, NULL, 100000, 100, 2, &r), BT_OK);
    static const double part[] = {1.0 / 14, 4.0 / 14, 9.0 / 14}; // no interaction: S = ST
    check(&r, part, part, 0.015);
}

static void bootstrap_intervals_cover(void** state) {
    (void)state;
    static const double first[] = {0.3139051911478115, 0.4424111447900408, 0};
    static const double total[] = {0.5575888552099592, 0.4424111447900408, 0.2436836640621477};
    enum { REPETITIONS = 500 };
    int covered[6] = {0};
    for (int i = 0; i < REPETITIONS; ++i) {
        const bt_sampler s = uniform_sampler(3, -M_PI, M_PI, (uint64_t)(100 + i));
        bt_sobol_result r;
        assert_int_equal(bt_sobol_indices(&s, ishigami, NULL, 1000, 200, 2, &r), BT_OK);
        for (int k = 0; k < 3; ++k) {
            covered[k] += r.first[k].ci95.least <= first[k] && first[k] <= r.first[k].ci95.greatest;
            covered[3 + k] +=
                r.total[k].ci95.least <= total[k] && total[k] <= r.total[k].ci95.greatest;
        }
    }
    for (int k = 0; k < 6; ++k) { // 95 % less three standard errors of 500 repetitions
        print_message("%s of input %d covered %.3f\n", k < 3 ? "S" : "ST", k % 3,
                      (double)covered[k] / REPETITIONS);
        assert_true(covered[k] >= 0.92 * REPETITIONS);
    }
}

static void indices_are_the_same_for_1_2_and_3_threads(void** state) {
    (void)state;
    const bt_sampler s = uniform_sampler(3, -M_PI, M_PI, 5);
    static bt_sobol_result r[3];
    for (int i = 0; i < 3; ++i) {
        assert_int_equal(bt_sobol_indices(&s, ishigami, NULL, 5000, 50, i + 1, &r[i]), BT_OK);
        assert_memory_equal(&r[i], &r[0], sizeof r[0]);
    }
}

static void one(void* user, const double* x, int n, double* f) {
    (void)user;
    (void)x;
    for (int i = 0; i < n; ++i)
        f[i] = 1;
}

static void a_function_that_does_not_vary_has_no_indices(void** state) {
    (void)state;
    const bt_sampler s = uniform_sampler(2, 0, 1, 6);
    bt_sobol_result r;
    assert_int_equal(bt_sobol_indices(&s, one, NULL, 1000, 50, 1, &r), BT_ERR_NUMERIC);
    assert_true(isnan(r.first[0].value) && isnan(r.total[1].ci95.least));
    assert_int_equal(bt_sobol_indices(&s, one, NULL, 4, 50, 1, &r), BT_ERR_ARG);
}

static void above(void* user, const double* x, int n, int8_t* label, float* decision) {
    (void)user;
    for (int i = 0; i < n; ++i) {
        decision[i] = (float)(x[2 * i] - 0.3);
        label[i] = x[2 * i] > 0.3 ? 1 : -1;
    }
}

static void a_classifier_that_looks_at_one_input_gives_it_everything(void** state) {
    (void)state;
    const bt_sampler s = uniform_sampler(2, 0, 1, 7);
    bt_classifier c = {.classify = above, .dims = 2};
    bt_sobol_result r;
    assert_int_equal(bt_sobol_indices(&s, bt_engaged, &c, 20000, 50, 2, &r), BT_OK);
    BT_ASSERT_NEAR(r.mean, 0.7, 0, 4 * sqrt(0.21 / 40000));
    BT_ASSERT_NEAR(r.first[0].value, 1, 0, 0.03);
    BT_ASSERT_NEAR(r.total[0].value, 1, 0, 0.03);
    assert_true(r.first[1].value == 0 && r.total[1].value == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ishigami_has_its_closed_form_indices),
        cmocka_unit_test(g_function_has_its_closed_form_indices),
        cmocka_unit_test(a_sum_of_normals_divides_its_variance_by_the_squares),
        cmocka_unit_test(bootstrap_intervals_cover),
        cmocka_unit_test(indices_are_the_same_for_1_2_and_3_threads),
        cmocka_unit_test(a_function_that_does_not_vary_has_no_indices),
        cmocka_unit_test(a_classifier_that_looks_at_one_input_gives_it_everything),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
