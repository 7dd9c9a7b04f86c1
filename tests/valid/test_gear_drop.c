/// The leg against numbers that nobody here made: a regression with the constants of NACA TR 1154
/// as remembered, an energy balance published with a light-aircraft code, and Currey's static
/// curve.
#include "elements/strut.h"
#include "elements/wheel.h"
#include "near.h"
#include "rigs/rigs.h"

static const double foot = 0.3048, inch = 0.0254, pound = 0.45359237;
static const double gravity = 32.174 * 0.3048;

/// Weight of a pound where g is 32.174 ft/s^2, N.
static double lbf(double value) {
    return value * pound * gravity;
}

typedef struct history {
    double closes_s; ///< when the strut leaves its stop
    double stroke_s, sinkage_s, tyre_s, stroke, sinkage, tyre;
} history;

static void note(double time_s, double value, double* most, double* when) {
    if (value > *most) {
        *most = value;
        *when = time_s;
    }
}

static void watch(void* user, const bt_rig_sample* sample) {
    history* h = user;
    if (h->closes_s == 0 && sample->values[0] > 0)
        h->closes_s = sample->time_s;
    note(sample->time_s, sample->values[0], &h->stroke, &h->stroke_s);
    note(sample->time_s, sample->values[3], &h->sinkage, &h->sinkage_s);
    note(sample->time_s, sample->values[4], &h->tyre, &h->tyre_s);
}

static bt_gear_params tr1154_gear(void) {
    bt_gear_params g;
    bt_group_set_defaults(&bt_gear_group, &g);
    g.piston_mass_kg = 120 * pound;
    g.wheel_mass_kg = 11 * pound;
    g.oleo.air_area_m2 = 0.05761 * foot * foot;
    g.oleo.precharge_Pa = lbf(6264) / (foot * foot);
    g.oleo.ambient_Pa = 0;
    g.oleo.air_volume_m3 = 0.03545 * foot * foot * foot;
    g.oleo.gas_exponent = 1.12;
    g.oleo.oil_area_m2 = 0.04708 * foot * foot;
    g.oleo.orifice_area_m2 = 0.0005585 * foot * foot;
    g.oleo.discharge = 0.9;
    g.oleo.oil_density_kgpm3 = 1.62 * 32.174 * pound / (foot * foot * foot);
    g.oleo.stroke_max_m = 0.6 * foot;
    g.oleo.stop_stiffness_Npm = 1e12; // rigid until the precharge is passed
    g.tyre.radius_m = 0.5 * 27 * inch;
    g.tyre.law = BT_TYRE_POWER;
    g.tyre.power_deflection_m = 2.25 * foot;
    g.tyre.power_load_N = lbf(82.5e3);
    g.tyre.power_exponent = 1.34;
    g.tyre.damping_Npmps = 0;
    return g;
}

/// Regression, not validation: the constants are from memory and the reference is an independent
/// integration with them, printed to four digits or more.
static void regression_tr1154_drop(void** state) {
    (void)state;
    const bt_gear_params g = tr1154_gear();
    bt_drop_params d;
    bt_group_set_defaults(&bt_drop_group, &d);
    d.mass_kg = 2542 * pound;
    d.gravity_mps2 = gravity;
    d.sink_speed_mps = 8.86 * foot;
    d.step_s = 2e-6; // resolves the unsprung mass on that stop
    d.duration_s = 0.2;
    bt_rig_result r;
    history h = {0};
    assert_int_equal(bt_rig_run_drop(&g, &d, &r, watch, &h, NULL), BT_OK);
    BT_ASSERT_NEAR(h.closes_s, 0.00578, 0, 2e-5);
    BT_ASSERT_NEAR(r.metrics[3].value, lbf(7262.9), 1e-4, 0);
    BT_ASSERT_NEAR(h.tyre / foot, 0.3670, 0, 5e-5);
    BT_ASSERT_NEAR(h.tyre_s, 0.0836, 0, 6e-5);
    // Deceleration of the upper mass: strut force and the lift beyond its own weight.
    BT_ASSERT_NEAR((r.metrics[4].value + lbf(131)) / lbf(2411), 2.861, 0, 6e-4);
    BT_ASSERT_NEAR(h.sinkage / foot, 0.7159, 0, 6e-5);
    BT_ASSERT_NEAR(h.sinkage_s, 0.1359, 0, 1e-4);
    BT_ASSERT_NEAR(h.stroke / foot, 0.5143, 0, 6e-5);
    BT_ASSERT_NEAR(h.stroke_s, 0.1744, 0, 1e-4);
}

