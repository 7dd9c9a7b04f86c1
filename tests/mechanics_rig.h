/// What the tests of the multibody engine share: a system under construction that fails the test on
/// any diagnostic it did not expect, and runs with audits.
#ifndef BT_TESTS_MECHANICS_RIG_H
#define BT_TESTS_MECHANICS_RIG_H

#include "near.h"

#include "mechanics/system.h"

#include <stdio.h>

typedef struct rig {
    bt_system* system;
    bt_arena arena;
    bt_state state;
    char text[2048]; ///< all diagnostics
    int notes;
    bt_audit start;
    double energy_error_J; ///< largest change of kinetic + potential energy in rig_run
    double position_residual, velocity_residual, norm_error; ///< largest in rig_run
} rig;

static inline void rig_hear(void* user, bt_severity severity, bt_where where, const char* text) {
    rig* r = user;
    (void)where;
    r->notes += severity == BT_NOTE;
    const size_t used = strlen(r->text);
    snprintf(r->text + used, sizeof r->text - used, "%s\n", text);
}

static inline void rig_open(rig* r, double gx, double gy, double gz) {
    memset(r, 0, sizeof *r);
    assert_int_equal(bt_system_create(&r->system), BT_OK);
    bt_system_set_gravity(r->system, (double[3]){gx, gy, gz});
}

/// Body in the x-y plane at (x, y), turned by angle about z.
static inline int rig_planar_body(rig* r, const char* name, double mass, double izz, double x,
                                  double y, double angle) {
    return bt_system_add_body(r->system,
                              &(bt_body_def){.name = name,
                                             .mass_kg = mass,
                                             .inertia_kgm2 = {izz, izz, izz},
                                             .position_m = {x, y, 0},
                                             .attitude = {cos(angle / 2), 0, 0, sin(angle / 2)}});
}

/// Revolute joint about z.
static inline int rig_hinge(rig* r, const char* name, int a, double ax, double ay, int b, double bx,
                            double by) {
    return bt_system_add_joint(r->system, &(bt_joint_def){.name = name,
                                                          .kind = BT_JOINT_REVOLUTE,
                                                          .body_a = a,
                                                          .body_b = b,
                                                          .point_a_m = {ax, ay, 0},
                                                          .point_b_m = {bx, by, 0},
                                                          .axis_a = {0, 0, 1},
                                                          .axis_b = {0, 0, 1}});
}

static inline bt_status rig_assemble_status(rig* r) {
    bt_diag diag = {rig_hear, r, 0, 0};
    return bt_system_assemble(r->system, &diag);
}

static inline void rig_assemble(rig* r) {
    if (rig_assemble_status(r) != BT_OK)
        fail_msg("not assembled: %s", r->text);
    assert_int_equal(bt_arena_create(&r->arena, bt_state_size(r->system)), BT_OK);
    assert_int_equal(bt_state_create(r->system, &r->arena, &r->state), BT_OK);
    bt_system_audit(r->system, &r->state, &r->start);
}

static inline void rig_close(rig* r) {
    bt_arena_destroy(&r->arena);
    bt_system_destroy(r->system);
    memset(r, 0, sizeof *r);
}

static inline double rig_energy(const bt_audit* audit) {
    return audit->kinetic_J + audit->potential_J;
}

static inline void rig_step(rig* r, double h, bt_integrator integrator) {
    bt_failure failure = {"", "", 0};
    if (bt_system_step(r->system, &r->state, h, integrator, &failure) != BT_OK)
        fail_msg("step failed: %s, %s at %g s", failure.where, failure.quantity, failure.time_s);
}

static inline void rig_watch(rig* r) {
    bt_audit now;
    bt_system_audit(r->system, &r->state, &now);
    r->energy_error_J = fmax(r->energy_error_J, fabs(rig_energy(&now) - rig_energy(&r->start)));
    r->position_residual = fmax(r->position_residual, now.position_residual);
    r->velocity_residual = fmax(r->velocity_residual, now.velocity_residual);
    r->norm_error = fmax(r->norm_error, now.norm_error);
}

/// `steps` equal steps to time `until_s`, audited at each.
static inline void rig_run(rig* r, double until_s, int steps, bt_integrator integrator) {
    const double h = (until_s - r->state.time_s) / steps;
    for (int i = 0; i < steps; ++i) {
        rig_step(r, h, integrator);
        rig_watch(r);
    }
}

/// What the engine promises of every run.
static inline void rig_assert_constraints(const rig* r) {
    if (!(r->position_residual <= 1e-10))
        fail_msg("position residual %g", r->position_residual);
    if (!(r->velocity_residual <= 1e-10))
        fail_msg("velocity residual %g", r->velocity_residual);
    if (!(r->norm_error <= 1e-14))
        fail_msg("Euler parameter norm error %g", r->norm_error);
}

/// Observed order from errors at steps h, h/2 and h/4 (of the last pair).
static inline void rig_assert_order(const double error[3], double order, double slack) {
    for (int i = 0; i < 2; ++i) {
        const double observed = log2(error[i] / error[i + 1]);
        if (!(fabs(observed - order) <= slack))
            fail_msg("order %g from errors %g %g %g, expected %g", observed, error[0], error[1],
                     error[2], order);
    }
}

/// Turn of a body about z, -pi .. pi, and its rate.
static inline double rig_angle(const rig* r, int body) {
    const double* e = r->state.q + 7 * body + 3;
    return 2 * atan2(e[3] * (e[0] < 0 ? -1 : 1), fabs(e[0]));
}

static inline double rig_rate(const rig* r, int body) {
    return r->state.v[6 * body + 5];
}

#endif
