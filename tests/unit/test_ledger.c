#define _GNU_SOURCE
#include "near.h"

#include "base/directory.h"
#include "campaign/campaign.h"
#include "toy_study.h"

#include <signal.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

typedef struct fixture {
    char* directory;
    char path[4096];
    bt_study study;
    toy_messages messages;
    bt_diag diag;
} fixture;

static int setup(void** state) {
    fixture* f = calloc(1, sizeof *f);
    f->directory = toy_directory();
    toy_path(f->path, f->directory, BT_LEDGER_NAME);
    toy_study(&f->study, BT_DESIGN_SOBOL, 100);
    f->diag = toy_diag(&f->messages);
    *state = f;
    return 0;
}

static int teardown(void** state) {
    fixture* f = *state;
    toy_directory_remove(f->directory);
    free(f);
    return 0;
}

static bt_ledger* opened(fixture* f) {
    bt_ledger* ledger = NULL;
    assert_int_equal(bt_ledger_open(f->path, &f->study, BT_LEDGER_CREATE, &ledger, &f->diag),
                     BT_OK);
    return ledger;
}

static bt_status open_status(fixture* f, bt_ledger_access how) {
    bt_ledger* ledger = NULL;
    const bt_status status = bt_ledger_open(f->path, &f->study, how, &ledger, &f->diag);
    bt_ledger_close(ledger);
    return status;
}

/// A result in which every number is different.
static bt_landing_result result_of(int run, bt_outcome outcome) {
    bt_landing_result r = {.outcome = outcome, .mode = BT_MODE_RIDDEN_OVER, .retained = run % 2};
    r.margin_m = 0.001 * run + 1.0 / 3;
    r.throat_force_peak_N = 1e5 + run;
    r.time_of_contact_s = outcome == BT_MISSED ? NAN : 0.1 * run;
    r.wire = outcome == BT_ENGAGED ? 2 : 0;
    r.contact_count = outcome == BT_FAILED ? 0 : 2;
    r.contacts[0] = (bt_contact){1, BT_MODE_PASSED_OVER, -0.3 - run, 0.1, 0, 0};
    r.contacts[1] = (bt_contact){2, BT_MODE_RIDDEN_OVER, NAN, 0.2 + run, 3e4, 2e5};
    r.bounce_count = 1;
    r.bounces[0] = (bt_bounce){0.05 + run, 3.2, 3e5, true};
    r.steps = 1000 + run;
    r.cable_steps = 40000 + run;
    r.wall_s = 0.02;
    r.state_hash = 0xfedcba9876543210u ^ (uint64_t)run;
    if (outcome == BT_FAILED) {
        snprintf(r.failed_element, sizeof r.failed_element, "aircraft.hook");
        snprintf(r.failed_quantity, sizeof r.failed_quantity, "velocity");
        r.failed_time_s = 0.25;
        r.margin_m = NAN;
        r.mode = BT_MODE_NONE;
    }
    return r;
}

static void add(fixture* f, bt_ledger* ledger, int run, bt_outcome outcome) {
    const bt_landing_result r = result_of(run, outcome);
    const double x[4] = {run + 0.1, run + 0.2, run + 0.3, run + 0.4};
    assert_int_equal(bt_ledger_add(ledger, run, x, NAN, &r, &f->diag), BT_OK);
}

static int64_t count(fixture* f, bt_ledger* ledger) {
    bt_ledger_counts counts = {0};
    assert_int_equal(bt_ledger_count(ledger, &counts, &f->diag), BT_OK);
    return counts.runs;
}

static void a_run_comes_back_to_the_bit(void** state) {
    fixture* f = *state;
    bt_ledger* ledger = opened(f);
    add(f, ledger, 7, BT_ENGAGED);
    assert_int_equal(bt_ledger_commit(ledger, &f->diag), BT_OK);
    bt_ledger_close(ledger);

    ledger = opened(f);
    bt_ledger_row row;
    assert_int_equal(bt_ledger_get(ledger, 7, &row, &f->diag), BT_OK);
    const bt_landing_result want = result_of(7, BT_ENGAGED);
    assert_int_equal(row.run, 7);
    BT_ASSERT_NEAR(row.x[3], 7 + 0.4, 0, 0);
    assert_int_equal(row.result.outcome, BT_ENGAGED);
    assert_int_equal(row.result.mode, BT_MODE_RIDDEN_OVER);
    assert_true(row.result.retained);
    assert_int_equal(row.result.wire, 2);
    assert_int_equal(row.result.contact_count, 2);
    assert_int_equal(row.result.contacts[0].mode, BT_MODE_PASSED_OVER);
    assert_true(row.result.contacts[0].margin_m == want.contacts[0].margin_m);
    assert_int_equal(row.result.contacts[1].wire, 2);
    assert_true(isnan(row.result.contacts[1].margin_m));
    assert_true(row.result.contacts[1].time_s == want.contacts[1].time_s);
    assert_true(row.result.contacts[1].tension_max_N == want.contacts[1].tension_max_N);
    assert_memory_equal(&row.result.margin_m, &want.margin_m, sizeof want.margin_m);
    assert_memory_equal(&row.result.bounces[0], &want.bounces[0], sizeof want.bounces[0].height_m);
    assert_true(row.result.state_hash == want.state_hash);
    assert_int_equal(row.result.cable_steps, want.cable_steps);
    assert_int_equal(bt_ledger_get(ledger, 8, &row, &f->diag), BT_ERR_ARG);
    bt_ledger_close(ledger);
}

