/// Touchdown zones: the stretches of deck that the wires divide it into. A landing's zone is where
/// landing.distance puts the part that it is measured from, at first contact.
#ifndef BT_RELIABILITY_ZONE_H
#define BT_RELIABILITY_ZONE_H

#include "study/study.h"

enum { BT_ZONE_MAX = BT_WIRE_MAX + 1 };

/// Zone k lies beyond wire k and before wire k + 1 (wires from 1): the wires k + 1, ... are ahead.
typedef struct bt_zones {
    int count; ///< wires + 1; 0: a deck of one wire, or the distance is not random
    int input; ///< landing.distance among the study's inputs
    double nearest_m[BT_ZONE_MAX]; ///< least distance of zone k, to the wire of distance_to;
                                   ///< -INFINITY beyond the last wire
    double share[BT_ZONE_MAX];     ///< probability that a landing touches down in it; sum 1
} bt_zones;

/// The zones of a study as it stands.
bt_zones bt_zones_of(const bt_study* study);

/// The zone of a landing with this distance.
int bt_zones_find(const bt_zones* zones, double distance_m);

#endif
