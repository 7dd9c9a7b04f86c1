/// The stages from C: what is up to date is not done again, and a user's files stay.
#define _GNU_SOURCE
#include "near.h"

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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_study_is_done_once),
        cmocka_unit_test(a_study_of_the_users_in_the_directory_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
