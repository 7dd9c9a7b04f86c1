#include "reference.h"

/// Bytes of a result that belong to the outcome: all but the wall clock.
static void assert_same(bt_landing_result a, bt_landing_result b) {
    a.wall_s = b.wall_s = 0;
    assert_true(a.state_hash == b.state_hash);
    assert_memory_equal(&a.margin_m, &b.margin_m, sizeof a.margin_m);
    assert_memory_equal(a.bounces, b.bounces, sizeof a.bounces);
    assert_int_equal(a.outcome, b.outcome);
    assert_int_equal(a.mode, b.mode);
    assert_true(a.steps == b.steps && a.cable_steps == b.cable_steps);
    assert_true(a.throat_force_peak_N == b.throat_force_peak_N);
    assert_true(a.cable_tension_max_N == b.cable_tension_max_N);
}

enum { CASES = 5 };

static bt_model_params model_of(int k) {
    bt_model_params models[CASES] = {
        REFERENCE("landing.distance=5 m"), REFERENCE("landing.distance=9 m", "landing.roll=1 deg"),
        REFERENCE("deck.cable.pretension=30 kN"), REFERENCE("aircraft.hook.mass=115 kg"),
        REFERENCE("deck.cable.mesh.fine_length=0.08 m", "landing.off_centre=1 m")};
    return models[k];
}

static void the_same_landing_gives_the_same_bits(void** state) {
    (void)state;
    const bt_model_params model = model_of(1);
    bt_lander* lander = new_lander();
    const bt_landing_result first = land(lander, &model, NULL, NULL);
    for (int k = 0; k < 2; ++k)
        assert_same(first, land(lander, &model, NULL, NULL));
    bt_lander_destroy(lander);
}

/// A lander keeps airframe and cable between runs; which runs went before must not show.
static void what_was_landed_before_does_not_matter(void** state) {
    (void)state;
    bt_landing_result fresh[CASES];
    for (int k = 0; k < CASES; ++k) {
        const bt_model_params model = model_of(k);
        bt_lander* lander = new_lander();
        fresh[k] = land(lander, &model, NULL, NULL);
        bt_lander_destroy(lander);
    }
    static const int order[] = {3, 0, 4, 0, 1, 2, 1, 4, 3, 2};
    bt_lander* lander = new_lander();
    for (size_t i = 0; i < sizeof order / sizeof *order; ++i) {
        const bt_model_params model = model_of(order[i]);
        assert_same(fresh[order[i]], land(lander, &model, NULL, NULL));
    }
    bt_lander_destroy(lander);
}

static void look(void* user, const struct bt_landing_view* view) {
    (void)view;
    ++*(int64_t*)user;
}

static void being_watched_changes_nothing(void** state) {
    (void)state;
    const bt_model_params model = model_of(0);
    int64_t views = 0;
    bt_lander* lander = new_lander();
    const bt_landing_result alone = land(lander, &model, NULL, NULL);
    assert_same(alone, land(lander, &model, look, &views));
    assert_true(views == alone.steps + 1);
    bt_lander_destroy(lander);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_landing_gives_the_same_bits),
        cmocka_unit_test(what_was_landed_before_does_not_matter),
        cmocka_unit_test(being_watched_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
