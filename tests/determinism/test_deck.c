/// The same bits for any number of threads, and after an interruption, on a deck with several
/// wires, in landings and contacts.
#define _GNU_SOURCE
#include "near.h"

#include "campaign/campaign.h"
#include "toy_study.h"

/// @param first  landings before an interruption; 0: none
static uint64_t hash_with_threads(bt_study* study, int threads, int first, int64_t* contacts) {
    char path[4096];
    char* directory = toy_directory();
    bt_ledger* ledger = NULL;
    uint64_t hash = 0;
    toy_path(path, directory, BT_LEDGER_NAME);
    assert_int_equal(bt_ledger_open(path, study, BT_LEDGER_CREATE, &ledger, NULL), BT_OK);
    const bt_campaign_options options = {.threads = threads};
    bt_campaign_progress progress;
    const int64_t all = study->campaign.samples;
    if (first > 0) {
        study->campaign.samples = first;
        assert_int_equal(bt_campaign_run(study, ledger, &options, &progress, NULL), BT_OK);
        assert_int_equal(progress.done, first);
        study->campaign.samples = all;
    }
    assert_int_equal(bt_campaign_run(study, ledger, &options, &progress, NULL), BT_OK);
    assert_int_equal(bt_ledger_hash(ledger, &hash, NULL), BT_OK);
    bt_ledger_row row;
    for (int run = 0; run < progress.done; ++run) {
        assert_int_equal(bt_ledger_get(ledger, run, &row, NULL), BT_OK);
        *contacts += row.result.contact_count;
        assert_int_equal(row.result.wire > 0, row.result.outcome == BT_ENGAGED);
    }
    bt_ledger_close(ledger);
    toy_directory_remove(directory);
    return hash;
}

static void threads_and_resume_give_the_same_bits(void** state) {
    (void)state;
    static const char* const sets[] = {"campaign.samples=32",
                                       "deck.wires.number=4",
                                       "landing.distance_to=3",
                                       "campaign.bounds.landing.distance=[-13 m, 13 m]",
                                       "deck.cable.mesh.fine_length=0.2 m",
                                       "deck.cable.mesh.medium_length=0.3 m",
                                       "deck.cable.mesh.coarse_length=0.6 m"};
    bt_study study;
    assert_int_equal(bt_study_read("studies/reference/study.yaml", sets, 7, &study, NULL), BT_OK);
    int64_t contacts[3] = {0};
    const uint64_t one = hash_with_threads(&study, 1, 0, &contacts[0]);
    assert_true(hash_with_threads(&study, 3, 0, &contacts[1]) == one);
    assert_true(contacts[0] > 2 * 32 && contacts[0] == contacts[1]);
    assert_true(hash_with_threads(&study, 2, 11, &contacts[2]) == one);
    assert_true(contacts[0] == contacts[2]);
    bt_study_destroy(&study);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(threads_and_resume_give_the_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
