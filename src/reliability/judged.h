/// The landings of a ledger, judged round by round, ready to be weighed for any condition.
#ifndef BT_RELIABILITY_JUDGED_H
#define BT_RELIABILITY_JUDGED_H

#include "reliability/classifier.h"
#include "reliability/pooled.h"
#include "reliability/rounds.h"

enum { BT_ROUNDS_MAX = 64 };

/// Everything that the pooled estimates of a study need.
typedef struct bt_judged {
    const bt_evidence* evidence;
    bt_design* design;
    bt_mixture* mixture;
    double least; ///< every landing was drawn with at least so many times the design's own density
    double tail;  ///< of the intervals
    int8_t* said; ///< [evidence.count] what the round's classifier said; -1: of the first round
    int8_t* engaged; ///< [evidence.count] the same from the first round that is judged, -1 before
    int rounds;      ///< that are judged
    int begin[BT_ROUNDS_MAX + 1]; ///< first landing of each round, and the end of the last
    bt_surrogate surrogate[BT_ROUNDS_MAX];
    bt_surrogate_classifier* classifier[BT_ROUNDS_MAX];
    bt_features features;
} bt_judged;

/// Whether the landings of a study's design say anything about its conditions: they are drawn from
/// a density over just the random inputs, and no input is frozen in a condition.
bool bt_judged_possible(const bt_study* study);

/// Trains the classifiers of all rounds and has them judge. The evidence and the study must
/// outlive it. Fewer than 129 landings are one round and none is judged. The same bits for any
/// number of threads.
/// @return BT_OK; BT_ERR_INPUT, BT_ERR_MEMORY (said in diag). On BT_OK the caller gives *made back.
BT_CHECKED bt_status bt_judged_create(const bt_study* study, const bt_evidence* evidence,
                                      bt_judged** made, bt_diag* diag);
void bt_judged_destroy(bt_judged* judged);

/// Samples of a condition that the rounds' classifiers call engaged: sample i belongs to the round
/// in proportion to its landings. hits of `samples`. BT_ERR_MEMORY.
/// @param pool  may be NULL; keeps the labels of the first samples
BT_CHECKED bt_status bt_judged_sample(const bt_judged* judged, const bt_sampler* sampler,
                                      int64_t samples, int threads, const bt_pool* pool,
                                      int64_t* hits);

#endif
