/// Strut, wheel, hook damper and centring as elements: equal and opposite, and the power they take
/// is the change of their energy plus what they dissipate, for bodies in any attitude.
#include "elements/hook_damper_element.h"
#include "elements/hook_damper_orifice.h"
#include "elements/strut.h"
#include "elements/wheel.h"
#include "elements/yaw_damper.h"
#include "mechanics/vec.h"
#include "near.h"

/// Two bodies in some motion.
typedef struct scene {
    double q[14], v[12], rotation[18], wrench[12], output[8];
    bt_motion motion;
} scene;

static double random_number(uint32_t* seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / (1 << 23) - 1;
}

static void refresh(scene* s) {
    for (int b = 0; b < 2; ++b) {
        double* e = s->q + 7 * b + 3;
        const double n = sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3]);
        for (int i = 0; i < 4; ++i)
            e[i] /= n;
        bt_rotation_from_euler(e, s->rotation + 9 * b);
    }
    s->motion = (bt_motion){0, s->q, s->v, s->rotation};
}

/// Attitudes within `tilt` of upright, random velocities.
static void shuffle(scene* s, uint32_t* seed, double tilt) {
    for (int i = 0; i < 14; ++i)
        s->q[i] = i % 7 == 3 ? 1 : (i % 7 > 3 ? tilt : 0.3) * random_number(seed);
    for (int i = 0; i < 12; ++i)
        s->v[i] = 2 * random_number(seed);
    refresh(s);
}

/// Moves the scene by its velocities for a time.
static void move(const scene* s, double h, scene* m) {
    *m = *s;
    for (int b = 0; b < 2; ++b) {
        const double* w = s->v + 6 * b + 3;
        const double turn[4] = {0, 0.5 * h * w[0], 0.5 * h * w[1], 0.5 * h * w[2]};
        double change[4];
        bt_euler_multiply(s->q + 7 * b + 3, turn, change);
        for (int i = 0; i < 3; ++i)
            m->q[7 * b + i] += h * s->v[6 * b + i];
        for (int i = 0; i < 4; ++i)
            m->q[7 * b + 3 + i] += change[i];
    }
    refresh(m);
}

static void evaluate(const bt_element* e, scene* s) {
    memset(s->wrench, 0, sizeof s->wrench);
    e->type->force(e, &s->motion, s->wrench, s->output);
}

static double power(const scene* s) {
    double p = 0;
    for (int i = 0; i < 12; ++i)
        p += s->wrench[i] * s->v[i];
    return p;
}

static double energy_rate(const bt_element* e, const scene* s) {
    const double h = 1e-5;
    scene after, before;
    move(s, h, &after);
    move(s, -h, &before);
    return (e->type->energy(e, &after.motion) - e->type->energy(e, &before.motion)) / (2 * h);
}

static void assert_equal_and_opposite(const scene* s) {
    double moment[2][3], total[3];
    for (int b = 0; b < 2; ++b) {
        bt_rotate(s->rotation + 9 * b, s->wrench + 6 * b + 3, moment[b]);
        bt_cross(s->q + 7 * b, s->wrench + 6 * b, total);
        bt_add_scaled(moment[b], 1, total);
    }
    const double scale = bt_norm(s->wrench) + bt_norm(moment[0]) + 1;
    for (int i = 0; i < 3; ++i) {
        BT_ASSERT_NEAR(s->wrench[i], -s->wrench[6 + i], 0, 1e-13 * scale);
        BT_ASSERT_NEAR(moment[0][i], -moment[1][i], 0, 1e-12 * scale);
    }
}

static bt_strut strut_data(void) {
    bt_oleo_params p;
    bt_group_set_defaults(&bt_oleo_group, &p);
    p.orifice_area_m2 = 300e-6;
    bt_strut s = {.point_a_m = {0.1, 0.2, -0.9}, .axis_a = {0.6, 0, 0.8}};
    bt_oleo_prepare(&p, &s.oleo);
    return s;
}

/// The piston on the axis, as the prismatic joint holds it.
static void put_on_axis(const bt_strut* strut, scene* s, double stroke) {
    double root[3], axis[3];
    bt_point_position(&s->motion, 0, strut->point_a_m, root);
    bt_rotate(s->rotation, strut->axis_a, axis);
    for (int k = 0; k < 3; ++k)
        s->q[7 + k] = root[k] + stroke * axis[k];
}

