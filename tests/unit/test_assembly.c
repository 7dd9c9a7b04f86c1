/// Bad input named, approximate positions closed, and what may not be refused.
#include "mechanics_rig.h"

#include "elements/spring.h"

static const double nan_value = (double)NAN;

static int free_body(rig* r, const char* name) {
    return bt_system_add_body(r->system, &(bt_body_def){.name = name,
                                                        .mass_kg = 1,
                                                        .inertia_kgm2 = {0.1, 0.1, 0.1},
                                                        .attitude = {1, 0, 0, 0}});
}

/// Assembly refuses and says all the words.
static void assert_refused(rig* r, const char* const* words) {
    assert_int_equal(rig_assemble_status(r), BT_ERR_INPUT);
    for (; *words; ++words)
        if (!strstr(r->text, *words))
            fail_msg("'%s' is not in: %s", *words, r->text);
    rig_close(r);
}

#define WORDS(...) ((const char* const[]){__VA_ARGS__, NULL})

static void refuse_body(bt_body_def def, const char* const* words) {
    rig r;
    rig_open(&r, 0, 0, 0);
    def.name = "strange";
    bt_system_add_body(r.system, &def);
    assert_refused(&r, words);
}

static const bt_body_def good = {
    .mass_kg = 1, .inertia_kgm2 = {0.1, 0.1, 0.1}, .attitude = {1, 0, 0, 0}};

static void mass_must_be_positive(void** state) {
    (void)state;
    const double bad[4] = {0, -2, nan_value, INFINITY};
    for (int i = 0; i < 4; ++i) {
        bt_body_def def = good;
        def.mass_kg = bad[i];
        refuse_body(def, WORDS("body 'strange'", "mass must be positive"));
    }
}

static void inertia_must_be_positive_definite(void** state) {
    (void)state;
    const double bad[4][6] = {{0.1, 0, 0.1}, {-0.1, 0.1, 0.1}, {0.1, 0.1, 0.1, 0.2}, {0, 0, 0}};
    for (int i = 0; i < 4; ++i) {
        bt_body_def def = good;
        memcpy(def.inertia_kgm2, bad[i], sizeof bad[i]);
        refuse_body(def, WORDS("body 'strange'", "positive definite"));
    }
}

static void inertia_must_obey_the_triangle_inequality(void** state) {
    (void)state;
    bt_body_def def = good;
    memcpy(def.inertia_kgm2, (double[6]){1, 1, 2.1}, sizeof def.inertia_kgm2);
    refuse_body(def, WORDS("body 'strange'", "larger than the sum of the other two"));
    // the same body seen from axes turned by 45 degrees about y
    memcpy(def.inertia_kgm2, (double[6]){1.55, 1, 1.55, 0, 0.55, 0}, sizeof def.inertia_kgm2);
    refuse_body(def, WORDS("body 'strange'", "larger than the sum of the other two"));
}

static void flat_bodies_and_rods_are_accepted(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, 0);
    bt_body_def def = good;
    memcpy(def.inertia_kgm2, (double[6]){1, 1, 2}, sizeof def.inertia_kgm2);
    bt_system_add_body(r.system, &def);
    memcpy(def.inertia_kgm2, (double[6]){1e-6, 1, 1}, sizeof def.inertia_kgm2);
    bt_system_add_body(r.system, &def);
    rig_assemble(&r);
    rig_close(&r);
}

static void attitude_and_numbers_must_be_there(void** state) {
    (void)state;
    bt_body_def def = good;
    def.attitude[0] = 0;
    refuse_body(def, WORDS("body 'strange'", "attitude", "zero"));
    def = good;
    def.position_m[1] = nan_value;
    refuse_body(def, WORDS("body 'strange'", "finite"));
    rig r;
    rig_open(&r, 0, nan_value, 0);
    free_body(&r, "a");
    assert_refused(&r, WORDS("gravity"));
    rig_open(&r, 0, 0, 0);
    assert_refused(&r, WORDS("no body"));
}

