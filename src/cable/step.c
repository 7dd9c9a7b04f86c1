/// One step of the cable, and what can be asked of it.
#include "cable/cable_kernel.h"

#include "mechanics/vec.h"

#include <math.h>
#include <string.h>

/* ---- ends ---- */

typedef struct end_point {
    int segment, joint;
    double sign;     ///< -1 at segment 0, +1 at the last segment
    double arm[3];   ///< from the segment's centre to its end
    double gap[3];   ///< from the anchor to the end of the segment
    double speed[3]; ///< rate of gap
    double axis[3], spin[3];
} end_point;

static end_point end_point_of(const bt_cable_model* model, const bt_cable_state* s, int side) {
    const int i = side ? model->count - 1 : 0;
    const double sign = side ? 1 : -1, h = sign * model->half_m[i];
    end_point p = {.segment = i,
                   .joint = side ? model->count : 0,
                   .sign = sign,
                   .arm = {h * s->tx[i], h * s->ty[i], h * s->tz[i]},
                   .axis = {s->tx[i], s->ty[i], s->tz[i]},
                   .spin = {s->wx[i], s->wy[i], s->wz[i]}};
    const double centre[3] = {s->x[i], s->y[i], s->z[i]};
    const double velocity[3] = {s->vx[i], s->vy[i], s->vz[i]};
    double turn[3];
    bt_cross(p.spin, p.arm, turn);
    for (int k = 0; k < 3; ++k) {
        p.gap[k] = centre[k] + p.arm[k] - s->scalars->anchor_m[side][k];
        p.speed[k] = velocity[k] + turn[k] - s->scalars->anchor_velocity_mps[side][k];
    }
    return p;
}

/// Force and torque on the end segment, into the outputs of the end joint.
static void put_end(bt_cable_state* s, const end_point* p, const double force[3],
                    const double torque[3]) {
    const int j = p->joint;
    /* the joint's force is the one on the segment before it; segment 0 lies after joint 0 */
    s->joint_fx[j] = p->sign * force[0];
    s->joint_fy[j] = p->sign * force[1];
    s->joint_fz[j] = p->sign * force[2];
    double* const to[3] = {p->sign > 0 ? s->before_x : s->after_x,
                           p->sign > 0 ? s->before_y : s->after_y,
                           p->sign > 0 ? s->before_z : s->after_z};
    for (int k = 0; k < 3; ++k)
        to[k][j] = torque[k];
}

/// Half a joint between the anchor and the end: twice the stiffness of a whole one.
static void hold_end(const bt_cable_model* model, bt_cable_state* s, int side) {
    const bt_cable_def* d = &model->def;
    const end_point p = end_point_of(model, s, side);
    const double per = 1 / model->half_m[p.segment];
    const double ka = d->axial_stiffness_N, ca = d->axial_damping_Ns;
    const double out = -p.sign * bt_dot(p.gap, p.axis); /* opening of the gap */
    const double out_speed = -p.sign * bt_dot(p.speed, p.axis);
    const double part = out > 0 ? 1 : d->compression_ratio;
    const double along = -p.sign * ((part - d->shear_ratio) * (ka * out + ca * out_speed));
    double force[3], torque[3], arm[3];
    for (int k = 0; k < 3; ++k) {
        force[k] = -per * (along * p.axis[k] + d->shear_ratio * (ka * p.gap[k] + ca * p.speed[k]));
        arm[k] = p.arm[k] - p.gap[k];
    }
    bt_cross(arm, force, torque);
    if (d->end[side].kind == BT_CABLE_CLAMPED) {
        const int i = p.segment;
        const double e[4] = {s->e0[i], s->e1[i], s->e2[i], s->e3[i]};
        const double* w = s->scalars->anchor_e[side];
        const double back[4] = {w[0], -w[1], -w[2], -w[3]};
        double c[4];
        bt_euler_multiply(e, back, c);
        const double sine = bt_norm(c + 1);
        const double twice = sine > 1e-9 ? 2 * atan2(sine, c[0]) / sine : 2;
        const double twist = twice * bt_dot(c + 1, p.axis), twist_rate = bt_dot(p.spin, p.axis);
        for (int k = 0; k < 3; ++k)
            torque[k] -=
                per *
                (d->bending_stiffness_Nm2 * (twice * c[1 + k] - twist * p.axis[k]) +
                 d->bending_damping_Nm2s * (p.spin[k] - twist_rate * p.axis[k]) +
                 (d->twist_stiffness_Nm2 * twist + d->twist_damping_Nm2s * twist_rate) * p.axis[k]);
    }
    put_end(s, &p, force, torque);
}

