#include "bolter/campaign.h"

#include "api/case.h"
#include "pipeline/pipeline.h"

typedef struct watching {
    const bt_campaign_def* def;
    atomic_int stop;
} watching;

static bt_campaign_counts public_counts(const bt_campaign_progress* p) {
    return (bt_campaign_counts){
        .total = p->total,
        .before = p->before,
        .done = p->done,
        .engaged = p->engaged,
        .missed = p->missed,
        .failed = p->failed,
        .seconds = p->seconds,
    };
}

static void watch(void* user, const bt_campaign_progress* progress) {
    watching* w = user;
    const bt_campaign_counts counts = public_counts(progress);
    if (w->def->progress && !w->def->progress(w->def->user, &counts))
        atomic_store(&w->stop, 1);
}

bt_status bt_case_campaign(bt_case* opened, const bt_campaign_def* def,
                           bt_campaign_counts* counts) {
    bt_campaign_def wanted;
    if (!BT_DEF_COPY(wanted, def))
        return BT_ERR_ARG;
    bt_diag diag = bt_case_diag(opened);
    bt_study_directory directory;
    bt_campaign_progress progress = {0};
    watching w = {.def = &wanted};
    const bt_campaign_options options = {.shard = wanted.shard,
                                         .shards = wanted.shards,
                                         .stop = &w.stop,
                                         .watch = watch,
                                         .user = &w};
    bt_status status = bt_study_directory_open(&directory, &opened->study, BT_LEDGER_CREATE, &diag);
    if (status == BT_OK)
        status = bt_stage_campaign(&directory, &options, &progress);
    bt_study_directory_close(&directory);
    if (counts)
        *counts = public_counts(&progress);
    return status;
}

typedef struct walking {
    bt_campaign_visit* visit;
    void* user;
    bt_campaign_row row;
    const char* inputs[BT_INPUT_MAX];
} walking;

static bool walk(void* user, const bt_ledger_row* row) {
    walking* w = user;
    w->row.run = row->run;
    w->row.values = row->x;
    w->row.log_density = row->log_density;
    return bt_case_report(&row->result, &w->row.report) && w->visit(w->user, &w->row);
}

bt_status bt_case_ledger(bt_case* opened, bt_campaign_visit* visit, void* user) {
    bt_diag diag = bt_case_diag(opened);
    bt_study_directory directory;
    walking w = {.visit = visit, .user = user};
    const bt_axes axes = bt_design_axes(&opened->study);
    for (int i = 0; i < axes.count; ++i)
        w.inputs[i] = opened->study.inputs[axes.input[i]].path;
    w.row.input_count = axes.count;
    w.row.inputs = w.inputs;
    w.row.report.size = sizeof w.row.report;
    bt_status status = bt_study_directory_open(&directory, &opened->study, BT_LEDGER_READ, &diag);
    if (status == BT_OK)
        status = bt_ledger_walk(directory.ledger, walk, &w, &diag);
    bt_study_directory_close(&directory);
    return status;
}
