#include "landing/airframe.h"

#include "elements/hook_damper_element.h"
#include "elements/torque.h"
#include "elements/wheel.h"
#include "elements/yaw_damper.h"
#include "mechanics/vec.h"

#include <math.h>
#include <string.h>

const char* const bt_body_names[BT_BODY_COUNT] = {"fuselage",     "nose_piston", "left_piston",
                                                  "right_piston", "nose_wheel",  "left_wheel",
                                                  "right_wheel",  "hook"};

enum { BODIES_MAX = BT_BODY_COUNT + 1, SHANK_ROOT = BT_BODY_COUNT };

static const bt_gear_params* gear_of(const bt_aircraft_params* aircraft, int leg) {
    return leg == BT_LEG_NOSE ? &aircraft->nose_gear : &aircraft->main_gear;
}

/// Axles and pivot from the centre of gravity, struts fully extended.
static void place_parts(const bt_aircraft_params* p, bt_airframe* f) {
    static const double side[BT_LEG_COUNT] = {0, 1, -1};
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const bt_gear_params* gear = gear_of(p, leg);
        bt_tyre_prepare(&gear->tyre, &f->tyre[leg]);
        bt_gear_prepare_oleo(gear, &f->oleo[leg]);
        bt_leg_prepare(gear, &f->leg[leg]);
        f->tyre_width_m[leg] = gear->tyre.width_m * (double)gear->tyre.tyres;
        f->axle_m[leg][0] = gear->station_m;
        f->axle_m[leg][1] = side[leg] * gear->half_track_m;
        f->axle_m[leg][2] = gear->underside_m + gear->tyre.radius_m;
    }
    f->pivot_m[0] = p->hook.pivot_x_m;
    f->pivot_m[1] = 0;
    f->pivot_m[2] = p->hook.pivot_z_m;
    bt_shank_prepare(&p->hook, &f->shank);
    f->body_count = f->shank.bends ? BODIES_MAX : BT_BODY_COUNT;
    f->shoe_m[0] = f->shank.head.centre_m - p->hook.length_m;
    f->shoe_m[1] = f->shoe_m[2] = 0;
}

/// Euler parameters of the hook's body at a shank angle below the fuselage axis.
static void hook_attitude(double angle_rad, double e[4]) {
    e[0] = cos(0.5 * angle_rad);
    e[1] = e[3] = 0;
    e[2] = -sin(0.5 * angle_rad);
}

/// What is left of the aircraft's inertia once gear and hook are taken off must be the inertia of
/// some mass: its second moments, (J_xx + J_zz - J_yy)/2 and so on, are those of a positive
/// semidefinite matrix. With J_xy = J_yz = 0 that is
/// sqrt((J_zz - J_xx)^2 + 4 J_xz^2) <= J_yy <= J_xx + J_zz, said of the aircraft's own J_yy.
static bt_status check_inertia(const bt_aircraft_params* p, const double inertia[6],
                               bt_diag* diag) {
    const double xx = inertia[0], yy = inertia[1], zz = inertia[2], xz = inertia[4];
    const double least = hypot(zz - xx, 2 * xz), most = xx + zz;
    const double parts = p->inertia_yy_kgm2 - yy;
    if (!(xx > 0 && zz > 0 && least < most)) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "aircraft.inertia_%s: %g kg m^2 leaves the fuselage none once gear and hook "
                    "are taken off: inertia_xx above %g, inertia_zz above %g kg m^2, their "
                    "excesses' product above inertia_xz^2",
                    xx > 0 ? "zz" : "xx", xx > 0 ? p->inertia_zz_kgm2 : p->inertia_xx_kgm2,
                    p->inertia_xx_kgm2 - xx, p->inertia_zz_kgm2 - zz);
        return BT_ERR_INPUT;
    }
    if (yy >= least && yy <= most)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                "aircraft.inertia_yy: %g kg m^2 is outside %g .. %g kg m^2: with inertia_xx, "
                "inertia_zz and the masses as they are, no fuselage has it",
                p->inertia_yy_kgm2, least + parts, most + parts);
    return BT_ERR_INPUT;
}

