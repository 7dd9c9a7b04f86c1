/// A shank that bends at one sprung joint: the hook's mass in two parts, a cantilever's deflection,
/// its frequency, the load of an impact, and the rigid shank as its limit.
#include "elements/hook_damper_orifice.h"
#include "reference.h"

#include "elements/torque.h"
#include "landing/airframe.h"
#include "landing/shank.h"
#include "mechanics/vec.h"

static bt_hook_params reference_hook(double bending_Nm2) {
    bt_hook_params hook = reference_model(NULL, 0).aircraft.hook;
    hook.shank_bending_stiffness_Nm2 = bending_Nm2;
    return hook;
}

static double about_pivot(const bt_shank_part* part) {
    return part->inertia_kgm2 + part->mass_kg * part->centre_m * part->centre_m;
}

static void both_parts_together_are_the_hook(void** state) {
    (void)state;
    const bt_hook_params hook = reference_hook(1e6);
    bt_shank s;
    bt_shank_prepare(&hook, &s);
    assert_true(s.bends && bt_shank_is_sound(&s));
    BT_ASSERT_NEAR(s.root.mass_kg + s.head.mass_kg, hook.mass_kg, 1e-14, 0);
    BT_ASSERT_NEAR(s.root.mass_kg * s.root.centre_m + s.head.mass_kg * s.head.centre_m,
                   hook.mass_kg * hook.mass_centre_m, 1e-14, 0);
    BT_ASSERT_NEAR(about_pivot(&s.root) + about_pivot(&s.head), hook.inertia_kgm2, 1e-14, 0);
    BT_ASSERT_NEAR(s.root.axial_inertia_kgm2 + s.head.axial_inertia_kgm2, hook.axial_inertia_kgm2,
                   1e-14, 0);
    assert_true(s.root.centre_m < s.joint_m && s.head.centre_m > s.joint_m);
}

static void a_uniform_rod_is_cut_into_uniform_rods(void** state) {
    (void)state;
    bt_hook_params hook = reference_hook(1e6);
    hook.mass_centre_m = hook.length_m / 2;
    hook.inertia_kgm2 = hook.mass_kg * hook.length_m * hook.length_m / 3;
    bt_shank s;
    bt_shank_prepare(&hook, &s);
    const double out = hook.length_m - s.joint_m, mass = hook.mass_kg * out / hook.length_m;
    BT_ASSERT_NEAR(s.head.mass_kg, mass, 1e-13, 0);
    BT_ASSERT_NEAR(s.head.centre_m, s.joint_m + out / 2, 1e-13, 0);
    BT_ASSERT_NEAR(s.head.inertia_kgm2, mass * out * out / 12, 1e-12, 0);
    BT_ASSERT_NEAR(s.root.inertia_kgm2, (hook.mass_kg - mass) * s.joint_m * s.joint_m / 12, 1e-12,
                   0);
}

static void a_rigid_shank_is_one_part(void** state) {
    (void)state;
    const bt_hook_params hook = reference_hook(0);
    bt_shank s;
    bt_shank_prepare(&hook, &s);
    assert_false(s.bends);
    assert_true(s.head.mass_kg == hook.mass_kg && s.head.centre_m == hook.mass_centre_m);
    BT_ASSERT_NEAR(about_pivot(&s.head), hook.inertia_kgm2, 1e-14, 0);
    assert_true(bt_shank_frequency2(&s) == 0);
}

/// Deflection F l^3 / (3 EI) and slope F l^2 / (2 EI) at the shoe, the hook held at the damper. The
/// head part on its spring, the root fixed: settles there when loaded.
static void a_load_at_the_shoe_bends_it_as_a_cantilever(void** state) {
    (void)state;
    const double bending = 1e6, load = 2000;
    const bt_hook_params hook = reference_hook(bending);
    bt_shank s;
    bt_shank_prepare(&hook, &s);
    const double free_m = hook.length_m - hook.damper_lever_m, arm = s.head.centre_m - s.joint_m;
    bt_system* system;
    assert_int_equal(bt_system_create(&system), BT_OK);
    const int head = bt_system_add_body(
        system, &(bt_body_def){.name = "head",
                               .mass_kg = s.head.mass_kg,
                               .inertia_kgm2 = {1, s.head.inertia_kgm2, s.head.inertia_kgm2},
                               .position_m = {-arm, 0, 0},
                               .attitude = {1, 0, 0, 0}});
    bt_system_add_joint(system, &(bt_joint_def){.name = "joint",
                                                .kind = BT_JOINT_REVOLUTE,
                                                .body_a = BT_GROUND,
                                                .body_b = head,
                                                .point_b_m = {arm, 0, 0},
                                                .axis_a = {0, 1, 0},
                                                .axis_b = {0, 1, 0}});
    const double inertia = s.head.inertia_kgm2 + s.head.mass_kg * arm * arm;
    const bt_torsion spring = {.axis = {0, 1, 0},
                               .stiffness_Nmprad = s.stiffness_Nmprad,
                               .damping_Nmsprad = 2 * sqrt(s.stiffness_Nmprad * inertia)};
    const bt_follower push = {.point_b_m = {s.head.centre_m - hook.length_m, 0, 0},
                              .force_N = {0, 0, load}};
    bt_system_add_element(system, &(bt_element){.type = &bt_torsion_element,
                                                .name = "spring",
                                                .body_a = BT_GROUND,
                                                .body_b = head,
                                                .data = &spring});
    bt_system_add_element(system, &(bt_element){.type = &bt_follower_element,
                                                .name = "push",
                                                .body_a = BT_GROUND,
                                                .body_b = head,
                                                .data = &push});
    assert_int_equal(bt_system_assemble(system, NULL), BT_OK);
    bt_arena arena;
    bt_state motion;
    assert_int_equal(bt_arena_create(&arena, bt_state_size(system)), BT_OK);
    assert_int_equal(bt_state_create(system, &arena, &motion), BT_OK);
    for (int i = 0; i < 20000; ++i)
        assert_int_equal(bt_system_step(system, &motion, 1e-4, BT_INTEGRATOR_SECOND_ORDER, NULL),
                         BT_OK);
    const double* a = motion.rotation;
    const double shoe = motion.q[2] + a[6] * (s.head.centre_m - hook.length_m);
    // angles of 3 mrad: sine and tangent agree to 1e-5
    BT_ASSERT_NEAR(shoe, load * pow(free_m, 3) / (3 * bending), 1e-5, 0);
    BT_ASSERT_NEAR(asin(-a[6]), load * free_m * free_m / (2 * bending), 1e-5, 0);
    bt_arena_destroy(&arena);
    bt_system_destroy(system);
}

