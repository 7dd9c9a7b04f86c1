#include "mechanics/dynamics.h"
#include "mechanics/vec.h"

#include <string.h>

/* ------------------------------------------------------------------ second order */

#define ROUNDING 2e-16

/// Half of the step's impulse from the accelerations at its start: force and torque (constraint
/// forces included), both in the world, times h/2.
static void first_kick(const bt_system* system, const bt_state* state, double half_h) {
    const bt_work* work = bt_work_of(state);
    for (int b = 0; b < system->body_count; ++b) {
        const bt_body* body = &system->bodies[b];
        const double *a = state->a + 6 * b, *new = state->applied + 6 * b;
        const double* old = work->used + 6 * b;
        double torque[3], turn[3], kick[3];
        bt_gyroscopic(body, state->v + 6 * b + 3, torque);
        bt_rotate(body->inertia, a + 3, turn);
        for (int i = 0; i < 3; ++i) {
            torque[i] = half_h * (torque[i] + turn[i] + new[3 + i] - old[3 + i]);
            work->kick[6 * b + i] = half_h * (body->mass_kg * a[i] + new[i] - old[i]);
        }
        bt_rotate(state->rotation + 9 * b, torque, kick);
        memcpy(work->kick + 6 * b + 3, kick, sizeof kick);
    }
}

/// Rotation vector of a free turn over h with the angular momentum pi (body frame, at its start):
/// the implicit midpoint rule on the rotation group, J theta / h = exp(-theta/2) pi.
static void free_turn(const bt_body* body, const double pi[3], double h, double theta[3]) {
    double omega[3];
    bt_rotate(body->inverse_inertia, pi, omega);
    for (int i = 0; i < 3; ++i)
        theta[i] = h * omega[i];
    for (int sweep = 0; sweep < 30; ++sweep) {
        const double half[3] = {-0.5 * theta[0], -0.5 * theta[1], -0.5 * theta[2]};
        double turn[4], mid[3], cross[3], cross2[3];
        bt_euler_from_vector(half, turn);
        bt_cross(turn + 1, pi, cross); // exp(-theta/2) pi = pi + 2 w (n x pi) + 2 n x (n x pi)
        bt_cross(turn + 1, cross, cross2);
        for (int i = 0; i < 3; ++i)
            mid[i] = pi[i] + 2 * (turn[0] * cross[i] + cross2[i]);
        bt_rotate(body->inverse_inertia, mid, omega);
        double change = 0, size = 0;
        for (int i = 0; i < 3; ++i) {
            const double next = h * omega[i];
            change = fmax(change, fabs(next - theta[i]));
            size = fmax(size, fabs(next));
            theta[i] = next;
        }
        if (!(change > 1e-15 * size))
            return;
    }
}

/// Moves body b over h from its start with the momenta of the middle of the step.
static void drift(const bt_system* system, bt_state* state, int b, double h) {
    bt_work* work = bt_work_of(state);
    const bt_body* body = &system->bodies[b];
    const double *v = state->v + 6 * b, *kick = work->kick + 6 * b;
    double pi[3], local[3], step[6];
    bt_rotate(body->inertia, v + 3, pi);
    bt_unrotate(work->rotation_old + 9 * b, kick + 3, local);
    bt_add_scaled(pi, 1, local);
    for (int i = 0; i < 3; ++i)
        step[i] = h * (v[i] + body->inverse_mass * kick[i]);
    free_turn(body, pi, h, step + 3);
    work->turn[b] = bt_norm(step + 3);
    memcpy(state->q + 7 * b, work->q_old + 7 * b, 7 * sizeof(double));
    bt_move(state->q + 7 * b, step);
}

/// Adds to the kick of body b the impulse that changes its velocity by dv at the start of the step.
static void add_impulse(const bt_body* body, const bt_work* work, int b, const double dv[6]) {
    double local[3], impulse[3];
    bt_rotate(body->inertia, dv + 3, local);
    bt_rotate(work->rotation_old + 9 * b, local, impulse);
    bt_add_scaled(work->kick + 6 * b, body->mass_kg, dv);
    bt_add_scaled(work->kick + 6 * b + 3, 1, impulse);
}

/// Moves the end of the step of body b by what the velocity change dv at its start does over h, to
/// first order in dv and in the turn. False, and nothing done, when that is not exact to rounding.
static bool nudge(bt_state* state, int b, const double dv[6], double h) {
    const bt_work* work = bt_work_of(state);
    if (work->turn[b] * h * bt_norm(dv + 3) > ROUNDING)
        return false;
    double world[3], local[3], step[6];
    bt_rotate(work->rotation_old + 9 * b, dv + 3, world);
    bt_unrotate(state->rotation + 9 * b, world, local);
    for (int i = 0; i < 3; ++i) {
        step[i] = h * dv[i];
        step[3 + i] = h * local[i];
    }
    bt_move(state->q + 7 * b, step);
    return true;
}

