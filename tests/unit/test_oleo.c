#include "elements/oleo.h"
#include "near.h"

#include <stdio.h>

/// Main leg of the reference aircraft.
static bt_oleo_params main_leg(void) {
    bt_oleo_params p;
    bt_group_set_defaults(&bt_oleo_group, &p);
    p.rebound_ratio = 0.2;
    p.orifice_table = (bt_table){4, {0, 0.09, 0.45, 0.60}, {375e-6, 300e-6, 200e-6, 160e-6}};
    return p;
}

static bt_oleo prepared(const bt_oleo_params* p) {
    bt_oleo o;
    bt_oleo_prepare(p, &o);
    return o;
}

/// Central difference of the energy, fourth order.
static double energy_slope(const bt_oleo* o, double s) {
    const double h = 1e-3;
    return (8 * (bt_oleo_energy(o, s + h) - bt_oleo_energy(o, s - h)) -
            (bt_oleo_energy(o, s + 2 * h) - bt_oleo_energy(o, s - 2 * h))) /
           (12 * h);
}

static void eq3_gas_force_at_zero_stroke_is_precharge_minus_ambient(void** state) {
    (void)state;
    const bt_oleo_params p = main_leg();
    const bt_oleo o = prepared(&p);
    BT_ASSERT_NEAR(bt_oleo_gas_force(&o, 0), p.air_area_m2 * (p.precharge_Pa - p.ambient_Pa), 1e-14,
                   0);
}

static void eq3_halving_the_volume_multiplies_the_pressure_by_two_to_the_n(void** state) {
    (void)state;
    const bt_oleo_params p = main_leg();
    const bt_oleo o = prepared(&p);
    const double s = 0.5 * p.air_volume_m3 / p.air_area_m2;
    BT_ASSERT_NEAR(bt_oleo_gas_pressure(&o, s), p.precharge_Pa * pow(2, p.gas_exponent), 1e-13, 0);
}

static void eq3_isothermal_gas_keeps_pressure_times_volume(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.gas_exponent = 1;
    const bt_oleo o = prepared(&p);
    for (double s = -0.01; s < 0.65; s += 0.03)
        BT_ASSERT_NEAR(bt_oleo_gas_pressure(&o, s) * (p.air_volume_m3 - p.air_area_m2 * s),
                       p.precharge_Pa * p.air_volume_m3, 1e-13, 0);
    BT_ASSERT_NEAR(energy_slope(&o, 0.3), bt_oleo_force(&o, 0.3, 0), 1e-9, 0);
}

static void eq3_no_gas_volume_left_is_not_finite(void** state) {
    (void)state;
    const bt_oleo_params p = main_leg();
    const bt_oleo o = prepared(&p);
    assert_true(isinf(bt_oleo_gas_force(&o, p.air_volume_m3 / p.air_area_m2)));
    assert_true(!isfinite(bt_oleo_gas_force(&o, NAN)));
}

static void eq3_second_chamber_is_continuous_where_it_lifts(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.high_precharge_Pa = 7.7e6;
    p.high_volume_m3 = 1.7e-3;
    const bt_oleo two = prepared(&p);
    p.high_precharge_Pa = p.high_volume_m3 = 0;
    const bt_oleo one = prepared(&p);
    // The first chamber alone reaches 7.7 MPa where V = V0 (2.8 / 7.7)^(1/n).
    const double s = p.air_volume_m3 * (1 - pow(2.8 / 7.7, 1 / 1.15)) / p.air_area_m2;
    BT_ASSERT_NEAR(two.second_stroke, s, 1e-13, 0);
    const double before = bt_oleo_gas_force(&two, s * (1 - 1e-12));
    const double after = bt_oleo_gas_force(&two, s * (1 + 1e-12));
    BT_ASSERT_NEAR(before, after, 1e-10, 0);
    BT_ASSERT_NEAR(bt_oleo_gas_energy(&two, s * (1 - 1e-12)),
                   bt_oleo_gas_energy(&two, s * (1 + 1e-12)), 1e-10, 0);
    // Below it is the single chamber, above it is softer.
    BT_ASSERT_NEAR(bt_oleo_gas_force(&two, 0.9 * s), bt_oleo_gas_force(&one, 0.9 * s), 0, 0);
    assert_true(bt_oleo_gas_force(&two, 1.2 * s) < bt_oleo_gas_force(&one, 1.2 * s));
}

