/// The stages of a study, one call each: campaign, fit, reliability. A stage does what its result
/// lacks and nothing else: what it depends on is written down as a text beside the result (content
/// of the landings, settings, version of the algorithm), and the same text means the same result.
#ifndef BT_PIPELINE_PIPELINE_H
#define BT_PIPELINE_PIPELINE_H

#include "campaign/campaign.h"
#include "pipeline/study_directory.h"
#include "reliability/reliability.h"
#include "reliability/sobol_indices.h"
#include "surrogate/surrogate.h"

#include <stdio.h>

/// Runs the landings of the design that the ledger lacks (of one shard, when the options say so).
///
/// @return BT_OK; BT_ERR_INTERRUPTED (what was finished is kept); BT_ERR_FAILED_RUNS (more than
///         the study allows); BT_ERR_IO, BT_ERR_MEMORY; said in diag
BT_CHECKED bt_status bt_stage_campaign(bt_study_directory* directory,
                                       const bt_campaign_options* options,
                                       bt_campaign_progress* progress);

/// surrogate.model: trains it on the landings of the ledger, or takes the one there is when it
/// came from the same landings, settings and algorithm.
///
/// @param again      train in any case
/// @param surrogate  the caller's: bt_surrogate_destroy after BT_OK
/// @param fresh      whether it was trained now; may be NULL
BT_CHECKED bt_status bt_stage_fit(bt_study_directory* directory, bool again,
                                  bt_surrogate* surrogate, bool* fresh);

/// A form in which the result of a stage is kept: a file of the study directory and its writer.
typedef struct bt_reliability_file {
    const char* name; ///< "reliability.json"; NULL ends a list
    bt_status (*write)(FILE* out, const bt_reliability_result* result);
    bool events; ///< kept only of a study that has events
} bt_reliability_file;

typedef struct bt_reliability_stage {
    bool again;                       ///< compute even what is up to date
    const bt_reliability_file* files; ///< what is to be kept; the list ends in a NULL name
    const atomic_int* stop;           ///< may be NULL; once not 0: BT_ERR_INTERRUPTED
    const bt_backend* backend;        ///< of the high-fidelity runs; NULL: threads
    bt_reliability_watch* watch;      ///< may be NULL
    void* watch_user;
    bt_reliability_result* result; ///< receives the numbers, which are then computed in any case;
                                   ///< may be NULL
} bt_reliability_stage;

/// The probability of engagement for every condition, into the files of the stage; leaves them
/// when all are there and came from the same surrogate, distributions, conditions and settings.
///
/// @param fresh  whether they were written now; may be NULL
/// @return BT_OK; BT_ERR_FAILED_RUNS (more high-fidelity runs than campaign.max_failed allows, said
///         in diag: the files are written, and not taken for up to date); what bt_reliability_run
///         and bt_ledger_set_remark return
BT_CHECKED bt_status bt_stage_reliability(bt_study_directory* directory,
                                          const bt_surrogate* surrogate,
                                          const bt_reliability_stage* stage, bool* fresh);

/// Which input drives the scatter of outcomes: Sobol' indices of the study as it stands, on the
/// surrogate, with intervals. Nothing is written. BT_ERR_INPUT, said in diag, when the outcomes
/// have no variance.
BT_CHECKED bt_status bt_stage_indices(bt_study_directory* directory, const bt_surrogate* surrogate,
                                      bt_sobol_result* result);

/// Everything in order, skipping what is up to date.
///
/// @param surrogate  the caller's: bt_surrogate_destroy after BT_OK
BT_CHECKED bt_status bt_stage_study(bt_study_directory* directory,
                                    const bt_campaign_options* campaign,
                                    const bt_reliability_stage* reliability,
                                    bt_campaign_progress* progress, bt_surrogate* surrogate);

#endif
