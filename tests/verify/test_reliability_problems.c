/// Failure probabilities with known answers: openturns/otbenchmark (LGPL), the values by
/// quadrature; where its list and the quadrature differ, the quadrature. Failure is g < 0; here
/// g >= 0 counts as engaged, so that 1 - R is the listed probability.
#include "near.h"

#include "reliability/high_fidelity.h"
#include "reliability/monte_carlo.h"

static double rp8(const double* x) {
    return x[0] + 2 * x[1] + 2 * x[2] + x[3] - 5 * x[4] - 5 * x[5];
}

static double rp28(const double* x) {
    return x[0] * x[1] - 146.14;
}

static double rp33(const double* x) {
    return fmin(-x[0] - x[1] - x[2] + 3 * sqrt(3), 3 - x[2]);
}

static double rp35(const double* x) {
    return fmin(2 - x[1] + exp(-0.1 * x[0] * x[0]) + pow(0.2 * x[0], 4), 4.5 - x[0] * x[1]);
}

static double rp54(const double* x) {
    double sum = 0;
    for (int i = 0; i < 20; ++i)
        sum += x[i];
    return sum - 8.951;
}

static double rp55(const double* x) {
    const double d = x[0] - x[1], bowl = 0.2 + 0.6 * d * d * d * d;
    return fmin(fmin(bowl - d / M_SQRT2, bowl + d / M_SQRT2),
                fmin(d + 5 / M_SQRT2 - 2.2, -d + 5 / M_SQRT2 - 2.2));
}

static double rp77(const double* x) {
    return x[2] <= 5 ? x[0] - x[1] - x[2] : x[2] - x[1];
}

static double rp110(const double* x) {
    const double a = x[0] <= 3.5 ? 0.85 - 0.1 * x[0] : 4 - x[0];
    const double b = x[1] <= 2 ? 2.3 - x[1] : 0.5 - 0.1 * x[1];
    return fmin(a, b);
}

static double four_branch(const double* x) {
    const double d = x[0] - x[1], s = x[0] + x[1];
    return fmin(fmin(3 + 0.1 * d * d - s / M_SQRT2, 3 + 0.1 * d * d + s / M_SQRT2),
                fmin(d + 7 / M_SQRT2, -d + 7 / M_SQRT2));
}

static double r_minus_s(const double* x) {
    return x[0] - x[1];
}

#define NORMAL(m, s) ((bt_distribution){.kind = BT_NORMAL, .mean = (m), .sd = (s)})

typedef struct problem {
    const char* name;
    double (*g)(const double* x);
    int dims;
    double probability;
    int64_t samples;
    bt_distribution all, own[6]; ///< the first own_count inputs have their own
    int own_count;
} problem;

static void label(void* user, const double* x, int n, int8_t* label, float* decision) {
    const problem* p = user;
    for (int i = 0; i < n; ++i) {
        const double g = p->g(x + i * p->dims);
        label[i] = g >= 0 ? 1 : -1;
        decision[i] = (float)g;
    }
}

static bt_status truth(void* user, const double* x, int n, int* label) {
    const problem* p = user;
    for (int i = 0; i < n; ++i)
        label[i] = p->g(x + i * p->dims) >= 0;
    return BT_OK;
}

static bt_sampler sampler_of(const problem* p) {
    bt_sampler s = {.dims = p->dims, .seed = 20230118};
    for (int k = 0; k < p->dims; ++k)
        s.distribution[k] = k < p->own_count ? p->own[k] : p->all;
    return s;
}

/// Within four coefficients of variation of crude Monte Carlo, sqrt((1 - p) / (p N)).
static void check(const problem* p) {
    const bt_sampler sampler = sampler_of(p);
    const bt_classifier classifier = {.classify = label, .user = (void*)p, .dims = p->dims};
    bt_tally tally;
    assert_int_equal(bt_monte_carlo(&sampler, &classifier, p->samples, 2, NULL, &tally), BT_OK);
    assert_true(tally.samples == p->samples);
    const double found = (double)(tally.samples - tally.engaged) / (double)tally.samples;
    const double exact = p->probability;
    const double cv = sqrt((1 - exact) / (exact * (double)p->samples));
    print_message("%-12s %.6g, exactly %.6g: off by %+.2f cv\n", p->name, found, exact,
                  (found / exact - 1) / cv);
    BT_ASSERT_NEAR(found, exact, 4 * cv, 0);
    bt_tally again;
    bt_direct_result direct; // the referee draws the same samples
    assert_int_equal(bt_direct_monte_carlo(&sampler, truth, (void*)p, 5000, &direct), BT_OK);
    assert_int_equal(bt_monte_carlo(&sampler, &classifier, 5000, 3, NULL, &again), BT_OK);
    assert_true(direct.engaged == again.engaged && direct.samples == 5000 && direct.failed == 0);
}

static void rp8_linear_in_lognormals(void** state) {
    (void)state;
#define LOGNORMAL(m, s)                                                                            \
    { .kind = BT_LOGNORMAL, .mean = (m), .sd = (s) }
    const problem p = {.name = "RP8",
                       .g = rp8,
                       .dims = 6,
                       .probability = 7.897938213e-4,
                       .samples = 1000000,
                       .own_count = 6,
                       .own = {LOGNORMAL(120, 12), LOGNORMAL(120, 12), LOGNORMAL(120, 12),
                               LOGNORMAL(120, 12), LOGNORMAL(50, 10), LOGNORMAL(40, 8)}};
    check(&p);
}

