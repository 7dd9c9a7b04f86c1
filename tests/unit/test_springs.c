/// Springs, torsion and constant loads: force from energy, equal and opposite, power of dampers,
/// limits.
#include "near.h"

#include "elements/spring.h"
#include "elements/torque.h"
#include "mechanics/vec.h"

typedef struct scene {
    double q[14], v[12], rotation[18], wrench[12], output[4];
    bt_motion motion;
} scene;

static void turn_bodies(scene* s) {
    for (int b = 0; b < 2; ++b)
        bt_rotation_from_euler(s->q + 7 * b + 3, s->rotation + 9 * b);
    s->motion = (bt_motion){0, s->q, s->v, s->rotation};
}

static void set(scene* s, bool moving) {
    const double q[14] = {0.1, 0.5, -0.3, 0.8, -0.2, 0.4, 0.3, 1.1, 0.2, 0.6, 0.5, 0.6, 0.1, -0.6};
    const double v[12] = {0.3, -1.2, 0.7, 0.9, -0.4, 1.5, -0.8, 0.2, 0.6, -1.1, 0.5, 0.3};
    memset(s, 0, sizeof *s);
    memcpy(s->q, q, sizeof q);
    if (moving)
        memcpy(s->v, v, sizeof v);
    bt_euler_normalise(s->q + 3);
    bt_euler_normalise(s->q + 10);
    turn_bodies(s);
}

static void evaluate(scene* s, const bt_element* element) {
    memset(s->wrench, 0, sizeof s->wrench);
    element->type->force(element, &s->motion, s->wrench, s->output);
}

static double power(const scene* s, const double v[12]) {
    double sum = 0;
    for (int k = 0; k < 12; ++k)
        sum += s->wrench[k] * v[k];
    return sum;
}

/// Energy after moving along v for the time t.
static double energy_along(const scene* s, const bt_element* element, const double v[12],
                           double t) {
    scene moved = *s;
    for (int b = 0; b < 2; ++b) {
        const double turn[3] = {t * v[6 * b + 3], t * v[6 * b + 4], t * v[6 * b + 5]};
        double e[4];
        bt_add_scaled(moved.q + 7 * b, t, v + 6 * b);
        bt_euler_from_vector(turn, e);
        bt_euler_multiply(s->q + 7 * b + 3, e, moved.q + 7 * b + 3);
    }
    turn_bodies(&moved);
    return element->type->energy(element, &moved.motion);
}

/// At rest the power of the wrench along any motion is the loss of stored energy.
static void assert_force_is_the_slope_of_the_energy(const bt_element* element) {
    scene s, moving;
    set(&s, false);
    set(&moving, true);
    evaluate(&s, element);
    const double h = 1e-4;
    const double slope =
        (8 * (energy_along(&s, element, moving.v, h) - energy_along(&s, element, moving.v, -h)) -
         (energy_along(&s, element, moving.v, 2 * h) -
          energy_along(&s, element, moving.v, -2 * h))) /
        (12 * h);
    BT_ASSERT_NEAR(power(&s, moving.v), -slope, 1e-9, 1e-9);
}

/// A common rigid motion of both bodies takes no work: forces and torques are equal and opposite.
static void assert_equal_and_opposite(const bt_element* element) {
    scene s;
    double rigid[12];
    const double omega[3] = {0.4, -0.9, 1.3};
    set(&s, true);
    evaluate(&s, element);
    for (int b = 0; b < 2; ++b) {
        bt_cross(omega, s.q + 7 * b, rigid + 6 * b);
        rigid[6 * b] += 2;
        bt_unrotate(s.rotation + 9 * b, omega, rigid + 6 * b + 3);
    }
    BT_ASSERT_NEAR(power(&s, rigid), 0, 0, 1e-12);
}

