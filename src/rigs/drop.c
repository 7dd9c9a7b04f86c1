#include "elements/strut.h"
#include "elements/wheel.h"
#include "rigs/rig.h"

#include <math.h>

enum { BODY_MASS, BODY_PISTON, BODY_WHEEL };

typedef struct drop_rig {
    bt_rig rig;
    int strut, wheel;
    double lift_N;
    double start_m;       ///< height of the mass at touchdown
    double rolling_radps; ///< wheel speed that follows the belt
    double unsprung_kg, sink_mps;
    bt_oleo oleo;
    bt_tyre tyre;
} drop_rig;

static void add_bodies(const bt_gear_params* gear, const bt_drop_params* drop, double stroke_m,
                       drop_rig* d) {
    const double axle = gear->tyre.radius_m, unsprung = gear->piston_mass_kg + gear->wheel_mass_kg;
    const double sprung = drop->mass_kg - unsprung,
                 across = bt_wheel_inertia_across(gear->wheel_inertia_kgm2);
    d->start_m = axle + 1 - stroke_m;
    const bt_body_def bodies[] = {
        {.name = "mass",
         .mass_kg = sprung,
         .inertia_kgm2 = {sprung, sprung, sprung},
         .position_m = {0, 0, d->start_m}},
        {.name = "piston",
         .mass_kg = gear->piston_mass_kg,
         .inertia_kgm2 = {gear->piston_mass_kg, gear->piston_mass_kg, gear->piston_mass_kg},
         .position_m = {0, 0, axle}},
        {.name = "wheel",
         .mass_kg = gear->wheel_mass_kg,
         .inertia_kgm2 = {across, gear->wheel_inertia_kgm2, across},
         .position_m = {0, 0, axle}},
    };
    for (int i = 0; i < 3; ++i) {
        bt_body_def body = bodies[i];
        body.attitude[0] = 1;
        body.velocity_mps[2] = -d->sink_mps;
        bt_rig_add_body(&d->rig, &body);
    }
}

static void add_joints(bt_system* system, double mass_height_m) {
    const bt_joint_def guides = {.name = "guides",
                                 .kind = BT_JOINT_PRISMATIC,
                                 .body_a = BT_GROUND,
                                 .body_b = BODY_MASS,
                                 .axis_a = {0, 0, 1},
                                 .axis_b = {0, 0, 1},
                                 .attitude_ab = {1, 0, 0, 0}};
    const bt_joint_def slide = {.name = "slide",
                                .kind = BT_JOINT_PRISMATIC,
                                .body_a = BODY_MASS,
                                .body_b = BODY_PISTON,
                                .point_a_m = {0, 0, -mass_height_m},
                                .axis_a = {0, 0, 1},
                                .axis_b = {0, 0, 1},
                                .attitude_ab = {1, 0, 0, 0}};
    const bt_joint_def axle = {.name = "axle",
                               .kind = BT_JOINT_REVOLUTE,
                               .body_a = BODY_PISTON,
                               .body_b = BODY_WHEEL,
                               .axis_a = {0, 1, 0},
                               .axis_b = {0, 1, 0}};
    bt_system_add_joint(system, &guides);
    bt_system_add_joint(system, &slide);
    bt_system_add_joint(system, &axle);
}

static bt_status build(const bt_gear_params* gear, const bt_drop_params* drop, drop_rig* d) {
    const double unsprung = gear->piston_mass_kg + gear->wheel_mass_kg;
    if (drop->mass_kg <= unsprung) {
        bt_diag_add(d->rig.diag, BT_ERROR, BT_NOWHERE,
                    "mass: the drop mass of %g kg is not above that of piston and wheel, %g kg",
                    drop->mass_kg, unsprung);
        return BT_ERR_INPUT;
    }
    const double height = 1; // of the mass above the axle, strut extended; any will do
    bt_strut strut = {.point_a_m = {0, 0, -height}, .axis_a = {0, 0, 1}};
    bt_oleo_prepare(&gear->oleo, &strut.oleo);
    d->oleo = strut.oleo;
    d->unsprung_kg = unsprung;
    d->sink_mps = drop->drop_height_m > 0 ? sqrt(2 * drop->gravity_mps2 * drop->drop_height_m)
                                          : drop->sink_speed_mps;
    bt_wheel wheel = {.deck_velocity_mps = {-drop->belt_speed_mps, 0, 0}};
    bt_tyre_prepare(&gear->tyre, &wheel.tyre);
    d->tyre = wheel.tyre;
    // As it falls: the stop carries the gas, and what the unsprung parts feel of the lift.
    const double effective_mps2 = drop->lift_ratio * drop->gravity_mps2;
    add_bodies(gear, drop, bt_oleo_hanging_stroke(&strut.oleo, unsprung * effective_mps2), d);
    add_joints(d->rig.system, height);
    d->strut = bt_system_add_element(d->rig.system, &(bt_element){.type = &bt_strut_type,
                                                                  .name = "strut",
                                                                  .body_a = BODY_MASS,
                                                                  .body_b = BODY_PISTON,
                                                                  .data = &strut});
    d->wheel = bt_system_add_element(d->rig.system, &(bt_element){.type = &bt_wheel_type,
                                                                  .name = "tyre",
                                                                  .body_a = BODY_WHEEL,
                                                                  .body_b = BT_GROUND,
                                                                  .data = &wheel});
    d->lift_N = drop->lift_ratio * drop->mass_kg * drop->gravity_mps2;
    d->rolling_radps = drop->belt_speed_mps / gear->tyre.radius_m;
    return bt_rig_start(&d->rig, drop->gravity_mps2);
}

