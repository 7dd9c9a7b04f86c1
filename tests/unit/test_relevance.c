#include "near.h"

#include "surrogate/relevance.h"

#include <stdatomic.h>

enum { DIMS = 4, FOLDS = 5, COUNT = 2000 };

/// Answers that are right the more often the nearer the weights are to a target.
typedef struct landscape {
    double target[DIMS]; ///< log2 of the best weights
    int slope;           ///< right answers lost per fold and factor of two
    atomic_int trials;
} landscape;

static bt_status ask(void* user, const double* weight, int fold, int* correct) {
    landscape* land = user;
    double apart = 0;
    for (int k = 0; k < DIMS; ++k)
        apart += fabs(log2(weight[k]) - land->target[k]);
    *correct = 380 - fold - (int)(land->slope * apart);
    atomic_fetch_add(&land->trials, 1);
    return BT_OK;
}

static bt_status refuse(void* user, const double* weight, int fold, int* correct) {
    (void)user, (void)weight, (void)correct;
    return fold == 3 ? BT_ERR_INTERNAL : BT_OK;
}

static bt_relevance over(landscape* land, const bool* varies, int threads) {
    return (bt_relevance){DIMS, FOLDS, COUNT, varies, threads, ask, land};
}

static const bool all_vary[DIMS] = {true, true, true, true};

static void search_climbs_to_the_best_weights_for_any_number_of_threads(void** state) {
    (void)state;
    for (int threads = 1; threads <= 3; ++threads) {
        landscape land = {.target = {-1, 0, 3, 1}, .slope = 4};
        const bt_relevance relevance = over(&land, all_vary, threads);
        double weight[DIMS];
        assert_int_equal(bt_relevance_search(&relevance, weight), BT_OK);
        for (int k = 0; k < DIMS; ++k)
            assert_true(weight[k] == exp2(land.target[k]));
        // at most four steps of each input in each of three turns, and the start
        assert_true(land.trials <= FOLDS * (1 + 3 * 4 * DIMS));
    }
}

/// A landscape without slope: no step gains, whatever its weights.
static void weights_that_gain_nothing_stay(void** state) {
    (void)state;
    landscape land = {.target = {2, 0, 0, 0}, .slope = 0};
    const bt_relevance relevance = over(&land, all_vary, 2);
    double weight[DIMS];
    assert_int_equal(bt_relevance_search(&relevance, weight), BT_OK);
    for (int k = 0; k < DIMS; ++k)
        assert_true(weight[k] == 1);
    assert_int_equal(land.trials, FOLDS * (1 + 4 * DIMS)); // one turn is enough to see it
}

/// 1,890 of 2,000 are right, half a standard error is 5.1 answers: a gain of 1 per fold is noise,
/// of 2 per fold is not.
static void less_than_half_a_standard_error_is_no_gain(void** state) {
    (void)state;
    for (int slope = 1; slope <= 2; ++slope) {
        landscape land = {.target = {1, 0, 0, 0}, .slope = slope};
        const bt_relevance relevance = over(&land, all_vary, 2);
        double weight[DIMS];
        assert_int_equal(bt_relevance_search(&relevance, weight), BT_OK);
        assert_true(weight[0] == slope && weight[1] == 1 && weight[2] == 1 && weight[3] == 1);
    }
}

static void weights_stay_between_an_eighth_and_sixteen(void** state) {
    (void)state;
    landscape land = {.target = {9, -9, 0, 0}, .slope = 4};
    const bt_relevance relevance = over(&land, all_vary, 2);
    double weight[DIMS];
    assert_int_equal(bt_relevance_search(&relevance, weight), BT_OK);
    assert_true(weight[0] == 16 && weight[1] == 0.125 && weight[2] == 1 && weight[3] == 1);
}

static void inputs_that_never_varied_keep_the_weight_one(void** state) {
    (void)state;
    landscape land = {.target = {2, 2, 2, 2}, .slope = 4};
    const bool some[DIMS] = {true, false, true, false}, one[DIMS] = {false, true, false, false};
    bt_relevance relevance = over(&land, some, 2);
    double weight[DIMS];
    assert_int_equal(bt_relevance_search(&relevance, weight), BT_OK);
    assert_true(weight[0] == 4 && weight[1] == 1 && weight[2] == 4 && weight[3] == 1);
    land.trials = 0;
    relevance = over(&land, one, 2);
    assert_int_equal(bt_relevance_search(&relevance, weight), BT_OK);
    assert_true(weight[1] == 1);
    assert_int_equal(land.trials, 0); // gamma is its weight
}

static void what_a_trial_returns_ends_the_search(void** state) {
    (void)state;
    const bt_relevance relevance = {DIMS, FOLDS, COUNT, all_vary, 2, refuse, NULL};
    double weight[DIMS];
    assert_int_equal(bt_relevance_search(&relevance, weight), BT_ERR_INTERNAL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(search_climbs_to_the_best_weights_for_any_number_of_threads),
        cmocka_unit_test(weights_that_gain_nothing_stay),
        cmocka_unit_test(less_than_half_a_standard_error_is_no_gain),
        cmocka_unit_test(weights_stay_between_an_eighth_and_sixteen),
        cmocka_unit_test(inputs_that_never_varied_keep_the_weight_one),
        cmocka_unit_test(what_a_trial_returns_ends_the_search),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
