/// Balances of a whole landing, seen from outside through its observer: momentum, energy, the
/// hook's free body, and convergence with the step.
#include "reference.h"

#include "elements/hook_damper_element.h"
#include "landing/view.h"
#include "mechanics/vec.h"
#include "tables.h"

/// Masses of the bodies, from the parameters.
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

/* ---- vertical momentum ---- */

typedef struct momentum {
    double mass[BT_BODY_COUNT];
    double last_s, last_N, start_Ns, impulse_Ns, worst_Ns;
    bool begun;
} momentum;

static void see_momentum(void* user, const bt_landing_view* view) {
    momentum* m = user;
    if (view->cable_awake)
        return;
    double now_Ns = 0, force_N = view->hook_deck_force_N;
    for (int body = 0; body < BT_BODY_COUNT; ++body)
        now_Ns += m->mass[body] * view->v[6 * body + 2];
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        force_N += view->tyre_force_N[leg];
    if (m->begun)
        m->impulse_Ns += 0.5 * (force_N + m->last_N) * (view->time_s - m->last_s);
    else
        m->start_Ns = now_Ns;
    m->begun = true;
    m->last_s = view->time_s;
    m->last_N = force_N;
    m->worst_Ns = fmax(m->worst_Ns, fabs(now_Ns - m->start_Ns - m->impulse_Ns));
}

/// Lift carries the weight: what changes the vertical momentum are tyres and shoe alone.
static void vertical_momentum_is_the_impulse_of_deck_on_tyres_and_hook(void** state) {
    (void)state;
    const bt_model_params model = REFERENCE("landing.distance=14 m", "landing.sink_speed=5 m/s");
    momentum m = {.begun = false};
    masses(&model.aircraft, m.mass);
    bt_lander* lander = new_lander();
    land(lander, &model, see_momentum, &m);
    bt_lander_destroy(lander);
    assert_true(m.impulse_Ns > 1e4);
    // the integrator's own sum: trapezoidal, so that only rounding is left
    BT_VERIFY("landing", "vertical momentum less impulse of the deck, over impulse",
              m.worst_Ns / m.impulse_Ns, 0, 1e-12, "Newton");
}

/* ---- energy ---- */

typedef struct energy {
    double last_J, start_J, worst_rise_J;
    bool begun;
} energy;

static void see_energy(void* user, const bt_landing_view* view) {
    energy* e = user;
    if (view->cable_awake)
        return;
    if (e->begun)
        e->worst_rise_J = fmax(e->worst_rise_J, view->energy_J - e->last_J);
    else
        e->start_J = view->energy_J;
    e->begun = true;
    e->last_J = view->energy_J;
}

/// While nothing touches the cable, struts, tyres, damper, shoe and friction only take energy out:
/// kinetic, gravity, lift, gas, tyres and stops together never rise from step to step by more than
/// rounding.
static void check_energy(bt_model_params model, const char* quantity) {
    bt_lander* lander = new_lander();
    energy e = {.begun = false};
    land(lander, &model, see_energy, &e);
    bt_lander_destroy(lander);
    const double out_J = e.start_J - e.last_J;
    assert_true(out_J > 1e4); // something was taken out
    // rounding of 25 MJ
    BT_VERIFY("landing", quantity, e.worst_rise_J / out_J, 0, 1e-12, "dissipation");
}

static void energy_never_rises_before_the_cable(void** state) {
    (void)state;
    check_energy(REFERENCE("landing.distance=14 m", "landing.sink_speed=5 m/s"),
                 "largest rise of energy in a step over energy taken out");
    check_energy(REFERENCE("landing.distance=14 m", "landing.sink_speed=5 m/s",
                           "aircraft.hook.shank_bending_stiffness=1e6 N m^2"),
                 "the same, shank of 1 MN m^2");
}