/// Adds to the kick the constraint impulses that put the end of the step on the constraints. They
/// act along G of its start, whose factor is still the present one.
static bool close_drift(const bt_system* system, bt_state* state, double h, int* worst) {
    bt_work* work = bt_work_of(state);
    const int n = system->body_count;
    const double rounding = bt_rounding(system, state->q);
    double before = INFINITY;
    for (int sweep = 0; sweep < 40; ++sweep) {
        bt_rotations(system, state->q, state->rotation);
        const double residual = bt_residual(system, state->q, state->rotation, work->phi, worst);
        if (residual <= rounding || (residual < BT_CLOSED_ENOUGH && residual > 0.25 * before))
            return true;
        if (!isfinite(residual) || residual > 4 * before)
            return false;
        before = residual;
        memset(work->x, 0, sizeof(double) * 6 * (size_t)n);
        for (int r = 0; r < system->constraint_count; ++r)
            work->x[6 * n + r] = -work->phi[r] / h;
        bt_solve(system, state);
        for (int b = 0; b < n; ++b) {
            add_impulse(&system->bodies[b], work, b, work->x + 6 * b);
            if (!nudge(state, b, work->x + 6 * b, h))
                drift(system, state, b, h);
        }
    }
    return false;
}

/// Momenta after the first kick go to work->x (force part in the world, torque part in the new body
/// frame); velocities for the forces at the end of the step, v + 2 kick / m, to work->v_mean.
static void carry_momenta(const bt_system* system, bt_state* state) {
    bt_work* work = bt_work_of(state);
    for (int b = 0; b < system->body_count; ++b) {
        const bt_body* body = &system->bodies[b];
        const double *v = state->v + 6 * b, *kick = work->kick + 6 * b;
        double spin[3], world[3], local[3];
        bt_rotate(body->inertia, v + 3, spin);
        bt_rotate(work->rotation_old + 9 * b, spin, world);
        bt_add_scaled(world, 1, kick + 3);
        bt_unrotate(state->rotation + 9 * b, world, work->x + 6 * b + 3);
        bt_add_scaled(world, 1, kick + 3);
        bt_unrotate(state->rotation + 9 * b, world, local);
        bt_rotate(body->inverse_inertia, local, work->v_mean + 6 * b + 3);
        for (int i = 0; i < 3; ++i) {
            work->x[6 * b + i] = body->mass_kg * v[i] + kick[i];
            work->v_mean[6 * b + i] = v[i] + 2 * body->inverse_mass * kick[i];
        }
    }
}

static void first_kick_and_drift(const bt_system* system, bt_state* state, double h) {
    first_kick(system, state, 0.5 * h);
    for (int b = 0; b < system->body_count; ++b)
        drift(system, state, b, h);
}

/// One step of the constrained leapfrog: kick, drift onto the constraints, forces, kick onto the
/// constraints' tangent. One force evaluation and one factorisation. Where the constraint
/// directions of the start cannot close the end (very long steps, positions where a mechanism
/// branches) the end is projected along its own.
static bool step_second_order(const bt_system* system, bt_state* state, double h,
                              bt_failure* failure) {
    bt_work* work = bt_work_of(state);
    const size_t n = (size_t)system->body_count;
    const double end_s = state->time_s + h;
    int worst;
    memcpy(work->rotation_old, state->rotation, sizeof(double) * 9 * n);
    memcpy(work->q_old, state->q, sizeof(double) * 7 * n);
    // 1. velocities by half the step with the accelerations at its start, positions by the step
    first_kick_and_drift(system, state, h);
    // 2. the end of the step onto the joints
    if (!close_drift(system, state, h, &worst)) {
        memcpy(state->rotation, work->rotation_old, sizeof(double) * 9 * n);
        first_kick_and_drift(system, state, h);
        if (!(bt_close_positions(system, state, 50, 0.5, &worst, failure) <= BT_CLOSED_ENOUGH))
            return bt_fail(failure, worst >= 0 ? system->joints[worst].name : "body",
                           "position constraint", end_s);
    }
    // 3. forces of all elements at the end of the step
    carry_momenta(system, state);
    state->time_s = end_s;
    if (!bt_forces(system, state, end_s, work->v_mean, failure) ||
        !bt_factorise(system, state, failure))
        return false;
    // 4. velocities by the other half, with joint impulses that keep them on the joints
    for (size_t k = 0; k < 6 * n; ++k)
        work->x[k] += 0.5 * h * work->wrench[k];
    memset(work->x + 6 * n, 0, sizeof(double) * (size_t)system->constraint_count);
    bt_solve(system, state);
    memcpy(state->v, work->x, sizeof(double) * 6 * n);
    bt_close_velocities(system, state);
    // 5. accelerations and multipliers at the end: [M G^T; G 0] [a; -lambda] = [F; gamma]
    //    [Peng2023 Eq. 1]
    return bt_accelerations(system, state, failure);
}

