/// Legs with a rake and levered legs by closed forms: docs/theory/levered.md.
#include "reference.h"

#include "landing/leg.h"
#include "mechanics/vec.h"
#include "rigs/rigs.h"

#include <math.h>

static const double g0 = 9.80665;

/// A leg of invented numbers: arm 0.75 m long trailing from its pivot, strut above its middle.
static bt_gear_params levered(void) {
    bt_gear_params g;
    bt_group_set_defaults(&bt_gear_group, &g);
    g.type = BT_LEG_LEVERED;
    g.arm = (bt_arm_params){.pivot_x_m = 0.7,
                            .pivot_z_m = 0.25,
                            .foot_x_m = 0.25,
                            .foot_z_m = 0.15,
                            .head_x_m = 0.45,
                            .head_z_m = 1.0};
    g.oleo.stroke_max_m = 0.3;
    g.oleo.air_volume_m3 = 4.5e-3;
    g.oleo.precharge_Pa = 5e6;
    g.oleo.orifice_area_m2 = 300e-6;
    return g;
}

static bt_drop_params drop(double mass_kg) {
    bt_drop_params d;
    bt_group_set_defaults(&bt_drop_group, &d);
    d.mass_kg = mass_kg;
    d.lift_ratio = 0;
    return d;
}

static double metric(const bt_rig_result* r, const char* name) {
    for (int i = 0; i < r->metric_count; ++i)
        if (strcmp(r->metrics[i].name, name) == 0)
            return r->metrics[i].value;
    fail_msg("no metric %s", name);
    return NAN;
}

static bt_rig_result dropped(const bt_gear_params* g, const bt_drop_params* d,
                             bt_rig_observer* observer, void* user) {
    bt_rig_result r;
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    if (bt_rig_run_drop(g, d, &r, observer, user, &diag) != BT_OK)
        fail_msg("refused: %s", kept.text);
    return r;
}

/* ---- geometry ---- */

/// The strut's length and the arm's turn, from nothing but the places of its ends.
static void stroke_and_turn_of_the_arm_are_those_of_its_ends(void** state) {
    (void)state;
    const bt_gear_params g = levered();
    bt_leg leg;
    bt_leg_prepare(&g, &leg);
    for (double stroke = -0.001; stroke <= g.oleo.stroke_max_m; stroke += 0.0101) {
        bt_leg_place p;
        bt_leg_at(&leg, stroke, &p);
        // the foot, carried by the body's own place and attitude
        const double turn = -2 * atan2(p.attitude[2], p.attitude[0]);
        const double x = leg.foot_m[0] - leg.centre_m[0], z = leg.foot_m[2] - leg.centre_m[2];
        const double foot_x = p.piston_m[0] + x * cos(turn) - z * sin(turn);
        const double foot_z = p.piston_m[2] + x * sin(turn) + z * cos(turn);
        const double length = hypot(leg.head_m[0] - foot_x, leg.head_m[2] - foot_z);
        const double at_rest = hypot(0.2, 0.85);
        BT_ASSERT_NEAR(at_rest - length, stroke, 0, 1e-13);
        BT_ASSERT_NEAR(hypot(p.axle_m[0] - 0.7, p.axle_m[2] - 0.25), hypot(0.7, 0.25), 1e-14, 0);
        assert_true(stroke <= 0 || p.axle_m[2] > 0);
    }
}

/// r = ds/dtheta, and the load ratio is dz/ds turned round: virtual work, by differences.
static void lever_arm_is_the_slope_of_the_stroke(void** state) {
    (void)state;
    const bt_gear_params g = levered();
    bt_leg leg;
    bt_leg_prepare(&g, &leg);
    for (double stroke = 0; stroke < 0.3; stroke += 0.05) {
        const double h = 1e-5;
        bt_leg_place before, after;
        bt_leg_at(&leg, stroke - h, &before);
        bt_leg_at(&leg, stroke + h, &after);
        const double turned = 2 * atan2(after.attitude[2], after.attitude[0]) -
                              2 * atan2(before.attitude[2], before.attitude[0]);
        BT_ASSERT_NEAR(2 * h / fabs(turned), bt_leg_lever(&leg, stroke), 1e-8, 0);
        BT_ASSERT_NEAR((after.axle_m[2] - before.axle_m[2]) / (2 * h),
                       bt_leg_load_ratio(&leg, stroke), 1e-8, 0);
    }
}

