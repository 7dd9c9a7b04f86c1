/// Pendulums: the simple pendulum against its exact solution (elliptic functions), as a body with
/// one degree of freedom; the double pendulum against an independent integration of its
/// minimal-coordinate equations.
#include "mechanics_rig.h"
#include "tables.h"

#include "elements/torque.h"

static const char exact[] = "exact solution, elliptic functions";
static const double pi = 3.14159265358979323846;

/// Point mass 1 kg on a rod of 1 m, start at (-1, 0) at rest, gravity along -y. A point has no
/// inertia of its own; 1e-9 kg m2 lengthens the period by 5e-10.
static void build_simple(rig* r, bt_joint_kind kind) {
    rig_open(r, 0, -9.81, 0);
    rig_planar_body(r, "bob", 1, 1e-9, -1, 0, 0);
    bt_system_add_joint(r->system, &(bt_joint_def){.name = "pivot",
                                                   .kind = kind,
                                                   .body_a = BT_GROUND,
                                                   .body_b = 0,
                                                   .point_b_m = {kind == BT_JOINT_DISTANCE ? 0 : 1},
                                                   .axis_a = {0, 0, 1},
                                                   .axis_b = {0, 0, 1},
                                                   .length_m = 1});
    rig_assemble(r);
}

static const double table[7][5] = {
    // t, x, y, vx, vy
    {0.25, -0.9536646122114, -0.30087174579159, 0.73100712594847, -2.3170524884524},
    {0.5, -0.39104879155055, -0.92036994878519, 3.9110480039556, -1.6617346075474},
    {1, 0.98629175113188, -0.16501085312554, 0.29690551591632, 1.7746436411127},
    {2, -0.79356619534332, -0.60848393044379, -2.1024378744361, 2.7419353930105},
    {5, -0.94230543504376, -0.334754338414, 0.85790425688595, -2.4149286543705},
    {9.99, -0.31643646991303, -0.94861370457578, 4.092451991494, -1.3651511202403},
    {10, -0.27508746257612, -0.96141920509913, 4.1755981009517, -1.1947490545605},
};

static void simple_pendulum_follows_the_exact_solution(void** state) {
    (void)state;
    static const char* const name[4] = {"x [m]", "y [m]", "vx [m/s]", "vy [m/s]"};
    rig r;
    build_simple(&r, BT_JOINT_DISTANCE);
    for (int i = 0; i < 7; ++i) {
        const int steps = (int)round((table[i][0] - r.state.time_s) / 1e-3);
        rig_run(&r, table[i][0], steps, BT_INTEGRATOR_FOURTH_ORDER);
        char problem[64];
        snprintf(problem, sizeof problem, "pendulum, t = %g s, 4th order, 1 ms", table[i][0]);
        const double got[4] = {r.state.q[0], r.state.q[1], r.state.v[0], r.state.v[1]};
        for (int k = 0; k < 4; ++k) // truncation error of 1 ms steps after 10 s: 4e-10
            BT_VERIFY(problem, name[k], got[k], table[i][1 + k], 2e-9, exact);
    }
    rig_assert_constraints(&r);
    rig_close(&r);
}

/// Quality target that another code set itself for this problem: energy error below 5e-5 J, which
/// it reached with steps of 0.8 ms (EXUDYN).
static void simple_pendulum_keeps_its_energy(void** state) {
    (void)state;
    rig r;
    build_simple(&r, BT_JOINT_REVOLUTE);
    rig_run(&r, 10, 12500, BT_INTEGRATOR_SECOND_ORDER);
    BT_VERIFY("pendulum, 10 s, 2nd order, 0.8 ms", "energy error [J]", r.energy_error_J, 0, 5e-5,
              "IFToMM A01, target used by EXUDYN");
    rig_assert_constraints(&r);
    rig_close(&r);
}

static void simple_pendulum_is_second_order(bt_joint_kind kind) {
    double error[3];
    for (int k = 0; k < 3; ++k) {
        rig r;
        build_simple(&r, kind);
        rig_run(&r, 10, 5000 << k, BT_INTEGRATOR_SECOND_ORDER);
        error[k] = hypot(r.state.q[0] - table[6][1], r.state.q[1] - table[6][2]);
        rig_assert_constraints(&r);
        rig_close(&r);
    }
    rig_assert_order(error, 2, 0.05);
    BT_TABLE_ROW("pendulum, t = 10 s", "2nd order, 0.5 ms, position [m]", error[2], 0, error[2],
                 exact);
}

