#include "near.h"
#include "rigs/rigs.h"

/// Main leg of the reference aircraft.
static bt_gear_params main_gear(void) {
    bt_gear_params g;
    bt_group_set_defaults(&bt_gear_group, &g);
    g.oleo.rebound_ratio = 0.2;
    g.oleo.orifice_table = (bt_table){4, {0, 0.09, 0.45, 0.60}, {375e-6, 300e-6, 200e-6, 160e-6}};
    return g;
}

static bt_drop_params main_drop(void) {
    bt_drop_params d;
    bt_group_set_defaults(&bt_drop_group, &d);
    return d;
}

static double metric(const bt_rig_result* r, const char* name) {
    for (int i = 0; i < r->metric_count; ++i)
        if (strcmp(r->metrics[i].name, name) == 0)
            return r->metrics[i].value;
    fail_msg("no metric %s", name);
    return NAN;
}

static bt_rig_result dropped(const bt_gear_params* g, const bt_drop_params* d) {
    bt_rig_result r;
    bt_diag diag = {0};
    assert_int_equal(bt_rig_run_drop(g, d, &r, NULL, NULL, &diag), BT_OK);
    assert_int_equal(diag.errors, 0);
    return r;
}

static void drop_at_no_speed_with_full_lift_stays_where_it_is(void** state) {
    (void)state;
    const bt_gear_params g = main_gear();
    bt_drop_params d = main_drop();
    d.sink_speed_mps = 0;
    const bt_rig_result r = dropped(&g, &d);
    BT_ASSERT_NEAR(metric(&r, "sinkage_max_m"), 0, 0, 1e-6);
    BT_ASSERT_NEAR(metric(&r, "tyre_force_max_N"), 0, 0, 1);
}

static void keep_last(void* user, const bt_rig_sample* sample) {
    memcpy(user, sample->values, sizeof(double) * (size_t)sample->count);
}

typedef struct means {
    long count;
    double strut_N, tyre_N, stroke_m;
} means;

/// Sums over the second half of a run of 20 s.
static void add_up(void* user, const bt_rig_sample* sample) {
    means* m = user;
    if (sample->time_s < 10)
        return;
    ++m->count;
    m->stroke_m += sample->values[0];
    m->strut_N += sample->values[2];
    m->tyre_N += sample->values[5];
}

/// Without lift the leg ends up carrying the weight, and its stroke swings about that of the gas
/// curve (the swing dies out slowly: the damping is quadratic).
static void drop_from_rest_without_lift_settles_at_the_static_load(void** state) {
    (void)state;
    const bt_gear_params g = main_gear();
    bt_drop_params d = main_drop();
    d.sink_speed_mps = 0;
    d.lift_ratio = 0;
    d.duration_s = 20;
    bt_rig_result r;
    means m = {0};
    assert_int_equal(bt_rig_run_drop(&g, &d, &r, add_up, &m, NULL), BT_OK);
    bt_oleo oleo;
    bt_oleo_prepare(&g.oleo, &oleo);
    const double n = (double)m.count, unsprung = g.piston_mass_kg + g.wheel_mass_kg;
    const double sprung_weight = (d.mass_kg - unsprung) * d.gravity_mps2;
    BT_ASSERT_NEAR(m.strut_N / n, sprung_weight, 2e-4, 0);
    BT_ASSERT_NEAR(m.tyre_N / n, d.mass_kg * d.gravity_mps2, 2e-4, 0);
    BT_ASSERT_NEAR(bt_oleo_gas_force(&oleo, m.stroke_m / n), sprung_weight, 2e-3, 0);
}

/// The usual step is converged: a step forty times finer changes no metric by 0.02 %.
static void drop_converges_with_the_step(void** state) {
    (void)state;
    const bt_gear_params g = main_gear();
    bt_drop_params d = main_drop();
    static const char* const names[] = {"stroke_max_m", "sinkage_max_m", "tyre_compression_max_m",
                                        "tyre_force_max_N"};
    d.step_s = 1e-5;
    const bt_rig_result fine = dropped(&g, &d);
    d.step_s = main_drop().step_s;
    const bt_rig_result usual = dropped(&g, &d);
    for (int i = 0; i < 4; ++i)
        BT_ASSERT_NEAR(metric(&usual, names[i]), metric(&fine, names[i]), 2e-4, 0);
}

