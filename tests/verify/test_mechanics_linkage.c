/// Closed loops with closed-form kinematics: four-bar linkage, slider-crank, Hooke's joint; joint
/// loads against statics.
#include "mechanics_rig.h"
#include "tables.h"

#include "elements/torque.h"

static const double pi = 3.14159265358979323846;

/* ------------------------------------------------------------------ four-bar */

static const double crank = 0.3, coupler = 1.0, rocker = 0.8, base = 1.1;

/// Coupler and rocker angles of the open four-bar for a crank angle: the joint between them is
/// where the circle about the crank pin meets the circle about the ground pivot.
static void four_bar(double a, double* b, double* c) {
    const double px = crank * cos(a), py = crank * sin(a);
    const double dx = base - px, dy = -py, d = hypot(dx, dy);
    const double inside = acos((coupler * coupler + d * d - rocker * rocker) / (2 * coupler * d));
    *b = atan2(dy, dx) + inside;
    const double qx = px + coupler * cos(*b), qy = py + coupler * sin(*b);
    *c = atan2(qy, qx - base);
}

/// Crank from the origin, coupler, rocker to (base, 0); uniform bars. Angles are approximate by
/// `error` rad: assembly closes the loop.
static void build_four_bar(rig* r, double a, double error) {
    double b, c;
    four_bar(a, &b, &c);
    rig_open(r, 0, -9.81, 0);
    b += error;
    c -= error;
    rig_planar_body(r, "crank", 2, 2 * crank * crank / 12, crank / 2 * cos(a),
                    crank / 2 * sin(a) + error, a);
    rig_planar_body(r, "coupler", 1.5, 1.5 * coupler * coupler / 12,
                    crank * cos(a) + coupler / 2 * cos(b), crank * sin(a) + coupler / 2 * sin(b),
                    b);
    rig_planar_body(r, "rocker", 1, rocker * rocker / 12, base + rocker / 2 * cos(c),
                    rocker / 2 * sin(c), c);
    rig_hinge(r, "A", BT_GROUND, 0, 0, 0, -crank / 2, 0);
    rig_hinge(r, "B", 0, crank / 2, 0, 1, -coupler / 2, 0);
    rig_hinge(r, "C", 1, coupler / 2, 0, 2, rocker / 2, 0);
    rig_hinge(r, "D", BT_GROUND, base, 0, 2, -rocker / 2, 0);
}

static void four_bar_counts_three_redundant_rows_and_assembles(void** state) {
    (void)state;
    rig r;
    build_four_bar(&r, 0.9, 0.05);
    rig_assemble(&r);
    assert_int_equal(bt_system_constraint_count(r.system), 20);
    assert_int_equal(bt_system_redundant_count(r.system), 3);
    assert_true(r.notes >= 1);
    assert_true(r.start.position_residual <= 1e-14);
    double b, c;
    four_bar(rig_angle(&r, 0), &b, &c);
    BT_VERIFY("four-bar, assembled from 0.05 rad off", "coupler angle [rad]", rig_angle(&r, 1), b,
              1e-13, "closed form");
    BT_VERIFY("four-bar, assembled from 0.05 rad off", "rocker angle [rad]", rig_angle(&r, 2), c,
              1e-13, "closed form");
    rig_close(&r);
}

/// Closed-form angles for the crank's angle hold at every step, and the crank driven by a constant
/// torque gains the energy that the torque does.
static void four_bar_moves_as_its_closed_form(void** state) {
    (void)state;
    rig r;
    build_four_bar(&r, 0.9, 0);
    const double torque = 6;
    const bt_torque motor = {{0, 0, torque}};
    bt_system_add_element(r.system,
                          &(bt_element){&bt_torque_element, "motor", BT_GROUND, 0, &motor});
    rig_assemble(&r);
    double turned = rig_angle(&r, 0), last = turned, worst = 0, energy = 0;
    const double start = turned;
    for (int i = 0; i < 8000; ++i) {
        rig_step(&r, 2.5e-4, BT_INTEGRATOR_FOURTH_ORDER);
        const double now = rig_angle(&r, 0);
        turned += remainder(now - last, 2 * pi);
        last = now;
        double b, c;
        four_bar(now, &b, &c);
        worst = fmax(worst, fabs(remainder(rig_angle(&r, 1) - b, 2 * pi)));
        worst = fmax(worst, fabs(remainder(rig_angle(&r, 2) - c, 2 * pi)));
        bt_audit audit;
        bt_system_audit(r.system, &r.state, &audit);
        energy = fmax(energy,
                      fabs(rig_energy(&audit) - rig_energy(&r.start) - torque * (turned - start)));
        rig_watch(&r);
    }
    assert_true(turned - start > 10 * pi);
    BT_VERIFY("four-bar, 2 s, several turns", "coupler and rocker angles, worst [rad]", worst, 0,
              1e-12, "closed form");
    BT_VERIFY("four-bar, 2 s, 4th order, 0.25 ms", "energy - work of the torque [J]", energy, 0,
              2e-5, "energy audit");
    rig_assert_constraints(&r);
    rig_close(&r);
}

