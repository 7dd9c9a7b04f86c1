/// Energy and momentum of the cable.
#include "cable/cable_parts.h"

#include "mechanics/vec.h"

#include <math.h>

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
    const bt_cable_end_point p = bt_cable_end_point_of(model, s, side);
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
    bt_cable_balance(model, s);
    const bool turns = bt_frame_turns(&s->scalars->frame);
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
        energy->gravity_J -= m * bt_dot(s->scalars->frame.gravity_mps2, r);
        energy->gravity_J += turns ? bt_cable_centrifugal(model, s, i) : 0;
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
