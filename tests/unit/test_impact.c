#include "elements/friction.h"
#include "elements/impact.h"
#include "near.h"

static bt_impact_params defaults(void) {
    bt_impact_params p;
    bt_group_set_defaults(&bt_impact_group, &p);
    return p;
}

/// A ball that hits a wall: returns the rebound speed; peak depth, peak force and contact time.
typedef struct blow {
    double depth, force, time, rebound;
} blow;

/// Runge-Kutta of order 4 to the end of the contact, last step by linear interpolation in time.
static blow strike(const bt_impact* c, double mass, double speed, double step) {
    blow b = {0};
    double x = 0, v = speed;
    for (int i = 0; i < 2000000; ++i) {
        double kx[4], kv[4];
        static const double share[4] = {0, 0.5, 0.5, 1};
        for (int k = 0; k < 4; ++k) {
            const double at = k ? x + share[k] * step * kx[k - 1] : x;
            const double rate = k ? v + share[k] * step * kv[k - 1] : v;
            kx[k] = rate;
            kv[k] = -bt_impact_force(c, at, rate) / mass;
        }
        const double dx = step / 6 * (kx[0] + 2 * kx[1] + 2 * kx[2] + kx[3]);
        const double dv = step / 6 * (kv[0] + 2 * kv[1] + 2 * kv[2] + kv[3]);
        if (x + dx <= 0 && i > 0) {
            b.time += step * x / -dx;
            b.rebound = -(v + dv * x / -dx);
            return b;
        }
        x += dx;
        v += dv;
        b.time += step;
        b.depth = fmax(b.depth, x);
        b.force = fmax(b.force, bt_impact_force(c, x, v));
    }
    return b;
}

static void eq10_is_the_power_three_halves_and_never_pulls(void** state) {
    (void)state;
    const bt_impact_params p = defaults();
    bt_impact c;
    bt_impact_prepare(&p, &c);
    BT_ASSERT_NEAR(bt_impact_force(&c, 1e-3, 0), 2.63e9 * pow(1e-3, 1.5), 1e-14, 0);
    BT_ASSERT_NEAR(bt_impact_force(&c, 4e-3, 0), 8 * bt_impact_force(&c, 1e-3, 0), 1e-14, 0);
    BT_ASSERT_NEAR(bt_impact_force(&c, 1e-3, 0.5), 1.4 * bt_impact_force(&c, 1e-3, 0), 1e-14, 0);
    assert_true(bt_impact_force(&c, 1e-3, -10) == 0);
    assert_true(bt_impact_force(&c, 0, 3) == 0 && bt_impact_force(&c, -1, 3) == 0);
}

static void eq10_force_is_the_gradient_of_the_energy(void** state) {
    (void)state;
    const bt_impact_params p = defaults();
    bt_impact c;
    bt_impact_prepare(&p, &c);
    for (double d = 1e-4; d < 5e-3; d += 3e-4) {
        const double h = 1e-7;
        BT_ASSERT_NEAR((bt_impact_energy(&c, d + h) - bt_impact_energy(&c, d - h)) / (2 * h),
                       bt_impact_force(&c, d, 0), 1e-6, 0);
    }
}

static void eq10_dissipation_is_never_negative(void** state) {
    (void)state;
    const bt_impact_params p = defaults();
    bt_impact c;
    bt_impact_prepare(&p, &c);
    for (double rate = -10; rate <= 10; rate += 0.1)
        assert_true((bt_impact_force(&c, 1e-3, rate) - bt_impact_force(&c, 1e-3, 0)) * rate >= 0);
}

static void eq10_sphere_on_flat_has_the_textbook_stiffness(void** state) {
    (void)state;
    const bt_hertz_body ball = {210e9, 0.3, 0.010, 0.010}, flat = {210e9, 0.3, 0, 0};
    bt_hertz h;
    assert_int_equal(bt_hertz_contact(&ball, &flat, 0.7, &h), BT_OK);
    BT_ASSERT_NEAR(h.stiffness, 15384615384.615, 1e-13, 0);
    BT_ASSERT_NEAR(h.axis_ratio, 1, 1e-12, 0);
}

