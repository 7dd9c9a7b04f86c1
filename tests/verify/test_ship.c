/// Landings on a deck that moves: Galilei, equivalence of heave and gravity, straight flight seen
/// from a deck that turns, the frame's work, wires that sleep.
#include "reference.h"

#include "landing/parts.h"
#include "landing/ship.h"
#include "mechanics/vec.h"
#include "tables.h"

static bt_landing_result once(const bt_model_params* model, bt_landing_observer* observer,
                              void* user) {
    bt_lander* lander = new_lander();
    const bt_landing_result result = land(lander, model, observer, user);
    bt_lander_destroy(lander);
    return result;
}

/* ---- Galilei ---- */

static void a_deck_that_heaves_steadily_is_a_deck_at_rest(void** state) {
    (void)state;
    static const char* const sink[2] = {"landing.sink_speed=4 m/s", "landing.sink_speed=5.25 m/s"};
    static const char* const heave[2] = {"deck.motion.heave.velocity=1.25 m/s",
                                         "deck.motion.heave.velocity=0 m/s"};
    static const char* const lift[2] = {"aircraft.lift_ratio=1", "aircraft.lift_ratio=0.9"};
    for (int l = 0; l < 2; ++l) {
        uint64_t hash[2];
        for (int k = 0; k < 2; ++k) {
            const bt_model_params model =
                REFERENCE("landing.distance=5 m", sink[k], heave[k], lift[l], "landing.roll=1 deg");
            hash[k] = once(&model, NULL, NULL).state_hash;
        }
        assert_true(hash[0] == hash[1]);
    }
}

/// So it is with four wires, over which it lands with drift and yaw too.
static void four_wires_on_a_deck_that_heaves_steadily_are_at_rest(void** state) {
    (void)state;
    static const char* const sink[2] = {"landing.sink_speed=4 m/s", "landing.sink_speed=5.25 m/s"};
    static const char* const heave[2] = {"deck.motion.heave.velocity=1.25 m/s",
                                         "deck.motion.heave.velocity=0 m/s"};
    bt_landing_result r[2];
    for (int k = 0; k < 2; ++k) {
        const bt_model_params model =
            REFERENCE("deck.wires.number=4", "landing.distance=2 m", sink[k], heave[k],
                      "landing.roll=1 deg", "landing.drift=0.5 m/s", "landing.yaw=1 deg");
        r[k] = once(&model, NULL, NULL);
    }
    assert_true(r[0].state_hash == r[1].state_hash);
    assert_true(r[0].contact_count == r[1].contact_count && r[0].contact_count > 0);
    for (int c = 0; c < r[0].contact_count; ++c)
        assert_memory_equal(&r[0].contacts[c].margin_m, &r[1].contacts[c].margin_m, sizeof(double));
}

/* ---- equivalence ---- */

/// A deck that accelerates upward by a is a deck at rest under gravity g + a, with the same lift.
static void heave_acceleration_is_gravity(void** state) {
    (void)state;
    static const double a_mps2 = 1.5;
    for (int k = 0; k < 2; ++k) {
        bt_model_params ship = REFERENCE("aircraft.lift_ratio=0.9", "landing.sink_speed=4 m/s");
        ship.landing.distance_m = k ? 5 : 8;
        bt_model_params still = ship;
        ship.deck.motion.heave.acceleration_mps2 = a_mps2;
        const double g = still.deck.gravity_mps2;
        still.deck.gravity_mps2 = g + a_mps2;
        still.aircraft.lift_ratio *= g / (g + a_mps2);
        const bt_landing_result moving = once(&ship, NULL, NULL), rest = once(&still, NULL, NULL);
        assert_int_equal(moving.mode, rest.mode);
        BT_VERIFY("landing", "margin, deck accelerating by 1.5 m/s2", moving.margin_m,
                  rest.margin_m, 1e-10, "gravity g + a");
        for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
            BT_ASSERT_NEAR(moving.strut_stroke_max_m[leg], rest.strut_stroke_max_m[leg], 1e-6, 0);
        BT_ASSERT_NEAR(moving.hook_deck_force_peak_N, rest.hook_deck_force_peak_N, 1e-6, 0);
    }
}

/* ---- flight ---- */

/// Where the fuselage is in the axes of touchdown, seen from a deck that moves.
typedef struct flight {
    const bt_motion_params* motion;
    double first_s, first_m[3], way_mps[3], worst_m, worst_rad, before_s;
    double attitude[9];
    int seen;
} flight;

