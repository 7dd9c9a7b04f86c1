#include "cli/cli.h"
#include "cli/output.h"
#include "cli/rig_sweep.h"
#include "cli/values.h"

#include "base/directory.h"
#include "base/units.h"
#include "pipeline/sweep.h"
#include "report/sweep_report.h"

#include <string.h>

/// The sweeps of one command.
typedef struct sweeping {
    const bt_command* command;
    const bt_study* study;
    char folder[BT_FILE_PATH_MAX];
    bt_report_table* all; ///< rows of every sweep, for -o FILE.csv
    bt_json json;
    int failed;
    bt_diag diag;
} sweeping;

static bt_status print_json(bt_json* json, const bt_sweep_plan* plan, const bt_sweep* sweep,
                            const bt_report_table* table) {
    const bt_field* field = sweep->field;
    bt_json_begin_object(json, NULL);
    bt_json_string(json, "key", plan->key);
    bt_json_string(json, "unit", field->kind == BT_FIELD_REAL ? bt_unit_text(field->unit) : "");
    bt_json_string(json, "figure", plan->name);
    BT_TRY(bt_report_table_json(table, json, "rows"));
    bt_json_end_object(json);
    return BT_OK;
}

/// One sweep for people or programs.
static bt_status print(sweeping* s, const bt_sweep_plan* plan, const bt_sweep* sweep) {
    bt_status status;
    bt_report_table* table = bt_sweep_table_create();
    bt_sweep_table_add(table, plan, sweep);
    if (plan->said && bt_study_is_reference(s->study))
        bt_report_table_remark(table, "(%s)", plan->said);
    if (s->command->json)
        status = print_json(&s->json, plan, sweep, table);
    else {
        printf("%s\n", plan->key);
        status = bt_report_table_print(table, stdout);
    }
    bt_report_table_destroy(table);
    return status;
}

static bt_status show(sweeping* s, const bt_sweep_plan* plan, const bt_sweep* sweep) {
    bt_sweep_table_add(s->all, plan, sweep);
    for (int i = 0; i < sweep->count; ++i)
        s->failed += sweep->rows[i].result.outcome == BT_FAILED;
    BT_TRY(print(s, plan, sweep));
    if (bt_output_kind(s->command->output) == BT_OUTPUT_TABLE)
        return BT_OK; // only the table was asked for
    return bt_sweep_draw(s->study, plan, sweep, s->folder,
                         s->command->option[2] && !s->command->json ? stdout : NULL, &s->diag);
}

static bt_status run_plan(sweeping* s, const bt_sweep_plan* plan) {
    bt_sweep sweep;
    BT_TRY(bt_stage_sweep(s->study, plan, &bt_interrupted, &sweep, &s->diag));
    const bt_status status = show(s, plan, &sweep);
    bt_sweep_destroy(&sweep);
    return status;
}

static bt_status run_plans(sweeping* s, const bt_sweep_plan* plans, int count) {
    bt_status status = BT_OK;
    if (s->command->json) {
        bt_json_begin_object(&s->json, NULL);
        bt_json_begin_array(&s->json, "sweeps");
    }
    for (int i = 0; i < count && status == BT_OK; ++i)
        status = run_plan(s, &plans[i]);
    if (s->command->json) {
        bt_json_end_array(&s->json);
        bt_json_end_object(&s->json);
    }
    return status;
}

/// Into the study directory, or into the one file of -o.
static bt_status sweep_into(sweeping* s, const bt_sweep_plan* plans, int count) {
    if (bt_output_kind(s->command->output) == BT_OUTPUT_TABLE) {
        BT_TRY(run_plans(s, plans, count));
        return bt_output_table(s->command, s->all, &s->diag);
    }
    bt_directory directory;
    BT_TRY(bt_file_path(s->folder, s->study->directory, "figures"));
    BT_TRY(bt_directory_open(&directory, s->study->directory, &s->diag));
    const bt_status status = run_plans(s, plans, count);
    bt_directory_close(&directory);
    if (status == BT_OK && !s->command->quiet && !s->command->json)
        printf("figures: %s\n", s->folder);
    return status;
}

static bt_status run_sweeps(const bt_command* command, const bt_study* study,
                            const bt_sweep_plan* plans, int count) {
    sweeping s = {.command = command,
                  .study = study,
                  .all = bt_sweep_table_create(),
                  .json = {.out = stdout},
                  .diag = bt_stderr_diag()};
    const bt_status status = sweep_into(&s, plans, count);
    bt_report_table_destroy(s.all);
    return status == BT_OK && s.failed > 0 ? BT_ERR_FAILED_RUNS : status;
}

static bt_status run_sweep(const bt_command* command) {
    const char *key = command->option[0], *values = command->option[1];
    if (!key != !values)
        return bt_usage_error(command, "--key and --values go together");
    char list[4096] = "", why[512];
    if (values && bt_values_expand(values, list, sizeof list, why, sizeof why) != BT_OK)
        return bt_usage_error(command, "--values: %s", why);
    bt_study study;
    bt_status status;
    BT_TRY(key ? bt_command_rigs(command, &study) : bt_command_study(command, &study));
    if (study.rigs_only || (key && strncmp(key, "rigs.", 5) == 0))
        status = bt_rig_sweep_command(command, &study, key, list);
    else if (key) {
        const bt_sweep_plan own = bt_sweep_plan_of(key, list);
        status = run_sweeps(command, &study, &own, 1);
    } else
        status = run_sweeps(command, &study, bt_paper_sweeps, BT_PAPER_SWEEPS);
    bt_study_destroy(&study);
    return status;
}

static const struct argp_option options[] = {
    {"key", BT_OPTION + 0, "PATH", 0, "the key to vary, for example landing.sink_speed", 1},
    {"values", BT_OPTION + 1, "LIST", 0,
     "its values: '3.6, 4, 5 m/s', or a range: '0..8 deg' (nine values), '0..8 deg in 5', "
     "'0..8 deg by 2'",
     1},
    {"plot", BT_OPTION + 2, 0, 0, "draw the ways of the hook in the terminal too", 1},
    {0},
};

const bt_verb bt_verb_sweep = {
    .name = "sweep",
    .summary = "one key over values: how the hook bounces",
    .arguments = "STUDY.yaml",
    .text =
        "Varies one key and lands once per value, the rest as in the study but the cable at least "
        "14 m away, so that the hook bounces undisturbed. Prints height, length and impact load "
        "of the first bounce and draws the way of the hook into STUDY/figures (PNG, SVG, script "
        "and data).\n\n"
        "  bolter sweep study.yaml --key landing.pitch --values '0 deg, 4 deg, 8 deg'\n"
        "  bolter sweep study.yaml          the paper's three: Figs. 14, 15 and 16\n"
        "  bolter sweep study.yaml -o table.csv     the table alone, SI\n"
        "  bolter sweep drop.yaml --key rigs.nose_drop.sink_speed --values '2..4 m/s in 5'\n\n"
        "With --key landing.distance the cable lies where the value says.",
    .options = options,
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_TABLE | BT_OUTPUT_DIRECTORY,
    .run = run_sweep,
};