static double four_bar_end(bt_integrator integrator, int steps, double* energy_error) {
    rig r;
    build_four_bar(&r, 0.9, 0);
    rig_assemble(&r);
    rig_run(&r, 2, steps, integrator);
    rig_assert_constraints(&r);
    *energy_error = r.energy_error_J;
    const double angle = rig_angle(&r, 0);
    rig_close(&r);
    return angle;
}

static void four_bar_is_second_order(void** state) {
    (void)state;
    double error[3], energy[3], unused;
    const double end = four_bar_end(BT_INTEGRATOR_FOURTH_ORDER, 8000, &unused);
    for (int k = 0; k < 3; ++k)
        error[k] = fabs(four_bar_end(BT_INTEGRATOR_SECOND_ORDER, 2000 << k, &energy[k]) - end);
    rig_assert_order(error, 2, 0.1);
    rig_assert_order(energy, 2, 0.1);
    BT_TABLE_ROW("four-bar falling, t = 2 s, 2nd order, 0.25 ms", "crank angle [rad]", error[2], 0,
                 error[2], "4th order, 0.25 ms");
    BT_TABLE_ROW("four-bar falling, 2 s, 2nd order, 0.25 ms", "energy error [J]", energy[2], 0,
                 energy[2], "energy audit");
}

/* ------------------------------------------------------------------ slider-crank */

static const double rod = 0.5, arm = 0.15;

/// Crank, rod and a slider on a prismatic joint along x: four joints of five rows on three bodies
/// that keep one freedom, so three rows are redundant.
static void build_slider_crank(rig* r, double a, double speed) {
    const double b = -asin(arm * sin(a) / rod), x = arm * cos(a) + rod * cos(b);
    rig_open(r, 0, 0, 0);
    rig_planar_body(r, "crank", 3, 0.02, 0, 0, a);
    rig_planar_body(r, "rod", 0.8, 0.015, arm * cos(a) + rod / 2 * cos(b), rod / 2 * -sin(b), b);
    rig_planar_body(r, "slider", 1.2, 0.001, x, 0, 0);
    rig_hinge(r, "main bearing", BT_GROUND, 0, 0, 0, 0, 0);
    rig_hinge(r, "crank pin", 0, arm, 0, 1, -rod / 2, 0);
    rig_hinge(r, "wrist pin", 1, rod / 2, 0, 2, 0, 0);
    bt_system_add_joint(r->system, &(bt_joint_def){.name = "guide",
                                                   .kind = BT_JOINT_PRISMATIC,
                                                   .body_a = BT_GROUND,
                                                   .body_b = 2,
                                                   .axis_a = {1, 0, 0},
                                                   .axis_b = {1, 0, 0}});
    rig_assemble(r);
    // set the crank turning by hand, the others follow by projection
    r->state.v[5] = speed;
    assert_int_equal(bt_system_project(r->system, &r->state, NULL), BT_OK);
    bt_system_audit(r->system, &r->state, &r->start);
}

static void slider_crank_moves_as_its_closed_form(void** state) {
    (void)state;
    rig r;
    build_slider_crank(&r, 0.4, 20);
    assert_int_equal(bt_system_redundant_count(r.system), 3);
    double position = 0, speed = 0, acceleration = 0;
    for (int i = 0; i < 4000; ++i) {
        rig_step(&r, 2.5e-4, BT_INTEGRATOR_FOURTH_ORDER);
        rig_watch(&r);
        const double a = rig_angle(&r, 0), w = rig_rate(&r, 0), alpha = r.state.a[5];
        const double s = arm * sin(a), k = arm * cos(a), root = sqrt(rod * rod - s * s);
        // x = k + root; derivatives with respect to the crank angle
        const double x1 = -s - s * k / root;
        const double x2 = -k - (k * k - s * s) / root - s * s * k * k / (root * root * root);
        position = fmax(position, fabs(r.state.q[14] - (k + root)));
        speed = fmax(speed, fabs(r.state.v[12] - x1 * w));
        acceleration = fmax(acceleration, fabs(r.state.a[12] - x1 * alpha - x2 * w * w));
    }
    const char* s = "closed form";
    BT_VERIFY("slider-crank, 1 s", "slider position, worst [m]", position, 0, 1e-13, s);
    BT_VERIFY("slider-crank, 1 s", "slider speed, worst [m/s]", speed, 0, 1e-11, s);
    BT_VERIFY("slider-crank, 1 s", "slider acceleration, worst [m/s2]", acceleration, 0, 1e-9, s);
    BT_VERIFY("slider-crank, 1 s, 4th order, 0.25 ms", "energy error [J]", r.energy_error_J, 0,
              1e-7, "energy audit");
    rig_assert_constraints(&r);
    rig_close(&r);
}