static void see_flight(void* user, const bt_landing_view* view) {
    flight* f = user;
    if (view->time_s > 0)
        return;
    bt_ship ship;
    double place[3], attitude[9];
    bt_ship_at(f->motion, view->time_s, &ship);
    bt_rotate(ship.turn, view->q + 7 * BT_BODY_FUSELAGE, place);
    bt_add_scaled(place, 1, ship.shift_m);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            attitude[3 * i + j] = 0;
            for (int k = 0; k < 3; ++k)
                attitude[3 * i + j] += ship.turn[3 * i + k] * view->rotation[3 * k + j];
        }
    if (f->seen++ == 0) {
        f->first_s = view->time_s;
        memcpy(f->first_m, place, sizeof place);
        memcpy(f->attitude, attitude, sizeof attitude);
    }
    bt_add_scaled(place, -1, f->first_m);
    bt_add_scaled(place, -(view->time_s - f->first_s), f->way_mps);
    f->worst_m = fmax(f->worst_m, bt_norm(place));
    for (int i = 0; i < 9; ++i)
        f->worst_rad = fmax(f->worst_rad, fabs(attitude[i] - f->attitude[i]));
    f->before_s = view->time_s;
}

/// Until it touches, the aircraft flies straight and does not turn, whatever the deck does: heave
/// as the closed form s = v t + a t^2 / 2, pitch and roll about a point far ahead.
static void the_glide_is_straight_over_a_deck_that_moves(void** state) {
    (void)state;
    bt_model_params model = REFERENCE("landing.pitch=0 deg", "landing.distance=-30 m",
                                      "landing.drift=1 m/s", "landing.solver.past_cable=10 m");
    const struct {
        const char* what;
        double acceleration, rate, amplitude, tolerance_m;
    } cases[] = {{"heave", 1.5, 0, 0, 1e-11}, {"pitch and roll", 1, 0.02, 0.02, 1e-6}};
    for (int k = 0; k < 2; ++k) {
        bt_motion_params* m = &model.deck.motion;
        m->heave.velocity_mps = 0.7;
        m->heave.acceleration_mps2 = cases[k].acceleration;
        m->pitch.rate_radps = cases[k].rate;
        m->pitch.amplitude_rad = 0.5 * cases[k].amplitude;
        m->roll.amplitude_rad = cases[k].amplitude;
        m->centre_ahead_m = cases[k].rate != 0 ? 60 : 0;
        flight f = {.motion = m};
        bt_ship ship;
        bt_ship_at(m, 0, &ship);
        const bt_landing_params* p = &model.landing;
        const double way[3] = {p->horizontal_speed_mps, p->drift_mps, -p->sink_speed_mps};
        memcpy(f.way_mps, way, sizeof way);
        once(&model, see_flight, &f);
        assert_true(f.before_s - f.first_s > 0.2);
        char text[80];
        snprintf(text, sizeof text, "glide from a straight line over 0.2 s, deck with %s, m",
                 cases[k].what);
        BT_VERIFY("landing", text, f.worst_m, 0, cases[k].tolerance_m, "Newton");
        BT_ASSERT_NEAR(f.worst_rad, 0, 0, 1e-6);
    }
}

/* ---- the frame's work ---- */

typedef struct audit {
    const bt_model_params* model;
    double last_s, last_kgm, last_J, start_J, frame_J, worst_rise_J, worst_flight_J;
    bool begun;
} audit;

static double first_moment(const bt_aircraft_params* a, const double* q) {
    double moment = a->hook.mass_kg * q[7 * BT_BODY_HOOK + 2],
           rest_kg = a->mass_kg - a->hook.mass_kg;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const bt_gear_params* gear = leg == BT_LEG_NOSE ? &a->nose_gear : &a->main_gear;
        moment += gear->piston_mass_kg * q[7 * (BT_BODY_NOSE_PISTON + leg) + 2] +
                  gear->wheel_mass_kg * q[7 * (BT_BODY_NOSE_WHEEL + leg) + 2];
        rest_kg -= gear->piston_mass_kg + gear->wheel_mass_kg;
    }
    return moment + rest_kg * q[7 * BT_BODY_FUSELAGE + 2];
}

/// Gravity's potential in the frame is -M (g - a0) . r; where a0 changes, it changes by M a0' r.
static void see_audit(void* user, const bt_landing_view* view) {
    audit* a = user;
    if (view->time_s > 0.12) // before the cable
        return;
    const double now_kgm = first_moment(&a->model->aircraft, view->q);
    bt_ship from, to;
    bt_ship_at(&a->model->deck.motion, a->last_s, &from);
    bt_ship_at(&a->model->deck.motion, view->time_s, &to);
    if (a->begun)
        a->frame_J +=
            (to.acceleration_mps2[2] - from.acceleration_mps2[2]) * 0.5 * (now_kgm + a->last_kgm);
    else
        a->start_J = view->energy_J;
    const double own_J = view->energy_J - a->frame_J;
    if (a->begun)
        a->worst_rise_J = fmax(a->worst_rise_J, own_J - a->last_J);
    if (view->time_s < 0)
        a->worst_flight_J = fmax(a->worst_flight_J, fabs(own_J - a->start_J));
    a->begun = true;
    a->last_s = view->time_s;
    a->last_kgm = now_kgm;
    a->last_J = own_J;
}

