/// Automatic relevance: one weight per input, so that a kernel of equal width in all directions can
/// follow an outcome that depends far more finely on one input than on another.
///
///   exp(-gamma sum_k (w_k (x_k - s_k) / sd_k)^2),   w_k a power of two
#ifndef BT_SURROGATE_RELEVANCE_H
#define BT_SURROGATE_RELEVANCE_H

#include "base/status.h"

#include <stdbool.h>

/// One fold of the cross-validation with given weights.
/// @param weight   [dims]
/// @param correct  right answers among the landings of the fold
typedef bt_status bt_relevance_trial(void* user, const double* weight, int fold, int* correct);

/// What to search, and with what.
typedef struct bt_relevance {
    int dims, folds, count; ///< count: landings of the cross-validation, all folds together
    const bool* varies;     ///< [dims] an input that never varied keeps the weight 1
    int threads;            ///< 0: one per core
    bt_relevance_trial* trial;
    void* user;
} bt_relevance;

/// Searches the weights input by input: each in turn is tried at a quarter, half, twice and four
/// times what it is, between 1/8 and 16, and moves to where most answers are right if that gains
/// at least half a standard error. It ends when no input moved in a whole turn, or after
/// three turns. With fewer than two inputs that vary there is nothing to weigh: gamma does it. The
/// same weights for any number of threads.
///
/// @param weight  [dims] out; a power of two each
/// @return BT_OK, BT_ERR_MEMORY, or what a trial returned
BT_CHECKED bt_status bt_relevance_search(const bt_relevance* relevance, double* weight);

#endif
