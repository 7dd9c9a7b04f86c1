/// Bodies that turn in space: the heavy top with a published fast spin, steady precession, the flip
/// about the intermediate axis against Jacobi's elliptic functions, and what a free body conserves.
#include "mechanics_rig.h"
#include "tables.h"

#include "mechanics/vec.h"

#include <gsl/gsl_sf_elljac.h>

/* ------------------------------------------------------------------ heavy top */

static const char top_source[] = "converged independent integration; Bruls, Cardona, Arnold 2012";

static void build_heavy_top(rig* r) {
    rig_open(r, 0, 0, -9.81);
    bt_system_add_body(r->system, &(bt_body_def){.name = "top",
                                                 .mass_kg = 15,
                                                 .inertia_kgm2 = {0.234375, 0.46875, 0.234375},
                                                 .position_m = {0, 1, 0},
                                                 .attitude = {1, 0, 0, 0},
                                                 .velocity_mps = {4.61538, 0, 0},
                                                 .spin_radps = {0, 150, -4.61538}});
    bt_system_add_joint(r->system, &(bt_joint_def){.name = "tip",
                                                   .kind = BT_JOINT_SPHERICAL,
                                                   .body_a = BT_GROUND,
                                                   .body_b = 0,
                                                   .point_b_m = {0, -1, 0}});
    rig_assemble(r);
}

static void heavy_top_starts_with_the_published_accelerations(void** state) {
    (void)state;
    const double want[6] = {0, -21.3017325444, -30.9608307692308, 661.3461692307692, 0, 0};
    static const char* const name[6] = {"ax", "ay", "az", "alpha x", "alpha y", "alpha z"};
    rig r;
    build_heavy_top(&r);
    assert_int_equal(bt_system_evaluate(r.system, &r.state, NULL), BT_OK);
    for (int i = 0; i < 6; ++i) // the source prints 10 decimals
        BT_VERIFY("heavy top, t = 0", name[i], r.state.a[i], want[i], 2e-10,
                  "kynema, initial values");
    rig_close(&r);
}

static const double top_table[2][11] = {
    // t, e0..e3, centre of mass, body angular velocity
    {0.2, -0.708279152974, 0.438781088127, 0.545728396145, 0.089399752824, 0.605550561377,
     0.598957681795, -0.523983027430, -2.691590912, 150, 4.917260990},
    {0.8, -0.181181248745, 0.214757333821, -0.959571435109, -0.016592275222, -0.418162424317,
     0.907207967947, -0.045977057144, 3.118957688, 150, 3.530159678},
};

static void heavy_top_reaches_the_reference(void** state) {
    (void)state;
    static const char* const name[10] = {"e0",    "e1",    "e2",      "e3",      "x [m]",
                                         "y [m]", "z [m]", "omega x", "omega y", "omega z"};
    rig r;
    build_heavy_top(&r);
    for (int i = 0; i < 2; ++i) {
        rig_run(&r, top_table[i][0], i ? 12000 : 4000, BT_INTEGRATOR_FOURTH_ORDER);
        char problem[48];
        snprintf(problem, sizeof problem, "heavy top, t = %g s, 4th order, 50 us", top_table[i][0]);
        const double* q = r.state.q;
        const double sign = q[3] * top_table[i][1] < 0 ? -1 : 1; // e and -e are one attitude
        double got[10] = {sign * q[3], sign * q[4], sign * q[5], sign * q[6], q[0], q[1], q[2]};
        memcpy(got + 7, r.state.v + 3, 3 * sizeof(double));
        for (int k = 0; k < 10; ++k) // the reference prints 12 and 9 decimals
            BT_VERIFY(problem, name[k], got[k], top_table[i][1 + k], k < 7 ? 1e-9 : 1e-8,
                      top_source);
    }
    rig_assert_constraints(&r);
    rig_close(&r);
}