static void a_failed_run_is_counted_and_never_a_label(void** state) {
    fixture* f = *state;
    bt_ledger* ledger = opened(f);
    add(f, ledger, 0, BT_ENGAGED);
    add(f, ledger, 1, BT_FAILED);
    add(f, ledger, 2, BT_MISSED);
    bt_ledger_counts counts;
    assert_int_equal(bt_ledger_count(ledger, &counts, &f->diag), BT_OK);
    assert_int_equal(counts.runs, 3);
    assert_int_equal(counts.engaged, 1);
    assert_int_equal(counts.missed, 1);
    assert_int_equal(counts.failed, 1);

    bt_labels labels;
    assert_int_equal(bt_labels_read(ledger, 4, &labels, &f->diag), BT_OK);
    assert_int_equal(labels.count, 2);
    assert_int_equal(labels.failed, 1);
    assert_int_equal(labels.label[0], 1);
    assert_int_equal(labels.label[1], -1);
    BT_ASSERT_NEAR(labels.x[4], 2 + 0.1, 0, 0);
    bt_labels_destroy(&labels);

    bt_ledger_row row;
    assert_int_equal(bt_ledger_get(ledger, 1, &row, &f->diag), BT_OK);
    assert_string_equal(row.result.failed_element, "aircraft.hook");
    assert_string_equal(row.result.failed_quantity, "velocity");
    assert_true(isnan(row.result.margin_m));
    bt_ledger_close(ledger);
}

static void the_hash_does_not_depend_on_order_or_wall_time(void** state) {
    fixture* f = *state;
    uint64_t hash[2];
    for (int k = 0; k < 2; ++k) {
        remove(f->path);
        bt_ledger* ledger = opened(f);
        for (int i = 0; i < 10; ++i) {
            const int run = k ? 9 - i : i;
            bt_landing_result r = result_of(run, BT_MISSED);
            r.wall_s = k + i;
            const double x[4] = {1, 2, 3, run};
            assert_int_equal(bt_ledger_add(ledger, run, x, NAN, &r, &f->diag), BT_OK);
        }
        assert_int_equal(bt_ledger_hash(ledger, &hash[k], &f->diag), BT_OK);
        bt_ledger_close(ledger);
    }
    assert_true(hash[0] == hash[1]);
}

static void the_hash_sees_every_result(void** state) {
    fixture* f = *state;
    uint64_t hash[2];
    for (int k = 0; k < 2; ++k) {
        remove(f->path);
        bt_ledger* ledger = opened(f);
        bt_landing_result r = result_of(0, BT_MISSED);
        r.margin_m = k ? nextafter(r.margin_m, 1) : r.margin_m;
        const double x[4] = {1, 2, 3, 4};
        assert_int_equal(bt_ledger_add(ledger, 0, x, NAN, &r, &f->diag), BT_OK);
        assert_int_equal(bt_ledger_hash(ledger, &hash[k], &f->diag), BT_OK);
        bt_ledger_close(ledger);
    }
    assert_true(hash[0] != hash[1]);
}

static void columns_are_named_after_the_inputs(void** state) {
    fixture* f = *state;
    bt_ledger* ledger = opened(f);
    add(f, ledger, 3, BT_MISSED);
    assert_int_equal(bt_ledger_commit(ledger, &f->diag), BT_OK);
    bt_ledger_close(ledger);
    sqlite3* db = NULL;
    sqlite3_stmt* statement = NULL;
    assert_int_equal(sqlite3_open(f->path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_prepare_v2(db,
                                        "SELECT \"landing.distance\", status, outcome, mode, "
                                        "time_of_contact_s FROM runs",
                                        -1, &statement, NULL),
                     SQLITE_OK);
    assert_int_equal(sqlite3_step(statement), SQLITE_ROW);
    BT_ASSERT_NEAR(sqlite3_column_double(statement, 0), 3.4, 1e-15, 0);
    assert_string_equal((const char*)sqlite3_column_text(statement, 1), "done");
    assert_string_equal((const char*)sqlite3_column_text(statement, 2), "missed");
    assert_string_equal((const char*)sqlite3_column_text(statement, 3), "ridden_over");
    assert_int_equal(sqlite3_column_type(statement, 4), SQLITE_NULL);
    sqlite3_finalize(statement);
    sqlite3_close(db);
}

static void a_missing_ledger_says_to_run_the_campaign(void** state) {
    fixture* f = *state;
    assert_int_equal(open_status(f, BT_LEDGER_READ), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "run the campaign first"));
    assert_int_equal(access(f->path, F_OK), -1);
}

