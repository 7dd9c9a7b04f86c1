/// Loops that are hard: the N-four-bar linkage, which passes through positions where its
/// constraints are dependent and its motion could branch, and Bricard's linkage, which moves
/// although a count of its freedoms says it cannot. Definitions after the IFToMM library of
/// benchmark problems (A02, A04); references are energy, symmetry and closure.
#include "mechanics_rig.h"
#include "tables.h"

#include "mechanics/vec.h"

enum { WINDOWS = 5, POSTS = WINDOWS + 1, BARS = POSTS + WINDOWS };

static const double pi = 3.14159265358979323846;

/// Posts of 1 m and 1 kg standing on the ground 1 m apart, heads joined by bars of 1 m and 1 kg;
/// the heads start at 1 m/s along x.
static void build_windows(rig* r) {
    rig_open(r, 0, -9.81, 0);
    for (int i = 0; i < POSTS; ++i)
        rig_planar_body(r, "post", 1, 1.0 / 12, i, 0.5, pi / 2);
    for (int i = 0; i < WINDOWS; ++i)
        rig_planar_body(r, "bar", 1, 1.0 / 12, i + 0.5, 1, 0);
    for (int i = 0; i < POSTS; ++i)
        rig_hinge(r, "foot", BT_GROUND, i, 0, i, -0.5, 0);
    for (int i = 0; i < WINDOWS; ++i) {
        rig_hinge(r, "left head", i, 0.5, 0, POSTS + i, -0.5, 0);
        rig_hinge(r, "right head", i + 1, 0.5, 0, POSTS + i, 0.5, 0);
    }
    rig_assemble(r);
    for (int b = 0; b < BARS; ++b) {
        r->state.v[6 * b] = b < POSTS ? 0.5 : 1;
        r->state.v[6 * b + 5] = b < POSTS ? -1 : 0;
    }
    assert_int_equal(bt_system_project(r->system, &r->state, NULL), BT_OK);
    bt_system_audit(r->system, &r->state, &r->start);
}

/// All posts stay parallel and the bars level, through every horizontal position; energy as the
/// library judges it (0.1 J).
static void windows_pass_their_singular_position(bt_integrator integrator, int steps) {
    rig r;
    build_windows(&r);
    assert_int_equal(bt_system_redundant_count(r.system), 3 * WINDOWS);
    double tilt = 0, lowest = 1;
    for (int i = 0; i < steps; ++i) {
        rig_step(&r, 10.0 / steps, integrator);
        rig_watch(&r);
        for (int b = POSTS; b < BARS; ++b)
            tilt = fmax(tilt, fabs(rig_angle(&r, b)));
        lowest = fmin(lowest, r.state.q[7 * POSTS + 1]);
    }
    assert_true(lowest < -0.99);
    const char* scheme = integrator == BT_INTEGRATOR_SECOND_ORDER
                             ? "5-window four-bar, 10 s, 2nd order, 1 ms"
                             : "5-window four-bar, 10 s, 4th order, 1 ms";
    BT_VERIFY(scheme, "tilt of the bars [rad]", tilt, 0, 1e-6, "symmetry");
    BT_VERIFY(scheme, "energy error [J]", r.energy_error_J, 0,
              integrator == BT_INTEGRATOR_SECOND_ORDER ? 1e-2 : 1e-5, "IFToMM A02 asks 0.1 J");
    rig_assert_constraints(&r);
    rig_close(&r);
}

static void windows_second_order(void** state) {
    (void)state;
    windows_pass_their_singular_position(BT_INTEGRATOR_SECOND_ORDER, 10000);
}

static void windows_fourth_order(void** state) {
    (void)state;
    windows_pass_their_singular_position(BT_INTEGRATOR_FOURTH_ORDER, 10000);
}

/* ------------------------------------------------------------------ Bricard */

/// Six edges of a cube as a closed chain, hinges at the corners perpendicular to both edges that
/// meet there; the first edge is the ground. Rods of 1 m and 1 kg.
static void build_bricard(rig* r) {
    static const double corner[6][3] = {{0, 0, 1},  {0, 0, 0},  {1, 0, 0},
                                        {1, -1, 0}, {1, -1, 1}, {0, -1, 1}};
    rig_open(r, 0, 0, -9.81);
    for (int b = 0; b < 5; ++b) { // rod b from corner b + 1 to the next
        const double *from = corner[b + 1], *to = corner[(b + 2) % 6];
        bt_body_def rod = {.name = "rod", .mass_kg = 1, .attitude = {1, 0, 0, 0}};
        for (int i = 0; i < 3; ++i) {
            rod.position_m[i] = 0.5 * (from[i] + to[i]);
            rod.inertia_kgm2[i] = fabs(to[i] - from[i]) > 0.5 ? 1e-4 : 1.0 / 12;
        }
        bt_system_add_body(r->system, &rod);
    }
    for (int j = 0; j < 6; ++j) { // at corner j, between rods j - 2 and j - 1
        const int a = j == 0 ? 4 : j - 2, b = j - 1;
        const double *before = corner[(j + 5) % 6], *here = corner[j], *after = corner[(j + 1) % 6];
        bt_joint_def hinge = {.name = "hinge",
                              .kind = BT_JOINT_REVOLUTE,
                              .body_a = a < 0 ? BT_GROUND : a,
                              .body_b = b < 0 ? BT_GROUND : b};
        const double e1[3] = {here[0] - before[0], here[1] - before[1], here[2] - before[2]};
        const double e2[3] = {after[0] - here[0], after[1] - here[1], after[2] - here[2]};
        bt_cross(e1, e2, hinge.axis_a);
        memcpy(hinge.axis_b, hinge.axis_a, sizeof hinge.axis_b);
        for (int i = 0; i < 3; ++i) {
            hinge.point_a_m[i] = hinge.body_a < 0 ? here[i] : 0.5 * e1[i];
            hinge.point_b_m[i] = hinge.body_b < 0 ? here[i] : -0.5 * e2[i];
        }
        bt_system_add_joint(r->system, &hinge);
    }
    rig_assemble(r);
}

static void bricard_moves_with_one_redundant_row(bt_integrator integrator, double* energy_error,
                                                 int steps) {
    rig r;
    build_bricard(&r);
    assert_int_equal(bt_system_constraint_count(r.system), 30);
    assert_int_equal(bt_system_redundant_count(r.system), 1);
    rig_run(&r, 10, steps, integrator);
    assert_true(fabs(r.start.kinetic_J) < 1e-12);
    rig_assert_constraints(&r);
    *energy_error = r.energy_error_J;
    rig_close(&r);
}

static void bricard_keeps_its_energy(void** state) {
    (void)state;
    double fourth, second[3];
    bricard_moves_with_one_redundant_row(BT_INTEGRATOR_FOURTH_ORDER, &fourth, 20000);
    BT_VERIFY("Bricard, 10 s, 4th order, 0.5 ms", "energy error [J]", fourth, 0, 1e-5,
              "IFToMM A04 asks 0.001 J");
    for (int k = 0; k < 3; ++k)
        bricard_moves_with_one_redundant_row(BT_INTEGRATOR_SECOND_ORDER, &second[k], 5000 << k);
    BT_VERIFY("Bricard, 10 s, 2nd order, 0.5 ms", "energy error [J]", second[2], 0, 1e-3,
              "IFToMM A04 asks 0.001 J");
    rig_assert_order(second, 2, 0.2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(windows_second_order),
        cmocka_unit_test(windows_fourth_order),
        cmocka_unit_test(bricard_keeps_its_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
