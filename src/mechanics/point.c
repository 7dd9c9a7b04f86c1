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

void bt_link_between(const bt_motion* motion, int body_a, const double point_a_m[3], int body_b,
                     const double point_b_m[3], bt_link* link) {
    double velocity_a[3], velocity_b[3];
    bt_point_position(motion, body_a, point_a_m, link->end_a);
    bt_point_position(motion, body_b, point_b_m, link->end_b);
    bt_point_velocity(motion, body_a, point_a_m, velocity_a);
    bt_point_velocity(motion, body_b, point_b_m, velocity_b);
    for (int i = 0; i < 3; ++i)
        link->direction[i] = link->end_b[i] - link->end_a[i];
    link->distance_m = bt_norm(link->direction);
    link->closing_mps = 0;
    for (int i = 0; i < 3; ++i) {
        link->direction[i] /= link->distance_m;
        link->closing_mps -= link->direction[i] * (velocity_b[i] - velocity_a[i]);
    }
}

void bt_link_push(const bt_motion* motion, int body_a, int body_b, const bt_link* link,
                  double force_N, double* wrench) {
    double on_a[3], on_b[3];
    for (int i = 0; i < 3; ++i) {
        on_b[i] = force_N * link->direction[i];
        on_a[i] = -on_b[i];
    }
    bt_wrench_add(motion, body_a, link->end_a, on_a, wrench);
    bt_wrench_add(motion, body_b, link->end_b, on_b, wrench);
}
