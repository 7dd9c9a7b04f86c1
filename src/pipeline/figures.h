/// Every figure of the paper that a study can give, into STUDY/figures: one call.
#ifndef BT_PIPELINE_FIGURES_H
#define BT_PIPELINE_FIGURES_H

#include "pipeline/rig_stage.h"
#include "pipeline/sweep.h"

/// Who draws what a stage computed, into a folder. `report/study_figures.h` has gnuplot's.
typedef struct bt_figure_writers {
    bt_status (*rig)(const bt_study* study, const bt_rig_test* test, const char* folder,
                     bt_diag* diag);
    bt_status (*sweep)(const bt_study* study, const bt_sweep_plan* plan, const bt_sweep* sweep,
                       const char* folder, bt_diag* diag);
    bt_status (*reliability)(const bt_study* study, const char* folder, bt_diag* diag);
} bt_figure_writers;

/// Runs the rigs that the study describes (Figs. 9-12; one that diverges says so and has no
/// figures) and the paper's sweeps (Figs. 14-16), and draws them and the reliability table of the
/// study directory, where there is one (Figs. 19-22).
///
/// @param stop  may be NULL; once not 0: BT_ERR_INTERRUPTED
/// @return BT_OK, or what reading curves, running, drawing and opening the directory return
BT_CHECKED bt_status bt_stage_figures(const bt_study* study, const bt_figure_writers* draw,
                                      const atomic_int* stop, bt_diag* diag);

#endif
