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
    char mode[16];   ///< caught: direct, arm; missed: bounced_over, passed_over, ridden_over,
                     ///< passed_beside (beyond the end of the cable), stopped (at rest before
                     ///< it); failed: none
    double margin_m; ///< cable centre above lip centre when they meet; positive when caught; NAN
                     ///< without a meeting: passed_beside, stopped, failed
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

/// One line of the time histories: the columns that `bolter land -o x.csv` writes, and the cable.
/// Arrays and names are valid during the call only.
typedef struct bt_landing_line {
    double time_s; ///< since the first contact of any part with the deck
    int count;
    const char* const* names; ///< [count] with their units: "hook_height_m", "nose_stroke_m"
    const double* values;     ///< [count] SI
    int cable_count;          ///< segments of the cable
    const double *cable_x_m, *cable_y_m, *cable_z_m; ///< [cable_count] their centres
    const double* cable_tension_N;                   ///< [cable_count - 1] between neighbours
} bt_landing_line;

/// Called at the start, after every airframe step, and at the end.
typedef void bt_landing_watch(void* user, const bt_landing_line* line);

/// What else to do. Set size to sizeof(bt_landing_def); what is zero is the default.
typedef struct bt_landing_def {
    size_t size;
    bt_landing_watch* watch; ///< may be NULL
    void* user;
} bt_landing_def;

/// bt_case_land with a watcher; the landing keeps its bits. Errors as bt_case_land.
BT_PUBLIC BT_CHECKED bt_status bt_case_land_watched(bt_case* opened, const bt_landing_def* def,
                                                    bt_landing_report* report);

/// A landing in one's own hands: stepped, looked at, copied, compared. Opaque.
typedef struct bt_flight bt_flight;

/// The landing of a case as the case is now, at its start; later changes of the case do not touch
/// it, and it may outlive the case. Flights of one thread at a time each; copies may go to others.
/// Errors as bt_case_land.
BT_PUBLIC BT_CHECKED bt_status bt_flight_create(const bt_case* opened, bt_flight** created);
BT_PUBLIC void bt_flight_destroy(bt_flight* flight); ///< accepts NULL

/// One step of the airframe, with the cable's own steps in it. False once the landing is over:
/// caught and held a little, past the wire, at rest, or failed; then nothing moves any more.
BT_PUBLIC bool bt_flight_step(bt_flight* flight);

/// Shows the present state to a watcher, once.
BT_PUBLIC void bt_flight_look(bt_flight* flight, bt_landing_watch* watch, void* user);

/// A flight of its own in the same state: to try what happens from here on. BT_ERR_MEMORY.
BT_PUBLIC BT_CHECKED bt_status bt_flight_copy(const bt_flight* flight, bt_flight** copy);

/// Whether a flight and its copy are equal to the bit in what decides how they go on.
BT_PUBLIC bool bt_flight_equal(const bt_flight* a, const bt_flight* b);

/// What has become of it so far, over or not. BT_ERR_ARG: no size.
BT_PUBLIC BT_CHECKED bt_status bt_flight_report(const bt_flight* flight, bt_landing_report* report);

/// One quantity of a landing, as `bolter keys --results` lists them. The texts are static.
typedef struct bt_result_info {
    const char* name; ///< column of the ledger and of a CSV file: "strut_stroke_max_left_m"
    const char* unit; ///< SI, as written; "" where there is none
    const char* text; ///< meaning
} bt_result_info;

/// Calls visit for every quantity until it returns false.
typedef bool bt_result_visit(void* user, const bt_result_info* info);
BT_PUBLIC void bt_results(bt_result_visit* visit, void* user);

/// A number of the last landing of bt_case_land by its name. Flags are 0 or 1; outcome is 1
/// engaged, 0 missed, NAN failed; mode is a place in bt_mode_label; NAN where there is none.
/// BT_ERR_ARG: no such number, or no landing yet.
BT_PUBLIC BT_CHECKED bt_status bt_case_result(const bt_case* opened, const char* name,
                                              double* value);

/// The name of a mode by its number ("ridden_over"); NULL beyond the last. Static.
BT_PUBLIC const char* bt_mode_label(int mode);

/// Called a few times a second on the thread of the call with the landings that are done; false:
/// no more begin, and the call returns BT_ERR_INTERRUPTED.
typedef bool bt_batch_progressed(void* user, int64_t done, int64_t count);

/// A table of landings. Set size to sizeof(bt_batch_def); arrays belong to the caller.
typedef struct bt_batch_def {
    size_t size;
    int path_count;
    const char* const* paths; ///< [path_count] numeric keys of the model, each once
    int64_t count;
    const double* points; ///< [count * path_count] row-major, SI
    int column_count;
    const char* const* columns; ///< [column_count] names of results, as bt_case_result takes them
    int threads;                ///< 0: one per core that the process may use
    bt_batch_progressed* progress; ///< may be NULL
    void* user;
} bt_batch_def;

/// Runs one landing per row of points on all cores; other keys are the case's. The same values for
/// any number of threads. Rows that cannot be landed (a value outside what the model allows, a
/// landing that diverges) are failed ones, not errors.
///
/// @param values  [count * column_count] row-major: receives the results; NAN where there is none,
///                and in rows that were not run when the call was stopped
/// @return BT_OK; BT_ERR_ARG (an unknown path or column, said; no size); BT_ERR_INPUT (the model of
///         the case has a fault of its own, said); BT_ERR_INTERRUPTED, BT_ERR_MEMORY
BT_PUBLIC BT_CHECKED bt_status bt_case_land_batch(bt_case* opened, const bt_batch_def* def,
                                                  double* values);

#ifdef __cplusplus
}
#endif

#endif
