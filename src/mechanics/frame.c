#include "mechanics/frame.h"

#include "mechanics/vec.h"

bool bt_frame_turns(const bt_frame* frame) {
    const double *w = frame->spin_radps, *rate = frame->spin_rate_radps2;
    return w[0] != 0 || w[1] != 0 || w[2] != 0 || rate[0] != 0 || rate[1] != 0 || rate[2] != 0;
}

void bt_frame_field(const bt_frame* frame, const double r[3], const double v[3], double field[3]) {
    double carried[3], centripetal[3], euler[3], coriolis[3];
    bt_cross(frame->spin_radps, r, carried);
    bt_cross(frame->spin_radps, carried, centripetal);
    bt_cross(frame->spin_rate_radps2, r, euler);
    bt_cross(frame->spin_radps, v, coriolis);
    for (int i = 0; i < 3; ++i)
        field[i] = frame->gravity_mps2[i] - euler[i] - centripetal[i] - 2 * coriolis[i];
}

void bt_frame_torque(const bt_frame* frame, const double rotation[9], const double inertia[9],
                     const double w[3], double torque[3]) {
    double u[3], rate[3], whole[3], own[3], momentum[3], gyroscopic[3], change[3], turn[3];
    bt_unrotate(rotation, frame->spin_radps, u);
    bt_unrotate(rotation, frame->spin_rate_radps2, rate);
    for (int i = 0; i < 3; ++i)
        whole[i] = w[i] + u[i];
    bt_rotate(inertia, w, momentum);
    bt_cross(w, momentum, own);
    bt_rotate(inertia, whole, momentum);
    bt_cross(whole, momentum, gyroscopic);
    bt_cross(w, u, change);
    bt_add_scaled(change, -1, rate);
    bt_rotate(inertia, change, turn);
    for (int i = 0; i < 3; ++i)
        torque[i] = own[i] - gyroscopic[i] + turn[i];
}

double bt_frame_potential(const bt_frame* frame, double mass, const double r[3],
                          const double rotation[9], const double inertia[9]) {
    double carried[3], u[3], momentum[3];
    bt_cross(frame->spin_radps, r, carried);
    bt_unrotate(rotation, frame->spin_radps, u);
    bt_rotate(inertia, u, momentum);
    return -0.5 * (mass * bt_dot(carried, carried) + bt_dot(u, momentum));
}
