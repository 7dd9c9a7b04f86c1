#include "near.h"

#include "base/rng.h"
#include "reliability/reliability.h"
#include "report/reliability_report.h"

#include <stdio.h>
#include <stdlib.h>

/* A study of two inputs and a constant one, whose model is a straight line. */

static const bt_field fields[3] = {
    {.kind = BT_FIELD_REAL, .name = "sink_speed", .unit = "mps"},
    {.kind = BT_FIELD_REAL, .name = "pitch", .unit = "rad"},
    {.kind = BT_FIELD_REAL, .name = "off_centre", .unit = "m"},
};

static bt_study* make_study(int high_fidelity_runs) {
    bt_study* s = calloc(1, sizeof *s);
    assert_non_null(s);
    static const char* const path[] = {"landing.sink_speed", "landing.pitch", "landing.off_centre"};
    s->input_count = 3;
    for (int i = 0; i < 3; ++i) {
        bt_input* in = &s->inputs[i];
        snprintf(in->path, sizeof in->path, "%s", path[i]);
        in->field = &fields[i];
        in->offset = offsetof(bt_model_params, landing) +
                     (i == 0   ? offsetof(bt_landing_params, sink_speed_mps)
                      : i == 1 ? offsetof(bt_landing_params, pitch_rad)
                               : offsetof(bt_landing_params, off_centre_m));
        in->random = i < 2;
        in->bounded = true;
        in->distribution = (bt_distribution){.kind = BT_NORMAL, .mean = i, .sd = 1};
    }
    s->model.landing.off_centre_m = 0.25;
    s->condition_count = 2;
    s->conditions[0] = (bt_condition){0, 1.5};
    s->conditions[1] = (bt_condition){1, -0.5};
    s->reliability = (bt_reliability_params){
        .samples = 60000, .high_fidelity_runs = high_fidelity_runs, .seed = 3};
    return s;
}

/// Engaged below the line x0 + x1 = 2; the surrogate has no use for the third input and takes the
/// other two in the opposite order.
static bt_surrogate train_surrogate(void) {
    enum { N = 800 };
    static double x[2 * N];
    static int label[N];
    for (int i = 0; i < N; ++i) {
        const double sink = 8 * bt_rng_uniform(1, (uint64_t)i, 0) - 4;
        const double pitch = 8 * bt_rng_uniform(1, (uint64_t)i, 1) - 3;
        x[2 * i] = pitch;
        x[2 * i + 1] = sink;
        label[i] = sink + pitch < 2 ? 1 : -1;
    }
    const bt_training_set set = {2, N, x, label};
    const bt_surrogate_params params = {
        .folds = 5, .holdout = 0.2, .C = {1, {1000}}, .gamma = {1, {0.05}}};
    bt_surrogate s;
    assert_int_equal(bt_surrogate_train(&set, &params, 1, 1, &s, NULL, NULL), BT_OK);
    snprintf(s.path[0], sizeof s.path[0], "landing.pitch");
    snprintf(s.path[1], sizeof s.path[1], "landing.sink_speed");
    return s;
}

static bt_status line(void* user, const double* x, int n, int* label) {
    (void)user;
    for (int i = 0; i < n; ++i) {
        assert_true(x[3 * i + 2] == 0.25); // an input without a distribution keeps its value
        label[i] = x[3 * i] + x[3 * i + 1] < 2;
    }
    return BT_OK;
}

static double below(double x) {
    return 0.5 * erfc(-x * M_SQRT1_2);
}

