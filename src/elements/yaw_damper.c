#include "elements/yaw_damper.h"

#include "mechanics/vec.h"

/// A direction fixed in a body, in the world.
static void to_world(const bt_motion* motion, int body, const double local[3], double world[3]) {
    if (body == BT_GROUND)
        for (int i = 0; i < 3; ++i)
            world[i] = local[i];
    else
        bt_rotate(motion->rotation + 9 * body, local, world);
}

/// Angular velocity of a body, in the world.
static void world_spin(const bt_motion* motion, int body, double spin[3]) {
    static const double none[3] = {0, 0, 0};
    to_world(motion, body, body == BT_GROUND ? none : motion->v + 6 * body + 3, spin);
}

/// Yaw angle and the second arm in the world.
static double angle(const bt_element* element, const bt_motion* motion, double arm[3]) {
    const bt_yaw_damper* c = element->data;
    double first[3], neutral[3], left[3];
    to_world(motion, element->body_a, c->axis_a, first);
    to_world(motion, element->body_b, c->axis_b, arm);
    to_world(motion, element->body_b, c->neutral_b, neutral);
    bt_cross(arm, neutral, left);
    return atan2(-bt_dot(first, left), bt_dot(first, neutral));
}

static void yaw_force(const bt_element* element, const bt_motion* motion, double* wrench,
                      double* output) {
    const bt_yaw_damper* c = element->data;
    double arm[3], spin_a[3], spin_b[3], on_a[3], on_b[3];
    const double psi = angle(element, motion, arm);
    world_spin(motion, element->body_a, spin_a);
    world_spin(motion, element->body_b, spin_b);
    const double rate = bt_dot(arm, spin_b) - bt_dot(arm, spin_a);
    const double torque = -(c->stiffness_Nmprad * psi + c->damping_Nmsprad * rate);
    for (int i = 0; i < 3; ++i) {
        on_b[i] = torque * arm[i];
        on_a[i] = -on_b[i];
    }
    bt_wrench_add_torque(motion, element->body_a, on_a, wrench);
    bt_wrench_add_torque(motion, element->body_b, on_b, wrench);
    output[BT_YAW_DAMPER_ANGLE] = psi;
    output[BT_YAW_DAMPER_RATE] = rate;
    output[BT_YAW_DAMPER_TORQUE] = torque;
}

static double yaw_energy(const bt_element* element, const bt_motion* motion) {
    const bt_yaw_damper* c = element->data;
    double arm[3];
    const double psi = angle(element, motion, arm);
    return 0.5 * c->stiffness_Nmprad * psi * psi;
}

static const char* const output_names[] = {"angle_rad", "rate_radps", "torque_Nm"};

const bt_element_type bt_yaw_damper_element = {
    .name = "yaw_damper",
    .data_size = sizeof(bt_yaw_damper),
    .output_count = BT_YAW_DAMPER_OUTPUTS,
    .output_names = output_names,
    .force = yaw_force,
    .energy = yaw_energy,
};
