/// Elements `strut`, an oleo between two bodies along the axis of their prismatic joint, and
/// `strut_link`, an oleo between a point of each.
#ifndef BT_ELEMENTS_STRUT_H
#define BT_ELEMENTS_STRUT_H

#include "elements/oleo.h"
#include "mechanics/system.h"

/// Data of one strut. body_a carries the cylinder (airframe), body_b is the piston.
///
///     s = axis . (p_b - p_a),  s' its rate;  F_s(s, s') on a along +axis, on b along -axis
typedef struct bt_strut {
    bt_oleo oleo;
    double point_a_m[3]; ///< in a: where point_b lies when the strut is extended
    double axis_a[3];    ///< in a: unit vector, direction in which the piston moves in compression
    double point_b_m[3]; ///< in b
} bt_strut;

enum { BT_STRUT_STROKE, BT_STRUT_RATE, BT_STRUT_FORCE, BT_STRUT_OUTPUTS };

/// Outputs stroke_m, rate_mps, force_N. Energy: gas and stops. Law: the oleo's.
extern const bt_element_type bt_strut_type;

/// Data of a strut held by a pin at each end.
///
///     s = l_0 - |p_b - p_a|,  s' its rate;  F_s(s, s') pushes the two points apart
typedef struct bt_strut_link {
    bt_oleo oleo;
    double point_a_m[3], point_b_m[3];
    double length_m; ///< l_0, extended
} bt_strut_link;

/// Outputs, energy and law as above.
extern const bt_element_type bt_strut_link_type;

#endif