/// Johnson's equations solved independently to 11 digits.
static void eq10_elliptic_contact_has_the_exact_stiffness(void** state) {
    (void)state;
    static const double table[][3] = {{1.5, 1.3101029621, 1.2089268413},
                                      {2, 1.5858021197, 1.1323996557},
                                      {5, 2.8901810398, 0.9394095827},
                                      {25, 7.9439506675, 0.7227056226}};
    for (int i = 0; i < 4; ++i) {
        // E* = 1 and R_small = 1: a rigid second body.
        const bt_hertz_body first = {0.91, 0.3, table[i][0], 1}, flat = {1e30, 0.3, 0, 0};
        bt_hertz h;
        assert_int_equal(bt_hertz_contact(&first, &flat, 0, &h), BT_OK);
        BT_ASSERT_NEAR(h.radius_large, table[i][0], 1e-14, 0);
        BT_ASSERT_NEAR(h.axis_ratio, table[i][1], 1e-10, 0);
        BT_ASSERT_NEAR(h.stiffness / sqrt(h.radius_large), table[i][2], 1e-10, 0);
    }
}

/// Crossed cylinders of equal radius touch in a circle, as a sphere of that radius on a flat.
static void eq10_crossing_angle_turns_the_second_body(void** state) {
    (void)state;
    const bt_hertz_body rod = {210e9, 0.3, 0.02, 0};
    const bt_hertz_body ball = {210e9, 0.3, 0.02, 0.02}, flat = {210e9, 0.3, 0, 0};
    bt_hertz crossed, sphere;
    assert_int_equal(bt_hertz_contact(&rod, &rod, acos(0.0), &crossed), BT_OK);
    assert_int_equal(bt_hertz_contact(&ball, &flat, 0, &sphere), BT_OK);
    BT_ASSERT_NEAR(crossed.stiffness, sphere.stiffness, 1e-12, 0);
    assert_int_equal(bt_hertz_contact(&rod, &rod, 0, &crossed), BT_ERR_ARG); // parallel
    assert_int_equal(bt_hertz_contact(&flat, &flat, 0, &crossed), BT_ERR_ARG);
}

/// The table of the literature (Roark: lambda over cos theta), three digits.
static void eq10_agrees_with_the_tabulated_coefficients(void** state) {
    (void)state;
    static const double table[][2] = {{0.1, 0.748},  {0.3, 0.734},  {0.5, 0.703},
                                      {0.7, 0.644},  {0.8, 0.594},  {0.9, 0.510},
                                      {0.94, 0.452}, {0.98, 0.345}, {0.99, 0.288}};
    for (unsigned i = 0; i < sizeof table / sizeof table[0]; ++i) {
        const double large = 1 / (1 - table[i][0]), small = 1 / (1 + table[i][0]);
        const bt_hertz_body first = {2e11, 0.3, large, small}, flat = {2e11, 0.3, 0, 0};
        bt_hertz h;
        assert_int_equal(bt_hertz_contact(&first, &flat, 0, &h), BT_OK);
        const double flexibility = 2 * 0.91 / 2e11, k_d = 1.5 / 2; // the curvatures add up to 2
        BT_ASSERT_NEAR(h.stiffness, sqrt(k_d) / (flexibility * pow(table[i][1], 1.5)), 4e-3, 0);
    }
}

/// C.1: closed form of the undamped impact.
static void eq10_impact_of_a_ball_follows_hertz(void** state) {
    (void)state;
    bt_impact_params p = defaults();
    p.stiffness_from = BT_STIFFNESS_BODIES;
    p.dissipation_spm = 0;
    p.first_radius_m = p.first_cross_radius_m = 0.05;
    bt_impact c;
    bt_impact_prepare(&p, &c);
    BT_ASSERT_NEAR(c.stiffness, 34401045807.689, 1e-13, 0);
    const blow b = strike(&c, 4.1102503884466, 6, 1e-7);
    BT_ASSERT_NEAR(b.depth, 4.9227032779459e-4, 1e-6, 0);
    BT_ASSERT_NEAR(b.force, 375731.09130656, 1e-6, 0);
    BT_ASSERT_NEAR(b.time, 2.4148117329620e-4, 1e-5, 0);
    BT_ASSERT_NEAR(b.rebound, 6, 1e-6, 0);
}

/// C.3: what each published formula really gives.
static void restitution_of_the_published_laws_is_the_exact_one(void** state) {
    (void)state;
    static const double table[][6] = {
        {0.05, 0.5014470, 0.6635367, 0.0328947, 0.4884446, 0.6746245},
        {0.1, 0.5158326, 0.6652654, 0.0694442, 0.4906977, 0.6866634},
        {0.3, 0.5812880, 0.6842246, 0.2562079, 0.5199666, 0.7389953},
        {0.5, 0.6629622, 0.7252411, 0.4704448, 0.5936243, 0.7991988},
        {0.7, 0.7679998, 0.7959726, 0.6831842, 0.7226826, 0.8693431},
        {0.9, 0.9090157, 0.9131767, 0.8939207, 0.9008930, 0.9523702},
        {0.95, 0.9523702, 0.9535060, 0.9468288, 0.9501123, 0.9756083},
        {0.99, 0.9900989, 0.9901479, 0.9893403, 0.9900009, 0.9950249},
    };
    for (int i = 0; i < 8; ++i)
        for (int law = 0; law < 5; ++law)
            BT_ASSERT_NEAR(bt_impact_restitution(
                               bt_impact_law(BT_DISSIPATION_HUNT_CROSSLEY + law, table[i][0])),
                           table[i][1 + law], 0, 0.51e-7);
}

