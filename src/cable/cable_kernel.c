#include "cable/cable_kernel.h"

#include "cable/deck.h"

#include <math.h>

#define PASTE_(a, b) a##_##b
#define PASTE(a, b) PASTE_(a, b)
#define LEVEL(name) PASTE(name, BT_KERNEL_LEVEL)

/// Force on the segment before each joint and torques on both [Peng2023 Eqs. 12-17], and shear.
/// Force and torque act at the middle of the gap, so linear and angular momentum are kept exactly.
void LEVEL(bt_cable_joints)(const bt_cable_model* model, bt_cable_state* state) {
    const bt_cable_def* def = &model->def;
    const double ka = def->axial_stiffness_N, ca = def->axial_damping_Ns;
    const double ks = def->shear_ratio * ka, cs = def->shear_ratio * ca;
    const double kb = def->bending_stiffness_Nm2, cb = def->bending_damping_Nm2s;
    const double kt = def->twist_stiffness_Nm2 - kb, ct = def->twist_damping_Nm2s - cb;
    const double push = def->compression_ratio;
    const double* restrict half = model->half_m;
    const double* restrict per_spacing = model->inverse_spacing;
    const double* restrict x = state->x, * restrict y = state->y, * restrict z = state->z;
    const double *restrict e0 = state->e0, *restrict e1 = state->e1, *restrict e2 = state->e2,
                 *restrict e3 = state->e3;
    const double* restrict vx = state->vx, * restrict vy = state->vy, * restrict vz = state->vz;
    const double* restrict wx = state->wx, * restrict wy = state->wy, * restrict wz = state->wz;
    const double* restrict tx = state->tx, * restrict ty = state->ty, * restrict tz = state->tz;
    double* restrict fx = state->joint_fx, * restrict fy = state->joint_fy, * restrict fz = state->joint_fz;
    double* restrict bx = state->before_x, * restrict by = state->before_y, * restrict bz = state->before_z;
    double* restrict ax = state->after_x, * restrict ay = state->after_y, * restrict az = state->after_z;
    const int last = model->padded;
#pragma GCC ivdep
    for (int j = 1; j <= last; ++j) {
        const int i = j - 1;
        /* half segments from the centres to the joint, and the gap between their ends */
        const double ix = half[i] * tx[i], iy = half[i] * ty[i], iz = half[i] * tz[i];
        const double jx = half[j] * tx[j], jy = half[j] * ty[j], jz = half[j] * tz[j];
        const double dx = (x[j] - jx) - (x[i] + ix);
        const double dy = (y[j] - jy) - (y[i] + iy);
        const double dz = (z[j] - jz) - (z[i] + iz);
        /* arms from the centres to the middle of the gap (the second one reversed) */
        const double rx = ix + 0.5 * dx, ry = iy + 0.5 * dy, rz = iz + 0.5 * dz;
        const double qx = jx + 0.5 * dx, qy = jy + 0.5 * dy, qz = jz + 0.5 * dz;
        /* relative velocity there */
        const double ux = (vx[j] - vx[i]) - ((wy[i] * rz - wz[i] * ry) + (wy[j] * qz - wz[j] * qy));
        const double uy = (vy[j] - vy[i]) - ((wz[i] * rx - wx[i] * rz) + (wz[j] * qx - wx[j] * qz));
        const double uz = (vz[j] - vz[i]) - ((wx[i] * ry - wy[i] * rx) + (wx[j] * qy - wy[j] * qx));
        /* common axis: s / |s| */
        const double sx = tx[i] + tx[j], sy = ty[i] + ty[j], sz = tz[i] + tz[j];
        const double per_ss = 1 / (sx * sx + sy * sy + sz * sz);
        const double ds = (dx * sx + dy * sy + dz * sz) * per_ss;
        const double us = (ux * sx + uy * sy + uz * sz) * per_ss;
        /* axial spring and damper [Peng2023 Eqs. 12, 13] and shear, K0 / l and C0 / l */
        const double side = ds > 0 ? 1 : push;
        const double along = side * (ka * ds + ca * us) - (ks * ds + cs * us);
        const double per = per_spacing[j];
        const double gx = per * (along * sx + (ks * dx + cs * ux));
        const double gy = per * (along * sy + (ks * dy + cs * uy));
        const double gz = per * (along * sz + (ks * dz + cs * uz));
        /* relative rotation vector: 2 asin |c| / |c| c, c the vector part of e_j conj(e_i) */
        const double cx = (e0[i] * e1[j] - e0[j] * e1[i]) + (e2[i] * e3[j] - e3[i] * e2[j]);
        const double cy = (e0[i] * e2[j] - e0[j] * e2[i]) + (e3[i] * e1[j] - e1[i] * e3[j]);
        const double cz = (e0[i] * e3[j] - e0[j] * e3[i]) + (e1[i] * e2[j] - e2[i] * e1[j]);
        const double cc = cx * cx + cy * cy + cz * cz;
        const double twice =
            2 + cc * (1.0 / 3 + cc * (3.0 / 20 + cc * (5.0 / 56 + cc * (35.0 / 576))));
        const double ox = wx[j] - wx[i], oy = wy[j] - wy[i], oz = wz[j] - wz[i];
        const double cs_ = (cx * sx + cy * sy + cz * sz) * per_ss * twice;
        const double os = (ox * sx + oy * sy + oz * sz) * per_ss;
        /* bending [Peng2023 Eqs. 14, 15] and twist [Peng2023 Eqs. 16, 17] springs and dampers */
        const double turn = kt * cs_ + ct * os;
        const double bend = kb * twice;
        const double mx = per * (turn * sx + (bend * cx + cb * ox));
        const double my = per * (turn * sy + (bend * cy + cb * oy));
        const double mz = per * (turn * sz + (bend * cz + cb * oz));
        fx[j] = gx;
        fy[j] = gy;
        fz[j] = gz;
        bx[j] = (ry * gz - rz * gy) + mx;
        by[j] = (rz * gx - rx * gz) + my;
        bz[j] = (rx * gy - ry * gx) + mz;
        ax[j] = (qy * gz - qz * gy) - mx;
        ay[j] = (qz * gx - qx * gz) - my;
        az[j] = (qx * gy - qy * gx) - mz;
    }
}

