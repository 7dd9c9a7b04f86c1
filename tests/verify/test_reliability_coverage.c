/// Intervals are promises about repetition: here they are repeated.
#include "near.h"

#include "base/rng.h"
#include "reliability/reliability.h"

enum { REPETITIONS = 4000, SAMPLES = 4000 };

static const double LEAST_COVERAGE = 0.935; ///< 95 % less four standard errors of 4,000 tosses

/// A world with one standard normal input. The hook catches below `limit`, but for a pocket; the
/// surrogate believes in `believed`, and has never heard of the pocket. Runs in the `failing` slice
/// have no outcome.
typedef struct world {
    const char* name;
    double limit, believed;
    double pocket_from, pocket_to;
    double failing_from, failing_to;
    int high_fidelity_runs;
    double expected_error;
} world;

static bool in_slice(double x, double from, double to) {
    return x >= from && x < to;
}

static bool catches(const world* w, double x) {
    return x < w->limit && !in_slice(x, w->pocket_from, w->pocket_to);
}

static double below(double x) {
    return 0.5 * erfc(-x * M_SQRT1_2);
}

static double reliability_of(const world* w) {
    double r = below(w->limit);
    if (w->pocket_to > w->pocket_from)
        r -= below(fmin(w->pocket_to, w->limit)) - below(fmin(w->pocket_from, w->limit));
    return r;
}

static double disagreement_of(const world* w) {
    const double pocket = w->pocket_to > w->pocket_from
                              ? below(fmin(w->pocket_to, fmin(w->limit, w->believed))) -
                                    below(fmin(w->pocket_from, fmin(w->limit, w->believed)))
                              : 0;
    return fabs(below(w->limit) - below(w->believed)) + pocket;
}

static void believe(void* user, const double* x, int n, int8_t* label, float* decision) {
    const world* w = user;
    for (int i = 0; i < n; ++i) {
        decision[i] = (float)(w->believed - x[i]);
        label[i] = x[i] < w->believed ? 1 : -1;
    }
}

static bt_status try_it(void* user, const double* x, int n, int* label) {
    const world* w = user;
    for (int i = 0; i < n; ++i)
        label[i] = in_slice(x[i], w->failing_from, w->failing_to) ? -1 : catches(w, x[i]);
    return BT_OK;
}

typedef struct coverage {
    double corrected, disagreement, surrogate; ///< shares of intervals that hold the truth
    double mean, bias_in_errors;               ///< of the corrected estimate
    double width;                              ///< mean, of the corrected interval
    double below, above;                       ///< shares that lie wholly above, below the truth
} coverage;

static coverage repeat(const world* w) {
    const double r = reliability_of(w), d = disagreement_of(w);
    coverage c = {0};
    double square = 0;
    for (int i = 0; i < REPETITIONS; ++i) {
        bt_sampler sampler = {.dims = 1, .seed = (uint64_t)(1000 + i), .stream = 1};
        sampler.distribution[0] = (bt_distribution){.kind = BT_NORMAL, .mean = 0, .sd = 1};
        const bt_classifier surrogate = {.classify = believe, .user = (void*)w, .dims = 1};
        bt_reliability_row row = {.unit = ""};
        assert_int_equal(bt_reliability_condition(&sampler, &surrogate, SAMPLES, 1, try_it,
                                                  (void*)w, w->high_fidelity_runs,
                                                  w->expected_error, &row),
                         BT_OK);
        assert_int_equal(row.high_fidelity_runs, w->high_fidelity_runs);
        assert_true(row.corrected_ci95.greatest > row.corrected_ci95.least);
        assert_true(row.corrected_ci95.least >= 0 && row.corrected_ci95.greatest <= 1);
        c.below += row.corrected_ci95.least > r;
        c.above += row.corrected_ci95.greatest < r;
        c.disagreement += row.disagreement_ci95.least <= d && d <= row.disagreement_ci95.greatest;
        const double believed = below(w->believed);
        c.surrogate +=
            row.surrogate_ci95.least <= believed && believed <= row.surrogate_ci95.greatest;
        c.mean += row.corrected;
        square += (row.corrected - r) * (row.corrected - r);
        c.width += row.corrected_ci95.greatest - row.corrected_ci95.least;
    }
    c.corrected = 1 - (c.below + c.above) / REPETITIONS;
    c.below /= REPETITIONS;
    c.above /= REPETITIONS;
    c.disagreement /= REPETITIONS;
    c.surrogate /= REPETITIONS;
    c.mean /= REPETITIONS;
    c.width /= REPETITIONS;
    c.bias_in_errors = (c.mean - r) / sqrt(square / REPETITIONS / REPETITIONS);
    print_message(
        "%-34s R %.5f  covered %.4f (missed %.4f below, %.4f above), disagreement "
        "%.4f, sampling %.4f; bias %+.1f errors; width %.4f, high-fidelity runs alone %.4f\n",
        w->name, r, c.corrected, c.above, c.below, c.disagreement, c.surrogate, c.bias_in_errors,
        c.width, 2 * 1.96 * sqrt(r * (1 - r) / w->high_fidelity_runs));
    return c;
}

