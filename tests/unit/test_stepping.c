/// What stepping promises: no allocation, same bits from a copy, outside wrenches, steps of any
/// length, stability, failures that say where.
#include "mechanics_rig.h"

#include "elements/spring.h"
#include "elements/torque.h"
#include "mechanics/vec.h"

#include <stdlib.h>

/* Every allocation of this program passes here (glibc resolves these names to the program's). */
#if !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
#define COUNTS_ALLOCATIONS 1
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
static volatile long allocations;

void* malloc(size_t size) {
    ++allocations;
    return __libc_malloc(size);
}

void* calloc(size_t count, size_t size) {
    ++allocations;
    return __libc_calloc(count, size);
}

void* realloc(void* old, size_t size) {
    ++allocations;
    return __libc_realloc(old, size);
}

void* aligned_alloc(size_t alignment, size_t size) {
    ++allocations;
    return __libc_memalign(alignment, size);
}
#endif

/// A chain of three bodies on three kinds of joint with a spring and a closing rod: everything that
/// a step does, loops included.
static void build_chain(rig* r) {
    rig_open(r, 0, -9.81, 0);
    for (int b = 0; b < 3; ++b)
        bt_system_add_body(r->system, &(bt_body_def){.name = "link",
                                                     .mass_kg = 1 + b,
                                                     .inertia_kgm2 = {0.1, 0.2, 0.25, 0.01},
                                                     .position_m = {0.5 + b, 0, 0},
                                                     .attitude = {1, 0, 0, 0},
                                                     .spin_radps = {0.1, 0, 0}});
    const bt_joint_kind kinds[3] = {BT_JOINT_UNIVERSAL, BT_JOINT_SPHERICAL, BT_JOINT_CYLINDRICAL};
    for (int b = 0; b < 3; ++b)
        bt_system_add_joint(r->system, &(bt_joint_def){.name = "joint",
                                                       .kind = kinds[b],
                                                       .body_a = b - 1,
                                                       .body_b = b,
                                                       .point_a_m = {b ? 0.5 : 0, 0, 0},
                                                       .point_b_m = {-0.5, 0, 0},
                                                       .axis_a = {0, 0, 1},
                                                       .axis_b = {0, b ? 0 : 1, b ? 1 : 0}});
    bt_system_add_joint(r->system, &(bt_joint_def){.name = "stay",
                                                   .kind = BT_JOINT_DISTANCE,
                                                   .body_a = 0,
                                                   .body_b = 2,
                                                   .point_b_m = {0, 0.5, 0.1},
                                                   .length_m = 1.9});
    const bt_spring spring = {
        .point_b_m = {0.5, 0, 0}, .stiffness_Npm = 300, .free_length_m = 1, .damping_Nspm = 2};
    bt_system_add_element(r->system,
                          &(bt_element){&bt_spring_element, "stay spring", BT_GROUND, 2, &spring});
    rig_assemble(r);
}

static void stepping_allocates_nothing(void** state) {
    (void)state;
#ifdef COUNTS_ALLOCATIONS
    rig r;
    build_chain(&r);
    bt_failure failure;
    bt_audit audit;
    double force[3], torque[3];
    const long before = allocations;
    bt_status status = BT_OK;
    for (int i = 0; i < 200 && status == BT_OK; ++i)
        status = bt_system_step(r.system, &r.state, 1e-3, (bt_integrator)(i % 2), &failure);
    if (status == BT_OK)
        status = bt_system_project(r.system, &r.state, &failure);
    if (status == BT_OK)
        status = bt_system_evaluate(r.system, &r.state, &failure);
    bt_system_audit(r.system, &r.state, &audit);
    bt_system_joint_load(r.system, &r.state, 0, force, torque);
    const long after = allocations;
    assert_int_equal(status, BT_OK);
    assert_int_equal(after - before, 0);
    void* volatile piece = malloc(8); // the counter does count
    free(piece);
    assert_true(allocations > after);
    rig_close(&r);
#else
    skip();
#endif
}

static void state_takes_the_size_it_says(void** state) {
    (void)state;
    rig r;
    build_chain(&r);
    assert_int_equal(r.arena.used, bt_state_size(r.system));
    rig_close(&r);
}