static void write_file(const char* path, const char* text) {
    FILE* file = fopen(path, "w");
    fputs(text, file);
    fclose(file);
}

static void assert_unchanged(const char* path, const char* text) {
    char* now = NULL;
    assert_int_equal(bt_file_read(path, &now, NULL, NULL), BT_OK);
    assert_string_equal(now, text);
    free(now);
}

static void a_foreign_file_is_refused_and_left_alone(void** state) {
    fixture* f = *state;
    const char text[] = "These are my notes about the weather, not a data base of any kind.\n";
    write_file(f->path, text);
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "not a bolter ledger"));
    assert_string_equal(f->messages.file, f->path);
    assert_unchanged(f->path, text);
}

static void another_program_s_database_is_refused(void** state) {
    fixture* f = *state;
    sqlite3* db = NULL;
    assert_int_equal(sqlite3_open(f->path, &db), SQLITE_OK);
    sqlite3_exec(db, "CREATE TABLE photos(name TEXT)", NULL, NULL, NULL);
    sqlite3_close(db);
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "not a bolter ledger"));
}

static void a_damaged_ledger_is_refused(void** state) {
    fixture* f = *state;
    bt_ledger* ledger = opened(f);
    for (int run = 0; run < 500; ++run)
        add(f, ledger, run, BT_MISSED);
    assert_int_equal(bt_ledger_commit(ledger, &f->diag), BT_OK);
    bt_ledger_close(ledger);

    FILE* file = fopen(f->path, "r+b");
    for (long page = 4; page < 12; ++page) {
        fseek(file, page * 4096, SEEK_SET);
        for (int i = 0; i < 4096; ++i)
            fputc(0xee, file);
    }
    fclose(file);
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "damaged"));
}

static void a_truncated_ledger_is_refused(void** state) {
    fixture* f = *state;
    bt_ledger* ledger = opened(f);
    for (int run = 0; run < 500; ++run)
        add(f, ledger, run, BT_MISSED);
    assert_int_equal(bt_ledger_commit(ledger, &f->diag), BT_OK);
    bt_ledger_close(ledger);
    assert_int_equal(truncate(f->path, 3 * 4096), 0);
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "damaged"));
}

static void a_ledger_of_another_format_is_refused(void** state) {
    fixture* f = *state;
    bt_ledger_close(opened(f));
    sqlite3* db = NULL;
    assert_int_equal(sqlite3_open(f->path, &db), SQLITE_OK);
    sqlite3_exec(db, "PRAGMA user_version = 99", NULL, NULL, NULL);
    sqlite3_close(db);
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "format 99"));
}

static void a_ledger_of_another_study_names_the_key(void** state) {
    fixture* f = *state;
    bt_ledger_close(opened(f));
    f->study.model.aircraft.hook.profile.lip_height_m *= 1.5;
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "aircraft.hook.profile.lip_height = 0.03"));
    f->study.model.aircraft.hook.profile.lip_height_m /= 1.5;
    f->study.inputs[2].upper = 0.15;
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "campaign.bounds.landing.pitch"));
}

static void what_no_run_depends_on_may_change(void** state) {
    fixture* f = *state;
    bt_ledger_close(opened(f));
    f->study.campaign.threads = 7;
    f->study.campaign.max_failed = 0.5;
    f->study.campaign.samples = 200; /* a Sobol' sequence may grow */
    f->study.inputs[0].distribution.mean = 4.5;
    f->study.model.landing.pitch_rad = 0.01; /* an axis: no run has it */
    f->study.inputs[1].levels = 7;           /* of a factorial */
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_OK);
    f->study.campaign.seed = 5;
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_ERR_IO);
}

static void the_points_of_a_factorial_do_not_depend_on_the_seed(void** state) {
    fixture* f = *state;
    toy_study(&f->study, BT_DESIGN_FULL_FACTORIAL, 100);
    bt_ledger_close(opened(f));
    f->study.campaign.seed = 12;
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_OK);
    f->study.inputs[1].levels = 7;
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "levels 0"));
    assert_non_null(strstr(f->messages.last, "levels 7"));
}

/// The lines of one key only: what both studies have is not named.
static void an_axis_more_is_named(void** state) {
    fixture* f = *state;
    bt_ledger_close(opened(f));
    toy_input(&f->study, "landing.roll", -0.1, 0.1);
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "it has \"landing.roll = 0\""));
    assert_non_null(strstr(f->messages.last, "has \"campaign.bounds.landing.roll = -0.1 0.1\""));
}

static void the_points_of_a_latin_hypercube_depend_on_their_number(void** state) {
    fixture* f = *state;
    toy_study(&f->study, BT_DESIGN_LATIN_HYPERCUBE, 100);
    bt_ledger_close(opened(f));
    f->study.campaign.samples = 200;
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "campaign.samples = 100"));
}

