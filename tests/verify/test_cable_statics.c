/// The cable at rest against closed forms: elastic catenary, elastica, roll-up, twist.
#include "test_cable_case.h"

#define PI 3.14159265358979323846

/* Code_Aster SSNL114 (V6.05.116): 325 m unstretched over a span of 325 m. The reference is the
   elastic catenary evaluated to rounding (validation data D.1). */
static void hang(int count, double error[3]) {
    const double area = 2.2783e-4;
    bt_cable_def def = rope_def(count, 325);
    def.axial_stiffness_N = 5.70e10 * area;
    def.mass_kgpm = 2844.23 * area;
    def.bending_stiffness_Nm2 = 0;
    def.gravity_mps2 = 9.81;
    def.end[0].kind = def.end[1].kind = BT_CABLE_PINNED;
    rope r;
    rope_open(&r, &def, 325);
    double left, at[3];
    assert_int_equal(bt_cable_equilibrium(&r.model, &r.state, &left, NULL), BT_OK);
    assert_true(left < 1e-6);
    rope_joint(&r, count / 2, at);
    error[0] = at[2] / -6.3521614697 - 1;
    error[1] = r.state.joint_fy[count / 2] / 13206.239149 - 1;
    const double end = hypot(r.state.joint_fy[0], r.state.joint_fz[0]);
    error[2] = end / 13246.578050 - 1;
    rope_close(&r);
}

static void elastic_catenary_ssnl114_sag_and_tension(void** state) {
    (void)state;
    double error[3][3];
    for (int k = 0; k < 3; ++k)
        hang(50 << k, error[k]);
    for (int q = 0; q < 3; ++q) {
        const double e[3] = {error[0][q], error[1][q], error[2][q]};
        print_message("catenary, quantity %d: errors %.3g %.3g %.3g\n", q, e[0], e[1], e[2]);
        assert_true(fabs(e[2]) < 1e-5);
        if (q < 2) { /* the end tension is already at the digits of the reference */
            assert_true(order_of(e) > 1.8);
        }
    }
}

/// Span and rise of an elastic catenary from the horizontal pull H and the vertical pull V at the
/// upper (far) end: closed form (Irvine, Cable Structures, 1981).
static void catenary(double h, double v, double weight, double ea, double length, double at[2]) {
    const double low = v - weight; /* vertical pull at the near end */
    const double per_m = weight / length;
    at[0] = h * length / ea + h / per_m * (asinh(v / h) - asinh(low / h));
    at[1] = length / ea * (v - 0.5 * weight) + (hypot(h, v) - hypot(h, low)) / per_m;
}

/// The pulls that reach span and rise, by Newton's method with differences.
static void pulls_of(double span, double rise, double weight, double ea, double length,
                     double pull[2]) {
    pull[0] = 0.25 * weight * span / length;
    pull[1] = 0.5 * weight;
    for (int k = 0; k < 300; ++k) {
        const double dh = 1e-5 * pull[0], dv = 1e-5 * weight;
        double at[2], by_h[2], by_v[2];
        catenary(pull[0], pull[1], weight, ea, length, at);
        catenary(pull[0] + dh, pull[1], weight, ea, length, by_h);
        catenary(pull[0], pull[1] + dv, weight, ea, length, by_v);
        const double a = (by_h[0] - at[0]) / dh, b = (by_v[0] - at[0]) / dv;
        const double c = (by_h[1] - at[1]) / dh, d = (by_v[1] - at[1]) / dv;
        const double ex = at[0] - span, ez = at[1] - rise, det = a * d - b * c;
        const double step_h = (d * ex - b * ez) / det, step_v = (a * ez - c * ex) / det;
        const double part = fmin(1, 0.3 * pull[0] / fabs(step_h));
        pull[0] -= part * step_h;
        pull[1] -= part * step_v;
    }
}

