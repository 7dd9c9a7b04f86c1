/// The hook's head on the deck  [Peng2023 Eq. 10]: Hertz contact at the lowest point of the head,
/// which rolls along the shoe arc as the shank turns.
#ifndef BT_LANDING_SHOE_H
#define BT_LANDING_SHOE_H

#include "elements/impact.h"
#include "landing/profile.h"
#include "mechanics/system.h"

typedef struct bt_shoe {
    bt_impact impact;
    double shoe_m[3]; ///< centre of the shoe arc, body frame
    double shoe_radius_m, lip_radius_m;
    double lip_m[3]; ///< centre of the lip, body frame
} bt_shoe;

enum { BT_SHOE_HEIGHT, BT_SHOE_RATE, BT_SHOE_FORCE, BT_SHOE_X, BT_SHOE_OUTPUTS };

/// Outputs: height of the lowest point above the deck (m), vertical velocity of the material point
/// there (m/s), normal force (N), x of the lowest point (m).
/// Law: left where the shoe is pressed in by more than its own radius ("shoe below the
/// deck"), which Hertz' theory of small contacts does not describe.
/// body_a: the hook. data: bt_shoe.
extern const bt_element_type bt_shoe_type;

/// Lowest point of the head, world frame: of the shoe arc, or of the lip where that is lower.
void bt_shoe_lowest(const bt_shoe* shoe, const bt_motion* motion, int hook, double lowest_m[3]);

#endif
