#include "elements/torque.h"

#include "mechanics/vec.h"

#include <string.h>

/* ------------------------------------------------------------------ torsion */

static void attitude(const bt_motion* motion, int body, double e[4]) {
    static const double level[4] = {1, 0, 0, 0};
    memcpy(e, body == BT_GROUND ? level : motion->q + 7 * body + 3, 4 * sizeof(double));
}

static void to_world(const bt_motion* motion, int body, const double x[3], double y[3]) {
    if (body == BT_GROUND)
        memcpy(y, x, 3 * sizeof(double));
    else
        bt_rotate(motion->rotation + 9 * body, x, y);
}

static void unit_axis(const bt_torsion* torsion, double axis[3]) {
    const double s = 1 / bt_norm(torsion->axis);
    for (int i = 0; i < 3; ++i)
        axis[i] = s * torsion->axis[i];
}

static double torsion_angle(const bt_element* element, const bt_motion* motion) {
    const bt_torsion* torsion = element->data;
    const double* zero = torsion->attitude_ab;
    double a[4], b[4], relative[4], axis[3];
    attitude(motion, element->body_a, a);
    attitude(motion, element->body_b, b);
    if (bt_dot(zero, zero) + zero[3] * zero[3] > 0) {
        const double undo[4] = {zero[0], -zero[1], -zero[2], -zero[3]};
        double turned[4];
        bt_euler_multiply(b, undo, turned);
        memcpy(b, turned, sizeof b);
    }
    bt_euler_relative(a, b, relative);
    unit_axis(torsion, axis);
    const double along = bt_dot(relative + 1, axis);
    return relative[0] < 0 ? 2 * atan2(-along, -relative[0]) : 2 * atan2(along, relative[0]);
}

static void torsion_force(const bt_element* element, const bt_motion* motion, double* wrench,
                          double* output) {
    const bt_torsion* torsion = element->data;
    const int ends[2] = {element->body_a, element->body_b};
    double axis[3], world[3], rate = 0;
    unit_axis(torsion, axis);
    to_world(motion, element->body_a, axis, world);
    for (int s = 0; s < 2; ++s) {
        double omega[3];
        if (ends[s] == BT_GROUND)
            continue;
        to_world(motion, ends[s], motion->v + 6 * ends[s] + 3, omega);
        rate += (s ? 1 : -1) * bt_dot(omega, world);
    }
    const double angle = torsion_angle(element, motion);
    const double torque = torsion->stiffness_Nmprad * (angle - torsion->free_angle_rad) +
                          torsion->damping_Nmsprad * rate;
    const double on_a[3] = {torque * world[0], torque * world[1], torque * world[2]};
    const double on_b[3] = {-on_a[0], -on_a[1], -on_a[2]};
    bt_wrench_add_torque(motion, element->body_a, on_a, wrench);
    bt_wrench_add_torque(motion, element->body_b, on_b, wrench);
    output[BT_TORSION_ANGLE] = angle;
    output[BT_TORSION_TORQUE] = torque;
}

static double torsion_energy(const bt_element* element, const bt_motion* motion) {
    const bt_torsion* torsion = element->data;
    const double turn = torsion_angle(element, motion) - torsion->free_angle_rad;
    return 0.5 * torsion->stiffness_Nmprad * turn * turn;
}

static const char* const torsion_outputs[] = {"angle_rad", "torque_Nm"};

const bt_element_type bt_torsion_element = {
    .name = "torsion",
    .data_size = sizeof(bt_torsion),
    .output_count = BT_TORSION_OUTPUT_COUNT,
    .output_names = torsion_outputs,
    .force = torsion_force,
    .energy = torsion_energy,
};

/* ------------------------------------------------------------------ constant loads */

static void torque_force(const bt_element* element, const bt_motion* motion, double* wrench,
                         double* output) {
    const bt_torque* torque = element->data;
    double on_b[3];
    (void)output;
    to_world(motion, element->body_a, torque->torque_Nm, on_b);
    const double on_a[3] = {-on_b[0], -on_b[1], -on_b[2]};
    bt_wrench_add_torque(motion, element->body_a, on_a, wrench);
    bt_wrench_add_torque(motion, element->body_b, on_b, wrench);
}

const bt_element_type bt_torque_element = {
    .name = "torque",
    .data_size = sizeof(bt_torque),
    .force = torque_force,
};

static void force_force(const bt_element* element, const bt_motion* motion, double* wrench,
                        double* output) {
    const bt_force* force = element->data;
    double point[3];
    (void)output;
    bt_point_position(motion, element->body_b, force->point_b_m, point);
    bt_wrench_add(motion, element->body_b, point, force->force_N, wrench);
}

static double force_energy(const bt_element* element, const bt_motion* motion) {
    const bt_force* force = element->data;
    double point[3];
    bt_point_position(motion, element->body_b, force->point_b_m, point);
    return -bt_dot(force->force_N, point);
}

const bt_element_type bt_force_element = {
    .name = "force",
    .data_size = sizeof(bt_force),
    .force = force_force,
    .energy = force_energy,
};

static void follower_force(const bt_element* element, const bt_motion* motion, double* wrench,
                           double* output) {
    const bt_follower* follower = element->data;
    double point[3], force[3], torque[3];
    (void)output;
    bt_point_position(motion, element->body_b, follower->point_b_m, point);
    to_world(motion, element->body_b, follower->force_N, force);
    to_world(motion, element->body_b, follower->torque_Nm, torque);
    bt_wrench_add(motion, element->body_b, point, force, wrench);
    bt_wrench_add_torque(motion, element->body_b, torque, wrench);
}

const bt_element_type bt_follower_element = {
    .name = "follower",
    .data_size = sizeof(bt_follower),
    .force = follower_force,
};
