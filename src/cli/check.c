#include "pipeline/check.h"
#include "campaign/design.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "report/rig_report.h"

#include <stdio.h>

static const bt_column columns[] = {
    {.name = "element", .head = "element", .unit = ""},
    {.name = "setting", .head = NULL, .unit = ""},
    {.name = "stable_s", .head = "stable step", .unit = "us", .scale = 1e6, .decimals = 1},
    {.name = "used_s", .head = "step used", .unit = "us", .scale = 1e6, .decimals = 1},
};

static bt_report_table* step_table(const bt_check_result* result) {
    bt_report_table* table = bt_report_table_create(NULL, columns, 4);
    for (int i = 0; i < result->step_count; ++i) {
        const bt_stable_step* step = &result->steps[i];
        bt_report_table_row(table);
        bt_report_table_text(table, step->element);
        bt_report_table_text(table, step->setting);
        bt_report_table_number(table, step->stable_s);
        bt_report_table_number(table, step->used_s);
    }
    return table;
}

static bt_status print_text(const bt_study* study, int64_t runs, const bt_report_table* steps) {
    const bt_axes axes = bt_design_axes(study);
    char count[32], samples[32], checks[32];
    printf("%s\n", study->title);
    printf("campaign    %s landings, design %s, over", bt_count_text(runs, count),
           bt_design_names[study->campaign.design]);
    for (int i = 0; i < axes.count; ++i)
        printf("%s %s", i ? "," : "", study->inputs[axes.input[i]].path);
    printf("\nreliability %d conditions, %s samples each, checked by %s high-fidelity runs each\n",
           study->condition_count, bt_count_text(study->reliability.samples, samples),
           bt_count_text(study->reliability.high_fidelity_runs, checks));
    printf("results     %s\n\n", study->directory);
    return bt_report_table_print(steps, stdout);
}

static bt_status print_json(const bt_study* study, int64_t runs, const bt_report_table* steps) {
    bt_json json = {.out = stdout};
    bt_json_begin_object(&json, NULL);
    bt_json_string(&json, "title", study->title);
    bt_json_integer(&json, "runs", runs);
    bt_json_string(&json, "directory", study->directory);
    BT_TRY(bt_report_table_json(steps, &json, "stable_steps"));
    bt_json_end_object(&json);
    return BT_OK;
}

/// The table of steps to -o FILE.csv, and with the rest to the user.
static bt_status show(const bt_command* command, const bt_study* study,
                      const bt_check_result* result, bt_diag* diag) {
    bt_report_table* table = step_table(result);
    bt_status status = bt_output_table(command, table, diag);
    if (status == BT_OK)
        status = command->json ? print_json(study, result->runs, table)
                               : print_text(study, result->runs, table);
    bt_report_table_destroy(table);
    return status;
}

/// Reads every measured curve that the study names.
static bt_status check_curves(const bt_study* study, bt_diag* diag) {
    bt_status worst = BT_OK;
    for (int kind = 0; kind < BT_RIG_COUNT; ++kind) {
        bt_rig_curves curves;
        const bt_status status = bt_rig_curves_read(study, (bt_rig_kind)kind, &curves, diag);
        if (status == BT_OK)
            bt_rig_curves_destroy(&curves);
        worst = worst == BT_OK ? status : worst;
    }
    return worst;
}

/// A file that describes rigs only.
static void print_rigs(const bt_command* command, const bt_study* study) {
    bt_json json = {.out = stdout};
    if (command->json) {
        bt_json_begin_object(&json, NULL);
        bt_json_string(&json, "title", study->title);
        bt_json_begin_array(&json, "rigs");
        for (int kind = 0; kind < BT_RIG_COUNT; ++kind)
            if (study->rig_inputs[kind].given)
                bt_json_string(&json, NULL, bt_rig_keys[kind]);
        bt_json_end_array(&json);
        bt_json_end_object(&json);
    } else {
        printf("%s\n", study->title);
        for (int kind = 0; kind < BT_RIG_COUNT; ++kind)
            if (study->rig_inputs[kind].given)
                printf("rig         %s, %d measured curve%s\n", bt_rig_keys[kind],
                       study->rig_inputs[kind].curve_count,
                       study->rig_inputs[kind].curve_count == 1 ? "" : "s");
        printf("results     %s\n", study->directory);
    }
}

static bt_status check(const bt_command* command, const bt_study* study) {
    bt_diag diag = bt_stderr_diag();
    bt_check_result result;
    BT_TRY(check_curves(study, &diag));
    if (study->rigs_only) {
        print_rigs(command, study);
        return BT_OK;
    }
    BT_TRY(bt_stage_check(study, &result, &diag));
    return show(command, study, &result, &diag);
}

static bt_status run_check(const bt_command* command) {
    bt_study study;
    BT_TRY(bt_command_rigs(command, &study));
    const bt_status status = check(command, &study);
    bt_study_destroy(&study);
    return status;
}

const bt_verb bt_verb_check = {
    .name = "check",
    .summary = "check a study file: every mistake with its place",
    .arguments = "STUDY.yaml",
    .text = "Reads the study and the files it names, converts every value, and reports all "
            "mistakes at once, each as file:line:column: error: key: what is wrong and what would "
            "be right. If there are none it prints what the study will do and the largest stable "
            "time step of each element beside the step used. Nothing is run; -o FILE.csv takes the "
            "table of steps. A file that "
            "describes rigs only (see `bolter rig --help') is checked as such.",
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_TABLE | BT_OUTPUT_DIRECTORY,
    .run = run_check,
};