static void rows_hold_the_known_probabilities(void** state) {
    (void)state;
    bt_study* study = make_study(300);
    bt_surrogate s = train_surrogate();
    bt_reliability_result* r = calloc(1, sizeof *r);
    const bt_reliability_options options = {.high_fidelity = line, .threads = 2};
    assert_int_equal(bt_reliability_run(study, &s, &options, r, NULL), BT_OK);
    assert_int_equal(r->condition_count, 2);
    const bt_reliability_row* row[] = {&r->condition[0], &r->condition[1], &r->overall};
    // x0 + x1 is normal with the sum of the means and variance 2
    const double exact[] = {below((2 - 2.5) * M_SQRT1_2), below((2 + 0.5) * M_SQRT1_2),
                            below((2 - 1) * M_SQRT1_2)};
    for (int i = 0; i < 3; ++i) {
        BT_ASSERT_NEAR(row[i]->surrogate, exact[i], 0, 0.02); // hold-out error of some percent
        assert_true(row[i]->corrected_ci95.least < exact[i]);
        assert_true(row[i]->corrected_ci95.greatest > exact[i]);
        assert_int_equal(row[i]->high_fidelity_runs, 300);
        assert_int_equal(row[i]->high_fidelity_failed, 0);
        assert_true(row[i]->samples == 60000);
        assert_true(row[i]->outside_missed <= row[i]->surrogate &&
                    row[i]->surrogate <= row[i]->outside_engaged);
        BT_ASSERT_NEAR(row[i]->outside_engaged - row[i]->outside_missed, row[i]->outside_share, 0,
                       1e-12);
    }
    assert_string_equal(r->condition[1].parameter, "landing.pitch");
    assert_string_equal(r->condition[1].unit, "rad");
    assert_true(r->condition[1].value == -0.5);
    assert_string_equal(r->overall.parameter, "");
    free(r);
    free(study);
    bt_surrogate_destroy(&s);
}

static void frozen_inputs_stay_at_their_means(void** state) {
    (void)state;
    bt_study* study = make_study(0);
    study->reliability.others = BT_OTHERS_FROZEN;
    const bt_sampler sampler = bt_reliability_sampler(study, 0);
    assert_int_equal(sampler.distribution[0].kind, BT_NORMAL);
    assert_true(sampler.distribution[0].mean == 1.5 && sampler.distribution[0].sd == 1);
    assert_int_equal(sampler.distribution[1].kind, BT_CONSTANT);
    assert_true(sampler.distribution[1].mean == 1);
    const bt_sampler whole = bt_reliability_sampler(study, -1); // nothing is frozen as a whole
    assert_int_equal(whole.distribution[1].kind, BT_NORMAL);
    assert_true(whole.stream != sampler.stream);
    free(study);
}

static void without_true_runs_nothing_is_claimed(void** state) {
    (void)state;
    bt_study* study = make_study(0);
    bt_surrogate s = train_surrogate();
    bt_reliability_result* r = calloc(1, sizeof *r);
    const bt_reliability_options options = {.high_fidelity = line};
    assert_int_equal(bt_reliability_run(study, &s, &options, r, NULL), BT_OK);
    assert_true(isnan(r->overall.corrected) && isnan(r->overall.corrected_ci95.least));
    assert_true(r->overall.surrogate_ci95.greatest > r->overall.surrogate_ci95.least);
    free(r);
    free(study);
    bt_surrogate_destroy(&s);
}

static void results_are_the_same_for_1_2_and_3_threads(void** state) {
    (void)state;
    bt_study* study = make_study(100);
    bt_surrogate s = train_surrogate();
    bt_reliability_result* r[3];
    for (int i = 0; i < 3; ++i) {
        r[i] = calloc(1, sizeof *r[i]);
        const bt_reliability_options options = {.high_fidelity = line, .threads = i + 1};
        assert_int_equal(bt_reliability_run(study, &s, &options, r[i], NULL), BT_OK);
        r[i]->seconds = r[i]->overall.seconds = 0;
        for (int c = 0; c < 2; ++c)
            r[i]->condition[c].seconds = 0;
        assert_memory_equal(&r[i]->overall, &r[0]->overall, sizeof r[0]->overall);
        assert_memory_equal(r[i]->condition, r[0]->condition, 2 * sizeof *r[0]->condition);
    }
    for (int i = 0; i < 3; ++i)
        free(r[i]);
    free(study);
    bt_surrogate_destroy(&s);
}

static bt_status refuse(void* user, const double* x, int n, int* label) {
    (void)user;
    (void)x;
    (void)n;
    (void)label;
    return BT_ERR_INTERRUPTED;
}

