/// The atlas of misses: where in the inputs the hook misses, how, and what share of 1 - R each kind
/// has.
///
/// Misses of one mode, those in the first bounce of the hook apart from those after it, are sorted
/// along the input whose distribution among them differs most from that among all landings (largest
/// distance of the two distribution functions), and cut where a part of its range holds few of
/// them. This sorts and shows; it proves nothing.
#ifndef BT_PIPELINE_ATLAS_H
#define BT_PIPELINE_ATLAS_H

#include "pipeline/landings.h"
#include "statistics/intervals.h"

enum { BT_MISS_GROUP_MAX = 24 };

/// Misses of one mode in one part of the inputs' range.
typedef struct bt_miss_group {
    bt_mode mode;
    bool bounced;           ///< the hook had ended its first bounce
    int axis;               ///< whose range tells them best from all landings
    double least, greatest; ///< of that input: the middle nine tenths of the group's weight, SI
    int count;              ///< landings in it
    int typical;            ///< index of its medoid: the least weighted sum of distances to the
                            ///< others, every input measured by its standard deviation
    double probability;     ///< of such a miss, sum of the weights over the landings
    bt_interval ci95;       ///< of the probability (statistics/weighted.h)
    double share;           ///< of the probability of any miss
} bt_miss_group;

typedef struct bt_atlas {
    int count;
    bt_miss_group group[BT_MISS_GROUP_MAX]; ///< the most probable first
    double missed;                          ///< 1 - R, from the landings alone
    bt_interval missed_ci95;
} bt_atlas;

/// Sorts the misses. Landings without weights (bt_landings.weighted) count alike: probabilities are
/// then shares of the design's landings. Failed runs count as neither. BT_ERR_MEMORY.
BT_CHECKED bt_status bt_atlas_make(const bt_landings* landings, bt_atlas* atlas);

#endif