static void strut_forces_are_equal_and_opposite(void** state) {
    (void)state;
    const bt_strut data = strut_data();
    const bt_element e = {&bt_strut_type, "strut", 0, 1, &data};
    uint32_t seed = 3;
    for (int i = 0; i < 100; ++i) {
        scene s;
        shuffle(&s, &seed, 0.5);
        put_on_axis(&data, &s, 0.3);
        evaluate(&e, &s);
        assert_equal_and_opposite(&s);
    }
}

/// Power = -(change of energy) - (dissipation), and the dissipation is F_h times the rate.
static void strut_power_is_energy_and_damping(void** state) {
    (void)state;
    const bt_strut data = strut_data();
    const bt_element e = {&bt_strut_type, "strut", 0, 1, &data};
    uint32_t seed = 5;
    for (int i = 0; i < 100; ++i) {
        scene s;
        shuffle(&s, &seed, 0.2);
        put_on_axis(&data, &s, 0.3);
        evaluate(&e, &s);
        BT_ASSERT_NEAR(s.output[BT_STRUT_STROKE], 0.3, 1e-13, 0);
        const double damping = bt_oleo_oil_force(&data.oleo, 0.3, s.output[BT_STRUT_RATE]);
        BT_ASSERT_NEAR(power(&s), -energy_rate(&e, &s) - damping * s.output[BT_STRUT_RATE], 1e-6,
                       1e-3);
    }
}

static bt_hook_damper_mount mount_data(void) {
    bt_hook_damper_variant p;
    bt_variant_set(&bt_hook_damper_types, 0, (void*)&p);
    bt_hook_damper_mount h = {.length_m = 0.9};
    bt_hook_damper_prepare(&p, &h.damper);
    bt_hook_damper_place(1.2147, 0.417, 1.5708, 0.9, h.point_b_m, h.point_a_m);
    return h;
}

static void eq9_hook_damper_is_equal_and_opposite_and_keeps_the_energy(void** state) {
    (void)state;
    const bt_hook_damper_mount data = mount_data();
    const bt_element e = {&bt_hook_damper_element, "hook_damper", 0, 1, &data};
    uint32_t seed = 7;
    for (int i = 0; i < 100; ++i) {
        scene s;
        shuffle(&s, &seed, 0.3);
        for (int k = 0; k < 3; ++k)
            s.q[7 + k] = s.q[k] + 0.05 * random_number(&seed);
        evaluate(&e, &s);
        assert_equal_and_opposite(&s);
        const double stroke = s.output[BT_HOOK_DAMPER_STROKE], rate = s.output[BT_HOOK_DAMPER_RATE];
        if (fabs(stroke) < 1e-4)
            continue;
        const double damping = bt_hook_damper_orifice_oil((const void*)data.damper.data, rate);
        BT_ASSERT_NEAR(power(&s), -energy_rate(&e, &s) - damping * rate, 1e-5, 0.1);
    }
}

/// At the down stop the damper is extended, and its lever arm is what the drawing says; it presses
/// the hook down; and it shortens as the hook rises.
static void eq9_hook_damper_is_placed_as_drawn(void** state) {
    (void)state;
    const double phi = 1.2147, lever = 0.417, length = 0.9;
    for (double angle = 0.6; angle < 2.6; angle += 0.5) {
        double shank[3], fuselage[3], along[3], moment[3];
        bt_hook_damper_place(phi, lever, angle, length, shank, fuselage);
        double push[3];
        for (int i = 0; i < 3; ++i)
            push[i] = (shank[i] - fuselage[i]) / length;
        BT_ASSERT_NEAR(bt_norm(push), 1, 1e-14, 0);
        BT_ASSERT_NEAR(bt_norm(shank), lever, 1e-14, 0);
        BT_ASSERT_NEAR(-bt_dot(push, shank) / lever, -cos(angle), 1e-12, 1e-14);
        bt_cross(shank, push, moment);
        // The shank points aft: a moment about -y (to starboard) lowers it.
        BT_ASSERT_NEAR(moment[1], -lever * sin(angle), 1e-12, 0);
        const double risen = phi - 1e-6;
        along[0] = -lever * cos(risen) - fuselage[0];
        along[1] = 0;
        along[2] = -lever * sin(risen) - fuselage[2];
        assert_true(bt_norm(along) < length);
    }
}