static void elastic_catenaries_taut_to_slack_with_ends_at_any_height(void** state) {
    (void)state;
    const double span = 10, ratios[] = {1.002, 1.05, 1.21, 1.5, 3, 5}, rises[] = {0, 0.05, 2.5};
    for (int q = 0; q < 6; ++q)
        for (int k = 0; k < 3; ++k) {
            if (hypot(span, rises[k]) > 0.999 * ratios[q] * span)
                continue;
            bt_cable_def def = rope_def(200, 1);
            def.bending_stiffness_Nm2 = 0;
            def.gravity_mps2 = 9.81;
            def.axial_stiffness_N = 1e6;
            def.end[0].kind = def.end[1].kind = BT_CABLE_PINNED;
            def.end[1].anchor_m[1] = span;
            def.end[1].anchor_m[2] = rises[k];
            rope r;
            rope_open(&r, &def, ratios[q] * span);
            assert_int_equal(bt_cable_equilibrium(&r.model, &r.state, NULL, NULL), BT_OK);
            double pull[2];
            pulls_of(span, rises[k], 5.536 * 9.81 * ratios[q] * span, 1e6, ratios[q] * span, pull);
            BT_ASSERT_NEAR(r.state.joint_fy[100], pull[0], 2e-5, 0);
            BT_ASSERT_NEAR(r.state.joint_fz[200], pull[1], 2e-5, 0);
            rope_close(&r);
        }
}

/* Cantilever with a dead tip load across it: validation data D.5. */
static void bend(int count, double load, double out[3]) {
    bt_cable_def def = rope_def(count, 1);
    def.diameter_m = 0.01;
    def.mass_kgpm = 1;
    def.bending_stiffness_Nm2 = 1;
    def.axial_stiffness_N = 1e7;
    def.end[0].kind = BT_CABLE_CLAMPED;
    rope r;
    rope_open(&r, &def, 1);
    const int last = count - 1;
    double tip[3];
    for (int ramp = 1; ramp <= 5; ++ramp)
        for (int k = 0; k < 12; ++k) { /* the arm of the tip load follows the last segment */
            const double force[3] = {0, 0, load * ramp / 5};
            rope_tip(&r, tip);
            bt_cable_clear_loads(&r.model, &r.state);
            bt_cable_add_load(&r.state, last, force, tip);
            assert_int_equal(bt_cable_equilibrium(&r.model, &r.state, NULL, NULL), BT_OK);
        }
    rope_tip(&r, tip);
    out[0] = tip[2];
    out[1] = 1 - tip[1];
    out[2] = atan2(r.state.tz[last], r.state.ty[last]);
    rope_close(&r);
}

/// Eq. 14.
static void elastica_tip_of_a_cantilever_large_rotation(void** state) {
    (void)state;
    const double cases[4][4] = {
        {0.25, 0.082745915354417, 0.0041178184099758, 0.12429244211364},
        {1, 0.30172077379981, 0.056433236283377, 0.46135194971188},
        {2, 0.49345748039671, 0.16064172082517, 0.78174983155654},
        {5, 0.71379152361191, 0.38762836072443, 1.2153681176117},
    };
    for (int c = 0; c < 4; ++c) {
        double error[3][3];
        for (int k = 0; k < 3; ++k) {
            double got[3];
            bend(20 << k, cases[c][0], got);
            for (int q = 0; q < 3; ++q)
                error[q][k] = got[q] / cases[c][1 + q] - 1;
        }
        for (int q = 0; q < 3; ++q) {
            print_message("elastica %g, quantity %d: errors %.3g %.3g %.3g\n", cases[c][0], q,
                          error[q][0], error[q][1], error[q][2]);
            assert_true(fabs(error[q][2]) < 3e-4);
            assert_true(order_of(error[q]) > 1.7);
        }
    }
}

