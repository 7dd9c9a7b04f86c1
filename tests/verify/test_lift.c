/// Lift after touchdown against its formula and its closed forms; crosswind and mirror symmetry.
#include "reference.h"

#include "landing/airframe.h"
#include "landing/lift.h"
#include "tables.h"

static bt_landing_result once(const bt_model_params* model, bt_landing_observer* observer,
                              void* user) {
    bt_lander* lander = new_lander();
    const bt_landing_result result = land(lander, model, observer, user);
    bt_lander_destroy(lander);
    return result;
}

/* ---- the law ---- */

/// The factor of a fuselage that pitches by `pitch` and moves with (vx, vz) at a time.
static double factor(const bt_model_params* model, double time_s, double pitch, double vx,
                     double vz) {
    const double q[7] = {0, 0, 3, 1, 0, 0, 0}, v[6] = {vx, 0, vz, 0, 0, 0};
    const double c = cos(pitch), s = sin(pitch);
    const double rotation[9] = {c, 0, -s, 0, 1, 0, s, 0, c};
    const bt_motion motion = {.time_s = time_s, .q = q, .v = v, .rotation = rotation};
    const double point[3] = {0};
    bt_lift lift;
    bt_lift_init(&lift, 1e5, point);
    bt_lift_prepare(&lift, model, model->landing.pitch_rad);
    return bt_lift_factor(&lift, &motion, 0);
}

static void lift_follows_speed_squared_and_angle_of_attack(void** state) {
    (void)state;
    const bt_model_params m =
        REFERENCE("landing.lift.law=aerodynamic", "landing.lift.zero_lift_angle=-2 deg",
                  "landing.pitch=4 deg", "landing.sink_speed=3 m/s",
                  "landing.horizontal_speed=50 m/s", "landing.lift.wind=10 m/s");
    const double a_T = m.landing.pitch_rad + atan(3. / 60),
                 a_0 = m.landing.lift.zero_lift_angle_rad;
    const double level = m.landing.pitch_rad;
    BT_ASSERT_NEAR(factor(&m, 0.1, level, 50, -3), 1, 1e-14, 0); // as at touchdown
    BT_ASSERT_NEAR(factor(&m, -0.1, level, 20, -9), 1, 0, 0);    // the glide is steady
    BT_ASSERT_NEAR(factor(&m, 0.1, a_0, 50, 0), 0, 0, 1e-14);    // zero lift angle
    BT_ASSERT_NEAR(factor(&m, 0.1, level, 50, 0),                // the sinking has stopped
                   3600. / 3609 * (level - a_0) / (a_T - a_0), 1e-14, 0);
    BT_ASSERT_NEAR(factor(&m, 0.1, level, 20, 0), // speed through the air halved
                   0.25 * factor(&m, 0.1, level, 50, 0), 1e-14, 0);
}

static void lift_is_dumped_over_its_time(void** state) {
    (void)state;
    const bt_model_params m =
        REFERENCE("landing.lift.dump_after=0.1 s", "landing.lift.dump_duration=0.2 s",
                  "landing.lift.dump_share=0.2");
    static const double expected[][2] = {{0.05, 1}, {0.1, 1}, {0.2, 0.6}, {0.3, 0.2}, {2, 0.2}};
    for (size_t k = 0; k < sizeof expected / sizeof *expected; ++k)
        BT_ASSERT_NEAR(factor(&m, expected[k][0], 0, 50, 0), expected[k][1], 1e-14, 0);
}

/* ---- in a landing ---- */

typedef struct balance {
    const bt_model_params* model;
    double lift_N, last_N, last_s, start_Ns, impulse_Ns, worst_Ns;
    bool begun;
} balance;

static double momentum(const bt_aircraft_params* a, const double* v) {
    double now = a->hook.mass_kg * v[6 * BT_BODY_HOOK + 2], rest_kg = a->mass_kg - a->hook.mass_kg;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const bt_gear_params* gear = leg == BT_LEG_NOSE ? &a->nose_gear : &a->main_gear;
        now += gear->piston_mass_kg * v[6 * (BT_BODY_NOSE_PISTON + leg) + 2] +
               gear->wheel_mass_kg * v[6 * (BT_BODY_NOSE_WHEEL + leg) + 2];
        rest_kg -= gear->piston_mass_kg + gear->wheel_mass_kg;
    }
    return now + rest_kg * v[6 * BT_BODY_FUSELAGE + 2];
}

static void see_balance(void* user, const bt_landing_view* view) {
    balance* b = user;
    if (view->cable_awake || view->time_s > 0.2)
        return;
    const double weight_N = b->model->aircraft.mass_kg * b->model->deck.gravity_mps2;
    const double since = fmin(1, fmax(0, (view->time_s - 0.05) / 0.1));
    double force_N = view->hook_deck_force_N - weight_N + weight_N * (1 - since);
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        force_N += view->tyre_force_N[leg];
    const double now_Ns = momentum(&b->model->aircraft, view->v);
    if (b->begun)
        b->impulse_Ns += 0.5 * (force_N + b->last_N) * (view->time_s - b->last_s);
    else
        b->start_Ns = now_Ns;
    b->begun = true;
    b->last_N = force_N;
    b->last_s = view->time_s;
    b->worst_Ns = fmax(b->worst_Ns, fabs(now_Ns - b->start_Ns - b->impulse_Ns));
}

