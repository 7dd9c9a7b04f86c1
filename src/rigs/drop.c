#include "elements/strut.h"
#include "elements/wheel.h"
#include "landing/leg.h"
#include "rigs/rig.h"

#include <math.h>

enum { BODY_MASS, BODY_PISTON, BODY_WHEEL };

typedef struct drop_rig {
    bt_rig rig;
    int strut, wheel, joint;
    double lift_N;
    double start_m;       ///< height of the mass at touchdown
    double rolling_radps; ///< wheel speed that follows the belt
    double sink_mps;
    bt_leg leg;
    bt_oleo oleo;
    bt_tyre tyre;
} drop_rig;

/// Height of the mass above the axle of the extended leg; any will do.
static const double above_axle_m = 1;

static void add_bodies(const bt_gear_params* gear, const bt_drop_params* drop, double stroke_m,
                       drop_rig* d) {
    const double sprung = drop->mass_kg - d->leg.unsprung_kg;
    bt_leg_place place;
    bt_leg_at(&d->leg, stroke_m, &place);
    d->start_m = gear->tyre.radius_m + above_axle_m - place.axle_m[2];
    bt_body_def bodies[3] = {{.mass_kg = sprung,
                              .inertia_kgm2 = {sprung, sprung, sprung},
                              .position_m = {0, 0, d->start_m},
                              .attitude = {1, 0, 0, 0}}};
    const double axle_m[3] = {0, 0, d->start_m - above_axle_m};
    bt_leg_describe(&d->leg, gear, stroke_m, axle_m, &bodies[BODY_PISTON], &bodies[BODY_WHEEL]);
    static const char* const names[] = {"mass", "piston", "wheel"};
    for (int i = 0; i < 3; ++i) {
        bodies[i].name = names[i];
        bodies[i].velocity_mps[2] = -d->sink_mps;
        bt_rig_add_body(&d->rig, &bodies[i]);
    }
}

static void add_joints(drop_rig* d) {
    const bt_joint_def guides = {.name = "guides",
                                 .kind = BT_JOINT_PRISMATIC,
                                 .body_a = BT_GROUND,
                                 .body_b = BODY_MASS,
                                 .axis_a = {0, 0, 1},
                                 .axis_b = {0, 0, 1},
                                 .attitude_ab = {1, 0, 0, 0}};
    const bt_leg_parts leg = {.airframe = BODY_MASS,
                              .piston = BODY_PISTON,
                              .wheel = BODY_WHEEL,
                              .axle_m = {0, 0, -above_axle_m},
                              .joint_name = "slide",
                              .axle_name = "axle",
                              .strut_name = "strut"};
    bt_system_add_joint(d->rig.system, &guides);
    d->strut = bt_leg_add(d->rig.system, &d->leg, &d->oleo, &leg, &d->joint);
}

static bt_status build(const bt_gear_params* gear, const bt_drop_params* drop, drop_rig* d) {
    bt_leg_prepare(gear, &d->leg);
    if (drop->mass_kg <= d->leg.unsprung_kg) {
        bt_diag_add(d->rig.diag, BT_ERROR, BT_NOWHERE,
                    "mass: the drop mass of %g kg is not above that of piston and wheel, %g kg",
                    drop->mass_kg, d->leg.unsprung_kg);
        return BT_ERR_INPUT;
    }
    bt_gear_prepare_oleo(gear, &d->oleo);
    d->sink_mps = drop->drop_height_m > 0 ? sqrt(2 * drop->gravity_mps2 * drop->drop_height_m)
                                          : drop->sink_speed_mps;
    bt_wheel wheel = {.deck_velocity_mps = {-drop->belt_speed_mps, 0, 0}};
    bt_tyre_prepare(&gear->tyre, &wheel.tyre);
    d->tyre = wheel.tyre;
    // As it falls: the stop carries the gas, and what the unsprung parts feel of the lift.
    const double effective_mps2 = drop->lift_ratio * drop->gravity_mps2;
    add_bodies(gear, drop, bt_leg_hanging_stroke(&d->leg, &d->oleo, effective_mps2), d);
    add_joints(d);
    d->wheel = bt_system_add_element(d->rig.system, &(bt_element){.type = &bt_wheel_type,
                                                                  .name = "tyre",
                                                                  .body_a = BODY_WHEEL,
                                                                  .body_b = BT_GROUND,
                                                                  .data = &wheel});
    d->lift_N = drop->lift_ratio * drop->mass_kg * drop->gravity_mps2;
    d->rolling_radps = drop->belt_speed_mps / gear->tyre.radius_m;
    return bt_rig_start(&d->rig, drop->gravity_mps2);
}

