/// The same bits for any number of threads, after a kill and a resume, and from shards; on the
/// reference study with the real model.
#define _GNU_SOURCE
#include "near.h"

#include "pipeline/pipeline.h"
#include "toy_study.h"

#include <signal.h>
#include <sys/wait.h>

/// Fewer than 64 finished runs are ever uncommitted.
enum { RUNS = 160, KILL_AFTER = 100, COMMITTED_BY_THEN = KILL_AFTER - 63 };

static bt_study study;

/// A coarse cable: fast, and every contact is still there.
static int read_study(void** state) {
    (void)state;
    static const char* const sets[] = {"campaign.samples=160", "deck.cable.mesh.fine_length=0.2 m",
                                       "deck.cable.mesh.medium_length=0.3 m",
                                       "deck.cable.mesh.coarse_length=0.6 m"};
    return bt_study_read("studies/reference/study.yaml", sets, 4, &study, NULL) == BT_OK ? 0 : -1;
}

static int free_study(void** state) {
    (void)state;
    bt_study_destroy(&study);
    return 0;
}

static bt_ledger* opened(const char* directory) {
    char path[4096];
    bt_ledger* ledger = NULL;
    toy_path(path, directory, BT_LEDGER_NAME);
    assert_int_equal(bt_ledger_open(path, &study, BT_LEDGER_CREATE, &ledger, NULL), BT_OK);
    return ledger;
}

static uint64_t hash_of(bt_ledger* ledger) {
    uint64_t hash = 0;
    assert_int_equal(bt_ledger_hash(ledger, &hash, NULL), BT_OK);
    return hash;
}

static int64_t runs_in(const char* directory) {
    bt_ledger_counts counts = {0};
    bt_ledger* ledger = opened(directory);
    assert_int_equal(bt_ledger_count(ledger, &counts, NULL), BT_OK);
    bt_ledger_close(ledger);
    return counts.runs;
}

static bt_status run_with(const char* directory, const bt_campaign_options* options,
                          bt_campaign_progress* progress) {
    bt_ledger* ledger = opened(directory);
    const bt_status status = bt_campaign_run(&study, ledger, options, progress, NULL);
    bt_ledger_close(ledger);
    return status;
}

/// Runs what is missing and returns the hash of the ledger.
static uint64_t run(const char* directory, int threads) {
    const bt_campaign_options options = {.threads = threads};
    bt_campaign_progress progress;
    assert_int_equal(run_with(directory, &options, &progress), BT_OK);
    assert_int_equal(progress.done, RUNS);
    assert_int_equal(progress.engaged + progress.missed + progress.failed, RUNS);
    bt_ledger* ledger = opened(directory);
    const uint64_t hash = hash_of(ledger);
    bt_ledger_close(ledger);
    return hash;
}

static uint64_t hash_with_threads(int threads) {
    char* directory = toy_directory();
    const uint64_t hash = run(directory, threads);
    toy_directory_remove(directory);
    return hash;
}

static void threads_1_2_3_and_8_give_the_same_bits(void** state) {
    (void)state;
    const uint64_t one = hash_with_threads(1);
    assert_true(hash_with_threads(2) == one);
    assert_true(hash_with_threads(3) == one);
    assert_true(hash_with_threads(8) == one);
}

static void kill_on_the_way(void* user, const bt_campaign_progress* progress) {
    (void)user;
    if (progress->done >= KILL_AFTER)
        raise(SIGKILL);
}

static void a_kill_loses_what_is_in_flight_and_a_resume_gives_the_same_bits(void** state) {
    (void)state;
    const uint64_t whole = hash_with_threads(2);
    char* directory = toy_directory();
    const pid_t child = fork();
    if (child == 0) {
        const bt_campaign_options options = {.threads = 2, .watch = kill_on_the_way};
        bt_campaign_progress progress;
        _exit(run_with(directory, &options, &progress) == BT_OK ? 0 : 1);
    }
    int code = 0;
    waitpid(child, &code, 0);
    assert_true(WIFSIGNALED(code) && WTERMSIG(code) == SIGKILL);
    assert_in_range(runs_in(directory), COMMITTED_BY_THEN, RUNS);
    assert_true(run(directory, 2) == whole);
    toy_directory_remove(directory);
}