/// Turns about the pivot and the joint, the damper's stop a spring about the pivot: both angular
/// frequencies squared from M^-1 K of the two angles.
static void frequencies(const bt_shank* s, double about_pivot_Nmprad, double omega2[2]) {
    const double arm = s->head.centre_m - s->joint_m, m = s->head.mass_kg, k = s->stiffness_Nmprad;
    const double m11 = about_pivot(&s->root) + m * s->joint_m * s->joint_m;
    const double m22 = s->head.inertia_kgm2 + m * arm * arm, m12 = m * s->joint_m * arm;
    const double a = m11 * m22 - m12 * m12;
    const double b = (about_pivot_Nmprad + k) * m22 + k * m11 + 2 * k * m12;
    const double c = about_pivot_Nmprad * k, root = sqrt(b * b - 4 * a * c);
    omega2[0] = (b - root) / (2 * a);
    omega2[1] = (b + root) / (2 * a);
}

/// The whole aircraft in the glide, heavy and so at rest, the damper's stop stiff: the head is
/// given a turn and swings.
static void the_head_swings_at_the_frequency_of_the_two_parts(void** state) {
    (void)state;
    bt_model_params model = REFERENCE("landing.pitch=0 deg");
    model.aircraft.mass_kg = 2.2e7;
    model.aircraft.inertia_xx_kgm2 = model.aircraft.inertia_yy_kgm2 = 1e9;
    model.aircraft.inertia_zz_kgm2 = 1e9;
    model.aircraft.hook.shank_bending_stiffness_Nm2 = 1e6;
    model.aircraft.hook.shank_damping_ratio = 0;
    bt_hook_damper_orifice_params* damper = (void*)model.aircraft.hook.damper.params;
    damper->stop_stiffness_Npm = 2e9;
    bt_airframe f;
    bt_arena arena;
    bt_state hanging, motion;
    bt_glide glide;
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    if (bt_airframe_build(&model.aircraft, 9.81, 0.0175, &f, &diag) != BT_OK)
        fail_msg("refused: %s", kept.text);
    assert_int_equal(bt_arena_create(&arena, 4 * bt_state_size(f.system)), BT_OK);
    assert_int_equal(bt_state_create(f.system, &arena, &hanging), BT_OK);
    assert_int_equal(bt_state_create(f.system, &arena, &motion), BT_OK);
    bt_airframe_place(&f, &model.landing, &hanging, &motion, &glide);
    bt_airframe_move(&f, (double[]){0, 0, 10}, &motion);
    const int spring = bt_system_element_find(f.system, "shank_spring");
    assert_true(spring >= 0 && f.body_count == BT_BODY_COUNT + 1);
    bt_failure failure;
    assert_int_equal(bt_system_evaluate(f.system, &motion, &failure), BT_OK);
    const double rest = bt_system_element_output(f.system, &motion, spring)[BT_TORSION_ANGLE];
    const double step = 2e-5, lever = model.aircraft.hook.damper_lever_m;
    // the head turns about the joint
    const double turn[3] = {0, 0.02, 0}, arm_m = f.shank.joint_m - f.shank.head.centre_m;
    const double* shank = motion.rotation + 9 * BT_BODY_HOOK;
    const double arm[3] = {arm_m * shank[0], arm_m * shank[3], arm_m * shank[6]};
    double velocity[3];
    bt_cross(turn, arm, velocity);
    bt_add_scaled(motion.v + 6 * BT_BODY_HOOK, 1, velocity);
    motion.v[6 * BT_BODY_HOOK + 4] += turn[1];
    assert_int_equal(bt_system_project(f.system, &motion, &failure), BT_OK);
    double omega2[2], first_s = 0, last_s = 0, before = 0;
    int crossings = 0;
    frequencies(&f.shank, damper->stop_stiffness_Npm * lever * lever, omega2);
    for (double t = 0; t < 0.5; t += step) {
        assert_int_equal(
            bt_system_step(f.system, &motion, step, BT_INTEGRATOR_SECOND_ORDER, &failure), BT_OK);
        const double now =
            bt_system_element_output(f.system, &motion, spring)[BT_TORSION_ANGLE] - rest;
        if (before < 0 && now >= 0) {
            last_s = t + step * now / (before - now) + step;
            first_s = crossings++ ? first_s : last_s;
        }
        before = now;
    }
    assert_true(crossings > 4);
    const double pi = acos(-1.0);
    BT_ASSERT_NEAR((last_s - first_s) / (crossings - 1), 2 * pi / sqrt(omega2[0]), 2e-3, 0);
    bt_airframe_destroy(&f);
    bt_arena_destroy(&arena);
}

