/// Aircraft that roll in: how they stand, that they stay so, what is refused, and that a hook close
/// behind the wheels comes before the wire is back.
#include "reference.h"

#include "landing/parts.h"
#include "mechanics/vec.h"
#include "tables.h"

#define ROLLING                                                                                    \
    "landing.start=rolling", "aircraft.lift_ratio=0.3", "landing.distance=16 m",                   \
        "landing.horizontal_speed=50 m/s"

/* ---- standing ---- */

typedef struct standing {
    bt_landing_model* model;
    bt_landing_state* state;
} standing;

static standing stand(const bt_model_params* params) {
    standing s;
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    assert_int_equal(bt_landing_model_create(&s.model), BT_OK);
    if (bt_landing_model_prepare(s.model, params, &diag) != BT_OK)
        fail_msg("refused: %s", kept.text);
    assert_int_equal(bt_landing_state_create(s.model, &s.state), BT_OK);
    assert_true(bt_landing_start(s.model, s.state));
    return s;
}

static void leave(standing* s) {
    bt_landing_state_destroy(s->state);
    bt_landing_model_destroy(s->model);
}

static void masses(const bt_aircraft_params* a, double mass[BT_BODY_COUNT]) {
    mass[BT_BODY_HOOK] = a->hook.mass_kg;
    mass[BT_BODY_FUSELAGE] = a->mass_kg - a->hook.mass_kg;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const bt_gear_params* gear = leg == BT_LEG_NOSE ? &a->nose_gear : &a->main_gear;
        mass[BT_BODY_NOSE_PISTON + leg] = gear->piston_mass_kg;
        mass[BT_BODY_NOSE_WHEEL + leg] = gear->wheel_mass_kg;
        mass[BT_BODY_FUSELAGE] -= gear->piston_mass_kg + gear->wheel_mass_kg;
    }
}

/// Weight, lift, tyre and hook forces balance, and so do their moments about the wire; the hook
/// slides without friction, so that nothing acts along the deck.
static void the_loads_are_those_of_statics(void** state) {
    (void)state;
    const bt_model_params params = REFERENCE(ROLLING, "aircraft.hook.deck_contact.friction=0");
    standing s = stand(&params);
    const bt_stance* stance = &s.model->stance;
    const double *q = s.state->airframe.q, g = params.deck.gravity_mps2;
    double mass[BT_BODY_COUNT], force_N = 0, moment_Nm = 0, lift_point[3];
    masses(&params.aircraft, mass);
    for (int body = 0; body < BT_BODY_COUNT; ++body) {
        force_N -= mass[body] * g;
        moment_Nm -= mass[body] * g * q[7 * body];
    }
    const bt_motion motion = {
        .q = q, .v = s.state->airframe.v, .rotation = s.state->airframe.rotation};
    bt_point_position(&motion, BT_BODY_FUSELAGE, s.model->airframe.lift.point_m, lift_point);
    const double lift_N = 0.3 * params.aircraft.mass_kg * g;
    force_N += lift_N + stance->hook_N;
    double hook_m[3];
    bt_shoe_lowest(&s.model->airframe.shoe_contact, &motion, BT_BODY_HOOK, hook_m);
    moment_Nm += lift_N * lift_point[0] + stance->hook_N * hook_m[0];
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        force_N += stance->load_N[leg];
        moment_Nm += stance->load_N[leg] * q[7 * (BT_BODY_NOSE_WHEEL + leg)];
    }
    const double weight_N = params.aircraft.mass_kg * g;
    BT_VERIFY("rolling", "forces of the stance over weight", force_N / weight_N, 0, 1e-9,
              "statics");
    BT_VERIFY("rolling", "moments of the stance over weight times 1 m", moment_Nm / weight_N, 0,
              1e-8, "statics");
    assert_true(stance->hook_N > 1e3 && stance->hook_N < 1e4);
    assert_true(stance->load_N[BT_LEG_NOSE] > 0.1 * (weight_N - lift_N));
    assert_true(stance->load_N[BT_LEG_LEFT] == stance->load_N[BT_LEG_RIGHT]);
    leave(&s);
}