static void copy_continues_with_the_same_bits(void** state) {
    (void)state;
    for (int integrator = 0; integrator < 2; ++integrator) {
        rig r;
        bt_arena arena;
        bt_state copy;
        build_chain(&r);
        for (int i = 0; i < 50; ++i)
            rig_step(&r, 1e-3, (bt_integrator)integrator);
        assert_int_equal(bt_arena_create(&arena, bt_state_size(r.system)), BT_OK);
        assert_int_equal(bt_state_create(r.system, &arena, &copy), BT_OK);
        bt_state_copy(r.system, &copy, &r.state);
        for (int i = 0; i < 50; ++i) {
            rig_step(&r, 1e-3, (bt_integrator)integrator);
            assert_int_equal(bt_system_step(r.system, &copy, 1e-3, (bt_integrator)integrator, NULL),
                             BT_OK);
        }
        assert_memory_equal(copy.q, r.state.q, 21 * sizeof(double));
        assert_memory_equal(copy.v, r.state.v, 18 * sizeof(double));
        assert_memory_equal(copy.lambda, r.state.lambda, 12 * sizeof(double));
        assert_int_equal(copy.steps, 100);
        assert_true(copy.time_s == r.state.time_s);
        bt_arena_destroy(&arena);
        rig_close(&r);
    }
}

/// The outside wrench is the mean over the coming step: a free body gains h F / m at each.
static void applied_wrench_pushes_a_free_body(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, 0);
    rig_planar_body(&r, "body", 2, 0.5, 0, 0, 0);
    rig_assemble(&r);
    double momentum = 0, spin = 0;
    for (int i = 0; i < 100; ++i) {
        const double h = 1e-3 * (1 + i % 3);
        r.state.applied[1] = sin(0.3 * i);
        r.state.applied[5] = cos(0.2 * i);
        momentum += h * r.state.applied[1];
        spin += h * r.state.applied[5];
        rig_step(&r, h, BT_INTEGRATOR_SECOND_ORDER);
        BT_ASSERT_NEAR(r.state.v[1], momentum / 2, 0, 1e-15);
        BT_ASSERT_NEAR(r.state.v[5], spin / 0.5, 0, 1e-14);
    }
    rig_close(&r);
}

/// On a constrained body it does what an element with the same force does.
static void applied_wrench_equals_an_element(void** state) {
    (void)state;
    double end[2][7], load[2][3], torque[3];
    for (int by_hand = 0; by_hand < 2; ++by_hand) {
        rig r;
        rig_open(&r, 0, -9.81, 0);
        rig_planar_body(&r, "bob", 2, 0.5, 1, 0, 0);
        rig_hinge(&r, "pivot", BT_GROUND, 0, 0, 0, -1, 0);
        const bt_force force = {{0, 0, 0}, {3, 4, 5}};
        if (!by_hand)
            bt_system_add_element(r.system,
                                  &(bt_element){&bt_force_element, "f", BT_GROUND, 0, &force});
        rig_assemble(&r);
        if (by_hand)
            memcpy(r.state.applied, force.force_N, sizeof force.force_N);
        rig_run(&r, 1, 1000, BT_INTEGRATOR_SECOND_ORDER);
        memcpy(end[by_hand], r.state.q, sizeof end[0]);
        bt_system_joint_load(r.system, &r.state, 0, load[by_hand], torque);
        rig_assert_constraints(&r);
        rig_close(&r);
    }
    for (int i = 0; i < 7; ++i)
        BT_ASSERT_NEAR(end[1][i], end[0][i], 0, 1e-13);
    for (int i = 0; i < 3; ++i)
        BT_ASSERT_NEAR(load[1][i], load[0][i], 0, 1e-10);
}

/// A wrench that comes and goes between steps of different lengths, on a constrained body.
static double pushed_pendulum(int steps) {
    rig r;
    rig_open(&r, 0, -9.81, 0);
    rig_planar_body(&r, "bob", 2, 0.5, 1, 0, 0);
    rig_hinge(&r, "pivot", BT_GROUND, 0, 0, 0, -1, 0);
    rig_assemble(&r);
    const double h = 1.0 / (1.5 * steps);
    for (int i = 0; i < steps; ++i) {
        const double step = i % 2 ? h : 2 * h;
        const double mid = r.state.time_s + step / 2;
        r.state.applied[1] = 20 * sin(5 * mid);
        rig_step(&r, step, BT_INTEGRATOR_SECOND_ORDER);
        rig_watch(&r);
    }
    rig_assert_constraints(&r);
    const double angle = rig_angle(&r, 0);
    rig_close(&r);
    return angle;
}

static void second_order_holds_with_uneven_steps_and_outside_wrenches(void** state) {
    (void)state;
    const double fine = pushed_pendulum(64000);
    const double error[3] = {fabs(pushed_pendulum(500) - fine), fabs(pushed_pendulum(1000) - fine),
                             fabs(pushed_pendulum(2000) - fine)};
    rig_assert_order(error, 2, 0.1);
}

