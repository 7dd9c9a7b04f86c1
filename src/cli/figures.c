#include "base/directory.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "report/study_figures.h"

#include <stdio.h>

static bt_status run_figures(const bt_command* command) {
    bt_diag diag = bt_stderr_diag();
    bt_study study;
    BT_TRY(bt_command_study(command, &study));
    const bt_status status = bt_stage_figures(&study, &bt_study_figures, &bt_interrupted, &diag);
    if (status == BT_OK)
        printf("figures: %s/figures\n", study.directory);
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
