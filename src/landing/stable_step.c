#include "landing/stable_step.h"

#include "cable/cable.h"
#include "elements/tyre.h"
#include "landing/leg.h"
#include "landing/shank.h"

#include <math.h>
#include <stdlib.h>

static double step_of(double stiffness, double mass) {
    return 2 / sqrt(stiffness / mass);
}

static double tyre_slope(const bt_tyre_params* params) {
    bt_tyre tyre;
    bt_tyre_prepare(params, &tyre);
    const double d = 0.1 * params->radius_m, h = 1e-4 * params->radius_m;
    return (bt_tyre_load(&tyre, d + h) - bt_tyre_load(&tyre, d - h)) / (2 * h);
}

/// Largest h with omega^2 h^2 + 2 g h <= 4: leapfrog with the damping of the last half step.
static double damped_step(double stiffness, double damping, double mass) {
    const double omega2 = stiffness / mass, g = damping / mass;
    return (sqrt(g * g + 4 * omega2) - g) / omega2;
}

/// Contact of the shoe at the depth of an impact at the sinking velocity; the hook's effective
/// mass at the shoe is I / x^2, x the horizontal distance of shoe and pivot.
static double shoe_step(const bt_model_params* model) {
    const bt_hook_params* hook = &model->aircraft.hook;
    bt_impact contact;
    bt_impact_prepare(&hook->deck_contact, &contact);
    const double angle = fmin(hook->down_stop_rad, 1.4), arm = hook->length_m * cos(angle);
    bt_shank shank;
    bt_shank_prepare(hook, &shank);
    const double mass = shank.bends ? bt_shank_effective_mass(&shank, hook->length_m, angle)
                                    : hook->inertia_kgm2 / (arm * arm);
    const double v = model->landing.sink_speed_mps;
    const double depth = pow(1.25 * mass * v * v / contact.stiffness, 0.4);
    return damped_step(1.5 * contact.stiffness * sqrt(depth),
                       contact.dissipation * contact.stiffness * depth * sqrt(depth), mass);
}

static bt_status cable_step(const bt_model_params* model, double* stable_s, bt_diag* diag) {
    enum { N = BT_CABLE_SEGMENTS_MAX };
    bt_arena arena = {0};
    BT_TRY(bt_arena_create(&arena, bt_cable_memory(N, 1) + sizeof(double) * N));
    bt_cable_def def;
    bt_cable_model cable;
    bt_cable_def_init(&def, &model->deck.cable, model->deck.gravity_mps2,
                      BT_TAKE(&arena, double, N));
    const bt_status status = bt_cable_model_init(&cable, &def, &arena, diag);
    if (status == BT_OK)
        *stable_s = bt_cable_stable_step(&cable);
    bt_arena_destroy(&arena);
    return status;
}

int bt_airframe_stable_steps(const bt_model_params* model, bt_stable_step* steps) {
    static const char airframe[] = "landing.solver.airframe_step";
    static const char contact[] = "landing.solver.contact_step";
    const bt_gear_params* nose = &model->aircraft.nose_gear;
    const bt_gear_params* main_gear = &model->aircraft.main_gear;
    const bt_hook_params* hook = &model->aircraft.hook;
    const bt_solver_params* solver = &model->landing.solver;
    bt_leg nose_leg, main_leg;
    bt_leg_prepare(nose, &nose_leg);
    bt_leg_prepare(main_gear, &main_leg);
    const double lever = hook->damper_lever_m;
    bt_shank shank;
    bt_shank_prepare(hook, &shank);
    const double about_pivot = shank.bends ? bt_shank_root_inertia(&shank) : hook->inertia_kgm2;
    const double flight_s = solver->airframe_step_s;
    const double contact_s = fmin(solver->contact_step_s, flight_s);
    bt_hook_damper damper;
    bt_hook_damper_prepare(&hook->damper, &damper);
    const bt_stable_step all[] = {
        {"aircraft.nose_gear.oleo", airframe,
         step_of(nose->oleo.stop_stiffness_Npm, nose_leg.stroke_kg), flight_s},
        {"aircraft.nose_gear.tyre", airframe, step_of(tyre_slope(&nose->tyre), nose_leg.axle_kg),
         flight_s},
        {"aircraft.main_gear.oleo", airframe,
         step_of(main_gear->oleo.stop_stiffness_Npm, main_leg.stroke_kg), flight_s},
        {"aircraft.main_gear.tyre", airframe,
         step_of(tyre_slope(&main_gear->tyre), main_leg.axle_kg), flight_s},
        {"aircraft.hook.damper", contact,
         bt_hook_damper_step_limit(&damper, about_pivot / (lever * lever)), contact_s},
        {"aircraft.hook.deck_contact", contact, shoe_step(model), contact_s},
        {"aircraft.hook.shank", airframe, 2 / sqrt(bt_shank_frequency2(&shank)), flight_s},
    };
    const int count = (int)(sizeof all / sizeof all[0]) - !shank.bends;
    for (int i = 0; i < count; ++i)
        steps[i] = all[i];
    return count;
}

bt_status bt_stable_steps(const bt_model_params* model, bt_stable_step* steps, int* count,
                          bt_diag* diag) {
    double cable_s = 0;
    BT_TRY(cable_step(model, &cable_s, diag));
    *count = bt_airframe_stable_steps(model, steps);
    steps[(*count)++] = (bt_stable_step){"deck.cable", "landing.solver.cable_courant", cable_s,
                                         cable_s * model->landing.solver.cable_courant};
    return BT_OK;
}