static void spring_pulls_by_hookes_law(void** state) {
    (void)state;
    const bt_spring spring = {.point_a_m = {0.1, 0.2, 0.3},
                              .point_b_m = {-0.3, 0.1, 0},
                              .stiffness_Npm = 40,
                              .free_length_m = 0.5};
    const bt_element element = {&bt_spring_element, "s", 0, 1, &spring};
    scene s;
    set(&s, true);
    evaluate(&s, &element);
    double a[3], b[3];
    bt_point_position(&s.motion, 0, spring.point_a_m, a);
    bt_point_position(&s.motion, 1, spring.point_b_m, b);
    const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    BT_ASSERT_NEAR(s.output[BT_SPRING_LENGTH], bt_norm(d), 1e-15, 0);
    BT_ASSERT_NEAR(s.output[BT_SPRING_FORCE], 40 * (bt_norm(d) - 0.5), 1e-14, 0);
    for (int i = 0; i < 3; ++i) // pulls a towards b
        BT_ASSERT_NEAR(s.wrench[i], s.output[BT_SPRING_FORCE] * d[i] / bt_norm(d), 1e-14, 1e-14);
    assert_force_is_the_slope_of_the_energy(&element);
    assert_equal_and_opposite(&element);
}

static void damper_takes_energy_out(void** state) {
    (void)state;
    const bt_spring damper = {.point_b_m = {-0.3, 0.1, 0}, .damping_Nspm = 7};
    const bt_element element = {&bt_spring_element, "d", 0, 1, &damper};
    scene s;
    set(&s, true);
    evaluate(&s, &element);
    const double rate = s.output[BT_SPRING_FORCE] / 7; // dl/dt
    BT_ASSERT_NEAR(power(&s, s.v), -7 * rate * rate, 1e-13, 0);
    assert_equal_and_opposite(&element);
}

static void spring_of_no_length_is_silent(void** state) {
    (void)state;
    const bt_spring spring = {.stiffness_Npm = 40, .free_length_m = 0.5};
    const bt_element element = {&bt_spring_element, "s", BT_GROUND, 0, &spring};
    scene s;
    set(&s, false);
    memset(s.q, 0, 3 * sizeof(double));
    evaluate(&s, &element);
    for (int k = 0; k < 12; ++k)
        BT_ASSERT_NEAR(s.wrench[k], 0, 0, 0);
}

static void torsion_angle_and_torque(void** state) {
    (void)state;
    const double angles[5] = {-3.1, -0.7, 0, 1e-9, 2.9};
    for (int i = 0; i < 5; ++i) {
        const bt_torsion torsion = {
            .axis = {0, 2, 0}, .stiffness_Nmprad = 5, .free_angle_rad = 0.2};
        const bt_element element = {&bt_torsion_element, "t", BT_GROUND, 0, &torsion};
        for (int sign = -1; sign <= 1; sign += 2) { // e and -e
            scene s;
            set(&s, false);
            const double half = angles[i] / 2;
            const double e[4] = {sign * cos(half), 0, sign * sin(half), 0};
            memcpy(s.q + 3, e, sizeof e);
            turn_bodies(&s);
            evaluate(&s, &element);
            BT_ASSERT_NEAR(s.output[BT_TORSION_ANGLE], angles[i], 1e-15, 1e-16);
            BT_ASSERT_NEAR(s.wrench[4], -5 * (angles[i] - 0.2), 1e-15, 1e-15);
        }
    }
}