static void all_errors_are_reported_at_once(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, 0);
    bt_body_def def = good;
    def.mass_kg = -1;
    def.name = "first";
    bt_system_add_body(r.system, &def);
    def.name = "second";
    bt_system_add_body(r.system, &def);
    assert_refused(&r, WORDS("'first'", "'second'"));
}

static void refuse_joint(bt_joint_def def, const char* const* words) {
    rig r;
    rig_open(&r, 0, 0, 0);
    free_body(&r, "a");
    free_body(&r, "b");
    def.name = "link";
    bt_system_add_joint(r.system, &def);
    assert_refused(&r, words);
}

static void joints_must_make_sense(void** state) {
    (void)state;
    const bt_joint_def revolute = {.kind = BT_JOINT_REVOLUTE,
                                   .body_a = 0,
                                   .body_b = 1,
                                   .axis_a = {0, 0, 1},
                                   .axis_b = {0, 0, 1}};
    bt_joint_def def = revolute;
    def.body_b = 2;
    refuse_joint(def, WORDS("joint 'link'", "body 2"));
    def.body_b = -2;
    refuse_joint(def, WORDS("joint 'link'", "body -2"));
    def.body_b = 0;
    refuse_joint(def, WORDS("joint 'link'", "to itself"));
    def.body_a = def.body_b = BT_GROUND;
    refuse_joint(def, WORDS("joint 'link'", "to itself"));
    def = revolute;
    def.axis_a[2] = 0;
    refuse_joint(def, WORDS("joint 'link'", "axis_a is zero"));
    def = revolute;
    def.point_a_m[0] = nan_value;
    refuse_joint(def, WORDS("joint 'link'", "finite"));
    def = revolute;
    def.kind = (bt_joint_kind)99;
    refuse_joint(def, WORDS("joint 'link'", "no such kind"));
    def = revolute;
    def.kind = BT_JOINT_UNIVERSAL;
    def.axis_b[2] = 0;
    refuse_joint(def, WORDS("joint 'link'", "axis_b is zero"));
    def = revolute;
    def.kind = BT_JOINT_DISTANCE;
    refuse_joint(def, WORDS("joint 'link'", "length must be positive"));
    def = revolute;
    def.kind = BT_JOINT_PRISMATIC;
    memcpy(def.axis_b, (double[3]){1, 0, 1}, sizeof def.axis_b);
    refuse_joint(def, WORDS("joint 'link'", "not parallel", "45 deg"));
}

static void elements_must_act_on_bodies_that_exist(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, 0);
    free_body(&r, "a");
    const bt_spring spring = {.stiffness_Npm = 1};
    bt_system_add_element(r.system, &(bt_element){&bt_spring_element, "far", 0, 5, &spring});
    assert_refused(&r, WORDS("element 'far'", "body 5"));
}

/// A triangle of links that cannot reach each other.
static void lengths_that_do_not_reach_are_refused(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, 0);
    rig_planar_body(&r, "short link", 1, 0.1, 0.5, 0, 0);
    rig_hinge(&r, "near end", BT_GROUND, 0, 0, 0, -0.5, 0);
    rig_hinge(&r, "far end", BT_GROUND, 1.2, 0, 0, 0.5, 0);
    assert_refused(&r, WORDS("short link", "cannot be assembled", "end'"));
}

/// Two hinges on one body whose axes are parallel but not in line hold it; axes that are askew
/// contradict each other.
static void axes_that_do_not_meet_are_refused(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, 0);
    free_body(&r, "door");
    bt_joint_def hinge = {.name = "upper hinge",
                          .kind = BT_JOINT_REVOLUTE,
                          .body_a = BT_GROUND,
                          .body_b = 0,
                          .point_a_m = {0, 0, 1},
                          .point_b_m = {0, 0, 1},
                          .axis_a = {0, 0, 1},
                          .axis_b = {0, 0, 1}};
    bt_system_add_joint(r.system, &hinge);
    hinge.name = "lower hinge";
    hinge.point_a_m[2] = hinge.point_b_m[2] = -1;
    memcpy(hinge.axis_b, (double[3]){0, 0.1, 1}, sizeof hinge.axis_b);
    bt_system_add_joint(r.system, &hinge);
    assert_refused(&r, WORDS("hinge'", "'door'", "cannot be assembled"));
}

