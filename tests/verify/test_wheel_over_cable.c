/// A wheel rolls over the cable at speed: it is pressed to the deck in the time the wheel's profile
/// gives, lies there, sends kinks out at c_T, and comes back when they return from the nearest
/// support (linear theory of a rope that is pushed down by its height h_c and stopped). At full
/// height, with the reference tyre and cable; test_wheel_string has the limit of small heights.
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
    bt_cable_forces(&c->cable_model, &c->cable);
    bt_slides slides = {.count = 0};
    bt_wheel_contact_press(&c->contact, &c->cable_model, &c->cable, w, &slides, step_s);
    bt_slides_resolve(&slides, &c->cable_model, &c->cable, step_s);
    c->peak_N = fmax(c->peak_N, c->contact.normal_N);
    bt_cable_advance(&c->cable_model, &c->cable, step_s);
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
        BT_TABLE_ROW("wheel over cable",
                     k ? "nose wheel: time from touch to deck, s"
                       : "main wheel: time from touch to deck, s",
                     took_s, first / speed_mps, rigid / speed_mps,
                     "sqrt(2 R (h + d)) / V; the wheel is one rope high sqrt(2 R d) / V before");
        assert_true(took_s > (first - rigid) / speed_mps);
        assert_true(took_s < first / speed_mps);
        assert_true(c.peak_N > 5e3); // the tyre feels it
        crossing_close(&c);
    }
}

/// What a wheel of the main gear on one side sends out, at full height.
typedef struct sent {
    double kink_mps, kink_tension_N; ///< between 1.5 and 0.3 m off the middle; tension there
    double return_s, mean_c_mps;     ///< from half-way down to half-way up; c_T on the way
    double lowest_m;                 ///< of the underside
    double rest_m;                   ///< height of the track before
    double behind_m;                 ///< height of the track until the kink is at the support
    bool support_let_go, support_carried_again;
} sent;

static const double outer_place = 1.5, inner_place = 0.3;

/// Points for the figure of docs/theory/tyre_on_cable.md (scripts/cable_figures.sh): time, height
/// of the underside in the track, at the inner place and at the first support.
static void print_heights(const crossing* c) {
    if (getenv("BT_CURVES"))
        printf("curve %.6f %.6f %.6f %.6f\n", c->time_s, underside(c, c->y_m),
               underside(c, inner_place), underside(c, c->model.deck.cable.supports.first_m));
}

/// Lets the wheel roll over and follows the kinks that it sends inward and to the support.
static sent follow_kinks(crossing* c) {
    const double y = c->model.aircraft.main_gear.half_track_m;
    const double out = c->model.deck.cable.supports.first_m;
    crossing_open(c, &c->model.aircraft.main_gear, y);
    const double rest[3] = {underside(c, outer_place), underside(c, inner_place), underside(c, y)};
    double arrival[2] = {NAN, NAN}, down_s = NAN, back_s = NAN, tension = 0, root_s = 0;
    int count = 0;
    sent s = {.lowest_m = 1, .rest_m = rest[2]};
    while (c->time_s < 0.2) {
        crossing_step(c);
        print_heights(c);
        for (double at = -5; at < 5; at += 0.1)
            s.lowest_m = fmin(s.lowest_m, underside(c, at));
        for (int k = 0; k < 2; ++k)
            if (isnan(arrival[k]) && underside(c, k ? inner_place : outer_place) < 0.5 * rest[k])
                arrival[k] = c->time_s;
        if (!isnan(arrival[0]) && isnan(arrival[1])) {
            tension += tension_at(c, 0.9);
            ++count;
        }
        const double now = underside(c, y);
        if (isnan(down_s) && now < 0.5 * rest[2])
            down_s = c->time_s;
        if (!isnan(down_s) && isnan(back_s)) {
            root_s += 0.9 * c->cable_model.stable_step_s * sqrt(tension_at(c, 0.5 * (y + out)));
            if (wheel_x(c) > c->tyre.radius && c->time_s < down_s + (out - y) / 66)
                s.behind_m = fmax(s.behind_m, now);
            if (wheel_x(c) > c->tyre.radius && now > 0.5 * rest[2])
                back_s = c->time_s;
        }
        const double support_N = c->cable.scalars->support_force_N[1];
        s.support_let_go |= support_N == 0;
        s.support_carried_again |= s.support_let_go && support_N > 0;
    }
    s.kink_mps = (outer_place - inner_place) / (arrival[1] - arrival[0]);
    s.kink_tension_N = tension / count;
    s.return_s = back_s - down_s;
    s.mean_c_mps = root_s / s.return_s / sqrt(c->model.deck.cable.mass_kgpm);
    crossing_close(c);
    return s;
}

static double wave_speed(const crossing* c, double tension_N) {
    return sqrt(tension_N / c->model.deck.cable.mass_kgpm);
}

/// At full height too the kink runs at c_T, once T is the tension that there is by then and the
/// rope is a string on stiff supports: what is left of the linear theory's error is the rise of
/// tension. The kink to the support starts at the edge of the tyre.
static void string_s_kinks_run_at_c_t(double bridging_m) {
    static crossing c;
    c = (crossing){.model = reference_model(NULL, 0)};
    c.model.aircraft.main_gear.tyre.bridging_length_m = bridging_m;
    c.model.deck.cable.bending_stiffness_Nm2 = 1;
    c.model.deck.cable.wheel_friction = 0;
    c.model.deck.cable.supports.stiffness_Npm = 5e6;
    const sent s = follow_kinks(&c);
    const double rest_mps = wave_speed(&c, c.model.deck.cable.pretension_N);
    const double risen_mps = wave_speed(&c, s.kink_tension_N);
    const double way = 2 * (c.model.deck.cable.supports.first_m - c.y_m);
    BT_TABLE_ROW("wheel over cable", "string: c_T of the tension there is over c_T at rest",
                 risen_mps / rest_mps, 1.0, risen_mps / rest_mps - 1, "rest tension: it rises");
    BT_VERIFY("wheel over cable", "string: speed of the inner kink, m/s", s.kink_mps, risen_mps,
              0.01 * risen_mps, "c_T = sqrt(T / mu), T as computed");
    const double theory_s = (way - 0.5 * c.contact.width_m) / s.mean_c_mps;
    BT_VERIFY("wheel over cable", "string: time from half-way down to half-way up, s", s.return_s,
              theory_s, 0.03 * theory_s, "(2 (s - b) - w / 2) / c_T");
}