static void check_world(const world* w) {
    const coverage c = repeat(w);
    assert_true(c.corrected >= LEAST_COVERAGE);
    assert_true(c.disagreement >= LEAST_COVERAGE);
    assert_true(c.surrogate >= LEAST_COVERAGE);
    if (w->failing_to <= w->failing_from) // failed runs are bounded, not estimated
        assert_true(fabs(c.bias_in_errors) < 4);
}

static void intervals_cover_a_surrogate_that_is_wrong_at_its_boundary(void** state) {
    (void)state;
    const world w = {.name = "wrong at its boundary",
                     .limit = 1.2,
                     .believed = 1.3,
                     .high_fidelity_runs = 200,
                     .expected_error = 0.02};
    check_world(&w);
    const world many = {.name = "the same, 1000 high-fidelity runs",
                        .limit = 1.2,
                        .believed = 1.3,
                        .high_fidelity_runs = 1000,
                        .expected_error = 0.02};
    const coverage c = repeat(&many);
    assert_true(c.corrected >= LEAST_COVERAGE);
    // Not bought by width: well below what the high-fidelity runs alone would give.
    assert_true(c.width < 0.75 * 2 * 1.96 * sqrt(0.885 * 0.115 / 1000));
}

static void intervals_cover_a_surrogate_that_is_wrong_far_from_its_boundary(void** state) {
    (void)state;
    const world w = {.name = "wrong in a far pocket",
                     .limit = 1.3,
                     .believed = 1.3,
                     .pocket_from = -0.5,
                     .pocket_to = -0.4,
                     .high_fidelity_runs = 200,
                     .expected_error = 0.01};
    check_world(&w);
    const world both = {.name = "wrong here and there",
                        .limit = 0.9,
                        .believed = 1,
                        .pocket_from = -1.5,
                        .pocket_to = -1.2,
                        .high_fidelity_runs = 200,
                        .expected_error = 0.02};
    check_world(&both);
}

static void intervals_cover_a_surrogate_that_is_right(void** state) {
    (void)state;
    const world w = {.name = "right everywhere",
                     .limit = 1,
                     .believed = 1,
                     .high_fidelity_runs = 200,
                     .expected_error = 0.01};
    check_world(&w);
}

static void intervals_cover_probabilities_near_0_and_1(void** state) {
    (void)state;
    const world sure = {.name = "nearly always caught",
                        .limit = 3.3,
                        .believed = 3.2,
                        .high_fidelity_runs = 200,
                        .expected_error = 0.001};
    check_world(&sure);
    const world hopeless = {.name = "nearly never caught",
                            .limit = -2.9,
                            .believed = -3,
                            .high_fidelity_runs = 200,
                            .expected_error = 0.01};
    check_world(&hopeless);
    const world always = {.name = "the surrogate sees no miss",
                          .limit = 2.9,
                          .believed = 9,
                          .high_fidelity_runs = 200,
                          .expected_error = 0.01};
    check_world(&always);
}

static void intervals_cover_with_few_true_runs(void** state) {
    (void)state;
    const world w = {.name = "30 high-fidelity runs",
                     .limit = 0.5,
                     .believed = 0.8,
                     .high_fidelity_runs = 30,
                     .expected_error = 0.1};
    check_world(&w);
}

static void intervals_cover_when_true_runs_fail(void** state) {
    (void)state;
    const world w = {.name = "some high-fidelity runs fail",
                     .limit = 1,
                     .believed = 1.1,
                     .failing_from = 0.95,
                     .failing_to = 1.05,
                     .high_fidelity_runs = 200,
                     .expected_error = 0.02};
    check_world(&w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intervals_cover_a_surrogate_that_is_wrong_at_its_boundary),
        cmocka_unit_test(intervals_cover_a_surrogate_that_is_wrong_far_from_its_boundary),
        cmocka_unit_test(intervals_cover_a_surrogate_that_is_right),
        cmocka_unit_test(intervals_cover_probabilities_near_0_and_1),
        cmocka_unit_test(intervals_cover_with_few_true_runs),
        cmocka_unit_test(intervals_cover_when_true_runs_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
