/// Load of a strut over its stroke, measured and computed: two loops, and how far apart they are.
#ifndef BT_REPORT_RIG_LOOP_H
#define BT_REPORT_RIG_LOOP_H

#include "rigs/record.h"
#include "study/measured.h"

/// One loop. The work on the way in is W = integral of F ds until the largest stroke.
typedef struct bt_loop {
    double stroke_max_m, force_max_N, energy_J; ///< until the largest stroke
    double efficiency;                          ///< W / (F_max s_max), force until the same point
} bt_loop;

typedef struct bt_loop_score {
    bt_loop measured, computed;
    /// Area between the loops, way in and way out, over the measured work on the way in. Where one
    /// loop goes further, the whole of its load counts.
    double area_share;
} bt_loop_score;

/// Compares the strut load over stroke of a drop with measured curves: either one curve of load
/// over stroke, or load and stroke over the same times of one file. False: there is no such curve,
/// or memory ran out.
///
/// Tests: test_measured.c (equal loops, one scaled by a factor).
bool bt_rig_loop_score(const bt_rig_record* record, bt_measured* const* measured, int count,
                       bt_loop_score* score);

#endif
