#define _GNU_SOURCE
#include "near.h"

#include "elements/hook_damper_orifice.h"
#include "landing/stable_step.h"
#include "toy_study.h"

static double step_of(const bt_study* study, const char* element) {
    bt_stable_step steps[BT_STABLE_STEP_MAX];
    int count = 0;
    assert_int_equal(bt_stable_steps(&study->model, steps, &count, NULL), BT_OK);
    for (int i = 0; i < count; ++i)
        if (strcmp(steps[i].element, element) == 0)
            return steps[i].stable_s;
    fail_msg("no element %s", element);
    return 0;
}

/// 2 / omega is where the leapfrog on an undamped spring and mass stops being bounded.
static void a_down_stop_stepped_just_below_its_stable_step_stays_bounded(void** state) {
    (void)state;
    bt_study study;
    toy_study(&study, BT_DESIGN_SOBOL, 1);
    const bt_hook_params* hook = &study.model.aircraft.hook;
    const double lever = hook->damper_lever_m;
    const bt_hook_damper_orifice_params* damper = (const void*)hook->damper.params;
    const double k = damper->stop_stiffness_Npm * lever * lever, m = hook->inertia_kgm2;
    const double stable = step_of(&study, "aircraft.hook.damper");
    for (int above = 0; above < 2; ++above) {
        const double h = stable * (above ? 1.01 : 0.99);
        double x = 1, v = 0, most = 0;
        for (int i = 0; i < 2000; ++i) {
            v -= h * k / m * x;
            x += h * v;
            most = fmax(most, fabs(x));
        }
        assert_true(above ? most > 1e6 : most < 100);
    }
}

static void four_times_the_stiffness_halves_the_step(void** state) {
    (void)state;
    bt_study study;
    toy_study(&study, BT_DESIGN_SOBOL, 1);
    const double strut = step_of(&study, "aircraft.main_gear.oleo");
    study.model.aircraft.main_gear.oleo.stop_stiffness_Npm *= 4;
    BT_ASSERT_NEAR(step_of(&study, "aircraft.main_gear.oleo"), strut / 2, 1e-15, 0);
}

/// Undamped, omega^2 = 3/2 K delta^1/2 / m with delta = (5 m v^2 / (4 K))^(2/5) grows as (K^4
/// v^2)^(1/5).
static void eq10_the_shoe_s_step_follows_stiffness_and_sinking_velocity(void** state) {
    (void)state;
    bt_study study;
    toy_study(&study, BT_DESIGN_SOBOL, 1);
    study.model.aircraft.hook.deck_contact.dissipation_spm = 0;
    const double before = step_of(&study, "aircraft.hook.deck_contact");
    study.model.landing.sink_speed_mps *= 2;
    BT_ASSERT_NEAR(step_of(&study, "aircraft.hook.deck_contact"), before * pow(2, -0.2), 1e-14, 0);
    study.model.aircraft.hook.deck_contact.stiffness_Npm15 *= 10;
    BT_ASSERT_NEAR(step_of(&study, "aircraft.hook.deck_contact"),
                   before * pow(2, -0.2) * pow(10, -0.4), 1e-14, 0);
}

/// A spring with a damper that lags by half a step: bounded just below the step, not above it.
static void eq10_the_shoe_s_damping_shortens_its_step(void** state) {
    (void)state;
    bt_study study;
    toy_study(&study, BT_DESIGN_SOBOL, 1);
    bt_impact_params* contact = &study.model.aircraft.hook.deck_contact;
    contact->dissipation_spm = 0;
    const double undamped = step_of(&study, "aircraft.hook.deck_contact");
    contact->dissipation_spm = 0.8;
    const double damped = step_of(&study, "aircraft.hook.deck_contact");
    assert_true(damped < 0.6 * undamped);
    // omega = 2 / undamped; omega^2 h^2 + 2 g h = 4 gives the damping back
    const double omega2 = 4 / (undamped * undamped);
    const double g = (4 - omega2 * damped * damped) / (2 * damped);
    for (int above = 0; above < 2; ++above) {
        const double h = damped * (above ? 1.02 : 0.98);
        double x = 1, v = 0, most = 0;
        for (int i = 0; i < 3000; ++i) {
            v -= h * (omega2 * x + g * v);
            x += h * v;
            most = fmax(most, fabs(x));
        }
        assert_true(above ? most > 1e6 : most < 100);
    }
}

/// The axial Courant step l / sqrt(EA / mu) bounds the cable's.
static void the_cable_s_step_is_near_its_courant_step(void** state) {
    (void)state;
    bt_study study;
    toy_study(&study, BT_DESIGN_SOBOL, 1);
    const bt_cable_params* cable = &study.model.deck.cable;
    const double courant =
        cable->mesh.fine_length_m / sqrt(cable->axial_stiffness_N / cable->mass_kgpm);
    const double stable = step_of(&study, "deck.cable");
    assert_true(stable <= courant && stable >= 0.85 * courant);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_down_stop_stepped_just_below_its_stable_step_stays_bounded),
        cmocka_unit_test(four_times_the_stiffness_halves_the_step),
        cmocka_unit_test(eq10_the_shoe_s_step_follows_stiffness_and_sinking_velocity),
        cmocka_unit_test(eq10_the_shoe_s_damping_shortens_its_step),
        cmocka_unit_test(the_cable_s_step_is_near_its_courant_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