/// Both chambers obey their own polytrope at the common pressure and fill what room is left.
static void eq3_second_chamber_shares_the_pressure(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.high_precharge_Pa = 7.7e6;
    p.high_volume_m3 = 1.7e-3;
    const bt_oleo o = prepared(&p);
    for (double s = o.second_stroke + 0.01; s < p.stroke_max_m; s += 0.02) {
        const double pressure = bt_oleo_gas_pressure(&o, s);
        const double v1 = p.air_volume_m3 * pow(p.precharge_Pa / pressure, 1 / p.gas_exponent);
        const double v2 =
            p.high_volume_m3 * pow(p.high_precharge_Pa / pressure, 1 / p.gas_exponent);
        BT_ASSERT_NEAR(v1 + v2, p.air_volume_m3 + p.high_volume_m3 - p.air_area_m2 * s, 1e-12, 0);
    }
}

/// The second chamber with an exponent of its own: each polytrope holds, with stiff and with
/// compressible oil; the same exponent twice is the closed form.
static void eq3_second_chamber_may_have_its_own_exponent(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.high_precharge_Pa = 7.7e6;
    p.high_volume_m3 = 1.7e-3;
    p.high_exponent = 1.3;
    for (int soft = 0; soft < 2; ++soft) {
        p.oil_volume_m3 = soft ? 8e-3 : 0;
        const bt_oleo o = prepared(&p);
        const double kappa = p.oil_volume_m3 / p.oil_bulk_modulus_Pa;
        for (double s = o.second_stroke + 1e-6; s < p.stroke_max_m; s += 0.02) {
            const double pressure = bt_oleo_gas_pressure(&o, s);
            const double v1 = p.air_volume_m3 * pow(p.precharge_Pa / pressure, 1 / p.gas_exponent);
            const double v2 = p.high_volume_m3 * pow(p.high_precharge_Pa / pressure, 1 / 1.3);
            BT_ASSERT_NEAR(v1 + v2,
                           p.air_volume_m3 + p.high_volume_m3 - p.air_area_m2 * s +
                               kappa * (pressure - p.precharge_Pa),
                           1e-12, 0);
        }
    }
    p.oil_volume_m3 = 0;
    p.high_exponent = p.gas_exponent * (1 + 1e-12);
    const bt_oleo near = prepared(&p);
    p.high_exponent = 0;
    const bt_oleo alike = prepared(&p);
    BT_ASSERT_NEAR(bt_oleo_gas_force(&near, 0.55), bt_oleo_gas_force(&alike, 0.55), 1e-10, 0);
}

/// A leaf spring: no gas, no oil.
static bt_oleo_params leaf(void) {
    bt_oleo_params p = main_leg();
    p.spring = BT_SPRING_POINTS;
    p.spring_points = (bt_table){2, {0, 0.5}, {0, 15e3}};
    p.air_area_m2 = p.precharge_Pa = p.air_volume_m3 = p.oil_area_m2 = 0;
    p.orifice_table.count = 0;
    return p;
}

