/// Andrews' squeezing mechanism against the reference solution of the IVP Test Set (problem
/// "Andrews' squeezing mechanism"; Hairer and Wanner II, section VII.7). Seven bodies, ten revolute
/// joints in space: a planar mechanism of one degree of freedom with nine redundant constraints.
///
/// Tolerances: the published digits end near 1e-10 of each quantity's size. A separate integration
/// of the textbook's 7-coordinate equations in extended precision (step halved without change)
/// lies 1.15e-9 from the published beta and 3.1e-7 from gamma', and so does this engine.
#include "mechanics_rig.h"
#include "tables.h"

#include "elements/spring.h"
#include "elements/torque.h"

static const char problem[] = "Andrews' squeezer, t = 0.03 s";
static const char source[] = "IVP Test Set, reference solution at tolerance 1e-14";

enum { K1, K2, K3, K4, K5, K6, K7, BODIES };
enum { E3 = 3, E4 = 6, E6 = 9 }; // joints at point E

static const double rr = 0.007, ra = 0.00092, d = 0.028, da = 0.0115, e = 0.02, ea = 0.01421,
                    ss = 0.035, sa = 0.01874, sb = 0.01043, sc = 0.018, sd = 0.02, ta = 0.02308,
                    tb = 0.00916, u = 0.04, ua = 0.01228, ub = 0.00449, zf = 0.02, zt = 0.04,
                    fa = 0.01421;
static const double xa = -0.06934, ya = -0.00227, xb = -0.03635, yb = 0.03273, xc = 0.014,
                    yc = 0.072;

/// Adds a body whose centre lies at (cx, cy) in a link frame with origin (x, y) and the angle.
static void link_body(rig* r, const char* name, double mass, double inertia, double x, double y,
                      double cx, double cy, double angle) {
    rig_planar_body(r, name, mass, inertia, x + cx * cos(angle) - cy * sin(angle),
                    y + cx * sin(angle) + cy * cos(angle), angle);
}

static void build(rig* r) {
    const double beta = -0.0617138900142764496, theta = 0, gamma = 0.455279819163070380,
                 phi = 0.222668390165885885, delta = 0.487364979543842550,
                 omega = -0.222668390165885885, epsilon = 1.23054744454982119;
    const double fx = rr * cos(beta), fy = rr * sin(beta);
    const double hx = xa + zt * cos(delta), hy = ya + zt * sin(delta);
    const double gx = xa + u * sin(epsilon), gy = ya - u * cos(epsilon);
    rig_open(r, 0, 0, 0);
    link_body(r, "K1", 0.04325, 2.194e-6, 0, 0, ra, 0, beta);
    link_body(r, "K2", 0.00365, 4.410e-7, fx, fy, -da, 0, beta + theta);
    link_body(r, "K3", 0.02373, 5.255e-6, xb, yb, sa, -sb, gamma);
    link_body(r, "K4", 0.00706, 5.667e-7, hx, hy, 0, -(e - ea), phi + delta);
    link_body(r, "K5", 0.07050, 1.169e-5, xa, ya, ta, tb, delta);
    link_body(r, "K6", 0.00706, 5.667e-7, gx, gy, zf - fa, 0, omega + epsilon);
    link_body(r, "K7", 0.05498, 1.912e-5, xa, ya, ua, -ub, epsilon);
    rig_hinge(r, "O", BT_GROUND, 0, 0, K1, -ra, 0);
    rig_hinge(r, "F", K1, rr - ra, 0, K2, da, 0);
    rig_hinge(r, "B", BT_GROUND, xb, yb, K3, -sa, sb);
    rig_hinge(r, "E3", K2, da - d, 0, K3, -sa, sb - ss);
    rig_hinge(r, "A5", BT_GROUND, xa, ya, K5, -ta, -tb);
    rig_hinge(r, "H", K5, zt - ta, -tb, K4, 0, e - ea);
    rig_hinge(r, "E4", K2, da - d, 0, K4, 0, -ea);
    rig_hinge(r, "A7", BT_GROUND, xa, ya, K7, -ua, ub);
    rig_hinge(r, "G", K7, -ua, ub - u, K6, -(zf - fa), 0);
    rig_hinge(r, "E6", K2, da - d, 0, K6, fa, 0);
    const bt_spring spring = {.point_a_m = {xc, yc, 0},
                              .point_b_m = {sd - sa, sb - sc, 0},
                              .stiffness_Npm = 4530,
                              .free_length_m = 0.07785};
    bt_system_add_element(r->system,
                          &(bt_element){&bt_spring_element, "spring", BT_GROUND, K3, &spring});
    const bt_torque motor = {{0, 0, 0.033}};
    bt_system_add_element(r->system,
                          &(bt_element){&bt_torque_element, "motor", BT_GROUND, K1, &motor});
    rig_assemble(r);
}

/// beta, Theta, gamma, Phi, delta, Omega, epsilon from the attitudes of K1..K7; turns counts whole
/// turns of K1.
static void angles(const rig* r, double turns, double x[7]) {
    double a[BODIES];
    for (int b = 0; b < BODIES; ++b)
        a[b] = rig_angle(r, b);
    x[0] = a[K1] + turns;
    x[1] = a[K2] - x[0];
    x[2] = a[K3];
    x[3] = a[K4] - a[K5];
    x[4] = a[K5];
    x[5] = a[K6] - a[K7];
    x[6] = a[K7];
}