static void a_directory_that_cannot_be_made_is_said(void** state) {
    fixture* f = *state;
    char path[4096];
    bt_directory directory;
    write_file(toy_path(path, f->directory, "file"), "");
    toy_path(path, f->directory, "file/study");
    assert_int_equal(bt_directory_open(&directory, path, &f->diag), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "cannot make the study directory"));
    bt_directory_close(&directory);
}

static void a_ledger_below_a_file_cannot_be_opened(void** state) {
    fixture* f = *state;
    char path[4096];
    write_file(toy_path(path, f->directory, "file"), "");
    toy_path(f->path, f->directory, "file/campaign.sqlite");
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "cannot be opened"));
}

static void a_second_process_is_kept_out_and_told_who_works(void** state) {
    fixture* f = *state;
    bt_directory mine, other;
    char path[4096], wanted[64];
    toy_path(path, f->directory, "a/b/study");
    assert_int_equal(bt_directory_open(&mine, path, &f->diag), BT_OK);
    assert_int_equal(bt_directory_open(&other, path, &f->diag), BT_ERR_IO);
    snprintf(wanted, sizeof wanted, "(process %ld)", (long)getpid());
    assert_non_null(strstr(f->messages.last, wanted));
    bt_directory_close(&mine);
    assert_int_equal(bt_directory_open(&other, path, &f->diag), BT_OK);
    bt_directory_close(&other);
}

static void a_file_is_replaced_whole(void** state) {
    fixture* f = *state;
    char path[4096];
    toy_path(path, f->directory, "reliability.json");
    assert_int_equal(bt_file_write(path, "one", 3, &f->diag), BT_OK);
    assert_int_equal(bt_file_write(path, "second", 6, &f->diag), BT_OK);
    assert_unchanged(path, "second");
}

/// In a child whose files may not grow beyond a limit, as on a full disk: fills the ledger until it
/// says so. Returns the number of runs whose commit succeeded.
static int fill_until_full(fixture* f) {
    signal(SIGXFSZ, SIG_IGN);
    const struct rlimit limit = {200000, 200000};
    setrlimit(RLIMIT_FSIZE, &limit);
    bt_ledger* ledger = opened(f);
    bt_status status = BT_OK;
    int committed = 0;
    for (int run = 0; status == BT_OK && run < 10000; ++run) {
        const bt_landing_result r = result_of(run, BT_MISSED);
        const double x[4] = {run, run, run, run};
        status = bt_ledger_add(ledger, run, x, NAN, &r, &f->diag);
        if (status == BT_OK && run % 50 == 49) {
            status = bt_ledger_commit(ledger, &f->diag);
            committed = status == BT_OK ? run + 1 : committed;
        }
    }
    const bool told = status == BT_ERR_IO && strstr(f->messages.last, "committed before is kept");
    bt_ledger_close(ledger);
    return told ? committed : -1;
}

static void a_full_disk_is_said_and_nothing_committed_is_lost(void** state) {
    fixture* f = *state;
    int pipes[2], committed = -1, code = 0;
    assert_int_equal(pipe(pipes), 0);
    const pid_t child = fork();
    if (child == 0) {
        const int answer = fill_until_full(f);
        _exit(write(pipes[1], &answer, sizeof answer) == sizeof answer ? 0 : 1);
    }
    assert_int_equal(read(pipes[0], &committed, sizeof committed), sizeof committed);
    assert_int_equal(waitpid(child, &code, 0), child);
    close(pipes[0]);
    close(pipes[1]);
    assert_true(committed > 100);

    bt_ledger* ledger = opened(f);
    assert_int_equal(count(f, ledger), committed);
    bt_ledger_close(ledger);
}

/// As a user who may read the study directory but not write in it: 0 when everything that needs
/// writing is refused with the reason, and reading works.
static int try_read_only(fixture* f) {
    bt_directory directory;
    if (geteuid() == 0 && setuid(65534) != 0)
        return 1;
    if (bt_directory_open(&directory, f->directory, &f->diag) != BT_ERR_IO ||
        !strstr(f->messages.last, "cannot be written"))
        return 2;
    if (open_status(f, BT_LEDGER_WRITE) != BT_ERR_IO ||
        !strstr(f->messages.last, "the ledger cannot be written"))
        return 3;
    return open_status(f, BT_LEDGER_READ) == BT_OK ? 0 : 4;
}

static void a_read_only_directory_is_said_and_can_still_be_read(void** state) {
    fixture* f = *state;
    bt_ledger_close(opened(f));
    assert_int_equal(chmod(f->path, 0444), 0);
    assert_int_equal(chmod(f->directory, 0555), 0);
    const pid_t child = fork();
    if (child == 0)
        _exit(try_read_only(f));
    int code = 0;
    waitpid(child, &code, 0);
    chmod(f->directory, 0755);
    assert_true(WIFEXITED(code));
    assert_int_equal(WEXITSTATUS(code), 0);
}

