/// What a playback holds: shared by those that write it, as the page's data or for ParaView.
#ifndef BT_REPORT_PLAYBACK_RECORD_H
#define BT_REPORT_PLAYBACK_RECORD_H

#include "report/playback.h"
#include "report/playback_events.h"

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
