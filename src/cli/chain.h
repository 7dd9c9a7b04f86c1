/// The links of the chain campaign, fit, reliability: what the verbs of the same names do, and
/// `study` one after the other. Each leaves its files in the study directory.
#ifndef BT_CLI_CHAIN_H
#define BT_CLI_CHAIN_H

#include "base/directory.h"
#include "campaign/campaign.h"
#include "cli/cli.h"
#include "surrogate/surrogate.h"

typedef struct bt_chain {
    const bt_command* command;
    bt_study study;
    bt_directory directory;
    bt_ledger* ledger;
    bt_diag diag;
} bt_chain;

/// Reads the study and opens its ledger; for writing it also takes the study directory and writes
/// study.yaml there.
BT_CHECKED bt_status bt_chain_open(const bt_command* command, bt_ledger_access how,
                                   bt_chain* chain);
void bt_chain_close(bt_chain* chain); ///< accepts one whose opening failed

/// Runs what the campaign lacks, with progress on stderr.
BT_CHECKED bt_status bt_chain_campaign(bt_chain* chain, int shard, int shards,
                                       bt_campaign_progress* progress);

/// A file of the study directory, as a path in a buffer of BT_FILE_PATH_MAX bytes.
BT_CHECKED bt_status bt_chain_file(const bt_chain* chain, const char* name, char* path);

/// surrogate.model: trains it, or takes the one there is when it came from the same landings and
/// settings (*fresh false). The caller owns *surrogate.
BT_CHECKED bt_status bt_chain_fit(bt_chain* chain, bool again, bt_surrogate* surrogate,
                                  bool* fresh);
void bt_surrogate_print(FILE* out, const bt_surrogate* surrogate);

/// reliability.json and reliability.txt: computes them, or leaves them when they came from the
/// same surrogate and settings; then copies the one that is asked for to stdout.
BT_CHECKED bt_status bt_chain_reliability(bt_chain* chain, bool again,
                                          const bt_surrogate* surrogate);

#endif
