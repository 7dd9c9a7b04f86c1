/// Bodies seen from a frame that accelerates or turns, beside what an inertial frame tells of them.
#include "mechanics_rig.h"

#include "mechanics/vec.h"

/* ---- closed forms in the inertial frame ---- */

enum { TOP_MASS = 3 };
static const double across = 0.7, along = 0.25; ///< inertia of the symmetric top

/// A free symmetric top: straight line, and the regular precession about its angular momentum.
typedef struct top {
    double r[3], v[3]; ///< at time 0
    double e[4], w[3]; ///< attitude, angular velocity in the body
} top;

static const top example = {
    .r = {2, -1, 0.5}, .v = {3, 1, -2}, .e = {0.8, 0.36, -0.48, 0}, .w = {1.1, -0.6, 4}};

/// Place and attitude at time t: A(t) = exp(L t / I) A(0) exp((1 - K / I) w_z t), I across, K
/// along.
static void top_at(const top* b, double t, double r[3], double e[4]) {
    const double momentum[3] = {across * b->w[0], across * b->w[1], along * b->w[2]};
    const double own[3] = {0, 0, (1 - along / across) * b->w[2] * t};
    double a[9], turn[3], about[4], spun[4], half[4];
    bt_rotation_from_euler(b->e, a);
    bt_rotate(a, momentum, turn);
    for (int i = 0; i < 3; ++i) {
        turn[i] *= t / across;
        r[i] = b->r[i] + t * b->v[i];
    }
    bt_euler_from_vector(turn, about);
    bt_euler_from_vector(own, spun);
    bt_euler_multiply(about, b->e, half);
    bt_euler_multiply(half, spun, e);
}

/// The same seen from a frame that has turned by the rotation vector `turned`.
static void seen_from(const double turned[3], double r[3], double e[4]) {
    const double back[3] = {-turned[0], -turned[1], -turned[2]};
    double turn[4], a[9], old[3] = {r[0], r[1], r[2]}, attitude[4] = {e[0], e[1], e[2], e[3]};
    bt_euler_from_vector(back, turn);
    bt_rotation_from_euler(turn, a);
    bt_rotate(a, old, r);
    bt_euler_multiply(turn, attitude, e);
}

/// A system of one free body that starts as the top does, in a frame that turns with `spin`.
static void open_top(rig* r, const top* b, const double spin[3], const double spin_rate[3]) {
    rig_open(r, 0, 0, 0);
    bt_body_def def = {.name = "top", .mass_kg = TOP_MASS, .inertia_kgm2 = {across, across, along}};
    double a[9], carried[3], local[3];
    bt_rotation_from_euler(b->e, a);
    bt_cross(spin, b->r, carried);
    bt_unrotate(a, spin, local);
    memcpy(def.position_m, b->r, sizeof b->r);
    memcpy(def.attitude, b->e, sizeof b->e);
    for (int i = 0; i < 3; ++i) {
        def.velocity_mps[i] = b->v[i] - carried[i];
        def.spin_radps[i] = b->w[i] - local[i];
    }
    bt_system_add_body(r->system, &def);
    rig_assemble(r);
    memcpy(r->state.frame.spin_radps, spin, sizeof r->state.frame.spin_radps);
    memcpy(r->state.frame.spin_rate_radps2, spin_rate, sizeof r->state.frame.spin_rate_radps2);
    assert_int_equal(bt_system_evaluate(r->system, &r->state, NULL), BT_OK);
}

/// Largest difference of places (m) and Euler parameters, whose sign is free.
static double apart(const bt_state* s, const double r[3], const double e[4]) {
    double most = 0, sign = 0;
    for (int i = 0; i < 4; ++i)
        sign += s->q[3 + i] * e[i];
    for (int i = 0; i < 3; ++i)
        most = fmax(most, fabs(s->q[i] - r[i]));
    for (int i = 0; i < 4; ++i)
        most = fmax(most, fabs(s->q[3 + i] - (sign < 0 ? -e[i] : e[i])));
    return most;
}

