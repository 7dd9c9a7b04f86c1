/// High-fidelity runs: fresh landings of the full model, which check a surrogate or do without one.
#ifndef BT_RELIABILITY_HIGH_FIDELITY_H
#define BT_RELIABILITY_HIGH_FIDELITY_H

#include "campaign/executor.h"
#include "reliability/sampler.h"
#include "statistics/intervals.h"

#include <stdatomic.h>

/// Finds the outcomes of n points by the full model.
///
/// @param x      [n * inputs] row-major, SI, in the order of the study's inputs
/// @param label  [n] 1 engaged, 0 missed, -1 failed (no outcome)
typedef bt_status bt_high_fidelity_batch(void* user, const double* x, int n, int* label);

/// Landings of a study's model through the executor. Same labels for any number of threads.
typedef struct bt_high_fidelity bt_high_fidelity;

/// @param threads  0: one per core
/// @param stop     may be NULL; once not 0, landings in flight end and no more begin
/// @param backend  what computes the landings; NULL: threads of this process
/// @return BT_OK or BT_ERR_MEMORY. The study must outlive it.
BT_CHECKED bt_status bt_high_fidelity_create(const bt_study* study, int threads,
                                             const atomic_int* stop, const bt_backend* backend,
                                             bt_high_fidelity** high_fidelity);
void bt_high_fidelity_destroy(bt_high_fidelity* high_fidelity);

/// A bt_high_fidelity_batch whose user is a bt_high_fidelity. A run that diverges, and a point that
/// the model does not allow or that cannot be assembled (a tail of its distribution), has no
/// outcome: -1. Returns BT_OK, BT_ERR_INTERRUPTED, BT_ERR_MEMORY.
BT_CHECKED bt_status bt_high_fidelity_run(void* high_fidelity, const double* x, int n, int* label);

/// Whether no more of the landings so far had no outcome than campaign.max_failed allows.
/// BT_ERR_FAILED_RUNS, said in diag with the reason of the first.
BT_CHECKED bt_status bt_high_fidelity_check_failed(const bt_high_fidelity* high_fidelity,
                                                   bt_diag* diag);

/// Direct Monte Carlo: the full model at every sample, no surrogate.
typedef struct bt_direct_result {
    int64_t samples, engaged, failed;
    double probability; ///< share engaged, failed runs left out
    bt_interval ci95;   ///< Clopper-Pearson; failed runs counted as missed below, engaged above
} bt_direct_result;

/// Samples 0 .. samples - 1 of the sampler, whose variables are the inputs of `high_fidelity`.
/// Returns what that returns, or BT_ERR_MEMORY.
BT_CHECKED bt_status bt_direct_monte_carlo(const bt_sampler* sampler,
                                           bt_high_fidelity_batch* high_fidelity, void* user,
                                           int64_t samples, bt_direct_result* result);

#endif