static void spring_by_points_is_the_curve_and_its_last_slope(void** state) {
    (void)state;
    bt_oleo_params p = leaf();
    const bt_oleo straight = prepared(&p);
    for (double s = 0; s < 0.6; s += 0.07) {
        BT_ASSERT_NEAR(bt_oleo_force(&straight, s, 3), 30e3 * s, 1e-13, 1e-9);
        BT_ASSERT_NEAR(bt_oleo_energy(&straight, s), 15e3 * s * s, 1e-13, 1e-9);
    }
    p.spring_points = (bt_table){3, {0, 0.2, 0.4}, {5e3, 20e3, 60e3}};
    const bt_oleo curved = prepared(&p);
    for (int i = 0; i < 3; ++i)
        BT_ASSERT_NEAR(bt_oleo_gas_force(&curved, p.spring_points.x[i]), p.spring_points.y[i],
                       1e-14, 0);
    BT_ASSERT_NEAR(bt_oleo_force(&curved, 0, 0), 5e3, 1e-14, 0); // the preload
    assert_true(bt_oleo_hanging_stroke(&curved, 0) < 0);         // holds it on its stop
    for (double s = 0.01; s < 0.59; s += 0.02) // the cubic's energy has a fourth power
        BT_ASSERT_NEAR(energy_slope(&curved, s), bt_oleo_force(&curved, s, 0), 1e-2, 0);
}

static void eq3_compressible_oil_gives_the_gas_more_room(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.high_precharge_Pa = 7.7e6;
    p.high_volume_m3 = 1.7e-3;
    const bt_oleo stiff = prepared(&p);
    p.oil_volume_m3 = 8e-3;
    const bt_oleo soft = prepared(&p);
    const double kappa = p.oil_volume_m3 / p.oil_bulk_modulus_Pa;
    BT_ASSERT_NEAR(bt_oleo_gas_force(&soft, 0), bt_oleo_gas_force(&stiff, 0), 1e-13, 0);
    for (double s = -0.003; s < 0.6; s += 0.007) {
        const double pressure = bt_oleo_gas_pressure(&soft, s);
        const double extra = kappa * (pressure - p.precharge_Pa) / p.air_area_m2;
        // The same pressure at the stroke that leaves the gas the same room. The second chamber
        // lifts at the same pressure in both.
        BT_ASSERT_NEAR(pressure, bt_oleo_gas_pressure(&stiff, s - extra), 1e-10, 0);
    }
}

static void eq3_force_is_the_gradient_of_the_energy(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    for (int variant = 0; variant < 8; ++variant) {
        p.high_exponent = variant & 4 ? 1.3 : 0;
        p.high_precharge_Pa = variant & 1 ? 7.7e6 : 0;
        p.high_volume_m3 = variant & 1 ? 1.7e-3 : 0;
        p.oil_volume_m3 = variant & 2 ? 8e-3 : 0;
        const bt_oleo o = prepared(&p);
        BT_ASSERT_NEAR(bt_oleo_energy(&o, 0), 0, 0, 1e-9);
        for (double s = -0.02; s < 0.62; s += 0.01) {
            const double kink[3] = {0, o.second_stroke, o.stops.stroke_max};
            bool near_kink = false;
            for (int i = 0; i < 3; ++i)
                near_kink |= fabs(s - kink[i]) < 3e-3;
            if (!near_kink)
                BT_ASSERT_NEAR(energy_slope(&o, s), bt_oleo_force(&o, s, 0), 1e-7, 1e-2);
        }
    }
}

static void eq4_oil_force_is_quadratic_and_odd_in_the_rate(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.rebound_ratio = 1;
    const bt_oleo o = prepared(&p);
    const double f = bt_oleo_oil_force(&o, 0.09, 1);
    const double want = 860 * pow(0.0098, 3) / (2 * pow(0.65 * 300e-6, 2));
    BT_ASSERT_NEAR(f, want, 1e-13, 0);
    BT_ASSERT_NEAR(bt_oleo_oil_force(&o, 0.09, 3), 9 * f, 1e-14, 0);
    BT_ASSERT_NEAR(bt_oleo_oil_force(&o, 0.09, -3), -9 * f, 1e-14, 0);
    assert_true(bt_oleo_oil_force(&o, 0.09, 0) == 0);
}

