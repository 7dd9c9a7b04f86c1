#include "mechanics/dynamics.h"
#include "mechanics/vec.h"

#include <string.h>

double bt_residual(const bt_system* system, const double* q, const double* rotation, double* phi,
                   int* worst) {
    double largest = 0;
    if (worst)
        *worst = system->joint_count ? 0 : -1;
    for (int j = 0; j < system->joint_count; ++j) {
        const bt_joint* joint = &system->joints[j];
        bt_joint_residual(joint, q, rotation, phi + joint->row);
        for (int r = joint->row; r < joint->row + joint->row_count; ++r) {
            const double size =
                isfinite(phi[r]) ? fabs(phi[r]) / joint->row_scale[r - joint->row] : INFINITY;
            if (size > largest) {
                largest = size;
                if (worst)
                    *worst = j;
            }
        }
    }
    return largest;
}

double bt_rounding(const bt_system* system, const double* q) {
    double far = 0;
    for (int b = 0; b < system->body_count; ++b)
        for (int i = 0; i < 3; ++i)
            far = fmax(far, fabs(q[7 * b + i]));
    return fmin(1e-12, 1e-15 + 4.5e-16 * far / system->smallest_scale);
}

void bt_move(double q[7], const double step[6]) {
    double turn[4], e[4];
    bt_add_scaled(q, 1, step);
    bt_euler_from_vector(step + 3, turn);
    bt_euler_multiply(q + 3, turn, e);
    bt_euler_normalise(e);
    memcpy(q + 3, e, sizeof e);
}

/// One Newton step from the residual in work->phi with the present factor.
static void newton_step(const bt_system* system, bt_state* state, double turn_limit_rad) {
    bt_work* work = bt_work_of(state);
    const int top = 6 * system->body_count;
    memset(work->x, 0, sizeof(double) * (size_t)top);
    for (int r = 0; r < system->constraint_count; ++r)
        work->x[top + r] = -work->phi[r];
    bt_solve(system, state);
    double turn = 0;
    for (int b = 0; b < system->body_count; ++b)
        turn = fmax(turn, bt_norm(work->x + 6 * b + 3));
    const double share = turn > turn_limit_rad ? turn_limit_rad / turn : 1;
    for (int b = 0; b < system->body_count; ++b) {
        double step[6];
        for (int i = 0; i < 6; ++i)
            step[i] = share * work->x[6 * b + i];
        bt_move(state->q + 7 * b, step);
    }
    bt_rotations(system, state->q, state->rotation);
}

double bt_close_positions(const bt_system* system, bt_state* state, int iterations,
                          double turn_limit_rad, int* worst, bt_failure* failure) {
    bt_work* work = bt_work_of(state);
    bt_rotations(system, state->q, state->rotation);
    const double rounding = bt_rounding(system, state->q);
    double residual = bt_residual(system, state->q, state->rotation, work->phi, worst);
    for (int i = 0; i < iterations && residual > rounding; ++i) {
        if (!bt_factorise(system, state, failure))
            return INFINITY;
        newton_step(system, state, turn_limit_rad);
        const double before = residual;
        residual = bt_residual(system, state->q, state->rotation, work->phi, worst);
        if (!isfinite(residual) || (residual < BT_CLOSED_ENOUGH && residual > 0.25 * before))
            break;
    }
    return residual;
}

void bt_rate_scales(const bt_system* system, const double* v, int j, double* length,
                    double* angle) {
    const bt_joint* joint = &system->joints[j];
    const int ends[2] = {joint->body_a, joint->body_b};
    double speed = 0, turn = 1e-3;
    for (int s = 0; s < 2; ++s)
        for (int k = 0; ends[s] >= 0 && k < 3; ++k) {
            speed = fmax(speed, fabs(v[6 * ends[s] + k]));
            turn = fmax(turn, fabs(v[6 * ends[s] + 3 + k]));
        }
    *length = fmax(speed, turn * joint->row_scale[0]);
    *angle = turn;
}

/// Whether G v, in work->x behind the bodies, is more than rounding of its terms.
static bool velocities_open(const bt_system* system, const bt_state* state) {
    const double* rate = bt_work_of(state)->x + 6 * system->body_count;
    for (int j = 0; j < system->joint_count; ++j) {
        const bt_joint* joint = &system->joints[j];
        const int lengths = bt_joint_length_rows(joint->kind);
        double length, angle;
        bt_rate_scales(system, state->v, j, &length, &angle);
        for (int r = 0; r < joint->row_count; ++r)
            if (!(fabs(rate[joint->row + r]) <= BT_CLOSED * (r < lengths ? length : angle)))
                return true;
    }
    return false;
}

void bt_close_velocities(const bt_system* system, bt_state* state) {
    bt_work* work = bt_work_of(state);
    const int top = 6 * system->body_count;
    for (int i = 0; i < 3; ++i) {
        bt_constraint_rates(system, work, state->v, work->x + top);
        if (!velocities_open(system, state))
            return;
        memset(work->x, 0, sizeof(double) * (size_t)top);
        for (int r = top; r < system->kkt.order; ++r)
            work->x[r] = -work->x[r];
        bt_solve(system, state);
        for (int k = 0; k < top; ++k)
            state->v[k] += work->x[k];
    }
}

bt_status bt_system_project(const bt_system* system, bt_state* state, bt_failure* failure) {
    bt_work* work = bt_work_of(state);
    for (int b = 0; b < system->body_count; ++b)
        bt_euler_normalise(state->q + 7 * b + 3);
    int worst;
    const double residual = bt_close_positions(system, state, 50, 0.5, &worst, failure);
    work->evaluated = false;
    if (!(residual <= BT_CLOSED_ENOUGH)) {
        if (isfinite(residual) || worst >= 0)
            bt_fail(failure, worst >= 0 ? system->joints[worst].name : "", "position constraint",
                    state->time_s);
        return BT_ERR_NUMERIC;
    }
    if (!bt_factorise(system, state, failure))
        return BT_ERR_NUMERIC;
    bt_close_velocities(system, state);
    return BT_OK;
}
