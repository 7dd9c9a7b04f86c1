/// The campaign of a case: the landings of its design, kept in a ledger in the study directory.
#ifndef BOLTER_CAMPAIGN_H
#define BOLTER_CAMPAIGN_H

#include "bolter/landing.h"

#ifdef __cplusplus
extern "C" {
#endif

/// How far a campaign is.
typedef struct bt_campaign_counts {
    int64_t total;                   ///< landings of the design, or of this shard
    int64_t before;                  ///< of them, in the ledger before the call
    int64_t done;                    ///< of them, in the ledger now
    int64_t engaged, missed, failed; ///< of done
    double seconds;                  ///< since the call
} bt_campaign_counts;

/// Called about five times a second and at the end, on the thread of the call. False: landings in
/// flight end, no more begin, and the call returns BT_ERR_INTERRUPTED.
typedef bool bt_campaign_progressed(void* user, const bt_campaign_counts* counts);

/// How to run it. Set size to sizeof(bt_campaign_def); what is zero is the default.
typedef struct bt_campaign_def {
    size_t size;
    int shard, shards;                ///< only landings with number % shards == shard; 0: all
    bt_campaign_progressed* progress; ///< may be NULL
    void* user;
} bt_campaign_def;

/// Runs what the ledger lacks; what it has is not repeated. Results are committed in groups, so
/// that a kill loses what was in flight. The same bits for any number of threads.
///
/// @param counts  filled in any case; may be NULL
/// @return BT_OK; BT_ERR_INTERRUPTED (everything finished is kept); BT_ERR_FAILED_RUNS (more failed
///         than the study allows; all are done); BT_ERR_ARG, BT_ERR_IO, BT_ERR_MEMORY; said to the
///         case's message function
BT_PUBLIC BT_CHECKED bt_status bt_case_campaign(bt_case* opened, const bt_campaign_def* def,
                                                bt_campaign_counts* counts);

/// One landing of the ledger. Arrays and texts are valid during the call only.
typedef struct bt_campaign_row {
    int64_t run;
    int input_count;
    const char* const* inputs; ///< [input_count] paths: "landing.pitch"
    const double* values;      ///< [input_count] SI
    double log_density;        ///< natural logarithm of the density it was drawn with; NAN unknown
    bt_landing_report report;
} bt_campaign_row;

/// Calls visit for every landing of the ledger in order of number, until it returns false. The
/// ledger is opened for reading. BT_ERR_IO (there is none, or of another study), BT_ERR_MEMORY.
typedef bool bt_campaign_visit(void* user, const bt_campaign_row* row);
BT_PUBLIC BT_CHECKED bt_status bt_case_ledger(bt_case* opened, bt_campaign_visit* visit,
                                              void* user);

#ifdef __cplusplus
}
#endif

#endif
