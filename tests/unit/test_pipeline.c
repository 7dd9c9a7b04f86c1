/// The stages from C: what is up to date is not done again, and a user's files stay.
#define _GNU_SOURCE
#include "near.h"

#include "pipeline/figures.h"
#include "pipeline/pipeline.h"
#include "report/reliability_report.h"
#include "toy_study.h"

#include <string.h>

static bt_study* make(const char* directory) {
    bt_study* study = calloc(1, sizeof *study);
    const char* const sets[] = {"deck.cable.mesh.fine_length=0.6 m",
                                "deck.cable.mesh.medium_length=0.6 m",
                                "deck.cable.mesh.coarse_length=0.6 m",
                                "campaign.samples=24",
                                "reliability.samples=500",
                                "reliability.high_fidelity_runs=0"};
    assert_int_equal(bt_study_read("studies/reference/study.yaml", sets, 6, study, NULL), BT_OK);
    snprintf(study->directory, sizeof study->directory, "%s", directory);
    return study;
}

static void a_study_is_done_once(void** state) {
    (void)state;
    char* folder = toy_directory();
    bt_study* study = make(folder);
    bt_study_directory directory;
    bt_diag diag = {0};
    assert_int_equal(bt_study_directory_open(&directory, study, BT_LEDGER_CREATE, &diag), BT_OK);
    const bt_campaign_options campaign = {0};
    const bt_reliability_stage stage = {.files = bt_reliability_files};
    bt_campaign_progress progress;
    bt_surrogate surrogate;
    assert_int_equal(bt_stage_study(&directory, &campaign, &stage, &progress, &surrogate), BT_OK);
    assert_true(progress.done == 24 && progress.before == 0);
    bt_surrogate_destroy(&surrogate);

    bool fresh = true;
    assert_int_equal(bt_stage_campaign(&directory, &campaign, &progress), BT_OK);
    assert_true(progress.before == 24);
    assert_int_equal(bt_stage_fit(&directory, false, &surrogate, &fresh), BT_OK);
    assert_false(fresh);
    assert_int_equal(bt_stage_reliability(&directory, &surrogate, &stage, &fresh), BT_OK);
    assert_false(fresh);

    // a file of the result that is gone, other settings, another fit: done again
    char path[4096];
    assert_int_equal(remove(toy_path(path, folder, "reliability.csv")), 0);
    assert_int_equal(bt_stage_reliability(&directory, &surrogate, &stage, &fresh), BT_OK);
    assert_true(fresh);
    study->reliability.seed += 1;
    assert_int_equal(bt_stage_reliability(&directory, &surrogate, &stage, &fresh), BT_OK);
    assert_true(fresh);
    bt_surrogate_destroy(&surrogate);
    study->surrogate.holdout = 0.5;
    assert_int_equal(bt_stage_fit(&directory, false, &surrogate, &fresh), BT_OK);
    assert_true(fresh);
    bt_surrogate_destroy(&surrogate);
    bt_study_directory_close(&directory);
    bt_study_destroy(study);
    free(study);
    toy_directory_remove(folder);
}

static void a_study_of_the_users_in_the_directory_stays(void** state) {
    (void)state;
    char* folder = toy_directory();
    bt_study* study = make(folder);
    bt_study_directory directory;
    bt_diag diag = {0};
    char path[4096], *text = NULL;
    toy_path(path, folder, "study.yaml");
    assert_int_equal(bt_file_write(path, "title: mine\n", 12, NULL), BT_OK);
    assert_int_equal(bt_study_directory_open(&directory, study, BT_LEDGER_CREATE, &diag),
                     BT_ERR_IO);
    bt_study_directory_close(&directory);
    assert_int_equal(diag.errors, 1);
    assert_int_equal(bt_file_read(path, &text, NULL, NULL), BT_OK);
    assert_string_equal(text, "title: mine\n");
    free(text);
    assert_int_equal(remove(path), 0);
    // what Bolter wrote itself is replaced, with or without another setting
    for (int i = 0; i < 2; ++i) {
        assert_int_equal(bt_study_directory_open(&directory, study, BT_LEDGER_CREATE, &diag),
                         BT_OK);
        bt_study_directory_close(&directory);
        bt_study_destroy(study);
        free(study);
        study = make(folder);
        study->text[0] = '#'; // another text
    }
    bt_study_destroy(study);
    free(study);
    toy_directory_remove(folder);
}