/// How far the top is from the closed form after one second in a frame whose spin grows evenly
/// along its own direction.
static double error_after_a_second(const double spin[3], double growth, int steps,
                                   bt_integrator integrator) {
    rig r;
    const double rate[3] = {growth * spin[0], growth * spin[1], growth * spin[2]};
    const double h = 1.0 / steps;
    open_top(&r, &example, spin, rate);
    for (int k = 0; k < steps; ++k) {
        for (int i = 0; i < 3; ++i)
            r.state.frame.spin_radps[i] = spin[i] + (k + 1) * h * rate[i];
        assert_int_equal(bt_system_step(r.system, &r.state, h, integrator, NULL), BT_OK);
    }
    double place[3], attitude[4], turned[3];
    for (int i = 0; i < 3; ++i)
        turned[i] = spin[i] + 0.5 * rate[i];
    top_at(&example, 1, place, attitude);
    seen_from(turned, place, attitude);
    const double error = apart(&r.state, place, attitude);
    rig_close(&r);
    return error;
}

/* ---- tests ---- */

static void a_body_falls_toward_a_deck_that_rises_ever_faster(void** state) {
    (void)state;
    static const double gravity[3] = {0, 0, -9.81}, heave[3] = {0.3, -0.2, 2.5};
    rig r;
    rig_open(&r, gravity[0], gravity[1], gravity[2]);
    bt_system_add_body(r.system, &(bt_body_def){.name = "weight",
                                                .mass_kg = 4,
                                                .inertia_kgm2 = {1, 1, 1},
                                                .position_m = {1, 2, 30},
                                                .attitude = {1, 0, 0, 0},
                                                .velocity_mps = {5, 0, -3}});
    rig_assemble(&r);
    for (int i = 0; i < 3; ++i)
        r.state.frame.gravity_mps2[i] = gravity[i] - heave[i];
    for (int k = 0; k < 1000; ++k)
        assert_int_equal(bt_system_step(r.system, &r.state, 1e-3, BT_INTEGRATOR_SECOND_ORDER, NULL),
                         BT_OK);
    static const double start[3] = {1, 2, 30}, velocity[3] = {5, 0, -3};
    for (int i = 0; i < 3; ++i)
        BT_ASSERT_NEAR(r.state.q[i], start[i] + velocity[i] + 0.5 * (gravity[i] - heave[i]), 0,
                       1e-12);
    rig_close(&r);
}

static void a_free_top_seen_from_a_turning_deck(void** state) {
    (void)state;
    static const double spin[3] = {0.4, -0.7, 1.1};
    BT_ASSERT_NEAR(error_after_a_second(spin, 0, 2000, BT_INTEGRATOR_FOURTH_ORDER), 0, 0, 1e-11);
}

static void the_second_order_step_is_of_second_order_in_a_turning_frame(void** state) {
    (void)state;
    static const double spin[3] = {0.4, -0.7, 1.1};
    for (int grows = 0; grows <= 1; ++grows) {
        const double growth = grows ? -1.3 : 0;
        const double coarse = error_after_a_second(spin, growth, 500, BT_INTEGRATOR_SECOND_ORDER);
        const double fine = error_after_a_second(spin, growth, 1000, BT_INTEGRATOR_SECOND_ORDER);
        assert_true(fine < 1e-4);
        BT_ASSERT_NEAR(coarse / fine, 4, 0.02, 0);
    }
}

/// A pendulum on a vertical shaft that turns: it stands at the angle at which gravity's moment and
/// the centrifugal one are equal, cos(angle) = m g d / ((I + m d^2 - K) W^2).
static void a_governor_stands_at_its_angle(void** state) {
    (void)state;
    const double mass = 2, d = 0.6, g = 9.81, turning = 6;
    const double cosine = mass * g * d / ((across + mass * d * d - along) * turning * turning);
    const double angle = acos(cosine);
    rig r;
    rig_open(&r, 0, 0, -g);
    bt_system_add_body(r.system,
                       &(bt_body_def){.name = "arm",
                                      .mass_kg = mass,
                                      .inertia_kgm2 = {across, across, along},
                                      .position_m = {d * sin(angle), 0, -d * cos(angle)},
                                      .attitude = {cos(angle / 2), 0, -sin(angle / 2), 0}});
    const int pivot = bt_system_add_joint(r.system, &(bt_joint_def){.name = "pivot",
                                                                    .kind = BT_JOINT_REVOLUTE,
                                                                    .body_a = BT_GROUND,
                                                                    .body_b = 0,
                                                                    .point_b_m = {0, 0, d},
                                                                    .axis_a = {0, 1, 0},
                                                                    .axis_b = {0, 1, 0}});
    rig_assemble(&r);
    r.state.frame.spin_radps[2] = turning;
    assert_int_equal(bt_system_evaluate(r.system, &r.state, NULL), BT_OK);
    for (int k = 0; k < 6; ++k)
        BT_ASSERT_NEAR(r.state.a[k], 0, 0, 1e-12);
    double force[3], torque[3];
    bt_system_joint_load(r.system, &r.state, pivot, force, torque);
    BT_ASSERT_NEAR(force[0], -mass * turning * turning * d * sin(angle), 1e-12, 0);
    BT_ASSERT_NEAR(force[2], mass * g, 1e-12, 0);
    rig_close(&r);
}

