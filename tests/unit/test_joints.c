/// Every kind of joint: its Jacobian and gamma against differences of its residual, the freedoms
/// that it leaves, and its loads.
#include "near.h"

#include "mechanics/joint.h"
#include "mechanics/vec.h"

enum { KINDS = BT_JOINT_DISTANCE + 1 };

static void rotations(const double* q, double* rotation) {
    for (int b = 0; b < 2; ++b)
        bt_rotation_from_euler(q + 7 * b + 3, rotation + 9 * b);
}

/// Moves two bodies for the time t with constant velocities of the centres and constant body rates.
static void move(const double* q, const double* v, double t, double* out) {
    for (int b = 0; b < 2; ++b) {
        const double* omega = v + 6 * b + 3;
        const double turn[3] = {t * omega[0], t * omega[1], t * omega[2]};
        double e[4];
        bt_euler_from_vector(turn, e);
        for (int i = 0; i < 3; ++i)
            out[7 * b + i] = q[7 * b + i] + t * v[6 * b + i];
        bt_euler_multiply(q + 7 * b + 3, e, out + 7 * b + 3);
    }
}

static bt_joint example(int kind, bool ground) {
    bt_joint joint = {.kind = (bt_joint_kind)kind,
                      .body_a = ground ? BT_GROUND : 0,
                      .body_b = 1,
                      .row_count = bt_joint_row_count((bt_joint_kind)kind),
                      .point_a = {0.3, -0.2, 0.5},
                      .point_b = {-0.4, 0.1, 0.2},
                      .axis_a = {2.0 / 3, -1.0 / 3, 2.0 / 3},
                      .axis_b = {0.6, 0, 0.8},
                      .attitude_ab = {0.9, 0.1, -0.3, 0.2},
                      .length_m = 1.3};
    bt_euler_normalise(joint.attitude_ab);
    bt_joint_sides(joint.axis_a, joint.side_a);
    return joint;
}

static void example_motion(double* q, double* v) {
    const double positions[14] = {0.1, 0.5, -0.3, 0.8, -0.2, 0.4, 0.3,
                                  1.1, 0.2, 0.6,  0.5, 0.6,  0.1, -0.6};
    const double velocities[12] = {0.3, -1.2, 0.7, 0.9, -0.4, 1.5, -0.8, 0.2, 0.6, -1.1, 0.5, 0.3};
    memcpy(q, positions, sizeof positions);
    memcpy(v, velocities, sizeof velocities);
    bt_euler_normalise(q + 3);
    bt_euler_normalise(q + 10);
}

/// Puts b where a fixed joint wants it, with the velocities of one rigid body.
static void lock_motion(const bt_joint* joint, double* q, double* v) {
    static const double level[4] = {1, 0, 0, 0};
    const bool ground = joint->body_a == BT_GROUND;
    double rotation[18], world[3];
    bt_euler_multiply(ground ? level : q + 3, joint->attitude_ab, q + 10);
    rotations(q, rotation);
    if (ground) {
        memset(v + 9, 0, 3 * sizeof *v);
        return;
    }
    bt_rotate(rotation, v + 3, world);
    bt_unrotate(rotation + 9, world, v + 9);
}

static void residual_at(const bt_joint* joint, const double* q, double* phi) {
    double rotation[18];
    rotations(q, rotation);
    bt_joint_residual(joint, q, rotation, phi);
}

static void rate_at(const bt_joint* joint, const double* q, const double* v, double* rate) {
    double rotation[18], ga[36], gb[36];
    rotations(q, rotation);
    bt_joint_jacobian(joint, q, rotation, ga, gb);
    for (int r = 0; r < joint->row_count; ++r) {
        rate[r] = 0;
        for (int k = 0; k < 6; ++k)
            rate[r] += (joint->body_a < 0 ? 0 : ga[6 * r + k] * v[k]) + gb[6 * r + k] * v[6 + k];
    }
}

/// Fourth-order central difference with step 1e-3: error about 1e-12 of the fifth derivative.
static void difference(void (*f)(const bt_joint*, const double*, const double*, double*),
                       const bt_joint* joint, const double* q, const double* v, double* out) {
    const double h = 1e-3, weight[4] = {1, -8, 8, -1}, at[4] = {-2, -1, 1, 2};
    memset(out, 0, 6 * sizeof *out);
    for (int k = 0; k < 4; ++k) {
        double there[14], value[6];
        move(q, v, at[k] * h, there);
        f(joint, there, v, value);
        for (int r = 0; r < joint->row_count; ++r)
            out[r] += weight[k] * value[r] / (12 * h);
    }
}

static void residual_only(const bt_joint* joint, const double* q, const double* v, double* out) {
    (void)v;
    residual_at(joint, q, out);
}