static void hand_changes_are_projected(void** state) {
    (void)state;
    rig r;
    build_chain(&r);
    for (int i = 0; i < 10; ++i)
        rig_step(&r, 1e-3, BT_INTEGRATOR_SECOND_ORDER);
    r.state.q[7] += 0.03;
    r.state.q[3] *= 1.1;
    r.state.v[12] += 2;
    bt_failure failure;
    assert_int_equal(bt_system_project(r.system, &r.state, &failure), BT_OK);
    rig_watch(&r);
    rig_run(&r, 0.1, 90, BT_INTEGRATOR_SECOND_ORDER);
    rig_assert_constraints(&r);
    rig_close(&r);
}

static void projection_that_cannot_succeed_names_the_joint(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, 0);
    rig_planar_body(&r, "bob", 2, 0.5, 1, 0, 0);
    rig_hinge(&r, "pivot", BT_GROUND, 0, 0, 0, -1, 0);
    rig_assemble(&r);
    r.state.q[0] = (double)NAN;
    bt_failure failure = {0};
    assert_int_equal(bt_system_project(r.system, &r.state, &failure), BT_ERR_NUMERIC);
    assert_string_equal(failure.where, "pivot");
    rig_close(&r);
}

static void explode(const bt_element* element, const bt_motion* motion, double* wrench,
                    double* output) {
    (void)output;
    wrench[6 * element->body_b] += motion->time_s > 0.0107 ? (double)NAN : 0;
}

static const bt_element_type exploding = {.name = "exploding", .force = explode};

static void failure_names_element_and_time(void** state) {
    (void)state;
    for (int integrator = 0; integrator < 2; ++integrator) {
        rig r;
        rig_open(&r, 0, 0, 0);
        rig_planar_body(&r, "bob", 2, 0.5, 1, 0, 0);
        const bt_spring spring = {.point_a_m = {3, 0, 0}, .stiffness_Npm = 1};
        bt_system_add_element(r.system,
                              &(bt_element){&bt_spring_element, "good", BT_GROUND, 0, &spring});
        bt_system_add_element(r.system, &(bt_element){&exploding, "bomb", BT_GROUND, 0, NULL});
        rig_assemble(&r);
        bt_failure failure = {0};
        bt_status status = BT_OK;
        for (int i = 0; i < 20 && status == BT_OK; ++i)
            status = bt_system_step(r.system, &r.state, 1e-3, (bt_integrator)integrator, &failure);
        assert_int_equal(status, BT_ERR_NUMERIC);
        assert_string_equal(failure.where, "bomb");
        assert_string_equal(failure.quantity, "force");
        BT_ASSERT_NEAR(failure.time_s, 0.011, 0, 1e-12);
        rig_close(&r);
    }
}

static void step_length_must_be_positive(void** state) {
    (void)state;
    rig r;
    build_chain(&r);
    const double bad[4] = {0, -1e-3, (double)NAN, (double)INFINITY};
    for (int i = 0; i < 4; ++i)
        assert_int_equal(
            bt_system_step(r.system, &r.state, bad[i], BT_INTEGRATOR_SECOND_ORDER, NULL),
            BT_ERR_ARG);
    rig_close(&r);
}

/// Leapfrog: an undamped spring keeps its energy for ever when omega h < 2, within (omega h)^2 / 4
/// of it at omega h = 0.5.
static void stiff_spring_is_stable(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, 0);
    rig_planar_body(&r, "mass", 1, 1, 1.1, 0, 0);
    const bt_spring spring = {.stiffness_Npm = 1e6, .free_length_m = 1};
    bt_system_add_element(r.system,
                          &(bt_element){&bt_spring_element, "spring", BT_GROUND, 0, &spring});
    rig_assemble(&r);
    rig_run(&r, 50, 100000, BT_INTEGRATOR_SECOND_ORDER); // omega h = 0.5
    assert_true(r.energy_error_J < 0.07 * rig_energy(&r.start));
    rig_close(&r);
}

/// Damped: with c h / m = 0.5 the speed falls to nothing without changing its sign.
static void stiff_damper_is_stable(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, 0);
    rig_planar_body(&r, "mass", 1, 1, 1, 0, 0);
    const bt_spring damper = {.damping_Nspm = 500};
    bt_system_add_element(r.system,
                          &(bt_element){&bt_spring_element, "damper", BT_GROUND, 0, &damper});
    rig_assemble(&r);
    r.state.v[0] = 1;
    for (int i = 0; i < 100; ++i) {
        const double before = r.state.v[0];
        rig_step(&r, 1e-3, BT_INTEGRATOR_SECOND_ORDER);
        assert_true(fabs(r.state.v[0]) < before + 1e-12);
    }
    assert_true(fabs(r.state.v[0]) < 1e-12);
    BT_ASSERT_NEAR(r.state.q[0], 1 + 1.0 / 500, 0, 2e-4);
    rig_close(&r);
}

