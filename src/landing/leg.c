#include "landing/leg.h"

#include "elements/check.h"
#include "elements/strut.h"
#include "elements/wheel.h"
#include "mechanics/vec.h"

#include <math.h>
#include <string.h>

const char* const bt_gear_type_names[] = {"telescopic", "levered", NULL};

/* ---- geometry ---- */

/// a x b in the plane, positive where b is turned from a in the sense from x to z.
static double across(const double a[3], const double b[3]) {
    return a[0] * b[2] - a[2] * b[0];
}

/// phi at a stroke; the last possible one beyond what the links can reach.
static double enclosed_angle(const bt_leg* leg, double stroke_m) {
    const double f = leg->foot_length_m, h = leg->head_length_m, l = leg->length_m - stroke_m;
    return acos(fmax(-1, fmin(1, (f * f + h * h - l * l) / (2 * f * h))));
}

static void turn_about_pivot(const bt_leg* leg, double angle_rad, const double point_m[3],
                             double turned_m[3]) {
    const double x = point_m[0] - leg->pivot_m[0], z = point_m[2] - leg->pivot_m[2];
    const double c = cos(angle_rad), s = sin(angle_rad);
    turned_m[0] = leg->pivot_m[0] + c * x - s * z;
    turned_m[1] = point_m[1];
    turned_m[2] = leg->pivot_m[2] + s * x + c * z;
}

/// Turn of the arm from where it is extended, from x towards z.
static double arm_angle(const bt_leg* leg, double stroke_m) {
    return leg->turn * (leg->angle_rad - enclosed_angle(leg, stroke_m));
}

void bt_leg_at(const bt_leg* leg, double stroke_m, bt_leg_place* place) {
    static const double axle_m[3] = {0};
    *place = (bt_leg_place){.attitude = {1, 0, 0, 0}};
    if (!leg->levered) {
        for (int i = 0; i < 3; ++i)
            place->piston_m[i] = place->axle_m[i] = stroke_m * leg->axis[i];
        return;
    }
    const double angle = arm_angle(leg, stroke_m);
    turn_about_pivot(leg, angle, leg->centre_m, place->piston_m);
    turn_about_pivot(leg, angle, axle_m, place->axle_m);
    place->attitude[0] = cos(0.5 * angle);
    place->attitude[2] = -sin(0.5 * angle);
}

double bt_leg_lever(const bt_leg* leg, double stroke_m) {
    if (!leg->levered)
        return 1;
    return leg->foot_length_m * leg->head_length_m * sin(enclosed_angle(leg, stroke_m)) /
           (leg->length_m - stroke_m);
}

/// Moment that a unit load upward on a part of the arm has about the pivot, in the sense in which
/// the strut shortens.
static double moment_of(const bt_leg* leg, const double place_m[3]) {
    return leg->turn * (place_m[0] - leg->pivot_m[0]);
}

double bt_leg_load_ratio(const bt_leg* leg, double stroke_m) {
    if (!leg->levered)
        return leg->axis[2];
    bt_leg_place place;
    bt_leg_at(leg, stroke_m, &place);
    return moment_of(leg, place.axle_m) / bt_leg_lever(leg, stroke_m);
}

double bt_leg_hanging_stroke(const bt_leg* leg, const bt_oleo* oleo, double effective_mps2) {
    if (!leg->levered)
        return bt_oleo_hanging_stroke(oleo, effective_mps2 * leg->unsprung_kg * leg->axis[2]);
    double stroke = 0;
    for (int i = 0; i < 20; ++i) {
        bt_leg_place place;
        bt_leg_at(leg, stroke, &place);
        const double moment = leg->arm_kg * moment_of(leg, place.piston_m) +
                              (leg->unsprung_kg - leg->arm_kg) * moment_of(leg, place.axle_m);
        stroke = bt_oleo_hanging_stroke(oleo, effective_mps2 * moment / bt_leg_lever(leg, stroke));
    }
    return stroke;
}

/* ---- preparation and check ---- */

static void set_point(double point[3], double x, double z) {
    point[0] = x;
    point[1] = 0;
    point[2] = z;
}

static void away(const double from[3], const double to[3], double way[3]) {
    for (int i = 0; i < 3; ++i)
        way[i] = to[i] - from[i];
}

/// Inertia of the arm about its centre: a slender rod from pivot to axle.
static double arm_inertia(const bt_leg* leg) {
    return leg->arm_kg * bt_dot(leg->pivot_m, leg->pivot_m) / 12;
}

