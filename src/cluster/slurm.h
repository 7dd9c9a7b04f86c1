/// Batch scripts for a cluster with Slurm.
#ifndef BT_CLUSTER_SLURM_H
#define BT_CLUSTER_SLURM_H

#include "study/study.h"

enum { BT_SLURM_PARTS_MAX = 1000 }; ///< MaxArraySize of a Slurm as it comes, less one

/// Writes into a directory (made when it is not there) what runs a study as a job array: the study
/// as it was read, landings.sh (one shard per task), results.sh (merge, fit, reliability) and
/// submit.sh, which submits both. A task that is killed, preempted or at its time limit goes on
/// where it stopped when it is started again.
///
/// @param program  path of bolter on the nodes
/// @return BT_OK; BT_ERR_INPUT: the study's design cannot run in shards; BT_ERR_IO, BT_ERR_MEMORY;
///         said in diag
BT_CHECKED bt_status bt_slurm_write(const bt_study* study, const char* directory,
                                    const char* program, int parts, bt_diag* diag);

#endif