static void rp28_product_of_normals_with_a_rare_failure(void** state) {
    (void)state;
    const problem p = {.name = "RP28",
                       .g = rp28,
                       .dims = 2,
                       .probability = 1.4532946520187e-7,
                       .samples = 100000000,
                       .own_count = 2,
                       .own = {{.kind = BT_NORMAL, .mean = 78064, .sd = 11710},
                               {.kind = BT_NORMAL, .mean = 0.0104, .sd = 0.00156}}};
    check(&p);
}

static void rp33_series_system(void** state) {
    (void)state;
    const problem p = {.name = "RP33",
                       .g = rp33,
                       .dims = 3,
                       .probability = 0.0025755977908003,
                       .samples = 4000000,
                       .all = NORMAL(0, 1)};
    check(&p);
}

static void rp35_series_system(void** state) {
    (void)state;
    const problem p = {.name = "RP35",
                       .g = rp35,
                       .dims = 2,
                       .probability = 0.0034789463209311,
                       .samples = 4000000,
                       .all = NORMAL(0, 1)};
    check(&p);
}

static void rp54_sum_of_twenty_exponentials(void** state) {
    (void)state;
    const problem p = {.name = "RP54",
                       .g = rp54,
                       .dims = 20,
                       .probability = 9.9060307251722e-4,
                       .samples = 1000000,
                       .all = {.kind = BT_EXPONENTIAL, .mean = 1, .lower = 0}};
    check(&p);
}

static void rp55_four_branches_in_a_box(void** state) {
    (void)state;
    const problem p = {.name = "RP55",
                       .g = rp55,
                       .dims = 2,
                       .probability = 0.56001442828637,
                       .samples = 4000000,
                       .all = {.kind = BT_UNIFORM, .lower = -1, .upper = 1}};
    check(&p);
}

static void rp77_discontinuous_and_rare(void** state) {
    (void)state;
    const problem p = {.name = "RP77",
                       .g = rp77,
                       .dims = 3,
                       .probability = 2.6908439521986e-7,
                       .samples = 50000000,
                       .own_count = 3,
                       .own = {{.kind = BT_NORMAL, .mean = 10, .sd = 0.5},
                               {.kind = BT_NORMAL, .mean = 0, .sd = 1},
                               {.kind = BT_NORMAL, .mean = 4, .sd = 1}}};
    check(&p);
}

static void rp110_discontinuous_branches(void** state) {
    (void)state;
    const problem p = {.name = "RP110",
                       .g = rp110,
                       .dims = 2,
                       .probability = 3.1957884326388e-5,
                       .samples = 20000000,
                       .all = NORMAL(0, 1)};
    check(&p);
}

static void four_branch_series_system(void** state) {
    (void)state;
    const problem p = {.name = "four-branch",
                       .g = four_branch,
                       .dims = 2,
                       .probability = 0.0022227950661944,
                       .samples = 4000000,
                       .all = NORMAL(0, 1)};
    check(&p);
}

static void resistance_minus_load_has_its_closed_form(void** state) {
    (void)state;
    const problem p = {
        .name = "R-S",
        .g = r_minus_s,
        .dims = 2,
        .probability = 0.5 * erfc(1),
        .samples = 4000000,
        .own_count = 2,
        .own = {{.kind = BT_NORMAL, .mean = 4, .sd = 1}, {.kind = BT_NORMAL, .mean = 2, .sd = 1}}};
    BT_ASSERT_NEAR(p.probability, 0.078649603525143, 1e-13, 0); // beta = sqrt 2
    check(&p);
}

static void tallies_and_pools_are_the_same_for_1_2_and_3_threads(void** state) {
    (void)state;
    const problem p = {.name = "four-branch", .g = four_branch, .dims = 2, .all = NORMAL(0, 1)};
    const bt_sampler sampler = sampler_of(&p);
    bt_classifier classifier = {.classify = label,
                                .user = (void*)&p,
                                .dims = 2,
                                .boxed = true,
                                .least = {-2, -2},
                                .greatest = {2, 2.5}};
    enum { POOL = 150000 };
    static int8_t labels[3][POOL];
    static float decisions[3][POOL];
    bt_tally tally[3];
    for (int i = 0; i < 3; ++i) {
        const bt_pool pool = {POOL, labels[i], decisions[i]};
        assert_int_equal(bt_monte_carlo(&sampler, &classifier, 300001, i + 1, &pool, &tally[i]),
                         BT_OK);
        assert_memory_equal(&tally[i], &tally[0], sizeof tally[0]);
        assert_memory_equal(labels[i], labels[0], sizeof labels[0]);
        assert_memory_equal(decisions[i], decisions[0], sizeof decisions[0]);
    }
    // the share outside the box has its closed form
    const double inside =
        (1 - erfc(2 / M_SQRT2)) * (1 - 0.5 * erfc(2 / M_SQRT2) - 0.5 * erfc(2.5 / M_SQRT2));
    BT_ASSERT_NEAR((double)tally[0].outside / 300001, 1 - inside, 0,
                   4 * sqrt(inside * (1 - inside) / 300001));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rp8_linear_in_lognormals),
        cmocka_unit_test(rp28_product_of_normals_with_a_rare_failure),
        cmocka_unit_test(rp33_series_system),
        cmocka_unit_test(rp35_series_system),
        cmocka_unit_test(rp54_sum_of_twenty_exponentials),
        cmocka_unit_test(rp55_four_branches_in_a_box),
        cmocka_unit_test(rp77_discontinuous_and_rare),
        cmocka_unit_test(rp110_discontinuous_branches),
        cmocka_unit_test(four_branch_series_system),
        cmocka_unit_test(resistance_minus_load_has_its_closed_form),
        cmocka_unit_test(tallies_and_pools_are_the_same_for_1_2_and_3_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