static void eq4_rebound_orifice_is_a_ratio_or_an_area(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    const bt_oleo ratio = prepared(&p);
    BT_ASSERT_NEAR(bt_oleo_oil_force(&ratio, 0.09, -2), -25 * bt_oleo_oil_force(&ratio, 0.09, 2),
                   1e-13, 0);
    p.rebound_area_m2 = 60e-6;
    const bt_oleo area = prepared(&p);
    BT_ASSERT_NEAR(bt_oleo_oil_force(&area, 0.09, -2), bt_oleo_oil_force(&ratio, 0.09, -2), 1e-13,
                   0);
    BT_ASSERT_NEAR(bt_oleo_oil_force(&area, 0.5, -2), bt_oleo_oil_force(&area, 0.09, -2), 1e-13, 0);
}

static void eq4_side_orifice_adds_its_own_term_in_each_direction(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    const bt_oleo without = prepared(&p);
    p.side_area_m2 = 6280e-6;
    p.side_orifice_compression_m2 = 100e-6;
    p.side_orifice_extension_m2 = 22e-6;
    p.side_discharge = 0.7;
    const bt_oleo with = prepared(&p);
    const double c = 860 * pow(6280e-6, 3) / (2 * 0.7 * 0.7);
    BT_ASSERT_NEAR(bt_oleo_oil_force(&with, 0.2, 3) - bt_oleo_oil_force(&without, 0.2, 3),
                   9 * c / (100e-6 * 100e-6), 1e-10, 0);
    BT_ASSERT_NEAR(bt_oleo_oil_force(&with, 0.2, -3) - bt_oleo_oil_force(&without, 0.2, -3),
                   -9 * c / (22e-6 * 22e-6), 1e-10, 0);
}

/// A check valve that is open in compression: only the other direction is given.
static void eq4_side_orifice_left_out_flows_freely(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    const bt_oleo without = prepared(&p);
    p.side_area_m2 = 6280e-6;
    p.side_orifice_extension_m2 = 22e-6;
    const bt_oleo with = prepared(&p);
    BT_ASSERT_NEAR(bt_oleo_oil_force(&with, 0.2, 3), bt_oleo_oil_force(&without, 0.2, 3), 0, 0);
    assert_true(bt_oleo_oil_force(&with, 0.2, -3) < 2 * bt_oleo_oil_force(&without, 0.2, -3));
}

static void eq4_no_oil_no_damping(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.oil_area_m2 = 0;
    p.orifice_table.count = 0;
    const bt_oleo o = prepared(&p);
    assert_true(bt_oleo_oil_force(&o, 0.2, 3) == 0 && bt_oleo_oil_force(&o, 0.2, -3) == 0);
}

static void eq4_orifice_law_is_as_asked(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.orifice_law = BT_CURVE_STEPPED;
    bt_oleo o = prepared(&p);
    BT_ASSERT_NEAR(bt_oleo_orifice_area(&o, 0.3), 300e-6, 1e-15, 0);
    p.orifice_law = BT_CURVE_LINEAR;
    o = prepared(&p);
    BT_ASSERT_NEAR(bt_oleo_orifice_area(&o, 0.27), 250e-6, 1e-12, 0);
    p.orifice_law = BT_CURVE_SMOOTH;
    o = prepared(&p);
    assert_true(bt_oleo_orifice_area(&o, 0.27) < 300e-6);
    assert_true(bt_oleo_orifice_area(&o, 0.27) > 200e-6);
    assert_true(bt_oleo_orifice_area(&o, 2) == 160e-6);
    p.orifice_table.count = 0;
    p.orifice_area_m2 = 210e-6;
    o = prepared(&p);
    assert_true(bt_oleo_orifice_area(&o, -0.1) == 210e-6 && bt_oleo_orifice_area(&o, 9) == 210e-6);
}

static void eq5_limit_is_zero_inside_and_linear_outside(void** state) {
    (void)state;
    const bt_oleo_params p = main_leg();
    const bt_oleo o = prepared(&p);
    const double k = p.stop_stiffness_Npm;
    assert_true(bt_oleo_limit_force(&o, 0, 1) == 0);
    assert_true(bt_oleo_limit_force(&o, 0.6, 1) == 0);
    BT_ASSERT_NEAR(bt_oleo_limit_force(&o, -0.002, 0), -0.002 * k, 1e-14, 0);
    BT_ASSERT_NEAR(bt_oleo_limit_force(&o, 0.603, 0), 0.003 * k, 1e-12, 0);
    BT_ASSERT_NEAR(bt_oleo_force(&o, 0.6 - 1e-12, 0), bt_oleo_force(&o, 0.6 + 1e-12, 0), 1e-8, 0);
}