static void errors_are_passed_up(void** state) {
    (void)state;
    bt_study* study = make_study(10);
    bt_surrogate s = train_surrogate();
    bt_reliability_result* r = calloc(1, sizeof *r);
    const bt_reliability_options interrupted = {.high_fidelity = refuse};
    assert_int_equal(bt_reliability_run(study, &s, &interrupted, r, NULL), BT_ERR_INTERRUPTED);
    atomic_int stop = 1;
    const bt_reliability_options stopped = {.high_fidelity = line, .stop = &stop};
    assert_int_equal(bt_reliability_run(study, &s, &stopped, r, NULL), BT_ERR_INTERRUPTED);
    snprintf(s.path[1], sizeof s.path[1], "landing.roll");
    bt_diag diag = {0};
    const bt_reliability_options plain = {.high_fidelity = line};
    assert_int_equal(bt_reliability_run(study, &s, &plain, r, &diag), BT_ERR_INPUT);
    assert_int_equal(diag.errors, 1);
    free(r);
    free(study);
    bt_surrogate_destroy(&s);
}

/* ---- the estimate, by hand ---- */

static void estimate_without_disagreement_is_the_surrogate_with_the_exact_bound(void** state) {
    (void)state;
    // one stratum: 1,000,000 samples, all engaged, 100 runs, none disagrees
    const bt_stratum strata[BT_STRATA] = {[2] = {1000000, 100, 100, 0, 0}};
    const bt_check_result r = bt_check_estimate(strata);
    assert_true(r.corrected == 1 && r.disagreement == 0);
    assert_true(r.corrected_ci95.greatest == 1);
    const double bound = -expm1(log(0.025) / 100);
    BT_ASSERT_NEAR(1 - r.corrected_ci95.least, bound, 1e-3, 0); // the pool adds 3.7e-6 in square
    BT_ASSERT_NEAR(r.disagreement_ci95.greatest, bound, 1e-9, 0);
}

static void estimate_weights_the_strata_by_their_share(void** state) {
    (void)state;
    // predicted missed, boundary: 1 of 4 is engaged; predicted engaged, interior: 2 of 10 are
    // missed
    const bt_stratum strata[BT_STRATA] = {
        [1] = {250000, 4, 4, 0, 1}, [2] = {500000, 10, 10, 0, 2}, [3] = {250000, 5, 5, 0, 0}};
    const bt_check_result r = bt_check_estimate(strata);
    BT_ASSERT_NEAR(r.corrected, 0.25 * 0.25 + 0.5 * 0.8 + 0.25, 1e-14, 0);
    BT_ASSERT_NEAR(r.disagreement, 0.25 * 0.25 + 0.5 * 0.2, 1e-14, 0);
}

static void failed_runs_widen_the_interval_both_ways(void** state) {
    (void)state;
    const bt_stratum sound[BT_STRATA] = {
        [0] = {500000, 50, 50, 0, 5}, [2] = {500000, 50, 50, 0, 5}};
    const bt_stratum failing[BT_STRATA] = {
        [0] = {500000, 50, 60, 10, 5}, [2] = {500000, 50, 60, 10, 5}};
    const bt_check_result a = bt_check_estimate(sound), b = bt_check_estimate(failing);
    BT_ASSERT_NEAR(a.corrected, b.corrected, 1e-14, 0);
    assert_true(b.corrected_ci95.least < a.corrected_ci95.least);
    assert_true(b.corrected_ci95.greatest > a.corrected_ci95.greatest);
}

static void a_stratum_without_a_run_may_be_anything(void** state) {
    (void)state;
    const bt_stratum strata[BT_STRATA] = {
        [0] = {100000, 0, 0, 0, 0}, [2] = {900000, 100000, 100000, 0, 0}};
    const bt_check_result r = bt_check_estimate(strata);
    BT_ASSERT_NEAR(r.corrected, 0.9, 1e-14, 0);
    BT_ASSERT_NEAR(r.corrected_ci95.greatest, 1, 0, 1e-3); // the tenth that nobody asked
    BT_ASSERT_NEAR(r.corrected_ci95.least, 0.9, 0, 1e-3);
}