static void roll_up_to_a_full_circle_by_an_end_moment(void** state) {
    (void)state;
    const int count = 40, last = count - 1;
    bt_cable_def def = rope_def(count, 10);
    def.bending_stiffness_Nm2 = 100;
    def.end[0].kind = BT_CABLE_CLAMPED;
    rope r;
    rope_open(&r, &def, 10);
    for (int ramp = 1; ramp <= 16; ++ramp) {
        const double t = 2 * PI * ramp / 16;
        r.state.mx[last] = t * 100 / 10;
        assert_int_equal(bt_cable_equilibrium(&r.model, &r.state, NULL, NULL), BT_OK);
        double tip[3];
        rope_tip(&r, tip);
        /* exact: y = L sin t / t, z = L (1 - cos t) / t. A polygon of n sides on the arc t is
           longer by (t / 2n) / sin(t / 2n) */
        const double side = (t / (2 * count)) / sin(t / (2 * count));
        BT_ASSERT_NEAR(tip[1] / side, 10 * sin(t) / t, 0, 1e-8);
        BT_ASSERT_NEAR(tip[2] / side, 10 * (1 - cos(t)) / t, 0, 1e-8);
    }
    rope_close(&r);
}

/// Eq. 16.
static void twist_of_a_rod_under_an_end_torque(void** state) {
    (void)state;
    const int count = 20, last = count - 1;
    bt_cable_def def = rope_def(count, 2);
    def.twist_damping_Nm2s = 0.06;
    def.end[0].kind = BT_CABLE_CLAMPED;
    rope r;
    rope_open(&r, &def, 2);
    r.state.my[last] = 15; /* M L / GJ = 0.5 rad at the tip, without the half segment beyond */
    rope_run(&r, 200000, r.model.stable_step_s);
    const double angle = 2 * atan2(r.state.e2[last], r.state.e0[last]);
    BT_ASSERT_NEAR(angle, 15.0 / 60 * (2 - 0.05), 1e-6, 0);
    for (int i = 0; i < count; ++i) /* nothing bends and nothing moves */
        BT_ASSERT_NEAR(fabs(r.state.x[i]) + fabs(r.state.z[i]), 0, 0, 1e-12);
    rope_close(&r);
}

/* ---- the arresting cable ---- */

static void open_cable(rope* r, const bt_cable_params* p) {
    static double length[BT_CABLE_SEGMENTS_MAX];
    bt_cable_def def;
    bt_cable_def_init(&def, p, 9.80665, length);
    assert_int_equal(bt_arena_create(&r->arena, bt_cable_memory(def.count, 2)), BT_OK);
    assert_int_equal(bt_cable_model_init(&r->model, &def, &r->arena, NULL), BT_OK);
    assert_int_equal(bt_cable_state_init(&r->model, &r->state, &r->arena), BT_OK);
}

static void sag_between_supports_is_the_catenary_s(void** state) {
    (void)state;
    bt_cable_params p;
    bt_group_set_defaults(&bt_cable_group, &p);
    p.bending_stiffness_Nm2 = 0;
    p.supports.stiffness_Npm = 5e6;
    rope r;
    open_cable(&r, &p);
    double left, middle[3], support[3];
    assert_int_equal(bt_cable_equilibrium(&r.model, &r.state, &left, NULL), BT_OK);
    rope_joint(&r, r.model.count / 2, middle);
    assert_true(bt_cable_centreline(&r.model, &r.state, 6.0, -1, support, NULL, NULL) >= 0);
    const double h = r.state.joint_fy[r.model.count / 2], w = p.mass_kgpm * 9.80665;
    const double sag = h / w * (cosh(w * 6.0 / h) - 1);
    BT_ASSERT_NEAR(support[2] - middle[2], sag, 4e-3, 0);
    rope_close(&r);
}

