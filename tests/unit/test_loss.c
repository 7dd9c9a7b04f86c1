#include "near.h"

#include "surrogate/loss.h"

/// k of n answers wrong, all |f| = 1: the best probability of being right is (n - k) / n, and the
/// loss is the entropy of that share.
static void loss_of_equal_answers_is_the_entropy_of_their_share(void** state) {
    (void)state;
    double margin[100];
    for (int wrong = 1; wrong < 50; wrong += 6) {
        for (int i = 0; i < 100; ++i)
            margin[i] = i < wrong ? -1 : 1;
        const double p = wrong / 100.0;
        const double entropy = -100 * (p * log(p) + (1 - p) * log(1 - p));
        BT_ASSERT_NEAR(bt_score_loss(margin, 100), entropy, 1e-12, 0);
    }
}

/// The unit of f does not matter: the slope takes it up.
static void loss_does_not_change_with_the_unit_of_f(void** state) {
    (void)state;
    const double f[] = {0.5, 2, -0.3, 1.2, 0.1, -0.7, 3, 0.9};
    double scaled[8];
    for (int i = 0; i < 8; ++i)
        scaled[i] = 12.5 * f[i];
    BT_ASSERT_NEAR(bt_score_loss(scaled, 8), bt_score_loss(f, 8), 1e-12, 0);
}

/// No slope helps answers that are no better than a coin or worse: log 2 each, not more.
static void answers_that_know_nothing_lose_log_two_each(void** state) {
    (void)state;
    const double coin[] = {1, -1, 2, -2}, worse[] = {-1, -2, 1};
    BT_ASSERT_NEAR(bt_score_loss(coin, 4), 4 * M_LN2, 1e-12, 0);
    BT_ASSERT_NEAR(bt_score_loss(worse, 3), 3 * M_LN2, 1e-12, 0);
}

static void right_answers_lose_nothing_and_none_lose_nothing(void** state) {
    (void)state;
    const double right[] = {1, 0.5, 30, 1e6};
    BT_ASSERT_NEAR(bt_score_loss(right, 4), 0, 0, 1e-100);
    assert_true(bt_score_loss(right, 0) == 0);
}

/// Equal numbers of right answers: the nearer miss loses less.
static void a_near_miss_loses_less_than_a_confident_error(void** state) {
    (void)state;
    const double near[] = {1, 1, 1, 1, -0.1}, far[] = {1, 1, 1, 1, -2};
    assert_true(bt_score_loss(near, 5) < 0.5 * bt_score_loss(far, 5));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loss_of_equal_answers_is_the_entropy_of_their_share),
        cmocka_unit_test(loss_does_not_change_with_the_unit_of_f),
        cmocka_unit_test(answers_that_know_nothing_lose_log_two_each),
        cmocka_unit_test(right_answers_lose_nothing_and_none_lose_nothing),
        cmocka_unit_test(a_near_miss_loses_less_than_a_confident_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
