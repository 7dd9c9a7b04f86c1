#include "base/directory.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "cli/rig_sweep.h"
#include "report/rig_record.h"
#include "report/rig_report.h"

#include <stdio.h>
#include <string.h>

/// "nose-drop" -> BT_RIG_NOSE_DROP; the key's own spelling will do as well.
static bool find_kind(const char* word, bt_rig_kind* kind) {
    for (int k = 0; k < BT_RIG_COUNT; ++k) {
        char name[32];
        snprintf(name, sizeof name, "%s", bt_rig_keys[k]);
        *strchr(name, '_') = '-';
        if (strcmp(word, name) == 0 || strcmp(word, bt_rig_keys[k]) == 0) {
            *kind = (bt_rig_kind)k;
            return true;
        }
    }
    return false;
}

/// Histories where -o says; figures into the study directory unless only a file is wanted.
static bt_status write_files(const bt_command* command, const bt_study* study,
                             const bt_rig_test* test, bt_diag* diag) {
    const bt_rig_record* record = &test->record;
    char folder[BT_FILE_PATH_MAX], path[BT_FILE_PATH_MAX], name[64];
    const int kind = bt_output_kind(command->output);
    if (kind == BT_OUTPUT_HISTORIES)
        return bt_rig_record_write(record, command->output, study, &test->result, diag);
    if (kind == BT_OUTPUT_TABLE)
        return BT_OK; // written when it was shown
    BT_TRY(bt_file_path(folder, study->directory, "figures"));
    BT_TRY(bt_directory_make(folder, diag));
    if (command->output) {
        snprintf(name, sizeof name, "%s.h5", bt_rig_keys[record->kind]);
        BT_TRY(bt_file_path(path, study->directory, name));
        BT_TRY(bt_rig_record_write(record, path, study, &test->result, diag));
    }
    BT_TRY(bt_rig_draw(study, record, &test->curves, folder, diag));
    if (!command->json && !command->quiet)
        printf("figures: %s\n", folder);
    return BT_OK;
}

static void write_json(const bt_study* study, const bt_rig_test* test, double tolerance) {
    bt_json json = {.out = stdout};
    bt_json_begin_object(&json, NULL);
    bt_json_string(&json, "rig", bt_rig_keys[test->record.kind]);
    bt_json_string(&json, "title", study->title);
    bt_rig_write_json(&json, &test->result, &test->record, &test->curves, tolerance);
    bt_json_end_object(&json);
}

/// The table to -o FILE.csv, and to the user.
static bt_status show(const bt_command* command, const bt_study* study, const bt_rig_test* test,
                      bt_diag* diag) {
    const double tolerance = bt_rig_point_tolerance(test->record.kind, &study->rigs);
    bt_report_table* table = bt_rig_table(&test->result, &test->record, &test->curves, tolerance);
    bt_status status = bt_output_table(command, table, diag);
    if (status == BT_OK && command->json)
        write_json(study, test, tolerance);
    else if (status == BT_OK) {
        printf("%s: %s\n", bt_rig_keys[test->record.kind], study->title);
        status = bt_report_table_print(table, stdout);
    }
    bt_report_table_destroy(table);
    return status;
}

static bt_status run_test(const bt_command* command, const bt_study* study, bt_rig_kind kind) {
    bt_diag diag = bt_stderr_diag();
    bt_rig_test test;
    BT_TRY(bt_stage_rig(study, kind, &test, &diag));
    bt_status status = show(command, study, &test, &diag);
    if (status == BT_OK)
        status = write_files(command, study, &test, &diag);
    bt_rig_test_destroy(&test);
    return status;
}

static bt_status run_rig(const bt_command* typed) {
    bt_rig_kind kind = BT_RIG_COUNT;
    const bool named = find_kind(typed->words[0], &kind);
    if (!named && typed->word_count == 2)
        return bt_usage_error(typed,
                              "\"%s\" is none of nose-drop, main-drop, hook-rebound, nose-static, "
                              "main-static",
                              typed->words[0]);
    if (named && typed->word_count == 1)
        return bt_usage_error(typed, "STUDY.yaml expected after %s", typed->words[0]);
    bt_command command = *typed;
    command.words[0] = typed->words[typed->word_count - 1];
    command.word_count = 1;
    bt_study study;
    BT_TRY(bt_command_rigs(&command, &study));
    bt_status status = named ? BT_OK : bt_rig_only(&command, &study, &kind);
    if (status == BT_OK)
        status = run_test(&command, &study, kind);
    bt_study_destroy(&study);
    return status;
}

const bt_verb bt_verb_rig = {
    .name = "rig",
    .summary = "drop and static tests of the gear, rebound test of the hook",
    .arguments = "STUDY.yaml\nnose-drop STUDY.yaml\nmain-drop STUDY.yaml\nhook-rebound STUDY.yaml\n"
                 "nose-static STUDY.yaml\nmain-static STUDY.yaml",
    .text =
        "Runs the rig that the study's `rigs:' describes, or the named one of several, and prints "
        "its metrics beside "
        "the reference values given there, with errors in percent. The figures go into "
        "STUDY/figures (PNG, SVG, script and data), with the measured curves of "
        "`reference.curve' as points.\n\n"
        "  bolter rig nose-drop study.yaml\n"
        "  bolter rig nose-drop study.yaml --set rigs.nose_drop.sink_speed='3 m/s'\n"
        "  bolter rig nose-static studies/rigs/currey.yaml    load over stroke\n"
        "  bolter rig main-drop study.yaml -o drop.h5     time histories, no figures\n"
        "  bolter rig main-drop study.yaml -o drop.csv    the table of metrics, no figures\n"
        "  bolter rig main-drop study.yaml -o results     histories and figures\n\n"
        "A file that holds `rigs:' and, under `aircraft:', only the leg or hook to be tested will "
        "do. The exit code is 4 when the computation diverged; a metric that misses its reference "
        "is marked, and is no error.",
    .least_words = 1,
    .most_words = 2,
    .outputs = BT_OUTPUT_HISTORIES | BT_OUTPUT_TABLE | BT_OUTPUT_DIRECTORY,
    .run = run_rig,
};