/// Vertical momentum is the impulse of tyres, shoe, weight, and the lift that is left.
static void a_landing_feels_the_dump(void** state) {
    (void)state;
    const bt_model_params model =
        REFERENCE("landing.distance=14 m", "landing.lift.dump_after=0.05 s",
                  "landing.lift.dump_duration=0.1 s", "landing.lift.dump_share=0");
    balance b = {.model = &model};
    once(&model, see_balance, &b);
    assert_true(b.last_s > 0.12 && b.impulse_Ns != 0);
    BT_VERIFY("landing", "lift dump: momentum less impulse, over impulse",
              b.worst_Ns / fabs(b.impulse_Ns), 0, 1e-12, "Newton");
}

static void the_aerodynamic_law_begins_as_the_constant_one(void** state) {
    (void)state;
    // caught before the main wheels load: lift has hardly changed
    const bt_model_params constant = REFERENCE("landing.distance=3 m");
    bt_model_params law = constant;
    law.landing.lift.law = BT_LIFT_AERODYNAMIC;
    const bt_landing_result a = once(&constant, NULL, NULL), b = once(&law, NULL, NULL);
    assert_true(a.state_hash != b.state_hash);
    BT_ASSERT_NEAR(a.margin_m, b.margin_m, 0, 1e-3);
}

static void no_angle_of_attack_is_refused(void** state) {
    (void)state;
    static const char* const sets[] = {"landing.lift.law=aerodynamic", "landing.pitch=-6 deg"};
    bt_study* study = malloc(sizeof *study);
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    assert_int_equal(bt_study_read("studies/reference/study.yaml", sets, 2, study, &diag),
                     BT_ERR_INPUT);
    assert_non_null(strstr(kept.text, "landing.lift.zero_lift_angle: -0.03491 rad"));
    assert_non_null(strstr(kept.text, "at most -0.0"));
    free(study);
}

/* ---- crosswind ---- */

typedef struct side {
    double drift_mps, hook_y_m, side_N[BT_LEG_COUNT];
} side;

static void see_side(void* user, const bt_landing_view* view) {
    side* s = user;
    s->drift_mps = view->v[1];
    s->hook_y_m = view->hook_shoe_m[1];
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        s->side_N[leg] = fmax(s->side_N[leg], view->strut_side_force_N[leg]);
}

/// Drift, roll, yaw, place and the ship's roll, all to the other side.
static void everything_mirrored_gives_the_mirrored_landing(void** state) {
    (void)state;
    bt_model_params model = REFERENCE(
        "landing.distance=9 m", "landing.drift=2 m/s", "landing.roll=1 deg", "landing.yaw=-1.5 deg",
        "landing.off_centre=0.6 m", "deck.motion.roll.rate=0.01 rad/s",
        "deck.motion.roll.angle=0.5 deg", "deck.motion.centre_below=15 m");
    side a = {0}, b = {0};
    const bt_landing_result left = once(&model, see_side, &a);
    model.landing.drift_mps *= -1;
    model.landing.roll_rad *= -1;
    model.landing.yaw_rad *= -1;
    model.landing.off_centre_m *= -1;
    model.deck.motion.roll.rate_radps *= -1;
    model.deck.motion.roll.angle_rad *= -1;
    const bt_landing_result right = once(&model, see_side, &b);
    assert_int_equal(left.mode, right.mode);
    BT_VERIFY("landing", "margin, everything mirrored", right.margin_m, left.margin_m, 1e-9,
              "symmetry");
    BT_ASSERT_NEAR(a.drift_mps, -b.drift_mps, 1e-9, 0);
    BT_ASSERT_NEAR(a.hook_y_m, -b.hook_y_m, 1e-9, 0);
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const int other = leg == BT_LEG_NOSE ? leg : BT_LEG_LEFT + BT_LEG_RIGHT - leg;
        BT_ASSERT_NEAR(left.strut_stroke_max_m[leg], right.strut_stroke_max_m[other], 1e-9, 1e-12);
        BT_ASSERT_NEAR(a.side_N[leg], b.side_N[other], 1e-6, 1e-6);
    }
    assert_true(fabs(a.side_N[BT_LEG_LEFT] - a.side_N[BT_LEG_RIGHT]) > 100);
}

/// Tyres that drift pull to the other side.
static void drift_is_braked_by_the_tyres(void** state) {
    (void)state;
    const bt_model_params model = REFERENCE("landing.distance=14 m", "landing.drift=2 m/s");
    side s = {0};
    once(&model, see_side, &s);
    assert_true(s.drift_mps > 0 && s.drift_mps < 1.95);
    assert_true(s.side_N[BT_LEG_LEFT] > 1e3);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lift_follows_speed_squared_and_angle_of_attack),
        cmocka_unit_test(lift_is_dumped_over_its_time),
        cmocka_unit_test(a_landing_feels_the_dump),
        cmocka_unit_test(the_aerodynamic_law_begins_as_the_constant_one),
        cmocka_unit_test(no_angle_of_attack_is_refused),
        cmocka_unit_test(everything_mirrored_gives_the_mirrored_landing),
        cmocka_unit_test(drift_is_braked_by_the_tyres),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