/// Across: half a joint's shear spring at the sheave. Along y: the purchase cable, which only
/// pulls.
static void hold_sheave(const bt_cable_model* model, bt_cable_state* s, int side) {
    const bt_cable_def* d = &model->def;
    const bt_cable_end* end = &d->end[side];
    const end_point p = end_point_of(model, s, side);
    const double per = d->shear_ratio / model->half_m[p.segment];
    const double pull = end->pretension_N - p.sign * (end->purchase_stiffness_Npm * p.gap[1] +
                                                      end->purchase_damping_Npmps * p.speed[1]);
    const double tension = pull > 0 ? pull : 0;
    const double force[3] = {
        -per * (d->axial_stiffness_N * p.gap[0] + d->axial_damping_Ns * p.speed[0]),
        p.sign * tension,
        -per * (d->axial_stiffness_N * p.gap[2] + d->axial_damping_Ns * p.speed[2]),
    };
    double torque[3];
    bt_cross(p.arm, force, torque);
    s->scalars->end_tension_N[side] = tension;
    put_end(s, &p, force, torque);
}

void bt_cable_ends(const bt_cable_model* model, bt_cable_state* state) {
    const double none[3] = {0, 0, 0};
    for (int side = 0; side < 2; ++side) {
        const end_point at = {.joint = side ? model->count : 0, .sign = side ? 1 : -1};
        switch (model->def.end[side].kind) {
        case BT_CABLE_FREE:
            put_end(state, &at, none, none);
            break;
        case BT_CABLE_PINNED:
        case BT_CABLE_CLAMPED:
            hold_end(model, state, side);
            break;
        case BT_CABLE_SHEAVE:
            hold_sheave(model, state, side);
            break;
        }
    }
}

/* ---- supports ---- */

