#include "campaign/campaign.h"

#include "base/clock.h"

#include <math.h>
#include <stdlib.h>

enum { GROUP_RUNS = 64 };
static const double group_seconds = 1.0;

typedef struct campaign {
    const bt_campaign_options* options;
    bt_campaign_progress* progress;
    bt_design* design;
    bt_ledger* ledger;
    bt_diag* diag;
    int64_t count;          ///< runs of the whole design
    int64_t next;           ///< the next run to look at
    unsigned char* present; ///< [count / 8 + 1] one bit per run: it is in the ledger
    int uncommitted;
    double started_s, committed_s;
} campaign;

static bool mine(const campaign* c, int64_t run) {
    return c->options->shards <= 1 || run % c->options->shards == c->options->shard;
}

static bool is_present(const campaign* c, int64_t run) {
    return c->present[run / 8] >> (run % 8) & 1;
}

static void count_result(bt_campaign_progress* progress, bt_outcome outcome) {
    ++progress->done;
    progress->engaged += outcome == BT_ENGAGED;
    progress->missed += outcome == BT_MISSED;
    progress->failed += outcome == BT_FAILED;
}

static bool note_present(void* user, const bt_ledger_row* row) {
    campaign* c = user;
    if (row->run < 0 || row->run >= c->count)
        return true;
    c->present[row->run / 8] = (unsigned char)(c->present[row->run / 8] | 1u << (row->run % 8));
    if (mine(c, row->run))
        count_result(c->progress, row->result.outcome);
    return true;
}

static bool next_job(void* user, bt_job* job) {
    campaign* c = user;
    while (c->next < c->count && (!mine(c, c->next) || is_present(c, c->next)))
        ++c->next;
    if (c->next >= c->count)
        return false;
    job->run = c->next++;
    bt_design_point(c->design, job->run, job->x);
    return true;
}

static bt_status commit(campaign* c) {
    c->uncommitted = 0;
    c->committed_s = bt_clock_s();
    return bt_ledger_commit(c->ledger, c->diag);
}

static bt_status store(void* user, const bt_job* job, const bt_landing_result* result) {
    campaign* c = user;
    BT_TRY(bt_ledger_add(c->ledger, job->run, job->x, NAN, result, c->diag));
    count_result(c->progress, result->outcome);
    return ++c->uncommitted >= GROUP_RUNS ? commit(c) : BT_OK;
}

static bt_status pulse(void* user) {
    campaign* c = user;
    c->progress->seconds = bt_clock_s() - c->started_s;
    if (c->options->watch)
        c->options->watch(c->options->user, c->progress);
    if (c->uncommitted > 0 && bt_clock_s() - c->committed_s >= group_seconds)
        return commit(c);
    return BT_OK;
}

static bt_status run(campaign* c, const bt_study* study) {
    for (int64_t r = 0; r < c->count; ++r)
        c->progress->total += mine(c, r);
    BT_TRY(bt_ledger_walk(c->ledger, note_present, c, c->diag));
    c->progress->before = c->progress->done;

    const bt_executor executor = {
        .model = &study->model,
        .inputs = study->inputs,
        .axes = bt_design_get_axes(c->design),
        .threads = c->options->threads > 0 ? c->options->threads : (int)study->campaign.threads,
        .stop = c->options->stop,
        .source = next_job,
        .sink = store,
        .pulse = pulse,
        .user = c,
    };
    bt_status status = BT_OK;
    if (c->progress->done < c->progress->total)
        status = bt_executor_run(&executor, c->diag);
    /* what is finished is kept, whatever ended the work */
    const bt_status committed = commit(c);
    return status == BT_OK ? committed : status;
}

bt_status bt_campaign_run(const bt_study* study, bt_ledger* ledger,
                          const bt_campaign_options* options, bt_campaign_progress* progress,
                          bt_diag* diag) {
    *progress = (bt_campaign_progress){0};
    campaign c = {.options = options,
                  .progress = progress,
                  .ledger = ledger,
                  .diag = diag,
                  .started_s = bt_clock_s(),
                  .committed_s = bt_clock_s()};
    BT_TRY(bt_design_create(study, &c.design, diag));
    c.count = bt_design_count(c.design);
    c.present = calloc((size_t)(c.count / 8 + 1), 1);
    bt_status status = c.present ? run(&c, study) : BT_ERR_MEMORY;
    free(c.present);
    bt_design_destroy(c.design);
    progress->seconds = bt_clock_s() - c.started_s;
    if (options->watch)
        options->watch(options->user, progress);
    if (status == BT_OK &&
        (double)progress->failed > study->campaign.max_failed * (double)progress->total) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "campaign: %lld of %lld runs failed, more than max_failed = %g allows; see the "
                    "columns failed_element and failed_quantity of the ledger",
                    (long long)progress->failed, (long long)progress->total,
                    study->campaign.max_failed);
        status = BT_ERR_FAILED_RUNS;
    }
    return status;
}

static bool take_label(void* user, const bt_ledger_row* row) {
    bt_labels* labels = user;
    if (row->result.outcome == BT_FAILED) {
        ++labels->failed;
        return true;
    }
    for (int i = 0; i < labels->axis_count; ++i)
        labels->x[labels->count * labels->axis_count + i] = row->x[i];
    labels->label[labels->count] = row->result.outcome == BT_ENGAGED ? 1 : -1;
    labels->margin_m[labels->count] = row->result.margin_m;
    ++labels->count;
    return true;
}

bt_status bt_labels_read(bt_ledger* ledger, int axis_count, bt_labels* labels, bt_diag* diag) {
    *labels = (bt_labels){.axis_count = axis_count};
    bt_ledger_counts counts;
    BT_TRY(bt_ledger_count(ledger, &counts, diag));
    const size_t rows = (size_t)counts.runs + 1;
    labels->x = calloc(rows * (size_t)(axis_count + 1), sizeof *labels->x);
    labels->label = calloc(rows, sizeof *labels->label);
    labels->margin_m = calloc(rows, sizeof *labels->margin_m);
    bt_status status = labels->x && labels->label && labels->margin_m
                           ? bt_ledger_walk(ledger, take_label, labels, diag)
                           : BT_ERR_MEMORY;
    if (status != BT_OK)
        bt_labels_destroy(labels);
    return status;
}

void bt_labels_destroy(bt_labels* labels) {
    free(labels->x);
    free(labels->label);
    free(labels->margin_m);
    *labels = (bt_labels){0};
}