static void stop_on_the_way(void* user, const bt_campaign_progress* progress) {
    if (progress->done > 0)
        atomic_store((atomic_int*)user, 1);
}

static void an_interruption_keeps_what_is_finished_and_a_resume_gives_the_same_bits(void** state) {
    (void)state;
    const uint64_t whole = hash_with_threads(2);
    char* directory = toy_directory();
    atomic_int stop = 0;
    const bt_campaign_options options = {
        .threads = 2, .stop = &stop, .watch = stop_on_the_way, .user = &stop};
    bt_campaign_progress progress;
    assert_int_equal(run_with(directory, &options, &progress), BT_ERR_INTERRUPTED);
    assert_in_range(progress.done, 1, RUNS - 1);
    assert_int_equal(runs_in(directory), progress.done);
    assert_true(run(directory, 2) == whole);
    toy_directory_remove(directory);
}

static void shards_in_any_order_merge_to_the_same_bits(void** state) {
    (void)state;
    const uint64_t whole = hash_with_threads(2);
    char *directory = toy_directory(), *parts[3];
    for (int i = 2; i >= 0; --i) {
        parts[i] = toy_directory();
        const bt_campaign_options options = {.threads = 2, .shard = i, .shards = 3};
        bt_campaign_progress progress;
        assert_int_equal(run_with(parts[i], &options, &progress), BT_OK);
        assert_int_equal(progress.done, progress.total);
    }
    bt_ledger* ledger = opened(directory);
    int64_t sum = 0;
    for (int i = 0; i < 3; ++i) {
        char path[4096];
        int64_t added = 0;
        toy_path(path, parts[i], BT_LEDGER_NAME);
        assert_int_equal(bt_ledger_merge(ledger, path, &added, NULL), BT_OK);
        sum += added;
        toy_directory_remove(parts[i]);
    }
    assert_int_equal(sum, RUNS);
    assert_true(hash_of(ledger) == whole);
    bt_ledger_close(ledger);
    toy_directory_remove(directory);
}

static void any_run_repeats_alone_to_the_bit(void** state) {
    (void)state;
    char* directory = toy_directory();
    run(directory, 2);
    bt_ledger* ledger = opened(directory);
    const bt_axes axes = bt_design_axes(&study);
    bt_model_params* model = malloc(sizeof *model);
    bt_lander* lander = NULL;
    *model = study.model;
    assert_int_equal(bt_lander_create(&lander), BT_OK);
    for (int k = 0; k < 3; ++k) {
        bt_ledger_row row;
        bt_landing_result result;
        assert_int_equal(bt_ledger_get(ledger, 17 + 60 * k, &row, NULL), BT_OK);
        assert_int_equal(
            bt_landing_at(lander, model, study.inputs, &axes, row.x, &result, NULL, NULL), BT_OK);
        assert_true(result.state_hash == row.result.state_hash);
        assert_memory_equal(&result.margin_m, &row.result.margin_m, sizeof result.margin_m);
    }
    bt_lander_destroy(lander);
    free(model);
    bt_ledger_close(ledger);
    toy_directory_remove(directory);
}

static void a_point_outside_what_the_model_allows_is_a_failed_run_with_the_key(void** state) {
    (void)state;
    const bt_axes axes = bt_design_axes(&study);
    bt_model_params* model = malloc(sizeof *model);
    bt_lander* lander = NULL;
    bt_landing_result result;
    *model = study.model;
    assert_int_equal(bt_lander_create(&lander), BT_OK);
    const double x[4] = {3.6, -47.5, 0.05, 6};
    assert_int_equal(bt_landing_at(lander, model, study.inputs, &axes, x, &result, NULL, NULL),
                     BT_OK);
    assert_int_equal(result.outcome, BT_FAILED);
    assert_string_equal(result.failed_element, "landing.horizontal_speed");
    bt_lander_destroy(lander);
    free(model);
}