static void outputs_are_those_of_the_last_evaluation(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, 0);
    rig_planar_body(&r, "mass", 1, 1, 1.25, 0, 0);
    const bt_spring spring = {.stiffness_Npm = 8, .free_length_m = 1};
    bt_system_add_element(r.system,
                          &(bt_element){&bt_spring_element, "first", BT_GROUND, 0, &spring});
    const int second = bt_system_add_element(
        r.system, &(bt_element){&bt_spring_element, "second", BT_GROUND, 0, &spring});
    rig_assemble(&r);
    assert_int_equal(bt_system_evaluate(r.system, &r.state, NULL), BT_OK);
    const double* output = bt_system_element_output(r.system, &r.state, second);
    BT_ASSERT_NEAR(output[BT_SPRING_LENGTH], 1.25, 0, 1e-15);
    BT_ASSERT_NEAR(output[BT_SPRING_FORCE], 2, 0, 1e-14);
    BT_ASSERT_NEAR(r.state.a[0], -4, 0, 1e-14);
    rig_close(&r);
}

/// Points move with their bodies: position and velocity of a point, and the wrench of a force on
/// it, do the same work.
static void point_kinematics_and_wrench_are_dual(void** state) {
    (void)state;
    double q[7] = {1, -2, 0.5, 0.7, -0.1, 0.5, 0.3}, v[6] = {0.3, 0.2, -1, 2, -1, 0.5};
    double rotation[9], position[3], ahead[3], velocity[3], wrench[6] = {0};
    const double point[3] = {0.4, 0.3, -0.6}, force[3] = {3, -5, 2}, torque[3] = {1, 2, -1};
    bt_euler_normalise(q + 3);
    bt_rotation_from_euler(q + 3, rotation);
    const bt_motion motion = {0, q, v, rotation};
    bt_point_position(&motion, 0, point, position);
    bt_point_velocity(&motion, 0, point, velocity);
    bt_wrench_add(&motion, 0, position, force, wrench);
    bt_wrench_add_torque(&motion, 0, torque, wrench);
    double omega[3], power = 0;
    bt_rotate(rotation, v + 3, omega);
    for (int i = 0; i < 6; ++i)
        power += wrench[i] * v[i];
    BT_ASSERT_NEAR(power, bt_dot(force, velocity) + bt_dot(torque, omega), 1e-14, 0);
    const double h = 1e-5, turn[3] = {h * v[3], h * v[4], h * v[5]};
    double e[4], next[7] = {q[0] + h * v[0], q[1] + h * v[1], q[2] + h * v[2]};
    bt_euler_from_vector(turn, e);
    bt_euler_multiply(q + 3, e, next + 3);
    bt_rotation_from_euler(next + 3, rotation);
    const bt_motion later = {h, next, v, rotation};
    bt_point_position(&later, 0, point, ahead);
    for (int i = 0; i < 3; ++i)
        BT_ASSERT_NEAR((ahead[i] - position[i]) / h, velocity[i], 0, 5e-5);
    bt_point_position(&motion, BT_GROUND, point, position);
    bt_point_velocity(&motion, BT_GROUND, point, velocity);
    assert_memory_equal(position, point, sizeof point);
    BT_ASSERT_NEAR(bt_norm(velocity), 0, 0, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stepping_allocates_nothing),
        cmocka_unit_test(state_takes_the_size_it_says),
        cmocka_unit_test(copy_continues_with_the_same_bits),
        cmocka_unit_test(applied_wrench_pushes_a_free_body),
        cmocka_unit_test(applied_wrench_equals_an_element),
        cmocka_unit_test(second_order_holds_with_uneven_steps_and_outside_wrenches),
        cmocka_unit_test(hand_changes_are_projected),
        cmocka_unit_test(projection_that_cannot_succeed_names_the_joint),
        cmocka_unit_test(failure_names_element_and_time),
        cmocka_unit_test(step_length_must_be_positive),
        cmocka_unit_test(stiff_spring_is_stable),
        cmocka_unit_test(stiff_damper_is_stable),
        cmocka_unit_test(outputs_are_those_of_the_last_evaluation),
        cmocka_unit_test(point_kinematics_and_wrench_are_dual),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
