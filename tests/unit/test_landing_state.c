/// A landing stepped, paused, copied and compared from outside.
#include "reference.h"

#include "landing/model.h"
#include "landing/view.h"

typedef struct flight {
    bt_landing_model* model;
    bt_landing_state* state;
} flight;

static flight begin(const bt_model_params* params) {
    flight f;
    assert_int_equal(bt_landing_model_create(&f.model), BT_OK);
    assert_int_equal(bt_landing_model_prepare(f.model, params, NULL), BT_OK);
    assert_int_equal(bt_landing_state_create(f.model, &f.state), BT_OK);
    assert_true(bt_landing_start(f.model, f.state));
    return f;
}

static void end(flight* f) {
    bt_landing_state_destroy(f->state);
    bt_landing_model_destroy(f->model);
}

static bt_landing_result fly_on(const flight* f, bt_landing_state* state) {
    bt_landing_result result;
    while (bt_landing_step(f->model, state))
        ;
    bt_landing_finish(f->model, state, &result);
    return result;
}

static void stepping_from_outside_is_the_lander_s_run(void** state) {
    (void)state;
    const bt_model_params params = REFERENCE("landing.distance=5 m");
    bt_lander* lander = new_lander();
    const bt_landing_result whole = land(lander, &params, NULL, NULL);
    flight f = begin(&params);
    const bt_landing_result stepped = fly_on(&f, f.state);
    assert_true(stepped.state_hash == whole.state_hash);
    assert_int_equal(stepped.steps, whole.steps);
    assert_int_equal(stepped.cable_steps, whole.cable_steps);
    assert_int_equal(stepped.mode, whole.mode);
    assert_true(stepped.margin_m == whole.margin_m);
    // it is over: nothing moves any more
    assert_false(bt_landing_step(f.model, f.state));
    bt_landing_result again;
    bt_landing_finish(f.model, f.state, &again);
    assert_true(again.state_hash == stepped.state_hash);
    end(&f);
    bt_lander_destroy(lander);
}

/// A copy taken in the middle of the meeting goes on as the original does, wherever it lies.
static void a_copy_goes_on_as_the_original(void** state) {
    (void)state;
    const bt_model_params params = REFERENCE("landing.distance=8 m");
    flight f = begin(&params);
    bt_landing_state* copy;
    assert_int_equal(bt_landing_state_create(f.model, &copy), BT_OK);
    bt_landing_view view;
    do {
        assert_true(bt_landing_step(f.model, f.state));
        bt_landing_observe(f.model, f.state, false, &view);
    } while (!(view.cable_awake && view.tyre_cable_force_N[BT_LEG_LEFT] > 0));
    bt_landing_state_copy(f.model, copy, f.state);
    assert_true(bt_landing_state_equal(f.model, copy, f.state));
    bt_landing_step(f.model, copy);
    assert_false(bt_landing_state_equal(f.model, copy, f.state));
    bt_landing_step(f.model, f.state);
    assert_true(bt_landing_state_equal(f.model, copy, f.state));

    const bt_landing_result first = fly_on(&f, f.state);
    assert_false(bt_landing_state_equal(f.model, copy, f.state));
    const bt_landing_result second = fly_on(&f, copy);
    assert_true(bt_landing_state_equal(f.model, copy, f.state));
    assert_true(first.state_hash == second.state_hash);
    assert_true(first.margin_m == second.margin_m);
    assert_int_equal(first.bounce_count, second.bounce_count);
    bt_landing_state_destroy(copy);
    end(&f);
}

/// Parts that do not change stay, and with them the states; a new deck makes states of before
/// useless, and says so.
static void preparing_again_keeps_what_has_not_changed(void** state) {
    (void)state;
    bt_model_params params = REFERENCE("landing.distance=5 m");
    flight f = begin(&params);
    const bt_landing_result first = fly_on(&f, f.state);
    params.landing.pitch_rad = 0;
    assert_int_equal(bt_landing_model_prepare(f.model, &params, NULL), BT_OK);
    assert_true(bt_landing_state_fits(f.model, f.state));
    params.landing.pitch_rad = REFERENCE("landing.distance=5 m").landing.pitch_rad;
    assert_int_equal(bt_landing_model_prepare(f.model, &params, NULL), BT_OK);
    assert_true(bt_landing_start(f.model, f.state));
    assert_true(fly_on(&f, f.state).state_hash == first.state_hash);

    params.deck.cable.pretension_N *= 1.01;
    assert_int_equal(bt_landing_model_prepare(f.model, &params, NULL), BT_OK);
    assert_false(bt_landing_state_fits(f.model, f.state));
    end(&f);
}

