/// Point-to-point spring and damper between two bodies.
///
///   F = k (l - l_0) + c dl/dt      along the line between the two points, positive = pulls them
///                                  together
///
/// Points that coincide have no line between them: the element is silent at l = 0.
#ifndef BT_ELEMENTS_SPRING_H
#define BT_ELEMENTS_SPRING_H

#include "mechanics/system.h"

typedef struct bt_spring {
    double point_a_m[3], point_b_m[3]; ///< in the frames of the bodies (world frame for the ground)
    double stiffness_Npm;              ///< k >= 0
    double free_length_m;              ///< l_0 >= 0
    double damping_Nspm;               ///< c >= 0
} bt_spring;

enum { BT_SPRING_LENGTH, BT_SPRING_FORCE, BT_SPRING_OUTPUT_COUNT };

/// Data: bt_spring. Outputs: length_m, force_N.
extern const bt_element_type bt_spring_element;

#endif