/// Mass, place and inertia of the fuselage: the whole aircraft less its parts.
static bt_status add_fuselage(const bt_aircraft_params* p, const bt_body_def* parts, bt_airframe* f,
                              bt_diag* diag) {
    double mass = p->mass_kg, first[3] = {0};
    double inertia[6] = {
        p->inertia_xx_kgm2, p->inertia_yy_kgm2, p->inertia_zz_kgm2, 0, p->inertia_xz_kgm2, 0};
    for (int body = 1; body < f->body_count; ++body) {
        const bt_body_def* part = &parts[body];
        const double* r = part->position_m;
        double a[9], turned[9] = {0};
        bt_rotation_from_euler(part->attitude, a);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                for (int k = 0; k < 3; ++k)
                    turned[3 * i + j] += a[3 * i + k] * part->inertia_kgm2[k] * a[3 * j + k];
        mass -= part->mass_kg;
        bt_add_scaled(first, -part->mass_kg, r);
        const double r2 = bt_dot(r, r);
        for (int i = 0; i < 3; ++i)
            inertia[i] -= turned[4 * i] + part->mass_kg * (r2 - r[i] * r[i]);
        inertia[3] -= turned[1] - part->mass_kg * r[0] * r[1];
        inertia[4] -= turned[2] - part->mass_kg * r[0] * r[2];
        inertia[5] -= turned[5] - part->mass_kg * r[1] * r[2];
    }
    if (!(mass > 0)) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "aircraft.mass: %g kg is not more than the mass of gear and hook, %g kg",
                    p->mass_kg, p->mass_kg - mass);
        return BT_ERR_INPUT;
    }
    double* r = f->fuselage_m;
    for (int i = 0; i < 3; ++i)
        r[i] = first[i] / mass;
    for (int i = 0; i < 3; ++i)
        inertia[i] -= mass * (bt_dot(r, r) - r[i] * r[i]);
    inertia[3] += mass * r[0] * r[1];
    inertia[4] += mass * r[0] * r[2];
    inertia[5] += mass * r[1] * r[2];
    BT_TRY(check_inertia(p, inertia, diag));

    bt_body_def fuselage = {.name = bt_body_names[BT_BODY_FUSELAGE],
                            .mass_kg = mass,
                            .position_m = {r[0], r[1], r[2]},
                            .attitude = {1, 0, 0, 0}};
    memcpy(fuselage.inertia_kgm2, inertia, sizeof inertia);
    bt_system_add_body(f->system, &fuselage);
    return BT_OK;
}

/// A part of the hook as it hangs: straight from the pivot to `turned_m`, from there on at its
/// angle.
static void describe_shank(const bt_shank_part* part, double turned_m, double angle_rad,
                           const bt_airframe* f, const char* name, bt_body_def* body) {
    const double c = cos(angle_rad), s = sin(angle_rad), along = part->centre_m - turned_m;
    *body = (bt_body_def){
        .name = name,
        .mass_kg = part->mass_kg,
        .inertia_kgm2 = {part->axial_inertia_kgm2, part->inertia_kgm2, part->inertia_kgm2},
        .position_m = {f->pivot_m[0] - turned_m * cos(f->hook_angle_rad) - along * c, 0,
                       f->pivot_m[2] - turned_m * sin(f->hook_angle_rad) - along * s},
    };
    hook_attitude(angle_rad, body->attitude);
}

/// The parts other than the fuselage, as they hang in the glide, from the centre of gravity.
static void describe_parts(const bt_aircraft_params* p, const bt_airframe* f,
                           bt_body_def parts[BODIES_MAX]) {
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        bt_body_def *piston = &parts[BT_BODY_NOSE_PISTON + leg],
                    *wheel = &parts[BT_BODY_NOSE_WHEEL + leg];
        bt_leg_describe(&f->leg[leg], gear_of(p, leg), f->stroke_m[leg], f->axle_m[leg], piston,
                        wheel);
        piston->name = bt_body_names[BT_BODY_NOSE_PISTON + leg];
        wheel->name = bt_body_names[BT_BODY_NOSE_WHEEL + leg];
    }
    const bt_shank* shank = &f->shank;
    describe_shank(&shank->head, shank->joint_m, f->head_angle_rad, f, bt_body_names[BT_BODY_HOOK],
                   &parts[BT_BODY_HOOK]);
    if (shank->bends)
        describe_shank(&shank->root, 0, f->hook_angle_rad, f, "shank_root", &parts[SHANK_ROOT]);
}