enum { STROKE, STROKE_RATE, STRUT_FORCE, SINKAGE, TYRE, TYRE_FORCE, DRAG, SPIN };

const char* const bt_drop_channels[BT_DROP_CHANNELS] = {
    "stroke_m",           "stroke_rate_mps", "strut_force_N", "sinkage_m",
    "tyre_compression_m", "tyre_force_N",    "drag_force_N",  "wheel_spin_radps"};

static void look(const drop_rig* d, double channel[BT_DROP_CHANNELS]) {
    const double* strut = bt_rig_output(&d->rig, d->strut);
    const double* wheel = bt_rig_output(&d->rig, d->wheel);
    channel[STROKE] = strut[BT_STRUT_STROKE];
    channel[STROKE_RATE] = strut[BT_STRUT_RATE];
    channel[STRUT_FORCE] = strut[BT_STRUT_FORCE];
    channel[SINKAGE] = d->start_m - d->rig.state.q[7 * BODY_MASS + 2];
    channel[TYRE] = wheel[BT_WHEEL_DEFLECTION];
    channel[TYRE_FORCE] = wheel[BT_WHEEL_NORMAL];
    channel[DRAG] = -wheel[BT_WHEEL_FORWARD];
    channel[SPIN] = d->rig.state.v[6 * BODY_WHEEL + 4];
}

/// What is kept of a run: extremes, the work done on the strut, spin-up.
typedef struct record {
    double most[BT_DROP_CHANNELS];
    double work_J;  ///< until now
    double taken_J; ///< until the largest stroke
    double last_stroke, last_force, spin_up_s;
} record;

static void keep(record* r, const drop_rig* d, const double channel[BT_DROP_CHANNELS]) {
    r->work_J += 0.5 * (channel[STRUT_FORCE] + r->last_force) *
                 (fmax(channel[STROKE], 0) - fmax(r->last_stroke, 0));
    if (channel[STROKE] > r->most[STROKE])
        r->taken_J = r->work_J;
    for (int i = 0; i < BT_DROP_CHANNELS; ++i)
        r->most[i] = fmax(r->most[i], channel[i]);
    r->last_stroke = channel[STROKE];
    r->last_force = channel[STRUT_FORCE];
    // A loaded tyre turns faster than the belt over its free radius, so this is reached.
    if (isnan(r->spin_up_s) && d->rolling_radps != 0 && channel[SPIN] / d->rolling_radps >= 0.99)
        r->spin_up_s = d->rig.state.time_s;
}

/// The error that is accepted of one value.
static double accepted(const bt_drop_reference_params* ref, double own) {
    return own > 0 ? own : ref->tolerance;
}

static void report(const bt_drop_params* drop, const record* r, const drop_rig* d,
                   bt_rig_result* result) {
    const bt_drop_reference_params* ref = &drop->reference;
    const double tyre_J = bt_tyre_energy(&d->tyre, r->most[TYRE]);
    bt_rig_result_begin(&d->rig, result);
    bt_rig_add(result, "stroke_max_m", "m", r->most[STROKE], ref->stroke_max_m,
               accepted(ref, ref->stroke_max_tolerance));
    bt_rig_add(result, "sinkage_max_m", "m", r->most[SINKAGE], ref->sinkage_max_m,
               accepted(ref, ref->sinkage_max_tolerance));
    bt_rig_add(result, "tyre_compression_max_m", "m", r->most[TYRE], ref->tyre_compression_max_m,
               accepted(ref, ref->tyre_compression_max_tolerance));
    bt_rig_add(result, "tyre_force_max_N", "N", r->most[TYRE_FORCE], ref->tyre_force_max_N,
               accepted(ref, ref->tyre_force_max_tolerance));
    bt_rig_add(result, "strut_force_max_N", "N", r->most[STRUT_FORCE], ref->strut_force_max_N,
               accepted(ref, ref->strut_force_max_tolerance));
    bt_rig_add(result, "drag_force_max_N", "N", r->most[DRAG] + 0.0, 0, 0); // no -0
    bt_rig_add(result, "efficiency", "1", r->taken_J / (r->most[STRUT_FORCE] * r->most[STROKE]),
               ref->efficiency, accepted(ref, ref->efficiency_tolerance));
    bt_rig_add(result, "spin_up_time_s", "s", r->spin_up_s, 0, 0);
    bt_rig_add(result, "strut_energy_J", "J", r->taken_J, ref->strut_energy_J,
               accepted(ref, ref->strut_energy_tolerance));
    bt_rig_add(result, "tyre_energy_J", "J", tyre_J, ref->tyre_energy_J,
               accepted(ref, ref->tyre_energy_tolerance));
    bt_rig_add(result, "tyre_efficiency", "1", tyre_J / (r->most[TYRE_FORCE] * r->most[TYRE]),
               ref->tyre_efficiency, accepted(ref, ref->tyre_efficiency_tolerance));
    bt_rig_add_energy(&d->rig, result, 2, (const int[]){d->strut, d->wheel},
                      (const char* const[]){"strut_taken_J", "tyre_taken_J"});
}