/* ------------------------------------------------------------------ fourth order */

/// Slope at the present q, v: qdot [7 n] and vdot [6 n].
static bool slope(const bt_system* system, bt_state* state, double time_s, double* rate,
                  bt_failure* failure) {
    const int n = system->body_count;
    for (int b = 0; b < n; ++b) { // stage values leave the unit sphere; their rotations do not
        double e[4];
        memcpy(e, state->q + 7 * b + 3, sizeof e);
        bt_euler_normalise(e);
        bt_rotation_from_euler(e, state->rotation + 9 * b);
    }
    if (!bt_factorise(system, state, failure) ||
        !bt_forces(system, state, time_s, state->v, failure) ||
        !bt_accelerations(system, state, failure))
        return false;
    for (int b = 0; b < n; ++b) {
        const double *v = state->v + 6 * b, *e = state->q + 7 * b + 3;
        const double omega[4] = {0, 0.5 * v[3], 0.5 * v[4], 0.5 * v[5]};
        memcpy(rate + 7 * b, v, 3 * sizeof(double));
        bt_euler_multiply(e, omega, rate + 7 * b + 3);
    }
    memcpy(rate + 7 * n, state->a, sizeof(double) * 6 * (size_t)n);
    return true;
}

/// Classical Runge-Kutta on the index-1 form, then projection of positions and velocities.
static bool step_fourth_order(const bt_system* system, bt_state* state, double h,
                              bt_failure* failure) {
    static const double reach[4] = {0, 0.5, 0.5, 1}, weight[4] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
    bt_work* work = bt_work_of(state);
    const size_t nq = 7 * (size_t)system->body_count, nv = 6 * (size_t)system->body_count;
    const double start_s = state->time_s;
    memcpy(work->q_old, state->q, sizeof(double) * nq);
    memcpy(work->v_old, state->v, sizeof(double) * nv);
    for (int s = 0; s < 4; ++s) {
        const double* last = work->stage + (size_t)(s - (s > 0)) * (nq + nv);
        for (size_t k = 0; s && k < nq; ++k)
            state->q[k] = work->q_old[k] + reach[s] * h * last[k];
        for (size_t k = 0; s && k < nv; ++k)
            state->v[k] = work->v_old[k] + reach[s] * h * last[nq + k];
        if (!slope(system, state, start_s + reach[s] * h, work->stage + (size_t)s * (nq + nv),
                   failure))
            return false;
    }
    memcpy(state->q, work->q_old, sizeof(double) * nq);
    memcpy(state->v, work->v_old, sizeof(double) * nv);
    for (int s = 0; s < 4; ++s) {
        const double* rate = work->stage + (size_t)s * (nq + nv);
        for (size_t k = 0; k < nq; ++k)
            state->q[k] += h * weight[s] * rate[k];
        for (size_t k = 0; k < nv; ++k)
            state->v[k] += h * weight[s] * rate[nq + k];
    }
    state->time_s = start_s + h;
    if (bt_system_project(system, state, failure) != BT_OK)
        return false;
    return bt_forces(system, state, state->time_s, state->v, failure) &&
           bt_accelerations(system, state, failure);
}

bt_status bt_system_step(const bt_system* system, bt_state* state, double h_s,
                         bt_integrator integrator, bt_failure* failure) {
    bt_work* work = bt_work_of(state);
    if (!(h_s > 0) || !isfinite(h_s))
        return BT_ERR_ARG;
    if (!work->evaluated)
        BT_TRY(bt_system_evaluate(system, state, failure));
    work->evaluated = integrator == BT_INTEGRATOR_SECOND_ORDER
                          ? step_second_order(system, state, h_s, failure)
                          : step_fourth_order(system, state, h_s, failure);
    if (!work->evaluated)
        return BT_ERR_NUMERIC;
    ++state->steps;
    return BT_OK;
}
