/// Bolter as a library: open a study, change any number in it, land.
///
///     bt_case* c;
///     if (bt_case_open("study.yaml", NULL, 0, on_message, NULL, &c) == BT_OK) {
///         bt_case_set(c, "landing.sink_speed", 4.5);            // SI: m/s
///         bt_landing_report report;
///         if (bt_case_land(c, &report) == BT_OK && report.engaged)
///             printf("caught with %.1f mm to spare\n", 1e3 * report.margin_m);
///         bt_case_close(c);
///     }
///
/// The library never prints, never exits and has no mutable globals. A case belongs to one thread
/// at a time; several cases may run at once. All numbers are SI: m, kg, s, rad, N, Pa.
#ifndef BOLTER_BOLTER_H
#define BOLTER_BOLTER_H

#include "bolter/status.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define BT_PUBLIC __attribute__((visibility("default")))
#else
#define BT_PUBLIC
#endif

/// Receives what is wrong with an input, one message at a time, already with its place
/// ("study.yaml:12:7: error: ..."). The text is valid during the call only.
typedef void bt_message(void* user, const char* text);

/// A study opened for landings. Opaque; release with bt_case_close.
typedef struct bt_case bt_case;

/// Reads and checks a study file.
///
/// @param path       the file, not kept
/// @param sets       [set_count] texts "PATH=VALUE" with units, as --set on the command line; NULL
///                   when set_count is 0; not kept
/// @param message    receives every mistake found; NULL to drop them
/// @param opened     the case on BT_OK, NULL otherwise
/// @return BT_OK; BT_ERR_INPUT (rejected), BT_ERR_IO (unreadable), BT_ERR_MEMORY
BT_PUBLIC BT_CHECKED bt_status bt_case_open(const char* path, const char* const* sets,
                                            int set_count, bt_message* message, void* user,
                                            bt_case** opened);

/// Releases a case; accepts NULL.
BT_PUBLIC void bt_case_close(bt_case* opened);

/// Any numeric key of the model by its path ("aircraft.hook.profile.lip_height"), in SI.
/// BT_ERR_ARG: no such key, not a number, or a value outside its range (nothing is changed).
BT_PUBLIC BT_CHECKED bt_status bt_case_set(bt_case* opened, const char* path, double value);
BT_PUBLIC BT_CHECKED bt_status bt_case_get(const bt_case* opened, const char* path,
                                           double* value);

/// What became of a landing.
typedef struct bt_landing_report {
    bool failed;  ///< the computation diverged: no label. See failure
    bool engaged; ///< the throat caught the cable
    bool retained; ///< and still held it at the end of the run
    char mode[16]; ///< direct, arm, bounced_over, passed_over, ridden_over, none
    double margin_m; ///< cable centre above lip centre when they meet; positive when caught
    double throat_force_peak_N, hook_deck_force_peak_N, cable_tension_peak_N;
    int bounces;
    double first_bounce_height_m, first_bounce_distance_m; ///< 0 without a bounce
    double strut_stroke_max_m[3], tyre_force_max_N[3];     ///< nose, left, right
    uint64_t state_hash; ///< equal for bit-equal runs
    char failure[128];   ///< "element: quantity at time", empty unless failed
} bt_landing_report;

/// Runs one landing. A landing that diverges is a result (failed), not an error.
/// BT_ERR_INPUT: the numbers set do not describe an aircraft or cable that can be assembled (the
/// reason went to the message function); BT_ERR_MEMORY.
BT_PUBLIC BT_CHECKED bt_status bt_case_land(bt_case* opened, bt_landing_report* report);

#ifdef __cplusplus
}
#endif

#endif
