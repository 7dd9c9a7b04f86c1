/// A leg: what its wheel hangs on. Telescopic: the wheel is on the piston of the strut, which
/// stands upright or with a rake. Levered: the wheel is on an arm that turns about a pivot on the
/// airframe, the strut between a point of the arm (foot) and one of the airframe (head). Closed
/// forms of its geometry; docs/theory/levered.md.
///
/// All points are in the leg's plane, from the axle of the extended leg, x forward, z up. With f
/// and h the distances of foot and head from the pivot and phi_0 the angle between them, strut
/// extended, the strut of length l = l_0 - s encloses
///
///     l^2 = f^2 + h^2 - 2 f h cos(phi)         the arm has turned by phi_0 - phi(s)
///     r = f h sin(phi) / l = ds/dtheta         lever arm of the strut force about the pivot
#ifndef BT_LANDING_LEG_H
#define BT_LANDING_LEG_H

#include "landing/params.h"
#include "mechanics/system.h"

typedef struct bt_leg {
    bool levered;
    double axis[3]; ///< telescopic: unit, the piston's way in compression
    double pivot_m[3], foot_m[3], head_m[3], centre_m[3]; ///< levered; centre of the arm's mass
    double foot_length_m, head_length_m, length_m;        ///< f, h, l_0
    double angle_rad;                                     ///< phi_0
    double turn; ///< sense of the arm in compression: 1 from x to z, -1 from z to x
    double unsprung_kg, arm_kg;
    double stroke_kg; ///< mass that the strut feels along its stroke, where it is least
    double axle_kg;   ///< mass that the tyre feels, likewise
} bt_leg;

/// The strut of a leg. Where no side load is given for its bearings, the rake's tangent is it.
void bt_gear_prepare_oleo(const bt_gear_params* gear, bt_oleo* oleo);

/// @param gear  checked
void bt_leg_prepare(const bt_gear_params* gear, bt_leg* leg);

/// Where the parts are at a stroke, from the axle of the extended leg, in the airframe's axes.
typedef struct bt_leg_place {
    double piston_m[3], attitude[4]; ///< of the piston or arm: centre of mass, Euler parameters
    double axle_m[3];
} bt_leg_place;

void bt_leg_at(const bt_leg* leg, double stroke_m, bt_leg_place* place);

/// r, m; 1 for a telescopic leg, whose force acts along the stroke itself.
double bt_leg_lever(const bt_leg* leg, double stroke_m);

/// Strut force over the vertical load on the axle that it holds, airframe level and wheel free to
/// roll: cos(rake), or the horizontal distance of axle and pivot over r.
double bt_leg_load_ratio(const bt_leg* leg, double stroke_m);

/// Stroke at which the hanging leg is at rest on its stop where weight is effective_mps2.
double bt_leg_hanging_stroke(const bt_leg* leg, const bt_oleo* oleo, double effective_mps2);

/// Piston or arm, and wheel, as they are at a stroke; their velocity and what they are called is
/// left to the caller. axle_m: axle of the extended leg.
void bt_leg_describe(const bt_leg* leg, const bt_gear_params* gear, double stroke_m,
                     const double axle_m[3], bt_body_def* piston, bt_body_def* wheel);

/// What holds a leg together.
typedef struct bt_leg_parts {
    int airframe, piston, wheel; ///< bodies
    double axle_m[3];            ///< axle of the extended leg, in the airframe's frame
    const char *joint_name, *axle_name, *strut_name;
} bt_leg_parts;

/// Adds the joint of piston or arm, the axle and the strut (an element with the outputs of
/// elements/strut.h). Returns the strut; *joint is the one that bears the side loads.
int bt_leg_add(bt_system* system, const bt_leg* leg, const bt_oleo* oleo, const bt_leg_parts* parts,
               int* joint);

/// Load on a leg's bearings from the force of its joint: across the strut, or all of it at the
/// pivot of an arm, N.
double bt_leg_side_force(const bt_leg* leg, const double airframe_rotation[9],
                         const double force_N[3]);

#endif
