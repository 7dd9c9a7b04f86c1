/// What a campaign costs beside its landings, and how it scales over threads.
#include "bench.h"

#include "campaign/campaign.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { REFUSED = 4000, LANDINGS = 120 };

/// Seconds of a campaign into a new ledger.
static double time_campaign(const bt_study* study, int threads) {
    char path[] = "bench-campaign-XXXXXX";
    const int file = mkstemp(path);
    bt_ledger* ledger = NULL;
    bt_campaign_progress progress;
    const bt_campaign_options options = {.threads = threads};
    if (file < 0)
        return NAN;
    close(file);
    const double start = bench_now_s();
    bt_status status = bt_ledger_open(path, study, BT_LEDGER_CREATE, &ledger, NULL);
    if (status == BT_OK)
        status = bt_campaign_run(study, ledger, &options, &progress, NULL);
    const double seconds = bench_now_s() - start;
    bt_ledger_close(ledger);
    unlink(path);
    return status == BT_OK ? seconds : NAN;
}

/// Points that the model does not allow go through everything but the landing itself.
static double overhead_per_run(const bt_study* study) {
    bt_study* outside = malloc(sizeof *outside);
    if (!outside)
        return NAN;
    *outside = *study;
    outside->campaign.design = BT_DESIGN_SOBOL; // over a box, which can be put outside the model
    outside->campaign.samples = REFUSED;
    outside->campaign.max_failed = 1;
    outside->inputs[0].lower = -20;
    outside->inputs[0].upper = -10;
    double best = INFINITY;
    for (int i = 0; i < 5; ++i)
        best = fmin(best, time_campaign(outside, 1) / REFUSED);
    free(outside);
    return best;
}

void bench_campaign(void) {
    bt_study study;
    if (bt_study_read("studies/reference/study.yaml", NULL, 0, &study, NULL) != BT_OK) {
        printf("studies/reference/study.yaml cannot be read: run from the project's directory\n");
        return;
    }
    study.campaign.samples = LANDINGS;
    double seconds[3];
    for (int threads = 1; threads <= 2; ++threads) {
        seconds[threads] = INFINITY;
        for (int i = 0; i < 3; ++i)
            seconds[threads] = fmin(seconds[threads], time_campaign(&study, threads));
    }
    const double landing_s = seconds[1] / LANDINGS, overhead_s = overhead_per_run(&study);
    bench_row("scheduler and ledger, per landing", 1e6 * overhead_s, "us", NULL, 0,
              1e6 * 0.01 * landing_s);
    bench_row("campaign, one thread", LANDINGS / seconds[1], "1/s", NULL, 0, 0);
    bench_row("campaign, two threads", LANDINGS / seconds[2], "1/s", "0.95 of twice one",
              0.95 * 2 * LANDINGS / seconds[1], 0);
    bt_study_destroy(&study);
}
