#include "elements/hook_damper_orifice.h"
#include "elements/hook_damper_viscous.h"
#include "near.h"

/// A damper of a type with its fallbacks, to be changed through params.
static bt_hook_damper_variant variant(const char* name) {
    bt_hook_damper_variant v = {0};
    for (int i = 0; i < bt_hook_damper_types.count; ++i)
        if (strcmp(bt_hook_damper_types.type.choices[i], name) == 0) {
            bt_variant_set(&bt_hook_damper_types, i, (void*)&v);
            return v;
        }
    fail_msg("no damper %s", name);
    return v;
}

static bt_hook_damper prepared(const bt_hook_damper_variant* v) {
    bt_hook_damper d;
    bt_hook_damper_prepare(v, &d);
    return d;
}

static double oil(const bt_hook_damper* d, double rate) {
    return bt_hook_damper_orifice_oil((const void*)d->data, rate);
}

static void eq9_fallback_damping_is_that_of_the_feasibility_model(void** state) {
    (void)state;
    const bt_hook_damper_variant v = variant("orifice");
    assert_int_equal(v.type, 0); // the default
    const bt_hook_damper d = prepared(&v);
    BT_ASSERT_NEAR(oil(&d, 1), 4695, 1e-4, 0); // the area is given to 5 digits
    BT_ASSERT_NEAR(oil(&d, -1), -4695, 1e-4, 0);
}

static void eq9_oil_force_is_quadratic_and_of_its_own_orifice(void** state) {
    (void)state;
    bt_hook_damper_variant v = variant("orifice");
    bt_hook_damper_orifice_params* p = (void*)v.params;
    p->rebound_area_m2 = 2 * p->orifice_area_m2;
    const bt_hook_damper d = prepared(&v);
    const double want = 860 * pow(1.6e-3, 3) / (2 * pow(0.65 * p->orifice_area_m2, 2));
    BT_ASSERT_NEAR(oil(&d, 2), 4 * want, 1e-13, 0);
    BT_ASSERT_NEAR(oil(&d, -2), -want, 1e-13, 0);
    assert_true(oil(&d, 0) == 0);
}

static void eq9_gas_force_at_the_down_stop_is_the_precharge(void** state) {
    (void)state;
    const bt_gas_spring gas = {{3e-3, 11e6, 1.2}, 1.96e-3, 101325};
    BT_ASSERT_NEAR(bt_gas_spring_force(&gas, 0), 1.96e-3 * (11e6 - 101325), 1e-14, 0);
    BT_ASSERT_NEAR(bt_gas_spring_force(&gas, 0.5 * 3e-3 / 1.96e-3),
                   1.96e-3 * (11e6 * pow(2, 1.2) - 101325), 1e-13, 0);
    assert_true(isinf(bt_gas_spring_force(&gas, 2)));
    const bt_hook_damper_variant v = variant("orifice");
    const bt_hook_damper d = prepared(&v);
    BT_ASSERT_NEAR(bt_hook_damper_force(&d, 0.2, 0), bt_gas_spring_force(&gas, 0.2), 1e-15, 0);
}

static void eq9_down_stop_acts_below_zero_stroke(void** state) {
    (void)state;
    const bt_stops stops = {.stroke_max = 0.6, .stiffness = 2e7};
    BT_ASSERT_NEAR(bt_stops_force(&stops, -1e-3, 0), -2e4, 1e-14, 0);
    assert_true(bt_stops_force(&stops, 0.3, 5) == 0);
    BT_ASSERT_NEAR(bt_stops_force(&stops, 0.601, 0), 2e4, 1e-11, 0);
}

static void eq9_stop_never_pulls(void** state) {
    (void)state;
    const bt_stops stops = {.stroke_max = 0.6, .stiffness = 2e7, .damping = 1e6};
    for (double rate = -5; rate <= 5; rate += 0.25) {
        assert_true(bt_stops_force(&stops, -1e-3, rate) <= 0);
        assert_true(bt_stops_force(&stops, 0.601, rate) >= 0);
    }
}

