#include "cli/chain.h"
#include "base/clock.h"
#include "cluster/cluster.h"
#include "report/campaign_status.h"

#include <stdio.h>
#include <stdlib.h>

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

/// A campaign as it is shown: the line on stderr, and status.json once a second.
typedef struct showing {
    bt_chain* chain;
    bt_progress line;
    double written_s;
} showing;

/// Beside the ledger, for programs that watch. What keeps it from being written is said of the
/// ledger, too.
static void write_status(const bt_chain* chain, const bt_campaign_progress* p) {
    bt_campaign_status status = bt_campaign_status_of(p);
    char path[BT_FILE_PATH_MAX], ledger[BT_FILE_PATH_MAX], *text = NULL;
    size_t size = 0;
    if (bt_study_directory_file(&chain->directory, "status.json", path) != BT_OK ||
        bt_study_directory_file(&chain->directory, BT_LEDGER_NAME, ledger) != BT_OK ||
        bt_ledger_hash(chain->ledger, &status.content, NULL) != BT_OK)
        return;
    status.ledger = ledger;
    FILE* out = open_memstream(&text, &size);
    bt_json json = {.out = out};
    if (!out)
        return;
    bt_campaign_status_write(&json, &status);
    if (fclose(out) == 0)
        (void)!bt_file_write(path, text, size, NULL);
    free(text);
}

static void show(void* user, const bt_campaign_progress* p) {
    showing* s = user;
    const int64_t fresh = p->done - p->before;
    const double rate = p->seconds > 0 ? (double)fresh / p->seconds : 0;
    const int64_t labelled = p->engaged + p->missed;
    char left[32];
    bt_duration_text(rate > 0 ? (double)(p->total - p->done) / rate : 0, left, sizeof left);
    bt_progress_show(&s->line, false,
                     "%lld/%lld landings, %lld failed, %.1f/s, %s left, %.1f %% engaged",
                     (long long)p->done, (long long)p->total, (long long)p->failed, rate, left,
                     labelled ? 100.0 * (double)p->engaged / (double)labelled : 0.0);
    if (bt_clock_s() - s->written_s < 1)
        return;
    s->written_s = bt_clock_s();
    write_status(s->chain, p);
}

bt_status bt_chain_campaign(bt_chain* chain, int shard, int shards,
                            bt_campaign_progress* progress) {
    showing s = {.chain = chain,
                 .line =
                     bt_progress_start("campaign", chain->command->quiet || chain->command->json),
                 .written_s = bt_clock_s()};
    const bt_campaign_options options = {.shard = shard,
                                         .shards = shards,
                                         .stop = &bt_interrupted,
                                         .backend = bt_cluster_backend(),
                                         .watch = show,
                                         .user = &s};
    atomic_store(&bt_grace_s, 5);
    const bt_status status = bt_stage_campaign(&chain->directory, &options, progress);
    write_status(chain, progress);
    atomic_store(&bt_grace_s, 1);
    char took[32];
    bt_duration_text(progress->seconds, took, sizeof took);
    const int64_t fresh = progress->done - progress->before;
    bt_progress_show(
        &s.line, true, "%lld landings (%lld new in %s): %lld engaged, %lld missed, %lld failed%s",
        (long long)progress->done, (long long)fresh, took, (long long)progress->engaged,
        (long long)progress->missed, (long long)progress->failed,
        status == BT_ERR_INTERRUPTED ? "; interrupted, run again to go on" : "");
    return status;
}
