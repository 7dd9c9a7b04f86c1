/// Element `yaw_damper`: spring and damper about the second arm of a universal joint; the hook's
/// damper about its yaw axis, which centres it.
#ifndef BT_ELEMENTS_YAW_DAMPER_H
#define BT_ELEMENTS_YAW_DAMPER_H

#include "mechanics/system.h"

/// Data of one yaw damper. body_a is the fuselage, body_b the hook.
///
///     T = -(k psi + c psi') about axis_b, on b; the opposite on a
///
/// psi is the angle from the first arm of the joint (fixed in a) to the same direction in b.
typedef struct bt_yaw_damper {
    double axis_a[3]; ///< first arm of the cross, in a, unit
    double axis_b[3]; ///< second arm, in b, unit
    double
        neutral_b[3]; ///< direction in b that lies on axis_a when psi = 0, unit, normal to axis_b
    double stiffness_Nmprad, damping_Nmsprad;
} bt_yaw_damper;

enum { BT_YAW_DAMPER_ANGLE, BT_YAW_DAMPER_RATE, BT_YAW_DAMPER_TORQUE, BT_YAW_DAMPER_OUTPUTS };

/// Outputs angle_rad, rate_radps, torque_Nm. Energy: k psi^2 / 2.
extern const bt_element_type bt_yaw_damper_element;

#endif
