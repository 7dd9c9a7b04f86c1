/// Two studies against each other, landing by landing with the same random numbers.
#ifndef BT_PIPELINE_COMPARE_H
#define BT_PIPELINE_COMPARE_H

#include "pipeline/noise.h"
#include "statistics/paired.h"

enum { BT_DIFFERENT_KEYS_MAX = 64, BT_KEY_VALUE_SIZE = 96 };

/// A key with another value in the second study; "" where a study does not have it. In SI.
typedef struct bt_different_key {
    char path[BT_PATH_MAX];
    char first[BT_KEY_VALUE_SIZE], second[BT_KEY_VALUE_SIZE];
} bt_different_key;

typedef struct bt_comparison {
    bt_paired pairs;   ///< landings by their two outcomes
    int64_t failed;    ///< pairs left out because a landing of them failed
    double engaged[2]; ///< shares
    bt_interval engaged_ci95[2];
    bt_paired_difference difference; ///< of the second less the first
    int key_count;                   ///< may be more than are kept
    bt_different_key key[BT_DIFFERENT_KEYS_MAX];
} bt_comparison;

typedef struct bt_compare_stage {
    const bt_study *first, *second;
    int64_t count; ///< pairs
    const atomic_int* stop;
    const bt_backend* backend; ///< NULL: threads of this process
} bt_compare_stage;

/// Draws `count` landings of each study from its distributions at the same uniform numbers, keyed
/// by the seed of the first: what both have in common moves both landings of a pair alike, and the
/// difference shows with far fewer landings than two separate numbers. Where the random inputs
/// differ (a warning in diag) they share numbers only as far as their lists agree; the interval
/// holds as well.
///
/// @return BT_OK; BT_ERR_FAILED_RUNS (more than campaign.max_failed of either study, said in diag);
///         what bt_noise_run returns
BT_CHECKED bt_status bt_stage_compare(const bt_compare_stage* stage, bt_comparison* comparison,
                                      bt_diag* diag);

#endif