/// Energy seen in a frame that turns evenly, centrifugal potential included, is kept.
static void a_swinging_pendulum_keeps_its_energy_in_a_turning_frame(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, -9.81);
    bt_system_add_body(r.system, &(bt_body_def){.name = "bob",
                                                .mass_kg = 2,
                                                .inertia_kgm2 = {0.3, 0.2, 0.4},
                                                .position_m = {0.5, 0.1, -0.4},
                                                .attitude = {0.8, 0.36, -0.48, 0},
                                                .spin_radps = {3, -2, 1}});
    bt_joint_def pivot = {.name = "pivot",
                          .kind = BT_JOINT_SPHERICAL,
                          .body_a = BT_GROUND,
                          .body_b = 0,
                          .point_a_m = {0.2, -0.3, 0.1}};
    double a[9];
    bt_rotation_from_euler((double[]){0.8, 0.36, -0.48, 0}, a);
    bt_unrotate(a, (double[]){-0.3, -0.4, 0.5}, pivot.point_b_m);
    bt_system_add_joint(r.system, &pivot);
    rig_assemble(&r);
    memcpy(r.state.frame.spin_radps, (double[]){0.5, -0.3, 1.4}, 3 * sizeof(double));
    assert_int_equal(bt_system_evaluate(r.system, &r.state, NULL), BT_OK);
    bt_audit start, now;
    bt_system_audit(r.system, &r.state, &start);
    double error = 0, swing = 0;
    for (int k = 0; k < 4000; ++k) {
        assert_int_equal(bt_system_step(r.system, &r.state, 5e-4, BT_INTEGRATOR_FOURTH_ORDER, NULL),
                         BT_OK);
        bt_system_audit(r.system, &r.state, &now);
        swing = fmax(swing, now.kinetic_J);
        error = fmax(error, fabs(rig_energy(&now) - rig_energy(&start)));
    }
    assert_true(swing > 2);
    BT_ASSERT_NEAR(error, 0, 0, 1e-9 * swing);
    rig_close(&r);
}

static void a_state_is_equal_to_its_copy_until_one_of_them_moves(void** state) {
    (void)state;
    rig r;
    const double none[3] = {0, 0, 0};
    open_top(&r, &example, none, none);
    bt_arena arena;
    bt_state copy;
    assert_int_equal(bt_arena_create(&arena, bt_state_size(r.system)), BT_OK);
    assert_int_equal(bt_state_create(r.system, &arena, &copy), BT_OK);
    bt_state_copy(r.system, &copy, &r.state);
    assert_true(bt_state_equal(r.system, &copy, &r.state));
    for (int k = 0; k < 2; ++k) {
        bt_state* s = k ? &copy : &r.state;
        assert_int_equal(bt_system_step(r.system, s, 1e-3, BT_INTEGRATOR_SECOND_ORDER, NULL),
                         BT_OK);
        assert_int_equal(bt_state_equal(r.system, &copy, &r.state), k);
    }
    copy.frame.spin_rate_radps2[1] = 1e-300;
    assert_false(bt_state_equal(r.system, &copy, &r.state));
    bt_arena_destroy(&arena);
    rig_close(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_falls_toward_a_deck_that_rises_ever_faster),
        cmocka_unit_test(a_free_top_seen_from_a_turning_deck),
        cmocka_unit_test(the_second_order_step_is_of_second_order_in_a_turning_frame),
        cmocka_unit_test(a_governor_stands_at_its_angle),
        cmocka_unit_test(a_swinging_pendulum_keeps_its_energy_in_a_turning_frame),
        cmocka_unit_test(a_state_is_equal_to_its_copy_until_one_of_them_moves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