/// The single-leg integration of the feasibility study, same legs, to its printed digits. Its
/// tables are linear between rows and its tyres undamped.
static void drop_of_the_reference_legs_agrees_with_another_code(void** state) {
    (void)state;
    bt_gear_params g = main_gear();
    bt_drop_params d = main_drop();
    g.oleo.orifice_law = BT_CURVE_LINEAR;
    g.tyre.damping_Npmps = 0;
    const bt_rig_result main_leg = dropped(&g, &d);
    BT_ASSERT_NEAR(metric(&main_leg, "stroke_max_m"), 0.577, 0, 5e-4);
    BT_ASSERT_NEAR(metric(&main_leg, "sinkage_max_m"), 0.654, 0, 5e-4);
    BT_ASSERT_NEAR(metric(&main_leg, "tyre_compression_max_m"), 0.108, 0, 5e-4);
    BT_ASSERT_NEAR(metric(&main_leg, "tyre_force_max_N"), 319e3, 0, 500);

    g.piston_mass_kg = 50;
    g.wheel_mass_kg = 30;
    g.wheel_inertia_kgm2 = 1;
    g.oleo.air_area_m2 = 6200e-6;
    g.oleo.precharge_Pa = 2e6;
    g.oleo.air_volume_m3 = 3.33e-3;
    g.oleo.oil_area_m2 = 5200e-6;
    g.oleo.stroke_max_m = 0.45;
    g.oleo.orifice_table = (bt_table){4, {0, 0.068, 0.338, 0.45}, {200e-6, 160e-6, 100e-6, 80e-6}};
    g.tyre.tyres = 2;
    g.tyre.width_m = 0.168;
    g.tyre.radius_m = 0.5 * 0.559;
    d.mass_kg = 3500;
    const bt_rig_result nose = dropped(&g, &d);
    BT_ASSERT_NEAR(metric(&nose, "stroke_max_m"), 0.435, 2.5e-3, 0);
    BT_ASSERT_NEAR(metric(&nose, "sinkage_max_m"), 0.462, 2.5e-3, 0);
    BT_ASSERT_NEAR(metric(&nose, "tyre_compression_max_m"), 0.051, 0, 5e-4);
    BT_ASSERT_NEAR(metric(&nose, "tyre_force_max_N"), 173e3, 5e-3, 0);
}

static void belt_spins_the_wheel_up_and_drags(void** state) {
    (void)state;
    const bt_gear_params g = main_gear();
    bt_drop_params d = main_drop();
    const bt_rig_result rest = dropped(&g, &d);
    assert_true(metric(&rest, "drag_force_max_N") == 0);
    assert_true(isnan(metric(&rest, "spin_up_time_s")));
    d.belt_speed_mps = 47.5;
    const bt_rig_result belt = dropped(&g, &d);
    assert_true(metric(&belt, "spin_up_time_s") > 0 && metric(&belt, "spin_up_time_s") < 0.3);
    assert_true(metric(&belt, "drag_force_max_N") > 0.5 * metric(&belt, "tyre_force_max_N") * 0.3);
    // Guides take the drag: the vertical motion is the same.
    BT_ASSERT_NEAR(metric(&belt, "stroke_max_m"), metric(&rest, "stroke_max_m"), 1e-6, 0);
    d.belt_speed_mps = -47.5;
    const bt_rig_result back = dropped(&g, &d);
    BT_ASSERT_NEAR(metric(&back, "spin_up_time_s"), metric(&belt, "spin_up_time_s"), 1e-9, 0);
}

static void reference_gives_the_error_in_percent(void** state) {
    (void)state;
    const bt_gear_params g = main_gear();
    bt_drop_params d = main_drop();
    bt_rig_result r = dropped(&g, &d);
    assert_true(isnan(r.metrics[0].reference) && isnan(r.metrics[0].error_percent));
    assert_true(r.metrics[0].accepted);
    d.reference.stroke_max_m = r.metrics[0].value / 1.02;
    d.reference.sinkage_max_m = r.metrics[1].value / 1.04;
    r = dropped(&g, &d);
    BT_ASSERT_NEAR(r.metrics[0].error_percent, 2, 1e-9, 0);
    assert_true(r.metrics[0].accepted);
    BT_ASSERT_NEAR(r.metrics[1].error_percent, 4, 1e-9, 0);
    assert_false(r.metrics[1].accepted);
}