/// A point given from the centre of gravity, in the fuselage's frame.
static void from_fuselage(const bt_airframe* f, const double point[3], double local[3]) {
    for (int i = 0; i < 3; ++i)
        local[i] = point[i] - f->fuselage_m[i];
}

static void add_legs(bt_airframe* f) {
    static const char* const strut_names[] = {"nose_strut", "left_strut", "right_strut"};
    static const char* const tyre_names[] = {"nose_tyre", "left_tyre", "right_tyre"};
    static const char* const joint_names[] = {"nose_slide", "left_slide", "right_slide"};
    static const char* const axle_names[] = {"nose_axle", "left_axle", "right_axle"};
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const int wheel = BT_BODY_NOSE_WHEEL + leg;
        bt_leg_parts parts = {.airframe = BT_BODY_FUSELAGE,
                              .piston = BT_BODY_NOSE_PISTON + leg,
                              .wheel = wheel,
                              .joint_name = joint_names[leg],
                              .axle_name = axle_names[leg],
                              .strut_name = strut_names[leg]};
        from_fuselage(f, f->axle_m[leg], parts.axle_m);
        f->strut[leg] =
            bt_leg_add(f->system, &f->leg[leg], &f->oleo[leg], &parts, &f->strut_joint[leg]);
        const bt_wheel tread = {.tyre = f->tyre[leg]};
        f->wheel[leg] = bt_system_add_element(f->system, &(bt_element){.type = &bt_wheel_type,
                                                                       .name = tyre_names[leg],
                                                                       .body_a = wheel,
                                                                       .body_b = BT_GROUND,
                                                                       .data = &tread});
    }
}

/// The sprung joint of a shank that bends.
static void add_shank_joint(bt_airframe* f) {
    const bt_shank* s = &f->shank;
    bt_system_add_joint(f->system,
                        &(bt_joint_def){.name = "shank_joint",
                                        .kind = BT_JOINT_REVOLUTE,
                                        .body_a = SHANK_ROOT,
                                        .body_b = BT_BODY_HOOK,
                                        .point_a_m = {s->root.centre_m - s->joint_m, 0, 0},
                                        .point_b_m = {s->head.centre_m - s->joint_m, 0, 0},
                                        .axis_a = {0, 1, 0},
                                        .axis_b = {0, 1, 0}});
    const bt_torsion spring = {.axis = {0, 1, 0},
                               .stiffness_Nmprad = s->stiffness_Nmprad,
                               .damping_Nmsprad = s->damping_Nmsprad};
    bt_system_add_element(f->system, &(bt_element){.type = &bt_torsion_element,
                                                   .name = "shank_spring",
                                                   .body_a = SHANK_ROOT,
                                                   .body_b = BT_BODY_HOOK,
                                                   .data = &spring});
}

