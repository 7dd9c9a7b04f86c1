/// The cable's kernel: the loops over joints and segments, built once per instruction-set level.
/// Level v1, without contraction, is the definition; the others may fuse multiply and add.
#ifndef BT_CABLE_CABLE_KERNEL_H
#define BT_CABLE_CABLE_KERNEL_H

#include "cable/cable.h"

#define BT_CABLE_KERNEL_DECLARE(level)                                                             \
    void bt_cable_joints_##level(const bt_cable_model* model, bt_cable_state* state);              \
    void bt_cable_resultants_##level(const bt_cable_model* model, bt_cable_state* state);          \
    void bt_cable_advance_##level(const bt_cable_model* model, bt_cable_state* state,              \
                                  double kick_s, double drift_s);

BT_CABLE_KERNEL_DECLARE(v1)
BT_CABLE_KERNEL_DECLARE(v3)
BT_CABLE_KERNEL_DECLARE(v4)

/// Ends and supports (few, scalar): forces at the present positions and velocities.
void bt_cable_ends(const bt_cable_model* model, bt_cable_state* state);
void bt_cable_supports(const bt_cable_model* model, bt_cable_state* state);
/// Axis from Euler parameters, for one segment.
void bt_cable_set_axis(bt_cable_state* state, int segment);

#endif
