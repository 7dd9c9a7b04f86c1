#include "mechanics/dynamics.h"

#include "mechanics/vec.h"

#include <string.h>

void bt_rotations(const bt_system* system, const double* q, double* rotation) {
    for (int b = 0; b < system->body_count; ++b)
        bt_rotation_from_euler(q + 7 * b + 3, rotation + 9 * b);
}

bool bt_fail(bt_failure* failure, const char* where, const char* quantity, double time_s) {
    if (failure)
        *failure = (bt_failure){where, quantity, time_s};
    return false;
}

bool bt_factorise(const bt_system* system, bt_state* state, bt_failure* failure) {
    bt_work* work = bt_work_of(state);
    for (int j = 0; j < system->joint_count; ++j) {
        const bt_joint* joint = &system->joints[j];
        bt_joint_jacobian(joint, state->q, state->rotation, work->ga + 6 * joint->row,
                          work->gb + 6 * joint->row);
    }
    const int failed = bt_kkt_factor(&system->kkt, work->ga, work->gb, work->factor);
    work->factored = failed < 0;
    if (failed < 0)
        return true;
    return failed < system->body_count
               ? bt_fail(failure, system->bodies[failed].name, "mass matrix", state->time_s)
               : bt_fail(failure, system->joints[failed - system->body_count].name,
                         "singular constraint", state->time_s);
}

void bt_constraint_rates(const bt_system* system, const bt_work* work, const double* v,
                         double* rate) {
    for (int j = 0; j < system->joint_count; ++j) {
        const bt_joint* joint = &system->joints[j];
        for (int r = joint->row; r < joint->row + joint->row_count; ++r) {
            double sum = 0;
            for (int k = 0; joint->body_a >= 0 && k < 6; ++k)
                sum += work->ga[6 * r + k] * v[6 * joint->body_a + k];
            for (int k = 0; joint->body_b >= 0 && k < 6; ++k)
                sum += work->gb[6 * r + k] * v[6 * joint->body_b + k];
            rate[r] = sum;
        }
    }
}

/// y -= G^T z
static void subtract_transposed(const bt_system* system, const bt_work* work, const double* z,
                                double* y) {
    for (int j = 0; j < system->joint_count; ++j) {
        const bt_joint* joint = &system->joints[j];
        for (int r = joint->row; r < joint->row + joint->row_count; ++r) {
            for (int k = 0; joint->body_a >= 0 && k < 6; ++k)
                y[6 * joint->body_a + k] -= work->ga[6 * r + k] * z[r];
            for (int k = 0; joint->body_b >= 0 && k < 6; ++k)
                y[6 * joint->body_b + k] -= work->gb[6 * r + k] * z[r];
        }
    }
}

/// y -= M x
static void subtract_mass(const bt_system* system, const double* x, double* y) {
    for (int b = 0; b < system->body_count; ++b) {
        const bt_body* body = &system->bodies[b];
        const double* in = x + 6 * b;
        double* out = y + 6 * b;
        double turn[3];
        bt_rotate(body->inertia, in + 3, turn);
        bt_add_scaled(out, -body->mass_kg, in);
        bt_add_scaled(out + 3, -1, turn);
    }
}

void bt_solve(const bt_system* system, const bt_state* state) {
    const bt_work* work = bt_work_of(state);
    const bt_kkt* kkt = &system->kkt;
    const int top = 6 * system->body_count;
    if (!system->refinements) {
        bt_kkt_solve(kkt, work->factor, work->x);
        return;
    }
    const size_t bytes = sizeof(double) * (size_t)kkt->order;
    memcpy(work->rhs, work->x, bytes);
    bt_kkt_solve(kkt, work->factor, work->x);
    for (int i = 0; i < system->refinements; ++i) {
        double* r = work->refined;
        bt_constraint_rates(system, work, work->x, r + top);
        for (int k = top; k < kkt->order; ++k)
            r[k] = work->rhs[k] - r[k];
        memcpy(r, work->rhs, sizeof(double) * (size_t)top);
        subtract_mass(system, work->x, r);
        subtract_transposed(system, work, work->x + top, r);
        bt_kkt_solve(kkt, work->factor, r);
        for (int k = 0; k < kkt->order; ++k)
            work->x[k] += r[k];
    }
}

/* ------------------------------------------------------------------ forces */

