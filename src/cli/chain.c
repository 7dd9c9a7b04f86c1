#include "cli/chain.h"
#include "cluster/cluster.h"

#include <stdio.h>

bt_status bt_chain_open(const bt_command* command, bt_ledger_access how, bt_chain* chain) {
    *chain = (bt_chain){
        .command = command, .directory = {.lock = {.lock = -1}}, .diag = bt_stderr_diag()};
    BT_TRY(bt_command_study(command, &chain->study));
    const bt_status status =
        bt_study_directory_open(&chain->directory, &chain->study, how, &chain->diag);
    chain->ledger = chain->directory.ledger;
    return status;
}

void bt_chain_close(bt_chain* chain) {
    bt_study_directory_close(&chain->directory);
    bt_study_destroy(&chain->study);
}

static void show(void* user, const bt_campaign_progress* p) {
    const int64_t fresh = p->done - p->before;
    const double rate = p->seconds > 0 ? (double)fresh / p->seconds : 0;
    const int64_t labelled = p->engaged + p->missed;
    char left[32];
    bt_duration_text(rate > 0 ? (double)(p->total - p->done) / rate : 0, left, sizeof left);
    bt_progress_show(user, false,
                     "%lld/%lld landings, %lld failed, %.1f/s, %s left, %.1f %% engaged",
                     (long long)p->done, (long long)p->total, (long long)p->failed, rate, left,
                     labelled ? 100.0 * (double)p->engaged / (double)labelled : 0.0);
}

bt_status bt_chain_campaign(bt_chain* chain, int shard, int shards,
                            bt_campaign_progress* progress) {
    bt_progress line = bt_progress_start("campaign", chain->command->quiet || chain->command->json);
    const bt_campaign_options options = {.shard = shard,
                                         .shards = shards,
                                         .stop = &bt_interrupted,
                                         .backend = bt_cluster_backend(),
                                         .watch = show,
                                         .user = &line};
    atomic_store(&bt_grace_s, 5);
    const bt_status status = bt_stage_campaign(&chain->directory, &options, progress);
    atomic_store(&bt_grace_s, 1);
    char took[32];
    bt_duration_text(progress->seconds, took, sizeof took);
    const int64_t fresh = progress->done - progress->before;
    bt_progress_show(
        &line, true, "%lld landings (%lld new in %s): %lld engaged, %lld missed, %lld failed%s",
        (long long)progress->done, (long long)fresh, took, (long long)progress->engaged,
        (long long)progress->missed, (long long)progress->failed,
        status == BT_ERR_INTERRUPTED ? "; interrupted, run again to go on" : "");
    return status;
}