/// A value's own tolerance goes before the common one.
static void reference_may_have_its_own_tolerance(void** state) {
    (void)state;
    const bt_gear_params g = main_gear();
    bt_drop_params d = main_drop();
    bt_rig_result r = dropped(&g, &d);
    d.reference.stroke_max_m = r.metrics[0].value / 1.02;
    d.reference.stroke_max_tolerance = 0.01;
    r = dropped(&g, &d);
    assert_false(r.metrics[0].accepted);
    assert_true(r.metrics[0].tolerance == 0.01);
}

/// What the fall brings in is in strut and tyre when the mass stands still; the wheel swings on.
static void energies_add_up_to_that_of_the_fall(void** state) {
    (void)state;
    bt_gear_params g = main_gear();
    bt_drop_params d = main_drop();
    g.tyre.damping_Npmps = 0;
    const bt_rig_result r = dropped(&g, &d);
    const double in = 0.5 * d.mass_kg * d.sink_speed_mps * d.sink_speed_mps; // lift carries all
    const double strut = metric(&r, "strut_energy_J"), tyre = metric(&r, "tyre_energy_J");
    assert_true(strut < in && tyre < in && strut + tyre > in); // the tyre is fullest before
    assert_true(strut + tyre < 1.1 * in);
    BT_ASSERT_NEAR(metric(&r, "efficiency"),
                   strut / (metric(&r, "strut_force_max_N") * metric(&r, "stroke_max_m")), 1e-12,
                   0);
}

/// Seal friction that changes sign within 1 mm/s stays stable at the usual step.
static void drop_with_friction_converges_with_the_step(void** state) {
    (void)state;
    bt_gear_params g = main_gear();
    bt_drop_params d = main_drop();
    g.oleo.seal_coefficient = 0.07;
    g.oleo.friction_speed_mps = 1e-3;
    const bt_rig_result usual = dropped(&g, &d);
    d.step_s = 1e-5;
    const bt_rig_result fine = dropped(&g, &d);
    for (int i = 0; i < 5; ++i)
        BT_ASSERT_NEAR(usual.metrics[i].value, fine.metrics[i].value, 5e-4, 0);
}

static bt_rig_result pressed(const bt_gear_params* g, const bt_static_params* p,
                             bt_rig_observer* observer, void* user) {
    bt_rig_result r;
    assert_int_equal(bt_rig_run_static(g, p, &r, observer, user, NULL), BT_OK);
    return r;
}

/// On the press the strut is its gas: loads at both ends, and the gas's energy between them.
static void static_test_finds_the_gas_law(void** state) {
    (void)state;
    const bt_gear_params g = main_gear();
    bt_static_params p;
    bt_group_set_defaults(&bt_static_group, &p);
    const bt_rig_result r = pressed(&g, &p, NULL, NULL);
    bt_oleo o;
    bt_oleo_prepare(&g.oleo, &o);
    BT_ASSERT_NEAR(metric(&r, "load_extended_N"), bt_oleo_gas_force(&o, 0), 1e-4, 0);
    BT_ASSERT_NEAR(metric(&r, "load_compressed_N"), bt_oleo_gas_force(&o, 0.6), 1e-4, 0);
    BT_ASSERT_NEAR(metric(&r, "energy_J"), bt_oleo_gas_energy(&o, 0.6), 1e-4, 0);
    assert_true(metric(&r, "hysteresis_J") < 1); // the oil at 1 mm/s
    p.stroke_m = 0.3;
    const bt_rig_result half = pressed(&g, &p, NULL, NULL);
    BT_ASSERT_NEAR(metric(&half, "load_compressed_N"), bt_oleo_gas_force(&o, 0.3), 1e-4, 0);
}

/// Friction of the seals is there in full at any speed: twice its work is not given back.
static void static_test_shows_the_friction_as_hysteresis(void** state) {
    (void)state;
    bt_gear_params g = main_gear();
    bt_static_params p;
    bt_group_set_defaults(&bt_static_group, &p);
    g.oleo.seal_friction_N = 2e3;
    const bt_rig_result r = pressed(&g, &p, NULL, NULL);
    BT_ASSERT_NEAR(metric(&r, "hysteresis_J"), 2 * 2e3 * 0.6, 1e-3, 0);
}