static void slider_crank_is_second_order(void** state) {
    (void)state;
    double angle[4], energy[4];
    for (int k = 0; k < 4; ++k) {
        rig r;
        build_slider_crank(&r, 0.4, 5);
        if (k < 3)
            rig_run(&r, 1, 1000 << k, BT_INTEGRATOR_SECOND_ORDER);
        else
            rig_run(&r, 1, 8000, BT_INTEGRATOR_FOURTH_ORDER);
        angle[k] = rig_angle(&r, 0);
        energy[k] = r.energy_error_J;
        rig_close(&r);
    }
    const double error[3] = {fabs(angle[0] - angle[3]), fabs(angle[1] - angle[3]),
                             fabs(angle[2] - angle[3])};
    rig_assert_order(error, 2, 0.1);
    rig_assert_order(energy, 2, 0.1);
    BT_TABLE_ROW("slider-crank, t = 1 s, 2nd order, 0.25 ms", "crank angle [rad]", error[2], 0,
                 error[2], "4th order, 0.125 ms");
}

/* ------------------------------------------------------------------ Hooke's joint */

/// Two shafts at an angle beta joined by a universal joint: tan(out) = tan(in) / cos(beta), and
/// omega_out / omega_in = cos(beta) / (1 - sin(beta)^2 cos(in)^2) with `in` measured from the arm
/// of the input shaft lying in the plane of both shafts' normal.
static void hookes_joint_transmits_its_ratio(void** state) {
    (void)state;
    const double beta = 0.6;
    rig r;
    rig_open(&r, 0, 0, 0);
    // input along x; output along (cos beta, sin beta, 0): its body frame is turned about z
    const bt_body_def body = {
        .mass_kg = 1, .inertia_kgm2 = {0.02, 0.05, 0.05}, .attitude = {1, 0, 0, 0}};
    bt_body_def in = body, out = body;
    in.name = "input";
    in.spin_radps[0] = 30;
    out.name = "output";
    out.attitude[0] = cos(beta / 2);
    out.attitude[3] = sin(beta / 2);
    out.inertia_kgm2[0] = 0.03;
    bt_system_add_body(r.system, &in);
    bt_system_add_body(r.system, &out);
    const double along[3] = {cos(beta), sin(beta), 0};
    bt_joint_def joint = {.name = "input bearing",
                          .kind = BT_JOINT_REVOLUTE,
                          .body_a = BT_GROUND,
                          .body_b = 0,
                          .axis_a = {1, 0, 0},
                          .axis_b = {1, 0, 0}};
    bt_system_add_joint(r.system, &joint);
    joint.name = "output bearing";
    joint.body_b = 1;
    memcpy(joint.axis_a, along, sizeof along);
    bt_system_add_joint(r.system, &joint);
    // arms: of the input along its z, of the output along its y, perpendicular at the start
    bt_system_add_joint(r.system, &(bt_joint_def){.name = "cross",
                                                  .kind = BT_JOINT_UNIVERSAL,
                                                  .body_a = 0,
                                                  .body_b = 1,
                                                  .axis_a = {0, 0, 1},
                                                  .axis_b = {0, 1, 0}});
    rig_assemble(&r);
    double ratio = 0, angle = 0;
    for (int i = 0; i < 2000; ++i) {
        rig_step(&r, 5e-4, BT_INTEGRATOR_FOURTH_ORDER);
        rig_watch(&r);
        const double* e = r.state.q + 3;
        const double turn = 2 * atan2(e[1], e[0]);
        const double want = cos(beta) / (1 - pow(sin(beta) * sin(turn), 2));
        ratio = fmax(ratio, fabs(r.state.v[9] / r.state.v[3] - want));
        // output turn about its own axis: take the start attitude off
        const double *o = r.state.q + 10, c = cos(beta / 2), s = sin(beta / 2);
        const double w = o[0] * c + o[3] * s, x = o[1] * c - o[2] * s; // o conj(start), in space
        const double y = o[2] * c + o[1] * s;
        const double got = 2 * atan2(x * along[0] + y * along[1], w);
        angle = fmax(angle, fabs(remainder(got - atan2(sin(turn) * cos(beta), cos(turn)), 2 * pi)));
    }
    BT_VERIFY("Hooke's joint, 1 s, 5 turns", "speed ratio, worst", ratio, 0, 1e-11, "closed form");
    BT_VERIFY("Hooke's joint, 1 s, 5 turns", "output angle, worst [rad]", angle, 0, 1e-11,
              "closed form");
    BT_VERIFY("Hooke's joint, 1 s, 4th order, 0.5 ms", "energy error [J]", r.energy_error_J, 0,
              1e-6, "energy audit");
    rig_assert_constraints(&r);
    rig_close(&r);
}

