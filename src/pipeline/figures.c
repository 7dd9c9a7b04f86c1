#include "pipeline/figures.h"

#include "base/directory.h"

static bt_status draw_rig(const bt_study* study, bt_rig_kind kind, const bt_figure_writers* draw,
                          const char* folder, bt_diag* diag) {
    bt_rig_test test;
    bt_status status = bt_stage_rig(study, kind, &test, diag);
    if (status != BT_OK)
        return status == BT_ERR_FAILED_RUNS ? BT_OK : status;
    status = draw->rig(study, &test, folder, diag);
    bt_rig_test_destroy(&test);
    return status;
}

static bt_status draw_sweep(const bt_study* study, const bt_sweep_plan* plan,
                            const bt_figure_writers* draw, const atomic_int* stop,
                            const char* folder, bt_diag* diag) {
    bt_sweep sweep;
    BT_TRY(bt_stage_sweep(study, plan, stop, &sweep, diag));
    const bt_status status = draw->sweep(study, plan, &sweep, folder, diag);
    bt_sweep_destroy(&sweep);
    return status;
}

static bt_status draw_all(const bt_study* study, const bt_figure_writers* draw,
                          const atomic_int* stop, const char* folder, bt_diag* diag) {
    for (int kind = 0; kind < BT_RIG_COUNT; ++kind)
        if (study->rig_inputs[kind].given)
            BT_TRY(draw_rig(study, (bt_rig_kind)kind, draw, folder, diag));
    for (int i = 0; i < BT_PAPER_SWEEPS; ++i)
        BT_TRY(draw_sweep(study, &bt_paper_sweeps[i], draw, stop, folder, diag));
    return draw->reliability(study, folder, diag);
}

bt_status bt_stage_figures(const bt_study* study, const bt_figure_writers* draw,
                           const atomic_int* stop, bt_diag* diag) {
    char folder[BT_FILE_PATH_MAX];
    bt_directory directory;
    BT_TRY(bt_file_path(folder, study->directory, "figures"));
    BT_TRY(bt_directory_open(&directory, study->directory, diag));
    const bt_status status = draw_all(study, draw, stop, folder, diag);
    bt_directory_close(&directory);
    return status;
}
