/// Inside of a bt_system and of a state's scratch memory; for the files of this folder only.
#ifndef BT_MECHANICS_MODEL_H
#define BT_MECHANICS_MODEL_H

#include "mechanics/joint.h"
#include "mechanics/kkt.h"
#include "mechanics/system.h"

typedef struct bt_body {
    char* name;
    double mass_kg, inverse_mass;
    double inertia[9], inverse_inertia[9]; ///< row-major
    double q[7], v[6];                     ///< as given, after assembly as assembled
    double given_inertia[6];
} bt_body;

typedef struct bt_element_slot {
    bt_element element;
    int output_first;
} bt_element_slot;

struct bt_system {
    bt_body* bodies;
    int body_count, body_capacity;
    bt_joint* joints;
    int joint_count, joint_capacity;
    bt_element_slot* elements;
    int element_count, element_capacity;
    double gravity_mps2[3];
    bt_status add_status; ///< what went wrong while adding, kept for bt_system_assemble
    bool assembled;
    int constraint_count, redundant_count, output_count;
    double smallest_scale; ///< least of all joints' lengths, m
    int refinements;       ///< refinements of each solve; 0 when no joint closes a loop
    bt_kkt kkt;
};

/// Scratch of a state, one struct at the start, arrays behind it.
typedef struct bt_work {
    bool factored;         ///< rotation, jacobians and factor belong to the present q
    bool evaluated;        ///< a, lambda, output belong to the present q, v
    double *ga, *gb;       ///< [6 * constraint_count]
    double* factor;        ///< [factor_size]
    double* x;             ///< [order] right-hand side and solution
    double *rhs, *refined; ///< [order] for refinement; laid out only when it is used
    double* phi;           ///< [constraint_count]
    double* wrench;        ///< [6 n] forces of the last evaluation, without gyroscopic terms
    double* used;          ///< [6 n] outside wrench that a and lambda contain
    double* kick;          ///< [6 n] impulse of half a step: force, torque both in the world
    double* turn;          ///< [n] angle of the step's turn
    double* q_old;         ///< [7 n]
    double* v_old;         ///< [6 n]
    double* rotation_old;  ///< [9 n]
    double* v_mean;        ///< [6 n] predicted velocity
    double* stage;         ///< [4 * 13 n] Runge-Kutta slopes
} bt_work;

static inline bt_work* bt_work_of(const bt_state* state) {
    return state->scratch;
}

#endif