/// Resultant force and torque of every segment at zero friction time: for equilibrium and audit.
void LEVEL(bt_cable_resultants)(const bt_cable_model* model, bt_cable_state* state) {
    const bt_cable_state* s = state;
    const deck_law law = deck_law_of(model);
    const double gravity = -state->scalars->frame.gravity_mps2[2];
    for (int i = 0; i < model->padded; ++i) {
        const int j = i + 1;
        const double tilt_rate = s->wx[i] * s->ty[i] - s->wy[i] * s->tx[i];
        const deck_push deck =
            deck_under(law, model->half_m[i], s->z[i], s->tz[i], s->vz[i], tilt_rate);
        const double normal = deck.normal;
        const double sx = s->vx[i] - s->wy[i] * law.radius;
        const double sy = s->vy[i] + s->wx[i] * law.radius;
        const double drag = law.friction * normal / sqrt(sx * sx + sy * sy + law.slip2);
        s->net[0][i] = (s->joint_fx[j] - s->joint_fx[i]) + (s->fx[i] - drag * sx);
        s->net[1][i] = (s->joint_fy[j] - s->joint_fy[i]) + (s->fy[i] - drag * sy);
        s->net[2][i] = (s->joint_fz[j] - s->joint_fz[i]) +
                       ((s->fz[i] + s->support_fz[i]) + (normal - gravity * model->mass_kg[i]));
        s->net[3][i] =
            (s->before_x[j] + s->after_x[i]) +
            ((s->mx[i] + s->support_mx[i]) + (deck.moment * s->ty[i] - law.radius * (drag * sy)));
        s->net[4][i] = (s->before_y[j] + s->after_y[i]) +
                       (s->my[i] + (law.radius * (drag * sx) - deck.moment * s->tx[i]));
        s->net[5][i] = (s->before_z[j] + s->after_z[i]) + s->mz[i];
    }
}

