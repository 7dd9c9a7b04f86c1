/// One step of the cable, and the loads of the caller.
#include "cable/cable_parts.h"

#include "mechanics/vec.h"

#include <string.h>

void bt_cable_forces(const bt_cable_model* model, bt_cable_state* state) {
    // 1. springs and dampers between the segments [Peng2023 Eqs. 12-17]
    model->kernel.joints(model, state);
    // 2. what holds the rope: sheaves with the purchase cable, wire supports
    bt_cable_ends(model, state);
    bt_cable_supports(model, state);
}

void bt_cable_advance(const bt_cable_model* model, bt_cable_state* state, double step_s) {
    const double kick = 0.5 * (state->scalars->last_step_s + step_s);
    // 3. what the deck's motion does to every segment
    bt_cable_state loaded;
    const bool still = bt_cable_frame_is_still(state);
    if (!still)
        bt_cable_add_frame(model, state, kick, &loaded);
    // 4. the deck under every segment, then velocities, positions and attitudes by the step
    model->kernel.advance(model, still ? state : &loaded, kick, step_s);
    state->scalars->last_step_s = step_s;
    state->scalars->time_s += step_s;
}

void bt_cable_step(const bt_cable_model* model, bt_cable_state* state, double step_s) {
    bt_cable_forces(model, state);
    bt_cable_advance(model, state, step_s);
}

void bt_cable_clear_loads(const bt_cable_model* model, bt_cable_state* state) {
    /* fx .. mz are six arrays in a row */
    memset(state->fx, 0, 6 * (size_t)model->stride * sizeof(double));
}

void bt_cable_add_load(bt_cable_state* s, int i, const double force_N[3], const double point_m[3]) {
    const double arm[3] = {point_m[0] - s->x[i], point_m[1] - s->y[i], point_m[2] - s->z[i]};
    double torque[3];
    bt_cross(arm, force_N, torque);
    s->fx[i] += force_N[0];
    s->fy[i] += force_N[1];
    s->fz[i] += force_N[2];
    s->mx[i] += torque[0];
    s->my[i] += torque[1];
    s->mz[i] += torque[2];
}

double bt_cable_load_power(const bt_cable_model* model, const bt_cable_state* s) {
    double power_W = 0;
    for (int i = 0; i < model->count; ++i)
        power_W += s->fx[i] * s->vx[i] + s->fy[i] * s->vy[i] + s->fz[i] * s->vz[i] +
                   s->mx[i] * s->wx[i] + s->my[i] * s->wy[i] + s->mz[i] * s->wz[i];
    return power_W;
}

bool bt_cable_is_finite(const bt_cable_model* model, const bt_cable_state* s) {
    double sum = 0;
    for (int i = 0; i < model->count; ++i)
        sum += 0 * (s->x[i] + s->y[i] + s->z[i] + s->vx[i] + s->vy[i] + s->vz[i] + s->wx[i] +
                    s->wy[i] + s->wz[i]);
    return sum == 0;
}