/// The first of the two neighbouring segments whose centres lie around y; -1 beyond them all.
static int bracket(const bt_cable_model* model, const bt_cable_state* s, double y, int hint) {
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

/// Where the rope passes y: the lines of two neighbouring segments, shared.
typedef struct passage {
    int segment;        ///< the first of the two; -1 beyond the outermost centres
    double share[2];    ///< of the two segments, together 1
    double point[2][3]; ///< each segment's line at y
    double rate[2][3];  ///< velocity of the material point there
} passage;

/// Each line holds up to the joint between the two; the share goes from one to the other over the
/// middle half of the way, so that nothing jumps when the rope slides along y.
static passage pass(const bt_cable_model* model, const bt_cable_state* s, double y, int hint) {
    passage p = {.segment = bracket(model, s, y, hint)};
    if (p.segment < 0)
        return p;
    for (int k = 0; k < 2; ++k) {
        const int i = p.segment + k;
        const double t[3] = {s->tx[i], s->ty[i], s->tz[i]};
        const double w[3] = {s->wx[i], s->wy[i], s->wz[i]};
        const double far = (y - s->y[i]) / (t[1] > 0.1 ? t[1] : 0.1);
        const double arm[3] = {far * t[0], far * t[1], far * t[2]};
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

/// One-sided spring and damper under the cable where it passes each support.
void bt_cable_supports(const bt_cable_model* model, bt_cable_state* s) {
    const bt_cable_def* d = &model->def;
    struct bt_cable_scalars* scalars = s->scalars;
    for (int k = 0; k < d->support_y_m.count; ++k)
        for (int side = 0; side < 2 && scalars->support_at[k] >= 0; ++side)
            s->support_fz[scalars->support_at[k] + side] =
                s->support_mx[scalars->support_at[k] + side] = 0;
    for (int k = 0; k < d->support_y_m.count; ++k) {
        const passage p = pass(model, s, d->support_y_m.value[k], scalars->support_at[k]);
        scalars->support_at[k] = p.segment;
        scalars->support_force_N[k] = 0;
        if (p.segment < 0)
            continue;
        const double height = p.share[0] * p.point[0][2] + p.share[1] * p.point[1][2];
        const double rate = p.share[0] * p.rate[0][2] + p.share[1] * p.rate[1][2];
        const double depth = d->support.height_m + model->radius_m - height;
        const double force = d->support.stiffness_Npm * depth - d->support.damping_Npmps * rate;
        if (!(depth > 0 && force > 0))
            continue;
        scalars->support_force_N[k] = force;
        for (int side = 0; side < 2; ++side) {
            const int i = p.segment + side;
            s->support_fz[i] += p.share[side] * force;
            s->support_mx[i] += p.share[side] * force * (p.point[side][1] - s->y[i]);
        }
    }
}

/* ---- step ---- */

void bt_cable_step(const bt_cable_model* model, bt_cable_state* state, double step_s) {
    const double kick = 0.5 * (state->scalars->last_step_s + step_s);
    model->kernel.joints(model, state);
    bt_cable_ends(model, state);
    bt_cable_supports(model, state);
    model->kernel.advance(model, state, kick, step_s);
    state->scalars->last_step_s = step_s;
    state->scalars->time_s += step_s;
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

bool bt_cable_is_finite(const bt_cable_model* model, const bt_cable_state* s) {
    double sum = 0;
    for (int i = 0; i < model->count; ++i)
        sum += 0 * (s->x[i] + s->y[i] + s->z[i] + s->vx[i] + s->vy[i] + s->vz[i] + s->wx[i] +
                    s->wy[i] + s->wz[i]);
    return sum == 0;
}

/* ---- questions ---- */

int bt_cable_segment_at(const bt_cable_model* model, const bt_cable_state* s, double y_m,
                        int hint) {
    int i = bracket(model, s, y_m, hint);
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
    const passage p = pass(model, s, y_m, hint);
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

/* ---- audit ---- */

static double spring_energy(double stiffness, double length, double push) {
    return 0.5 * stiffness * (length > 0 ? 1 : push) * length * length;
}

/// Elastic energy of joint j (0 and count: held ends).
static double joint_energy(const bt_cable_model* model, const bt_cable_state* s, int j) {
    const bt_cable_def* d = &model->def;
    const int i = j - 1;
    const double t[3] = {s->tx[i] + s->tx[j], s->ty[i] + s->ty[j], s->tz[i] + s->tz[j]};
    const double li = model->half_m[i], lj = model->half_m[j], size = bt_norm(t);
    const double gap[3] = {
        (s->x[j] - lj * s->tx[j]) - (s->x[i] + li * s->tx[i]),
        (s->y[j] - lj * s->ty[j]) - (s->y[i] + li * s->ty[i]),
        (s->z[j] - lj * s->tz[j]) - (s->z[i] + li * s->tz[i]),
    };
    const double ei[4] = {s->e0[i], -s->e1[i], -s->e2[i], -s->e3[i]};
    const double ej[4] = {s->e0[j], s->e1[j], s->e2[j], s->e3[j]};
    double c[4];
    bt_euler_multiply(ej, ei, c);
    const double sine = bt_norm(c + 1), twice = sine > 1e-9 ? 2 * atan2(sine, c[0]) / sine : 2;
    const double angle2 = twice * twice * sine * sine, twist = twice * bt_dot(c + 1, t) / size;
    const double along = bt_dot(gap, t) / size, gap2 = bt_dot(gap, gap);
    return model->inverse_spacing[j] *
           (spring_energy(d->axial_stiffness_N, along, d->compression_ratio) +
            0.5 * d->shear_ratio * d->axial_stiffness_N * (gap2 - along * along) +
            0.5 * d->bending_stiffness_Nm2 * (angle2 - twist * twist) +
            0.5 * d->twist_stiffness_Nm2 * twist * twist);
}

static double end_energy(const bt_cable_model* model, const bt_cable_state* s, int side) {
    const bt_cable_def* d = &model->def;
    const bt_cable_end* end = &d->end[side];
    if (end->kind == BT_CABLE_FREE)
        return 0;
    const end_point p = end_point_of(model, s, side);
    const double per = 1 / model->half_m[p.segment], ks = d->shear_ratio * d->axial_stiffness_N;
    if (end->kind == BT_CABLE_SHEAVE) {
        const double out = p.sign * p.gap[1], k = end->purchase_stiffness_Npm;
        const double slack = k > 0 ? end->pretension_N / k : INFINITY; /* where it stops pulling */
        const double q = fmin(out, slack);
        return 0.5 * per * ks * (p.gap[0] * p.gap[0] + p.gap[2] * p.gap[2]) -
               end->pretension_N * q + 0.5 * k * q * q;
    }
    const double along = -p.sign * bt_dot(p.gap, p.axis), gap2 = bt_dot(p.gap, p.gap);
    double energy = per * (spring_energy(d->axial_stiffness_N, along, d->compression_ratio) +
                           0.5 * ks * (gap2 - along * along));
    if (end->kind == BT_CABLE_CLAMPED) {
        const int i = p.segment;
        const double e[4] = {s->e0[i], s->e1[i], s->e2[i], s->e3[i]};
        const double* w = s->scalars->anchor_e[side];
        const double back[4] = {w[0], -w[1], -w[2], -w[3]};
        double c[4];
        bt_euler_multiply(e, back, c);
        const double sine = bt_norm(c + 1), twice = sine > 1e-9 ? 2 * atan2(sine, c[0]) / sine : 2;
        const double twist = twice * bt_dot(c + 1, p.axis);
        energy += 0.5 * per *
                  (d->bending_stiffness_Nm2 * (twice * twice * sine * sine - twist * twist) +
                   d->twist_stiffness_Nm2 * twist * twist);
    }
    return energy;
}

static double contact_energy(const bt_cable_model* model, const bt_cable_state* s) {
    const bt_cable_def* d = &model->def;
    double energy = 0;
    for (int i = 0; i < model->count; ++i) { /* at the kernel's two points of each segment */
        const double rise = 0.57735026918962576 * model->half_m[i] * s->tz[i];
        const double before = fmax(0, model->radius_m - s->z[i] + rise);
        const double after = fmax(0, model->radius_m - s->z[i] - rise);
        energy += 0.5 * model->half_m[i] * d->deck_contact.stiffness_Npm2 *
                  (before * before + after * after);
    }
    for (int k = 0; k < d->support_y_m.count; ++k) {
        const double y = d->support_y_m.value[k];
        double at[3];
        if (bt_cable_centreline(model, s, y, s->scalars->support_at[k], at, NULL, NULL) < 0)
            continue;
        const double depth = fmax(0, d->support.height_m + model->radius_m - at[2]);
        energy += 0.5 * d->support.stiffness_Npm * depth * depth;
    }
    return energy;
}

void bt_cable_audit(const bt_cable_model* model, bt_cable_state* s, bt_cable_energy* energy) {
    *energy = (bt_cable_energy){0};
    model->kernel.joints(model, s);
    bt_cable_ends(model, s);
    bt_cable_supports(model, s);
    model->kernel.resultants(model, s);
    const double half = 0.5 * s->scalars->last_step_s;
    for (int i = 0; i < model->count; ++i) {
        const double m = model->mass_kg[i], kick = half * model->inverse_mass[i];
        const double r[3] = {s->x[i], s->y[i], s->z[i]}, t[3] = {s->tx[i], s->ty[i], s->tz[i]};
        const double v[3] = {s->vx[i] + kick * s->net[0][i], s->vy[i] + kick * s->net[1][i],
                             s->vz[i] + kick * s->net[2][i]};
        const double h[3] = {s->hx[i] + half * s->net[3][i], s->hy[i] + half * s->net[4][i],
                             s->hz[i] + half * s->net[5][i]};
        const double ht = bt_dot(h, t);
        double orbital[3];
        bt_cross(r, v, orbital);
        energy->kinetic_J += 0.5 * (m * bt_dot(v, v) + model->inverse_tilt[i] * bt_dot(h, h) +
                                    model->inverse_spin[i] * ht * ht);
        energy->gravity_J += m * model->def.gravity_mps2 * r[2];
        for (int k = 0; k < 3; ++k) {
            energy->momentum_kgmps[k] += m * v[k];
            energy->angular_momentum_Nms[k] += m * orbital[k] + h[k];
        }
    }
    for (int j = 1; j < model->count; ++j)
        energy->elastic_J += joint_energy(model, s, j);
    for (int side = 0; side < 2; ++side)
        energy->elastic_J += end_energy(model, s, side);
    energy->elastic_J += contact_energy(model, s);
}