static void restitution_that_is_asked_for_is_met(void** state) {
    (void)state;
    for (double e = 1e-3; e <= 1; e += 1e-3)
        BT_ASSERT_NEAR(bt_impact_restitution(bt_impact_dissipation(e)), e, 1e-11, 0);
    assert_true(bt_impact_dissipation(1) == 0 && bt_impact_restitution(0) == 1);
}

/// The same by integrating the impact, for other mass, stiffness and speed.
static void restitution_is_met_by_the_integrated_impact(void** state) {
    (void)state;
    bt_impact_params p = defaults();
    p.dissipation_law = BT_DISSIPATION_MET;
    p.reference_speed_mps = 3.6;
    static const double asked[] = {0.1, 0.3, 0.6, 0.9};
    for (int i = 0; i < 4; ++i) {
        p.restitution = asked[i];
        p.stiffness_Npm15 = i % 2 ? 1e8 : 2.63e9;
        bt_impact c;
        bt_impact_prepare(&p, &c);
        BT_ASSERT_NEAR(strike(&c, i < 2 ? 40 : 7, 3.6, 1e-6).rebound / 3.6, asked[i], 1e-4, 0);
    }
}

static void friction_is_coulomb_beyond_the_slip_speed(void** state) {
    (void)state;
    assert_true(bt_friction_factor(0.2, 0.2) == 1 && bt_friction_factor(-3, 0.2) == -1);
    assert_true(bt_friction_factor(0, 0.2) == 0);
    BT_ASSERT_NEAR(bt_friction_factor(0.1, 0.2), 0.6875, 1e-15, 0);
    for (double v = -0.3; v <= 0.3; v += 0.01)
        BT_ASSERT_NEAR(bt_friction_factor(-v, 0.2), -bt_friction_factor(v, 0.2), 0, 0);
}

static void friction_opposes_sliding_and_matches_its_factor(void** state) {
    (void)state;
    const bt_impact_params p = defaults();
    bt_impact c;
    bt_impact_prepare(&p, &c);
    for (double v = 0; v < 1; v += 0.03) {
        const double velocity[3] = {0.6 * v, -0.8 * v, 0};
        double force[3];
        bt_impact_friction(&c, 1e4, velocity, force);
        assert_true(force[0] * velocity[0] + force[1] * velocity[1] <= 0);
        BT_ASSERT_NEAR(hypot(force[0], force[1]), 0.24e4 * bt_friction_factor(v, 0.2), 1e-13, 0);
    }
}

static void check_refuses_bodies_that_touch_along_a_line(void** state) {
    (void)state;
    bt_impact_params p = defaults();
    bt_diag diag = {0};
    assert_int_equal(bt_group_check(&bt_impact_group, &p, "contact", &diag), BT_OK);
    p.stiffness_from = BT_STIFFNESS_BODIES;
    assert_int_equal(bt_group_check(&bt_impact_group, &p, "contact", &diag), BT_OK);
    p.first_cross_radius_m = 0;
    assert_int_equal(bt_group_check(&bt_impact_group, &p, "contact", &diag), BT_ERR_INPUT);
    assert_int_equal(diag.errors, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eq10_is_the_power_three_halves_and_never_pulls),
        cmocka_unit_test(eq10_force_is_the_gradient_of_the_energy),
        cmocka_unit_test(eq10_dissipation_is_never_negative),
        cmocka_unit_test(eq10_sphere_on_flat_has_the_textbook_stiffness),
        cmocka_unit_test(eq10_elliptic_contact_has_the_exact_stiffness),
        cmocka_unit_test(eq10_crossing_angle_turns_the_second_body),
        cmocka_unit_test(eq10_agrees_with_the_tabulated_coefficients),
        cmocka_unit_test(eq10_impact_of_a_ball_follows_hertz),
        cmocka_unit_test(restitution_of_the_published_laws_is_the_exact_one),
        cmocka_unit_test(restitution_that_is_asked_for_is_met),
        cmocka_unit_test(restitution_is_met_by_the_integrated_impact),
        cmocka_unit_test(friction_is_coulomb_beyond_the_slip_speed),
        cmocka_unit_test(friction_opposes_sliding_and_matches_its_factor),
        cmocka_unit_test(check_refuses_bodies_that_touch_along_a_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