/// Trailing arms under the main gear, whose struts stroke less than the wheel travels, and a nose
/// leg with a rake.
static void energy_never_rises_on_levered_and_raked_legs(void** state) {
    (void)state;
    check_energy(
        REFERENCE("landing.distance=14 m", "landing.sink_speed=5 m/s",
                  "aircraft.nose_gear.rake=10 deg", "aircraft.main_gear.type=levered",
                  "aircraft.main_gear.arm.pivot_x=0.7 m", "aircraft.main_gear.arm.pivot_z=0.25 m",
                  "aircraft.main_gear.arm.foot_x=0.25 m", "aircraft.main_gear.arm.foot_z=0.15 m",
                  "aircraft.main_gear.arm.head_x=0.45 m", "aircraft.main_gear.arm.head_z=1 m",
                  "aircraft.main_gear.oleo.stroke_max=0.3 m"),
        "the same, levered main gear, raked nose gear");
}

/* ---- energy, the cable included ---- */

/// What airframe and cable have lost otherwise than to each other: their energy at the start and
/// what they gained at the contacts, less what they have.
typedef struct ledger {
    double airframe_start_J, cable_start_J;
    double on_airframe_J, on_cable_J, friction_J; ///< works of the contacts so far
    double airframe_lost_J, cable_lost_J;
    double airframe_given_J, cable_given_J; ///< the most that they came back by
    double last_s, v[6 * BT_BODY_COUNT];
    bool begun;
} ledger;

static void see_ledger(void* user, const bt_landing_view* view) {
    ledger* b = user;
    const double cable_J = bt_landing_cable_energy(view);
    if (!b->begun) {
        b->airframe_start_J = view->energy_J;
        b->cable_start_J = cable_J;
    } else // a constant wrench during the step
        for (int k = 0; k < 6 * BT_BODY_COUNT; ++k)
            b->on_airframe_J +=
                (view->time_s - b->last_s) * view->cable_wrench[k] * 0.5 * (view->v[k] + b->v[k]);
    b->begun = true;
    b->last_s = view->time_s;
    memcpy(b->v, view->v, sizeof b->v);
    b->on_cable_J = view->cable_work_J;
    b->friction_J = view->friction_J;

    const double airframe_lost_J = b->airframe_start_J + b->on_airframe_J - view->energy_J;
    const double cable_lost_J = b->cable_start_J + b->on_cable_J - cable_J;
    b->airframe_given_J = fmax(b->airframe_given_J, b->airframe_lost_J - airframe_lost_J);
    b->cable_given_J = fmax(b->cable_given_J, b->cable_lost_J - cable_lost_J);
    b->airframe_lost_J = fmax(b->airframe_lost_J, airframe_lost_J);
    b->cable_lost_J = fmax(b->cable_lost_J, cable_lost_J);
}

/// A miss over the top, a catch, and a miss under wheels that have beaten the cable down.
static const double met_at_m[] = {2, 5.5, 8};

/// No damper, no friction and no loss on the deck in the cable: then all that the contacts give it
/// is in it. And what cable and airframe get together is negative, by friction and more.
static void without_dampers_the_cable_keeps_what_the_contacts_give_it(void** state) {
    (void)state;
    bt_model_params model =
        REFERENCE("deck.cable.axial_damping=0 N*s", "deck.cable.bending_damping=0 N*m2*s",
                  "deck.cable.twist_damping=0 N*m2*s", "deck.cable.supports.damping=0 N*s/m",
                  "deck.cable.sheaves.purchase_damping=0 N*s/m", "deck.cable.deck.friction=0",
                  "deck.cable.deck.restitution=1", "landing.solver.cable_courant=0.05");
    bt_lander* lander = new_lander();
    for (int k = 0; k < 3; ++k) {
        ledger b = {.begun = false};
        model.landing.distance_m = met_at_m[k];
        land(lander, &model, see_ledger, &b);
        assert_true(b.on_cable_J > 1e3);
        char text[80];
        snprintf(text, sizeof text, "undamped cable: energy lost over work done on it, D %g m",
                 met_at_m[k]);
        BT_VERIFY("landing", text, fmax(fabs(b.cable_lost_J), b.cable_given_J) / b.on_cable_J, 0,
                  1e-3, "conservation");
        assert_true(b.friction_J < 0);
        assert_true(b.on_airframe_J + b.on_cable_J < b.friction_J);
    }
    bt_lander_destroy(lander);
}