/// About the axis of a hinge; the free attitude need not be that of the frames.
static void torsion_is_the_slope_of_its_energy(void** state) {
    (void)state;
    bt_torsion torsion = {.axis = {0.6, 0, 0.8},
                          .attitude_ab = {0.9, 0.1, -0.3, 0.2},
                          .stiffness_Nmprad = 5,
                          .free_angle_rad = -0.4};
    bt_euler_normalise(torsion.attitude_ab);
    const bt_element element = {&bt_torsion_element, "t", 0, 1, &torsion};
    scene s;
    set(&s, false);
    // b turned by 0.8 about the hinge's axis from the free attitude
    const double turn[3] = {0.8 * 0.6, 0, 0.8 * 0.8};
    double e[4], turned[4];
    bt_euler_from_vector(turn, e);
    bt_euler_multiply(s.q + 3, e, turned);
    bt_euler_multiply(turned, torsion.attitude_ab, s.q + 10);
    turn_bodies(&s);
    evaluate(&s, &element);
    BT_ASSERT_NEAR(s.output[BT_TORSION_ANGLE], 0.8, 1e-14, 0);
    BT_ASSERT_NEAR(s.output[BT_TORSION_TORQUE], 5 * 1.2, 1e-14, 0);
    double axis[3], v[12] = {0};
    bt_rotate(s.rotation, torsion.axis, axis);
    bt_unrotate(s.rotation + 9, axis, v + 9); // b turns about the axis at 1 rad/s
    const double h = 1e-4;
    BT_ASSERT_NEAR(
        power(&s, v),
        -(energy_along(&s, &element, v, h) - energy_along(&s, &element, v, -h)) / (2 * h), 1e-9, 0);
    assert_equal_and_opposite(&element);
}

static void torsion_damper_takes_energy_out(void** state) {
    (void)state;
    const bt_torsion torsion = {.axis = {0, 0, 1}, .damping_Nmsprad = 3};
    const bt_element element = {&bt_torsion_element, "t", 0, 1, &torsion};
    scene s;
    set(&s, true);
    evaluate(&s, &element);
    const double rate = s.output[BT_TORSION_TORQUE] / 3;
    BT_ASSERT_NEAR(power(&s, s.v), -3 * rate * rate, 1e-13, 0);
    assert_equal_and_opposite(&element);
}

static void torque_turns_with_body_a(void** state) {
    (void)state;
    const bt_torque torque = {{1, -2, 3}};
    const bt_element element = {&bt_torque_element, "t", 0, 1, &torque};
    scene s;
    set(&s, true);
    evaluate(&s, &element);
    for (int i = 0; i < 3; ++i)
        BT_ASSERT_NEAR(s.wrench[3 + i], -torque.torque_Nm[i], 1e-14, 0);
    assert_equal_and_opposite(&element);
}

static void force_keeps_its_direction_and_has_a_potential(void** state) {
    (void)state;
    const bt_force force = {{0.3, -0.1, 0.2}, {4, 5, -6}};
    const bt_element element = {&bt_force_element, "f", BT_GROUND, 1, &force};
    scene s;
    set(&s, true);
    evaluate(&s, &element);
    for (int i = 0; i < 3; ++i)
        BT_ASSERT_NEAR(s.wrench[6 + i], force.force_N[i], 0, 0);
    assert_force_is_the_slope_of_the_energy(&element);
}

static void follower_turns_with_its_body(void** state) {
    (void)state;
    const bt_follower follower = {{0.3, -0.1, 0.2}, {4, 5, -6}, {1, 1, 2}};
    const bt_element element = {&bt_follower_element, "f", BT_GROUND, 1, &follower};
    scene s;
    double local[3], moment[3];
    set(&s, true);
    evaluate(&s, &element);
    bt_unrotate(s.rotation + 9, s.wrench + 6, local);
    bt_cross(follower.point_b_m, follower.force_N, moment);
    for (int i = 0; i < 3; ++i) {
        BT_ASSERT_NEAR(local[i], follower.force_N[i], 1e-14, 0);
        BT_ASSERT_NEAR(s.wrench[9 + i], moment[i] + follower.torque_Nm[i], 1e-14, 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spring_pulls_by_hookes_law),
        cmocka_unit_test(damper_takes_energy_out),
        cmocka_unit_test(spring_of_no_length_is_silent),
        cmocka_unit_test(torsion_angle_and_torque),
        cmocka_unit_test(torsion_is_the_slope_of_its_energy),
        cmocka_unit_test(torsion_damper_takes_energy_out),
        cmocka_unit_test(torque_turns_with_body_a),
        cmocka_unit_test(force_keeps_its_direction_and_has_a_potential),
        cmocka_unit_test(follower_turns_with_its_body),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