/// Leapfrog: velocities and angular momenta by kick_s, then positions and Euler parameters by
/// drift_s. The deck's friction is taken implicitly in the slip speed, so that it cannot reverse
/// it.
void LEVEL(bt_cable_advance)(const bt_cable_model* model, bt_cable_state* state, double kick_s,
                             double drift_s) {
    const deck_law law = deck_law_of(model);
    const double gravity = -state->scalars->frame.gravity_mps2[2], half_drift = 0.5 * drift_s;
    const double* restrict half = model->half_m, * restrict mass = model->mass_kg;
    const double* restrict per_mass = model->inverse_mass, * restrict per_tilt =
                                                               model->inverse_tilt;
    const double* restrict per_spin = model->inverse_spin;
    const double* restrict per_slide = model->inverse_slide;
    double* restrict x = state->x, * restrict y = state->y, * restrict z = state->z;
    double *restrict e0 = state->e0, *restrict e1 = state->e1, *restrict e2 = state->e2,
           *restrict e3 = state->e3;
    double* restrict vx = state->vx, * restrict vy = state->vy, * restrict vz = state->vz;
    double* restrict hx = state->hx, * restrict hy = state->hy, * restrict hz = state->hz;
    double* restrict wx = state->wx, * restrict wy = state->wy, * restrict wz = state->wz;
    double* restrict tx = state->tx, * restrict ty = state->ty, * restrict tz = state->tz;
    const double* restrict fx = state->fx, * restrict fy = state->fy, * restrict fz = state->fz;
    const double* restrict mx = state->mx, * restrict my = state->my, * restrict mz = state->mz;
    const double *restrict gx = state->joint_fx, *restrict gy = state->joint_fy,
                 *restrict gz = state->joint_fz;
    const double *restrict bx = state->before_x, *restrict by = state->before_y,
                 *restrict bz = state->before_z;
    const double *restrict ax = state->after_x, *restrict ay = state->after_y,
                 *restrict az = state->after_z;
    const double* restrict support = state->support_fz, * restrict support_turn = state->support_mx;
    const int count = model->padded;
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
        const int j = i + 1;
        /* deck */
        const double tilt_rate = wx[i] * ty[i] - wy[i] * tx[i];
        const deck_push deck = deck_under(law, half[i], z[i], tz[i], vz[i], tilt_rate);
        const double normal = deck.normal;
        const double sx = vx[i] - wy[i] * law.radius, sy = vy[i] + wx[i] * law.radius;
        const double drag = deck_drag(law, normal, sx, sy, kick_s * per_slide[i]);
        const double dragx = drag * sx, dragy = drag * sy;
        /* resultants */
        const double netx = (gx[j] - gx[i]) + (fx[i] - dragx);
        const double nety = (gy[j] - gy[i]) + (fy[i] - dragy);
        const double netz = (gz[j] - gz[i]) + ((fz[i] + support[i]) + (normal - gravity * mass[i]));
        const double torx = (bx[j] + ax[i]) + ((mx[i] + support_turn[i]) +
                                               (deck.moment * ty[i] - law.radius * dragy));
        const double tory = (by[j] + ay[i]) + (my[i] + (law.radius * dragx - deck.moment * tx[i]));
        const double torz = (bz[j] + az[i]) + mz[i];
        /* velocities */
        const double kick = kick_s * per_mass[i];
        const double nvx = vx[i] + kick * netx, nvy = vy[i] + kick * nety;
        const double nvz = vz[i] + kick * netz;
        const double nhx = hx[i] + kick_s * torx, nhy = hy[i] + kick_s * tory;
        const double nhz = hz[i] + kick_s * torz;
        /* angular velocity with the axis half a step ahead */
        const double a = per_tilt[i], half_turn = half_drift * a;
        const double px = tx[i] + half_turn * (nhy * tz[i] - nhz * ty[i]);
        const double py = ty[i] + half_turn * (nhz * tx[i] - nhx * tz[i]);
        const double pz = tz[i] + half_turn * (nhx * ty[i] - nhy * tx[i]);
        const double spin = per_spin[i] * (nhx * px + nhy * py + nhz * pz);
        const double ox = a * nhx + spin * px, oy = a * nhy + spin * py, oz = a * nhz + spin * pz;
        /* Euler parameters: (1, w dt / 2) e, brought back to unit length */
        const double qx = half_drift * ox, qy = half_drift * oy, qz = half_drift * oz;
        const double a0 = e0[i], a1 = e1[i], a2 = e2[i], a3 = e3[i];
        const double b0 = a0 - (qx * a1 + qy * a2 + qz * a3);
        const double b1 = a1 + (qx * a0 + (qy * a3 - qz * a2));
        const double b2 = a2 + (qy * a0 + (qz * a1 - qx * a3));
        const double b3 = a3 + (qz * a0 + (qx * a2 - qy * a1));
        const double excess = (b0 * b0 + b2 * b2) + (b1 * b1 + b3 * b3) - 1;
        const double scale = 1 + excess * (0.375 * excess - 0.5);
        const double n0 = scale * b0, n1 = scale * b1, n2 = scale * b2, n3 = scale * b3;
        x[i] += drift_s * nvx;
        y[i] += drift_s * nvy;
        z[i] += drift_s * nvz;
        vx[i] = nvx;
        vy[i] = nvy;
        vz[i] = nvz;
        hx[i] = nhx;
        hy[i] = nhy;
        hz[i] = nhz;
        wx[i] = ox;
        wy[i] = oy;
        wz[i] = oz;
        e0[i] = n0;
        e1[i] = n1;
        e2[i] = n2;
        e3[i] = n3;
        tx[i] = 2 * (n1 * n2 - n0 * n3);
        ty[i] = 1 - 2 * (n1 * n1 + n3 * n3);
        tz[i] = 2 * (n2 * n3 + n0 * n1);
    }
}
