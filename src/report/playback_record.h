/// What a playback holds: shared by those that write it, as the page's data or for ParaView.
#ifndef BT_REPORT_PLAYBACK_RECORD_H
#define BT_REPORT_PLAYBACK_RECORD_H

#include "report/playback.h"

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

enum { BT_PLAYBACK_Q = 7 * BT_BODY_COUNT };

/// Every step of the landing; which of them are written is chosen when it is over.
struct bt_playback {
    int rows_most, nodes_most;
    size_t count, room;
    double* time_s;
    float* q;                                 ///< [count * BT_PLAYBACK_Q]
    float* cable;                             ///< [count * 3 * nodes] x y z
    float* tension;                           ///< [count * nodes]
    float* curve;                             ///< [count * BT_CURVE_COUNT]
    int nodes, node[BT_LANDING_SEGMENTS_MAX]; ///< segments that are kept
    double awake_s;                           ///< when the cable first moved; INFINITY: never
    bool out_of_memory;
};

/// The rows to be written, at most rows_most of them, into row [count]; returns how many.
size_t bt_playback_choose_rows(const bt_playback* playback, size_t* row);

#endif
