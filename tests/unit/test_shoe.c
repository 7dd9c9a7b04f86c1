#include "near.h"

#include "landing/shoe.h"
#include "mechanics/vec.h"

/// One body with a shoe: arc of 80 mm about (-1, 0, 0), lip of 10 mm about a point ahead of it.
typedef struct rig {
    bt_shoe shoe;
    double q[7], v[6], rotation[9], wrench[6], output[BT_SHOE_OUTPUTS];
} rig;

static rig shoe_at(double x, double y, double z, double pitch, double roll) {
    rig r = {.shoe = {.impact = {.stiffness = 2.6e9,
                                 .dissipation = 0.8,
                                 .friction = 0.24,
                                 .slip_speed = 0.2},
                      .shoe_m = {-1, 0, 0},
                      .shoe_radius_m = 0.08,
                      .lip_radius_m = 0.01,
                      .lip_m = {-0.93, 0, -0.05}},
             .q = {x, y, z}};
    const double turn[4] = {cos(0.5 * pitch), 0, -sin(0.5 * pitch), 0};
    const double lean[4] = {cos(0.5 * roll), sin(0.5 * roll), 0, 0};
    bt_euler_multiply(turn, lean, r.q + 3);
    bt_rotation_from_euler(r.q + 3, r.rotation);
    return r;
}

static bt_motion motion_of(const rig* r) {
    return (bt_motion){.q = r->q, .v = r->v, .rotation = r->rotation};
}

static void evaluate(rig* r) {
    const bt_element element = {
        .type = &bt_shoe_type, .body_a = 0, .body_b = BT_GROUND, .data = &r->shoe};
    const bt_motion motion = motion_of(r);
    memset(r->wrench, 0, sizeof r->wrench);
    bt_shoe_type.force(&element, &motion, r->wrench, r->output);
}

/// The lowest point of the two discs by brute force.
static double lowest_by_sampling(const rig* r) {
    double lowest = INFINITY;
    const double* const centres[2] = {r->shoe.shoe_m, r->shoe.lip_m};
    const double radii[2] = {r->shoe.shoe_radius_m, r->shoe.lip_radius_m};
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < 20000; ++i) {
            const double angle = i * 2 * 3.14159265358979323846 / 20000;
            const double local[3] = {centres[k][0] + radii[k] * cos(angle), 0,
                                     centres[k][2] + radii[k] * sin(angle)};
            double world[3];
            bt_rotate(r->rotation, local, world);
            lowest = fmin(lowest, r->q[2] + world[2]);
        }
    return lowest;
}

static void the_lowest_point_is_that_of_the_arc_or_of_the_lip(void** state) {
    (void)state;
    bool arc = false, lip = false;
    for (double pitch = -1.5; pitch < 1.5; pitch += 0.1)
        for (double roll = -0.2; roll <= 0.21; roll += 0.1) {
            const rig r = shoe_at(0.3, -0.1, 2, pitch, roll);
            const bt_motion motion = motion_of(&r);
            double lowest[3], of_arc[3];
            bt_shoe_lowest(&r.shoe, &motion, 0, lowest);
            // 20,000 samples miss the lowest by at most R (pi / 20000)^2 / 2
            BT_ASSERT_NEAR(lowest[2], lowest_by_sampling(&r), 0, 2e-9);
            bt_point_position(&motion, 0, r.shoe.shoe_m, of_arc);
            const double side[3] = {r.rotation[1], r.rotation[4], r.rotation[7]};
            const bool on_arc =
                fabs(lowest[2] - (of_arc[2] - 0.08 * sqrt(1 - side[2] * side[2]))) < 1e-12;
            arc |= on_arc;
            lip |= !on_arc;
        }
    assert_true(arc);
    assert_true(lip);
}

static void no_force_off_the_deck(void** state) {
    (void)state;
    rig r = shoe_at(0, 0, 2, 0.9, 0);
    r.v[2] = -5;
    evaluate(&r);
    assert_true(bt_norm(r.wrench) == 0 && r.output[BT_SHOE_FORCE] == 0);
    const bt_motion motion = motion_of(&r);
    double lowest[3];
    bt_shoe_lowest(&r.shoe, &motion, 0, lowest);
    BT_ASSERT_NEAR(r.output[BT_SHOE_HEIGHT], lowest[2], 1e-15, 0);
}

/// Presses the shoe into the deck by a depth.
static rig pressed(double depth, double pitch, double roll) {
    rig r = shoe_at(0, 0, 0, pitch, roll);
    const bt_motion motion = motion_of(&r);
    double lowest[3];
    bt_shoe_lowest(&r.shoe, &motion, 0, lowest);
    r.q[2] = -lowest[2] - depth;
    return r;
}