static void a_killed_writer_loses_only_what_was_not_committed(void** state) {
    fixture* f = *state;
    const pid_t child = fork();
    if (child == 0) {
        bt_ledger* ledger = opened(f);
        for (int run = 0; run < 40; ++run)
            add(f, ledger, run, BT_ENGAGED);
        if (bt_ledger_commit(ledger, &f->diag) != BT_OK)
            _exit(1);
        for (int run = 40; run < 60; ++run)
            add(f, ledger, run, BT_ENGAGED);
        raise(SIGKILL);
    }
    int code = 0;
    waitpid(child, &code, 0);
    assert_true(WIFSIGNALED(code));
    bt_ledger* ledger = opened(f);
    assert_int_equal(count(f, ledger), 40);
    bt_ledger_close(ledger);
}

static void shards_merge_and_a_difference_is_refused(void** state) {
    fixture* f = *state;
    char whole[4096], part[4096];
    snprintf(whole, sizeof whole, "%s", f->path);
    toy_path(part, f->directory, "part.sqlite");

    snprintf(f->path, sizeof f->path, "%s", part);
    bt_ledger* other = opened(f);
    for (int run = 5; run < 15; ++run)
        add(f, other, run, BT_MISSED);
    assert_int_equal(bt_ledger_commit(other, &f->diag), BT_OK);

    snprintf(f->path, sizeof f->path, "%s", whole);
    bt_ledger* ledger = opened(f);
    for (int run = 0; run < 10; ++run)
        add(f, ledger, run, BT_MISSED);
    int64_t added = 0;
    assert_int_equal(bt_ledger_merge(ledger, part, &added, &f->diag), BT_OK);
    assert_int_equal(added, 5);
    assert_int_equal(count(f, ledger), 15);

    add(f, other, 20, BT_MISSED);
    add(f, other, 21, BT_ENGAGED);
    add(f, ledger, 21, BT_MISSED);
    assert_int_equal(bt_ledger_commit(other, &f->diag), BT_OK);
    bt_ledger_close(other);
    assert_int_equal(bt_ledger_merge(ledger, part, &added, &f->diag), BT_ERR_INPUT);
    assert_non_null(strstr(f->messages.last, "run 21 differs"));
    assert_int_equal(count(f, ledger), 16); /* run 20 of the shard was not taken over alone */
    bt_ledger_close(ledger);
}

static void a_remark_is_kept_and_replaced(void** state) {
    fixture* f = *state;
    bt_ledger* ledger = opened(f);
    assert_null(bt_ledger_remark(ledger, "fit"));
    assert_int_equal(bt_ledger_set_remark(ledger, "fit", "one", &f->diag), BT_OK);
    assert_int_equal(bt_ledger_set_remark(ledger, "fit", "two", &f->diag), BT_OK);
    bt_ledger_close(ledger);
    ledger = opened(f);
    char* remark = bt_ledger_remark(ledger, "fit");
    assert_string_equal(remark, "two");
    free(remark);
    bt_ledger_close(ledger);
}

static void remarks_and_density_come_back_to_the_bit(void** state) {
    fixture* f = *state;
    bt_ledger* ledger = opened(f);
    bt_landing_result r = result_of(1, BT_ENGAGED);
    const double x[4] = {1, 2, 3, 4};
    bt_remarks_note(&r.remarks, BT_REMARK_TYRE_ON_RIM_LEFT, 1.0 / 3);
    assert_int_equal(bt_ledger_add(ledger, 1, x, -1.0 / 7, &r, &f->diag), BT_OK);
    add(f, ledger, 2, BT_MISSED);
    bt_ledger_row row;
    assert_int_equal(bt_ledger_get(ledger, 1, &row, &f->diag), BT_OK);
    BT_ASSERT_NEAR(row.log_density, -1.0 / 7, 0, 0);
    assert_memory_equal(&row.result.remarks, &r.remarks, sizeof r.remarks);
    assert_int_equal(bt_ledger_get(ledger, 2, &row, &f->diag), BT_OK);
    assert_true(isnan(row.log_density));
    assert_int_equal(row.result.remarks.seen, 0);
    bt_ledger_close(ledger);
}