static void rates(const double* v, double x[7]) {
    double w[BODIES];
    for (int b = 0; b < BODIES; ++b)
        w[b] = v[6 * b + 5];
    const double out[7] = {w[K1], w[K2] - w[K1], w[K3], w[K4] - w[K5], w[K5], w[K6] - w[K7], w[K7]};
    memcpy(x, out, sizeof out);
}

/// Runs to 0.03 s and counts the turns of the crank.
static double run(rig* r, int steps, bt_integrator integrator) {
    double turns = 0, last = rig_angle(r, K1);
    for (int i = 0; i < steps; ++i) {
        rig_step(r, 0.03 / steps, integrator);
        if (i % 16 == 0)
            rig_watch(r);
        const double now = rig_angle(r, K1);
        if (now < last - 3)
            turns += 2 * acos(-1);
        last = now;
    }
    return turns;
}

static const double angle_reference[7] = {
    15.81077119629904,  -15.75637105984298, 0.04082224013073101, -0.5347301163226948,
    0.5244099658805304, 0.5347301163226948, 1.048080741042263};
static const double rate_reference[7] = {1139.920302151208, -1424.379294994111, 11.03291221937134,
                                         19.29337464421385, 0.5735699284790808, -19.29337464421385,
                                         0.3231791658026955};

static void start_is_consistent_and_redundant_rows_are_counted(void** state) {
    (void)state;
    rig r;
    build(&r);
    assert_int_equal(bt_system_constraint_count(r.system), 50);
    assert_int_equal(bt_system_redundant_count(r.system), 9);
    bt_failure failure;
    assert_int_equal(bt_system_evaluate(r.system, &r.state, &failure), BT_OK);
    double acceleration[7], force[3], torque[3];
    rates(r.state.a, acceleration);
    const char* s = "IVP Test Set, start values";
    BT_VERIFY("Andrews' squeezer, t = 0", "beta'' [rad/s2]", acceleration[0], 14222.4439199541138,
              1e-5, s);
    BT_VERIFY("Andrews' squeezer, t = 0", "Theta'' [rad/s2]", acceleration[1], -10666.8329399655854,
              1e-5, s);
    for (int i = 2; i < 7; ++i)
        BT_ASSERT_NEAR(acceleration[i], 0, 0, 1e-5);
    bt_system_joint_load(r.system, &r.state, E3, force, torque);
    BT_VERIFY("Andrews' squeezer, t = 0", "lambda1 [N]", force[0], 98.5668703962410896, 1e-7, s);
    BT_VERIFY("Andrews' squeezer, t = 0", "lambda2 [N]", force[1], -6.12268834425566, 1e-7, s);
    rig_close(&r);
}

static void reaches_the_published_reference(void** state) {
    (void)state;
    static const char* const angle_name[7] = {"beta",  "Theta", "gamma",  "Phi",
                                              "delta", "Omega", "epsilon"};
    static const char* const rate_name[7] = {"beta'",  "Theta'", "gamma'",  "Phi'",
                                             "delta'", "Omega'", "epsilon'"};
    static const double force_reference[6] = {199.1753333731910, -29.75531228015052,
                                              23.06654119098399, 31.45271365475927,
                                              22.64249232082739, 11.61740700019673};
    rig r;
    build(&r);
    const double turns = run(&r, 15000, BT_INTEGRATOR_FOURTH_ORDER);
    double x[7];
    angles(&r, turns, x);
    for (int i = 0; i < 7; ++i)
        BT_VERIFY(problem, angle_name[i], x[i], angle_reference[i], 2e-9, source);
    rates(r.state.v, x);
    for (int i = 0; i < 7; ++i)
        BT_VERIFY(problem, rate_name[i], x[i], rate_reference[i], 1e-6, source);
    const int joint[3] = {E3, E4, E6};
    for (int k = 0; k < 3; ++k) {
        double force[3], torque[3];
        bt_system_joint_load(r.system, &r.state, joint[k], force, torque);
        for (int i = 0; i < 2; ++i)
            BT_VERIFY(problem, "force at E [N]", force[i], force_reference[2 * k + i], 2e-5,
                      source);
    }
    rig_assert_constraints(&r);
    rig_close(&r);
}

static void second_order_scheme_converges(void** state) {
    (void)state;
    double error[3] = {0};
    for (int k = 0; k < 3; ++k) {
        rig r;
        build(&r);
        const double turns = run(&r, 6000 << k, BT_INTEGRATOR_SECOND_ORDER);
        double x[7];
        angles(&r, turns, x);
        for (int i = 0; i < 7; ++i)
            error[k] = fmax(error[k], fabs(x[i] - angle_reference[i]));
        rig_assert_constraints(&r);
        rig_close(&r);
    }
    rig_assert_order(error, 2, 0.1);
    BT_TABLE_ROW(problem, "second-order scheme, h = 1.25 us, worst angle", error[2], 0, error[2],
                 source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(start_is_consistent_and_redundant_rows_are_counted),
        cmocka_unit_test(reaches_the_published_reference),
        cmocka_unit_test(second_order_scheme_converges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