static void heavy_top_is_second_order(void** state) {
    (void)state;
    double error[3], energy[3];
    for (int k = 0; k < 3; ++k) {
        rig r;
        build_heavy_top(&r);
        rig_run(&r, 0.8, 4000 << k, BT_INTEGRATOR_SECOND_ORDER);
        error[k] = 0;
        for (int i = 0; i < 3; ++i)
            error[k] = fmax(error[k], fabs(r.state.q[i] - top_table[1][5 + i]));
        energy[k] = r.energy_error_J;
        rig_assert_constraints(&r);
        rig_close(&r);
    }
    rig_assert_order(error, 2, 0.1);
    rig_assert_order(energy, 2, 0.1);
    BT_TABLE_ROW("heavy top, t = 0.8 s, 2nd order, 50 us", "centre of mass, worst [m]", error[2], 0,
                 error[2], top_source);
    BT_TABLE_ROW("heavy top, 0.8 s, 2nd order, 50 us", "energy error [J] of 5500", energy[2], 0,
                 energy[2], "energy audit");
}

/* ------------------------------------------------------------------ steady precession */

/// A symmetric top (moments A about the tip, C about its axis) at the angle theta from the vertical
/// precesses steadily at P when  (A - C) P^2 cos(theta) - C s P + m g l = 0  with s the spin
/// relative to the precessing frame: C (s + P cos theta) P - A P^2 cos theta = m g l.
static void top_precesses_steadily(void** state) {
    (void)state;
    const double m = 2, l = 0.3, axial = 0.02, across = 0.03, g = 9.81, theta = 0.5, rate = 1.7;
    const double tip = across + m * l * l; // A
    const double spin = (m * g * l + (tip - axial) * rate * rate * cos(theta)) / (axial * rate);
    rig r;
    rig_open(&r, 0, 0, -g);
    // axis of the top: body z, leaning about y towards x; precession about the world's z
    const double sx = sin(theta), cz = cos(theta);
    bt_system_add_body(r.system, &(bt_body_def){.name = "top",
                                                .mass_kg = m,
                                                .inertia_kgm2 = {across, across, axial},
                                                .position_m = {l * sx, 0, l * cz},
                                                .attitude = {cos(theta / 2), 0, sin(theta / 2), 0},
                                                .velocity_mps = {0, rate * l * sx, 0},
                                                .spin_radps = {-rate * sx, 0, spin + rate * cz}});
    bt_system_add_joint(r.system, &(bt_joint_def){.name = "tip",
                                                  .kind = BT_JOINT_SPHERICAL,
                                                  .body_a = BT_GROUND,
                                                  .body_b = 0,
                                                  .point_b_m = {0, 0, -l}});
    rig_assemble(&r);
    const double until = 3;
    rig_run(&r, until, 30000, BT_INTEGRATOR_FOURTH_ORDER);
    const char* s = "steady precession, closed form";
    const double turn = rate * until;
    BT_VERIFY("spinning top, t = 3 s", "height [m]", r.state.q[2], l * cz, 1e-9, s);
    BT_VERIFY("spinning top, t = 3 s", "x [m]", r.state.q[0], l * sx * cos(turn), 1e-8, s);
    BT_VERIFY("spinning top, t = 3 s", "y [m]", r.state.q[1], l * sx * sin(turn), 1e-8, s);
    double force[3], torque[3];
    bt_system_joint_load(r.system, &r.state, 0, force, torque);
    BT_VERIFY("spinning top, t = 3 s", "vertical load of the tip [N]", force[2], m * g, 1e-6, s);
    BT_VERIFY("spinning top, t = 3 s", "horizontal load of the tip [N]", hypot(force[0], force[1]),
              m * rate * rate * l * sx, 1e-6, s);
    rig_assert_constraints(&r);
    rig_close(&r);
}

/* ------------------------------------------------------------------ free bodies */

