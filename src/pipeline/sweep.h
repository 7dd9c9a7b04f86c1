/// Parameter studies: one key over several values, one landing each  [Peng2023 Sec. 4].
#ifndef BT_PIPELINE_SWEEP_H
#define BT_PIPELINE_SWEEP_H

#include "study/study.h"

enum { BT_SWEEP_VALUES_MAX = 64 };

/// The way of the lowest point of the hook's head from its first contact with the deck on.
typedef struct bt_hook_path {
    int count, room;
    double* travelled_m; ///< [count] along the deck from where it first touched, rising
    double* height_m;    ///< [count] above the deck
} bt_hook_path;

typedef struct bt_sweep_row {
    double value; ///< value of the key, SI
    bt_landing_result result;
    bt_hook_path path;
} bt_sweep_row;

typedef struct bt_sweep {
    const bt_field* field; ///< row of the key
    int count;
    bt_sweep_row* rows; ///< [count] in the order of the values
} bt_sweep;

/// Finds a numeric key of the model ("landing.sink_speed"). BT_ERR_INPUT, said in diag with the
/// nearest key.
BT_CHECKED bt_status bt_sweep_find(const bt_model_params* model, const char* key,
                                   const bt_field** field, size_t* offset, bt_diag* diag);

/// Reads "3.6 m/s, 4 m/s, 5 m/s": at most BT_SWEEP_VALUES_MAX values of a field, each with its
/// unit and inside its range. BT_ERR_INPUT, said in diag.
BT_CHECKED bt_status bt_sweep_values(const bt_field* field, const char* key, const char* text,
                                     double* values, int* count, bt_diag* diag);

/// Runs one landing per value of the key, the rest as in `model` (which must be checked). The rows
/// do not depend on the number of threads (0: one per core). A run that diverges, and a value with
/// which there can be no landing, is a row whose outcome is BT_FAILED. On BT_OK the caller owns the
/// sweep (bt_sweep_destroy). `stop` may be NULL; see bt_executor. BT_ERR_INPUT: no such key, said
/// in diag; BT_ERR_INTERRUPTED, BT_ERR_MEMORY.
BT_CHECKED bt_status bt_sweep_run(const bt_model_params* model, const char* key,
                                  const double* values, int count, int threads,
                                  const atomic_int* stop, bt_sweep* sweep, bt_diag* diag);
void bt_sweep_destroy(bt_sweep* sweep);

/// The first bounce of a landing; NAN when there was none, or the run ended in the air.
bt_bounce bt_first_bounce(const bt_landing_result* result);

/// A sweep as it is typed, and what the paper says of it.
typedef struct bt_sweep_plan {
    char name[160];         ///< of its figure: "fig14"
    const char* key;        ///< "landing.sink_speed"
    const char* values;     ///< "3.6 m/s, 4 m/s"
    const char* title;      ///< NULL: none
    const char* paper;      ///< number of the paper's figure
    const char* said;       ///< what the paper prints; NULL: nothing
    const char* said_label; ///< in the figure
    double said_height_m, said_distance_m;
} bt_sweep_plan;

/// The paper's three: Figs. 14 to 16.
enum { BT_PAPER_SWEEPS = 3 };
extern const bt_sweep_plan bt_paper_sweeps[BT_PAPER_SWEEPS];

/// A plan of one's own; the texts stay the caller's.
bt_sweep_plan bt_sweep_plan_of(const char* key, const char* values);

/// Runs a plan on a study's landing, the cable at least BT_CLEAR_DISTANCE_M away (unless the
/// distance itself is the key), so that the hook bounces undisturbed. See bt_sweep_run.
BT_CHECKED bt_status bt_stage_sweep(const bt_study* study, const bt_sweep_plan* plan,
                                    const atomic_int* stop, bt_sweep* sweep, bt_diag* diag);

#endif
