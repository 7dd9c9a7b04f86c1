#include "mechanics/system.h"

#include "mechanics/vec.h"

void bt_point_position(const bt_motion* motion, int body, const double point_m[3],
                       double position_m[3]) {
    if (body == BT_GROUND) {
        for (int i = 0; i < 3; ++i)
            position_m[i] = point_m[i];
        return;
    }
    double arm[3];
    bt_rotate(motion->rotation + 9 * body, point_m, arm);
    for (int i = 0; i < 3; ++i)
        position_m[i] = motion->q[7 * body + i] + arm[i];
}

void bt_point_velocity(const bt_motion* motion, int body, const double point_m[3],
                       double velocity_mps[3]) {
    if (body == BT_GROUND) {
        velocity_mps[0] = velocity_mps[1] = velocity_mps[2] = 0;
        return;
    }
    const double* v = motion->v + 6 * body;
    double local[3], turn[3];
    bt_cross(v + 3, point_m, local);
    bt_rotate(motion->rotation + 9 * body, local, turn);
    for (int i = 0; i < 3; ++i)
        velocity_mps[i] = v[i] + turn[i];
}

void bt_wrench_add(const bt_motion* motion, int body, const double position_m[3],
                   const double force_N[3], double* wrench) {
    if (body == BT_GROUND)
        return;
    double arm[3], moment[3];
    for (int i = 0; i < 3; ++i)
        arm[i] = position_m[i] - motion->q[7 * body + i];
    bt_cross(arm, force_N, moment);
    bt_add_scaled(wrench + 6 * body, 1, force_N);
    bt_wrench_add_torque(motion, body, moment, wrench);
}

void bt_wrench_add_torque(const bt_motion* motion, int body, const double torque_Nm[3],
                          double* wrench) {
    if (body == BT_GROUND)
        return;
    double local[3];
    bt_unrotate(motion->rotation + 9 * body, torque_Nm, local);
    bt_add_scaled(wrench + 6 * body + 3, 1, local);
}