/// At the hanging angle the moments of damper and weight about the pivot cancel.
static void eq9_hook_hangs_in_balance_on_its_down_stop(void** state) {
    (void)state;
    bt_hook_damper_mount data = mount_data();
    const double weight_moment = 107.9 * 9.8 * 1.293, pitch = 0.1;
    const double shank = bt_hook_damper_hanging_angle(&data.damper, 1.2147, 0.417, 1.5708, 0.9,
                                                      weight_moment, pitch);
    assert_true(shank > 1.2147 && shank < 1.2147 + 0.01);
    // Both bodies with their origin at the pivot; b turned by what the shank hangs below the stop.
    const double turn = 0.5 * (shank - 1.2147);
    const bt_element e = {&bt_hook_damper_element, "hook_damper", 0, 1, &data};
    scene s = {.q = {0, 0, 0, 1, 0, 0, 0, 0, 0, 0, cos(turn), 0, -sin(turn), 0}};
    refresh(&s);
    evaluate(&e, &s);
    assert_true(s.output[BT_HOOK_DAMPER_STROKE] < 0);
    BT_ASSERT_NEAR(s.wrench[10], weight_moment * cos(shank + pitch), 1e-6, 0);
}

static void yaw_damper_is_equal_and_opposite_and_keeps_the_energy(void** state) {
    (void)state;
    const bt_yaw_damper data = {{0, 1, 0}, {0, 0, 1}, {0, 1, 0}, 2e4, 800};
    const bt_element e = {&bt_yaw_damper_element, "yaw_damper", 0, 1, &data};
    uint32_t seed = 11;
    for (int i = 0; i < 100; ++i) {
        // A hook on its universal joint: pitch about y of the fuselage, yaw about its own z.
        scene s;
        shuffle(&s, &seed, 0.3);
        const double pitch = random_number(&seed), yaw = 0.6 * random_number(&seed);
        const double turn_p[4] = {cos(pitch / 2), 0, sin(pitch / 2), 0};
        const double turn_y[4] = {cos(yaw / 2), 0, 0, sin(yaw / 2)};
        double half[4];
        bt_euler_multiply(s.q + 3, turn_p, half);
        bt_euler_multiply(half, turn_y, s.q + 10);
        refresh(&s);
        // Spin of the hook: that of the fuselage, plus pitch about its y and yaw about own z.
        const double pitch_rate = random_number(&seed), yaw_rate = random_number(&seed);
        double world[3], arm[3], y[3] = {0, pitch_rate, 0}, z[3] = {0, 0, yaw_rate};
        bt_rotate(s.rotation, s.v + 3, world);
        bt_rotate(s.rotation, y, arm);
        bt_add_scaled(world, 1, arm);
        bt_unrotate(s.rotation + 9, world, s.v + 9);
        bt_add_scaled(s.v + 9, 1, z);
        evaluate(&e, &s);
        BT_ASSERT_NEAR(s.output[BT_YAW_DAMPER_ANGLE], yaw, 1e-12, 1e-13);
        BT_ASSERT_NEAR(s.output[BT_YAW_DAMPER_RATE], yaw_rate, 1e-12, 1e-12);
        BT_ASSERT_NEAR(s.output[BT_YAW_DAMPER_TORQUE], -2e4 * yaw - 800 * yaw_rate, 1e-11, 1e-9);
        assert_equal_and_opposite(&s);
        BT_ASSERT_NEAR(power(&s), -energy_rate(&e, &s) - 800 * yaw_rate * yaw_rate, 1e-5, 1e-3);
    }
}

static bt_wheel wheel_data(void) {
    bt_tyre_params p;
    bt_group_set_defaults(&bt_tyre_group, &p);
    bt_wheel w = {0};
    bt_tyre_prepare(&p, &w.tyre);
    return w;
}

static void wheel_off_the_ground_has_no_force(void** state) {
    (void)state;
    const bt_wheel data = wheel_data();
    const bt_element e = {&bt_wheel_type, "wheel", 0, BT_GROUND, &data};
    scene s;
    uint32_t seed = 1;
    shuffle(&s, &seed, 0.2);
    s.q[2] = 0.48;
    evaluate(&e, &s);
    for (int i = 0; i < 12; ++i)
        assert_true(s.wrench[i] == 0);
    for (int i = 0; i < BT_WHEEL_OUTPUTS; ++i)
        assert_true(s.output[i] == 0);
}

