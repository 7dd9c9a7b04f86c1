/// What holds the ends of the rope: pins, clamps, sheaves with the purchase cable behind them.
#include "cable/cable_parts.h"

#include "mechanics/vec.h"

bt_cable_end_point bt_cable_end_point_of(const bt_cable_model* model, const bt_cable_state* s,
                                         int side) {
    const int i = side ? model->count - 1 : 0;
    const double sign = side ? 1 : -1, h = sign * model->half_m[i];
    bt_cable_end_point p = {.segment = i,
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
static void put_end(bt_cable_state* s, const bt_cable_end_point* p, const double force[3],
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
    const bt_cable_end_point p = bt_cable_end_point_of(model, s, side);
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
    const bt_cable_end_point p = bt_cable_end_point_of(model, s, side);
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
        const bt_cable_end_point at = {.joint = side ? model->count : 0, .sign = side ? 1 : -1};
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