static void eq5_stop_damping_never_makes_a_stop_pull(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.stop_damping_Npmps = 1e6;
    const bt_oleo o = prepared(&p);
    for (double rate = -5; rate <= 5; rate += 0.25) {
        assert_true(bt_oleo_limit_force(&o, -0.001, rate) <= 0);
        assert_true(bt_oleo_limit_force(&o, 0.601, rate) >= 0);
    }
}

/// Eq. 5 at s < 0 holds the precharge: pulling apart moves the strut by no more than the load over
/// k_l, and it begins to close when the load passes the precharge.
static void eq5_strut_is_locked_until_the_preload_is_passed(void** state) {
    (void)state;
    const bt_oleo_params p = main_leg();
    const bt_oleo o = prepared(&p);
    const double preload = p.air_area_m2 * (p.precharge_Pa - p.ambient_Pa);
    double low = -0.01, high = 0.01;
    for (int i = 0; i < 60; ++i) {
        const double s = 0.5 * (low + high);
        if (bt_oleo_force(&o, s, 0) < 0)
            low = s;
        else
            high = s;
    }
    BT_ASSERT_NEAR(low, -preload / p.stop_stiffness_Npm, 1e-2, 0); // the gas is a soft spring
    BT_ASSERT_NEAR(bt_oleo_force(&o, 0, 0), preload, 1e-14, 0);
}

static void eq5_strut_hangs_on_its_stop(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    bt_oleo o = prepared(&p);
    for (double load = 0; load < 1e4; load += 2500) {
        const double s = bt_oleo_hanging_stroke(&o, load);
        assert_true(s < 0);
        BT_ASSERT_NEAR(bt_oleo_force(&o, s, 0), -load, 0, 1e-6);
    }
    p.stop_stiffness_Npm = 0;
    o = prepared(&p);
    assert_true(bt_oleo_hanging_stroke(&o, 1e3) == 0);
}

static void eq2_dissipation_is_never_negative(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.side_area_m2 = 6280e-6;
    p.side_orifice_compression_m2 = 100e-6;
    p.side_orifice_extension_m2 = 22e-6;
    p.seal_friction_N = 500;
    p.seal_coefficient = 0.05;
    p.bearing_coefficient = 0.1;
    p.side_load_ratio = 0.2;
    p.axle_distance_m = 1;
    const bt_oleo o = prepared(&p);
    for (double s = 0; s <= 0.6; s += 0.03)
        for (double rate = -6; rate <= 6; rate += 0.1) {
            const double conservative = bt_oleo_force(&o, s, 0);
            assert_true((bt_oleo_force(&o, s, rate) - conservative) * rate >= 0);
        }
}

static void eq2_sum_has_no_other_part(void** state) {
    (void)state;
    const bt_oleo_params p = main_leg();
    const bt_oleo o = prepared(&p);
    for (double s = -0.01; s < 0.62; s += 0.021)
        for (double rate = -4; rate < 4; rate += 0.7)
            BT_ASSERT_NEAR(bt_oleo_force(&o, s, rate),
                           bt_oleo_gas_force(&o, s) + bt_oleo_oil_force(&o, s, rate) +
                               bt_oleo_limit_force(&o, s, rate),
                           1e-14, 1e-9);
}

