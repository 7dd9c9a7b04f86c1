#include "base/directory.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "cli/version.h"
#include "report/page.h"

#include <stdio.h>

bt_status bt_command_report(const bt_command* command, const bt_study* study, const char* path) {
    bt_diag diag = bt_stderr_diag();
    const bt_page_subject subject = {study, command->words[0], bt_version_build(), &bt_interrupted};
    return bt_page_report(&subject, path, &diag);
}

/// FILE.html of -o, else report.html in the study directory (that of -o).
static bt_status page_path(const bt_command* command, const bt_study* study, char* path) {
    bt_diag diag = bt_stderr_diag();
    if (bt_output_kind(command->output) == BT_OUTPUT_PAGE)
        return bt_output_path(command, "report.html", path, &diag);
    BT_TRY(bt_directory_make(study->directory, &diag));
    return bt_file_path(path, study->directory, "report.html");
}

static bt_status run_report(const bt_command* command) {
    char path[BT_FILE_PATH_MAX];
    bt_study study;
    BT_TRY(bt_command_study(command, &study));
    bt_status status = page_path(command, &study, path);
    if (status == BT_OK)
        status = bt_command_report(command, &study, path);
    if (status == BT_OK)
        printf("%s\n", path);
    bt_study_destroy(&study);
    return status;
}

const bt_verb bt_verb_report = {
    .name = "report",
    .summary = "one page that shows the study: STUDY/report.html",
    .arguments = "STUDY.yaml",
    .text = "Writes one HTML file that opens from disk in any browser, offline: the answer, "
            "reliability by condition, where landings miss, ten landings to play in three "
            "dimensions, sensitivity, bounces of the hook, rigs beside their references, the "
            "classifier, and the study's numbers with their sources; from whatever the study "
            "directory holds. The ledger is only read.\n\n"
            "  bolter report study.yaml\n"
            "  bolter report study.yaml -o report.html",
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_PAGE | BT_OUTPUT_DIRECTORY,
    .run = run_report,
};
