/// What a frame that accelerates or turns does to the cable (mechanics/frame.h).
#include "cable/cable_parts.h"

#include "mechanics/vec.h"

#include <math.h>
#include <string.h>

bool bt_cable_frame_is_still(const bt_cable_state* state) {
    const bt_frame* frame = &state->scalars->frame;
    return frame->gravity_mps2[0] == 0 && frame->gravity_mps2[1] == 0 && !bt_frame_turns(frame);
}

/// Change of v by Coriolis alone over the kick, per second. It turns v and keeps its size: with
/// t = W kick, v' = v + v x t, v+ = v + 2 v' x t / (1 + t^2). Without a kick: 2 v x W.
static void coriolis(const bt_frame* frame, const double v[3], double kick_s, double field[3]) {
    double t[3], turned[3];
    for (int k = 0; k < 3; ++k)
        t[k] = kick_s * frame->spin_radps[k];
    bt_cross(v, t, turned);
    bt_add_scaled(turned, 1, v);
    bt_cross(turned, frame->spin_radps, field);
    for (int k = 0; k < 3; ++k)
        field[k] *= 2 / (1 + bt_dot(t, t));
}

/// y = I x, I of segment i: across everywhere, about its axis t otherwise.
static void inertia(const bt_cable_model* model, int i, const double t[3], const double x[3],
                    double y[3]) {
    const double across = 1 / model->inverse_tilt[i];
    const double about = 1 / (model->inverse_spin[i] + model->inverse_tilt[i]);
    const double along = (about - across) * bt_dot(t, x);
    for (int k = 0; k < 3; ++k)
        y[k] = across * x[k] + along * t[k];
}

/// Torque on a segment with the axis t and the momentum h = I w, in the frame's axes:
/// T = -W x h - (w x I W - I (w x W)) - I W' - W x I W.
static void frame_torque(const bt_cable_model* model, const bt_frame* frame, int i,
                         const double t[3], const double h[3], double torque[3]) {
    const double *spin = frame->spin_radps, along = model->inverse_spin[i] * bt_dot(t, h);
    double w[3], carried[3], turned[3], whole[3], change[3], both[3], cross[3];
    inertia(model, i, t, spin, carried);
    for (int k = 0; k < 3; ++k) {
        w[k] = model->inverse_tilt[i] * h[k] + along * t[k];
        whole[k] = h[k] + carried[k];
    }
    bt_cross(w, carried, turned);
    bt_cross(w, spin, both);
    bt_add_scaled(both, -1, frame->spin_rate_radps2);
    inertia(model, i, t, both, change);
    bt_cross(spin, whole, cross);
    for (int k = 0; k < 3; ++k)
        torque[k] = change[k] - turned[k] - cross[k];
}

double bt_cable_centrifugal(const bt_cable_model* model, const bt_cable_state* s, int i) {
    const double *spin = s->scalars->frame.spin_radps, r[3] = {s->x[i], s->y[i], s->z[i]};
    const double t[3] = {s->tx[i], s->ty[i], s->tz[i]};
    double carried[3], turning[3];
    bt_cross(spin, r, carried);
    inertia(model, i, t, spin, turning);
    return -0.5 * (model->mass_kg[i] * bt_dot(carried, carried) + bt_dot(spin, turning));
}

/// Force of the frame on a segment, weight included. Velocities are half a kick old: Coriolis acts
/// on what they will be in its middle, by all forces but the deck's.
static void frame_force(const bt_cable_model* model, const bt_cable_state* s, int i, double kick_s,
                        double force[3]) {
    const bt_frame* frame = &s->scalars->frame;
    const double still[3] = {0, 0, 0}, half = 0.5 * kick_s * model->inverse_mass[i];
    const double r[3] = {s->x[i], s->y[i], s->z[i]};
    double v[3] = {s->vx[i], s->vy[i], s->vz[i]}, field[3], turning[3];
    const int j = i + 1;
    const double other[3] = {s->joint_fx[j] - s->joint_fx[i] + s->fx[i],
                             s->joint_fy[j] - s->joint_fy[i] + s->fy[i],
                             s->joint_fz[j] - s->joint_fz[i] + s->fz[i] + s->support_fz[i]};
    bt_frame_field(frame, r, still, field);
    bt_add_scaled(v, half, other);
    bt_add_scaled(v, 0.5 * kick_s, field);
    coriolis(frame, v, kick_s, turning);
    for (int k = 0; k < 3; ++k)
        force[k] = model->mass_kg[i] * (field[k] + turning[k]);
}

/// Its torque, likewise with the momentum in the middle of the kick.
static void frame_turn(const bt_cable_model* model, const bt_cable_state* s, int i, double kick_s,
                       double torque[3]) {
    const double t[3] = {s->tx[i], s->ty[i], s->tz[i]};
    const double now[3] = {s->hx[i], s->hy[i], s->hz[i]};
    const int j = i + 1;
    const double other[3] = {s->before_x[j] + s->after_x[i] + s->mx[i] + s->support_mx[i],
                             s->before_y[j] + s->after_y[i] + s->my[i],
                             s->before_z[j] + s->after_z[i] + s->mz[i]};
    double middle[3];
    frame_torque(model, &s->scalars->frame, i, t, now, torque);
    for (int k = 0; k < 3; ++k)
        middle[k] = now[k] + 0.5 * kick_s * (torque[k] + other[k]);
    frame_torque(model, &s->scalars->frame, i, t, middle, torque);
}

void bt_cable_frame_load(const bt_cable_model* model, const bt_cable_state* s, int i, double kick_s,
                         double force_N[3], double torque_Nm[3]) {
    frame_force(model, s, i, kick_s, force_N);
    frame_turn(model, s, i, kick_s, torque_Nm);
    force_N[2] -= model->mass_kg[i] * s->scalars->frame.gravity_mps2[2];
}

void bt_cable_add_frame(const bt_cable_model* model, bt_cable_state* s, double kick_s,
                        bt_cable_state* loaded) {
    double* const own[6] = {s->fx, s->fy, s->fz, s->mx, s->my, s->mz};
    for (int k = 0; k < 6; ++k)
        memcpy(s->net[k], own[k], sizeof(double) * (size_t)model->stride);
    for (int i = 0; i < model->count; ++i) {
        double force[3], torque[3];
        bt_cable_frame_load(model, s, i, kick_s, force, torque);
        for (int k = 0; k < 3; ++k) {
            s->net[k][i] += force[k];
            s->net[3 + k][i] += torque[k];
        }
    }
    *loaded = *s;
    double** const taken[6] = {&loaded->fx, &loaded->fy, &loaded->fz,
                               &loaded->mx, &loaded->my, &loaded->mz};
    for (int k = 0; k < 6; ++k)
        *taken[k] = s->net[k];
}

void bt_cable_balance(const bt_cable_model* model, bt_cable_state* state) {
    bt_cable_forces(model, state);
    bt_cable_state loaded; // its loads lie in `net`, where each is read before it is overwritten
    const bool still = bt_cable_frame_is_still(state);
    if (!still)
        bt_cable_add_frame(model, state, 0, &loaded);
    model->kernel.resultants(model, still ? state : &loaded);
}
