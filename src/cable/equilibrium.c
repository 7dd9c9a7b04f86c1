/// Static equilibrium of the cable: Newton's method on the forces of the stepping kernel, in the
/// plane x = 0, three unknowns (y, z, rotation about x) per segment, block-tridiagonal Jacobian by
/// central differences in three colours.
#include "cable/cable_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    B = 3, ///< unknowns of a segment
    NEWTON_MAX = 80,
    ANCHOR_MAX = 30,
};

/// One row of the block-tridiagonal system: lower, diagonal, upper and right side.
typedef struct row {
    double lower[B][B], diagonal[B][B], upper[B][B], right[B];
} row;

/// Forces along y and z and the torque about x of one segment.
static void resultant(const bt_cable_state* s, int i, double r[B]) {
    r[0] = s->net[1][i];
    r[1] = s->net[2][i];
    r[2] = s->net[3][i];
}

static double largest(const bt_cable_model* model, const bt_cable_state* s) {
    double most = 0;
    for (int i = 0; i < model->count; ++i) {
        const double torque = fabs(s->net[3][i]) * 0.5 / model->half_m[i];
        const double force = fmax(fabs(s->net[1][i]), fabs(s->net[2][i]));
        most = fmax(most, fmax(force, torque));
        if (!isfinite(force + torque))
            return INFINITY;
    }
    return most;
}

static void move(bt_cable_state* s, int i, int unknown, double by) {
    if (unknown == 0)
        s->y[i] += by;
    else if (unknown == 1)
        s->z[i] += by;
    else {
        const double c = cos(0.5 * by), d = sin(0.5 * by);
        const double e0 = s->e0[i], e1 = s->e1[i], e2 = s->e2[i], e3 = s->e3[i];
        const double f0 = c * e0 - d * e1, f1 = c * e1 + d * e0;
        const double f2 = c * e2 - d * e3, f3 = c * e3 + d * e2;
        const double scale = 1 / sqrt(f0 * f0 + f1 * f1 + f2 * f2 + f3 * f3);
        s->e0[i] = scale * f0;
        s->e1[i] = scale * f1;
        s->e2[i] = scale * f2;
        s->e3[i] = scale * f3;
        bt_cable_set_axis(s, i);
    }
}

/// Moves every third segment, from `colour` on; the differences go to the columns they cause.
static void difference(const bt_cable_model* model, bt_cable_state* s, row* rows, int colour,
                       int unknown, double by, double sign) {
    const int n = model->count;
    for (int i = colour; i < n; i += 3)
        move(s, i, unknown, sign * by);
    bt_cable_balance(model, s);
    for (int i = colour; i < n; i += 3) {
        const int first = i > 0 ? i - 1 : 0, last = i < n - 1 ? i + 1 : n - 1;
        for (int k = first; k <= last; ++k) {
            double r[B];
            resultant(s, k, r);
            double(*block)[B] = k == i ? rows[k].diagonal : k < i ? rows[k].upper : rows[k].lower;
            for (int a = 0; a < B; ++a)
                block[a][unknown] += sign * r[a] / (2 * by);
        }
    }
    for (int i = colour; i < n; i += 3)
        move(s, i, unknown, -sign * by);
}

static void build(const bt_cable_model* model, bt_cable_state* s, row* rows) {
    static const double by[B] = {1e-7, 1e-7, 1e-6};
    memset(rows, 0, sizeof(row) * (size_t)model->count);
    for (int colour = 0; colour < 3; ++colour)
        for (int unknown = 0; unknown < B; ++unknown) {
            difference(model, s, rows, colour, unknown, by[unknown], 1);
            difference(model, s, rows, colour, unknown, by[unknown], -1);
        }
}

/// Solves a x = b for `columns` right sides in place, by elimination with row exchange.
/// Returns false for a singular block.
static bool solve_block(double a[B][B], double* b, int columns) {
    for (int p = 0; p < B; ++p) {
        int best = p;
        for (int r = p + 1; r < B; ++r)
            if (fabs(a[r][p]) > fabs(a[best][p]))
                best = r;
        if (!(fabs(a[best][p]) > 0))
            return false;
        for (int c = 0; c < B && best != p; ++c) {
            const double t = a[p][c];
            a[p][c] = a[best][c];
            a[best][c] = t;
        }
        for (int c = 0; c < columns && best != p; ++c) {
            const double t = b[p * columns + c];
            b[p * columns + c] = b[best * columns + c];
            b[best * columns + c] = t;
        }
        for (int r = 0; r < B; ++r) {
            if (r == p)
                continue;
            const double f = a[r][p] / a[p][p];
            for (int c = p; c < B; ++c)
                a[r][c] -= f * a[p][c];
            for (int c = 0; c < columns; ++c)
                b[r * columns + c] -= f * b[p * columns + c];
        }
    }
    for (int p = 0; p < B; ++p)
        for (int c = 0; c < columns; ++c)
            b[p * columns + c] /= a[p][p];
    return true;
}