/// As it is, with all dampers and frictions: what is lost never comes back, in the cable within the
/// error of its step.
static void with_the_cable_too_nothing_gives_energy(void** state) {
    (void)state;
    bt_model_params model = REFERENCE("landing.solver.cable_courant=0.25");
    bt_lander* lander = new_lander();
    for (int k = 0; k < 3; ++k) {
        ledger b = {.begun = false};
        model.landing.distance_m = met_at_m[k];
        land(lander, &model, see_ledger, &b);
        char text[80];
        snprintf(text, sizeof text, "largest gain of the airframe over its losses, D %g m",
                 met_at_m[k]);
        BT_VERIFY("landing", text, b.airframe_given_J / b.airframe_lost_J, 0, 1e-11, "dissipation");
        snprintf(text, sizeof text, "largest gain of the cable over the work on it, D %g m",
                 met_at_m[k]);
        BT_VERIFY("landing", text, b.cable_given_J / b.on_cable_J, 0, 1e-3, "dissipation");
        assert_true(b.friction_J < 0);
        assert_true(b.on_airframe_J + b.on_cable_J < b.friction_J);
    }
    bt_lander_destroy(lander);
}

/* ---- the whole way over a deck of four wires ---- */

/// The hook rides over the first wire, the wheels roll over the others before it comes: energy that
/// is lost in any of it never comes back.
static void over_four_wires_nothing_gives_energy(void** state) {
    (void)state;
    const bt_model_params model =
        REFERENCE("landing.solver.cable_courant=0.25", "deck.wires.number=4",
                  "deck.wires.spacing=6 m", "landing.distance=2 m");
    bt_lander* lander = new_lander();
    ledger b = {.begun = false};
    const bt_landing_result r = land(lander, &model, see_ledger, &b);
    bt_lander_destroy(lander);
    assert_true(r.contact_count > 1);
    assert_int_equal(r.contacts[0].mode, BT_MODE_RIDDEN_OVER);
    BT_VERIFY("landing", "four wires: largest gain of the airframe over its losses",
              b.airframe_given_J / b.airframe_lost_J, 0, 1e-11, "dissipation");
    BT_VERIFY("landing", "four wires: largest gain of the cables over the work on them",
              b.cable_given_J / b.on_cable_J, 0, 1e-3, "dissipation");
    assert_true(b.friction_J < 0);
    assert_true(b.on_airframe_J + b.on_cable_J < b.friction_J);
}

/* ---- the hook's free body ---- */

typedef struct free_body {
    const bt_model_params* model;
    double before_mps[3], now_mps[3], before_s, now_s;
    double pivot_N[3], damper_N[3];
    bool flying; ///< the shoe was off the deck at the last view, too
    int count, checked;
    double worst, largest_N;
} free_body;

/// Direction of the damper, from its end on the fuselage to its end on the shank.
static void damper_direction(const bt_model_params* model, const bt_landing_view* view,
                             double along[3]) {
    const bt_hook_params* h = &model->aircraft.hook;
    const double* hook = view->rotation + 9 * BT_BODY_HOOK;
    double on_shank[3], on_fuselage[3], a[3], b[3];
    bt_hook_damper_place(h->down_stop_rad, h->damper_lever_m, h->damper_angle_rad,
                         h->damper_length_m, on_shank, on_fuselage);
    bt_rotate(view->rotation, on_fuselage, a);
    const double lever[3] = {-h->damper_lever_m, 0, 0};
    bt_rotate(hook, lever, b);
    for (int i = 0; i < 3; ++i)
        along[i] = b[i] - a[i];
    const double length = bt_norm(along);
    for (int i = 0; i < 3; ++i)
        along[i] /= length;
}

