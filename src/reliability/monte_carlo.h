/// Crude Monte Carlo on anything that labels points.
#ifndef BT_RELIABILITY_MONTE_CARLO_H
#define BT_RELIABILITY_MONTE_CARLO_H

#include "reliability/sampler.h"

/// Labels n points (row-major, the sampler's variables): +1 engaged, -1 missed, and a decision
/// value whose size says how far from the boundary. Called from several threads at once.
typedef void bt_classify(void* user, const double* x, int n, int8_t* label, float* decision);

typedef struct bt_classifier {
    bt_classify* classify;
    void* user;
    int dims;   ///< numbers per point
    bool boxed; ///< least and greatest hold: the box in which the classifier was trained
    double least[BT_INPUT_MAX], greatest[BT_INPUT_MAX];
} bt_classifier;

/// What came out of the samples. Counts, so the order of adding does not matter.
typedef struct bt_tally {
    int64_t samples, engaged;
    int64_t outside, outside_engaged; ///< of them, outside the box
} bt_tally;

/// The first samples of a Monte Carlo, kept one by one for the check by high-fidelity runs.
typedef struct bt_pool {
    int count;
    int8_t* label;   ///< [count]
    float* decision; ///< [count]; NULL: not kept
} bt_pool;

/// Draws and labels samples 0 .. samples - 1. The same result for any number of threads.
///
/// @param pool  may be NULL; filled with the first pool->count samples (at most `samples`)
/// @return BT_OK or BT_ERR_MEMORY
BT_CHECKED bt_status bt_monte_carlo(const bt_sampler* sampler, const bt_classifier* classifier,
                                    int64_t samples, int threads, const bt_pool* pool,
                                    bt_tally* tally);

/// How many of the samples first .. first + samples - 1 are labelled engaged.
/// @param pool  may be NULL; filled at the samples' own places
BT_CHECKED bt_status bt_monte_carlo_range(const bt_sampler* sampler,
                                          const bt_classifier* classifier, int64_t first,
                                          int64_t samples, int threads, const bt_pool* pool,
                                          int64_t* engaged);

#endif