static void jacobian_is_the_derivative_of_the_residual(void** state) {
    (void)state;
    for (int kind = 0; kind < KINDS; ++kind)
        for (int ground = 0; ground < 2; ++ground) {
            const bt_joint joint = example(kind, ground);
            double q[14], v[12], want[6], got[6];
            example_motion(q, v);
            if (bt_joint_locks(joint.kind)) // the lock's Jacobian is that of the closed joint
                lock_motion(&joint, q, (double[12]){0});
            difference(residual_only, &joint, q, v, want);
            rate_at(&joint, q, v, got);
            for (int r = 0; r < joint.row_count; ++r)
                BT_ASSERT_NEAR(got[r], want[r], 0, 1e-9);
        }
}

static void gamma_is_the_rate_of_the_jacobian(void** state) {
    (void)state;
    for (int kind = 0; kind < KINDS; ++kind)
        for (int ground = 0; ground < 2; ++ground) {
            const bt_joint joint = example(kind, ground);
            double q[14], v[12], rotation[18], want[6], got[6];
            example_motion(q, v);
            if (bt_joint_locks(joint.kind))
                lock_motion(&joint, q, v);
            difference(rate_at, &joint, q, v, want);
            rotations(q, rotation);
            bt_joint_gamma(&joint, q, rotation, v, got);
            for (int r = 0; r < joint.row_count; ++r)
                BT_ASSERT_NEAR(got[r], -want[r], 0, 1e-9);
        }
}

/// A common rigid motion of both bodies breaks no closed joint: what it puts on one body it puts on
/// the other with the opposite sign.
static void common_motion_keeps_every_joint(void** state) {
    (void)state;
    for (int kind = 0; kind < KINDS; ++kind) {
        const bt_joint joint = example(kind, false);
        double q[14], v[12], rotation[18], rate[6];
        const double omega[3] = {0.4, -0.9, 1.3}, drift[3] = {2, 1, -0.5};
        example_motion(q, v);
        if (bt_joint_locks(joint.kind))
            lock_motion(&joint, q, v);
        rotations(q, rotation);
        if (kind != BT_JOINT_DISTANCE) { // close it
            double arm_a[3], arm_b[3];
            bt_rotate(rotation, joint.point_a, arm_a);
            bt_rotate(rotation + 9, joint.point_b, arm_b);
            for (int i = 0; i < 3; ++i)
                q[7 + i] = q[i] + arm_a[i] - arm_b[i];
        }
        for (int b = 0; b < 2; ++b) {
            double turn[3];
            bt_cross(omega, q + 7 * b, turn);
            for (int i = 0; i < 3; ++i)
                v[6 * b + i] = drift[i] + turn[i];
            bt_unrotate(rotation + 9 * b, omega, v + 6 * b + 3);
        }
        rate_at(&joint, q, v, rate);
        for (int r = 0; r < joint.row_count; ++r)
            BT_ASSERT_NEAR(rate[r], 0, 0, 2e-14);
    }
}

static void kinds_have_their_rows(void** state) {
    (void)state;
    const int rows[KINDS] = {5, 5, 4, 4, 3, 6, 2, 1, 1};
    for (int kind = 0; kind < KINDS; ++kind)
        assert_int_equal(bt_joint_row_count((bt_joint_kind)kind), rows[kind]);
    assert_int_equal(bt_joint_row_count((bt_joint_kind)KINDS), 0);
    assert_int_equal(bt_joint_row_count((bt_joint_kind)-1), 0);
    assert_string_equal(bt_joint_kind_name(BT_JOINT_UNIVERSAL), "universal");
}

static void lock_residual_is_the_angle_between_the_attitudes(void** state) {
    (void)state;
    const bt_joint joint = example(BT_JOINT_FIXED, false);
    double q[14], v[12], phi[6], e[4], off[4];
    const double turn[3] = {1e-3, -2e-3, 5e-4};
    example_motion(q, v);
    lock_motion(&joint, q, v);
    bt_euler_from_vector(turn, e);
    bt_euler_multiply(q + 10, e, off);
    for (int sign = -1; sign <= 1; sign += 2) { // e and -e are the same attitude
        for (int i = 0; i < 4; ++i)
            q[10 + i] = sign * off[i];
        residual_at(&joint, q, phi);
        BT_ASSERT_NEAR(bt_norm(phi + 3), bt_norm(turn), 1e-6, 0);
    }
}

static void rotation_vector_gives_its_rotation(void** state) {
    (void)state;
    for (double angle = 1e-9; angle < 6; angle *= 3) { // both sides of the series' limit
        const double axis[3] = {0.36, 0.48, -0.8};
        const double theta[3] = {angle * axis[0], angle * axis[1], angle * axis[2]};
        double e[4];
        bt_euler_from_vector(theta, e);
        BT_ASSERT_NEAR(e[0], cos(angle / 2), 0, 2e-16);
        for (int i = 0; i < 3; ++i)
            BT_ASSERT_NEAR(e[1 + i], sin(angle / 2) * axis[i], 4e-16, 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(jacobian_is_the_derivative_of_the_residual),
        cmocka_unit_test(gamma_is_the_rate_of_the_jacobian),
        cmocka_unit_test(common_motion_keeps_every_joint),
        cmocka_unit_test(kinds_have_their_rows),
        cmocka_unit_test(lock_residual_is_the_angle_between_the_attitudes),
        cmocka_unit_test(rotation_vector_gives_its_rotation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