/// The largest motion over the first 0.1 s.
static double drift_of(const bt_model_params* params) {
    standing s = stand(params);
    const bt_state* a = &s.state->airframe;
    double first[7 * BT_BODY_COUNT], most = 0;
    memcpy(first, a->q, sizeof first);
    while (a->time_s < 0.1) {
        assert_true(bt_landing_step(s.model, s.state));
        assert_false(s.state->wire[0].awake);
        for (int body = 0; body < BT_BODY_COUNT; ++body)
            for (int i = 1; i < 3; ++i)
                most = fmax(most, fabs(a->q[7 * body + i] - first[7 * body + i]));
    }
    assert_true(a->q[0] - first[0] > 4.9);
    leave(&s);
    return most;
}

static void nothing_moves_until_the_wire(void** state) {
    (void)state;
    const bt_model_params rigid = REFERENCE(ROLLING, "landing.distance=25 m");
    BT_VERIFY("rolling", "largest motion up, down or aside in 0.1 s, m", drift_of(&rigid), 0, 1e-6,
              "statics");
    const bt_model_params bends = REFERENCE(ROLLING, "landing.distance=25 m",
                                            "aircraft.hook.shank_bending_stiffness=1e6 N*m2");
    BT_VERIFY("rolling", "the same, shank of 1 MN m^2", drift_of(&bends), 0, 1e-6, "statics");
    const bt_model_params heaves =
        REFERENCE(ROLLING, "landing.distance=25 m", "deck.motion.heave.acceleration=1 m/s2");
    BT_VERIFY("rolling", "the same, deck accelerating by 1 m/s2", drift_of(&heaves), 0, 1e-6,
              "statics");
}

/* ---- rolling ---- */

static bt_landing_result roll(const bt_model_params* model) {
    bt_lander* lander = new_lander();
    const bt_landing_result result = land(lander, model, NULL, NULL);
    bt_lander_destroy(lander);
    return result;
}

static void pitch_roll_and_sink_speed_play_no_part(void** state) {
    (void)state;
    const bt_model_params a = REFERENCE(ROLLING);
    const bt_model_params b = REFERENCE(ROLLING, "landing.pitch=7 deg", "landing.roll=2 deg",
                                        "landing.sink_speed=0.01 m/s");
    assert_true(roll(&a).state_hash == roll(&b).state_hash);
}

/// The way before the wire changes nothing but the speed that the hook's friction takes.
static void the_way_before_the_wire_plays_no_part(void** state) {
    (void)state;
    const bt_model_params a = REFERENCE(ROLLING, "aircraft.hook.deck_contact.friction=0");
    bt_model_params b = a;
    b.landing.distance_m = 24;
    const bt_landing_result near = roll(&a), far = roll(&b);
    assert_int_equal(near.mode, far.mode);
    BT_ASSERT_NEAR(near.margin_m, far.margin_m, 0, 5e-4);
    BT_ASSERT_NEAR(far.time_of_contact_s - near.time_of_contact_s, 8. / 50, 0, 1e-3);
}

/// Moves the pivot until the hook stands `behind_m` behind the main wheels.
static void couple(bt_model_params* params, double behind_m) {
    for (int turn = 0; turn < 3; ++turn) {
        standing s = stand(params);
        const bt_glide* at = &s.model->stance.at;
        params->aircraft.hook.pivot_x_m += at->tyre_m[BT_LEG_LEFT][0] - at->hook_m[0] - behind_m;
        leave(&s);
    }
}