static void viscous_damping_is_linear_and_of_its_own_direction(void** state) {
    (void)state;
    bt_hook_damper_variant v = variant("viscous");
    bt_hook_damper_viscous_params* p = (void*)v.params;
    p->damping_Npmps = 3000;
    p->rebound_damping_Npmps = 8000;
    const bt_hook_damper d = prepared(&v);
    const double rest = bt_hook_damper_force(&d, 0.1, 0);
    BT_ASSERT_NEAR(bt_hook_damper_force(&d, 0.1, 2) - rest, 6000, 1e-11, 0);
    BT_ASSERT_NEAR(bt_hook_damper_force(&d, 0.1, -2) - rest, -16000, 1e-11, 0);
    p->rebound_damping_Npmps = 0; // as in compression
    const bt_hook_damper alike = prepared(&v);
    BT_ASSERT_NEAR(bt_hook_damper_force(&alike, 0.1, -2) - rest, -6000, 1e-11, 0);
}

/// At the limit of a step the leapfrog with damping from the last half step is just bounded.
static void viscous_step_limit_is_where_the_leapfrog_ends(void** state) {
    (void)state;
    bt_hook_damper_variant v = variant("viscous");
    const bt_hook_damper d = prepared(&v);
    const double m = 500, k = 2e7, c = 5000, limit = bt_hook_damper_step_limit(&d, m);
    for (int above = 0; above < 2; ++above) {
        const double h = limit * (above ? 1.01 : 0.99);
        double x = 1e-3, u = 0, most = 0;
        for (int i = 0; i < 3000; ++i) {
            u -= h * (k * x + c * u) / m;
            x += h * u;
            most = fmax(most, fabs(x));
        }
        assert_true(above ? most > 1e3 : most < 0.1);
    }
}

// --- every law that is registered ---------------------------------------------------------------

static void every_law_is_the_gradient_of_its_energy_at_rest(void** state) {
    (void)state;
    for (int type = 0; type < bt_hook_damper_types.count; ++type) {
        bt_hook_damper_variant v;
        bt_variant_set(&bt_hook_damper_types, type, (void*)&v);
        const bt_hook_damper d = prepared(&v);
        BT_ASSERT_NEAR(bt_hook_damper_energy(&d, 0), 0, 0, 1e-9);
        for (double s = -0.0205; s < 0.63; s += 0.01) {
            const double h = 1e-4;
            const double slope =
                (bt_hook_damper_energy(&d, s + h) - bt_hook_damper_energy(&d, s - h)) / (2 * h);
            BT_ASSERT_NEAR(slope, bt_hook_damper_force(&d, s, 0), 1e-7, 0);
        }
    }
}

static void every_law_takes_energy_out_and_gives_none(void** state) {
    (void)state;
    for (int type = 0; type < bt_hook_damper_types.count; ++type) {
        bt_hook_damper_variant v;
        bt_variant_set(&bt_hook_damper_types, type, (void*)&v);
        const bt_hook_damper d = prepared(&v);
        double taken = 0;
        for (double s = -0.01; s < 0.62; s += 0.015)
            for (double rate = -8; rate <= 8; rate += 0.25) {
                const double power =
                    (bt_hook_damper_force(&d, s, rate) - bt_hook_damper_force(&d, s, 0)) * rate;
                assert_true(power >= 0);
                taken += power;
            }
        assert_true(taken > 0);
        assert_true(bt_hook_damper_step_limit(&d, 100) > 0);
    }
}