/// Runs SQL beside the library, as a user may.
static void sql(fixture* f, const char* text) {
    sqlite3* db = NULL;
    assert_int_equal(sqlite3_open(f->path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, text, NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
}

static int64_t sql_count(fixture* f, const char* text) {
    sqlite3* db = NULL;
    sqlite3_stmt* statement = NULL;
    assert_int_equal(sqlite3_open(f->path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_prepare_v2(db, text, -1, &statement, NULL), SQLITE_OK);
    assert_int_equal(sqlite3_step(statement), SQLITE_ROW);
    const int64_t number = sqlite3_column_int64(statement, 0);
    sqlite3_finalize(statement);
    sqlite3_close(db);
    return number;
}

static uint64_t content(fixture* f) {
    bt_ledger* ledger = NULL;
    uint64_t hash = 0;
    assert_int_equal(bt_ledger_open(f->path, &f->study, BT_LEDGER_READ, &ledger, &f->diag), BT_OK);
    assert_int_equal(bt_ledger_hash(ledger, &hash, &f->diag), BT_OK);
    bt_ledger_close(ledger);
    return hash;
}

static void fill(fixture* f, int first, int end) {
    static const bt_outcome outcomes[] = {BT_ENGAGED, BT_MISSED, BT_FAILED};
    bt_ledger* ledger = opened(f);
    for (int run = first; run < end; ++run)
        add(f, ledger, run, outcomes[run % 3]);
    assert_int_equal(bt_ledger_commit(ledger, &f->diag), BT_OK);
    bt_ledger_close(ledger);
}

/// The totals are those of adding up the rows as the file keeps them: failed runs, NaN, -0.
static void totals_are_what_the_rows_add_up_to(void** state) {
    fixture* f = *state;
    bt_ledger* ledger = opened(f);
    bt_landing_result r = result_of(50, BT_FAILED);
    r.mode = BT_MODE_DIRECT;
    r.margin_m = -NAN;
    r.end_time_s = -0.0;
    const double x[4] = {-0.0, 1, 2, 3};
    assert_int_equal(bt_ledger_add(ledger, 50, x, -0.0, &r, &f->diag), BT_OK);
    assert_int_equal(bt_ledger_commit(ledger, &f->diag), BT_OK);
    bt_ledger_close(ledger);
    fill(f, 0, 30);
    const uint64_t kept = content(f);
    assert_int_equal(sql_count(f, "SELECT failed FROM totals"), 11);
    sql(f, "UPDATE totals SET runs = NULL");
    assert_true(content(f) == kept);
    sql(f, "DROP TABLE totals; DROP TRIGGER runs_inserted; DROP TRIGGER runs_updated; "
           "DROP TRIGGER runs_deleted"); // a file of early 0.2.0
    assert_true(content(f) == kept);
    fill(f, 30, 31);
    assert_int_equal(sql_count(f, "SELECT runs FROM totals WHERE pending = 0"), 32);
}

static void what_a_user_does_to_the_runs_is_counted(void** state) {
    fixture* f = *state;
    fill(f, 0, 12);
    const uint64_t whole = content(f);
    bt_ledger* ledger = NULL;

    sql(f, "CREATE TABLE away AS SELECT * FROM runs WHERE run = 4; DELETE FROM runs WHERE run = 4");
    assert_int_equal(bt_ledger_open(f->path, &f->study, BT_LEDGER_READ, &ledger, &f->diag), BT_OK);
    assert_int_equal(count(f, ledger), 11);
    bt_ledger_close(ledger);
    assert_true(content(f) != whole);

    sql(f, "INSERT INTO runs SELECT * FROM away");
    assert_true(content(f) == whole);
    sql(f, "UPDATE runs SET margin_m = margin_m + 1 WHERE run = 7");
    assert_true(content(f) != whole);
    sql(f, "UPDATE runs SET margin_m = margin_m - 1 WHERE run = 7");

    fill(f, 12, 13); // the next writer puts the totals right
    assert_int_equal(sql_count(f, "SELECT runs FROM totals WHERE pending = 0"), 13);
}

/// Another instruction set, and another format: neither is merged; an empty ledger takes either.
static void shards_of_another_maker_are_refused(void** state) {
    fixture* f = *state;
    char part[4096], whole[4096];
    int64_t added = 0;
    snprintf(whole, sizeof whole, "%s", f->path);
    toy_path(part, f->directory, "part.sqlite");
    snprintf(f->path, sizeof f->path, "%s", part);
    fill(f, 0, 5);
    sql(f, "UPDATE meta SET value = 'bolter 0.2.0, kernels v9' WHERE key = 'made_by'");
    snprintf(f->path, sizeof f->path, "%s", whole);
    fill(f, 5, 8);
    bt_ledger* ledger = opened(f);
    assert_int_equal(bt_ledger_merge(ledger, part, &added, &f->diag), BT_ERR_INPUT);
    assert_non_null(strstr(f->messages.last, "kernels v9"));
    assert_int_equal(count(f, ledger), 3);
    bt_ledger_close(ledger);

    remove(f->path);
    ledger = opened(f);
    assert_int_equal(bt_ledger_merge(ledger, part, &added, &f->diag), BT_OK);
    assert_int_equal(added, 5);
    bt_ledger_close(ledger);
    assert_int_equal(sql_count(f, "SELECT count(*) FROM meta WHERE value LIKE '%kernels v9'"), 1);
    // what goes on here with landings of another maker is told
    assert_int_equal(open_status(f, BT_LEDGER_WRITE), BT_OK);
    assert_non_null(strstr(f->messages.last, "was begun by"));

    snprintf(f->path, sizeof f->path, "%s", part);
    sql(f, "PRAGMA user_version = 3");
    snprintf(f->path, sizeof f->path, "%s", whole);
    ledger = opened(f);
    assert_int_equal(bt_ledger_merge(ledger, part, &added, &f->diag), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "format 3"));
    bt_ledger_close(ledger);
}

static void every_result_is_a_column(void** state) {
    fixture* f = *state;
    bt_ledger_close(opened(f));
    for (int i = 0; i < bt_result_column_count; ++i) {
        char text[160];
        snprintf(text, sizeof text,
                 "SELECT count(*) FROM pragma_table_info('runs') WHERE name = '%s'",
                 bt_result_columns[i].name);
        assert_int_equal(sql_count(f, text), bt_result_columns[i].bounce < 2);
    }
}

static void a_column_that_a_user_adds_is_left_alone(void** state) {
    fixture* f = *state;
    bt_ledger* ledger = opened(f);
    add(f, ledger, 1, BT_MISSED);
    assert_int_equal(bt_ledger_commit(ledger, &f->diag), BT_OK);
    bt_ledger_close(ledger);
    sql(f, "ALTER TABLE runs ADD COLUMN my_remark TEXT; UPDATE runs SET my_remark = 'look'");
    ledger = opened(f);
    add(f, ledger, 2, BT_MISSED);
    assert_int_equal(bt_ledger_commit(ledger, &f->diag), BT_OK);
    bt_ledger_row row;
    assert_int_equal(bt_ledger_get(ledger, 2, &row, &f->diag), BT_OK);
    assert_true(row.result.state_hash == result_of(2, BT_MISSED).state_hash);
    bt_ledger_close(ledger);
    assert_int_equal(sql_count(f, "SELECT count(*) FROM runs WHERE my_remark = 'look'"), 1);
}

static void a_result_that_the_file_does_not_have_reads_empty_and_is_added(void** state) {
    fixture* f = *state;
    bt_ledger* ledger = opened(f);
    add(f, ledger, 1, BT_MISSED);
    assert_int_equal(bt_ledger_commit(ledger, &f->diag), BT_OK);
    bt_ledger_close(ledger);
    sql(f, "DROP VIEW landings; DROP VIEW misses; DROP VIEW failed;"
           "ALTER TABLE runs DROP COLUMN throat_force_peak_N");

    bt_ledger_row row;
    assert_int_equal(bt_ledger_open(f->path, &f->study, BT_LEDGER_READ, &ledger, &f->diag), BT_OK);
    assert_int_equal(bt_ledger_get(ledger, 1, &row, &f->diag), BT_OK);
    assert_true(isnan(row.result.throat_force_peak_N));
    BT_ASSERT_NEAR(row.result.margin_m, result_of(1, BT_MISSED).margin_m, 0, 0);
    bt_ledger_close(ledger);

    ledger = opened(f);
    add(f, ledger, 2, BT_MISSED);
    assert_int_equal(bt_ledger_get(ledger, 2, &row, &f->diag), BT_OK);
    BT_ASSERT_NEAR(row.result.throat_force_peak_N, 1e5 + 2, 0, 0);
    bt_ledger_close(ledger);
}

static void the_views_sort_the_runs(void** state) {
    fixture* f = *state;
    bt_ledger* ledger = opened(f);
    static const bt_outcome outcomes[] = {BT_ENGAGED, BT_ENGAGED, BT_ENGAGED,
                                          BT_MISSED,  BT_MISSED,  BT_FAILED};
    for (int i = 0; i < 6; ++i)
        add(f, ledger, i, outcomes[i]);
    assert_int_equal(bt_ledger_commit(ledger, &f->diag), BT_OK);
    bt_ledger_close(ledger);
    assert_int_equal(sql_count(f, "SELECT count(*) FROM landings"), 5);
    assert_int_equal(sql_count(f, "SELECT count(margin_m) FROM misses"), 2);
    assert_int_equal(sql_count(f, "SELECT run FROM failed"), 5);
}

/// In a child: dies with a transaction so large that part of it is in the file already, and the
/// journal that takes it back beside it.
static void die_inside_a_commit(fixture* f) {
    bt_ledger* ledger = opened(f);
    for (int run = 100; run < 12000; ++run)
        add(f, ledger, run, BT_MISSED);
    _exit(0);
}

static void what_a_killed_writer_left_is_rolled_back_for_readers(void** state) {
    fixture* f = *state;
    char journal[4200];
    int code = 0;
    bt_ledger* ledger = opened(f);
    for (int run = 0; run < 10; ++run)
        add(f, ledger, run, BT_ENGAGED);
    assert_int_equal(bt_ledger_commit(ledger, &f->diag), BT_OK);
    bt_ledger_close(ledger);
    const pid_t child = fork();
    if (child == 0)
        die_inside_a_commit(f);
    assert_int_equal(waitpid(child, &code, 0), child);
    snprintf(journal, sizeof journal, "%s-journal", f->path);
    assert_int_equal(access(journal, F_OK), 0);

    assert_int_equal(bt_ledger_open(f->path, &f->study, BT_LEDGER_READ, &ledger, &f->diag), BT_OK);
    assert_int_equal(count(f, ledger), 10);
    bt_ledger_close(ledger);
}

static void a_reader_cannot_write(void** state) {
    fixture* f = *state;
    bt_ledger_close(opened(f));
    bt_ledger* ledger = NULL;
    const bt_landing_result r = result_of(1, BT_MISSED);
    const double x[4] = {1, 2, 3, 4};
    assert_int_equal(bt_ledger_open(f->path, &f->study, BT_LEDGER_READ, &ledger, &f->diag), BT_OK);
    assert_int_equal(bt_ledger_add(ledger, 1, x, NAN, &r, &f->diag), BT_ERR_IO);
    assert_int_equal(count(f, ledger), 0);
    bt_ledger_close(ledger);
}

static void a_ledger_of_the_first_version_is_refused_with_the_way_out(void** state) {
    fixture* f = *state;
    bt_ledger_close(opened(f));
    sql(f, "PRAGMA user_version = 1");
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "written by bolter 0.1"));
    assert_non_null(strstr(f->messages.last, "use another directory with -o"));
    assert_int_equal(open_status(f, BT_LEDGER_READ), BT_ERR_IO);
}

