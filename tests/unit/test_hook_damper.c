#include "elements/hook_damper.h"
#include "near.h"

static bt_hook_damper_params defaults(void) {
    bt_hook_damper_params p;
    bt_group_set_defaults(&bt_hook_damper_group, &p);
    return p;
}

static bt_hook_damper prepared(const bt_hook_damper_params* p) {
    bt_hook_damper d;
    bt_hook_damper_prepare(p, &d);
    return d;
}

static void eq9_fallback_damping_is_that_of_the_feasibility_model(void** state) {
    (void)state;
    const bt_hook_damper_params p = defaults();
    const bt_hook_damper d = prepared(&p);
    BT_ASSERT_NEAR(bt_hook_damper_oil_force(&d, 1), 4695, 1e-4, 0); // the area is given to 5 digits
    BT_ASSERT_NEAR(bt_hook_damper_oil_force(&d, -1), -4695, 1e-4, 0);
}

static void eq9_oil_force_is_quadratic_and_of_its_own_orifice(void** state) {
    (void)state;
    bt_hook_damper_params p = defaults();
    p.rebound_area_m2 = 2 * p.orifice_area_m2;
    const bt_hook_damper d = prepared(&p);
    const double want = 860 * pow(1.6e-3, 3) / (2 * pow(0.65 * p.orifice_area_m2, 2));
    BT_ASSERT_NEAR(bt_hook_damper_oil_force(&d, 2), 4 * want, 1e-13, 0);
    BT_ASSERT_NEAR(bt_hook_damper_oil_force(&d, -2), -want, 1e-13, 0);
    assert_true(bt_hook_damper_oil_force(&d, 0) == 0);
}

static void eq9_gas_force_at_the_down_stop_is_the_precharge(void** state) {
    (void)state;
    const bt_hook_damper_params p = defaults();
    const bt_hook_damper d = prepared(&p);
    BT_ASSERT_NEAR(bt_hook_damper_gas_force(&d, 0), 1.96e-3 * (11e6 - 101325), 1e-14, 0);
    BT_ASSERT_NEAR(bt_hook_damper_gas_force(&d, 0.5 * 3e-3 / 1.96e-3),
                   1.96e-3 * (11e6 * pow(2, 1.2) - 101325), 1e-13, 0);
    assert_true(isinf(bt_hook_damper_gas_force(&d, 2)));
}

static void eq9_down_stop_acts_below_zero_stroke(void** state) {
    (void)state;
    const bt_hook_damper_params p = defaults();
    const bt_hook_damper d = prepared(&p);
    BT_ASSERT_NEAR(bt_hook_damper_limit_force(&d, -1e-3, 0), -2e4, 1e-14, 0);
    assert_true(bt_hook_damper_limit_force(&d, 0.3, 5) == 0);
    BT_ASSERT_NEAR(bt_hook_damper_limit_force(&d, 0.601, 0), 2e4, 1e-11, 0);
}

static void eq9_stop_never_pulls(void** state) {
    (void)state;
    bt_hook_damper_params p = defaults();
    p.stop_damping_Npmps = 1e6;
    const bt_hook_damper d = prepared(&p);
    for (double rate = -5; rate <= 5; rate += 0.25) {
        assert_true(bt_hook_damper_limit_force(&d, -1e-3, rate) <= 0);
        assert_true(bt_hook_damper_limit_force(&d, 0.601, rate) >= 0);
    }
}

static void eq9_force_is_the_gradient_of_the_energy(void** state) {
    (void)state;
    bt_hook_damper_params p = defaults();
    for (int isothermal = 0; isothermal < 2; ++isothermal) {
        p.gas_exponent = isothermal ? 1 : 1.2;
        const bt_hook_damper d = prepared(&p);
        BT_ASSERT_NEAR(bt_hook_damper_energy(&d, 0), 0, 0, 1e-9);
        for (double s = -0.0205; s < 0.63; s += 0.01) {
            const double h = 1e-4;
            const double slope =
                (bt_hook_damper_energy(&d, s + h) - bt_hook_damper_energy(&d, s - h)) / (2 * h);
            BT_ASSERT_NEAR(slope, bt_hook_damper_force(&d, s, 0), 1e-7, 0);
        }
    }
}

static void eq9_dissipation_is_never_negative(void** state) {
    (void)state;
    bt_hook_damper_params p = defaults();
    p.rebound_area_m2 = 1e-5;
    p.stop_damping_Npmps = 1e5;
    const bt_hook_damper d = prepared(&p);
    for (double s = -0.01; s < 0.62; s += 0.015)
        for (double rate = -8; rate <= 8; rate += 0.25)
            assert_true(
                (bt_hook_damper_force(&d, s, rate) - bt_hook_damper_force(&d, s, 0)) * rate >= 0);
}

static void check_accepts_the_fallbacks_and_refuses_too_little_gas(void** state) {
    (void)state;
    bt_hook_damper_params p = defaults();
    bt_diag diag = {0};
    assert_int_equal(bt_group_check(&bt_hook_damper_group, &p, "damper", &diag), BT_OK);
    p.air_volume_m3 = 1e-3;
    assert_int_equal(bt_group_check(&bt_hook_damper_group, &p, "damper", &diag), BT_ERR_INPUT);
    assert_int_equal(diag.errors, 1);
    p = defaults();
    p.precharge_Pa = 5e4;
    assert_int_equal(bt_group_check(&bt_hook_damper_group, &p, "", &diag), BT_ERR_INPUT);
    assert_int_equal(diag.errors, 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eq9_fallback_damping_is_that_of_the_feasibility_model),
        cmocka_unit_test(eq9_oil_force_is_quadratic_and_of_its_own_orifice),
        cmocka_unit_test(eq9_gas_force_at_the_down_stop_is_the_precharge),
        cmocka_unit_test(eq9_down_stop_acts_below_zero_stroke),
        cmocka_unit_test(eq9_stop_never_pulls),
        cmocka_unit_test(eq9_force_is_the_gradient_of_the_energy),
        cmocka_unit_test(eq9_dissipation_is_never_negative),
        cmocka_unit_test(check_accepts_the_fallbacks_and_refuses_too_little_gas),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