static void prepare_arm(const bt_gear_params* gear, bt_leg* leg) {
    const bt_arm_params* arm = &gear->arm;
    double to_foot[3], to_head[3];
    set_point(leg->pivot_m, arm->pivot_x_m, arm->pivot_z_m);
    set_point(leg->foot_m, arm->foot_x_m, arm->foot_z_m);
    set_point(leg->head_m, arm->head_x_m, arm->head_z_m);
    set_point(leg->centre_m, 0.5 * arm->pivot_x_m, 0.5 * arm->pivot_z_m);
    away(leg->pivot_m, leg->foot_m, to_foot);
    away(leg->pivot_m, leg->head_m, to_head);
    leg->foot_length_m = bt_norm(to_foot);
    leg->head_length_m = bt_norm(to_head);
    leg->length_m = hypot(arm->head_x_m - arm->foot_x_m, arm->head_z_m - arm->foot_z_m);
    leg->turn = across(to_foot, to_head) < 0 ? -1 : 1;
    leg->angle_rad = enclosed_angle(leg, 0);
    const double length2 = bt_dot(leg->pivot_m, leg->pivot_m);
    const double about_pivot =
        arm_inertia(leg) + (0.25 * leg->arm_kg + gear->wheel_mass_kg) * length2;
    double most = 0;
    for (int i = 0; i <= 20; ++i)
        most = fmax(most, bt_leg_lever(leg, 0.05 * i * gear->oleo.stroke_max_m));
    leg->stroke_kg = about_pivot / (most * most);
    leg->axle_kg = about_pivot / length2;
}

void bt_leg_prepare(const bt_gear_params* gear, bt_leg* leg) {
    const double unsprung = gear->piston_mass_kg + gear->wheel_mass_kg;
    *leg = (bt_leg){.levered = gear->type == BT_LEG_LEVERED,
                    .axis = {0.0 - sin(gear->rake_rad), 0, cos(gear->rake_rad)},
                    .unsprung_kg = unsprung,
                    .arm_kg = gear->piston_mass_kg,
                    .stroke_kg = unsprung,
                    .axle_kg = unsprung};
    if (leg->levered)
        prepare_arm(gear, leg);
}

/// What a telescopic leg has no use for.
static void check_telescopic(const bt_gear_params* gear, const char* path, bt_diag* diag) {
    const bt_arm_params* a = &gear->arm;
    if (a->pivot_x_m != 0 || a->pivot_z_m != 0 || a->foot_x_m != 0 || a->foot_z_m != 0 ||
        a->head_x_m != 0 || a->head_z_m != 0)
        bt_key_error(diag, path, "arm", "is given, and the leg has none; type: levered would do");
}

/// The arm must raise the wheel over the whole stroke, with a lever of a tenth of its foot's
/// distance at least.
static void check_stroke(const bt_leg* leg, double stroke_max_m, const char* path, bt_diag* diag) {
    for (int i = 0; i <= 100; ++i) {
        const double stroke = 0.01 * i * stroke_max_m;
        bt_leg_place place;
        bt_leg_at(leg, stroke, &place);
        if (!(leg->length_m - stroke > fabs(leg->foot_length_m - leg->head_length_m)) ||
            bt_leg_lever(leg, stroke) < 0.1 * leg->foot_length_m) {
            bt_key_error(diag, path, "arm",
                         "head, foot and pivot come to lie in line at a stroke of %.4g m, before "
                         "oleo.stroke_max; a shorter stroke or a foot nearer to the pivot would do",
                         stroke);
            return;
        }
        if (!(moment_of(leg, place.axle_m) > 0)) {
            bt_key_error(diag, path, "arm",
                         "the wheel does not rise at a stroke of %.4g m: the strut would have to "
                         "get longer; check the signs of pivot, foot and head (from the axle, "
                         "forward and up positive)",
                         stroke);
            return;
        }
    }
}

static void check_arm(const bt_gear_params* gear, const char* path, bt_diag* diag) {
    bt_leg leg;
    if (gear->rake_rad != 0)
        bt_key_error(diag, path, "rake",
                     "belongs to a telescopic leg; head and foot say how the "
                     "strut of a levered one stands");
    bt_leg_prepare(gear, &leg);
    if (!(bt_norm(leg.pivot_m) > 0) || !(leg.foot_length_m > 0) || !(leg.head_length_m > 0) ||
        !(leg.length_m > gear->oleo.stroke_max_m)) {
        bt_key_error(diag, path, "arm",
                     "pivot, axle and foot must be three places, and head and foot further apart "
                     "than oleo.stroke_max, %g m; they are %g m",
                     gear->oleo.stroke_max_m, leg.length_m);
        return;
    }
    check_stroke(&leg, gear->oleo.stroke_max_m, path, diag);
}

static void check_gear(const void* params, const char* path, bt_diag* diag) {
    const bt_gear_params* gear = params;
    (gear->type == BT_LEG_LEVERED ? check_arm : check_telescopic)(gear, path, diag);
}

