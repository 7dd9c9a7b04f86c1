/// Torsional spring and damper about a hinge, and constant loads.
#ifndef BT_ELEMENTS_TORQUE_H
#define BT_ELEMENTS_TORQUE_H

#include "mechanics/system.h"

/// Spring and damper about the axis of a revolute, cylindrical or universal joint.
///
///   T = k (theta - theta_0) + c dtheta/dt      on body a about the axis; -T on body b
///
/// theta: turn of b relative to a about the axis, zero in the relative attitude attitude_ab,
/// within -pi .. pi (a spring wound further is not described); dtheta/dt: relative angular velocity
/// along the axis.
typedef struct bt_torsion {
    double axis[3];        ///< in a's frame, any length but zero
    double attitude_ab[4]; ///< attitude of b relative to a where theta = 0; all zero = (1, 0, 0, 0)
    double stiffness_Nmprad, free_angle_rad, damping_Nmsprad; ///< k, theta_0, c
} bt_torsion;

enum { BT_TORSION_ANGLE, BT_TORSION_TORQUE, BT_TORSION_OUTPUT_COUNT };

/// Data: bt_torsion. Outputs: angle_rad, torque_Nm (T).
extern const bt_element_type bt_torsion_element;

/// Constant torque on body b about an axis fixed in body a, the reaction on a. Data: bt_torque.
typedef struct bt_torque {
    double torque_Nm[3]; ///< in a's frame
} bt_torque;

extern const bt_element_type bt_torque_element;

/// Constant force on body b, direction fixed in the world. Data: bt_force. body_a is not used.
typedef struct bt_force {
    double point_b_m[3];
    double force_N[3];
} bt_force;

extern const bt_element_type bt_force_element;

/// Constant force and torque on body b, directions fixed in b. Data: bt_follower. body_a is not
/// used.
typedef struct bt_follower {
    double point_b_m[3];
    double force_N[3], torque_Nm[3];
} bt_follower;

extern const bt_element_type bt_follower_element;

#endif
