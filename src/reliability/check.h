/// The check of a surrogate against fresh high-fidelity runs, and the estimate corrected by it.
///
/// The samples of a Monte Carlo (the pool) are divided into strata by the surrogate's prediction
/// and by whether they lie close to its boundary. In each stratum high-fidelity runs are made of
/// samples picked at random; within a stratum a disagreement has one sign, so that its rate e_k is
/// a plain proportion:
///
///   R = sum_k W_k q_k,  q_k = 1 - e_k where the surrogate says engaged, e_k where it says missed
///     = mean(surrogate) + mean(model - surrogate)
///
/// W_k is the stratum's share of the pool. How the runs are shared out changes the width of the
/// interval, never the mean of the estimate. Derived in docs/theory/reliability.md.
#ifndef BT_RELIABILITY_CHECK_H
#define BT_RELIABILITY_CHECK_H

#include "reliability/monte_carlo.h"
#include "statistics/intervals.h"

enum { BT_STRATA = 4 }; ///< 2 * (predicted engaged) + (in the boundary layer)

typedef struct bt_stratum {
    int64_t pool;  ///< samples of the pool in it
    int planned;   ///< high-fidelity runs to make
    int runs;      ///< high-fidelity runs made, failed ones included
    int failed;    ///< runs among them without an outcome
    int disagreed; ///< runs with an outcome other than the surrogate's
} bt_stratum;

typedef struct bt_check {
    float layer; ///< samples with |decision| up to this are in the boundary strata
    int picked_count;
    int* picked; ///< [picked_count] samples to run, stratum by stratum
    bt_stratum stratum[BT_STRATA];
} bt_check;

/// Which stratum a sample belongs to.
int bt_check_stratum(const bt_check* check, int8_t label, float decision);

/// Divides the pool and picks the samples to run.
///
/// @param runs            high-fidelity runs to share out; fewer when the pool has fewer
/// @param expected_error  guess of the surrogate's disagreement rate (its hold-out error), 0 .. 1;
///                        decides only where the runs go
/// @param seed, stream    key of the picking
/// @return BT_OK or BT_ERR_MEMORY. On BT_OK the caller owns check->picked (free).
BT_CHECKED bt_status bt_check_plan(const bt_pool* pool, int runs, double expected_error,
                                   uint64_t seed, uint32_t stream, bt_check* check);

/// What the high-fidelity runs say.
typedef struct bt_check_result {
    double corrected;           ///< R
    bt_interval corrected_ci95; ///< covers surrogate error, sampling, and failed runs either way
    double disagreement;        ///< sum_k W_k e_k
    bt_interval disagreement_ci95;
} bt_check_result;

/// The corrected estimate with its interval. Strata are combined by squares of the distances to
/// their Clopper-Pearson limits (MOVER), together with the pool's own sampling interval; a stratum
/// without a run may be anything. Failed runs are left out of the estimate and count as missed in
/// the lower limit and as engaged in the upper. Never of zero width; within [0, 1].
bt_check_result bt_check_estimate(const bt_stratum stratum[BT_STRATA]);

#endif
