#include "elements/wheel.h"

#include "mechanics/vec.h"

double bt_wheel_inertia_across(double about_axle_kgm2) {
    return 0.5 * about_axle_kgm2 * 1.1;
}

void bt_wheel_plane_find(const double axle[3], double centre_z, bt_wheel_plane* plane) {
    const double level = sqrt(axle[0] * axle[0] + axle[1] * axle[1]);
    // heading = axle x z, left = z x heading
    plane->heading[0] = axle[1] / level;
    plane->heading[1] = -axle[0] / level;
    plane->heading[2] = 0;
    plane->left[0] = -plane->heading[1];
    plane->left[1] = plane->heading[0];
    plane->left[2] = 0;
    bt_cross(plane->heading, axle, plane->up);
    plane->height_m = centre_z / plane->up[2];
}

bool bt_wheel_on_deck(const bt_wheel* wheel, const double centre_m[3], const double velocity_mps[3],
                      const double axle[3], const double spin_radps[3], bt_wheel_load* load) {
    const bt_tyre* tyre = &wheel->tyre;
    *load = (bt_wheel_load){0};
    if (centre_m[2] >= tyre->radius) // the lowest point of a cambered wheel is higher still
        return false;
    bt_wheel_plane plane;
    bt_wheel_plane_find(axle, centre_m[2], &plane);
    const double d = tyre->radius - plane.height_m;
    if (!(d > 0))
        return false;

    // Velocity of the contact point without the wheel's own turning.
    const double turning = bt_dot(spin_radps, axle);
    double yaw_spin[3], arm[3], swing[3], velocity[3];
    for (int i = 0; i < 3; ++i) {
        yaw_spin[i] = spin_radps[i] - turning * axle[i];
        arm[i] = -plane.height_m * plane.up[i];
        load->point_m[i] = centre_m[i] + arm[i];
    }
    bt_cross(yaw_spin, arm, swing);
    for (int i = 0; i < 3; ++i)
        velocity[i] = velocity_mps[i] + swing[i] - wheel->deck_velocity_mps[i];

    load->deflection_m = d;
    load->rate_mps = -velocity[2] / plane.up[2];
    load->normal_N = bt_tyre_normal_force(tyre, d, load->rate_mps) / plane.up[2];
    const double radius = bt_tyre_rolling_radius(tyre, d);
    double force[2];
    bt_tyre_ground_force(tyre, load->normal_N, d, bt_dot(velocity, plane.heading),
                         bt_dot(velocity, plane.left), turning * radius, force);
    load->forward_N = force[0];
    load->lateral_N = force[1];
    load->torque_Nm = -force[0] * (radius - plane.height_m);
    for (int i = 0; i < 3; ++i)
        load->force_N[i] = force[0] * plane.heading[i] + force[1] * plane.left[i];
    load->force_N[2] += load->normal_N;
    return true;
}

static void wheel_force(const bt_element* element, const bt_motion* motion, double* wrench,
                        double* output) {
    static const double y[3] = {0, 1, 0};
    const bt_wheel* wheel = element->data;
    const int body = element->body_a;
    const double* rotation = motion->rotation + 9 * body;
    const double* v = motion->v + 6 * body;
    double axle[3], spin[3], torque[3];
    bt_wheel_load load = {0};
    if (motion->q[7 * body + 2] < wheel->tyre.radius) {
        bt_rotate(rotation, y, axle);
        bt_rotate(rotation, v + 3, spin);
        if (bt_wheel_on_deck(wheel, motion->q + 7 * body, v, axle, spin, &load)) {
            bt_wrench_add(motion, body, load.point_m, load.force_N, wrench);
            for (int i = 0; i < 3; ++i)
                torque[i] = load.torque_Nm * axle[i];
            bt_wrench_add_torque(motion, body, torque, wrench);
        }
    }
    output[BT_WHEEL_DEFLECTION] = load.deflection_m;
    output[BT_WHEEL_NORMAL] = load.normal_N;
    output[BT_WHEEL_FORWARD] = load.forward_N;
    output[BT_WHEEL_LATERAL] = load.lateral_N;
}

static double wheel_energy(const bt_element* element, const bt_motion* motion) {
    static const double y[3] = {0, 1, 0};
    const bt_wheel* wheel = element->data;
    const double* q = motion->q + 7 * element->body_a;
    if (q[2] >= wheel->tyre.radius)
        return 0;
    double axle[3];
    bt_wheel_plane plane;
    bt_rotate(motion->rotation + 9 * element->body_a, y, axle);
    bt_wheel_plane_find(axle, q[2], &plane);
    return bt_tyre_energy(&wheel->tyre, wheel->tyre.radius - plane.height_m);
}

static bt_law wheel_law(const bt_element* element, const double* output, const char** what) {
    const bt_wheel* wheel = element->data;
    return bt_tyre_law(&wheel->tyre, output[BT_WHEEL_DEFLECTION], what);
}

static const char* const output_names[] = {"deflection_m", "normal_N", "longitudinal_N",
                                           "lateral_N"};

const bt_element_type bt_wheel_type = {
    .name = "wheel",
    .data_size = sizeof(bt_wheel),
    .output_count = BT_WHEEL_OUTPUTS,
    .output_names = output_names,
    .force = wheel_force,
    .energy = wheel_energy,
    .law = wheel_law,
};
