/// Landings of a case.
#ifndef BOLTER_LANDING_H
#define BOLTER_LANDING_H

#include "bolter/study.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What became of a landing.
typedef struct bt_landing_report {
    bool failed;     ///< the computation diverged: no label. See failure
    bool engaged;    ///< the throat caught the cable
    bool retained;   ///< and still held it at the end of the run
    char mode[16];   ///< direct, arm, bounced_over, passed_over, ridden_over, none
    double margin_m; ///< cable centre above lip centre when they meet; positive when caught
    /// Loads of the hook on the deck are not calibrated (docs/theory/shank.md); loads after a catch
    /// hold for 50 ms, since no arresting engine pays out.
    double throat_force_peak_N, hook_deck_force_peak_N, cable_tension_peak_N;
    int bounces;
    double first_bounce_height_m, first_bounce_distance_m; ///< 0 without a bounce
    double strut_stroke_max_m[3], tyre_force_max_N[3];     ///< nose, left, right
    uint64_t state_hash;                                   ///< equal for bit-equal runs
    char failure[128]; ///< "element: quantity at time", empty unless failed
} bt_landing_report;

/// Runs one landing. A landing that diverges is a result (failed), not an error.
/// BT_ERR_INPUT: the numbers set do not describe an aircraft or cable that can be assembled (the
/// reason went to the message function); BT_ERR_MEMORY.
BT_PUBLIC BT_CHECKED bt_status bt_case_land(bt_case* opened, bt_landing_report* report);

#ifdef __cplusplus
}
#endif

#endif
