/// What grows with a campaign: the ledger, merges, and the scheduler over many workers. The sizes
/// can be raised: BT_BENCH_ROWS=1000000 BT_BENCH_LANDINGS=10000000.
#include "bench.h"

#include "campaign/campaign.h"
#include "campaign/simulated_backend.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static int64_t size_of(const char* variable, int64_t otherwise) {
    const char* text = getenv(variable);
    const long long number = text ? atoll(text) : 0;
    return number > 0 ? number : otherwise;
}

// --- the ledger -------------------------------------------------------------------------------

static bt_landing_result some_result(int64_t run) {
    const double u = (double)(run % 1000) / 1000;
    return (bt_landing_result){.outcome = run % 7 ? BT_ENGAGED : BT_MISSED,
                               .mode = run % 7 ? BT_MODE_DIRECT : BT_MODE_BOUNCED_OVER,
                               .margin_m = 0.02 - 0.05 * u,
                               .throat_force_peak_N = 1e5 * (1 + u),
                               .time_of_contact_s = 0.1 + u / 7,
                               .hook_deck_force_peak_N = 3e5 / (1 + u),
                               .steps = 500 + run % 100,
                               .cable_steps = 2400,
                               .end_time_s = 0.2 + u / 3,
                               .state_hash = 0x9e3779b97f4a7c15u * (uint64_t)(run + 1),
                               .wall_s = 0.017};
}

/// Adds the runs of a shard; seconds, NAN when it fails.
static double fill(const bt_study* study, const char* path, int64_t rows, int shard, int shards) {
    bt_ledger* ledger = NULL;
    const double start = bench_now_s();
    bt_status status = bt_ledger_open(path, study, BT_LEDGER_CREATE, &ledger, NULL);
    for (int64_t run = shard; run < rows && status == BT_OK; run += shards) {
        const bt_landing_result result = some_result(run);
        double x[BT_INPUT_MAX];
        for (int i = 0; i < study->input_count; ++i)
            x[i] = 1 / (double)(run + i + 1);
        status = bt_ledger_add(ledger, run, x, NAN, &result, NULL);
        if (status == BT_OK && run / shards % 64 == 63)
            status = bt_ledger_commit(ledger, NULL);
    }
    if (status == BT_OK)
        status = bt_ledger_commit(ledger, NULL);
    bt_ledger_close(ledger);
    return status == BT_OK ? bench_now_s() - start : NAN;
}

/// Opens, counts and fingerprints.
static double look(const bt_study* study, const char* path) {
    bt_ledger* ledger = NULL;
    bt_ledger_counts counts;
    uint64_t hash;
    const double start = bench_now_s();
    bt_status status = bt_ledger_open(path, study, BT_LEDGER_READ, &ledger, NULL);
    if (status == BT_OK)
        status = bt_ledger_count(ledger, &counts, NULL);
    if (status == BT_OK)
        status = bt_ledger_hash(ledger, &hash, NULL);
    bt_ledger_close(ledger);
    return status == BT_OK ? bench_now_s() - start : NAN;
}

static double merge(const bt_study* study, const char* into, const char* from) {
    bt_ledger* ledger = NULL;
    int64_t added;
    const double start = bench_now_s();
    bt_status status = bt_ledger_open(into, study, BT_LEDGER_CREATE, &ledger, NULL);
    if (status == BT_OK)
        status = bt_ledger_merge(ledger, from, &added, NULL);
    bt_ledger_close(ledger);
    return status == BT_OK ? bench_now_s() - start : NAN;
}

static void bench_rows(const bt_study* study, int64_t rows) {
    static const char part[] = "bench-part.sqlite", whole[] = "bench-whole.sqlite";
    char name[64];
    unlink(part);
    unlink(whole);
    snprintf(name, sizeof name, "ledger of %lld rows: a landing", (long long)rows);
    bench_row(name, 1e6 * fill(study, part, rows, 0, 1) / (double)rows, "us", NULL, 0, 160);
    bench_row("  open, count, content", 1e3 * look(study, part), "ms", NULL, 0, 200);
    bench_row("  merge, for 1e6 rows", 1e6 / (double)rows * merge(study, whole, part), "s", NULL, 0,
              20);
    unlink(part);
    unlink(whole);
}

// --- many workers -----------------------------------------------------------------------------

typedef struct crowd {
    int64_t next, count;
    double work_s, end_s;
} crowd;

/// Ten milliseconds on average, from half to one and a half of it.
static bool give(void* user, bt_job* job) {
    crowd* c = user;
    if (c->next == c->count)
        return false;
    job->run = c->next++;
    job->x[0] = 0.01 * (0.5 + (double)(job->run * 7919 % 1000) / 999);
    return true;
}

static bt_status take(void* user, const bt_job* job, const bt_landing_result* result) {
    crowd* c = user;
    (void)job;
    c->work_s += result->wall_s;
    c->end_s = fmax(c->end_s, result->end_time_s);
    return BT_OK;
}

static double efficiency(int workers, int64_t landings) {
    crowd c = {.count = landings};
    const bt_axes axes = {.count = 1};
    const bt_executor executor = {.axes = &axes,
                                  .threads = workers,
                                  .source = give,
                                  .sink = take,
                                  .user = &c,
                                  .backend = &bt_simulated_backend};
    return bt_executor_run(&executor, NULL) == BT_OK ? c.work_s / (workers * c.end_s) : NAN;
}

void bench_ledger(void) {
    bt_study study;
    if (bt_study_read("studies/reference/study.yaml", NULL, 0, &study, NULL) != BT_OK) {
        printf("studies/reference/study.yaml cannot be read: run from the project's directory\n");
        return;
    }
    const int64_t rows = size_of("BT_BENCH_ROWS", 100000);
    bench_rows(&study, rows / 10);
    bench_rows(&study, rows);
    bt_study_destroy(&study);
    const int64_t landings = size_of("BT_BENCH_LANDINGS", 1000000);
    static const int workers[] = {100, 1000};
    for (int i = 0; i < 2; ++i) {
        char name[64];
        snprintf(name, sizeof name, "%d simulated workers of 10 ms: idle", workers[i]);
        bench_row(name, 100 * (1 - efficiency(workers[i], landings)), "%", NULL, 0, 5);
    }
}
