/// The rigs as a study describes them: the same numbers as the direct call, the references of the
/// reference study, and every file of studies/rigs.
#include "near.h"
#include "report/rig_report.h"
#include "study/study.h"

#define REFERENCE "studies/reference/study.yaml"

static bt_study read_study(const char* path, const char* const* sets, int count) {
    bt_study study;
    bt_diag diag = {0};
    assert_int_equal(bt_study_read_rigs(path, sets, count, &study, &diag), BT_OK);
    return study;
}

static bt_rig_result run(const bt_study* study, bt_rig_kind kind) {
    bt_rig_result result;
    assert_int_equal(
        bt_rig_run(kind, &study->model.aircraft, &study->rigs, &result, NULL, NULL, NULL), BT_OK);
    return result;
}

static void assert_same(const bt_rig_result* a, const bt_rig_result* b) {
    assert_int_equal(a->metric_count, b->metric_count);
    for (int i = 0; i < a->metric_count; ++i)
        assert_memory_equal(&a->metrics[i].value, &b->metrics[i].value, sizeof(double));
}

static void rig_of_a_study_is_the_direct_call(void** state) {
    (void)state;
    bt_study study = read_study(REFERENCE, NULL, 0);
    const bt_aircraft_params* a = &study.model.aircraft;
    bt_rig_result direct;
    const bt_rig_result nose = run(&study, BT_RIG_NOSE_DROP);
    assert_int_equal(
        bt_rig_run_drop(&a->nose_gear, &study.rigs.nose_drop, &direct, NULL, NULL, NULL), BT_OK);
    assert_same(&nose, &direct);
    const bt_rig_result main_leg = run(&study, BT_RIG_MAIN_DROP);
    assert_int_equal(
        bt_rig_run_drop(&a->main_gear, &study.rigs.main_drop, &direct, NULL, NULL, NULL), BT_OK);
    assert_same(&main_leg, &direct);
    const bt_rig_result hook = run(&study, BT_RIG_HOOK_REBOUND);
    assert_int_equal(
        bt_rig_run_rebound(&a->hook, &study.rigs.hook_rebound, &direct, NULL, NULL, NULL), BT_OK);
    assert_same(&hook, &direct);
    bt_study_destroy(&study);
}

/// Another integration of the same legs. Its tyres are undamped; at 2 kN s/m they are nearly so.
static void reference_legs_agree_with_another_code_within_a_percent(void** state) {
    (void)state;
    bt_study study = read_study(REFERENCE, NULL, 0);
    for (int kind = 0; kind < BT_RIG_HOOK_REBOUND; ++kind) {
        const bt_rig_result result = run(&study, (bt_rig_kind)kind);
        for (int i = 0; i < 4; ++i) {
            assert_true(fabs(result.metrics[i].error_percent) < 1);
            assert_true(result.metrics[i].accepted);
        }
    }
    bt_study_destroy(&study);
}

/// Constants from memory: a regression, to the printed digits of another integration.
static void tr_1154_drop_from_its_file(void** state) {
    (void)state;
    bt_study study = read_study("studies/rigs/tr1154.yaml", NULL, 0);
    assert_true(study.rigs_only);
    const bt_rig_result result = run(&study, BT_RIG_MAIN_DROP);
    for (int i = 0; i < 4; ++i)
        assert_true(fabs(result.metrics[i].error_percent) < 0.02);
    bt_study_destroy(&study);
}

/// Runs a rig of a file of studies/rigs; every reference in it must be met, `count` of them.
static bt_rig_result accepted(const char* path, bt_rig_kind kind, int count) {
    bt_study study = read_study(path, NULL, 0);
    const bt_rig_result result = run(&study, kind);
    int compared = 0;
    for (int i = 0; i < result.metric_count; ++i) {
        if (!result.metrics[i].accepted)
            fail_msg("%s: %s is %g, error %g %%", path, result.metrics[i].name,
                     result.metrics[i].value, result.metrics[i].error_percent);
        compared += isfinite(result.metrics[i].reference);
    }
    assert_int_equal(compared, count);
    bt_study_destroy(&study);
    return result;
}

/// Published, to the tolerance of the published test; the wheel is as good as massless.
static void energy_balance_drop_meets_the_published_balance(void** state) {
    (void)state;
    accepted("studies/rigs/energy_balance.yaml", BT_RIG_NOSE_DROP, 7);
}

