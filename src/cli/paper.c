#include "report/paper.h"
#include "cli/cli.h"
#include "cli/output.h"

#include <stdio.h>

static bt_status show(const bt_command* command, const bt_report_table* table, bt_diag* diag) {
    BT_TRY(bt_output_table(command, table, diag));
    if (!command->json)
        return bt_report_table_print(table, stdout);
    bt_json json = {.out = stdout};
    bt_json_begin_object(&json, NULL);
    const bt_status status = bt_report_table_json(table, &json, "rows");
    bt_json_end_object(&json);
    return status;
}

static bt_status run_paper(const bt_command* command) {
    bt_diag diag = bt_stderr_diag();
    bt_report_table* table = NULL;
    bt_study study;
    BT_TRY(bt_command_study(command, &study));
    bt_status status = bt_paper_table(&study, &bt_interrupted, &table, &diag);
    if (status == BT_OK)
        status = show(command, table, &diag);
    bt_report_table_destroy(table);
    bt_study_destroy(&study);
    return status;
}

const bt_verb bt_verb_paper = {
    .name = "paper",
    .summary = "each number and sentence of the paper beside this study's",
    .arguments = "STUDY.yaml",
    .text = "Compares the study with Peng et al. 2023 row by row: what the paper says, what this "
            "study gives, the difference, whether they agree, and why, or what the comparison "
            "cannot show. Bounces and rigs are computed; reliability and the classifier are taken "
            "from the study directory.\n\n"
            "  bolter paper study.yaml -o paper.csv     the same as a table",
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_TABLE | BT_OUTPUT_DIRECTORY,
    .run = run_paper,
};
