/// The cable's state: one block, and the places at which it starts.
#include "cable/cable_parts.h"

#include <math.h>
#include <string.h>

size_t bt_cable_state_size(const bt_cable_model* model) {
    return BT_CABLE_STATE_ARRAYS * (size_t)model->stride * sizeof(double) +
           sizeof(struct bt_cable_scalars);
}

bt_status bt_cable_state_init(const bt_cable_model* model, bt_cable_state* state, bt_arena* arena) {
    *state = (bt_cable_state){0};
    state->block_size = bt_cable_state_size(model);
    state->block = bt_arena_take(arena, state->block_size);
    if (!state->block)
        return BT_ERR_MEMORY;
    double** members[BT_CABLE_STATE_ARRAYS] = {
        &state->x,        &state->y,        &state->z,          &state->e0,
        &state->e1,       &state->e2,       &state->e3,         &state->vx,
        &state->vy,       &state->vz,       &state->hx,         &state->hy,
        &state->hz,       &state->wx,       &state->wy,         &state->wz,
        &state->tx,       &state->ty,       &state->tz,         &state->fx,
        &state->fy,       &state->fz,       &state->mx,         &state->my,
        &state->mz,       &state->joint_fx, &state->joint_fy,   &state->joint_fz,
        &state->before_x, &state->before_y, &state->before_z,   &state->after_x,
        &state->after_y,  &state->after_z,  &state->support_fz, &state->support_mx,
        &state->net[0],   &state->net[1],   &state->net[2],     &state->net[3],
        &state->net[4],   &state->net[5],
    };
    for (int k = 0; k < BT_CABLE_STATE_ARRAYS; ++k)
        *members[k] = state->block + (size_t)k * (size_t)model->stride;
    state->scalars =
        (struct bt_cable_scalars*)(void*)(state->block + BT_CABLE_STATE_ARRAYS * model->stride);
    bt_cable_place(model, state);
    return BT_OK;
}

void bt_cable_state_copy(const bt_cable_model* model, bt_cable_state* to,
                         const bt_cable_state* from) {
    (void)model;
    memcpy(to->block, from->block, from->block_size);
}

bool bt_cable_state_equal(const bt_cable_state* a, const bt_cable_state* b) {
    return a->block_size == b->block_size && memcmp(a->block, b->block, a->block_size) == 0;
}

void bt_cable_set_axis(bt_cable_state* state, int i) {
    const double a = state->e0[i], b = state->e1[i], c = state->e2[i], d = state->e3[i];
    state->tx[i] = 2 * (b * c - a * d);
    state->ty[i] = 1 - 2 * (b * b + d * d);
    state->tz[i] = 2 * (c * d + a * b);
}

/// Sag over span of a hanging rope with w = weight per length, length over span and EA:
/// parabola, 1 + (w S / H)^2 / 24 = (L / S) (1 + H / EA); H by bisection. 0 when it is tight.
static double sag_ratio(const bt_cable_model* model, double span) {
    const bt_cable_def* d = &model->def;
    const double weight = d->mass_kgpm * d->gravity_mps2 * span;
    double length = 0;
    for (int i = 0; i < model->count; ++i)
        length += 2 * model->half_m[i];
    if (d->end[0].kind != BT_CABLE_PINNED || d->end[1].kind != BT_CABLE_PINNED || !(weight > 0))
        return 0;
    double low = 1e-12 * d->axial_stiffness_N, high = d->axial_stiffness_N;
    for (int k = 0; k < 200; ++k) {
        const double h = sqrt(low * high), slope = weight / h;
        if (1 + slope * slope / 24 > length / span * (1 + h / d->axial_stiffness_N))
            low = h;
        else
            high = h;
    }
    return weight / (8 * low);
}

/// A rope much longer than the line between its ends hangs as a catenary of its length: with
/// arguments b - a .. b + a of scale p, sinh(a) / a = sqrt(L^2 - rise^2) / span, tanh(b) = rise /
/// L.
static void place_slack(const bt_cable_model* model, bt_cable_state* state, double length) {
    const double* from = model->def.end[0].anchor_m;
    const double* to = model->def.end[1].anchor_m;
    const double span = to[1] - from[1], rise = to[2] - from[2];
    const double ratio = sqrt(length * length - rise * rise) / span;
    double low = 1e-9, high = 50;
    for (int k = 0; k < 100; ++k) {
        const double a = 0.5 * (low + high);
        if (sinh(a) / a < ratio)
            low = a;
        else
            high = a;
    }
    const double p = 0.5 * span / low, first = atanh(rise / length) - low;
    for (int i = 0; i < model->count; ++i) {
        const double along = length * (model->rest_y_m[i] - from[1]) / span;
        const double at = asinh(along / p + sinh(first)), slope = atan(sinh(at));
        state->y[i] = from[1] + p * (at - first);
        state->z[i] = from[2] + p * (cosh(at) - cosh(first));
        state->e0[i] = cos(0.5 * slope);
        state->e1[i] = sin(0.5 * slope);
        bt_cable_set_axis(state, i);
    }
}

void bt_cable_place(const bt_cable_model* model, bt_cable_state* state) {
    const bt_cable_def* d = &model->def;
    memset(state->block, 0, state->block_size);
    state->scalars->frame.gravity_mps2[2] = -d->gravity_mps2;
    double along[3], span = 0;
    for (int k = 0; k < 3; ++k)
        along[k] = d->end[1].anchor_m[k] - d->end[0].anchor_m[k];
    span = along[1];
    const double sag = sag_ratio(model, span);
    for (int i = 0; i < model->stride; ++i) {
        state->e0[i] = 1;
        state->ty[i] = 1;
        if (i >= model->count)
            continue;
        const double u = (model->rest_y_m[i] - d->end[0].anchor_m[1]) / span;
        state->x[i] = d->end[0].anchor_m[0] + u * along[0];
        state->y[i] = model->rest_y_m[i];
        state->z[i] = d->end[0].anchor_m[2] + u * along[2] - 4 * sag * span * u * (1 - u);
        const double slope = atan(along[2] / span - 4 * sag * (1 - 2 * u));
        state->e0[i] = cos(0.5 * slope);
        state->e1[i] = sin(0.5 * slope);
        bt_cable_set_axis(state, i);
    }
    double length = 0;
    for (int i = 0; i < model->count; ++i)
        length += 2 * model->half_m[i];
    if (sag > 0 && length > 1.2 * hypot(span, along[2]))
        place_slack(model, state, length);
    for (int k = 0; k < 2; ++k) {
        memcpy(state->scalars->anchor_m[k], d->end[k].anchor_m, sizeof d->end[k].anchor_m);
        state->scalars->anchor_e[k][0] = 1;
    }
    for (int k = 0; k < BT_LIST_MAX; ++k)
        state->scalars->support_at[k] = -1;
}