static void a_directory_in_place_of_a_ledger_is_said(void** state) {
    fixture* f = *state;
    bt_ledger* ledger = opened(f);
    int64_t added;
    assert_int_equal(bt_ledger_merge(ledger, f->directory, &added, &f->diag), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "this is a directory"));
    assert_non_null(strstr(f->messages.last, "/campaign.sqlite"));
    bt_ledger_close(ledger);
}

static void a_path_longer_than_sqlite_takes_is_said(void** state) {
    fixture* f = *state;
    char name[101];
    memset(name, 'x', 100);
    name[100] = '\0';
    toy_path(f->path, f->directory, "");
    for (int i = 0; i < 5; ++i) {
        strcat(f->path, name);
        assert_int_equal(mkdir(f->path, 0755), 0);
        strcat(f->path, "/");
    }
    strcat(f->path, BT_LEDGER_NAME);
    assert_int_equal(open_status(f, BT_LEDGER_CREATE), BT_ERR_IO);
    assert_non_null(strstr(f->messages.last, "SQLite opens"));
    assert_null(strstr(f->messages.last, "may you read"));
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(remarks_and_density_come_back_to_the_bit),
        TEST(totals_are_what_the_rows_add_up_to),
        TEST(what_a_user_does_to_the_runs_is_counted),
        TEST(shards_of_another_maker_are_refused),
        TEST(every_result_is_a_column),
        TEST(a_column_that_a_user_adds_is_left_alone),
        TEST(a_result_that_the_file_does_not_have_reads_empty_and_is_added),
        TEST(the_views_sort_the_runs),
        TEST(what_a_killed_writer_left_is_rolled_back_for_readers),
        TEST(a_reader_cannot_write),
        TEST(a_ledger_of_the_first_version_is_refused_with_the_way_out),
        TEST(a_directory_in_place_of_a_ledger_is_said),
        TEST(a_path_longer_than_sqlite_takes_is_said),
        TEST(a_run_comes_back_to_the_bit),
        TEST(a_failed_run_is_counted_and_never_a_label),
        TEST(the_hash_does_not_depend_on_order_or_wall_time),
        TEST(the_hash_sees_every_result),
        TEST(columns_are_named_after_the_inputs),
        TEST(a_missing_ledger_says_to_run_the_campaign),
        TEST(a_foreign_file_is_refused_and_left_alone),
        TEST(another_program_s_database_is_refused),
        TEST(a_damaged_ledger_is_refused),
        TEST(a_truncated_ledger_is_refused),
        TEST(a_ledger_of_another_format_is_refused),
        TEST(a_ledger_of_another_study_names_the_key),
        TEST(what_no_run_depends_on_may_change),
        TEST(the_points_of_a_factorial_do_not_depend_on_the_seed),
        TEST(an_axis_more_is_named),
        TEST(the_points_of_a_latin_hypercube_depend_on_their_number),
        TEST(a_directory_that_cannot_be_made_is_said),
        TEST(a_ledger_below_a_file_cannot_be_opened),
        TEST(a_second_process_is_kept_out_and_told_who_works),
        TEST(a_file_is_replaced_whole),
        TEST(a_full_disk_is_said_and_nothing_committed_is_lost),
        TEST(a_read_only_directory_is_said_and_can_still_be_read),
        TEST(a_killed_writer_loses_only_what_was_not_committed),
        TEST(shards_merge_and_a_difference_is_refused),
        TEST(a_remark_is_kept_and_replaced),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