static void aligned_hinges_of_a_door_are_redundant_not_wrong(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, -9.81);
    rig_planar_body(&r, "door", 20, 3, 0.5, 0, 0);
    for (int k = 0; k < 2; ++k)
        bt_system_add_joint(r.system, &(bt_joint_def){.name = k ? "lower hinge" : "upper hinge",
                                                      .kind = BT_JOINT_REVOLUTE,
                                                      .body_a = BT_GROUND,
                                                      .body_b = 0,
                                                      .point_a_m = {0, 0, k ? -1 : 1},
                                                      .point_b_m = {-0.5, 0, k ? -1 : 1},
                                                      .axis_a = {0, 0, 1},
                                                      .axis_b = {0, 0, 1}});
    rig_assemble(&r);
    assert_int_equal(bt_system_constraint_count(r.system), 10);
    assert_int_equal(bt_system_redundant_count(r.system), 5);
    assert_non_null(strstr(r.text, "hinge'"));
    rig_close(&r);
}

static void bodies_without_joints_are_free(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, -10);
    free_body(&r, "a");
    free_body(&r, "b");
    rig_assemble(&r);
    assert_int_equal(bt_system_constraint_count(r.system), 0);
    rig_run(&r, 2, 20, BT_INTEGRATOR_SECOND_ORDER);
    for (int b = 0; b < 2; ++b) // exact: the fall is a parabola
        BT_ASSERT_NEAR(r.state.q[7 * b + 2], -20, 1e-14, 0);
    rig_close(&r);
}

/// Points 0.1 m and axes 0.2 rad off are closed; the heavy body hardly moves.
static void approximate_positions_are_closed_in_the_mass_metric(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, 0);
    const int heavy = bt_system_add_body(r.system, &(bt_body_def){.name = "heavy",
                                                                  .mass_kg = 1e6,
                                                                  .inertia_kgm2 = {1e6, 1e6, 1e6},
                                                                  .attitude = {1, 0, 0, 0}});
    const int light = bt_system_add_body(r.system, &(bt_body_def){.name = "light",
                                                                  .mass_kg = 1,
                                                                  .inertia_kgm2 = {0.1, 0.1, 0.1},
                                                                  .position_m = {1.6, 0.05, 0},
                                                                  .attitude = {1, 0.1, 0, 0},
                                                                  .velocity_mps = {0, 3, 0}});
    bt_system_add_joint(r.system, &(bt_joint_def){.name = "pin",
                                                  .kind = BT_JOINT_REVOLUTE,
                                                  .body_a = heavy,
                                                  .body_b = light,
                                                  .point_a_m = {1, 0, 0},
                                                  .point_b_m = {-0.5, 0, 0},
                                                  .axis_a = {0, 0, 1},
                                                  .axis_b = {0, 0, 1}});
    rig_assemble(&r);
    assert_true(r.start.position_residual < 1e-14 && r.start.velocity_residual < 1e-12);
    assert_true(fabs(r.state.q[0]) < 1e-6 && fabs(r.state.q[7] - 1.5) < 2e-3);
    // the centre moves at 3 m/s about the pin: projection keeps the momentum along the freedom
    const double rate = 3 * 0.5 / (0.1 + 0.25);
    BT_ASSERT_NEAR(r.state.v[11], rate, 1e-2, 0);
    rig_close(&r);
}

