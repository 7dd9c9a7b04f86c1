/// A campaign: the design of a study, run into its ledger. Runs that the ledger has are not
/// repeated, so an interrupted campaign goes on where it stopped  [Peng2023 Sec. 5.2].
#ifndef BT_CAMPAIGN_CAMPAIGN_H
#define BT_CAMPAIGN_CAMPAIGN_H

#include "campaign/executor.h"
#include "campaign/ledger.h"

typedef struct bt_campaign_progress {
    int64_t total;                   ///< runs of the design, or of this shard; of the rounds run
                                     ///< when they were enough
    int64_t before;                  ///< of them, in the ledger before this call
    int64_t done;                    ///< of them, in the ledger now
    int64_t engaged, missed, failed; ///< of done
    double seconds;                  ///< since the call
} bt_campaign_progress;

typedef void bt_campaign_watch(void* user, const bt_campaign_progress* progress);

/// Rounds of a design whose points depend on the landings before: a round begins where another
/// ends, when all its runs are in the ledger.
typedef struct bt_campaign_rounds {
    /// The first run after a round that begins at `begin`.
    int64_t (*end)(void* user, int64_t begin);
    /// Whether the landings before `end` are enough; NULL: all runs of the design are wanted.
    bt_status (*enough)(void* user, bt_ledger* ledger, int64_t end, bool* yes, bt_diag* diag);
    /// Points and log densities of the n runs from `begin` on; all before are in the ledger. NULL:
    /// the design's own points.
    bt_status (*draw)(void* user, bt_ledger* ledger, int64_t begin, int64_t n, double* x,
                      double* log_density, bt_diag* diag);
    void* user;
} bt_campaign_rounds;

typedef struct bt_campaign_options {
    int shard, shards;         ///< runs with run % shards == shard; shards 0 or 1: all
    int threads;               ///< 0: what the study says
    const atomic_int* stop;    ///< may be NULL; not 0: finish what is in flight
    const bt_backend* backend; ///< NULL: threads
    bt_campaign_watch* watch;  ///< may be NULL; called about five times a second and at the end
    void* user;
    const bt_campaign_rounds* rounds; ///< NULL: the design's own points, all at once
} bt_campaign_options;

/// Runs what is missing. Results are committed in groups (64 runs or one second); the ledger's
/// content does not depend on the number of threads, on interruptions, or on shards.
/// `progress` is filled in any case. Returns BT_OK, BT_ERR_INTERRUPTED, BT_ERR_FAILED_RUNS (more
/// failed than campaign.max_failed allows; all runs are done), BT_ERR_INPUT (also rounds of a
/// shard, which does not have the landings of the others), BT_ERR_IO, BT_ERR_MEMORY.
BT_CHECKED bt_status bt_campaign_run(const bt_study* study, bt_ledger* ledger,
                                     const bt_campaign_options* options,
                                     bt_campaign_progress* progress, bt_diag* diag);

/// The runs of a ledger as a classifier wants them: failed ones left out, in order of run number.
typedef struct bt_labels {
    int count, axis_count;
    double* x;        ///< [count * axis_count] row-major, SI
    int* label;       ///< [count] +1 engaged, -1 missed
    double* margin_m; ///< [count]
    int64_t failed;   ///< runs left out
} bt_labels;

/// Reads them; BT_ERR_MEMORY, BT_ERR_IO. To be given back by bt_labels_destroy.
BT_CHECKED bt_status bt_labels_read(bt_ledger* ledger, int axis_count, bt_labels* labels,
                                    bt_diag* diag);
void bt_labels_destroy(bt_labels* labels);

#endif