static void every_table_accepts_its_fallbacks_and_refuses_what_is_no_number(void** state) {
    (void)state;
    for (int type = 0; type < bt_hook_damper_types.count; ++type) {
        const bt_group* group = bt_hook_damper_types.groups[type];
        bt_hook_damper_variant v;
        bt_variant_set(&bt_hook_damper_types, type, (void*)&v);
        assert_int_equal(bt_group_check(group, v.params, "damper", NULL), BT_OK);
        assert_in_range(group->size, 1, BT_HOOK_DAMPER_PARAMS_SIZE);
        for (int i = 0; i < group->field_count; ++i) {
            const bt_field* field = &group->fields[i];
            if (field->kind > BT_FIELD_PLAIN)
                continue;
            bt_hook_damper_variant bad = v;
            bt_field_set(field, bad.params, field->offset, NAN);
            assert_int_equal(bt_group_check(group, bad.params, "", NULL), BT_ERR_INPUT);
        }
    }
}

static void eq9_stop_damping_takes_energy_out(void** state) {
    (void)state;
    bt_hook_damper_variant v = variant("orifice");
    bt_hook_damper_orifice_params* p = (void*)v.params;
    p->rebound_area_m2 = 1e-5;
    p->stop_damping_Npmps = 1e5;
    const bt_hook_damper d = prepared(&v);
    for (double s = -0.01; s < 0.62; s += 0.015)
        for (double rate = -8; rate <= 8; rate += 0.25)
            assert_true(
                (bt_hook_damper_force(&d, s, rate) - bt_hook_damper_force(&d, s, 0)) * rate >= 0);
}

static void eq3_isothermal_gas_is_the_gradient_of_its_energy(void** state) {
    (void)state;
    const bt_gas_spring gas = {{3e-3, 11e6, 1}, 1.96e-3, 101325};
    for (double s = -0.02; s < 0.6; s += 0.01) {
        const double h = 1e-4;
        const double slope =
            (bt_gas_spring_energy(&gas, s + h) - bt_gas_spring_energy(&gas, s - h)) / (2 * h);
        BT_ASSERT_NEAR(slope, bt_gas_spring_force(&gas, s), 1e-7, 0);
    }
    // P V ln(V / room) less the work on the atmosphere
    BT_ASSERT_NEAR(bt_gas_spring_energy(&gas, 0.5),
                   33e3 * log(3e-3 / (3e-3 - 0.98e-3)) - 101325 * 0.98e-3, 1e-13, 0);
}

static void check_refuses_too_little_gas_and_a_gauge_precharge(void** state) {
    (void)state;
    bt_hook_damper_variant v = variant("orifice");
    bt_hook_damper_orifice_params* p = (void*)v.params;
    bt_diag diag = {0};
    p->air_volume_m3 = 1e-3;
    assert_int_equal(bt_group_check(&bt_hook_damper_orifice_group, p, "damper", &diag),
                     BT_ERR_INPUT);
    assert_int_equal(diag.errors, 1);
    v = variant("orifice");
    p->precharge_Pa = 5e4;
    assert_int_equal(bt_group_check(&bt_hook_damper_orifice_group, p, "", &diag), BT_ERR_INPUT);
    assert_int_equal(diag.errors, 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eq9_fallback_damping_is_that_of_the_feasibility_model),
        cmocka_unit_test(eq9_oil_force_is_quadratic_and_of_its_own_orifice),
        cmocka_unit_test(eq9_gas_force_at_the_down_stop_is_the_precharge),
        cmocka_unit_test(eq9_down_stop_acts_below_zero_stroke),
        cmocka_unit_test(eq9_stop_never_pulls),
        cmocka_unit_test(viscous_damping_is_linear_and_of_its_own_direction),
        cmocka_unit_test(viscous_step_limit_is_where_the_leapfrog_ends),
        cmocka_unit_test(every_law_is_the_gradient_of_its_energy_at_rest),
        cmocka_unit_test(every_law_takes_energy_out_and_gives_none),
        cmocka_unit_test(every_table_accepts_its_fallbacks_and_refuses_what_is_no_number),
        cmocka_unit_test(eq9_stop_damping_takes_energy_out),
        cmocka_unit_test(eq3_isothermal_gas_is_the_gradient_of_its_energy),
        cmocka_unit_test(check_refuses_too_little_gas_and_a_gauge_precharge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
