#include "near.h"

#include "base/rng.h"
#include "reliability/rounds.h"

#include <stdlib.h>
#include <string.h>

enum { BEGIN = 256, NEXT = 128 };

/// One standard normal input; engaged below 1.
static bt_mixture* normal_mixture(void) {
    bt_study* study = calloc(1, sizeof *study);
    bt_mixture* m = NULL;
    study->input_count = 1;
    study->inputs[0].random = true;
    study->inputs[0].distribution = (bt_distribution){.kind = BT_NORMAL, .sd = 1};
    assert_int_equal(bt_mixture_create(study, &m, NULL), BT_OK);
    free(study);
    return m;
}

static bt_evidence normal_landings(const bt_mixture* m, bool failed) {
    bt_evidence e;
    assert_int_equal(bt_evidence_create(1, BEGIN, &e), BT_OK);
    for (e.count = 0; e.count < BEGIN; ++e.count) {
        const double u = bt_rng_uniform(4, (uint64_t)e.count, 0);
        bt_mixture_point(m, 0, &u, &e.x[e.count]);
        e.label[e.count] = (int8_t)(failed ? -1 : e.x[e.count] < 1);
    }
    return e;
}

static bt_rounds rounds_of(int threads) {
    return (bt_rounds){
        .seed = 4,
        .threads = threads,
        .chosen = {.C = 100, .gamma = 0.3, .weight = {1}, .cv_count = 100, .cv_correct = 95}};
}

static void rounds_begin_at_powers_of_two_and_their_means(void** state) {
    (void)state;
    static const int begin[] = {0, 128, 192, 256, 384, 512, 768, 1024, 1536, 2048};
    for (int i = 0; i + 1 < 10; ++i)
        for (int run = begin[i]; run < begin[i + 1]; ++run)
            assert_int_equal(bt_round_end(run), begin[i + 1]);
    assert_int_equal(bt_round_first(10), 128);
    assert_int_equal(bt_round_first(8192), 1024);
    assert_int_equal(bt_round_first(8191), 768);
}

/// The densities are those of the points: they sum to 1, and half the landings crowd about the
/// boundary.
static void the_unsure_half_lies_at_the_boundary(void** state) {
    (void)state;
    bt_mixture* m = normal_mixture();
    bt_evidence e = normal_landings(m, false);
    bt_rounds rounds = rounds_of(2);
    bt_surrogate s;
    double x[NEXT], log_density[NEXT], weight = 0, square = 0;
    assert_int_equal(bt_rounds_classifier(&rounds, &e, BEGIN, &s, NULL), BT_OK);
    assert_int_equal(bt_rounds_draw(&rounds, m, &s, BEGIN, NEXT, 0.5, x, log_density), BT_OK);
    int near = 0;
    for (int i = 0; i < NEXT; ++i) {
        const double w = exp(bt_mixture_log_density(m, &x[i], NULL) - log_density[i]);
        near += fabs(x[i] - 1) < 0.25;
        weight += w;
        square += w * w;
        assert_true(w <= 2.0000001); // never less than half the mixture's density
    }
    // a quarter of a deviation about 1 holds 12 % of the normal
    assert_true(near > NEXT * 0.4);
    const double mean = weight / NEXT, sd = sqrt((square / NEXT - mean * mean) / NEXT);
    BT_ASSERT_NEAR(mean, 1, 0, 4.5 * sd);
    bt_surrogate_destroy(&s);
    bt_evidence_destroy(&e);
    free(m);
}

static void points_do_not_depend_on_the_threads(void** state) {
    (void)state;
    bt_mixture* m = normal_mixture();
    bt_evidence e = normal_landings(m, false);
    double x[2][NEXT], log_density[2][NEXT];
    for (int i = 0; i < 2; ++i) {
        bt_rounds rounds = rounds_of(1 + 2 * i);
        bt_surrogate s;
        assert_int_equal(bt_rounds_classifier(&rounds, &e, BEGIN, &s, NULL), BT_OK);
        assert_int_equal(bt_rounds_draw(&rounds, m, &s, BEGIN, NEXT, 0.3, x[i], log_density[i]),
                         BT_OK);
        bt_surrogate_destroy(&s);
    }
    assert_memory_equal(x[0], x[1], sizeof x[0]);
    assert_memory_equal(log_density[0], log_density[1], sizeof log_density[0]);
    bt_evidence_destroy(&e);
    free(m);
}

/// When no landing has an outcome nothing is known, and the next ones come from the mixture alone.
static void failed_landings_teach_nothing(void** state) {
    (void)state;
    bt_mixture* m = normal_mixture();
    bt_evidence e = normal_landings(m, true);
    const bt_surrogate_params params = {.folds = 5};
    bt_rounds rounds = rounds_of(1);
    rounds.params = &params;
    bt_surrogate s;
    double x[NEXT], log_density[NEXT];
    assert_int_equal(bt_rounds_classifier(&rounds, &e, BEGIN, &s, NULL), BT_OK);
    assert_true(s.constant);
    assert_int_equal(bt_rounds_draw(&rounds, m, &s, BEGIN, NEXT, 0.5, x, log_density), BT_OK);
    for (int i = 0; i < NEXT; ++i)
        BT_ASSERT_NEAR(log_density[i], bt_mixture_log_density(m, &x[i], NULL), 1e-12, 0);
    bt_surrogate_destroy(&s);
    bt_evidence_destroy(&e);
    free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rounds_begin_at_powers_of_two_and_their_means),
        cmocka_unit_test(the_unsure_half_lies_at_the_boundary),
        cmocka_unit_test(points_do_not_depend_on_the_threads),
        cmocka_unit_test(failed_landings_teach_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
