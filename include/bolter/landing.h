/// Landings of a case.
#ifndef BOLTER_LANDING_H
#define BOLTER_LANDING_H

#include "bolter/study.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What became of a landing: the quantities most asked for; every other one by its name
/// (bt_case_result). Set size to sizeof(bt_landing_report) before the call.
typedef struct bt_landing_report {
    size_t size;
    bool failed;     ///< the computation diverged: no label. See failure
    bool engaged;    ///< the throat caught the cable
    bool retained;   ///< and still held it at the end of the run
    char mode[16];   ///< direct, arm, bounced_over, passed_over, ridden_over, ..., none
    double margin_m; ///< cable centre above lip centre when they meet; positive when caught; NAN
                     ///< without a meeting
    /// Loads of the hook on the deck are not calibrated (docs/theory/shank.md); loads after a catch
    /// hold for 50 ms, since no arresting engine pays out.
    double throat_force_peak_N, hook_deck_force_peak_N, cable_tension_max_N;
    int bounces;
    double first_bounce_height_m, first_bounce_distance_m; ///< 0 without a bounce
    double strut_stroke_max_m[3], tyre_force_max_N[3];     ///< nose, left, right
    uint64_t state_hash;                                   ///< equal for bit-equal runs
    char failure[320]; ///< "element: quantity at time", empty unless failed
    char remarks[512]; ///< states at the edge of what the model describes: "strut_bottomed left
                       ///< 0.125; ..." (what, element, time in s); empty without one
} bt_landing_report;

/// Runs one landing. A landing that diverges is a result (failed), not an error.
/// BT_ERR_ARG (no size); BT_ERR_INPUT: the numbers set do not describe an aircraft or cable that
/// can be assembled (the reason went to the message function); BT_ERR_MEMORY.
BT_PUBLIC BT_CHECKED bt_status bt_case_land(bt_case* opened, bt_landing_report* report);

/// One quantity of a landing, as `bolter keys --results` lists them. The texts are static.
typedef struct bt_result_info {
    const char* name; ///< column of the ledger and of a CSV file: "strut_stroke_max_left_m"
    const char* unit; ///< SI, as written; "" where there is none
    const char* text; ///< meaning
} bt_result_info;

/// Calls visit for every quantity until it returns false.
typedef bool bt_result_visit(void* user, const bt_result_info* info);
BT_PUBLIC void bt_results(bt_result_visit* visit, void* user);

/// A number of the last landing of bt_case_land by its name; flags are 0 or 1; NAN where there is
/// none. BT_ERR_ARG: no such number, or no landing yet.
BT_PUBLIC BT_CHECKED bt_status bt_case_result(const bt_case* opened, const char* name,
                                              double* value);

#ifdef __cplusplus
}
#endif

#endif