static void eq6_upright_wheel_carries_the_curve_at_its_deflection(void** state) {
    (void)state;
    const bt_wheel data = wheel_data();
    const bt_element e = {&bt_wheel_type, "wheel", 0, BT_GROUND, &data};
    scene s = {.q = {3, 2, 0.43, 1, 0, 0, 0, 0, 0, 0, 1}};
    s.v[2] = -0.5;
    refresh(&s);
    evaluate(&e, &s);
    BT_ASSERT_NEAR(s.output[BT_WHEEL_DEFLECTION], 0.04, 1e-13, 0);
    BT_ASSERT_NEAR(s.wrench[2], bt_tyre_load(&data.tyre, 0.04) + 2000 * 0.5, 1e-12, 0);
    assert_true(s.wrench[0] == 0 && s.wrench[1] == 0);
}

/// The axle's heading, not the body's, is what matters: any spin about the axle.
static void wheel_does_not_mind_how_far_it_has_turned(void** state) {
    (void)state;
    const bt_wheel data = wheel_data();
    const bt_element e = {&bt_wheel_type, "wheel", 0, BT_GROUND, &data};
    scene s = {.q = {3, 2, 0.43, 0.99, 0.05, 0.02, 0.1, 0, 0, 0, 1}}, t;
    s.v[0] = 40;
    s.v[1] = 2;
    s.v[2] = -1;
    s.v[4] = 60;
    refresh(&s);
    t = s;
    const double turn[4] = {cos(0.7), 0, sin(0.7), 0};
    bt_euler_multiply(s.q + 3, turn, t.q + 3);
    refresh(&t);
    evaluate(&e, &s);
    evaluate(&e, &t);
    for (int i = 0; i < 3; ++i)
        BT_ASSERT_NEAR(t.wrench[i], s.wrench[i], 1e-12, 1e-8);
    for (int i = 0; i < BT_WHEEL_OUTPUTS; ++i)
        BT_ASSERT_NEAR(t.output[i], s.output[i], 1e-12, 1e-8);
}

/// A wheel that slides forward is braked, spins up forward, and one that drifts left is pushed
/// right; with yaw the forces turn with the wheel.
static void eq8_wheel_forces_oppose_sliding_in_the_wheels_own_axes(void** state) {
    (void)state;
    const bt_wheel data = wheel_data();
    const bt_element e = {&bt_wheel_type, "wheel", 0, BT_GROUND, &data};
    for (double yaw = -0.5; yaw <= 0.5; yaw += 0.25) {
        scene s = {.q = {0, 0, 0.43, cos(yaw / 2), 0, 0, sin(yaw / 2), 0, 0, 0, 1}};
        s.v[0] = 40 * cos(yaw);
        s.v[1] = 40 * sin(yaw);
        refresh(&s);
        evaluate(&e, &s);
        const double braking = -0.55 * s.output[BT_WHEEL_NORMAL];
        BT_ASSERT_NEAR(s.output[BT_WHEEL_FORWARD], braking, 1e-3, 0);
        BT_ASSERT_NEAR(s.wrench[0], s.output[BT_WHEEL_FORWARD] * cos(yaw), 1e-12, 1e-9);
        BT_ASSERT_NEAR(s.wrench[1], s.output[BT_WHEEL_FORWARD] * sin(yaw), 1e-12, 1e-9);
        const double radius = 0.47 - 0.04 / 3;
        BT_ASSERT_NEAR(s.wrench[4], -s.output[BT_WHEEL_FORWARD] * radius, 1e-12, 0);
        s.v[4] = 40 / radius; // rolling
        s.v[0] -= 3 * sin(yaw);
        s.v[1] += 3 * cos(yaw);
        evaluate(&e, &s);
        assert_true(s.output[BT_WHEEL_LATERAL] < 0);
    }
}

/// What the deck takes out is the change of the tyre's energy and never negative beyond it.
static void wheel_power_is_energy_and_slip(void** state) {
    (void)state;
    bt_wheel data = wheel_data();
    const bt_element e = {&bt_wheel_type, "wheel", 0, BT_GROUND, &data};
    uint32_t seed = 17;
    for (int i = 0; i < 400; ++i) {
        scene s;
        shuffle(&s, &seed, 0.15);
        s.q[2] = 0.43 + 0.02 * random_number(&seed);
        s.v[0] += 5;
        s.v[4] = 15 * random_number(&seed);
        evaluate(&e, &s);
        if (i % 2) { // no friction: the tyre alone, to the last digit
            data.tyre.friction = data.tyre.locked_friction = data.tyre.damping = 0;
            evaluate(&e, &s);
            BT_ASSERT_NEAR(power(&s), -energy_rate(&e, &s), 1e-6, 1e-2);
            data = wheel_data();
        } else {
            assert_true(power(&s) + energy_rate(&e, &s) <= 1e-2);
        }
    }
}

