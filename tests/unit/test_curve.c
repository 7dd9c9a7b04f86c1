#include "elements/curve.h"
#include "near.h"

static const double pin_x[] = {0, 0.09, 0.45, 0.60}, pin_y[] = {375e-6, 300e-6, 200e-6, 160e-6};

static void curve_passes_through_its_rows(void** state) {
    (void)state;
    for (int law = BT_CURVE_SMOOTH; law <= BT_CURVE_STEPPED; ++law) {
        bt_curve c;
        bt_curve_make(&c, (bt_curve_law)law, 4, pin_x, pin_y);
        for (int i = 0; i < 4; ++i)
            BT_ASSERT_NEAR(bt_curve_value(&c, pin_x[i]), pin_y[i], 1e-15, 0);
    }
}

static void curve_holds_its_end_values_beyond_the_ends(void** state) {
    (void)state;
    bt_curve c;
    bt_curve_make(&c, BT_CURVE_SMOOTH, 4, pin_x, pin_y);
    assert_true(bt_curve_value(&c, -1) == pin_y[0]);
    assert_true(bt_curve_value(&c, 9) == pin_y[3]);
}

/// Random tables, monotone or not: between two rows the curve stays between their values.
static void smooth_curve_never_overshoots(void** state) {
    (void)state;
    uint32_t seed = 1;
    for (int round = 0; round < 300; ++round) {
        double x[12], y[12];
        for (int i = 0; i < 12; ++i) {
            seed = seed * 1664525u + 1013904223u;
            x[i] = (i ? x[i - 1] : 0) + 1e-3 + (seed >> 8) * 1e-8;
            seed = seed * 1664525u + 1013904223u;
            y[i] = 1e-5 + (seed >> 8) * 1e-9;
        }
        bt_curve c;
        bt_curve_make(&c, BT_CURVE_SMOOTH, 12, x, y);
        for (int i = 0; i + 1 < 12; ++i)
            for (int k = 1; k < 50; ++k) {
                const double v = bt_curve_value(&c, x[i] + (x[i + 1] - x[i]) * k / 50);
                const double slack = 1e-15;
                assert_true(v >= fmin(y[i], y[i + 1]) - slack);
                assert_true(v <= fmax(y[i], y[i + 1]) + slack);
            }
    }
}

static void smooth_curve_has_a_continuous_slope(void** state) {
    (void)state;
    bt_curve c;
    bt_curve_make(&c, BT_CURVE_SMOOTH, 4, pin_x, pin_y);
    for (int i = 1; i < 3; ++i) {
        const double h = 1e-6, at = pin_y[i];
        const double left = (at - bt_curve_value(&c, pin_x[i] - h)) / h;
        const double right = (bt_curve_value(&c, pin_x[i] + h) - at) / h;
        BT_ASSERT_NEAR(left, right, 1e-4, 0); // the difference is h times the jump of curvature
    }
}

static void slope_is_the_derivative_of_the_smooth_curve(void** state) {
    (void)state;
    bt_curve c;
    bt_curve_make(&c, BT_CURVE_SMOOTH, 4, pin_x, pin_y);
    const double h = 1e-6;
    for (double at = 0.013; at < 0.6; at += 0.031)
        BT_ASSERT_NEAR((bt_curve_value(&c, at + h) - bt_curve_value(&c, at - h)) / (2 * h),
                       bt_curve_slope(&c, at), 1e-7, 1e-12);
    assert_true(bt_curve_slope(&c, 9) == c.slope[3] && bt_curve_slope(&c, -1) == c.slope[0]);
}

static void smooth_curve_reproduces_a_straight_line(void** state) {
    (void)state;
    const double x[] = {0, 1, 3, 4}, y[] = {1, 3, 7, 9};
    bt_curve c;
    bt_curve_make(&c, BT_CURVE_SMOOTH, 4, x, y);
    for (double at = 0; at <= 4; at += 0.125)
        BT_ASSERT_NEAR(bt_curve_value(&c, at), 1 + 2 * at, 1e-15, 0);
}

static void stepped_curve_holds_a_row_until_the_next(void** state) {
    (void)state;
    bt_curve c;
    bt_curve_make(&c, BT_CURVE_STEPPED, 4, pin_x, pin_y);
    assert_true(bt_curve_value(&c, 0.0899) == pin_y[0]);
    assert_true(bt_curve_value(&c, 0.09) == pin_y[1]);
}

static void integral_is_the_antiderivative(void** state) {
    (void)state;
    for (int law = BT_CURVE_SMOOTH; law <= BT_CURVE_LINEAR; ++law) {
        bt_curve c;
        bt_curve_make(&c, (bt_curve_law)law, 4, pin_x, pin_y);
        assert_true(bt_curve_integral(&c, 0) == 0);
        for (double at = 0.01; at < 0.6; at += 0.037) {
            const double h = 1e-5;
            const double slope =
                (bt_curve_integral(&c, at + h) - bt_curve_integral(&c, at - h)) / (2 * h);
            BT_ASSERT_NEAR(slope, bt_curve_value(&c, at), 1e-8, 0);
        }
    }
}

static void faults_are_named(void** state) {
    (void)state;
    static const struct {
        bt_table rows;
        int least;
        const char* says;
    } cases[] = {
        {{2, {0, 0.1}, {1e-4, 1e-4}}, 3, "has 2 rows; 3 at least are needed"},
        {{2, {0, 0}, {1e-4, 1e-4}},
         2,
         "must increase from row to row in its first column; row 2 has 0 m after 0 m"},
        {{2, {0, NAN}, {1e-4, 1e-4}}, 2, "row 2 holds a value that is not finite"},
        {{2, {0, 0.1}, {0, 1e-4}}, 2, "must be above 0 in its second column; row 1 has 0 N"},
        {{2, {-0.1, 0.1}, {1, 1}}, 2, "row 1 begins below 0: -0.1 m"},
        {{2, {0, 0.1}, {2, 1}}, 2, "decreases, and must not; row 2 has 1 N after 2 N"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        const bt_curve_rule rule = {cases[i].least, "m", "N", true};
        char text[160] = "";
        assert_true(bt_curve_fault(&cases[i].rows, &rule, text, sizeof text));
        assert_string_equal(text, cases[i].says);
    }
    const bt_table sound = {2, {0, 0.1}, {2, 1}};
    const bt_curve_rule rule = {2, "m", "m^2", false};
    assert_false(bt_curve_fault(&sound, &rule, NULL, 0));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curve_passes_through_its_rows),
        cmocka_unit_test(curve_holds_its_end_values_beyond_the_ends),
        cmocka_unit_test(smooth_curve_never_overshoots),
        cmocka_unit_test(smooth_curve_has_a_continuous_slope),
        cmocka_unit_test(slope_is_the_derivative_of_the_smooth_curve),
        cmocka_unit_test(smooth_curve_reproduces_a_straight_line),
        cmocka_unit_test(stepped_curve_holds_a_row_until_the_next),
        cmocka_unit_test(integral_is_the_antiderivative),
        cmocka_unit_test(faults_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
