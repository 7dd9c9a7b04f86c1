#include "base/directory.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "report/reliability_figure.h"
#include "report/rig_report.h"

#include <stdio.h>

bt_status bt_reliability_figures(const bt_study* study, bt_diag* diag) {
    char folder[BT_FILE_PATH_MAX];
    BT_TRY(bt_file_path(folder, study->directory, "figures"));
    return bt_reliability_draw(study, folder, diag);
}

/// A rig that diverges says so and has no figures.
static bt_status draw_rig(const bt_study* study, bt_rig_kind kind, const char* folder,
                          bt_diag* diag) {
    bt_rig_curves curves;
    bt_rig_record record;
    bt_rig_result result;
    BT_TRY(bt_rig_curves_read(study, kind, &curves, diag));
    bt_rig_record_start(&record, kind);
    bt_status status = bt_rig_run(kind, &study->model.aircraft, &study->rigs, &result,
                                  bt_rig_record_observe, &record, diag);
    if (status == BT_OK)
        status = bt_rig_draw(study, &record, &curves, folder, diag);
    bt_rig_record_destroy(&record);
    bt_rig_curves_destroy(&curves);
    return status == BT_ERR_NUMERIC ? BT_OK : status;
}

static bt_status draw_all(const bt_study* study, const char* folder, bt_diag* diag) {
    for (int kind = 0; kind < BT_RIG_COUNT; ++kind)
        if (study->rig_inputs[kind].given)
            BT_TRY(draw_rig(study, (bt_rig_kind)kind, folder, diag));
    BT_TRY(bt_sweep_figures(study, folder, diag));
    return bt_reliability_draw(study, folder, diag);
}

static bt_status draw_into(const bt_study* study, bt_diag* diag) {
    char folder[BT_FILE_PATH_MAX];
    bt_directory directory;
    BT_TRY(bt_file_path(folder, study->directory, "figures"));
    BT_TRY(bt_directory_open(&directory, study->directory, diag));
    const bt_status status = draw_all(study, folder, diag);
    bt_directory_close(&directory);
    if (status == BT_OK)
        printf("figures: %s\n", folder);
    return status;
}

static bt_status run_figures(const bt_command* command) {
    bt_diag diag = bt_stderr_diag();
    bt_study study;
    BT_TRY(bt_command_study(command, &study));
    const bt_status status = draw_into(&study, &diag);
    bt_study_destroy(&study);
    return status;
}

const bt_verb bt_verb_figures = {
    .name = "figures",
    .summary = "every figure of the paper that the study can give, for print and screen",
    .arguments = "STUDY.yaml",
    .text = "Draws the rigs (Figs. 9 to 12), the bounces of the hook (Figs. 14 to 16) and, from "
            "the reliability table of the study directory, reliability by condition (Figs. 19 to "
            "22) into STUDY/figures: each as PDF for two columns and for one (NAME-column.pdf), "
            "SVG and PNG, with its data (NAME.csv) and the script that draws it (NAME.gp). Titles "
            "are the study's; gnuplot draws.",
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_DIRECTORY,
    .run = run_figures,
};