static void wheel_on_a_belt_feels_the_belts_speed(void** state) {
    (void)state;
    bt_wheel data = wheel_data();
    const bt_element e = {&bt_wheel_type, "wheel", 0, BT_GROUND, &data};
    scene s = {.q = {0, 0, 0.43, 1, 0, 0, 0, 0, 0, 0, 1}};
    scene t = s;
    s.v[0] = 30;
    refresh(&s);
    refresh(&t);
    evaluate(&e, &s);
    data.deck_velocity_mps[0] = -30;
    evaluate(&e, &t);
    for (int i = 0; i < 6; ++i)
        BT_ASSERT_NEAR(t.wrench[i], s.wrench[i], 1e-13, 1e-9);
}

/// The words an element has for a state, "" where its law holds.
static const char* said(const bt_element* e, const double* output, bt_law want) {
    const char* what = "";
    assert_int_equal(e->type->law(e, output, &what), want);
    return what;
}

static void laws_tell_where_they_end(void** state) {
    (void)state;
    const bt_strut strut = strut_data(); // stroke 0.6 m, gas gone at 8.04e-3 / 0.0113 = 0.7115 m
    const bt_element s = {&bt_strut_type, "strut", 0, 1, &strut};
    double output[8] = {0.6};
    assert_string_equal(said(&s, output, BT_LAW_HOLDS), "");
    output[BT_STRUT_STROKE] = 0.6001;
    assert_string_equal(said(&s, output, BT_LAW_AT_LIMIT), "strut bottomed");
    output[BT_STRUT_STROKE] = 0.7116;
    assert_string_equal(said(&s, output, BT_LAW_LEFT), "no gas volume in the strut");

    bt_wheel wheel = wheel_data(); // radius 0.47 m, width 0.292 m
    const bt_element w = {&bt_wheel_type, "tyre", 0, BT_GROUND, &wheel};
    output[BT_WHEEL_DEFLECTION] = 0.292;
    assert_string_equal(said(&w, output, BT_LAW_HOLDS), "");
    output[BT_WHEEL_DEFLECTION] = 0.293;
    assert_string_equal(said(&w, output, BT_LAW_AT_LIMIT), "tyre on its rim");
    output[BT_WHEEL_DEFLECTION] = 0.47;
    assert_string_equal(said(&w, output, BT_LAW_LEFT), "axle at the deck");
    wheel.tyre.bottoming = 0.1;
    output[BT_WHEEL_DEFLECTION] = 0.11;
    assert_string_equal(said(&w, output, BT_LAW_AT_LIMIT), "tyre on its rim");

    const bt_hook_damper_mount mount =
        mount_data(); // stroke 0.6 m, gas gone at 3e-3 / 1.96e-3 = 1.53 m
    const bt_element h = {&bt_hook_damper_element, "hook_damper", 0, 1, &mount};
    output[BT_HOOK_DAMPER_STROKE] = -0.01; // on the down stop it always is
    assert_string_equal(said(&h, output, BT_LAW_HOLDS), "");
    output[BT_HOOK_DAMPER_STROKE] = 0.61;
    assert_string_equal(said(&h, output, BT_LAW_AT_LIMIT), "hook damper bottomed");
    output[BT_HOOK_DAMPER_STROKE] = 1.54;
    assert_string_equal(said(&h, output, BT_LAW_LEFT), "no gas volume in the hook damper");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strut_forces_are_equal_and_opposite),
        cmocka_unit_test(strut_power_is_energy_and_damping),
        cmocka_unit_test(eq9_hook_damper_is_equal_and_opposite_and_keeps_the_energy),
        cmocka_unit_test(eq9_hook_damper_is_placed_as_drawn),
        cmocka_unit_test(eq9_hook_hangs_in_balance_on_its_down_stop),
        cmocka_unit_test(yaw_damper_is_equal_and_opposite_and_keeps_the_energy),
        cmocka_unit_test(wheel_off_the_ground_has_no_force),
        cmocka_unit_test(eq6_upright_wheel_carries_the_curve_at_its_deflection),
        cmocka_unit_test(wheel_does_not_mind_how_far_it_has_turned),
        cmocka_unit_test(eq8_wheel_forces_oppose_sliding_in_the_wheels_own_axes),
        cmocka_unit_test(wheel_power_is_energy_and_slip),
        cmocka_unit_test(wheel_on_a_belt_feels_the_belts_speed),
        cmocka_unit_test(laws_tell_where_they_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