/// Slope of the friction over the rate where it changes sign, if the next step may lead there:
/// phi' is 3 / (2 friction_speed) at rest.
static double friction_slope(const drop_rig* d, double stroke_m, double rate_mps,
                             double last_rate_mps) {
    const bt_oleo* o = &d->oleo;
    const double speed = o->friction_speed;
    if (!o->has_friction || fabs(rate_mps) > speed + 2 * fabs(rate_mps - last_rate_mps))
        return 0;
    const double full = bt_oleo_friction_force(o, stroke_m, speed, bt_oleo_gas_force(o, stroke_m),
                                               bt_oleo_oil_force(o, stroke_m, rate_mps));
    return 1.5 * full / speed;
}

/// Stiffness that the unsprung mass may feel in the next step: the tyre's, and the stop's where it
/// comes near.
static double stiffness(const bt_drop_params* drop, const drop_rig* d,
                        const double channel[BT_DROP_CHANNELS]) {
    const bt_oleo* o = &d->oleo;
    const double ahead = channel[STROKE] + channel[STROKE_RATE] * drop->step_s;
    const bool stops =
        fmin(channel[STROKE], ahead) < 0 || fmax(channel[STROKE], ahead) > o->stops.stroke_max;
    const double deflection = channel[TYRE] + d->sink_mps * drop->step_s;
    return bt_tyre_stiffness(&d->tyre, deflection) + (stops ? o->stops.stiffness : 0);
}

/// The step that is asked for, or a shorter one: half of 1 / omega of the unsprung mass on what it
/// stands on; and where its damping would be unstable: 0.8 of m / (dF/ds'), with dF_h/ds' = 2 F_h /
/// s' and the slope of the friction. A rebound valve asks for it when the wheel has left the
/// platform.
static double next_step(const bt_drop_params* drop, const drop_rig* d, double stroke_m,
                        double rate_mps, double last_rate_mps, double stiffness_Npm) {
    const double oil =
        rate_mps != 0 ? 2 * bt_oleo_oil_force(&d->oleo, stroke_m, rate_mps) / rate_mps : 0;
    const double damping = oil + friction_slope(d, stroke_m, rate_mps, last_rate_mps);
    double step = drop->step_s;
    if (damping * step > 0.8 * d->unsprung_kg)
        step = 0.8 * d->unsprung_kg / damping;
    if (stiffness_Npm * step * step > 0.25 * d->unsprung_kg)
        step = 0.5 * sqrt(d->unsprung_kg / stiffness_Npm);
    return step;
}

static bt_status run_drop(const bt_gear_params* gear, const bt_drop_params* drop, drop_rig* d,
                          bt_rig_result* result) {
    BT_TRY(build(gear, drop, d));
    d->rig.state.applied[6 * BODY_MASS + 2] = d->lift_N;
    BT_TRY(bt_rig_begin(&d->rig));
    record r = {.spin_up_s = NAN};
    double channel[BT_DROP_CHANNELS], last_rate = 0;
    look(d, channel);
    bt_rig_show(&d->rig, BT_DROP_CHANNELS, bt_drop_channels, channel);
    while (d->rig.state.time_s < drop->duration_s - 1e-6 * drop->step_s) {
        const double left = drop->duration_s - d->rig.state.time_s;
        const double rate = channel[STROKE_RATE];
        const double step =
            next_step(drop, d, channel[STROKE], rate, last_rate, stiffness(drop, d, channel));
        last_rate = rate;
        BT_TRY(bt_rig_step(&d->rig, fmin(step, left)));
        look(d, channel);
        keep(&r, d, channel);
        bt_rig_show(&d->rig, BT_DROP_CHANNELS, bt_drop_channels, channel);
    }
    report(drop, &r, d, result);
    return BT_OK;
}

bt_status bt_rig_run_drop(const bt_gear_params* gear, const bt_drop_params* drop,
                          bt_rig_result* result, bt_rig_observer* observer, void* user,
                          bt_diag* diag) {
    drop_rig d = {0};
    bt_status status = bt_rig_open(&d.rig, observer, user, diag);
    if (status == BT_OK)
        status = run_drop(gear, drop, &d, result);
    bt_rig_close(&d.rig);
    return status;
}
