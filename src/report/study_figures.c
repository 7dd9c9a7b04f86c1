#include "report/study_figures.h"

#include "report/reliability_figure.h"
#include "report/rig_report.h"
#include "report/sweep_report.h"

static bt_status draw_rig(const bt_study* study, const bt_rig_test* test, const char* folder,
                          bt_diag* diag) {
    return bt_rig_draw(study, &test->record, &test->curves, folder, diag);
}

static bt_status draw_sweep(const bt_study* study, const bt_sweep_plan* plan, const bt_sweep* sweep,
                            const char* folder, bt_diag* diag) {
    return bt_sweep_draw(study, plan, sweep, folder, NULL, diag);
}

const bt_figure_writers bt_study_figures = {
    .rig = draw_rig, .sweep = draw_sweep, .reliability = bt_reliability_draw};