static void static_test_beyond_the_gas_is_refused(void** state) {
    (void)state;
    const bt_gear_params g = main_gear();
    bt_static_params p;
    bt_rig_result r;
    bt_diag diag = {0};
    bt_group_set_defaults(&bt_static_group, &p);
    p.stroke_m = 1.1 * g.oleo.air_volume_m3 / g.oleo.air_area_m2;
    assert_int_equal(bt_rig_run_static(&g, &p, &r, NULL, NULL, &diag), BT_ERR_INPUT);
    assert_int_equal(diag.errors, 1);
}

static void drop_mass_below_the_leg_is_refused(void** state) {
    (void)state;
    const bt_gear_params g = main_gear();
    bt_drop_params d = main_drop();
    d.mass_kg = 170;
    bt_rig_result r;
    bt_diag diag = {0};
    assert_int_equal(bt_rig_run_drop(&g, &d, &r, NULL, NULL, &diag), BT_ERR_INPUT);
    assert_int_equal(diag.errors, 1);
}

/* Hook */

static bt_hook_params hook(void) {
    bt_hook_params h;
    bt_group_set_defaults(&bt_hook_group, &h);
    return h;
}

static bt_rebound_params basket(void) {
    bt_rebound_params p;
    bt_group_set_defaults(&bt_rebound_group, &p);
    return p;
}

static bt_rig_result rebounded(const bt_hook_params* h, const bt_rebound_params* p) {
    bt_rig_result r;
    bt_diag diag = {0};
    assert_int_equal(bt_rig_run_rebound(h, p, &r, NULL, NULL, &diag), BT_OK);
    assert_int_equal(diag.errors, 0);
    return r;
}

static void rebound_reports_one_bounce(void** state) {
    (void)state;
    const bt_hook_params h = hook();
    const bt_rebound_params p = basket();
    const bt_rig_result r = rebounded(&h, &p);
    assert_true(metric(&r, "rebound_height_m") > 5e-3 && metric(&r, "rebound_height_m") < 0.2);
    // Carried by the rim's speed, less the contact and the swing of the shank.
    assert_true(metric(&r, "bounce_distance_m") < p.rim_speed_mps * r.end_time_s);
    assert_true(metric(&r, "bounce_distance_m") > 0.8 * p.rim_speed_mps * r.end_time_s);
    assert_true(metric(&r, "restitution") > 0.1 && metric(&r, "restitution") < 0.6);
    assert_true(metric(&r, "damper_stroke_max_m") > 0.02);
}

static void rebound_height_does_not_depend_on_the_rim_speed(void** state) {
    (void)state;
    const bt_hook_params h = hook();
    bt_rebound_params p = basket();
    const bt_rig_result fast = rebounded(&h, &p);
    p.rim_speed_mps = 40;
    const bt_rig_result slow = rebounded(&h, &p);
    BT_ASSERT_NEAR(metric(&slow, "rebound_height_m"), metric(&fast, "rebound_height_m"), 1e-6, 0);
    BT_ASSERT_NEAR(metric(&slow, "impact_force_N"), metric(&fast, "impact_force_N"), 1e-6, 0);
    // The distances differ by the rim's travel during the flight, which is all but the contact.
    const double flight =
        (metric(&fast, "bounce_distance_m") - metric(&slow, "bounce_distance_m")) / 7.5;
    assert_true(flight < fast.end_time_s && flight > fast.end_time_s - 6e-3);
}

static void rebound_grows_with_the_sinking_velocity(void** state) {
    (void)state;
    const bt_hook_params h = hook();
    bt_rebound_params p = basket();
    double height = 0, force = 0;
    static const double speeds[] = {3.6, 4.5, 6.3};
    for (int i = 0; i < 3; ++i) {
        p.sink_speed_mps = speeds[i];
        const bt_rig_result r = rebounded(&h, &p);
        assert_true(metric(&r, "rebound_height_m") > height);
        assert_true(metric(&r, "impact_force_N") > force);
        height = metric(&r, "rebound_height_m");
        force = metric(&r, "impact_force_N");
    }
}

static void rebound_on_a_coating_is_softer(void** state) {
    (void)state;
    const bt_hook_params h = hook();
    bt_rebound_params p = basket();
    const bt_rig_result hard = rebounded(&h, &p);
    p.coating_stiffness_Npm15 = 1e9;
    const bt_rig_result soft = rebounded(&h, &p);
    assert_true(metric(&soft, "impact_force_N") < metric(&hard, "impact_force_N"));
}

