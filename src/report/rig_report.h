/// What a rig found, beside what was measured.
#ifndef BT_REPORT_RIG_REPORT_H
#define BT_REPORT_RIG_REPORT_H

#include "pipeline/rig_stage.h"
#include "report/json.h"
#include "report/table.h"

/// How far the record lies from a curve over time, or over another column that grows all the time:
/// root mean square of the difference where both exist, SI, and its share of the largest measured
/// value. NAN where the record has no single value for what the curve lies over.
void bt_rig_curve_error(const bt_rig_record* record, const bt_measured* measured, double* rms,
                        double* share);

/// As the paper's Tables 1-3: metric, value, unit, reference, error, what is accepted. A static
/// rig's measured curves follow point by point in the same columns; remarks below. To be destroyed
/// by the caller; NULL when out of memory (see report/table.h).
/// @param tolerance  error that is accepted of each point of a static rig's curves, as a share
bt_report_table* bt_rig_table(const bt_rig_result* result, const bt_rig_record* record,
                              const bt_rig_curves* curves, double tolerance);

/// Members of the present object: `metrics` by name, `curves` (a static rig's with their `points`),
/// `load_over_stroke` where it was measured, `steps`, `end_time_s`.
void bt_rig_write_json(bt_json* json, const bt_rig_result* result, const bt_rig_record* record,
                       const bt_rig_curves* curves, double tolerance);

/// The tolerance of a rig's curves point by point: a static rig's; 0 for the others, whose curves
/// are judged as a whole.
double bt_rig_point_tolerance(bt_rig_kind kind, const bt_rigs_params* rigs);

/// The rig's figures (Figs. 9-12: stroke and sinkage, compression and load of the tyre; height and
/// load of the hook) with the measured curves as points; one more for each curve that fits none.
/// They bear the study's title, and the paper's number only in the reference study.
BT_CHECKED bt_status bt_rig_draw(const bt_study* study, const bt_rig_record* record,
                                 const bt_rig_curves* curves, const char* folder, bt_diag* diag);

#endif