/// Block elimination forward, substitution backward; the solution replaces `right`.
static bool solve(row* rows, int n) {
    for (int i = 0; i < n; ++i) {
        double both[B][B + 1];
        if (i > 0)
            for (int a = 0; a < B; ++a)
                for (int k = 0; k < B; ++k) {
                    const double l = rows[i].lower[a][k];
                    for (int c = 0; c < B; ++c)
                        rows[i].diagonal[a][c] -= l * rows[i - 1].upper[k][c];
                    rows[i].right[a] -= l * rows[i - 1].right[k];
                }
        for (int a = 0; a < B; ++a) {
            memcpy(both[a], rows[i].upper[a], sizeof rows[i].upper[a]);
            both[a][B] = rows[i].right[a];
        }
        if (!solve_block(rows[i].diagonal, &both[0][0], B + 1))
            return false;
        for (int a = 0; a < B; ++a) {
            memcpy(rows[i].upper[a], both[a], sizeof rows[i].upper[a]);
            rows[i].right[a] = both[a][B];
        }
    }
    for (int i = n - 2; i >= 0; --i)
        for (int a = 0; a < B; ++a)
            for (int c = 0; c < B; ++c)
                rows[i].right[a] -= rows[i].upper[a][c] * rows[i + 1].right[c];
    return true;
}

/// Makes a shape that is alike left and right exactly so.
static void symmetrise(const bt_cable_model* model, bt_cable_state* s) {
    const int n = model->count;
    for (int i = 0; i < n; ++i) {
        const int j = n - 1 - i;
        if (model->rest_y_m[i] != -model->rest_y_m[j] || fabs(s->y[i] + s->y[j]) > 1e-9 ||
            fabs(s->z[i] - s->z[j]) > 1e-9 || model->half_m[i] != model->half_m[j])
            return;
    }
    for (int i = 0; i < n / 2; ++i) {
        const int j = n - 1 - i;
        s->y[j] = 0.5 * (s->y[j] - s->y[i]);
        s->z[j] = 0.5 * (s->z[j] + s->z[i]);
        s->e0[j] = 0.5 * (s->e0[j] + s->e0[i]);
        s->e1[j] = 0.5 * (s->e1[j] - s->e1[i]);
        move(s, j, 2, 0);
        s->y[i] = -s->y[j];
        s->z[i] = s->z[j];
        s->e0[i] = s->e0[j];
        s->e1[i] = -s->e1[j];
        bt_cable_set_axis(s, i);
    }
}

/// One step of Newton's method; the resultants are those of the present shape, before and after.
/// *full tells whether the whole step was taken. Returns false when the Jacobian is singular.
static bool improve(const bt_cable_model* model, bt_cable_state* s, row* rows, bt_cable_state* keep,
                    bool* full) {
    const int n = model->count;
    bt_cable_state_copy(model, keep, s); /* differences leave rounding errors in the coordinates */
    build(model, s, rows);
    bt_cable_state_copy(model, s, keep);
    for (int i = 0; i < n; ++i)
        resultant(s, i, rows[i].right);
    if (!solve(rows, n))
        return false;
    double turn = 0;
    for (int i = 0; i < n; ++i)
        turn = fmax(turn, fabs(rows[i].right[2]));
    /* rotations beyond 0.2 rad leave the range where the linearisation means anything */
    *full = turn <= 0.2;
    const double scale = *full ? 1 : 0.2 / turn;
    for (int i = 0; i < n; ++i)
        for (int a = 0; a < B; ++a)
            move(s, i, a, -scale * rows[i].right[a]);
    bt_cable_balance(model, s);
    return true;
}

/// Newton's method with the anchors where they are. Returns the largest force left; infinite on
/// failure.
static double settle(const bt_cable_model* model, bt_cable_state* s, row* rows,
                     bt_cable_state* keep) {
    bt_cable_balance(model, s);
    double left = largest(model, s), best = INFINITY;
    bool full = true;
    for (int k = 0; k < NEWTON_MAX && isfinite(left); ++k) {
        /* at rounding level it no longer falls */
        if (left < 1e-4 && left > 0.5 * best)
            return left;
        best = full ? fmin(best, left) : INFINITY;
        if (!improve(model, s, rows, keep, &full))
            return INFINITY;
        left = largest(model, s);
    }
    return left;
}