/* ------------------------------------------------------------------ loads */

/// A horizontal bar of length 2 m hinged at its left end and held by a vertical rod (a distance
/// joint) at its right end: each carries half the weight; a side force at the end of the bar is
/// taken by the hinge as force and moment.
static void loads_of_a_held_bar_are_those_of_statics(void** state) {
    (void)state;
    const double m = 12, g = 9.81, side = 40;
    rig r;
    rig_open(&r, 0, -g, 0);
    rig_planar_body(&r, "bar", m, 4, 1, 0, 0);
    rig_hinge(&r, "hinge", BT_GROUND, 0, 0, 0, -1, 0);
    bt_system_add_joint(r.system, &(bt_joint_def){.name = "rod",
                                                  .kind = BT_JOINT_DISTANCE,
                                                  .body_a = BT_GROUND,
                                                  .body_b = 0,
                                                  .point_a_m = {2, 3, 0},
                                                  .point_b_m = {1, 0, 0},
                                                  .length_m = 3});
    const bt_force pull = {{1, 0, 0}, {0, 0, side}};
    bt_system_add_element(r.system, &(bt_element){&bt_force_element, "side", BT_GROUND, 0, &pull});
    rig_assemble(&r);
    assert_int_equal(bt_system_redundant_count(r.system), 0);
    for (int i = 0; i < 100; ++i)
        rig_step(&r, 1e-3, BT_INTEGRATOR_SECOND_ORDER);
    double force[3], torque[3];
    const char* s = "statics";
    bt_system_joint_load(r.system, &r.state, 0, force, torque);
    BT_VERIFY("held bar", "hinge, vertical force [N]", force[1], m * g / 2, 1e-9, s);
    BT_VERIFY("held bar", "hinge, axial force [N]", force[0], 0, 1e-9, s);
    BT_VERIFY("held bar", "hinge, side force [N]", force[2], -side, 1e-9, s);
    BT_VERIFY("held bar", "hinge, moment about the vertical [N m]", torque[1], 2 * side, 1e-9, s);
    BT_VERIFY("held bar", "hinge, moment about its axis [N m]", torque[2], 0, 1e-9, s);
    bt_system_joint_load(r.system, &r.state, 1, force, torque);
    BT_VERIFY("held bar", "rod, vertical force [N]", force[1], m * g / 2, 1e-9, s);
    rig_close(&r);
}

/// The redundant twin: a beam held by two fixed joints to ground. The loads are not determined by
/// statics; their sum is.
static void redundant_supports_share_the_weight(void** state) {
    (void)state;
    const double m = 7, g = 9.81;
    rig r;
    rig_open(&r, 0, 0, -g);
    rig_planar_body(&r, "beam", m, 1, 0, 0, 0);
    bt_joint_def wall = {.name = "left",
                         .kind = BT_JOINT_FIXED,
                         .body_a = BT_GROUND,
                         .body_b = 0,
                         .point_a_m = {-1, 0, 0},
                         .point_b_m = {-1, 0, 0}};
    bt_system_add_joint(r.system, &wall);
    wall.name = "right";
    wall.point_a_m[0] = wall.point_b_m[0] = 1;
    bt_system_add_joint(r.system, &wall);
    rig_assemble(&r);
    assert_int_equal(bt_system_redundant_count(r.system), 6);
    rig_run(&r, 0.1, 100, BT_INTEGRATOR_SECOND_ORDER);
    double left[3], right[3], torque[3];
    bt_system_joint_load(r.system, &r.state, 0, left, torque);
    bt_system_joint_load(r.system, &r.state, 1, right, torque);
    BT_VERIFY("beam between two walls", "sum of the vertical loads [N]", left[2] + right[2], m * g,
              1e-9, "statics");
    rig_assert_constraints(&r);
    rig_close(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(four_bar_counts_three_redundant_rows_and_assembles),
        cmocka_unit_test(four_bar_moves_as_its_closed_form),
        cmocka_unit_test(four_bar_is_second_order),
        cmocka_unit_test(slider_crank_moves_as_its_closed_form),
        cmocka_unit_test(slider_crank_is_second_order),
        cmocka_unit_test(hookes_joint_transmits_its_ratio),
        cmocka_unit_test(loads_of_a_held_bar_are_those_of_statics),
        cmocka_unit_test(redundant_supports_share_the_weight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