enum { STROKE, STROKE_RATE, STRUT_FORCE, SINKAGE, TYRE, TYRE_FORCE, DRAG, SPIN, SIDE };

const char* const bt_drop_channels[BT_DROP_CHANNELS] = {
    "stroke_m",     "stroke_rate_mps", "strut_force_N",    "sinkage_m",   "tyre_compression_m",
    "tyre_force_N", "drag_force_N",    "wheel_spin_radps", "side_force_N"};

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
    double force_N[3], torque_Nm[3];
    bt_system_joint_load(d->rig.system, &d->rig.state, d->joint, force_N, torque_Nm);
    channel[SIDE] = bt_leg_side_force(&d->leg, d->rig.state.rotation + 9 * BODY_MASS, force_N);
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
    bt_rig_add(result, "side_force_max_N", "N", r->most[SIDE], 0, 0);
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

/// Longest step of a wheel that rolls: 0.8 of m / (dF/dv), F its friction over the slip speed, m
/// what turns and what goes along. Upright on a platform at rest it does neither.
static double rolling_step(const bt_gear_params* gear, const bt_drop_params* drop,
                           const drop_rig* d, const double channel[BT_DROP_CHANNELS]) {
    const double forward = d->rig.state.v[6 * BODY_WHEEL] + drop->belt_speed_mps;
    if ((forward == 0 && channel[SPIN] == 0) || !(channel[TYRE_FORCE] > 0))
        return INFINITY;
    static const double small = 1e-6;
    const bt_tyre* t = &d->tyre;
    const double slope = bt_tyre_slip_friction(t, small) / small * channel[TYRE_FORCE] /
                         hypot(forward, t->slip_speed);
    const double r2 = t->radius * t->radius;
    return 0.8 / (slope * (r2 / gear->wheel_inertia_kgm2 + 1 / d->leg.axle_kg));
}

/// The step that is asked for, or a shorter one: half of 1 / omega of the unsprung mass on what it
/// stands on; and where its damping would be unstable: 0.8 of m / (dF/ds'), with dF_h/ds' = 2 F_h /
/// s' and the slope of the friction. A rebound valve asks for it when the wheel has left the
/// platform.
static double next_step(const bt_gear_params* gear, const bt_drop_params* drop, const drop_rig* d,
                        const double channel[BT_DROP_CHANNELS], double last_rate_mps) {
    const double stroke = channel[STROKE], rate = channel[STROKE_RATE];
    const double stiffness_Npm = stiffness(drop, d, channel);
    const double oil = rate != 0 ? 2 * bt_oleo_oil_force(&d->oleo, stroke, rate) / rate : 0;
    const double damping = oil + friction_slope(d, stroke, rate, last_rate_mps);
    const double least_kg = fmin(d->leg.stroke_kg, d->leg.axle_kg);
    double step = fmin(drop->step_s, rolling_step(gear, drop, d, channel));
    if (damping * step > 0.8 * d->leg.stroke_kg)
        step = 0.8 * d->leg.stroke_kg / damping;
    if (stiffness_Npm * step * step > 0.25 * least_kg)
        step = 0.5 * sqrt(least_kg / stiffness_Npm);
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
        const double step = next_step(gear, drop, d, channel, last_rate);
        last_rate = channel[STROKE_RATE];
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
