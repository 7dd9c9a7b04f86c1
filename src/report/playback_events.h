/// What happened when in a recorded landing, in words. Private to the playback.
#ifndef BT_REPORT_PLAYBACK_EVENTS_H
#define BT_REPORT_PLAYBACK_EVENTS_H

#include "landing/result.h"
#include "report/json.h"

/// Columns of a recorded row.
enum {
    BT_CURVE_LIP, ///< x, y, z
    BT_CURVE_HOOK_HEIGHT = 3,
    BT_CURVE_HOOK_DECK,
    BT_CURVE_CABLE_HEIGHT, ///< height of its centre, in the hook's plane
    BT_CURVE_CABLE_AHEAD,  ///< distance ahead of the lip, there
    BT_CURVE_CABLE_TENSION,
    BT_CURVE_CABLE_HOOK,      ///< x, y, z: force of the cable on the hook
    BT_CURVE_TYRE = 11,       ///< nose, left, right
    BT_CURVE_TYRE_CABLE = 14, ///< nose, left, right
    BT_CURVE_STRUT = 17,      ///< nose, left, right
    BT_CURVE_WHEEL_X = 20,    ///< nose, left, right
    BT_CURVE_WHEEL_Y = 23,    ///< nose, left, right
    BT_CURVE_COUNT = 26
};

typedef struct bt_playback_rows {
    size_t count;
    const double* time_s;
    const float* curve; ///< [count * BT_CURVE_COUNT]
} bt_playback_rows;

/// Member `events`: [{time_s, what}] in the order of time.
void bt_playback_write_events(bt_json* json, const bt_playback_rows* rows,
                              const bt_landing_result* result);

#endif
