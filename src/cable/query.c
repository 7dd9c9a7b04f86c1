/// What can be asked of the cable: where it passes, how hard it pulls.
#include "cable/cable_parts.h"

#include "mechanics/vec.h"

#include <math.h>

int bt_cable_bracket(const bt_cable_model* model, const bt_cable_state* s, double y, int hint) {
    const int last = model->count - 2;
    int i = hint;
    if (i < 0 || i > last) { /* by the straight rope, then by walking */
        int low = 0, high = last;
        while (low < high) {
            const int middle = (low + high + 1) / 2;
            if (model->rest_y_m[middle] <= y)
                low = middle;
            else
                high = middle - 1;
        }
        i = low;
    }
    while (i < last && y >= s->y[i + 1])
        ++i;
    while (i > 0 && y < s->y[i])
        --i;
    return y >= s->y[i] && y <= s->y[i + 1] ? i : -1;
}

/// Each line holds up to the joint between the two; the share goes from one to the other over the
/// middle half of the way, so that nothing jumps when the rope slides along y.
bt_cable_passage bt_cable_pass(const bt_cable_model* model, const bt_cable_state* s, double y,
                               int hint) {
    bt_cable_passage p = {.segment = bt_cable_bracket(model, s, y, hint)};
    if (p.segment < 0)
        return p;
    for (int k = 0; k < 2; ++k) {
        const int i = p.segment + k;
        const double t[3] = {s->tx[i], s->ty[i], s->tz[i]};
        const double w[3] = {s->wx[i], s->wy[i], s->wz[i]};
        const double along = (y - s->y[i]) / (t[1] > 0.1 ? t[1] : 0.1);
        const double arm[3] = {along * t[0], along * t[1], along * t[2]};
        double turn[3];
        bt_cross(w, arm, turn);
        p.point[k][0] = s->x[i] + arm[0];
        p.point[k][1] = y;
        p.point[k][2] = s->z[i] + arm[2];
        p.rate[k][0] = s->vx[i] + turn[0];
        p.rate[k][1] = s->vy[i] + turn[1];
        p.rate[k][2] = s->vz[i] + turn[2];
    }
    const int i = p.segment, j = i + 1;
    const double before = y - (s->y[i] + model->half_m[i] * s->ty[i]);
    const double after = (s->y[j] - model->half_m[j] * s->ty[j]) - y;
    const double width = 0.5 * (model->half_m[i] * s->ty[i] + model->half_m[j] * s->ty[j]);
    const double free = 0.5 * (before - after) / width;
    const double balance = free > 0.5 ? 0.5 : free < -0.5 ? -0.5 : free;
    p.share[0] = 0.5 - balance;
    p.share[1] = 0.5 + balance;
    return p;
}

int bt_cable_segment_at(const bt_cable_model* model, const bt_cable_state* s, double y_m,
                        int hint) {
    int i = bt_cable_bracket(model, s, y_m, hint);
    if (i < 0) {
        const int last = model->count - 1;
        const bool first = y_m < s->y[0] && y_m >= s->y[0] - model->half_m[0];
        const bool final = y_m > s->y[last] && y_m <= s->y[last] + model->half_m[last];
        return first ? 0 : final ? last : -1;
    }
    const double joint = 0.5 * ((s->y[i] + model->half_m[i] * s->ty[i]) +
                                (s->y[i + 1] - model->half_m[i + 1] * s->ty[i + 1]));
    return y_m < joint ? i : i + 1;
}

int bt_cable_centreline(const bt_cable_model* model, const bt_cable_state* s, double y_m, int hint,
                        double position_m[3], double velocity_mps[3], double direction[3]) {
    const bt_cable_passage p = bt_cable_pass(model, s, y_m, hint);
    if (p.segment < 0)
        return -1;
    const int i = p.segment, j = i + 1;
    for (int k = 0; k < 3; ++k) {
        position_m[k] = p.share[0] * p.point[0][k] + p.share[1] * p.point[1][k];
        if (velocity_mps)
            velocity_mps[k] = p.share[0] * p.rate[0][k] + p.share[1] * p.rate[1][k];
    }
    if (direction) {
        const double t[3] = {p.share[0] * s->tx[i] + p.share[1] * s->tx[j],
                             p.share[0] * s->ty[i] + p.share[1] * s->ty[j],
                             p.share[0] * s->tz[i] + p.share[1] * s->tz[j]};
        const double size = bt_norm(t);
        for (int k = 0; k < 3; ++k)
            direction[k] = t[k] / size;
    }
    return i;
}

double bt_cable_tension(const bt_cable_model* model, const bt_cable_state* s, int joint) {
    const int i = joint > 0 ? joint - 1 : 0, j = joint < model->count ? joint : model->count - 1;
    const double axis[3] = {s->tx[i] + s->tx[j], s->ty[i] + s->ty[j], s->tz[i] + s->tz[j]};
    const double force[3] = {s->joint_fx[joint], s->joint_fy[joint], s->joint_fz[joint]};
    return bt_dot(force, axis) / bt_norm(axis);
}

double bt_cable_tension_max(const bt_cable_model* model, const bt_cable_state* s) {
    double most = bt_cable_tension(model, s, 0);
    for (int j = 1; j <= model->count; ++j)
        most = fmax(most, bt_cable_tension(model, s, j));
    return most;
}