/// TR 1154: N_1 + N_2 = F_n (2 (l_2 - s) / (l_1 + s) + 1).
static void friction_loads_the_bearings_by_leverage(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.bearing_coefficient = 0.1;
    p.side_load_ratio = 0.2;
    p.axle_distance_m = 1.0;
    p.bearing_distance_m = 0.25;
    const bt_oleo o = prepared(&p);
    BT_ASSERT_NEAR(bt_oleo_friction_force(&o, 0.25, 1, 3e4, 1e4),
                   0.1 * 0.2 * 4e4 * (2 * 0.75 / 0.5 + 1), 1e-13, 0);
    BT_ASSERT_NEAR(bt_oleo_friction_force(&o, 0.25, -1, 3e4, 1e4),
                   -bt_oleo_friction_force(&o, 0.25, 1, 3e4, 1e4), 0, 0);
    assert_true(bt_oleo_friction_force(&o, 0.25, 0, 3e4, 1e4) == 0);
}

/* Bad input */

typedef struct seen {
    int count;
    char text[8][256];
} seen;

static void keep(void* user, bt_severity severity, bt_where where, const char* text) {
    (void)severity;
    (void)where;
    seen* s = user;
    if (s->count < 8)
        snprintf(s->text[s->count], sizeof s->text[0], "%s", text);
    ++s->count;
}

static seen errors_of(const bt_oleo_params* p) {
    seen s = {0};
    bt_diag diag = {keep, &s, 0, 0};
    const bt_status status = bt_group_check(&bt_oleo_group, p, "main_gear.oleo", &diag);
    assert_int_equal(status == BT_OK, s.count == 0);
    return s;
}

static void check_accepts_the_reference_leg(void** state) {
    (void)state;
    const bt_oleo_params p = main_leg();
    assert_int_equal(errors_of(&p).count, 0);
}

static void check_refuses_gas_volume_below_the_swept_volume(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.air_volume_m3 = 6e-3;
    const seen s = errors_of(&p);
    assert_int_equal(s.count, 1);
    assert_string_equal(s.text[0], "main_gear.oleo.air_volume: the gas volume of 0.006 m^3 is not "
                                   "above the swept volume air_area x stroke_max = 0.00678 m^3");
    p.high_precharge_Pa = 7e6; // with a second chamber there is room enough
    p.high_volume_m3 = 1e-3;
    assert_int_equal(errors_of(&p).count, 0);
}

static void check_refuses_pressure_below_ambient(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.precharge_Pa = 9e4;
    const seen s = errors_of(&p);
    assert_int_equal(s.count, 1);
    assert_string_equal(s.text[0], "main_gear.oleo.precharge: 90000 Pa is below the ambient "
                                   "pressure of 101325 Pa; the precharge is absolute");
}

static void check_refuses_a_metering_table_that_goes_back(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.orifice_table.x[2] = 0.05;
    const seen s = errors_of(&p);
    assert_int_equal(s.count, 1);
    assert_string_equal(s.text[0], "main_gear.oleo.orifice_table: must increase from row to row in "
                                   "its first column; row 3 has 0.05 m after 0.09 m");
}

static void check_refuses_missing_and_double_orifices(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.orifice_area_m2 = 1e-4;
    assert_int_equal(errors_of(&p).count, 1);
    p.orifice_table.count = 0;
    assert_int_equal(errors_of(&p).count, 0);
    p.orifice_area_m2 = 0;
    assert_int_equal(errors_of(&p).count, 1);
    p.orifice_area_m2 = 1e-4;
    p.side_area_m2 = 1e-3;
    assert_int_equal(errors_of(&p).count, 1);
}

static void check_accepts_a_spring_without_gas_and_refuses_a_gas_without_keys(void** state) {
    (void)state;
    bt_oleo_params p = leaf();
    assert_int_equal(errors_of(&p).count, 0);
    p.spring = BT_SPRING_GAS;
    const seen s = errors_of(&p);
    assert_int_equal(s.count, 3);
    assert_string_equal(s.text[0], "main_gear.oleo.air_area: needed above 0 where spring is gas");
}