static void impossible_legs_are_refused_by_name(void** state) {
    (void)state;
    bt_gear_params g = levered();
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    g.arm.head_z_m = -0.7; // below the arm: the strut would pull the wheel down as it shortens
    assert_int_equal(bt_group_check(&bt_gear_group, &g, "gear", &diag), BT_ERR_INPUT);
    assert_non_null(strstr(kept.text, "gear.arm: the wheel does not rise"));
    g = levered();
    g.oleo.stroke_max_m = 0.6;
    g.oleo.air_volume_m3 = 1e-2;
    kept.text[0] = 0;
    assert_int_equal(bt_group_check(&bt_gear_group, &g, "gear", &diag), BT_ERR_INPUT);
    if (!strstr(kept.text, "gear.arm: head, foot and pivot"))
        fail_msg("%s", kept.text);
    g = levered();
    g.rake_rad = 0.1;
    kept.text[0] = 0;
    assert_int_equal(bt_group_check(&bt_gear_group, &g, "gear", &diag), BT_ERR_INPUT);
    assert_non_null(strstr(kept.text, "gear.rake: "));
    g = levered();
    g.type = BT_LEG_TELESCOPIC;
    kept.text[0] = 0;
    assert_int_equal(bt_group_check(&bt_gear_group, &g, "gear", &diag), BT_ERR_INPUT);
    assert_non_null(strstr(kept.text, "type: levered would do"));
}

/* ---- rest ---- */

static void keep_last(void* user, const bt_rig_sample* sample) {
    memcpy(user, sample->values, sizeof(double) * (size_t)sample->count);
}

enum { STROKE, RATE, STRUT, SINKAGE, TYRE, TYRE_FORCE, DRAG, SPIN, SIDE, CHANNELS };

/// Friction that develops slowly is a damper: what swings comes to rest.
static void settle(bt_gear_params* g, double mass_kg, double channel[CHANNELS]) {
    g->oleo.seal_friction_N = 2e4;
    g->oleo.friction_speed_mps = 1;
    g->tyre.damping_Npmps = 2e4;
    g->tyre.slip_speed_mps = 20; // a wheel that stands needs no short steps
    bt_drop_params d = drop(mass_kg);
    d.sink_speed_mps = 0;
    d.duration_s = 20;
    dropped(g, &d, keep_last, channel);
    assert_true(fabs(channel[RATE]) < 1e-6);
}

/// Moments about the pivot: F r = (V - m_w g) (x_P - x_A) - m_arm g (x_P - x_C), V = M g; the
/// stroke is that of the gas law there, and the pivot bears what the strut and the wheel leave.
static void a_levered_leg_rests_where_its_moments_balance(void** state) {
    (void)state;
    bt_gear_params g = levered();
    const double mass = 5000;
    double at[CHANNELS];
    settle(&g, mass, at);
    bt_leg leg;
    bt_leg_place p;
    bt_oleo oleo;
    bt_leg_prepare(&g, &leg);
    bt_oleo_prepare(&g.oleo, &oleo);
    bt_leg_at(&leg, at[STROKE], &p);
    const double load = (mass - g.wheel_mass_kg) * g0, arm = g.piston_mass_kg * g0;
    const double moment = load * (0.7 - p.axle_m[0]) - arm * (0.7 - p.piston_m[0]);
    const double force = moment / bt_leg_lever(&leg, at[STROKE]);
    BT_ASSERT_NEAR(at[TYRE_FORCE], mass * g0, 1e-7, 0);
    BT_ASSERT_NEAR(at[STRUT], force, 1e-6, 0);
    BT_ASSERT_NEAR(bt_oleo_gas_force(&oleo, at[STROKE]), force, 1e-6, 0);
    // along the strut, whose direction is that from foot to head
    const double turn = -2 * atan2(p.attitude[2], p.attitude[0]);
    const double x = leg.foot_m[0] - leg.centre_m[0], z = leg.foot_m[2] - leg.centre_m[2];
    const double dx = 0.45 - (p.piston_m[0] + x * cos(turn) - z * sin(turn));
    const double dz = 1.0 - (p.piston_m[2] + x * sin(turn) + z * cos(turn));
    const double pivot_x = force * dx / hypot(dx, dz);
    const double pivot_z = force * dz / hypot(dx, dz) + arm - load;
    BT_ASSERT_NEAR(at[SIDE], hypot(pivot_x, pivot_z), 1e-6, 0);
}