/* Energy balance: linear strut, no damping anywhere */

enum { BODY_MASS, BODY_WHEEL };

/// A linear spring along z between wheel and mass, in place of the oleo.
typedef struct linear_strut {
    double stiffness_Npm, length_m;
} linear_strut;

static double shortening(const bt_element* e, const bt_motion* m) {
    const linear_strut* s = e->data;
    return s->length_m - (m->q[7 * BODY_MASS + 2] - m->q[7 * BODY_WHEEL + 2]);
}

static void push(const bt_element* e, const bt_motion* m, double* wrench, double* output) {
    const linear_strut* s = e->data;
    output[0] = shortening(e, m);
    wrench[6 * BODY_MASS + 2] += s->stiffness_Npm * output[0];
    wrench[6 * BODY_WHEEL + 2] -= s->stiffness_Npm * output[0];
}

static double stored(const bt_element* e, const bt_motion* m) {
    const linear_strut* s = e->data;
    const double x = shortening(e, m);
    return 0.5 * s->stiffness_Npm * x * x;
}

static const char* const linear_names[] = {"stroke_m"};
static const bt_element_type linear_type = {
    "linear_strut", sizeof(linear_strut), 1, linear_names, push, stored, false};

static bt_tyre_params goodyear_tyre(void) {
    static const double points[][2] = {{0.535, 270},  {0.910, 530},  {1.180, 740},  {1.300, 840},
                                       {1.460, 980},  {1.650, 1160}, {1.840, 1345}, {2.020, 1525},
                                       {2.210, 1725}, {2.455, 2000}, {2.670, 2250}, {2.825, 2500},
                                       {2.895, 2700}};
    bt_tyre_params p;
    bt_group_set_defaults(&bt_tyre_group, &p);
    p.radius_m = 0.5 * 13.9 * inch;
    p.law = BT_TYRE_POINTS;
    p.damping_Npmps = 0;
    p.load_points.count = 13;
    for (int i = 0; i < 13; ++i) {
        p.load_points.x[i] = points[i][0] * inch;
        p.load_points.y[i] = lbf(points[i][1]);
    }
    return p;
}

static void add_sliding_body(bt_system* system, const char* name, double mass_kg, double height_m,
                             double sink_mps) {
    const bt_body_def body = {.name = name,
                              .mass_kg = mass_kg,
                              .inertia_kgm2 = {mass_kg, mass_kg, mass_kg},
                              .position_m = {0, 0, height_m},
                              .attitude = {1, 0, 0, 0},
                              .velocity_mps = {0, 0, -sink_mps}};
    const bt_joint_def guide = {.name = name,
                                .kind = BT_JOINT_PRISMATIC,
                                .body_a = BT_GROUND,
                                .body_b = bt_system_add_body(system, &body),
                                .axis_a = {0, 0, 1},
                                .axis_b = {0, 0, 1},
                                .attitude_ab = {1, 0, 0, 0}};
    bt_system_add_joint(system, &guide);
}

