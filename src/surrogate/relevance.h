/// Automatic relevance: one weight per input, so that a kernel of equal width in all directions can
/// follow an outcome that depends far more finely on one input than on another.
///
///   exp(-gamma sum_k (w_k (x_k - s_k) / sd_k)^2),   w_k a power of sqrt 2
#ifndef BT_SURROGATE_RELEVANCE_H
#define BT_SURROGATE_RELEVANCE_H

#include "base/status.h"

#include <stdbool.h>

/// One fold of the cross-validation with given weights.
/// @param weight  [dims]
/// @param loss    cross-entropy of the answers to the landings of the fold (loss.h), their sum;
///                INFINITY: these weights are out of the question
typedef bt_status bt_relevance_trial(void* user, const double* weight, int fold, double* loss);

/// What to search, and with what.
typedef struct bt_relevance {
    int dims, folds;
    const bool* varies; ///< [dims] an input that never varied keeps the weight 1
    int threads;        ///< 0: one per core
    bt_relevance_trial* trial;
    void* user;
} bt_relevance;

/// Searches the weights by steepest descent of the loss: every input is tried at twice and at half
/// its weight, between 1/16 and 16, and the one change that gains most is made, until none gains
/// at least 1 % or twelve were made; then the same with sqrt 2 for 2. Input by input would be
/// quicker but ends wherever the first inputs happen to go while the others are still wrong. With
/// fewer than two inputs that vary there is nothing to weigh: gamma does it. The same weights for
/// any number of threads.
///
/// @param weight  [dims] out; a power of sqrt 2 each
/// @return BT_OK, BT_ERR_MEMORY, or what a trial returned
BT_CHECKED bt_status bt_relevance_search(const bt_relevance* relevance, double* weight);

#endif