/// Supports near or below the line between the anchors are out of Newton's sight: the rope starts
/// clear of them. They begin above that line and are lowered a little at a time, so that they
/// always carry; stiff ones, which would let go of the rope at once, begin soft and become twice as
/// stiff at a time.
static double settle_onto_supports(const bt_cable_model* model, bt_cable_state* s, row* rows,
                                   bt_cable_state* keep) {
    static const double above_m = 0.02, lower_by_m = 4e-3, soft_Npm = 1e5;
    const bt_cable_def* d = &model->def;
    if (d->support_y_m.count == 0)
        return settle(model, s, rows, keep);
    const double line_m =
        fmin(s->scalars->anchor_m[0][2], s->scalars->anchor_m[1][2]) - model->radius_m;
    const double begin_m = fmax(line_m + above_m, d->support.height_m);
    const int stages = (int)ceil((begin_m - d->support.height_m) / lower_by_m);
    bt_cable_model eased = *model;
    eased.def.support.stiffness_Npm = fmin(d->support.stiffness_Npm, soft_Npm);
    double left = 0;
    for (int k = 0; k < stages && isfinite(left); ++k) {
        eased.def.support.height_m = begin_m - (begin_m - d->support.height_m) * k / stages;
        left = settle(&eased, s, rows, keep);
    }
    eased.def.support.height_m = d->support.height_m;
    while (eased.def.support.stiffness_Npm < d->support.stiffness_Npm && isfinite(left)) {
        left = settle(&eased, s, rows, keep);
        eased.def.support.stiffness_Npm *= 2;
    }
    return settle(model, s, rows, keep);
}

static bool hangs_clear(const bt_cable_model* model, const bt_cable_state* s, bt_diag* diag) {
    const bt_cable_def* d = &model->def;
    for (int k = 0; k < d->support_y_m.count; ++k) {
        double at[3];
        if (s->scalars->support_force_N[k] > 0 ||
            bt_cable_centreline(model, s, d->support_y_m.value[k], -1, at, NULL, NULL) < 0)
            continue;
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "deck.cable: at rest it hangs %g m above its support at y = %g m; raise the "
                    "supports by more than that, lower the sheaves or the pretension",
                    at[2] - model->radius_m - d->support.height_m, d->support_y_m.value[k]);
        return true;
    }
    return false;
}

static bool lies_on_deck(const bt_cable_model* model, const bt_cable_state* s, bt_diag* diag) {
    for (int i = 0; model->def.deck && model->def.support_y_m.count > 0 && i < model->count; ++i)
        if (s->z[i] < model->radius_m) {
            bt_diag_add(
                diag, BT_ERROR, BT_NOWHERE,
                "deck.cable: at rest it lies on the deck at y = %g m; more pretension, higher "
                "supports or supports nearer together",
                s->y[i]);
            return true;
        }
    return false;
}

/// Moves the anchors of sheaves to where the purchase cable pulls with the pretension.
/// Returns the largest move.
static double tune_anchors(const bt_cable_model* model, bt_cable_state* s) {
    double most = 0;
    for (int side = 0; side < 2; ++side) {
        const bt_cable_end* end = &model->def.end[side];
        if (end->kind != BT_CABLE_SHEAVE || !(end->purchase_stiffness_Npm > 0))
            continue;
        const double lack = end->pretension_N - s->scalars->end_tension_N[side];
        const double by = (side ? 1 : -1) * lack / end->purchase_stiffness_Npm;
        s->scalars->anchor_m[side][1] += by;
        most = fmax(most, fabs(by));
    }
    return most;
}

bt_status bt_cable_equilibrium(const bt_cable_model* model, bt_cable_state* state,
                               double* residual_N, bt_diag* diag) {
    bt_status status = BT_ERR_MEMORY;
    bt_arena arena;
    const size_t rows_size = sizeof(row) * (size_t)model->count;
    BT_TRY(bt_arena_create(&arena, bt_cable_memory(model->count, 1) + rows_size + 64));
    bt_cable_state keep;
    row* rows = bt_arena_take(&arena, rows_size);
    if (!rows || bt_cable_state_init(model, &keep, &arena) != BT_OK)
        goto done;
    memset(state->vx, 0, 9 * (size_t)model->stride * sizeof(double)); /* v, h, w */
    state->scalars->last_step_s = 0;
    double left = settle_onto_supports(model, state, rows, &keep);
    bool full = true;
    for (int k = 0; k < ANCHOR_MAX && left < 1e-3 && full; ++k) {
        if (tune_anchors(model, state) < 1e-12)
            break;
        bt_cable_balance(model, state);
        if (!improve(model, state, rows, &keep, &full))
            left = INFINITY;
    }
    if (left < 1e-3)
        left = settle(model, state, rows, &keep);
    symmetrise(model, state);
    bt_cable_balance(model, state);
    left = fmax(left, largest(model, state));
    if (residual_N)
        *residual_N = left;
    if (!(left < 1e-3)) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "deck.cable: no static equilibrium found (%g N left after %d iterations)", left,
                    (int)NEWTON_MAX);
        status = BT_ERR_NUMERIC;
    } else {
        status = hangs_clear(model, state, diag) || lies_on_deck(model, state, diag)
                     ? BT_ERR_NUMERIC
                     : BT_OK;
    }
done:
    bt_arena_destroy(&arena);
    return status;
}