static void rebound_converges_with_the_step(void** state) {
    (void)state;
    const bt_hook_params h = hook();
    bt_rebound_params p = basket();
    const bt_rig_result usual = rebounded(&h, &p);
    p.step_s = 1e-5;
    p.contact_step_s = 2e-6;
    const bt_rig_result fine = rebounded(&h, &p);
    BT_ASSERT_NEAR(metric(&usual, "rebound_height_m"), metric(&fine, "rebound_height_m"), 1e-3, 0);
    BT_ASSERT_NEAR(metric(&usual, "impact_force_N"), metric(&fine, "impact_force_N"), 2e-3, 0);
    BT_ASSERT_NEAR(metric(&usual, "bounce_distance_m"), metric(&fine, "bounce_distance_m"), 3e-3,
                   0);
}

/// A rig is a pure function of its parameters: same bits again, watched or not.
/// Slope of the head's height where it last crossed zero upwards.
typedef struct crossing {
    double time_s, height_m, speed_mps;
} crossing;

static void see_crossing(void* user, const bt_rig_sample* sample) {
    crossing* c = user;
    const double height = sample->values[0];
    if (c->height_m < 0 && height >= 0)
        c->speed_mps = (height - c->height_m) / (sample->time_s - c->time_s);
    c->height_m = height;
    c->time_s = sample->time_s;
}

/// Restitution is the speed at which the head leaves the disc, not the fastest within the contact.
static void restitution_is_taken_where_the_head_leaves_the_disc(void** state) {
    (void)state;
    const bt_hook_params h = hook();
    const bt_rebound_params p = basket();
    bt_rig_result r;
    crossing c = {0};
    assert_int_equal(bt_rig_run_rebound(&h, &p, &r, see_crossing, &c, NULL), BT_OK);
    assert_true(c.speed_mps > 0);
    BT_ASSERT_NEAR(metric(&r, "restitution"), c.speed_mps / p.sink_speed_mps, 1e-3, 0);
}

/// What the balance leaves over: zero by the way the residual is made.
static double unbalanced(const bt_rig_result* r, const char* const* taken) {
    double sum = metric(r, "impact_energy_J") + metric(r, "weight_work_J");
    for (; *taken; ++taken)
        sum -= metric(r, *taken);
    return sum - metric(r, "left_J") - metric(r, "energy_residual_J");
}

static void drop_accounts_for_its_energy(void** state) {
    (void)state;
    static const char* const taken[] = {"strut_taken_J", "tyre_taken_J", NULL};
    const bt_gear_params g = main_gear();
    bt_drop_params d = main_drop();
    double residual[2];
    for (int fine = 0; fine < 2; ++fine) {
        d.step_s = fine ? 1e-4 : 2e-4;
        const bt_rig_result r = dropped(&g, &d);
        BT_ASSERT_NEAR(metric(&r, "impact_energy_J"), 0.5 * d.mass_kg * 36, 1e-12, 0);
        BT_ASSERT_NEAR(unbalanced(&r, taken), 0, 0, 1e-6);
        assert_true(metric(&r, "strut_taken_J") > 0.8 * metric(&r, "impact_energy_J"));
        residual[fine] = fabs(metric(&r, "energy_residual_J")) / metric(&r, "impact_energy_J");
    }
    assert_true(residual[0] < 1e-4 && residual[1] < residual[0]);
}

/// In the rim's frame the impact energy is that of the sinking basket and hook.
static void rebound_accounts_for_its_energy(void** state) {
    (void)state;
    static const char* const taken[] = {"damper_taken_J", "buffer_taken_J", "disc_taken_J", NULL};
    const bt_hook_params h = hook();
    const bt_rebound_params p = basket();
    const bt_rig_result r = rebounded(&h, &p);
    const double mass = p.basket_mass_kg + h.mass_kg;
    BT_ASSERT_NEAR(metric(&r, "impact_energy_J"), 0.5 * mass * pow(p.sink_speed_mps, 2), 1e-12, 0);
    BT_ASSERT_NEAR(unbalanced(&r, taken), 0, 0, 1e-6);
    BT_ASSERT_NEAR(metric(&r, "energy_residual_J") / metric(&r, "impact_energy_J"), 0, 0, 1e-3);
}