static void too_many_failed_runs_are_an_error_and_are_kept(void** state) {
    (void)state;
    bt_study* wild = malloc(sizeof *wild);
    *wild = study;
    wild->inputs[1].lower = -40; /* no such speed: half of the runs fail */
    wild->inputs[1].upper = 50;
    wild->campaign.design = BT_DESIGN_SOBOL; // draws from the bounds
    wild->campaign.samples = 16;
    char *directory = toy_directory(), path[4096];
    bt_ledger* ledger = NULL;
    toy_messages messages;
    bt_diag diag = toy_diag(&messages);
    toy_path(path, directory, BT_LEDGER_NAME);
    assert_int_equal(bt_ledger_open(path, wild, BT_LEDGER_CREATE, &ledger, NULL), BT_OK);
    const bt_campaign_options options = {.threads = 2};
    bt_campaign_progress progress;
    assert_int_equal(bt_campaign_run(wild, ledger, &options, &progress, &diag), BT_ERR_FAILED_RUNS);
    assert_in_range(progress.failed, 6, 10);
    assert_int_equal(progress.done, 16);
    assert_non_null(strstr(messages.last, "more than max_failed"));
    bt_ledger_close(ledger);
    toy_directory_remove(directory);
    free(wild);
}

/* ---- rounds ---- */

/// A study whose landings come in rounds: the second and third depend on those before.
static void make_rounds(bt_study* rounds) {
    *rounds = study;
    rounds->campaign.design = BT_DESIGN_CONDITIONS;
    rounds->campaign.samples = 200;
}

/// Runs the campaign up to `samples`, then to its end, and returns the hash of the ledger.
static uint64_t hash_of_rounds(int threads, int samples) {
    static bt_study rounds;
    make_rounds(&rounds);
    rounds.campaign.threads = threads;
    char* name = toy_directory();
    snprintf(rounds.directory, sizeof rounds.directory, "%s", name);
    bt_study_directory directory;
    assert_int_equal(bt_study_directory_open(&directory, &rounds, BT_LEDGER_CREATE, NULL), BT_OK);
    const bt_campaign_options options = {.threads = threads};
    bt_campaign_progress progress;
    rounds.campaign.samples = samples;
    assert_int_equal(bt_stage_campaign(&directory, &options, &progress), BT_OK);
    rounds.campaign.samples = 200;
    assert_int_equal(bt_stage_campaign(&directory, &options, &progress), BT_OK);
    assert_int_equal(progress.done, 200);
    const uint64_t hash = hash_of(directory.ledger);
    bt_study_directory_close(&directory);
    toy_directory_remove(name);
    return hash;
}

static void rounds_have_the_same_bits_for_any_threads_and_any_stop(void** state) {
    (void)state;
    const uint64_t hash = hash_of_rounds(1, 200);
    assert_true(hash == hash_of_rounds(3, 150)); // stopped inside the second round
    assert_true(hash == hash_of_rounds(2, 40));  // and inside the first
}

static void rounds_of_a_shard_are_refused(void** state) {
    (void)state;
    static bt_study rounds;
    make_rounds(&rounds);
    char* name = toy_directory();
    snprintf(rounds.directory, sizeof rounds.directory, "%s", name);
    toy_messages said;
    bt_diag diag = toy_diag(&said);
    bt_study_directory directory;
    assert_int_equal(bt_study_directory_open(&directory, &rounds, BT_LEDGER_CREATE, &diag), BT_OK);
    const bt_campaign_options options = {.shard = 0, .shards = 2};
    bt_campaign_progress progress;
    assert_int_equal(bt_stage_campaign(&directory, &options, &progress), BT_ERR_INPUT);
    assert_non_null(strstr(said.last, "campaign.unsure"));
    bt_study_directory_close(&directory);
    toy_directory_remove(name);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_1_2_3_and_8_give_the_same_bits),
        cmocka_unit_test(a_kill_loses_what_is_in_flight_and_a_resume_gives_the_same_bits),
        cmocka_unit_test(an_interruption_keeps_what_is_finished_and_a_resume_gives_the_same_bits),
        cmocka_unit_test(shards_in_any_order_merge_to_the_same_bits),
        cmocka_unit_test(any_run_repeats_alone_to_the_bit),
        cmocka_unit_test(a_point_outside_what_the_model_allows_is_a_failed_run_with_the_key),
        cmocka_unit_test(too_many_failed_runs_are_an_error_and_are_kept),
        cmocka_unit_test(rounds_have_the_same_bits_for_any_threads_and_any_stop),
        cmocka_unit_test(rounds_of_a_shard_are_refused),
    };
    return cmocka_run_group_tests(tests, read_study, free_study);
}