/// First impact on the deck, for a shank and the steps it bears.
static bt_landing_result touch_down(double bending_Nm2, double step_s) {
    bt_model_params model = REFERENCE("landing.distance=14 m");
    model.aircraft.hook.shank_bending_stiffness_Nm2 = bending_Nm2;
    model.landing.solver.airframe_step_s = step_s;
    model.landing.solver.contact_step_s = fmin(step_s, model.landing.solver.contact_step_s);
    assert_int_equal(bt_group_check(&bt_model_group, &model, "", NULL), BT_OK);
    bt_lander* lander = new_lander();
    const bt_landing_result result = land(lander, &model, NULL, NULL);
    bt_lander_destroy(lander);
    return result;
}

/// A Hertz impact has a peak that goes with m^0.6: the joint halves the mass that the deck meets,
/// and is too slow (20 Hz) to have a say in 4 ms.
static void an_impact_meets_the_head_with_a_slack_joint(void** state) {
    (void)state;
    const bt_hook_params rigid = reference_hook(0), bending = reference_hook(1e6);
    bt_shank one, two;
    bt_shank_prepare(&rigid, &one);
    bt_shank_prepare(&bending, &two);
    const double angle = rigid.down_stop_rad - reference_model(NULL, 0).landing.pitch_rad;
    const double ratio = bt_shank_effective_mass(&two, rigid.length_m, angle) /
                         bt_shank_effective_mass(&one, rigid.length_m, angle);
    assert_true(ratio > 0.4 && ratio < 0.6);
    const double force =
        touch_down(1e6, 4e-4).hook_deck_force_peak_N / touch_down(0, 4e-4).hook_deck_force_peak_N;
    BT_ASSERT_NEAR(force, pow(ratio, 0.6), 0.02, 0);
}

static void a_stiff_shank_is_a_rigid_one(void** state) {
    (void)state;
    const bt_landing_result rigid = touch_down(0, 2e-5);
    double force[2], height[2];
    for (int k = 0; k < 2; ++k) {
        const bt_landing_result r = touch_down(k ? 1e9 : 2.5e8, 2e-5);
        force[k] = fabs(r.hook_deck_force_peak_N / rigid.hook_deck_force_peak_N - 1);
        height[k] = fabs(r.bounces[0].height_m / rigid.bounces[0].height_m - 1);
    }
    // with 1 / EI
    assert_true(force[1] < 0.03 && height[1] < 0.06);
    assert_true(force[1] < 0.4 * force[0] && height[1] < 0.6 * height[0]);
}

static void what_cannot_be_cut_is_refused(void** state) {
    (void)state;
    bt_model_params model = reference_model(NULL, 0);
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    model.aircraft.hook.shank_bending_stiffness_Nm2 = 100;
    assert_int_equal(bt_group_check(&bt_model_group, &model, "", &diag), BT_ERR_INPUT);
    assert_non_null(strstr(kept.text, "0 is a rigid shank"));
    // all the mass at half the length: no density of that kind
    model.aircraft.hook.shank_bending_stiffness_Nm2 = 1e6;
    model.aircraft.hook.mass_centre_m = 0.05;
    model.aircraft.hook.inertia_kgm2 = 0.3;
    kept.text[0] = 0;
    assert_int_equal(bt_group_check(&bt_model_group, &model, "", &diag), BT_ERR_INPUT);
    assert_non_null(strstr(kept.text, "one of the two parts of the shank"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_parts_together_are_the_hook),
        cmocka_unit_test(a_uniform_rod_is_cut_into_uniform_rods),
        cmocka_unit_test(a_rigid_shank_is_one_part),
        cmocka_unit_test(a_load_at_the_shoe_bends_it_as_a_cantilever),
        cmocka_unit_test(the_head_swings_at_the_frequency_of_the_two_parts),
        cmocka_unit_test(an_impact_meets_the_head_with_a_slack_joint),
        cmocka_unit_test(a_stiff_shank_is_a_rigid_one),
        cmocka_unit_test(what_cannot_be_cut_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