/// A step that is far too long for a wheel of 2 mg or a stop of 1e12 N/m is shortened, not obeyed.
static void steps_are_shortened_for_light_wheels_and_rigid_stops(void** state) {
    (void)state;
    const char* const light[] = {"rigs.nose_drop.step=1 ms"};
    const char* const rigid[] = {"rigs.main_drop.step=1 ms"};
    bt_study study = read_study("studies/rigs/energy_balance.yaml", light, 1);
    bt_rig_result result = run(&study, BT_RIG_NOSE_DROP);
    for (int i = 0; i < result.metric_count; ++i)
        assert_true(result.metrics[i].accepted);
    bt_study_destroy(&study);
    study = read_study("studies/rigs/tr1154.yaml", rigid, 1);
    result = run(&study, BT_RIG_MAIN_DROP);
    for (int i = 0; i < result.metric_count; ++i)
        assert_true(result.metrics[i].accepted);
    bt_study_destroy(&study);
}

/// Another integration, with straight lines between the points of the tyre: within 0.3 %.
static void drop_with_a_wheel_of_5_lb_meets_another_integration(void** state) {
    (void)state;
    accepted("studies/rigs/energy_balance_5lb.yaml", BT_RIG_NOSE_DROP, 5);
}

/// Open parameter sets, references by studies/rigs/two_mass.py: all within 0.1 %.
static void open_gears_meet_another_integration(void** state) {
    (void)state;
    accepted("studies/rigs/open_main_gear.yaml", BT_RIG_MAIN_DROP, 5);
    accepted("studies/rigs/open_nose_gear.yaml", BT_RIG_NOSE_DROP, 5);
    accepted("studies/rigs/open_nose_gear_163kJ.yaml", BT_RIG_NOSE_DROP, 5);
}

/// One chamber, three constants fitted to the curve: within 3.6 % at every published point.
static void one_chamber_follows_curreys_static_curve(void** state) {
    (void)state;
    bt_study study = read_study("studies/rigs/currey.yaml", NULL, 0);
    bt_rig_curves curves;
    bt_rig_record record;
    bt_rig_result result;
    assert_int_equal(bt_rig_curves_read(&study, BT_RIG_NOSE_STATIC, &curves, NULL), BT_OK);
    assert_int_equal(curves.count, 1);
    bt_rig_record_start(&record, BT_RIG_NOSE_STATIC);
    assert_int_equal(bt_rig_run(BT_RIG_NOSE_STATIC, &study.model.aircraft, &study.rigs, &result,
                                bt_rig_record_observe, &record, NULL),
                     BT_OK);
    const bt_measured* m = curves.measured[0];
    assert_int_equal(m->count, 20);
    assert_true(bt_rig_record_grows(&record, m->x_column));
    for (int i = 0; i < m->count; ++i)
        BT_ASSERT_NEAR(bt_rig_record_at(&record, m->y_column, m->x_column, m->x[i]), m->y[i], 0.036,
                       0);
    bt_rig_record_destroy(&record);
    bt_rig_curves_destroy(&curves);
    bt_study_destroy(&study);
}

static double stroke_with(const char* set) {
    const char* const sets[] = {set};
    bt_study study = read_study("studies/rigs/tr1154.yaml", sets, 1);
    const bt_rig_result result = run(&study, BT_RIG_MAIN_DROP);
    bt_study_destroy(&study);
    return result.metrics[0].value;
}

/// What else a strut's data sheet may hold, on the TR 1154 leg: each key acts, the right way round.
static void further_keys_of_a_strut_act_as_they_should(void** state) {
    (void)state;
    const double as_it_is = stroke_with("title=plain");
    assert_true(stroke_with("rigs.main_drop.sink_speed=12 ft/s") > 1.05 * as_it_is);
    assert_true(stroke_with("aircraft.main_gear.oleo.seal_friction=250 lbf") < 0.99 * as_it_is);
    const char* const bearings[] = {"aircraft.main_gear.oleo.bearing_coefficient=0.1",
                                    "aircraft.main_gear.oleo.side_load_ratio=0.2",
                                    "aircraft.main_gear.oleo.axle_distance=1.8023 ft",
                                    "aircraft.main_gear.oleo.bearing_distance=0.5521 ft"};
    bt_study study = read_study("studies/rigs/tr1154.yaml", bearings, 4);
    assert_true(run(&study, BT_RIG_MAIN_DROP).metrics[0].value < 0.99 * as_it_is);
    bt_study_destroy(&study);
    assert_true(stroke_with("aircraft.main_gear.oleo.oil_volume=100 in^3") > as_it_is);
    const char* const pin[] = {
        "aircraft.main_gear.oleo.orifice_area=0 ft^2",
        "aircraft.main_gear.oleo.orifice_table=[[0 in, 0.09 in^2], [3 in, 0.08 in^2], "
        "[7.2 in, 0.06 in^2]]"};
    study = read_study("studies/rigs/tr1154.yaml", pin, 2);
    const double with_pin = run(&study, BT_RIG_MAIN_DROP).metrics[0].value;
    assert_true(fabs(with_pin / as_it_is - 1) > 0.002 && fabs(with_pin / as_it_is - 1) < 0.15);
    bt_study_destroy(&study);
}