static void cable_at_rest_stays_at_rest_and_carries_its_weight(void** state) {
    (void)state;
    bt_cable_params p;
    bt_group_set_defaults(&bt_cable_group, &p);
    rope r;
    open_cable(&r, &p);
    double left;
    assert_int_equal(bt_cable_equilibrium(&r.model, &r.state, &left, NULL), BT_OK);
    assert_true(left < 1e-5); /* rounding: EA / l times the spacing of doubles at 18 m is 4e-6 N */
    for (int side = 0; side < 2; ++side)
        BT_ASSERT_NEAR(r.state.scalars->end_tension_N[side], p.pretension_N, 1e-9, 0);
    double weight = 0, carried = r.state.joint_fz[r.model.count] - r.state.joint_fz[0];
    for (int i = 0; i < r.model.count; ++i) {
        weight += r.model.mass_kg[i] * 9.80665;
        carried += r.state.support_fz[i];
    }
    BT_ASSERT_NEAR(carried, weight, 1e-7, 0);
    bt_cable_state start;
    assert_int_equal(bt_cable_state_init(&r.model, &start, &r.arena), BT_OK);
    bt_cable_state_copy(&r.model, &start, &r.state);
    rope_run(&r, 10000, r.model.stable_step_s);
    for (int i = 0; i < r.model.count; ++i) {
        BT_ASSERT_NEAR(r.state.x[i], start.x[i], 0, 1e-9);
        BT_ASSERT_NEAR(r.state.y[i], start.y[i], 0, 1e-9);
        BT_ASSERT_NEAR(r.state.z[i], start.z[i], 0, 1e-9);
    }
    rope_close(&r);
}

static void cable_at_rest_is_mirror_symmetric_to_the_bit(void** state) {
    (void)state;
    bt_cable_params p;
    bt_group_set_defaults(&bt_cable_group, &p);
    rope r;
    open_cable(&r, &p);
    assert_int_equal(bt_cable_equilibrium(&r.model, &r.state, NULL, NULL), BT_OK);
    for (int i = 0, j = r.model.count - 1; i < j; ++i, --j) {
        assert_true(r.state.y[i] == -r.state.y[j] && r.state.z[i] == r.state.z[j]);
        assert_true(r.state.e0[i] == r.state.e0[j] && r.state.e1[i] == -r.state.e1[j]);
        assert_true(r.state.x[i] == 0 && r.state.e2[i] == 0 && r.state.e3[i] == 0);
    }
    rope_close(&r);
}

static void rest_shape_converges_with_the_segments(void** state) {
    (void)state;
    double middle[3];
    for (int k = 0; k < 3; ++k) {
        bt_cable_params p;
        bt_group_set_defaults(&bt_cable_group, &p);
        p.mesh.fine_length_m = 0.2 / (1 << k);
        p.mesh.medium_length_m = 0.2 / (1 << k);
        p.mesh.coarse_length_m = 0.2 / (1 << k);
        rope r;
        open_cable(&r, &p);
        assert_int_equal(bt_cable_equilibrium(&r.model, &r.state, NULL, NULL), BT_OK);
        double at[3];
        assert_true(bt_cable_centreline(&r.model, &r.state, 0, -1, at, NULL, NULL) >= 0);
        middle[k] = at[2];
        rope_close(&r);
    }
    print_message("height of the middle at 0.2, 0.1, 0.05 m: %.9f %.9f %.9f\n", middle[0],
                  middle[1], middle[2]);
    assert_true(fabs(middle[2] - middle[1]) < 1e-4);
    assert_true(fabs(middle[2] - middle[1]) < 0.5 * fabs(middle[1] - middle[0]));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elastic_catenary_ssnl114_sag_and_tension),
        cmocka_unit_test(elastic_catenaries_taut_to_slack_with_ends_at_any_height),
        cmocka_unit_test(elastica_tip_of_a_cantilever_large_rotation),
        cmocka_unit_test(roll_up_to_a_full_circle_by_an_end_moment),
        cmocka_unit_test(twist_of_a_rod_under_an_end_torque),
        cmocka_unit_test(sag_between_supports_is_the_catenary_s),
        cmocka_unit_test(cable_at_rest_stays_at_rest_and_carries_its_weight),
        cmocka_unit_test(cable_at_rest_is_mirror_symmetric_to_the_bit),
        cmocka_unit_test(rest_shape_converges_with_the_segments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
