/// The rigs as a study describes them: the same numbers as the direct call, the references of the
/// reference study, the TR 1154 drop from its file.
#include "near.h"
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
        cmocka_unit_test(rig_file_gives_what_the_whole_study_gives),
        cmocka_unit_test(strut_extends_without_ringing_in_the_air),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