static void pendulum_on_a_revolute_joint_is_second_order(void** state) {
    (void)state;
    simple_pendulum_is_second_order(BT_JOINT_REVOLUTE);
}

static void pendulum_on_a_spherical_joint_is_second_order(void** state) {
    (void)state;
    simple_pendulum_is_second_order(BT_JOINT_SPHERICAL);
}

static void pendulum_on_a_rod_is_second_order(void** state) {
    (void)state;
    simple_pendulum_is_second_order(BT_JOINT_DISTANCE);
}

static void fourth_order_scheme_is_fourth_order(void** state) {
    (void)state;
    double error[3];
    for (int k = 0; k < 3; ++k) {
        rig r;
        build_simple(&r, BT_JOINT_SPHERICAL);
        rig_run(&r, 2, 50 << k, BT_INTEGRATOR_FOURTH_ORDER);
        error[k] = hypot(r.state.q[0] - table[3][1], r.state.q[1] - table[3][2]);
        rig_close(&r);
    }
    rig_assert_order(error, 4, 0.5);
}

/// A pendulum on a torsion spring swings, for small angles, at sqrt(k / J).
static void torsion_pendulum_has_its_frequency(void** state) {
    (void)state;
    const double k = 3, inertia = 0.12, h = 1e-4;
    rig r;
    rig_open(&r, 0, 0, 0);
    rig_planar_body(&r, "disc", 2, inertia, 0, 0, 0.01);
    rig_hinge(&r, "axle", BT_GROUND, 0, 0, 0, 0, 0);
    const bt_torsion torsion = {.axis = {0, 0, 1}, .stiffness_Nmprad = k};
    bt_system_add_element(r.system,
                          &(bt_element){&bt_torsion_element, "wire", BT_GROUND, 0, &torsion});
    rig_assemble(&r);
    const double omega = sqrt(k / inertia);
    rig_run(&r, 20 * pi / omega, (int)ceil(20 * pi / omega / h), BT_INTEGRATOR_SECOND_ORDER);
    // phase error of the leapfrog: (omega h)^2 / 24 per radian
    BT_VERIFY("torsion pendulum, 10 periods, 0.1 ms", "angle [rad]", rig_angle(&r, 0), 0.01,
              0.01 * pow(20 * pi * omega * omega * h * h / 24, 2) + 1e-12, "closed form");
    assert_true(fabs(rig_rate(&r, 0)) < 0.01 * omega * 20 * pi * omega * omega * h * h / 24 * 1.05);
    rig_close(&r);
}

/* ------------------------------------------------------------------ double pendulum */

typedef struct arm {
    double m1, m2, l1, c1, c2, j1, j2, g; ///< c: pivot to centre of mass
} arm;

/// Angles from the downward vertical, absolute: the textbook equations
///   [A  B cos(d)] [p1'']   [-B sin(d) p2'^2 - (m1 c1 + m2 l1) g sin p1]
///   [.  D       ] [p2''] = [ B sin(d) p1'^2 - m2 c2 g sin p2          ],  d = p1 - p2
static void arm_slope(const arm* p, const double y[4], double f[4]) {
    const double a = p->j1 + p->m1 * p->c1 * p->c1 + p->m2 * p->l1 * p->l1;
    const double d = p->j2 + p->m2 * p->c2 * p->c2, b0 = p->m2 * p->l1 * p->c2;
    const double b = b0 * cos(y[0] - y[1]), s = b0 * sin(y[0] - y[1]);
    const double r1 = -s * y[3] * y[3] - (p->m1 * p->c1 + p->m2 * p->l1) * p->g * sin(y[0]);
    const double r2 = s * y[2] * y[2] - p->m2 * p->c2 * p->g * sin(y[1]);
    f[0] = y[2];
    f[1] = y[3];
    f[2] = (d * r1 - b * r2) / (a * d - b * b);
    f[3] = (a * r2 - b * r1) / (a * d - b * b);
}

static void arm_run(const arm* p, double until, int steps, double y[4]) {
    const double h = until / steps;
    for (int i = 0; i < steps; ++i) {
        double k[4][4], z[4];
        static const double reach[4] = {0, 0.5, 0.5, 1};
        for (int s = 0; s < 4; ++s) {
            for (int j = 0; j < 4; ++j)
                z[j] = y[j] + (s ? reach[s] * h * k[s - 1][j] : 0);
            arm_slope(p, z, k[s]);
        }
        for (int j = 0; j < 4; ++j)
            y[j] += h / 6 * (k[0][j] + 2 * k[1][j] + 2 * k[2][j] + k[3][j]);
    }
}

