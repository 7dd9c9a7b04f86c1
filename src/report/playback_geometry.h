/// Shapes of the model's parts for the page, from the model's own numbers.
#ifndef BT_REPORT_PLAYBACK_GEOMETRY_H
#define BT_REPORT_PLAYBACK_GEOMETRY_H

#include "landing/airframe.h"
#include "landing/params.h"
#include "report/json.h"

enum { BT_OUTLINE_MAX = 128 };

/// The head's outline, counterclockwise from the back of the shoe, cut off up the arm.
/// @param reach_m  where the arm is cut, from the centre of the shoe arc
/// @return number of points
int bt_hook_outline(const bt_profile* profile, double reach_m, double outline[BT_OUTLINE_MAX][2]);

/// The aircraft's body as a tube along x, in the fuselage's frame: a sketch of its size, from the
/// stations of gear and hook.
typedef struct bt_fuselage_sketch {
    double nose_m, tail_m, radius_m;
    double height_m; ///< height of the tube's axis: the hook's pivot lies at its underside
} bt_fuselage_sketch;

bt_fuselage_sketch bt_fuselage_of(const bt_airframe* airframe);

/// Members of the present object: fuselage, pistons, wheels, hook, deck. The fuselage's solid is a
/// sketch of the aircraft's size; legs, wheels, hook and deck have the model's dimensions.
void bt_geometry_write(bt_json* json, const bt_airframe* airframe, const bt_model_params* model);

#endif