/// 2.7 m/s is a fall of V^2 / (2 g).
static void drop_height_is_the_sink_speed_of_a_free_fall(void** state) {
    (void)state;
    char height[80];
    const double g = 32.174 * 0.3048, v = 8.86 * 0.3048;
    snprintf(height, sizeof height, "rigs.main_drop.drop_height=%.17g m", v * v / (2 * g));
    const char* const sets[] = {"rigs.main_drop.sink_speed=0 m/s", height};
    bt_study study = read_study("studies/rigs/tr1154.yaml", sets, 2);
    const bt_rig_result fallen = run(&study, BT_RIG_MAIN_DROP);
    for (int i = 0; i < 4; ++i)
        assert_true(fabs(fallen.metrics[i].error_percent) < 0.02);
    bt_study_destroy(&study);
}

/// Places of the leg on the aircraft do not matter to a rig, so a rig file may leave them out.
static void rig_file_gives_what_the_whole_study_gives(void** state) {
    (void)state;
    static const char* const sets[] = {
        "aircraft.main_gear.oleo.orifice_table=[[0 mm, 375 mm^2], [600 mm, 160 mm^2]]",
        "rigs.main_drop={mass: 9100 kg, sink_speed: 5 m/s}"};
    bt_study whole = read_study(REFERENCE, sets, 2);
    const bt_rig_result expected = run(&whole, BT_RIG_MAIN_DROP);
    bt_study part = read_study(REFERENCE, (const char* const[]){sets[0], sets[1]}, 2);
    part.model.aircraft.main_gear.station_m = part.model.aircraft.main_gear.half_track_m =
        part.model.aircraft.main_gear.underside_m = 0;
    const bt_rig_result got = run(&part, BT_RIG_MAIN_DROP);
    assert_same(&got, &expected);
    bt_study_destroy(&part);
    bt_study_destroy(&whole);
}

typedef struct late_force {
    double from_s, least_N, most_N;
} late_force;

static void watch_force(void* user, const bt_rig_sample* sample) {
    late_force* f = user;
    if (sample->time_s < f->from_s)
        return;
    f->least_N = fmin(f->least_N, sample->values[2]);
    f->most_N = fmax(f->most_N, sample->values[2]);
}

/// Once the wheel hangs in the air the strut extends steadily against its rebound valve: all that
/// is left is the force that holds the unsprung mass back.
static void strut_extends_without_ringing_in_the_air(void** state) {
    (void)state;
    bt_study study = read_study(REFERENCE, NULL, 0);
    late_force f = {0.3, INFINITY, -INFINITY};
    bt_rig_result result;
    assert_int_equal(bt_rig_run(BT_RIG_NOSE_DROP, &study.model.aircraft, &study.rigs, &result,
                                watch_force, &f, NULL),
                     BT_OK);
    const bt_gear_params* g = &study.model.aircraft.nose_gear;
    const double weight =
        (g->piston_mass_kg + g->wheel_mass_kg) * study.rigs.nose_drop.gravity_mps2;
    assert_true(f.least_N > -1.2 * weight && f.most_N < 0);
    bt_study_destroy(&study);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rig_of_a_study_is_the_direct_call),
        cmocka_unit_test(reference_legs_agree_with_another_code_within_a_percent),
        cmocka_unit_test(tr_1154_drop_from_its_file),
        cmocka_unit_test(energy_balance_drop_meets_the_published_balance),
        cmocka_unit_test(steps_are_shortened_for_light_wheels_and_rigid_stops),
        cmocka_unit_test(drop_with_a_wheel_of_5_lb_meets_another_integration),
        cmocka_unit_test(open_gears_meet_another_integration),
        cmocka_unit_test(one_chamber_follows_curreys_static_curve),
        cmocka_unit_test(further_keys_of_a_strut_act_as_they_should),
        cmocka_unit_test(drop_height_is_the_sink_speed_of_a_free_fall),
        cmocka_unit_test(rig_file_gives_what_the_whole_study_gives),
        cmocka_unit_test(strut_extends_without_ringing_in_the_air),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