static const arm two_arms = {1.3, 0.7, 0.9, 0.4, 0.35, 0.11, 0.05, 9.81};

/// Both arms turned by `start` from the downward vertical; the hinge axis is y, gravity -z, so that
/// the motion is in x-z and nothing is aligned with the planar helpers.
static void build_double(rig* r, const double start[2]) {
    const arm* p = &two_arms;
    rig_open(r, 0, 0, -p->g);
    const double mass[2] = {p->m1, p->m2}, inertia[2] = {p->j1, p->j2}, c[2] = {p->c1, p->c2};
    const double root[2][2] = {{0, 0}, {p->l1 * sin(start[0]), -p->l1 * cos(start[0])}};
    for (int b = 0; b < 2; ++b)
        bt_system_add_body(
            r->system,
            &(bt_body_def){.name = b ? "lower" : "upper",
                           .mass_kg = mass[b],
                           .inertia_kgm2 = {0.8 * inertia[b], inertia[b], 0.9 * inertia[b]},
                           .position_m = {root[b][0] + c[b] * sin(start[b]), 0,
                                          root[b][1] - c[b] * cos(start[b])},
                           .attitude = {cos(start[b] / 2), 0, -sin(start[b] / 2), 0}});
    bt_joint_def hinge = {.name = "shoulder",
                          .kind = BT_JOINT_REVOLUTE,
                          .body_a = BT_GROUND,
                          .body_b = 0,
                          .point_b_m = {0, 0, p->c1},
                          .axis_a = {0, 1, 0},
                          .axis_b = {0, 1, 0}};
    bt_system_add_joint(r->system, &hinge);
    hinge.name = "elbow";
    hinge.body_a = 0;
    hinge.body_b = 1;
    memcpy(hinge.point_a_m, (double[3]){0, 0, p->c1 - p->l1}, sizeof hinge.point_a_m);
    memcpy(hinge.point_b_m, (double[3]){0, 0, p->c2}, sizeof hinge.point_b_m);
    bt_system_add_joint(r->system, &hinge);
    rig_assemble(r);
}

static double double_pendulum_error(bt_integrator integrator, double until, int steps,
                                    const double y[4], double* energy_error) {
    rig r;
    build_double(&r, (double[2]){2, 1.2});
    rig_run(&r, until, steps, integrator);
    rig_assert_constraints(&r);
    *energy_error = r.energy_error_J;
    double error = 0;
    for (int b = 0; b < 2; ++b) {
        const double* e = r.state.q + 7 * b + 3;
        const double angle = -2 * atan2(e[2], e[0]);
        error = fmax(error, fabs(remainder(angle - y[b], 2 * pi)));
        error = fmax(error, fabs(-r.state.v[6 * b + 4] - y[2 + b]));
    }
    rig_close(&r);
    return error;
}

static void double_pendulum_agrees_with_minimal_coordinates(void** state) {
    (void)state;
    double y[4] = {2, 1.2, 0, 0}, error[3], energy[3];
    arm_run(&two_arms, 2, 200000, y);
    const double fine = double_pendulum_error(BT_INTEGRATOR_FOURTH_ORDER, 2, 8000, y, &energy[0]);
    BT_VERIFY("double pendulum, t = 2 s, 4th order, 0.25 ms", "angles and rates, worst", fine, 0,
              1e-9, "independent integration, minimal coordinates");
    for (int k = 0; k < 3; ++k)
        error[k] = double_pendulum_error(BT_INTEGRATOR_SECOND_ORDER, 2, 2000 << k, y, &energy[k]);
    rig_assert_order(error, 2, 0.05);
    rig_assert_order(energy, 2, 0.1);
    BT_TABLE_ROW("double pendulum, t = 2 s, 2nd order, 0.25 ms", "angles and rates, worst",
                 error[2], 0, error[2], "independent integration, minimal coordinates");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(simple_pendulum_follows_the_exact_solution),
        cmocka_unit_test(simple_pendulum_keeps_its_energy),
        cmocka_unit_test(pendulum_on_a_revolute_joint_is_second_order),
        cmocka_unit_test(pendulum_on_a_spherical_joint_is_second_order),
        cmocka_unit_test(pendulum_on_a_rod_is_second_order),
        cmocka_unit_test(fourth_order_scheme_is_fourth_order),
        cmocka_unit_test(torsion_pendulum_has_its_frequency),
        cmocka_unit_test(double_pendulum_agrees_with_minimal_coordinates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
