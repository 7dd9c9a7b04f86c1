/// A wheel rolls over the cable at speed: it is pressed to the deck in the time the wheel's profile
/// gives, lies there, sends kinks out at c_T, and comes back when they return from the nearest
/// support (linear theory of a rope that is pushed down by its height h_c and stopped).
#include "reference.h"

#include "elements/wheel.h"
#include "landing/cable_contact.h"
#include "landing/view.h"
#include "mechanics/vec.h"
#include "tables.h"

static const double speed_mps = 47.5;

/// The reference cable with one wheel that rolls over it at a fixed height, a little pressed.
typedef struct crossing {
    bt_model_params model;
    bt_arena arena;
    bt_cable_model cable_model;
    bt_cable_state cable;
    bt_tyre tyre;
    bt_wheel_contact contact;
    bt_moving_body wheel;
    double segment_m[BT_CABLE_SEGMENTS_MAX];
    double y_m, sink_m, start_x;
    double time_s;
    double peak_N, impulse_x_Ns; ///< on the rope; on the wheel
} crossing;

static void crossing_open(crossing* c, const bt_gear_params* gear, double y_m) {
    bt_cable_def def;
    bt_cable_def_init(&def, &c->model.deck.cable, c->model.deck.gravity_mps2, c->segment_m);
    assert_int_equal(bt_arena_create(&c->arena, bt_cable_memory(def.count, 1)), BT_OK);
    assert_int_equal(bt_cable_model_init(&c->cable_model, &def, &c->arena, NULL), BT_OK);
    assert_int_equal(bt_cable_state_init(&c->cable_model, &c->cable, &c->arena), BT_OK);
    assert_int_equal(bt_cable_equilibrium(&c->cable_model, &c->cable, NULL, NULL), BT_OK);
    bt_tyre_prepare(&gear->tyre, &c->tyre);
    c->contact = (bt_wheel_contact){.tyre = &c->tyre,
                                    .width_m = gear->tyre.width_m * (double)gear->tyre.tyres,
                                    .friction = c->model.deck.cable.wheel_friction,
                                    .slip_speed_mps = 1,
                                    .hint = -1};
    c->y_m = y_m;
    c->sink_m = 0.03;
    c->start_x = -c->tyre.radius - 0.02;
    c->wheel = (bt_moving_body){.rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
}

static void crossing_close(crossing* c) {
    bt_arena_destroy(&c->arena);
}

static double wheel_x(const crossing* c) {
    return c->start_x + speed_mps * c->time_s;
}

/// One cable step with the wheel where it is by now, rolling without slip.
static void crossing_step(crossing* c) {
    const double step_s = 0.9 * c->cable_model.stable_step_s;
    bt_moving_body* w = &c->wheel;
    w->position_m[0] = wheel_x(c);
    w->position_m[1] = c->y_m;
    w->position_m[2] = c->tyre.radius - c->sink_m;
    w->velocity_mps[0] = speed_mps;
    w->spin_radps[1] = speed_mps / bt_tyre_rolling_radius(&c->tyre, c->sink_m);
    bt_moving_body_to(w, 0);
    bt_cable_clear_loads(&c->cable_model, &c->cable);
    bt_wheel_contact_apply(&c->contact, &c->cable_model, &c->cable, w, step_s);
    c->peak_N = fmax(c->peak_N, c->contact.normal_N);
    bt_cable_step(&c->cable_model, &c->cable, step_s);
    c->time_s += step_s;
}

static double underside(const crossing* c, double y_m) {
    double at[3];
    assert_true(bt_cable_centreline(&c->cable_model, &c->cable, y_m, -1, at, NULL, NULL) >= 0);
    return at[2] - c->cable_model.radius_m;
}

/// Tension where the rope passes y.
static double tension_at(const crossing* c, double y_m) {
    return bt_cable_tension(&c->cable_model, &c->cable,
                            bt_cable_segment_at(&c->cable_model, &c->cable, y_m, -1));
}

static void it_is_pressed_to_the_deck_in_the_time_of_the_wheels_profile(void** state) {
    (void)state;
    static const double places[] = {2.445, 0.0};
    for (int k = 0; k < 2; ++k) {
        static crossing c;
        c = (crossing){.model = reference_model(NULL, 0)};
        const bt_gear_params* gear = k ? &c.model.aircraft.nose_gear : &c.model.aircraft.main_gear;
        crossing_open(&c, gear, places[k]);
        const double height = underside(&c, places[k]);
        double touch_s = NAN, down_s = NAN;
        while (wheel_x(&c) < 0.1) {
            crossing_step(&c);
            if (isnan(touch_s) && c.contact.normal_N > 0)
                touch_s = c.time_s;
            if (isnan(down_s) && underside(&c, places[k]) < 1e-3)
                down_s = c.time_s;
        }
        // first touch where the profile xi^2 / 2R is as high as the rope's top; a rigid wheel has
        // it down where the profile is one rope high, a soft one a little before the axle
        const double diameter = 2 * c.cable_model.radius_m, r = c.tyre.radius;
        const double first = sqrt(2 * r * (height + diameter + c.sink_m));
        const double rigid = sqrt(2 * r * (diameter + c.sink_m));
        const double took_s = down_s - touch_s;
        BT_VERIFY("wheel over cable",
                  k ? "nose wheel: time from touch to deck, s"
                    : "main wheel: time from touch to deck, s",
                  took_s, first / speed_mps, 0.3 * first / speed_mps, "sqrt(2 R h) / V");
        assert_true(took_s > (first - rigid) / speed_mps);
        assert_true(took_s < first / speed_mps);
        assert_true(c.peak_N > 5e3); // the tyre feels it
        crossing_close(&c);
    }
}

/// Behind the wheel the rope stays on the deck until the kink is back from the support.
static void it_stays_down_until_the_kink_is_back_from_the_support(void** state) {
    (void)state;
    static crossing c;
    c = (crossing){.model = reference_model(NULL, 0)};
    const double y = c.model.aircraft.main_gear.half_track_m;
    crossing_open(&c, &c.model.aircraft.main_gear, y);
    double passed_s = NAN, down_s = NAN, back_s = NAN, tension_s = 0, lowest = 0;
    const double out = c.model.deck.cable.supports.first_m;
    while (isnan(back_s) && c.time_s < 0.3) {
        crossing_step(&c);
        for (double at = -5; at < 5; at += 0.1)
            lowest = fmin(lowest, underside(&c, at));
        const double now = underside(&c, y);
        if (isnan(down_s) && now < 1e-3)
            down_s = c.time_s;
        if (isnan(passed_s) && wheel_x(&c) > c.tyre.radius)
            passed_s = c.time_s;
        if (!isnan(down_s) && isnan(back_s)) {
            tension_s += 0.9 * c.cable_model.stable_step_s * sqrt(tension_at(&c, 0.5 * (y + out)));
            if (!isnan(passed_s) && now > 0.02)
                back_s = c.time_s;
        }
    }
    assert_true(back_s > 0);
    // c_T with the tension there was on the way, averaged
    const double c_t = tension_s / (back_s - down_s) / sqrt(c.model.deck.cable.mass_kgpm);
    const double theory_s = 2 * (out - y) / c_t;
    BT_TABLE_ROW("wheel over cable", "mean transverse wave speed to the support and back, m/s", c_t,
                 sqrt(c.model.deck.cable.pretension_N / c.model.deck.cable.mass_kgpm), 0.1 * c_t,
                 "rest tension: it rises");
    // kinks have a width (bending, the wheel's width) and start while the wheel presses
    BT_VERIFY("wheel over cable", "time from pressed down to risen 20 mm, s", back_s - down_s,
              theory_s, 0.1 * theory_s, "2 (s - b) / c_T");
    // penalty of the deck: at 30 m/s a piece of rope dips by v sqrt(mu / k)
    const double dip =
        30 * sqrt(c.model.deck.cable.mass_kgpm / c.model.deck.cable.deck.stiffness_Npm2);
    if (lowest < -2 * dip)
        fail_msg("the cable dips %g mm into the deck", -1e3 * lowest);
    crossing_close(&c);
}

/// Inner kink: when it has come from the wheel to the middle, and not before, the middle moves.
static void the_kink_runs_inward_at_the_transverse_wave_speed(void** state) {
    (void)state;
    static crossing c;
    c = (crossing){.model = reference_model(NULL, 0)};
    const double y = c.model.aircraft.main_gear.half_track_m;
    crossing_open(&c, &c.model.aircraft.main_gear, y);
    const double rest[2] = {underside(&c, 1.5), underside(&c, 0.3)};
    double arrival[2] = {NAN, NAN}, tension = 0;
    int count = 0;
    while (isnan(arrival[1]) && c.time_s < 0.1) {
        crossing_step(&c);
        for (int k = 0; k < 2; ++k)
            if (isnan(arrival[k]) && underside(&c, k ? 0.3 : 1.5) < 0.5 * rest[k])
                arrival[k] = c.time_s;
        if (!isnan(arrival[0])) {
            tension += tension_at(&c, 0.9);
            ++count;
        }
    }
    const double c_t = sqrt(tension / count / c.model.deck.cable.mass_kgpm);
    BT_VERIFY("wheel over cable", "speed of the kink between 1.5 and 0.3 m off the middle, m/s",
              1.2 / (arrival[1] - arrival[0]), c_t, 0.1 * c_t, "c_T = sqrt(T / mu)");
    crossing_close(&c);
}

/* ---- in a landing ---- */

typedef struct seen {
    double wheel_force_N[BT_LEG_COUNT]; ///< peak on the cable
    double lowest_m, rest_tension_N, peak_tension_N;
} seen;

static void see(void* user, const bt_landing_view* view) {
    seen* s = user;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        s->wheel_force_N[leg] = fmax(s->wheel_force_N[leg], view->tyre_cable_force_N[leg]);
    if (!view->cable_awake)
        s->rest_tension_N = view->cable_tension_N[view->cable_count / 2];
    else
        for (int i = 0; i + 1 < view->cable_count; ++i)
            s->peak_tension_N = fmax(s->peak_tension_N, view->cable_tension_N[i]);
    for (int i = 0; view->cable_awake && i < view->cable_count; ++i)
        s->lowest_m = fmin(s->lowest_m, view->cable_z[i]);
}

static void in_a_landing_main_and_nose_wheels_meet_the_cable(void** state) {
    (void)state;
    bt_lander* lander = new_lander();
    const bt_model_params main_only = REFERENCE("landing.distance=9 m");
    seen s = {.lowest_m = 1};
    land(lander, &main_only, see, &s);
    assert_true(s.wheel_force_N[BT_LEG_LEFT] > 5e3);
    BT_ASSERT_NEAR(s.wheel_force_N[BT_LEG_LEFT], s.wheel_force_N[BT_LEG_RIGHT], 1e-6, 0);
    assert_true(s.peak_tension_N > 1.1 * s.rest_tension_N);
    BT_ASSERT_NEAR(s.lowest_m, 0.01825, 0, 3e-3); // down to the deck, not into it

    const bt_model_params nose_too = REFERENCE("landing.distance=25 m", "landing.pitch=1 deg");
    s = (seen){.lowest_m = 1};
    land(lander, &nose_too, see, &s);
    assert_true(s.wheel_force_N[BT_LEG_NOSE] > 1e3);
    assert_true(s.wheel_force_N[BT_LEG_LEFT] > 5e3);

    const bt_model_params aside = REFERENCE("landing.distance=9 m", "landing.off_centre=1.5 m");
    s = (seen){.lowest_m = 1};
    land(lander, &aside, see, &s);
    assert_true(s.wheel_force_N[BT_LEG_LEFT] > 5e3);
    assert_true(s.wheel_force_N[BT_LEG_RIGHT] > 5e3);
    bt_lander_destroy(lander);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_pressed_to_the_deck_in_the_time_of_the_wheels_profile),
        cmocka_unit_test(it_stays_down_until_the_kink_is_back_from_the_support),
        cmocka_unit_test(the_kink_runs_inward_at_the_transverse_wave_speed),
        cmocka_unit_test(in_a_landing_main_and_nose_wheels_meet_the_cable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
