#define _GNU_SOURCE
#include "near.h"

#include "surrogate/features.h"
#include "toy_study.h"

static bt_study study;
static const int inputs[] = {0, 1, 2, 3};

static int make_study(void** state) {
    (void)state;
    toy_study(&study, BT_DESIGN_MONTE_CARLO, 10);
    bt_group_set_defaults(&bt_surrogate_group, &study.surrogate);
    study.model.landing.distance_from = BT_DISTANCE_FROM_HOOK;
    return 0;
}

static double feature(double sink_mps, double speed_mps, double pitch_rad, double distance_m) {
    const bt_features f = bt_features_of(&study, inputs, 4);
    const double x[] = {sink_mps, speed_mps, pitch_rad, distance_m};
    double extended[5];
    assert_int_equal(f.count, 1);
    bt_features_extend(&f, x, 1, extended);
    assert_memory_equal(x, extended, sizeof x);
    return extended[4];
}

/// Level, with the cable right under the wheels: the height of the tyres over the hook. From there
/// on the wheels sink V_V / V_E per metre, and they are never told more than half a tyre's radius
/// deep or a radius high.
static void height_is_that_of_the_glide_and_is_clipped(void** state) {
    (void)state;
    const bt_aircraft_params* a = &study.model.aircraft;
    const double hook_x = a->hook.pivot_x_m - a->hook.length_m * cos(a->hook.down_stop_rad);
    const double hook_z = a->hook.pivot_z_m - a->hook.length_m * sin(a->hook.down_stop_rad) -
                          a->hook.profile.shoe_radius_m;
    const double over = a->main_gear.underside_m - hook_z, ahead = a->main_gear.station_m - hook_x;
    const double radius = a->main_gear.tyre.radius_m;
    assert_true(over > -0.5 * radius && over < radius);
    BT_ASSERT_NEAR(feature(3.6, 47.5, 0, ahead), over, 1e-12, 0);
    BT_ASSERT_NEAR(feature(3.6, 47.5, 0, ahead + 0.5), over - 0.5 * 3.6 / 47.5, 1e-12, 0);
    assert_true(feature(6, 40, 0, 20) == -0.5 * radius);
    assert_true(feature(3.6, 47.5, 0.17, 0) == radius);
}

static void it_can_be_switched_off_and_needs_an_input(void** state) {
    (void)state;
    const bt_features none = bt_features_of(&study, inputs, 0);
    assert_int_equal(none.count, 0);
    study.surrogate.features = false;
    assert_int_equal(bt_features_of(&study, inputs, 4).count, 0);
    study.surrogate.features = true;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(height_is_that_of_the_glide_and_is_clipped),
        cmocka_unit_test(it_can_be_switched_off_and_needs_an_input),
    };
    return cmocka_run_group_tests(tests, make_study, NULL);
}