/// 600 lb on a leg with 2/3 of it carried by lift, 7 ft/s; strut 2158.3 lbf/ft and the 5.00-5 tyre.
/// The unsprung part weighs 2e-5 lb here, nothing there. Published to three and four digits.
static void energy_balance_of_a_light_aircraft_leg(void** state) {
    (void)state;
    const double weight = 600, unsprung = 2e-5;
    const bt_tyre_params params = goodyear_tyre();
    bt_wheel wheel = {0};
    bt_tyre_prepare(&params, &wheel.tyre);
    const linear_strut strut = {lbf(2158.3) / foot, 1};

    bt_system* system;
    bt_arena arena;
    bt_state motion;
    assert_int_equal(bt_system_create(&system), BT_OK);
    add_sliding_body(system, "mass", (weight - unsprung) * pound, params.radius_m + 1, 7 * foot);
    add_sliding_body(system, "wheel", unsprung * pound, params.radius_m, 7 * foot);
    const int spring = bt_system_add_element(
        system, &(bt_element){&linear_type, "strut", BODY_MASS, BODY_WHEEL, &strut});
    const int tyre = bt_system_add_element(
        system, &(bt_element){&bt_wheel_type, "tyre", BODY_WHEEL, BT_GROUND, &wheel});
    const double down[3] = {0, 0, -gravity};
    bt_system_set_gravity(system, down);
    assert_int_equal(bt_system_assemble(system, NULL), BT_OK);
    assert_int_equal(bt_arena_create(&arena, bt_state_size(system) + 64), BT_OK);
    assert_int_equal(bt_state_create(system, &arena, &motion), BT_OK);

    double most_stroke = 0, most_tyre = 0, most_load = 0;
    bt_failure failure;
    for (int i = 0; i < 100000; ++i) {
        motion.applied[6 * BODY_MASS + 2] = lbf(weight) * 2 / 3;
        assert_int_equal(
            bt_system_step(system, &motion, 2e-6, BT_INTEGRATOR_SECOND_ORDER, &failure), BT_OK);
        most_stroke = fmax(most_stroke, bt_system_element_output(system, &motion, spring)[0]);
        const double* out = bt_system_element_output(system, &motion, tyre);
        most_tyre = fmax(most_tyre, out[BT_WHEEL_DEFLECTION]);
        most_load = fmax(most_load, out[BT_WHEEL_NORMAL]);
    }
    const double strut_energy = 0.5 * strut.stiffness_Npm * most_stroke * most_stroke;
    const double tyre_energy = bt_tyre_energy(&wheel.tyre, most_tyre);
    BT_ASSERT_NEAR(most_stroke / foot, 0.695, 1e-3, 0);
    BT_ASSERT_NEAR(most_tyre / foot, 0.166, 3.1e-3, 0);
    BT_ASSERT_NEAR(most_load / lbf(1), 1500.5, 1e-3, 0);
    BT_ASSERT_NEAR(strut_energy / (foot * lbf(1)), 521.6, 2e-3, 0);
    BT_ASSERT_NEAR(tyre_energy / (foot * lbf(1)), 107.5, 3e-3, 0);
    BT_ASSERT_NEAR(tyre_energy / (most_tyre * most_load), 0.43107, 2e-3, 0);
    bt_arena_destroy(&arena);
    bt_system_destroy(system);
}

/// Currey, Aircraft Landing Gear Design, Fig. 5.31 (digitised). One chamber, three constants fitted
/// to the curve once, outside (preload 6465 lbf, gas length 17.29 in, n = 1.1): within 3.6 %.
static void eq3_one_chamber_follows_curreys_static_curve(void** state) {
    (void)state;
    static const double curve[][2] = {
        {0.889, 6778},   {1.965, 7131},   {2.951, 7827},   {3.937, 8639},   {4.924, 9565},
        {5.933, 10606},  {7.012, 11877},  {7.954, 13147},  {8.988, 14762},  {9.978, 16951},
        {10.992, 19484}, {11.966, 23852}, {13.083, 30402}, {14.048, 39705}, {14.530, 47972},
        {14.895, 55319}, {15.093, 60484}, {15.223, 65764}, {15.379, 72077}, {15.521, 81717}};
    bt_oleo_params p;
    bt_group_set_defaults(&bt_oleo_group, &p);
    p.ambient_Pa = 0;
    p.air_area_m2 = 0.01;
    p.precharge_Pa = lbf(6465) / p.air_area_m2;
    p.air_volume_m3 = 17.29 * inch * p.air_area_m2;
    p.gas_exponent = 1.1;
    p.orifice_area_m2 = 1e-4;
    bt_oleo o;
    bt_oleo_prepare(&p, &o);
    for (int i = 0; i < 20; ++i)
        BT_ASSERT_NEAR(bt_oleo_gas_force(&o, curve[i][0] * inch), lbf(curve[i][1]), 0.036, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(regression_tr1154_drop),
        cmocka_unit_test(energy_balance_of_a_light_aircraft_leg),
        cmocka_unit_test(eq3_one_chamber_follows_curreys_static_curve),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