/// What was given to be drawn.
static int rigs_drawn, sweeps_drawn, tables_drawn;

static bt_status count_rig(const bt_study* study, const bt_rig_test* test, const char* folder,
                           bt_diag* diag) {
    (void)study, (void)folder, (void)diag;
    assert_true(test->record.count > 100 && test->result.metric_count > 0);
    ++rigs_drawn;
    return BT_OK;
}

static bt_status count_sweep(const bt_study* study, const bt_sweep_plan* plan,
                             const bt_sweep* sweep, const char* folder, bt_diag* diag) {
    (void)study, (void)folder, (void)diag;
    assert_string_equal(plan->key, bt_paper_sweeps[sweeps_drawn].key);
    for (int i = 0; i < sweep->count; ++i)
        assert_true(isfinite(bt_first_bounce(&sweep->rows[i].result).height_m));
    ++sweeps_drawn;
    return BT_OK;
}

static bt_status count_table(const bt_study* study, const char* folder, bt_diag* diag) {
    (void)study, (void)diag;
    assert_non_null(strstr(folder, "/figures"));
    ++tables_drawn;
    return BT_OK;
}

static void one_call_gives_every_figure(void** state) {
    (void)state;
    char* folder = toy_directory();
    bt_study* study = make(folder);
    bt_diag diag = {0};
    const bt_figure_writers count = {count_rig, count_sweep, count_table};
    assert_int_equal(bt_stage_figures(study, &count, NULL, &diag), BT_OK);
    assert_int_equal(rigs_drawn, 3);
    assert_int_equal(sweeps_drawn, BT_PAPER_SWEEPS);
    assert_int_equal(tables_drawn, 1);

    // a rig that fails has no figure, and keeps nothing from being drawn; a stop does
    const atomic_int stop = 1;
    study->rigs.nose_drop.sink_speed_mps = 60;
    assert_int_equal(bt_stage_figures(study, &count, &stop, &diag), BT_ERR_INTERRUPTED);
    assert_int_equal(rigs_drawn, 5);
    assert_int_equal(sweeps_drawn, BT_PAPER_SWEEPS);
    bt_study_destroy(study);
    free(study);
    toy_directory_remove(folder);
}

static void a_rig_is_run_once_per_value(void** state) {
    (void)state;
    bt_diag diag = {0};
    bt_rig_sweep sweep;
    const char* const sets[] = {"rigs.nose_drop.duration=0.05 s"};
    assert_int_equal(bt_stage_rig_sweep("studies/reference/study.yaml", sets, 1, BT_RIG_NOSE_DROP,
                                        "rigs.nose_drop.sink_speed", "2 m/s, 3 m/s", &sweep, &diag),
                     BT_OK);
    assert_int_equal(sweep.count, 2);
    assert_string_equal(sweep.rows[1].value, "3 m/s");
    assert_true(sweep.rows[1].test.result.end_time_s < 0.06);
    BT_ASSERT_NEAR(sweep.rows[1].test.record.columns[0][0], 0, 0, 0);
    bt_rig_sweep_destroy(&sweep);
    assert_int_equal(bt_stage_rig_sweep("studies/reference/study.yaml", NULL, 0, BT_RIG_NOSE_DROP,
                                        "rigs.nose_drop.sink_sped", "2 m/s", &sweep, &diag),
                     BT_ERR_INPUT);
    bt_study study;
    bt_rig_test test;
    assert_int_equal(bt_study_read_rigs("studies/rigs/currey.yaml", NULL, 0, &study, &diag), BT_OK);
    assert_int_equal(bt_stage_rig(&study, BT_RIG_HOOK_REBOUND, &test, &diag), BT_ERR_INPUT);
    bt_study_destroy(&study);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_study_is_done_once),
        cmocka_unit_test(a_study_of_the_users_in_the_directory_stays),
        cmocka_unit_test(one_call_gives_every_figure),
        cmocka_unit_test(a_rig_is_run_once_per_value),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
