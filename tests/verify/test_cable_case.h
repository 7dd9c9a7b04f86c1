/// A rope with its memory, for the cable's verification cases.
#ifndef BT_TESTS_CABLE_CASE_H
#define BT_TESTS_CABLE_CASE_H

#include "cable/cable.h"

#include <stdlib.h>

#include "near.h"

typedef struct rope {
    bt_arena arena;
    bt_cable_model model;
    bt_cable_state state;
} rope;

/// A uniform rope of `count` segments without gravity, deck, supports or damping, free ends,
/// unstretched length `length_m` from (0, 0, 0) along y.
static inline bt_cable_def rope_def(int count, double length_m) {
    bt_cable_def def = {.count = count,
                        .diameter_m = 0.0365,
                        .mass_kgpm = 5.536,
                        .axial_stiffness_N = 5.1e7,
                        .bending_stiffness_Nm2 = 150,
                        .twist_stiffness_Nm2 = 60,
                        .shear_ratio = 1.0 / 3,
                        .compression_ratio = 1};
    def.end[1].anchor_m[1] = length_m;
    return def;
}

/// Opens a rope of def->count segments of the given unstretched lengths.
static inline void rope_open_mesh(rope* r, bt_cable_def* def, const double* segment_m) {
    def->length_m = segment_m;
    assert_int_equal(bt_arena_create(&r->arena, bt_cable_memory(def->count, 1)), BT_OK);
    assert_int_equal(bt_cable_model_init(&r->model, def, &r->arena, NULL), BT_OK);
    assert_int_equal(bt_cable_state_init(&r->model, &r->state, &r->arena), BT_OK);
}

/// Opens a rope of equal segments; total unstretched length `length_m`.
static inline void rope_open(rope* r, bt_cable_def* def, double length_m) {
    double* length = malloc(sizeof(double) * (size_t)def->count);
    assert_non_null(length);
    for (int i = 0; i < def->count; ++i)
        length[i] = length_m / def->count;
    rope_open_mesh(r, def, length);
    free(length);
}

static inline void rope_close(rope* r) {
    bt_arena_destroy(&r->arena);
}

static inline void rope_run(rope* r, int steps, double step_s) {
    for (int k = 0; k < steps; ++k)
        bt_cable_step(&r->model, &r->state, step_s);
}

/// The middle of the gap at an inner joint.
static inline void rope_joint(const rope* r, int joint, double at[3]) {
    const bt_cable_state* s = &r->state;
    const int i = joint - 1, j = joint;
    const double hi = r->model.half_m[i], hj = r->model.half_m[j];
    at[0] = 0.5 * (s->x[i] + hi * s->tx[i] + s->x[j] - hj * s->tx[j]);
    at[1] = 0.5 * (s->y[i] + hi * s->ty[i] + s->y[j] - hj * s->ty[j]);
    at[2] = 0.5 * (s->z[i] + hi * s->tz[i] + s->z[j] - hj * s->tz[j]);
}

/// The outer end of the last segment.
static inline void rope_tip(const rope* r, double at[3]) {
    const bt_cable_state* s = &r->state;
    const int i = r->model.count - 1;
    at[0] = s->x[i] + r->model.half_m[i] * s->tx[i];
    at[1] = s->y[i] + r->model.half_m[i] * s->ty[i];
    at[2] = s->z[i] + r->model.half_m[i] * s->tz[i];
}

/// Adds the rotation vector (a, b, c) to the attitude of a segment, small or large.
static inline void rope_turn(rope* r, int i, double a, double b, double c) {
    bt_cable_state* s = &r->state;
    const double angle = sqrt(a * a + b * b + c * c);
    if (angle == 0)
        return;
    const double w = cos(0.5 * angle), f = sin(0.5 * angle) / angle;
    const double x = f * a, y = f * b, z = f * c;
    const double e0 = s->e0[i], e1 = s->e1[i], e2 = s->e2[i], e3 = s->e3[i];
    s->e0[i] = w * e0 - x * e1 - y * e2 - z * e3;
    s->e1[i] = w * e1 + x * e0 + y * e3 - z * e2;
    s->e2[i] = w * e2 + y * e0 + z * e1 - x * e3;
    s->e3[i] = w * e3 + z * e0 + x * e2 - y * e1;
    s->tx[i] = 2 * (s->e1[i] * s->e2[i] - s->e0[i] * s->e3[i]);
    s->ty[i] = 1 - 2 * (s->e1[i] * s->e1[i] + s->e3[i] * s->e3[i]);
    s->tz[i] = 2 * (s->e2[i] * s->e3[i] + s->e0[i] * s->e1[i]);
}

/// Order of convergence from three errors at spacings h, h/2, h/4 (the last pair decides).
static inline double order_of(const double error[3]) {
    return log2(fabs(error[1] / error[2]));
}

#endif
