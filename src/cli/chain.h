/// A verb that works on a study directory: reads the study, opens the directory, and calls the
/// stages of the pipeline with progress on stderr.
#ifndef BT_CLI_CHAIN_H
#define BT_CLI_CHAIN_H

#include "cli/cli.h"
#include "pipeline/pipeline.h"

typedef struct bt_chain {
    const bt_command* command;
    bt_study study;
    bt_study_directory directory;
    bt_ledger* ledger; ///< the directory's
    bt_diag diag;
} bt_chain;

/// Reads the study and opens its directory (bt_study_directory_open).
BT_CHECKED bt_status bt_chain_open(const bt_command* command, bt_ledger_access how,
                                   bt_chain* chain);
void bt_chain_close(bt_chain* chain); ///< accepts one whose opening failed

/// Runs what the campaign lacks, with progress on stderr.
BT_CHECKED bt_status bt_chain_campaign(bt_chain* chain, int shard, int shards,
                                       bt_campaign_progress* progress);

void bt_surrogate_print(FILE* out, const bt_surrogate* surrogate);

/// The reliability stage with progress; then copies the form that is asked for to stdout.
BT_CHECKED bt_status bt_chain_reliability(bt_chain* chain, bool again,
                                          const bt_surrogate* surrogate);

#endif