static void plans_ask_every_stratum_and_pick_without_repetition(void** state) {
    (void)state;
    enum { N = 5000, RUNS = 400 };
    static int8_t label[N];
    static float decision[N];
    for (int i = 0; i < N; ++i) {
        decision[i] = (float)(4 * bt_rng_uniform(5, (uint64_t)i, 0) - 0.002);
        label[i] = decision[i] > 0 ? 1 : -1; // a handful are missed
    }
    const bt_pool pool = {N, label, decision};
    bt_check check;
    assert_int_equal(bt_check_plan(&pool, RUNS, 0.01, 7, 1, &check), BT_OK);
    assert_int_equal(check.picked_count, RUNS);
    int planned[BT_STRATA] = {0};
    static int seen[N];
    for (int i = 0; i < RUNS; ++i) {
        const int at = check.picked[i];
        assert_int_equal(seen[at]++, 0);
        ++planned[bt_check_stratum(&check, label[at], decision[at])];
    }
    int64_t total = 0;
    for (int k = 0; k < BT_STRATA; ++k) {
        assert_int_equal(planned[k], check.stratum[k].planned);
        assert_true((check.stratum[k].pool > 0) == (check.stratum[k].planned > 0));
        assert_true(check.stratum[k].planned <= check.stratum[k].pool);
        total += check.stratum[k].pool;
    }
    assert_true(total == N);
    // four times the expected error is boundary, and gets more than its share
    const int64_t boundary = check.stratum[1].pool + check.stratum[3].pool;
    BT_ASSERT_NEAR((double)boundary / N, 0.04, 0, 1e-3);
    assert_true(check.stratum[1].planned + check.stratum[3].planned > 0.04 * RUNS);
    free(check.picked);
    // more runs than samples: all of them, once
    const bt_pool few = {60, label, decision};
    assert_int_equal(bt_check_plan(&few, RUNS, 0.01, 7, 1, &check), BT_OK);
    assert_int_equal(check.picked_count, 60);
    free(check.picked);
}

/// The table as people read it; to be freed.
static char* printed(const bt_reliability_result* result) {
    char* text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    bt_report_table* table = bt_reliability_table(result);
    assert_int_equal(bt_report_table_print(table, out), BT_OK);
    bt_report_table_destroy(table);
    fclose(out);
    return text;
}

static void the_printed_table_names_conditions_and_what_was_not_checked(void** state) {
    (void)state;
    bt_study* study = make_study(20);
    bt_surrogate s = train_surrogate();
    bt_reliability_result* r = calloc(1, sizeof *r);
    const bt_reliability_options options = {.high_fidelity = line};
    assert_int_equal(bt_reliability_run(study, &s, &options, r, NULL), BT_OK);
    char* text = printed(r);
    assert_non_null(strstr(text, "landing.sink_speed"));
    assert_non_null(strstr(text, "  1.5 m/s  "));
    assert_non_null(strstr(text, "-28.65 deg")); // -0.5 rad
    assert_non_null(strstr(text, "all as distributed"));
    assert_non_null(strstr(text, " of 20 "));
    assert_non_null(strstr(text, "failed: 0 of 60 high-fidelity runs"));
    assert_null(strstr(text, "not checked"));
    r->overall.high_fidelity_runs = 0;
    free(text);
    text = printed(r);
    assert_non_null(strstr(text, "not checked"));
    free(text);
    free(r);
    free(study);
    bt_surrogate_destroy(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_hold_the_known_probabilities),
        cmocka_unit_test(frozen_inputs_stay_at_their_means),
        cmocka_unit_test(without_true_runs_nothing_is_claimed),
        cmocka_unit_test(results_are_the_same_for_1_2_and_3_threads),
        cmocka_unit_test(errors_are_passed_up),
        cmocka_unit_test(estimate_without_disagreement_is_the_surrogate_with_the_exact_bound),
        cmocka_unit_test(estimate_weights_the_strata_by_their_share),
        cmocka_unit_test(failed_runs_widen_the_interval_both_ways),
        cmocka_unit_test(a_stratum_without_a_run_may_be_anything),
        cmocka_unit_test(plans_ask_every_stratum_and_pick_without_repetition),
        cmocka_unit_test(the_printed_table_names_conditions_and_what_was_not_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