/// A hinged rod that is told to turn at 6 rad/s, its centre to move with `speed` (3.6 m/s is
/// right).
static void open_turning_rod(rig* r, double speed) {
    rig_open(r, 0, 0, 0);
    bt_system_add_body(r->system, &(bt_body_def){.name = "rod",
                                                 .mass_kg = 2,
                                                 .inertia_kgm2 = {0.1, 0.1, 0.1},
                                                 .position_m = {0.6, 0, 0},
                                                 .attitude = {1, 0, 0, 0},
                                                 .velocity_mps = {0, speed, 0},
                                                 .spin_radps = {0, 0, 6}});
    rig_hinge(r, "pivot", BT_GROUND, 0, 0, 0, -0.6, 0);
    rig_assemble(r);
}

static void velocities_that_break_the_joints_are_changed_and_said_so(void** state) {
    (void)state;
    rig r;
    open_turning_rod(&r, 0);
    // nearest in the mass metric: the angular momentum about the pivot is kept
    BT_ASSERT_NEAR(rig_rate(&r, 0), 0.1 * 6 / (0.1 + 2 * 0.6 * 0.6), 1e-12, 0);
    assert_int_equal(r.notes, 1);
    assert_non_null(strstr(r.text, "body 'rod': the given velocities break the joints"));
    assert_non_null(strstr(r.text, "from 6 to 0.7317 rad/s"));
    rig_close(&r);
    open_turning_rod(&r, 3.6 * 1.005);
    assert_int_equal(r.notes, 0); // half a per cent
    rig_close(&r);
}

static void names_are_found(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, 0);
    free_body(&r, "a");
    free_body(&r, "b");
    rig_hinge(&r, "pin", 0, 0, 0, 1, 0, 0);
    const bt_spring spring = {.stiffness_Npm = 1};
    bt_system_add_element(r.system, &(bt_element){&bt_spring_element, "coil", 0, 1, &spring});
    assert_int_equal(bt_system_body_find(r.system, "b"), 1);
    assert_int_equal(bt_system_joint_find(r.system, "pin"), 0);
    assert_int_equal(bt_system_element_find(r.system, "coil"), 0);
    assert_int_equal(bt_system_body_find(r.system, "c"), -1);
    assert_int_equal(bt_system_joint_find(r.system, "a"), -1);
    assert_int_equal(bt_system_element_find(r.system, ""), -1);
    rig_close(&r);
}

static void state_of_an_unassembled_system_is_refused(void** state) {
    (void)state;
    rig r;
    rig_open(&r, 0, 0, 0);
    free_body(&r, "a");
    assert_int_equal(bt_arena_create(&r.arena, 4096), BT_OK);
    assert_int_equal(bt_state_create(r.system, &r.arena, &r.state), BT_ERR_ARG);
    assert_int_equal(rig_assemble_status(&r), BT_OK);
    bt_arena_destroy(&r.arena);
    assert_int_equal(bt_arena_create(&r.arena, 64), BT_OK);
    assert_int_equal(bt_state_create(r.system, &r.arena, &r.state), BT_ERR_MEMORY);
    rig_close(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mass_must_be_positive),
        cmocka_unit_test(inertia_must_be_positive_definite),
        cmocka_unit_test(inertia_must_obey_the_triangle_inequality),
        cmocka_unit_test(flat_bodies_and_rods_are_accepted),
        cmocka_unit_test(attitude_and_numbers_must_be_there),
        cmocka_unit_test(all_errors_are_reported_at_once),
        cmocka_unit_test(joints_must_make_sense),
        cmocka_unit_test(elements_must_act_on_bodies_that_exist),
        cmocka_unit_test(lengths_that_do_not_reach_are_refused),
        cmocka_unit_test(axes_that_do_not_meet_are_refused),
        cmocka_unit_test(aligned_hinges_of_a_door_are_redundant_not_wrong),
        cmocka_unit_test(bodies_without_joints_are_free),
        cmocka_unit_test(approximate_positions_are_closed_in_the_mass_metric),
        cmocka_unit_test(velocities_that_break_the_joints_are_changed_and_said_so),
        cmocka_unit_test(names_are_found),
        cmocka_unit_test(state_of_an_unassembled_system_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
