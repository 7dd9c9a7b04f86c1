/// Landings of a ledger, computed again: whether they come out the same to the bit, and how far
/// they differ when they do not.
#ifndef BT_PIPELINE_VERIFY_H
#define BT_PIPELINE_VERIFY_H

#include "campaign/ledger.h"
#include "landing/landing.h"

#include <stdatomic.h>

/// Computes a run again at the inputs that the ledger has. With an observer its history may be
/// kept. `model` is the model as it landed. BT_ERR_INTERRUPTED when `stop` is set; BT_ERR_MEMORY.
BT_CHECKED bt_status bt_run_repeat(const bt_study* study, const bt_ledger_row* row,
                                   const atomic_int* stop, bt_model_params* model,
                                   bt_landing_result* result, bt_landing_observer* observer,
                                   void* user);

/// Whether a run came out as the ledger has it: everything but its wall-clock time, to the bit.
bool bt_run_is_same(const bt_ledger* ledger, const bt_ledger_row* row,
                    const bt_landing_result* result);

typedef struct bt_verification {
    int64_t runs; ///< of the ledger
    int64_t repeated, same;
    int64_t other_outcome;  ///< of those repeated
    double margin_change_m; ///< the largest of those with a margin in both; 0: none
    int64_t first_other;    ///< the first run that is not the same; -1: none
    char made_by[96];       ///< version and instruction set that the ledger was begun with
    char here[96];          ///< and this program's
} bt_verification;

/// Repeats `count` runs of a ledger, spread evenly over it from the first to the last (all, where
/// it has no more), one after another.
///
/// @return BT_OK also when they differ; BT_ERR_INPUT, said in diag, when there is no run;
///         BT_ERR_INTERRUPTED, BT_ERR_IO, BT_ERR_MEMORY
BT_CHECKED bt_status bt_ledger_verify(const bt_study* study, bt_ledger* ledger, int64_t count,
                                      const atomic_int* stop, bt_verification* result,
                                      bt_diag* diag);

#endif
