/// What a simulated case runs on: the model of a landing and the rigs, addressed by one set of
/// paths ("aircraft.hook.length", "landing.pitch", "rigs.nose_drop.sink_speed").
#ifndef BT_CALIBRATION_PARAMETER_SET_H
#define BT_CALIBRATION_PARAMETER_SET_H

#include "base/text.h"
#include "rigs/rigs.h"

typedef struct bt_parameter_set {
    bt_model_params model;
    bt_rigs_params rigs;
} bt_parameter_set;

/// Finds a field of a set by its path. Returns NULL when there is none. *offset is that of the
/// member in bt_parameter_set.
const bt_field* bt_parameter_set_find(const bt_parameter_set* set, const char* path,
                                      size_t* offset);

/// The path of a number nearest to what was typed.
bt_text_nearest bt_parameter_set_nearest(const bt_parameter_set* set, const char* typed);

/// What a simulated case on a parameter set needs of it.
typedef enum bt_parameter_set_part {
    BT_PART_LANDING, ///< the whole model
    BT_PART_NOSE_GEAR,
    BT_PART_MAIN_GEAR,
    BT_PART_HOOK,
} bt_parameter_set_part;

/// Checks a part, and the rigs where it is not a landing; messages as bt_group_check.
BT_CHECKED bt_status bt_parameter_set_check(const bt_parameter_set* set, bt_parameter_set_part part,
                                            bt_diag* diag);

#endif
