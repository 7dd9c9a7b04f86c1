#include "near.h"

#include "surrogate/relevance.h"

#include <stdatomic.h>

enum { DIMS = 4, FOLDS = 5 };

/// A loss that grows with the distance from the best weights.
typedef struct landscape {
    double target[DIMS]; ///< log2 of the best weights
    double slope;        ///< share of the loss per factor of two
    atomic_int trials;
} landscape;

static bt_status ask(void* user, const double* weight, int fold, double* loss) {
    landscape* land = user;
    double apart = 0;
    for (int k = 0; k < DIMS; ++k)
        apart += fabs(log2(weight[k]) - land->target[k]);
    *loss = (100 + fold) * (1 + land->slope * apart);
    atomic_fetch_add(&land->trials, 1);
    return BT_OK;
}

static bt_status refuse(void* user, const double* weight, int fold, double* loss) {
    (void)user, (void)weight;
    *loss = 1;
    return fold == 3 ? BT_ERR_INTERNAL : BT_OK;
}

/// Only one input matters, and below weight 2 nothing can be trained.
static bt_status rule_out(void* user, const double* weight, int fold, double* loss) {
    (void)user, (void)fold;
    *loss = weight[0] < 2 ? INFINITY : weight[0];
    return BT_OK;
}

static bt_relevance over(landscape* land, const bool* varies, int threads) {
    return (bt_relevance){DIMS, FOLDS, varies, threads, ask, land};
}

static const bool all_vary[DIMS] = {true, true, true, true};

static void search_descends_to_the_best_weights_for_any_number_of_threads(void** state) {
    (void)state;
    for (int threads = 1; threads <= 3; ++threads) {
        landscape land = {.target = {-1, 0, 3, 1.5}, .slope = 0.1};
        const bt_relevance relevance = over(&land, all_vary, threads);
        double weight[DIMS];
        assert_int_equal(bt_relevance_search(&relevance, weight), BT_OK);
        for (int k = 0; k < DIMS; ++k)
            BT_ASSERT_NEAR(weight[k], exp2(land.target[k]), 1e-15, 0);
        // the start; five moves by 2, then one by sqrt 2; each begins with a look at all eight
        // neighbours, and after a move the way back is not tried again
        assert_int_equal(land.trials, FOLDS * (1 + (8 + 5 * 7) + (8 + 7)));
    }
}

/// Going there and back leaves a weight as it was, to the bit.
static void weights_are_powers_of_the_square_root_of_two(void** state) {
    (void)state;
    landscape land = {.target = {-1.5, 0.5, 2, -3}, .slope = 0.1};
    const bt_relevance relevance = over(&land, all_vary, 1);
    double weight[DIMS];
    assert_int_equal(bt_relevance_search(&relevance, weight), BT_OK);
    assert_true(weight[0] == 0.25 * M_SQRT2 && weight[1] == M_SQRT2);
    assert_true(weight[2] == 4 && weight[3] == 0.125);
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
    assert_int_equal(land.trials, FOLDS * (1 + 2 * 2 * DIMS)); // one look round at each stride
}

/// A factor of two away from the best weight the loss is 1 + slope: less than 1 % is no gain.
static void less_than_one_percent_is_no_gain(void** state) {
    (void)state;
    for (int i = 0; i < 2; ++i) {
        landscape land = {.target = {1, 0, 0, 0}, .slope = i ? 0.0103 : 0.0100};
        const bt_relevance relevance = over(&land, all_vary, 2);
        double weight[DIMS];
        assert_int_equal(bt_relevance_search(&relevance, weight), BT_OK);
        assert_true(weight[0] == i + 1 && weight[1] == 1 && weight[2] == 1 && weight[3] == 1);
    }
}

static void weights_stay_between_a_sixteenth_and_sixteen(void** state) {
    (void)state;
    landscape land = {.target = {9, -9, 0, 0}, .slope = 1};
    const bt_relevance relevance = over(&land, all_vary, 2);
    double weight[DIMS];
    assert_int_equal(bt_relevance_search(&relevance, weight), BT_OK);
    assert_true(weight[0] == 16 && weight[1] == 0.0625 && weight[2] == 1 && weight[3] == 1);
}

static void inputs_that_never_varied_keep_the_weight_one(void** state) {
    (void)state;
    landscape land = {.target = {2, 2, 2, 2}, .slope = 0.1};
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

static void weights_that_cannot_be_trained_with_are_left(void** state) {
    (void)state;
    const bt_relevance relevance = {DIMS, FOLDS, all_vary, 2, rule_out, NULL};
    double weight[DIMS];
    assert_int_equal(bt_relevance_search(&relevance, weight), BT_OK);
    assert_true(weight[0] == 2);
}

static void what_a_trial_returns_ends_the_search(void** state) {
    (void)state;
    const bt_relevance relevance = {DIMS, FOLDS, all_vary, 2, refuse, NULL};
    double weight[DIMS];
    assert_int_equal(bt_relevance_search(&relevance, weight), BT_ERR_INTERNAL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(search_descends_to_the_best_weights_for_any_number_of_threads),
        cmocka_unit_test(weights_are_powers_of_the_square_root_of_two),
        cmocka_unit_test(weights_that_gain_nothing_stay),
        cmocka_unit_test(less_than_one_percent_is_no_gain),
        cmocka_unit_test(weights_stay_between_a_sixteenth_and_sixteen),
        cmocka_unit_test(inputs_that_never_varied_keep_the_weight_one),
        cmocka_unit_test(weights_that_cannot_be_trained_with_are_left),
        cmocka_unit_test(what_a_trial_returns_ends_the_search),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