static void eq10_normal_force_of_depth_and_rate(void** state) {
    (void)state;
    for (double rate = -2; rate <= 2; rate += 1) {
        rig r = pressed(1e-3, 0.9, 0.05);
        r.v[2] = -rate;
        evaluate(&r);
        const double want = fmax(0, 2.6e9 * pow(1e-3, 1.5) * (1 + 0.8 * rate));
        BT_ASSERT_NEAR(r.wrench[2], want, 1e-11, 0);
        BT_ASSERT_NEAR(r.output[BT_SHOE_FORCE], want, 1e-11, 0);
        BT_ASSERT_NEAR(r.output[BT_SHOE_RATE], -rate, 1e-12, 1e-15);
    }
}

static void friction_drags_against_the_sliding_and_never_more_than_coulomb(void** state) {
    (void)state;
    for (int k = 0; k < 8; ++k) {
        rig r = pressed(1e-3, 0.9, 0);
        const double angle = k * 0.7853981633974483;
        r.v[0] = 10 * cos(angle);
        r.v[1] = 10 * sin(angle);
        evaluate(&r);
        const double normal = r.wrench[2];
        // at 50 times the slip speed within 0.1 % of full friction
        BT_ASSERT_NEAR(r.wrench[0], -0.24 * normal * cos(angle), 1e-3, 1e-9 * normal);
        BT_ASSERT_NEAR(r.wrench[1], -0.24 * normal * sin(angle), 1e-3, 1e-9 * normal);
        assert_true(hypot(r.wrench[0], r.wrench[1]) <= 0.24 * normal);
    }
}

/// The rate is that of the hook's material where it touches: a hook that turns about its shoe's
/// lowest point without moving it meets no damping.
static void turning_about_the_contact_is_no_approach(void** state) {
    (void)state;
    rig r = pressed(1e-3, 0.9, 0);
    const bt_motion motion = motion_of(&r);
    double lowest[3], arm[3], velocity[3];
    bt_shoe_lowest(&r.shoe, &motion, 0, lowest);
    const double spin[3] = {0, 5, 0}; // about y: the same in the body's frame
    for (int i = 0; i < 3; ++i)
        arm[i] = r.q[i] - lowest[i];
    bt_cross(spin, arm, velocity);
    memcpy(r.v, velocity, sizeof velocity);
    memcpy(r.v + 3, spin, sizeof spin);
    evaluate(&r);
    BT_ASSERT_NEAR(r.output[BT_SHOE_RATE], 0, 0, 1e-12);
    BT_ASSERT_NEAR(r.wrench[2], 2.6e9 * pow(1e-3, 1.5), 1e-11, 0);
    BT_ASSERT_NEAR(r.wrench[0], 0, 0, 1e-6);
}

/// The moment is that of the force at the lowest point.
static void the_force_acts_at_the_lowest_point(void** state) {
    (void)state;
    rig r = pressed(1e-3, 0.9, 0);
    r.v[0] = 47.5;
    evaluate(&r);
    const bt_motion motion = motion_of(&r);
    double lowest[3], arm[3], torque[3];
    bt_shoe_lowest(&r.shoe, &motion, 0, lowest);
    for (int i = 0; i < 3; ++i)
        arm[i] = lowest[i] - r.q[i];
    bt_cross(arm, r.wrench, torque);
    // a torque about y is the same in the frame of a body that is only pitched
    BT_ASSERT_NEAR(r.wrench[4], torque[1], 1e-12, 0);
    BT_ASSERT_NEAR(r.output[BT_SHOE_X], lowest[0], 1e-15, 0);
}

static void the_force_is_the_slope_of_the_energy(void** state) {
    (void)state;
    const bt_element element = {.type = &bt_shoe_type, .body_a = 0, .body_b = BT_GROUND};
    const double depth = 1e-3, step = 1e-8;
    double energy[2];
    for (int k = 0; k < 2; ++k) {
        rig r = pressed(depth + (k ? step : -step), 0.9, 0.1);
        bt_element e = element;
        e.data = &r.shoe;
        const bt_motion motion = motion_of(&r);
        energy[k] = bt_shoe_type.energy(&e, &motion);
    }
    BT_ASSERT_NEAR((energy[1] - energy[0]) / (2 * step), 2.6e9 * pow(depth, 1.5), 1e-7, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_lowest_point_is_that_of_the_arc_or_of_the_lip),
        cmocka_unit_test(no_force_off_the_deck),
        cmocka_unit_test(eq10_normal_force_of_depth_and_rate),
        cmocka_unit_test(friction_drags_against_the_sliding_and_never_more_than_coulomb),
        cmocka_unit_test(turning_about_the_contact_is_no_approach),
        cmocka_unit_test(the_force_acts_at_the_lowest_point),
        cmocka_unit_test(the_force_is_the_slope_of_the_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