static void build_free(rig* r, const double inertia[6], const double spin[3]) {
    rig_open(r, 0, 0, 0);
    bt_body_def body = {.name = "body",
                        .mass_kg = 3,
                        .position_m = {1, -2, 0.5},
                        .attitude = {0.8, 0.1, -0.5, 0.3},
                        .velocity_mps = {0.4, 1.1, -0.7}};
    memcpy(body.inertia_kgm2, inertia, sizeof body.inertia_kgm2);
    memcpy(body.spin_radps, spin, sizeof body.spin_radps);
    bt_system_add_body(r->system, &body);
    rig_assemble(r);
}

/// Euler's equations for I1 < I2 < I3 and 2 T I2 < L^2 (Landau and Lifshitz, Mechanics, section
/// 37): w1 = W1 cn(tau), w2 = W2 sn(tau), w3 = W3 dn(tau). The phase of tau is fixed by w2 = 0 at t
/// = 0.
static void free_rotation_follows_elliptic_functions(void** state) {
    (void)state;
    const double j[3] = {1, 2, 3}, w1 = 0.05, w3 = 2;
    const double energy2 = j[0] * w1 * w1 + j[2] * w3 * w3;
    const double momentum2 = j[0] * j[0] * w1 * w1 + j[2] * j[2] * w3 * w3;
    assert_true(momentum2 > energy2 * j[1]);
    const double amplitude = sqrt((energy2 * j[2] - momentum2) / (j[1] * (j[2] - j[1]))); // of w2
    const double speed = sqrt((j[2] - j[1]) * (momentum2 - energy2 * j[0]) / (j[0] * j[1] * j[2]));
    const double k2 = (j[1] - j[0]) * (energy2 * j[2] - momentum2) /
                      ((j[2] - j[1]) * (momentum2 - energy2 * j[0]));
    const double until = 20;
    rig r;
    build_free(&r, (double[6]){j[0], j[1], j[2]}, (double[3]){w1, 0, w3});
    rig_run(&r, until, 20000, BT_INTEGRATOR_FOURTH_ORDER);
    double sn, cn, dn;
    gsl_sf_elljac_e(speed * until, k2, &sn, &cn, &dn);
    const char* s = "Jacobi elliptic functions (GSL)";
    BT_VERIFY("free body, t = 20 s", "omega 1", r.state.v[3], w1 * cn, 1e-9, s);
    BT_VERIFY("free body, t = 20 s", "omega 2", r.state.v[4], amplitude * sn, 1e-9, s);
    BT_VERIFY("free body, t = 20 s", "omega 3", r.state.v[5], w3 * dn, 1e-9, s);
    rig_close(&r);
}

/// Started next to the intermediate axis the body flips over: w2 turns its sign, with the modulus k
/// near 1. Same formulae with the start at a general phase: w2 = 1 at sn = 1 / amplitude.
static double flip_error(bt_integrator integrator, int steps, double* energy_error) {
    const double j[3] = {1, 2, 3}, w[3] = {0.01, 1, 0.02}, until = 20;
    const double energy2 = j[0] * w[0] * w[0] + j[1] * w[1] * w[1] + j[2] * w[2] * w[2];
    const double momentum2 =
        j[0] * j[0] * w[0] * w[0] + j[1] * j[1] * w[1] * w[1] + j[2] * j[2] * w[2] * w[2];
    assert_true(momentum2 > energy2 * j[1]); // cn goes with w1
    const double a1 = sqrt((energy2 * j[2] - momentum2) / (j[0] * (j[2] - j[0])));
    const double a2 = sqrt((energy2 * j[2] - momentum2) / (j[1] * (j[2] - j[1])));
    const double a3 = sqrt((momentum2 - energy2 * j[0]) / (j[2] * (j[2] - j[0])));
    const double speed = sqrt((j[2] - j[1]) * (momentum2 - energy2 * j[0]) / (j[0] * j[1] * j[2]));
    const double k2 = (j[1] - j[0]) * (energy2 * j[2] - momentum2) /
                      ((j[2] - j[1]) * (momentum2 - energy2 * j[0]));
    // phase at the start, by bisection of cn = w1 / a1, sn > 0
    double low = 0, high = 1;
    double sn, cn, dn;
    do {
        high *= 2;
        gsl_sf_elljac_e(high, k2, &sn, &cn, &dn);
    } while (cn > w[0] / a1);
    for (int i = 0; i < 200; ++i) {
        const double mid = 0.5 * (low + high);
        gsl_sf_elljac_e(mid, k2, &sn, &cn, &dn);
        if (cn > w[0] / a1)
            low = mid;
        else
            high = mid;
    }
    gsl_sf_elljac_e(low + speed * until, k2, &sn, &cn, &dn);
    rig r;
    build_free(&r, (double[6]){j[0], j[1], j[2]}, w);
    bool flipped = false;
    for (int i = 0; i < 20; ++i) {
        rig_run(&r, until * (i + 1) / 20, steps / 20, integrator);
        flipped = flipped || r.state.v[4] < -0.9;
    }
    assert_true(flipped);
    const double want[3] = {a1 * cn, a2 * sn, a3 * dn};
    double error = 0;
    for (int i = 0; i < 3; ++i)
        error = fmax(error, fabs(r.state.v[3 + i] - want[i]));
    *energy_error = r.energy_error_J;
    rig_close(&r);
    return error;
}