static void the_frame_does_the_work_that_its_acceleration_asks_for(void** state) {
    (void)state;
    bt_model_params model =
        REFERENCE("landing.distance=14 m", "landing.sink_speed=5 m/s",
                  "deck.motion.heave.amplitude=2 m", "deck.motion.heave.period=8 s");
    audit landing = {.model = &model};
    once(&model, see_audit, &landing);
    assert_true(fabs(landing.frame_J) > 100);
    const double out_J = landing.start_J - landing.last_J;
    assert_true(out_J > 1e4);
    BT_VERIFY("landing", "heaving deck: largest rise of energy less the frame's work, over loss",
              landing.worst_rise_J / out_J, 0, 1e-12, "dissipation");
    model.landing.distance_m = -30;
    audit air = {.model = &model};
    once(&model, see_audit, &air);
    BT_VERIFY("landing", "heaving deck, flight: energy less the frame's work, over energy",
              air.worst_flight_J / air.start_J, 0, 1e-11, "conservation");
}

/* ---- wires that sleep ---- */

static double margin_of(const bt_landing_model* model, bt_landing_state* state, bool awake) {
    bt_landing_result result;
    bool on = bt_landing_start(model, state);
    for (int k = 0; k < model->wire_count; ++k)
        state->wire[k].awake = awake;
    while (on)
        on = bt_landing_step(model, state);
    bt_landing_finish(model, state, &result);
    return result.margin_m;
}

/// A wire is let sleep in its equilibrium under what presses it down at touchdown.
static void letting_a_wire_sleep_moves_the_margin_by_less_than_its_bound(void** state) {
    (void)state;
    const bt_model_params model =
        REFERENCE("landing.distance=6 m", "deck.motion.heave.amplitude=0.5 m",
                  "deck.motion.heave.period=8 s");
    const double lasts_s = 16 / model.landing.horizontal_speed_mps;
    const double bound_m =
        bt_ship_sleeping_error(&model.deck.motion, &model.deck.cable, 0, lasts_s);
    assert_true(bound_m > 1e-4); // bt_landing_start would wake this one
    bt_landing_model* m;
    bt_landing_state* s;
    assert_int_equal(bt_landing_model_create(&m), BT_OK);
    assert_int_equal(bt_landing_model_prepare(m, &model, NULL), BT_OK);
    assert_int_equal(bt_landing_state_create(m, &s), BT_OK);
    assert_true(bt_landing_start(m, s));
    assert_true(s->wire[0].awake);
    const double asleep_m = margin_of(m, s, false), awake_m = margin_of(m, s, true);
    BT_ASSERT_NEAR(asleep_m, awake_m, 0, bound_m);
    bt_landing_state_destroy(s);
    bt_landing_model_destroy(m);
}

/// A steady acceleration: the wire rests deeper, and no deeper than it should.
static void a_wire_rests_under_what_presses_it_down(void** state) {
    (void)state;
    const bt_model_params model = REFERENCE("deck.motion.heave.acceleration=1 m/s2");
    assert_true(bt_ship_pressing(&model.deck.motion, 9) == 10);
    assert_true(bt_ship_sleeping_error(&model.deck.motion, &model.deck.cable, -1, 1) == 0);
}

/* ---- what is refused ---- */

static void refused(const char* const* sets, int count, const char* key, const char* advice) {
    bt_study* study = malloc(sizeof *study);
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    assert_int_equal(bt_study_read("studies/reference/study.yaml", sets, count, study, &diag),
                     BT_ERR_INPUT);
    if (!strstr(kept.text, key) || !strstr(kept.text, advice))
        fail_msg("neither %s nor %s in: %s", key, advice, kept.text);
    free(study);
}
#define REFUSED(key, advice, ...)                                                                  \
    refused((const char* const[]){__VA_ARGS__},                                                    \
            (int)(sizeof((const char* const[]){__VA_ARGS__}) / sizeof(const char*)), key, advice)

static void motions_beyond_the_frame_are_refused(void** state) {
    (void)state;
    REFUSED("deck.motion.pitch: reaches", "all of it times 0.5",
            "deck.motion.pitch.rate=0.2 rad/s");
    REFUSED("deck.motion: the deck accelerates", "all of it times 0.7",
            "deck.motion.heave.amplitude=7 m", "deck.motion.heave.period=6.28318531 s",
            "deck.motion.heave.phase=90 deg");
    REFUSED("deck.motion.heave.velocity: the deck falls", "landing.sink_speed above 4.01 m/s",
            "deck.motion.heave.velocity=-4 m/s", "landing.sink_speed=3.6 m/s");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_deck_that_heaves_steadily_is_a_deck_at_rest),
        cmocka_unit_test(four_wires_on_a_deck_that_heaves_steadily_are_at_rest),
        cmocka_unit_test(heave_acceleration_is_gravity),
        cmocka_unit_test(the_glide_is_straight_over_a_deck_that_moves),
        cmocka_unit_test(the_frame_does_the_work_that_its_acceleration_asks_for),
        cmocka_unit_test(letting_a_wire_sleep_moves_the_margin_by_less_than_its_bound),
        cmocka_unit_test(a_wire_rests_under_what_presses_it_down),
        cmocka_unit_test(motions_beyond_the_frame_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