static void at_full_height_a_string_s_kinks_run_at_c_t_of_the_risen_tension(void** state) {
    (void)state;
    string_s_kinks_run_at_c_t(0);
    string_s_kinks_run_at_c_t(0.05); // a carcass presses more, the string's answer is its own
}

/// The carcass at the reference's weight: the rope feels twice the force.
static void a_carcass_presses_the_cable_harder(void** state) {
    (void)state;
    static const double bridging_m[] = {0, 0.05};
    double peak_N[2], down_m[2];
    for (int k = 0; k < 2; ++k) {
        static crossing c;
        c = (crossing){.model = reference_model(NULL, 0)};
        c.model.aircraft.main_gear.tyre.bridging_length_m = bridging_m[k];
        crossing_open(&c, &c.model.aircraft.main_gear, 2.445);
        while (wheel_x(&c) < 0.1)
            crossing_step(&c);
        peak_N[k] = c.peak_N;
        down_m[k] = underside(&c, 2.445);
        crossing_close(&c);
    }
    BT_TABLE_ROW("wheel over cable", "carcass of 50 mm: peak force on the cable, N", peak_N[1],
                 peak_N[0], peak_N[1] - peak_N[0], "without carcass");
    assert_true(peak_N[1] > 1.5 * peak_N[0] && peak_N[1] < 4 * peak_N[0]);
    BT_ASSERT_NEAR(down_m[1], down_m[0], 0, 2e-3); // on the deck with both
}

/// The reference cable: bending carries the kink ahead (its phase speed is sqrt((T + EI k^2) / mu),
/// the wheel makes waves of k up to 8 / m), and supports that give hold the answer back by up to
/// 2 sqrt(T mu) / k_s = 15 ms.
static void at_full_height_bending_and_soft_supports_are_seen(void** state) {
    (void)state;
    static crossing c;
    c = (crossing){.model = reference_model(NULL, 0)};
    const sent s = follow_kinks(&c);
    const bt_cable_params* p = &c.model.deck.cable;
    const double risen_mps = wave_speed(&c, s.kink_tension_N);
    const double bent_mps = sqrt((s.kink_tension_N + 64 * p->bending_stiffness_Nm2) / p->mass_kgpm);
    BT_TABLE_ROW("wheel over cable", "speed of the inner kink, m/s", s.kink_mps, risen_mps,
                 bent_mps - risen_mps, "c_T, T as computed: bending is faster");
    assert_true(s.kink_mps > risen_mps && s.kink_mps < bent_mps);
    const double way = 2 * (p->supports.first_m - c.y_m) - 0.5 * c.contact.width_m;
    const double soft_s = 2 * sqrt(p->pretension_N * p->mass_kgpm) / p->supports.stiffness_Npm;
    BT_TABLE_ROW("wheel over cable", "time from half-way down to half-way up, s", s.return_s,
                 way / s.mean_c_mps, soft_s, "(2 (s - b) - w / 2) / c_T: supports give");
    assert_true(s.return_s > way / bent_mps && s.return_s < way / s.mean_c_mps + soft_s);
    // on the deck; its shape at rest (6 mm of slope in the half metre beside) comes back first
    assert_true(s.behind_m < 0.1 * s.rest_m);
    // penalty of the deck: at 30 m/s a piece of rope dips by v sqrt(mu / k)
    const double dip = 30 * sqrt(p->mass_kgpm / p->deck.stiffness_Npm2);
    if (s.lowest_m < -2 * dip)
        fail_msg("the cable dips %g mm into the deck", -1e3 * s.lowest_m);
    assert_true(s.support_let_go && s.support_carried_again);
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

    // both main wheels, one of them near a support, at every speed of landing
    for (double speed = 40; speed < 71; speed += 15)
        for (double aside = -3; aside < 3.5; aside += 1.5) {
            bt_model_params model = REFERENCE("landing.distance=9 m");
            model.landing.horizontal_speed_mps = speed;
            model.landing.distance_m = 9 * speed / 47.5; // the wheels as low as at 47.5 m/s
            model.landing.off_centre_m = aside;
            s = (seen){.lowest_m = 1};
            land(lander, &model, see, &s);
            assert_true(s.wheel_force_N[BT_LEG_LEFT] > 5e3);
            assert_true(s.wheel_force_N[BT_LEG_RIGHT] > 5e3);
            assert_true(s.peak_tension_N > 1.1 * s.rest_tension_N);
            BT_ASSERT_NEAR(s.lowest_m, 0.01825, 0, 3e-3);
        }
    bt_lander_destroy(lander);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_pressed_to_the_deck_in_the_time_of_the_wheels_profile),
        cmocka_unit_test(at_full_height_a_string_s_kinks_run_at_c_t_of_the_risen_tension),
        cmocka_unit_test(a_carcass_presses_the_cable_harder),
        cmocka_unit_test(at_full_height_bending_and_soft_supports_are_seen),
        cmocka_unit_test(in_a_landing_main_and_nose_wheels_meet_the_cable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