/// A raked leg whose wheel rolls freely: F = V cos r along the strut, V sin r on its bearings, the
/// mass comes down by stroke times cos r; so that it is 1 / cos^2 r as stiff as upright.
static void a_raked_leg_rests_on_its_bearings(void** state) {
    (void)state;
    for (int k = -1; k <= 1; k += 2) {
        bt_gear_params g;
        bt_group_set_defaults(&bt_gear_group, &g);
        g.oleo.orifice_area_m2 = 300e-6;
        g.rake_rad = k * 0.2;
        const double mass = 7000;
        double at[CHANNELS];
        settle(&g, mass, at);
        const double load = (mass - g.wheel_mass_kg - g.piston_mass_kg) * g0;
        BT_ASSERT_NEAR(at[STRUT], load * cos(0.2), 1e-6, 0);
        BT_ASSERT_NEAR(at[SIDE], load * sin(0.2), 1e-6, 0);
        bt_oleo oleo;
        bt_oleo_prepare(&g.oleo, &oleo);
        const double hung = bt_oleo_hanging_stroke(&oleo, 0);
        BT_ASSERT_NEAR(at[SINKAGE] - at[TYRE], (at[STROKE] - hung) * cos(0.2), 0, 1e-8);
    }
}

/* ---- swinging ---- */

/// A straight spring instead of gas and oil, light parts, a tyre far stiffer than the leg.
static void make_spring(bt_gear_params* g, double preload_N, double stiffness_Npm,
                        double tyre_Npm) {
    g->oleo.spring = BT_SPRING_POINTS;
    g->oleo.spring_points = (bt_table){2, {0, 0.5}, {preload_N, preload_N + 0.5 * stiffness_Npm}};
    g->oleo.oil_area_m2 = 0;
    g->oleo.stop_stiffness_Npm = 1e9;
    g->oleo.friction_speed_mps = 1;
    g->piston_mass_kg = 10;
    g->wheel_mass_kg = 100;
    g->tyre.law = BT_TYRE_POINTS;
    g->tyre.load_points = (bt_table){1, {0.01}, {0.01 * tyre_Npm}};
    g->tyre.damping_Npmps = 2e4;
    g->tyre.friction = g->tyre.locked_friction = 0; // slides or rolls alike
}

typedef struct swing {
    double rate_mps, before_s, first_s, last_s;
    int count;
} swing;

/// Moments at which the leg is most compressed.
static void see_swing(void* user, const bt_rig_sample* sample) {
    swing* s = user;
    const double rate = sample->values[RATE], from_s = 2, in_m = 5e-4;
    if (sample->time_s > from_s && sample->values[STROKE] > in_m && s->rate_mps > 0 && rate <= 0) {
        s->last_s =
            s->before_s + (sample->time_s - s->before_s) * s->rate_mps / (s->rate_mps - rate);
        if (s->count++ == 0)
            s->first_s = s->last_s;
    }
    s->rate_mps = rate;
    s->before_s = sample->time_s;
}

/// The leg where it is shorter by a height; the stroke is returned.
static double shorten(const bt_leg* leg, double height_m, bt_leg_place* p) {
    double low = -0.01, high = 0.25;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        bt_leg_at(leg, middle, p);
        *(p->axle_m[2] < height_m ? &low : &high) = middle;
    }
    return low;
}

/// What the axle bears there.
static double held(const bt_leg* leg, double preload_N, double stiffness_Npm, double height_m) {
    bt_leg_place p;
    const double stroke = shorten(leg, height_m, &p);
    return (preload_N + stiffness_Npm * stroke) / bt_leg_load_ratio(leg, stroke);
}

/// What swings where the mass goes down by dz and the axle stays on the ground: 2 T / (dz/dt)^2.
static double swinging_mass(const bt_leg* leg, const bt_gear_params* g, double mass_kg,
                            double height_m) {
    const double h = 1e-4;
    bt_leg_place a, b;
    shorten(leg, height_m - h, &a);
    shorten(leg, height_m + h, &b);
    const double wheel_x = (b.axle_m[0] - a.axle_m[0]) / (2 * h);
    const double arm_x = (b.piston_m[0] - a.piston_m[0]) / (2 * h);
    const double arm_z = (b.piston_m[2] - a.piston_m[2]) / (2 * h) - 1;
    const double turn =
        2 * (atan2(b.attitude[2], b.attitude[0]) - atan2(a.attitude[2], a.attitude[0])) / (2 * h);
    const double rod =
        leg->levered ? g->piston_mass_kg * bt_dot(leg->pivot_m, leg->pivot_m) / 12 : 0;
    return mass_kg - g->piston_mass_kg - g->wheel_mass_kg + g->wheel_mass_kg * wheel_x * wheel_x +
           g->piston_mass_kg * (arm_x * arm_x + arm_z * arm_z) + rod * turn * turn;
}