#define ROW(kind, name, ...) BT_ROW_##kind(bt_arm_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(arm, BT_ARM_FIELDS, ROW, NULL, "arm of a levered leg and where its strut sits")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_gear_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(gear, BT_GEAR_FIELDS, ROW, check_gear, "one leg: strut, piston or arm, wheel, tyre")
#undef ROW

void bt_gear_prepare_oleo(const bt_gear_params* gear, bt_oleo* oleo) {
    bt_oleo_params params = gear->oleo;
    if (params.side_load_ratio == 0)
        params.side_load_ratio = fabs(tan(gear->rake_rad));
    bt_oleo_prepare(&params, oleo);
}

/* ---- bodies, joints, strut ---- */

void bt_leg_describe(const bt_leg* leg, const bt_gear_params* gear, double stroke_m,
                     const double axle_m[3], bt_body_def* piston, bt_body_def* wheel) {
    const double rod =
        gear->piston_mass_kg * 0.25 / 12; // a piston is a slender rod of half a metre
    const double across_kgm2 = bt_wheel_inertia_across(gear->wheel_inertia_kgm2);
    bt_leg_place place;
    bt_leg_at(leg, stroke_m, &place);
    *piston = (bt_body_def){.mass_kg = gear->piston_mass_kg, .inertia_kgm2 = {rod, rod, 0.1 * rod}};
    *wheel = (bt_body_def){.mass_kg = gear->wheel_mass_kg,
                           .inertia_kgm2 = {across_kgm2, gear->wheel_inertia_kgm2, across_kgm2},
                           .attitude = {1, 0, 0, 0}};
    if (leg->levered) // thick enough to have an inertia about its own length
        for (int i = 0; i < 3; ++i)
            piston->inertia_kgm2[i] = arm_inertia(leg) * (i == 1 ? 1 : 0.55);
    memcpy(piston->attitude, place.attitude, sizeof piston->attitude);
    for (int i = 0; i < 3; ++i) {
        piston->position_m[i] = axle_m[i] + place.piston_m[i];
        wheel->position_m[i] = axle_m[i] + place.axle_m[i];
    }
}

int bt_leg_add(bt_system* system, const bt_leg* leg, const bt_oleo* oleo, const bt_leg_parts* p,
               int* joint) {
    bt_joint_def hold = {.name = p->joint_name, .body_a = p->airframe, .body_b = p->piston};
    const bt_joint_def axle = {.name = p->axle_name,
                               .kind = BT_JOINT_REVOLUTE,
                               .body_a = p->piston,
                               .body_b = p->wheel,
                               .point_a_m = {0.0 - leg->centre_m[0], 0, 0.0 - leg->centre_m[2]},
                               .axis_a = {0, 1, 0},
                               .axis_b = {0, 1, 0}};
    bt_strut strut = {.oleo = *oleo};
    bt_strut_link link = {.oleo = *oleo, .length_m = leg->length_m};
    memcpy(hold.point_a_m, p->axle_m, sizeof hold.point_a_m);
    if (leg->levered) {
        hold.kind = BT_JOINT_REVOLUTE;
        hold.axis_a[1] = hold.axis_b[1] = 1;
        for (int i = 0; i < 3; ++i) {
            hold.point_a_m[i] += leg->pivot_m[i];
            hold.point_b_m[i] = leg->pivot_m[i] - leg->centre_m[i];
            link.point_a_m[i] = p->axle_m[i] + leg->head_m[i];
            link.point_b_m[i] = leg->foot_m[i] - leg->centre_m[i];
        }
    } else {
        hold.kind = BT_JOINT_PRISMATIC;
        hold.attitude_ab[0] = 1;
        memcpy(hold.axis_a, leg->axis, sizeof hold.axis_a);
        memcpy(hold.axis_b, leg->axis, sizeof hold.axis_b);
        memcpy(strut.axis_a, leg->axis, sizeof strut.axis_a);
        memcpy(strut.point_a_m, p->axle_m, sizeof strut.point_a_m);
    }
    *joint = bt_system_add_joint(system, &hold);
    bt_system_add_joint(system, &axle);
    return bt_system_add_element(
        system, &(bt_element){.type = leg->levered ? &bt_strut_link_type : &bt_strut_type,
                              .name = p->strut_name,
                              .body_a = p->airframe,
                              .body_b = p->piston,
                              .data = leg->levered ? (const void*)&link : &strut});
}

double bt_leg_side_force(const bt_leg* leg, const double airframe_rotation[9],
                         const double force_N[3]) {
    double axis[3];
    bt_rotate(airframe_rotation, leg->axis, axis);
    const double along = leg->levered ? 0 : bt_dot(force_N, axis);
    return sqrt(fmax(0, bt_dot(force_N, force_N) - along * along));
}