static void see_hook(void* user, const bt_landing_view* view) {
    free_body* f = user;
    const bt_hook_params* h = &f->model->aircraft.hook;
    const double* v = view->v + 6 * BT_BODY_HOOK;
    const double h1 = f->now_s - f->before_s, h2 = view->time_s - f->now_s;
    const bool off = view->hook_deck_force_N == 0 && view->hook_height_m > 5e-3;
    // at the last view: pivot and damper against the change of velocity around it
    if (f->flying && off && f->count >= 3 && !view->cable_awake && fabs(h1 - h2) < 1e-3 * h1) {
        double sum[3], missing = 0, size = 0;
        for (int i = 0; i < 3; ++i) {
            sum[i] =
                f->pivot_N[i] + f->damper_N[i] - h->mass_kg * (v[i] - f->before_mps[i]) / (h1 + h2);
            size = fmax(size, fabs(f->pivot_N[i]));
        }
        sum[2] -= h->mass_kg * f->model->deck.gravity_mps2;
        missing = bt_norm(sum);
        f->worst = fmax(f->worst, missing);
        f->largest_N = fmax(f->largest_N, size);
        ++f->checked;
    }
    f->count = off ? f->count + 1 : 0;
    f->flying = off;
    f->before_s = f->now_s;
    f->now_s = view->time_s;
    memcpy(f->before_mps, f->now_mps, sizeof f->now_mps);
    memcpy(f->now_mps, v, sizeof f->now_mps);
    memcpy(f->pivot_N, view->hook_pivot_force_N, sizeof f->pivot_N);
    double along[3];
    damper_direction(f->model, view, along);
    for (int i = 0; i < 3; ++i)
        f->damper_N[i] = view->hook_damper_force_N * along[i];
}

static void in_the_air_pivot_damper_and_weight_move_the_hook(void** state) {
    (void)state;
    bt_model_params model = REFERENCE("landing.distance=14 m", "landing.sink_speed=5 m/s");
    model.landing.solver.airframe_step_s = model.landing.solver.contact_step_s = 2e-5;
    free_body f = {.model = &model};
    bt_lander* lander = new_lander();
    land(lander, &model, see_hook, &f);
    bt_lander_destroy(lander);
    assert_true(f.checked > 500);
    BT_VERIFY("landing", "pivot + damper + weight - m a of the hook in the air, over pivot",
              f.worst / f.largest_N, 0, 1e-3, "Newton");
}

/* ---- convergence ---- */

static double first_bounce(bt_lander* lander, bt_model_params* model, double step_s) {
    model->landing.solver.airframe_step_s = model->landing.solver.contact_step_s = step_s;
    const bt_landing_result r = land(lander, model, NULL, NULL);
    assert_true(r.bounce_count > 0 && r.bounces[0].complete);
    return r.bounces[0].height_m;
}

/// The height of the first bounce against the step, with one and the same step throughout.
static void the_bounce_converges_at_second_order(void** state) {
    (void)state;
    bt_model_params model = REFERENCE("landing.distance=7 m");
    bt_lander* lander = new_lander();
    const double exact = first_bounce(lander, &model, 2.5e-6);
    double error[3];
    for (int k = 0; k < 3; ++k) {
        error[k] = fabs(first_bounce(lander, &model, 8e-5 / (1 << k)) - exact);
        char text[64];
        snprintf(text, sizeof text, "height of the first bounce, step %g us, m", 80.0 / (1 << k));
        BT_TABLE_ROW("landing", text, exact + error[k], exact, 1e-4, "step 2.5 us");
    }
    bt_lander_destroy(lander);
    // the shoe meets the deck anywhere in a step, so single orders scatter; over a factor of four
    const double order = 0.5 * log2(error[0] / error[2]);
    BT_VERIFY("landing", "order of the bounce height over a factor of 4 in the step",
              fmin(order, 2), 2, 0.5, "second-order integrator");
    BT_ASSERT_NEAR(error[0], 0, 0, 1e-4); // measured 0.05 mm
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertical_momentum_is_the_impulse_of_deck_on_tyres_and_hook),
        cmocka_unit_test(energy_never_rises_before_the_cable),
        cmocka_unit_test(energy_never_rises_on_levered_and_raked_legs),
        cmocka_unit_test(without_dampers_the_cable_keeps_what_the_contacts_give_it),
        cmocka_unit_test(with_the_cable_too_nothing_gives_energy),
        cmocka_unit_test(over_four_wires_nothing_gives_energy),
        cmocka_unit_test(in_the_air_pivot_damper_and_weight_move_the_hook),
        cmocka_unit_test(the_bounce_converges_at_second_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