static void flip_of_the_intermediate_axis_follows_elliptic_functions(void** state) {
    (void)state;
    double error[3], energy[3];
    const double fine = flip_error(BT_INTEGRATOR_FOURTH_ORDER, 20000, &energy[0]);
    BT_VERIFY("intermediate-axis flip, t = 20 s, 4th order, 1 ms", "angular velocity, worst", fine,
              0, 1e-8, "Jacobi elliptic functions (GSL)");
    for (int k = 0; k < 3; ++k)
        error[k] = flip_error(BT_INTEGRATOR_SECOND_ORDER, 4000 << k, &energy[k]);
    rig_assert_order(error, 2, 0.1);
    rig_assert_order(energy, 2, 0.1);
    BT_TABLE_ROW("intermediate-axis flip, t = 20 s, 2nd order, 1.25 ms", "angular velocity, worst",
                 error[2], 0, error[2], "Jacobi elliptic functions (GSL)");
}

/// The second-order scheme turns bodies at constant angular momentum: it is kept to rounding.
static void free_body_keeps_its_momenta(void** state) {
    (void)state;
    const double start[3] = {1, -2, 0.5};
    rig r;
    build_free(&r, (double[6]){1.2, 2.1, 2.9, 0.2, -0.3, 0.1}, (double[3]){3, -2, 1});
    rig_run(&r, 10, 5000, BT_INTEGRATOR_SECOND_ORDER);
    bt_audit end;
    bt_system_audit(r.system, &r.state, &end);
    for (int i = 0; i < 3; ++i) {
        BT_VERIFY("free body, 10 s, 2nd order", "momentum [N s]", end.momentum_Ns[i],
                  r.start.momentum_Ns[i], 1e-12, "conservation");
        BT_VERIFY("free body, 10 s, 2nd order", "angular momentum [N m s]",
                  end.angular_momentum_Nms[i], r.start.angular_momentum_Nms[i], 2e-11,
                  "conservation");
    }
    for (int i = 0; i < 3; ++i)
        BT_ASSERT_NEAR(r.state.q[i], start[i] + 10 * r.state.v[i], 1e-12, 1e-12);
    rig_close(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heavy_top_starts_with_the_published_accelerations),
        cmocka_unit_test(heavy_top_reaches_the_reference),
        cmocka_unit_test(heavy_top_is_second_order),
        cmocka_unit_test(top_precesses_steadily),
        cmocka_unit_test(free_rotation_follows_elliptic_functions),
        cmocka_unit_test(flip_of_the_intermediate_axis_follows_elliptic_functions),
        cmocka_unit_test(free_body_keeps_its_momenta),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
