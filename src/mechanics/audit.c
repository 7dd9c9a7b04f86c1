#include "mechanics/dynamics.h"
#include "mechanics/vec.h"

#include <string.h>

static void add_body(const bt_system* system, const bt_state* state, int b, bt_audit* audit) {
    const bt_body* body = &system->bodies[b];
    const double *q = state->q + 7 * b, *v = state->v + 6 * b;
    double rotation[9], spin[3], world[3], moment[3];
    bt_rotation_from_euler(q + 3, rotation);
    bt_rotate(body->inertia, v + 3, spin);
    bt_rotate(rotation, spin, world);
    bt_cross(q, v, moment);
    audit->kinetic_J += 0.5 * (body->mass_kg * bt_dot(v, v) + bt_dot(v + 3, spin));
    audit->potential_J -= body->mass_kg * bt_dot(state->frame.gravity_mps2, q);
    if (bt_frame_turns(&state->frame))
        audit->potential_J +=
            bt_frame_potential(&state->frame, body->mass_kg, q, rotation, body->inertia);
    bt_add_scaled(audit->momentum_Ns, body->mass_kg, v);
    bt_add_scaled(audit->angular_momentum_Nms, body->mass_kg, moment);
    bt_add_scaled(audit->angular_momentum_Nms, 1, world);
    const double* e = q + 3;
    const double norm = sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3]);
    audit->norm_error = fmax(audit->norm_error, fabs(norm - 1));
}

/// Largest |G v| of a joint over the speeds of its bodies.
static double velocity_error(const bt_system* system, const bt_state* state, int j) {
    const bt_joint* joint = &system->joints[j];
    const int lengths = bt_joint_length_rows(joint->kind);
    double ga[6 * BT_JOINT_ROWS_MAX], gb[6 * BT_JOINT_ROWS_MAX], worst = 0, length, angle;
    bt_joint_jacobian(joint, state->q, state->rotation, ga, gb);
    bt_rate_scales(system, state->v, j, &length, &angle);
    for (int r = 0; r < joint->row_count; ++r) {
        double rate = 0;
        for (int k = 0; k < 6; ++k) {
            rate += joint->body_a < 0 ? 0 : ga[6 * r + k] * state->v[6 * joint->body_a + k];
            rate += joint->body_b < 0 ? 0 : gb[6 * r + k] * state->v[6 * joint->body_b + k];
        }
        worst = fmax(worst, fabs(rate) / (r < lengths ? length : angle));
    }
    return worst;
}

void bt_system_audit(const bt_system* system, const bt_state* state, bt_audit* audit) {
    *audit = (bt_audit){0};
    const bt_work* work = bt_work_of(state);
    const bt_motion motion = {state->time_s, state->q, state->v, state->rotation};
    for (int b = 0; b < system->body_count; ++b)
        add_body(system, state, b, audit);
    for (int i = 0; i < system->element_count; ++i) {
        const bt_element* element = &system->elements[i].element;
        if (element->type->energy)
            audit->potential_J += element->type->energy(element, &motion);
    }
    audit->position_residual = bt_residual(system, state->q, state->rotation, work->phi, NULL);
    for (int j = 0; j < system->joint_count; ++j)
        audit->velocity_residual = fmax(audit->velocity_residual, velocity_error(system, state, j));
}

double bt_system_body_energy(const bt_system* system, const bt_state* state, int body,
                             const double frame_mps[3]) {
    const bt_body* b = &system->bodies[body];
    const double* v = state->v + 6 * body;
    double spin[3], along[3] = {v[0], v[1], v[2]};
    bt_add_scaled(along, -1, frame_mps);
    bt_rotate(b->inertia, v + 3, spin);
    return 0.5 * (b->mass_kg * bt_dot(along, along) + bt_dot(v + 3, spin));
}

double bt_system_element_power(const bt_system* system, const bt_state* state, int element,
                               const double frame_mps[3], double* wrench) {
    enum { OUTPUTS_MAX = 16 };
    const bt_element* e = &system->elements[element].element;
    const bt_motion motion = {state->time_s, state->q, state->v, state->rotation};
    const int ends[2] = {e->body_a, e->body_b};
    double output[OUTPUTS_MAX], power = 0;
    memset(wrench, 0, 6 * (size_t)system->body_count * sizeof *wrench);
    e->type->force(e, &motion, wrench, output);
    for (int end = 0; end < 2; ++end) {
        if (ends[end] == BT_GROUND)
            continue;
        const double *w = wrench + 6 * ends[end], *v = state->v + 6 * ends[end];
        power += bt_dot(w, v) - bt_dot(w, frame_mps) + bt_dot(w + 3, v + 3);
    }
    return power;
}

void bt_system_joint_load(const bt_system* system, const bt_state* state, int joint,
                          double force_N[3], double torque_Nm[3]) {
    const bt_joint* j = &system->joints[joint];
    static const double level[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double* rotation = j->body_b < 0 ? level : state->rotation + 9 * j->body_b;
    double ga[6 * BT_JOINT_ROWS_MAX], gb[6 * BT_JOINT_ROWS_MAX], total[6] = {0};
    bt_joint_jacobian(j, state->q, state->rotation, ga, gb);
    for (int r = 0; r < j->row_count; ++r)
        for (int k = 0; k < 6; ++k)
            total[k] += state->lambda[j->row + r] * gb[6 * r + k];
    double arm[3], moment[3];
    bt_rotate(rotation, j->point_b, arm);
    bt_rotate(rotation, total + 3, torque_Nm); // about the centre of mass (ground: the origin)
    bt_cross(arm, total, moment);
    memcpy(force_N, total, 3 * sizeof(double));
    bt_add_scaled(torque_Nm, -1, moment);
}
