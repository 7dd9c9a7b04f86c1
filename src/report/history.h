/// Time histories of one landing, written as HDF5 for Python, MATLAB and the figures, or as CSV.
///
/// CSV: a comment line, then a header "time [s],hook_angle [rad],..." of the columns of the view
/// (landing/view.h), then a row per airframe step.
///
/// HDF5 datasets, rows in time: those of the table in landing/view.h, in groups: time_s [n];
/// hook/..., airframe/..., contact/... and legs/... (columns nose, left, right);
/// bodies/NAME/{position_m [n, 3], attitude [n, 4] (Euler parameters), velocity_mps [n, 3],
/// spin_radps [n, 3] (body axes)}; cable/time_s [k] and cable/{x_m, y_m, z_m} [k, segments],
/// cable/tension_N [k, segments - 1]. Each dataset has the attributes `unit` and `meaning`; the
/// file has `outcome`, `mode`, `title`; dataset study is the text of the study.
#ifndef BT_REPORT_HISTORY_H
#define BT_REPORT_HISTORY_H

#include "landing/view.h"
#include "study/study.h"

typedef struct bt_history bt_history;

/// An empty history. BT_ERR_MEMORY.
BT_CHECKED bt_status bt_history_create(bt_history** history);
void bt_history_destroy(bt_history* history); ///< accepts NULL

/// The observer to hand to bt_lander_run, with the history as `user`. Keeps every airframe step;
/// the cable's shape at most once a millisecond, and at the end.
void bt_history_observe(void* user, const bt_landing_view* view);

/// Writes CSV where the path ends in .csv, else HDF5. Writes everything under a temporary name,
/// then renames: what was there before stays until the new file is complete. BT_ERR_IO (said in
/// diag), BT_ERR_MEMORY (also when memory ran out while observing).
BT_CHECKED bt_status bt_history_write(const bt_history* history, const char* path,
                                      const bt_study* study, const bt_landing_result* result,
                                      bt_diag* diag);

#endif
