#include "campaign/campaign.h"

#include "base/clock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GROUP_RUNS = 64 };
static const double group_seconds = 1.0;

typedef struct campaign {
    const bt_campaign_options* options;
    bt_campaign_progress* progress;
    bt_design* design;
    bt_ledger* ledger;
    bt_diag* diag;
    int64_t count;           ///< runs of the whole design
    int64_t next;            ///< the next run to look at
    int64_t begin, end;      ///< runs of the round
    double *x, *log_density; ///< of the round, [(end - begin) * axes], [end - begin]; NULL: the
                             ///< design's own
    unsigned char* present;  ///< [count / 8 + 1] one bit per run: it is in the ledger
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

static void note_present(void* user, int64_t run, bt_outcome outcome) {
    campaign* c = user;
    if (run < 0 || run >= c->count)
        return;
    c->present[run / 8] = (unsigned char)(c->present[run / 8] | 1u << (run % 8));
    if (mine(c, run))
        count_result(c->progress, outcome);
}

/// What the ledger has. Where that is the beginning of the design, all of it, the ledger's totals
/// say so; else every run is looked at.
static bt_status find_present(campaign* c) {
    bt_ledger_counts counts;
    int64_t last;
    BT_TRY(bt_ledger_count(c->ledger, &counts, c->diag));
    BT_TRY(bt_ledger_last_run(c->ledger, &last, c->diag));
    if (c->options->shards > 1 || last >= c->count || counts.runs != last + 1)
        return bt_ledger_scan(c->ledger, note_present, c, c->diag);
    memset(c->present, 0xff, (size_t)(counts.runs / 8));
    c->present[counts.runs / 8] = (unsigned char)((1u << (counts.runs % 8)) - 1);
    c->progress->done = counts.runs;
    c->progress->engaged = counts.engaged;
    c->progress->missed = counts.missed;
    c->progress->failed = counts.failed;
    return BT_OK;
}

static int64_t count_mine(const campaign* c) {
    const int64_t shards = c->options->shards;
    return shards <= 1 ? c->count : c->count / shards + (c->options->shard < c->count % shards);
}

static bool next_job(void* user, bt_job* job) {
    campaign* c = user;
    while (c->next < c->end && (!mine(c, c->next) || is_present(c, c->next)))
        ++c->next;
    if (c->next >= c->end)
        return false;
    job->run = c->next++;
    const size_t axes = (size_t)bt_design_get_axes(c->design)->count;
    if (c->x)
        memcpy(job->x, c->x + (size_t)(job->run - c->begin) * axes, axes * sizeof *job->x);
    else
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
    const double log_density =
        c->x ? c->log_density[job->run - c->begin] : bt_design_log_density(c->design, job->x);
    BT_TRY(bt_ledger_add(c->ledger, job->run, job->x, log_density, result, c->diag));
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

/// Runs what is missing of the runs begin .. end - 1.
static bt_status run_round(campaign* c, const bt_study* study) {
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
        .backend = c->options->backend,
    };
    c->next = c->begin;
    const bt_status status = bt_executor_run(&executor, c->diag);
    /* what is finished is kept, whatever ended the work */
    const bt_status committed = commit(c);
    return status == BT_OK ? committed : status;
}

static bool is_complete(const campaign* c) {
    for (int64_t r = c->begin; r < c->end; ++r)
        if (!is_present(c, r))
            return false;
    return true;
}

/// Draws the points of a whole round, so that a campaign may grow.
static bt_status draw_round(campaign* c, int64_t whole) {
    const bt_campaign_rounds* rounds = c->options->rounds;
    const size_t n = (size_t)(whole - c->begin),
                 axes = (size_t)bt_design_get_axes(c->design)->count;
    c->x = malloc(n * axes * sizeof *c->x);
    c->log_density = malloc(n * sizeof *c->log_density);
    if (!c->x || !c->log_density)
        return BT_ERR_MEMORY;
    return rounds->draw(rounds->user, c->ledger, c->begin, (int64_t)n, c->x, c->log_density,
                        c->diag);
}

/// Asks, before a round that lacks landings, whether those before are enough.
static bt_status ask(campaign* c, bool* enough) {
    const bt_campaign_rounds* rounds = c->options->rounds;
    *enough = false;
    return rounds->enough && c->begin > 0
               ? rounds->enough(rounds->user, c->ledger, c->begin, enough, c->diag)
               : BT_OK;
}

/// One round after the other; the points of a round are drawn when it lacks any.
static bt_status run_rounds(campaign* c, const bt_study* study) {
    const bt_campaign_rounds* rounds = c->options->rounds;
    bt_status status = BT_OK;
    bool enough = false;
    for (c->begin = 0; c->begin < c->count && status == BT_OK; c->begin = c->end) {
        const int64_t whole = rounds->end(rounds->user, c->begin);
        c->end = whole < c->count ? whole : c->count;
        if (is_complete(c))
            continue;
        status = ask(c, &enough);
        if (status == BT_OK && enough) {
            c->progress->total = c->progress->done;
            break;
        }
        if (status == BT_OK && c->begin > 0 && rounds->draw)
            status = draw_round(c, whole);
        if (status == BT_OK)
            status = run_round(c, study);
        free(c->x);
        free(c->log_density);
        c->x = c->log_density = NULL;
    }
    return status;
}

static bt_status run_design(campaign* c, const bt_study* study) {
    c->progress->total = count_mine(c);
    BT_TRY(find_present(c));
    c->progress->before = c->progress->done;
    if (c->progress->done >= c->progress->total)
        return commit(c);
    const bt_campaign_rounds* rounds = c->options->rounds;
    if (rounds && c->options->shards > 1 && rounds->end(rounds->user, 0) < c->count) {
        bt_diag_add(c->diag, BT_ERROR, BT_NOWHERE,
                    "campaign: rounds need the landings of all shards; set campaign.unsure to 0 "
                    "to run the design conditions in shards");
        return BT_ERR_INPUT;
    }
    if (rounds)
        return run_rounds(c, study);
    c->end = c->count;
    return run_round(c, study);
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
    bt_status status = c.present ? run_design(&c, study) : BT_ERR_MEMORY;
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