static void check_refuses_spring_points_that_fall_or_begin_late(void** state) {
    (void)state;
    static const struct {
        bt_table rows;
        const char* says;
    } cases[] = {
        {{1, {0}, {1e3}}, "2 at least are needed"},
        {{2, {0.01, 0.1}, {1e3, 2e3}}, "its first row must be at stroke 0"},
        {{3, {0, 0.2, 0.1}, {1e3, 2e3, 3e3}}, "must increase from row to row"},
        {{3, {0, 0.1, 0.2}, {1e3, 3e3, 2e3}}, "decreases"},
        {{2, {0, 0.1}, {-1, 3e3}}, "must be above 0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        bt_oleo_params p = leaf();
        p.spring_points = cases[i].rows;
        const seen s = errors_of(&p);
        assert_int_equal(s.count, 1);
        assert_non_null(strstr(s.text[0], cases[i].says));
    }
}

static void check_refuses_half_a_second_chamber(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.high_precharge_Pa = 7e6;
    assert_int_equal(errors_of(&p).count, 1);
    p.high_volume_m3 = 1e-3;
    p.high_precharge_Pa = 2e6;
    assert_int_equal(errors_of(&p).count, 1);
    p.high_precharge_Pa = 7e6;
    p.high_exponent = 0.9;
    assert_int_equal(errors_of(&p).count, 1);
}

static void check_refuses_an_axle_that_passes_its_bearing(void** state) {
    (void)state;
    bt_oleo_params p = main_leg();
    p.bearing_coefficient = 0.1;
    p.side_load_ratio = 0.1;
    p.axle_distance_m = 0.5;
    assert_int_equal(errors_of(&p).count, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eq3_gas_force_at_zero_stroke_is_precharge_minus_ambient),
        cmocka_unit_test(eq3_halving_the_volume_multiplies_the_pressure_by_two_to_the_n),
        cmocka_unit_test(eq3_isothermal_gas_keeps_pressure_times_volume),
        cmocka_unit_test(eq3_no_gas_volume_left_is_not_finite),
        cmocka_unit_test(eq3_second_chamber_is_continuous_where_it_lifts),
        cmocka_unit_test(eq3_second_chamber_shares_the_pressure),
        cmocka_unit_test(eq3_second_chamber_may_have_its_own_exponent),
        cmocka_unit_test(spring_by_points_is_the_curve_and_its_last_slope),
        cmocka_unit_test(eq3_compressible_oil_gives_the_gas_more_room),
        cmocka_unit_test(eq3_force_is_the_gradient_of_the_energy),
        cmocka_unit_test(eq4_oil_force_is_quadratic_and_odd_in_the_rate),
        cmocka_unit_test(eq4_rebound_orifice_is_a_ratio_or_an_area),
        cmocka_unit_test(eq4_side_orifice_adds_its_own_term_in_each_direction),
        cmocka_unit_test(eq4_side_orifice_left_out_flows_freely),
        cmocka_unit_test(eq4_no_oil_no_damping),
        cmocka_unit_test(eq4_orifice_law_is_as_asked),
        cmocka_unit_test(eq5_limit_is_zero_inside_and_linear_outside),
        cmocka_unit_test(eq5_stop_damping_never_makes_a_stop_pull),
        cmocka_unit_test(eq5_strut_is_locked_until_the_preload_is_passed),
        cmocka_unit_test(eq5_strut_hangs_on_its_stop),
        cmocka_unit_test(eq2_dissipation_is_never_negative),
        cmocka_unit_test(eq2_sum_has_no_other_part),
        cmocka_unit_test(friction_loads_the_bearings_by_leverage),
        cmocka_unit_test(check_accepts_the_reference_leg),
        cmocka_unit_test(check_refuses_gas_volume_below_the_swept_volume),
        cmocka_unit_test(check_refuses_pressure_below_ambient),
        cmocka_unit_test(check_refuses_a_metering_table_that_goes_back),
        cmocka_unit_test(check_refuses_missing_and_double_orifices),
        cmocka_unit_test(check_accepts_a_spring_without_gas_and_refuses_a_gas_without_keys),
        cmocka_unit_test(check_refuses_spring_points_that_fall_or_begin_late),
        cmocka_unit_test(check_refuses_half_a_second_chamber),
        cmocka_unit_test(check_refuses_an_axle_that_passes_its_bearing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