/// The wire is still flat when a hook comes that stands close behind the wheels: only a low lip
/// goes under it. A hook far behind finds it up again.
static void a_short_coupled_hook_needs_a_low_lip(void** state) {
    (void)state;
    static const struct {
        double behind_m, lip_m;
        bt_outcome outcome;
    } cases[] = {{2.2, 0.030, BT_MISSED},
                 {2.2, 0.013, BT_ENGAGED},
                 {7, 0.030, BT_ENGAGED},
                 {7, 0.013, BT_ENGAGED}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        bt_model_params m = REFERENCE(ROLLING, "landing.distance_from=main_wheels",
                                      "aircraft.hook.profile.throat_length=45 mm");
        m.aircraft.hook.profile.lip_height_m = cases[k].lip_m;
        couple(&m, cases[k].behind_m);
        const bt_landing_result r = roll(&m);
        if (r.outcome != cases[k].outcome)
            fail_msg("%g m behind the wheels, lip at %g m: %s, margin %g m", cases[k].behind_m,
                     cases[k].lip_m, bt_outcome_name(r.outcome), r.margin_m);
    }
}

/* ---- what is refused ---- */

static void refused(const bt_model_params* model, const char* key, const char* advice) {
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    bt_lander* lander = new_lander();
    assert_int_equal(bt_lander_prepare(lander, model, &diag), BT_ERR_INPUT);
    if (!strstr(kept.text, key) || !strstr(kept.text, advice))
        fail_msg("%s, %s expected in: %s", key, advice, kept.text);
    bt_lander_destroy(lander);
}

static void an_aircraft_that_cannot_stand_is_refused(void** state) {
    (void)state;
    const bt_model_params good = REFERENCE(ROLLING);
    bt_model_params m = good;
    m.aircraft.main_gear.station_m = 0.1;
    refused(&m, "aircraft.main_gear.station: 0.1 m", "tips on its tail");
    m = good;
    m.aircraft.lift_ratio = 1;
    refused(&m, "aircraft.lift_ratio: 1", "at most 0.9");
    m = good;
    m.aircraft.main_gear.oleo.precharge_Pa = 2e5;
    refused(&m, "aircraft.main_gear.oleo.precharge: the strut bottoms", "times as much would do");
    m = good;
    m.aircraft.hook.length_m = 1.4;
    m.aircraft.hook.mass_centre_m = 0.9;
    refused(&m, "aircraft.hook.length: 1.4 m: the hook hangs", "at least 1.");
    m = good;
    m.aircraft.tail.x_m = -8;
    m.aircraft.tail.z_m = -3;
    refused(&m, "aircraft.tail.z: -3 m: the tail lies on the deck", "would do");
    m = good;
    m.landing.distance_m = 8;
    refused(&m, "landing.distance: 8 m", "at least 12.69 m");
    m = good;
    m.landing.lift.law = BT_LIFT_AERODYNAMIC;
    m.landing.lift.zero_lift_angle_rad = 0.1;
    refused(&m, "landing.lift.zero_lift_angle", "would do");
}

/// What the message says would do, does.
static void what_would_do_does(void** state) {
    (void)state;
    bt_model_params m = REFERENCE(ROLLING);
    m.aircraft.main_gear.oleo.precharge_Pa = 2e5;
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    bt_lander* lander = new_lander();
    assert_int_equal(bt_lander_prepare(lander, &m, &diag), BT_ERR_INPUT);
    const char* said = strstr(kept.text, "rolling; ");
    assert_non_null(said);
    m.aircraft.main_gear.oleo.precharge_Pa *= atof(said + strlen("rolling; "));
    assert_int_equal(bt_lander_prepare(lander, &m, NULL), BT_OK);
    bt_lander_destroy(lander);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_loads_are_those_of_statics),
        cmocka_unit_test(nothing_moves_until_the_wire),
        cmocka_unit_test(pitch_roll_and_sink_speed_play_no_part),
        cmocka_unit_test(the_way_before_the_wire_plays_no_part),
        cmocka_unit_test(a_short_coupled_hook_needs_a_low_lip),
        cmocka_unit_test(an_aircraft_that_cannot_stand_is_refused),
        cmocka_unit_test(what_would_do_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