/// Distance and sinking speed at the first touch are those asked for, whatever the lift.
static void the_glide_is_held_until_the_first_touch(void** state) {
    (void)state;
    const bt_model_params params = REFERENCE("aircraft.lift_ratio=0", "landing.sink_speed=0.9 m/s",
                                             "landing.pitch=0 deg", "landing.distance=2 m");
    flight f = begin(&params);
    bt_landing_view view;
    bool touched = false;
    do {
        bt_landing_observe(f.model, f.state, false, &view);
        if (view.time_s > -1e-12 && !touched) {
            touched = true;
            BT_ASSERT_NEAR(view.time_s, 0, 0, 1e-15);
            BT_ASSERT_NEAR(view.v[2], -0.9, 0, 1e-9);
            BT_ASSERT_NEAR(view.hook_shoe_m[0], -2, 0, 1e-9);
        }
    } while (bt_landing_step(f.model, f.state));
    assert_true(touched);
    end(&f);
}

static void an_aircraft_that_comes_to_rest_has_stopped(void** state) {
    (void)state;
    const bt_model_params params =
        REFERENCE("aircraft.lift_ratio=0", "landing.horizontal_speed=5 m/s",
                  "landing.distance=60 m", "aircraft.hook.deck_contact.friction=3");
    flight f = begin(&params);
    const bt_landing_result r = fly_on(&f, f.state);
    assert_int_equal(r.outcome, BT_MISSED);
    assert_string_equal(bt_mode_name(r.mode), "stopped");
    assert_true(isnan(r.margin_m));
    end(&f);
}

static void states_beyond_the_model_are_said_and_beyond_a_law_fail(void** state) {
    (void)state;
    bt_model_params params = REFERENCE("landing.sink_speed=12 m/s", "landing.distance=14 m");
    flight f = begin(&params);
    const bt_landing_result r = fly_on(&f, f.state);
    assert_true(bt_remarks_has(&r.remarks, BT_REMARK_STRUT_BOTTOMED_LEFT) ||
                r.outcome == BT_FAILED);
    assert_true(r.remarks.seen != 0);
    end(&f);
    params = REFERENCE("landing.distance=5 m");
    f = begin(&params);
    assert_int_equal(fly_on(&f, f.state).remarks.seen, 0);
    end(&f);
}

/// A nose-high landing comes down hook first and sinks on with its wheels in the air: the tail
/// meets the deck when its height in the glide is used up, soon after the hook.
static void a_tail_that_comes_down_to_the_deck_is_said(void** state) {
    (void)state;
    const bt_model_params none = REFERENCE("landing.pitch=8 deg");
    const bt_model_params low =
        REFERENCE("landing.pitch=8 deg", "aircraft.tail.x=-8 m", "aircraft.tail.z=-2.35 m");
    const bt_model_params high =
        REFERENCE("landing.pitch=8 deg", "aircraft.tail.x=-8 m", "aircraft.tail.z=-1 m");
    bt_landing_view view;
    flight f = begin(&low);
    bt_landing_observe(f.model, f.state, false, &view);
    // heights from the centre of gravity: the shoe arc's centre, the tail
    const bt_hook_params* hook = &low.aircraft.hook;
    const double pitch = low.landing.pitch_rad, c = cos(pitch), s = sin(pitch);
    const double shoe_x = hook->pivot_x_m - hook->length_m * cos(view.hook_angle_rad);
    const double shoe_z = hook->pivot_z_m - hook->length_m * sin(view.hook_angle_rad);
    const double tail_m = view.hook_shoe_m[2] + (-8 - shoe_x) * s + (-2.35 - shoe_z) * c;
    const double expected_s = view.time_s + tail_m / low.landing.sink_speed_mps;
    const bt_landing_result struck = fly_on(&f, f.state);
    end(&f);
    assert_true(bt_remarks_has(&struck.remarks, BT_REMARK_TAIL_CLEARANCE));
    BT_ASSERT_NEAR(struck.remarks.time_s[BT_REMARK_TAIL_CLEARANCE], expected_s, 0, 5e-4);

    f = begin(&none);
    const bt_landing_result unseen = fly_on(&f, f.state);
    end(&f);
    f = begin(&high);
    const bt_landing_result clear = fly_on(&f, f.state);
    end(&f);
    assert_int_equal(unseen.remarks.seen, 0);
    assert_int_equal(clear.remarks.seen, 0);
    // it is looked at, and pushes on nothing
    assert_true(struck.state_hash == unseen.state_hash && clear.state_hash == unseen.state_hash);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stepping_from_outside_is_the_lander_s_run),
        cmocka_unit_test(a_copy_goes_on_as_the_original),
        cmocka_unit_test(the_glide_is_held_until_the_first_touch),
        cmocka_unit_test(an_aircraft_that_comes_to_rest_has_stopped),
        cmocka_unit_test(states_beyond_the_model_are_said_and_beyond_a_law_fail),
        cmocka_unit_test(a_tail_that_comes_down_to_the_deck_is_said),
        cmocka_unit_test(preparing_again_keeps_what_has_not_changed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