/// omega^2 = K / M; K is the slope of what the leg holds over its height (the tyre is 3,000 times
/// as stiff, in series). Swings by 2 mm about a place of rest that is 2 mm in. Returns K.
static double check_frequency(bt_gear_params g) {
    static const double mass = 5000, preload = 2.5e4, k = 3e5, tyre = 1e9, deep = 2e-3;
    bt_leg leg;
    swing s = {0};
    bt_drop_params d = drop(mass);
    make_spring(&g, preload, k, tyre);
    bt_leg_prepare(&g, &leg);
    const double ratio = bt_leg_load_ratio(&leg, 0), damping = 4000; // of the axle's height
    g.oleo.seal_friction_N = damping * ratio * ratio / 1.5;          // over friction_speed
    const double load = held(&leg, preload, k, deep);
    const double slope =
        (held(&leg, preload, k, deep + 1e-4) - held(&leg, preload, k, deep - 1e-4)) / 2e-4;
    // the load on the axle is the weight that lift leaves, but for what the axle itself weighs
    d.sink_speed_mps = 0;
    d.lift_ratio = 1 - (load + g.wheel_mass_kg * g0) / (mass * g0);
    d.duration_s = 10;
    dropped(&g, &d, see_swing, &s);
    assert_true(s.count > 4);
    const double omega = 2 * M_PI * (s.count - 1) / (s.last_s - s.first_s);
    const double m = swinging_mass(&leg, &g, mass, deep);
    const double stiffness = 1 / (1 / slope + 1 / tyre), half = 0.5 * damping / m;
    BT_ASSERT_NEAR(omega, sqrt(stiffness / m - half * half), 5e-4, 0);
    return slope;
}

static void small_swings_of_a_raked_leg_have_k_over_cos2(void** state) {
    (void)state;
    bt_gear_params g;
    bt_group_set_defaults(&bt_gear_group, &g);
    g.rake_rad = 0.35;
    BT_ASSERT_NEAR(check_frequency(g), 3e5 / (cos(0.35) * cos(0.35)), 1e-6, 0);
}

/// An arm that lies level with the strut upright on its middle has a quarter of the spring's
/// stiffness and half the load, and the turning of the arm adds F times the curvature.
static void small_swings_of_a_levered_leg_have_its_slope(void** state) {
    (void)state;
    bt_gear_params g = levered();
    g.arm = (bt_arm_params){
        .pivot_x_m = 1, .foot_x_m = 0.5, .head_x_m = 0.5, .head_z_m = 5}; // a very long strut
    BT_ASSERT_NEAR(check_frequency(g), 0.25 * 3e5, 5e-2, 0);
    check_frequency(levered());
}

/* ---- energy ---- */

static void check_energy(const bt_gear_params* g) {
    bt_drop_params d = drop(5000);
    d.sink_speed_mps = 3;
    d.belt_speed_mps = 40;
    d.step_s = 5e-5;
    const bt_rig_result r = dropped(g, &d, NULL, NULL);
    const double in = metric(&r, "impact_energy_J") + metric(&r, "weight_work_J");
    BT_ASSERT_NEAR(metric(&r, "energy_residual_J"), 0, 0, 1e-4 * in);
    assert_true(metric(&r, "stroke_max_m") > 0.1);
}

static void drops_of_such_legs_account_for_their_energy(void** state) {
    (void)state;
    bt_gear_params g = levered();
    check_energy(&g);
    bt_group_set_defaults(&bt_gear_group, &g);
    g.oleo.orifice_area_m2 = 300e-6;
    g.rake_rad = 0.3;
    check_energy(&g);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stroke_and_turn_of_the_arm_are_those_of_its_ends),
        cmocka_unit_test(lever_arm_is_the_slope_of_the_stroke),
        cmocka_unit_test(impossible_legs_are_refused_by_name),
        cmocka_unit_test(a_levered_leg_rests_where_its_moments_balance),
        cmocka_unit_test(a_raked_leg_rests_on_its_bearings),
        cmocka_unit_test(small_swings_of_a_raked_leg_have_k_over_cos2),
        cmocka_unit_test(small_swings_of_a_levered_leg_have_its_slope),
        cmocka_unit_test(drops_of_such_legs_account_for_their_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