static void add_hook(const bt_aircraft_params* p, const bt_hook_damper* damper, bt_airframe* f) {
    const bt_hook_params* h = &p->hook;
    // the part on the pivot
    const int root = f->shank.bends ? SHANK_ROOT : BT_BODY_HOOK;
    const double centre_m = f->shank.bends ? f->shank.root.centre_m : f->shank.head.centre_m;
    bt_joint_def pivot = {.name = "hook_pivot",
                          .kind = BT_JOINT_UNIVERSAL,
                          .body_a = BT_BODY_FUSELAGE,
                          .body_b = root,
                          .point_b_m = {centre_m, 0, 0},
                          .axis_a = {0, 1, 0},
                          .axis_b = {0, 0, 1}};
    from_fuselage(f, f->pivot_m, pivot.point_a_m);
    f->hook_joint = bt_system_add_joint(f->system, &pivot);

    double on_shank[3], on_fuselage[3];
    bt_hook_damper_place(h->down_stop_rad, h->damper_lever_m, h->damper_angle_rad,
                         h->damper_length_m, on_shank, on_fuselage);
    bt_hook_damper_mount mount = {.damper = *damper,
                                  .length_m = h->damper_length_m,
                                  .point_b_m = {centre_m - h->damper_lever_m, 0, 0}};
    for (int i = 0; i < 3; ++i)
        mount.point_a_m[i] = pivot.point_a_m[i] + on_fuselage[i];
    f->damper = bt_system_add_element(f->system, &(bt_element){.type = &bt_hook_damper_element,
                                                               .name = "hook_damper",
                                                               .body_a = BT_BODY_FUSELAGE,
                                                               .body_b = root,
                                                               .data = &mount});
    const bt_yaw_damper yaw = {.axis_a = {0, 1, 0},
                               .axis_b = {0, 0, 1},
                               .neutral_b = {0, 1, 0},
                               .stiffness_Nmprad = h->centring_stiffness_Nmprad,
                               .damping_Nmsprad = h->centring_damping_Nmsprad};
    bt_system_add_element(f->system, &(bt_element){.type = &bt_yaw_damper_element,
                                                   .name = "yaw_damper",
                                                   .body_a = BT_BODY_FUSELAGE,
                                                   .body_b = root,
                                                   .data = &yaw});
    if (f->shank.bends)
        add_shank_joint(f);
    f->shoe_contact = (bt_shoe){.shoe_radius_m = f->profile.shoe_radius,
                                .lip_radius_m = f->profile.lip_radius,
                                .shoe_m = {f->shoe_m[0], f->shoe_m[1], f->shoe_m[2]},
                                .lip_m = {f->shoe_m[0] + f->profile.lip[0], 0, f->profile.lip[1]}};
    bt_impact_prepare(&h->deck_contact, &f->shoe_contact.impact);
    f->shoe = bt_system_add_element(f->system, &(bt_element){.type = &bt_shoe_type,
                                                             .name = "hook_shoe",
                                                             .body_a = BT_BODY_HOOK,
                                                             .body_b = BT_GROUND,
                                                             .data = &f->shoe_contact});
}

/// How the hook hangs: the damper's stop holds its weight, the shank's spring that of the head.
static void hang_hook(const bt_hook_params* hook, const bt_hook_damper* damper,
                      double effective_mps2, bt_airframe* f) {
    const bt_shank* shank = &f->shank;
    double moment_Nm = hook->mass_kg * effective_mps2 * hook->mass_centre_m;
    const double head_Nm =
        shank->head.mass_kg * effective_mps2 * (shank->head.centre_m - shank->joint_m);
    for (int turn = 0; turn < (shank->bends ? 20 : 1); ++turn) {
        const double root = f->hook_angle_rad = bt_hook_damper_hanging_angle(
            damper, hook->down_stop_rad, hook->damper_lever_m, hook->damper_angle_rad,
            hook->damper_length_m, moment_Nm, 0);
        f->head_angle_rad = turn ? f->head_angle_rad : root;
        if (!shank->bends)
            return;
        for (int i = 0; i < 10; ++i)
            f->head_angle_rad = root + head_Nm * cos(f->head_angle_rad) / shank->stiffness_Nmprad;
        const double lost_Nm = head_Nm * (1 - cos(f->head_angle_rad) / cos(root));
        moment_Nm = hook->mass_kg * effective_mps2 * hook->mass_centre_m - lost_Nm;
    }
}

static bt_status assemble(const bt_aircraft_params* p, double gravity_mps2, bt_airframe* f,
                          bt_diag* diag) {
    bt_hook_damper damper;
    bt_hook_damper_prepare(&p->hook.damper, &damper);

    // how the parts hang in the glide, where lift carries lift_ratio of the weight
    const double effective_mps2 = p->lift_ratio * gravity_mps2;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        f->stroke_m[leg] = bt_leg_hanging_stroke(&f->leg[leg], &f->oleo[leg], effective_mps2);
    hang_hook(&p->hook, &damper, effective_mps2, f);

    bt_body_def parts[BODIES_MAX] = {0};
    describe_parts(p, f, parts);
    BT_TRY(add_fuselage(p, parts, f, diag));
    for (int body = 1; body < f->body_count; ++body)
        bt_system_add_body(f->system, &parts[body]);
    add_legs(f);
    add_hook(p, &damper, f);

    f->has_tail = p->tail.x_m != 0 || p->tail.z_m != 0;
    from_fuselage(f, (double[]){p->tail.x_m, 0, p->tail.z_m}, f->tail_m);
    static const double centre[3] = {0};
    double point_m[3];
    from_fuselage(f, centre, point_m);
    bt_lift_init(&f->lift, p->lift_ratio * p->mass_kg * gravity_mps2, point_m);
    bt_system_add_element(f->system, &(bt_element){.type = &bt_lift_type,
                                                   .name = "lift",
                                                   .body_a = BT_GROUND,
                                                   .body_b = BT_BODY_FUSELAGE,
                                                   .data = &(bt_lift_element){&f->lift}});
    const double gravity[3] = {0, 0, -gravity_mps2};
    bt_system_set_gravity(f->system, gravity);
    return bt_system_assemble(f->system, diag);
}