static void a_hard_drop_is_remarked_and_an_impossible_one_fails(void** state) {
    (void)state;
    const bt_gear_params g = main_gear();
    bt_drop_params d = main_drop();
    d.sink_speed_mps = 9;
    const bt_rig_result hard = dropped(&g, &d);
    assert_true(metric(&hard, "stroke_max_m") > g.oleo.stroke_max_m);
    assert_true(hard.remark_count >= 1);
    assert_string_equal(hard.remarks[0].what, "strut bottomed");
    assert_string_equal(hard.remarks[0].element, "strut");
    assert_true(hard.remarks[0].time_s > 0.02 && hard.remarks[0].time_s < 0.2);
    d.mass_kg = 60000; // the axle would reach the ground
    bt_rig_result none;
    bt_diag diag = {0};
    assert_int_equal(bt_rig_run_drop(&g, &d, &none, NULL, NULL, &diag), BT_ERR_NUMERIC);
    assert_int_equal(diag.errors, 1);
}

static void rigs_repeat_to_the_bit(void** state) {
    (void)state;
    const bt_gear_params g = main_gear();
    const bt_drop_params d = main_drop();
    const bt_hook_params h = hook();
    const bt_rebound_params p = basket();
    double last[16];
    bt_rig_result watched;
    assert_int_equal(bt_rig_run_drop(&g, &d, &watched, keep_last, last, NULL), BT_OK);
    const bt_rig_result alone = dropped(&g, &d);
    for (int i = 0; i < alone.metric_count; ++i)
        assert_memory_equal(&alone.metrics[i].value, &watched.metrics[i].value, sizeof(double));
    assert_int_equal(bt_rig_run_rebound(&h, &p, &watched, keep_last, last, NULL), BT_OK);
    const bt_rig_result again = rebounded(&h, &p);
    for (int i = 0; i < again.metric_count; ++i)
        assert_memory_equal(&again.metrics[i].value, &watched.metrics[i].value, sizeof(double));
}

static void rig_parameters_have_sound_fallbacks(void** state) {
    (void)state;
    bt_rigs_params p;
    bt_diag diag = {0};
    bt_group_set_defaults(&bt_rigs_group, &p);
    assert_int_equal(bt_group_check(&bt_rigs_group, &p, "rigs", &diag), BT_OK);
    p.nose_drop.step_s = NAN;
    assert_int_equal(bt_group_check(&bt_rigs_group, &p, "rigs", &diag), BT_ERR_INPUT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drop_at_no_speed_with_full_lift_stays_where_it_is),
        cmocka_unit_test(drop_from_rest_without_lift_settles_at_the_static_load),
        cmocka_unit_test(drop_converges_with_the_step),
        cmocka_unit_test(drop_of_the_reference_legs_agrees_with_another_code),
        cmocka_unit_test(belt_spins_the_wheel_up_and_drags),
        cmocka_unit_test(reference_gives_the_error_in_percent),
        cmocka_unit_test(reference_may_have_its_own_tolerance),
        cmocka_unit_test(energies_add_up_to_that_of_the_fall),
        cmocka_unit_test(drop_with_friction_converges_with_the_step),
        cmocka_unit_test(static_test_finds_the_gas_law),
        cmocka_unit_test(static_test_shows_the_friction_as_hysteresis),
        cmocka_unit_test(static_test_beyond_the_gas_is_refused),
        cmocka_unit_test(drop_mass_below_the_leg_is_refused),
        cmocka_unit_test(rebound_reports_one_bounce),
        cmocka_unit_test(rebound_height_does_not_depend_on_the_rim_speed),
        cmocka_unit_test(rebound_grows_with_the_sinking_velocity),
        cmocka_unit_test(rebound_on_a_coating_is_softer),
        cmocka_unit_test(rebound_converges_with_the_step),
        cmocka_unit_test(restitution_is_taken_where_the_head_leaves_the_disc),
        cmocka_unit_test(drop_accounts_for_its_energy),
        cmocka_unit_test(rebound_accounts_for_its_energy),
        cmocka_unit_test(a_hard_drop_is_remarked_and_an_impossible_one_fails),
        cmocka_unit_test(rigs_repeat_to_the_bit),
        cmocka_unit_test(rig_parameters_have_sound_fallbacks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