/// The element whose wrench or output is not finite.
static bool name_bad_element(const bt_system* system, bt_state* state, const bt_motion* motion,
                             bt_failure* failure) {
    double* wrench = bt_work_of(state)->wrench;
    for (int i = 0; i < system->element_count; ++i) {
        const bt_element_slot* slot = &system->elements[i];
        memset(wrench, 0, sizeof(double) * 6 * (size_t)system->body_count);
        slot->element.type->force(&slot->element, motion, wrench,
                                  state->output + slot->output_first);
        for (int k = 0; k < 6 * system->body_count; ++k)
            if (!isfinite(wrench[k]))
                return bt_fail(failure, slot->element.name, "force", motion->time_s);
    }
    return bt_fail(failure, system->body_count ? system->bodies[0].name : "", "force",
                   motion->time_s);
}

/// Gravity, and what a frame that turns does to body b.
static void frame_wrench(const bt_frame* frame, const bt_body* body, bool turns,
                         const bt_motion* motion, int b, double wrench[6]) {
    const double* field = frame->gravity_mps2;
    double turning[3];
    memset(wrench + 3, 0, 3 * sizeof *wrench);
    if (turns) {
        bt_frame_field(frame, motion->q + 7 * b, motion->v + 6 * b, turning);
        bt_frame_torque(frame, motion->rotation + 9 * b, body->inertia, motion->v + 6 * b + 3,
                        wrench + 3);
        field = turning;
    }
    for (int i = 0; i < 3; ++i)
        wrench[i] = body->mass_kg * field[i];
}

bool bt_forces(const bt_system* system, bt_state* state, double time_s, const double* v,
               bt_failure* failure) {
    double* wrench = bt_work_of(state)->wrench;
    const bt_motion motion = {time_s, state->q, v, state->rotation};
    const bool turns = bt_frame_turns(&state->frame);
    for (int b = 0; b < system->body_count; ++b)
        frame_wrench(&state->frame, &system->bodies[b], turns, &motion, b, wrench + 6 * b);
    for (int i = 0; i < system->element_count; ++i) {
        const bt_element_slot* slot = &system->elements[i];
        slot->element.type->force(&slot->element, &motion, wrench,
                                  state->output + slot->output_first);
    }
    double sum = 0; // not finite as soon as one entry is not, or their sizes are absurd
    for (int k = 0; k < 6 * system->body_count; ++k) {
        wrench[k] += state->applied[k];
        sum += wrench[k] * 0;
    }
    return sum == 0 || name_bad_element(system, state, &motion, failure);
}

void bt_gyroscopic(const bt_body* body, const double omega[3], double torque[3]) {
    double spin[3];
    bt_rotate(body->inertia, omega, spin);
    bt_cross(omega, spin, torque);
}

bool bt_accelerations(const bt_system* system, bt_state* state, bt_failure* failure) {
    bt_work* work = bt_work_of(state);
    const int n = system->body_count;
    for (int b = 0; b < n; ++b) {
        double gyroscopic[3];
        bt_gyroscopic(&system->bodies[b], state->v + 6 * b + 3, gyroscopic);
        memcpy(work->x + 6 * b, work->wrench + 6 * b, 6 * sizeof(double));
        bt_add_scaled(work->x + 6 * b + 3, -1, gyroscopic);
    }
    for (int j = 0; j < system->joint_count; ++j)
        bt_joint_gamma(&system->joints[j], state->q, state->rotation, state->v,
                       work->x + 6 * n + system->joints[j].row);
    bt_solve(system, state);
    memcpy(state->a, work->x, sizeof(double) * 6 * (size_t)n);
    for (int r = 0; r < system->constraint_count; ++r)
        state->lambda[r] = -work->x[6 * n + r];
    memcpy(work->used, state->applied, sizeof(double) * 6 * (size_t)n);
    for (int k = 0; k < 6 * n; ++k)
        if (!isfinite(state->a[k]))
            return bt_fail(failure, system->bodies[k / 6].name, "acceleration", state->time_s);
    return true;
}

bt_status bt_system_evaluate(const bt_system* system, bt_state* state, bt_failure* failure) {
    bt_work* work = bt_work_of(state);
    bt_rotations(system, state->q, state->rotation);
    if (!bt_factorise(system, state, failure) ||
        !bt_forces(system, state, state->time_s, state->v, failure) ||
        !bt_accelerations(system, state, failure))
        return BT_ERR_NUMERIC;
    work->evaluated = true;
    return BT_OK;
}