bt_status bt_airframe_build(const bt_aircraft_params* params, double gravity_mps2,
                            double cable_radius_m, bt_airframe* airframe, bt_diag* diag) {
    *airframe = (bt_airframe){0};
    BT_TRY(bt_profile_build(&params->hook.profile, params->hook.length_m, cable_radius_m,
                            "aircraft.hook.profile", &airframe->profile, diag));
    place_parts(params, airframe);
    BT_TRY(bt_system_create(&airframe->system));
    const bt_status status = assemble(params, gravity_mps2, airframe, diag);
    if (status != BT_OK)
        bt_airframe_destroy(airframe);
    return status;
}

void bt_airframe_destroy(bt_airframe* airframe) {
    bt_system_destroy(airframe->system);
    airframe->system = NULL;
}

/// Yaw, then pitch (nose up), then roll (port side up), as Euler parameters.
static void attitude_of(const bt_landing_params* landing, double e[4]) {
    const double yaw[4] = {cos(0.5 * landing->yaw_rad), 0, 0, sin(0.5 * landing->yaw_rad)};
    const double pitch[4] = {cos(0.5 * landing->pitch_rad), 0, -sin(0.5 * landing->pitch_rad), 0};
    const double roll[4] = {cos(0.5 * landing->roll_rad), sin(0.5 * landing->roll_rad), 0, 0};
    double heading[4];
    bt_euler_multiply(yaw, pitch, heading);
    bt_euler_multiply(heading, roll, e);
}

void bt_airframe_place(const bt_airframe* f, const bt_landing_params* landing,
                       const bt_state* hanging, bt_state* state, bt_glide* glide) {
    double turn[4], a[9],
        velocity[3] = {landing->horizontal_speed_mps, landing->drift_mps, -landing->sink_speed_mps};
    attitude_of(landing, turn);
    bt_rotation_from_euler(turn, a);
    bt_state_copy(f->system, state, hanging);
    for (int body = 0; body < f->body_count; ++body) {
        const double* from = hanging->q + 7 * body;
        double* q = state->q + 7 * body;
        double* v = state->v + 6 * body;
        bt_rotate(a, from, q);
        bt_euler_multiply(turn, from + 3, q + 3);
        bt_rotation_from_euler(q + 3, state->rotation + 9 * body);
        memcpy(v, velocity, sizeof velocity);
        memset(v + 3, 0, 3 * sizeof *v);
        q[1] += landing->off_centre_m;
    }

    const bt_motion motion = {.q = state->q, .v = state->v, .rotation = state->rotation};
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const double* q = state->q + 7 * (BT_BODY_NOSE_WHEEL + leg);
        const double* r = state->rotation + 9 * (BT_BODY_NOSE_WHEEL + leg);
        const double tilt = r[7], upright = sqrt(1 - tilt * tilt);
        const double down[3] = {tilt * r[1] / upright, tilt * r[4] / upright, -upright};
        for (int i = 0; i < 3; ++i)
            glide->tyre_m[leg][i] = q[i] + f->tyre[leg].radius * down[i];
    }
    bt_shoe_lowest(&f->shoe_contact, &motion, BT_BODY_HOOK, glide->hook_m);
}

double bt_airframe_tail_height(const bt_airframe* airframe, const bt_state* state) {
    if (!airframe->has_tail)
        return INFINITY;
    const bt_motion motion = {.q = state->q, .v = state->v, .rotation = state->rotation};
    double tail_m[3];
    bt_point_position(&motion, BT_BODY_FUSELAGE, airframe->tail_m, tail_m);
    return tail_m[2];
}

void bt_airframe_move(const bt_airframe* airframe, const double shift_m[3], bt_state* state) {
    for (int body = 0; body < airframe->body_count; ++body)
        bt_add_scaled(state->q + 7 * body, 1, shift_m);
}
