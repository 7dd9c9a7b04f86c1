#include "cli/cli.h"
#include "cli/output.h"
#include "cli/rig_sweep.h"
#include "cli/values.h"

#include "base/directory.h"
#include "base/text.h"
#include "base/units.h"
#include "pipeline/sweep.h"
#include "report/figure.h"
#include "report/figure_text.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LABEL_SIZE = 48, CORNERS = 3 };

/// What to sweep, and what the paper says of it.
typedef struct plan {
    char name[160]; ///< name of the figure
    const char *key, *values, *title;
    const char* paper;           ///< number of the paper's figure
    const char* reference;       ///< what the paper prints; NULL: nothing
    const char* reference_label; ///< in the figure
    double reference_height_mm, reference_distance_m;
} plan;

static const plan paper[] = {
    {"fig14", "landing.sink_speed", "3.6 m/s, 4 m/s, 5 m/s, 6.3 m/s",
     "Hook bounce and sinking velocity", " (Fig. 14)", "paper, 6.3 m/s: 53 mm, at most 4 m",
     "paper, 6.3 m/s", 53, 4},
    {"fig15", "landing.pitch", "0 deg, 2 deg, 4 deg, 6 deg, 8 deg", "Hook bounce and pitch angle",
     " (Fig. 15)", "paper, 8 deg: 81 mm, 4.57 m", "paper, 8 deg", 81, 4.57},
    {"fig16", "landing.horizontal_speed", "55 m/s, 50 m/s, 45 m/s, 40 m/s",
     "Hook bounce and horizontal velocity", " (Fig. 16)", NULL, NULL, 0, 0},
};
enum { PAPER_COUNT = sizeof paper / sizeof paper[0] };

/// The plan of --key and --values.
static plan own_plan(const char* key, const char* values) {
    plan p = {.key = key, .values = values};
    snprintf(p.name, sizeof p.name, "sweep_%s", key);
    for (char* c = p.name; *c; ++c)
        if (!isalnum((unsigned char)*c))
            *c = '_';
    return p;
}

/// The last of the values as typed: its unit is the unit of the table.
static const char* last_item(const char* values) {
    const char* comma = strrchr(values, ',');
    const char* item = comma ? comma + 1 : values;
    return item + strspn(item, " ");
}

static void value_label(const plan* p, double value, char* label) {
    char number[32];
    const char* unit = "";
    bt_unit_print_as(value, last_item(p->values), number, sizeof number, &unit);
    snprintf(label, LABEL_SIZE, "%s%s%s", number, *unit ? " " : "", unit);
}

/// The first bounce; nothing measured when there was none, or the run ended in the air.
static bt_bounce first_bounce(const bt_landing_result* result) {
    if (result->bounce_count > 0 && result->bounces[0].complete)
        return result->bounces[0];
    return (bt_bounce){.height_m = NAN, .distance_m = NAN, .impact_force_N = NAN};
}

// --- table ------------------------------------------------------------------------------------

static const bt_column columns[] = {
    {.name = "key", .head = NULL, .unit = ""},
    {.name = "value", .head = "value", .unit = ""},
    {.name = "outcome", .head = NULL, .unit = ""},
    {.name = "mode", .head = NULL, .unit = ""},
    {.name = "height_m", .head = "first bounce", .unit = "mm", .scale = 1e3, .decimals = 1},
    {.name = "distance_m", .head = "length", .unit = "m", .decimals = 2},
    {.name = "impact_force_N", .head = "impact load", .unit = "kN", .scale = 1e-3},
    {.name = "margin_m", .head = NULL, .unit = ""},
};

static bt_report_table* create_table(void) {
    return bt_report_table_create(NULL, columns, (int)(sizeof columns / sizeof columns[0]));
}

static void add_row(bt_report_table* table, const plan* p, const bt_sweep_row* row) {
    const bt_landing_result* result = &row->result;
    const bt_bounce bounce = first_bounce(result);
    char label[LABEL_SIZE], failed[160];
    value_label(p, row->value, label);
    bt_report_table_row(table);
    bt_report_table_text(table, p->key);
    bt_report_table_said(table, row->value, label);
    bt_report_table_text(table, bt_outcome_name(result->outcome));
    bt_report_table_text(table, bt_mode_name(result->mode));
    if (isfinite(bounce.height_m))
        bt_report_table_number(table, bounce.height_m);
    else
        bt_report_table_said(table, NAN, "none before the cable");
    bt_report_table_number(table, bounce.distance_m);
    bt_report_table_number(table, bounce.impact_force_N);
    bt_report_table_number(table, result->margin_m);
    if (result->outcome != BT_FAILED)
        return;
    snprintf(failed, sizeof failed, "%s failed: %s, %s at %.4g s", label, result->failed_element,
             result->failed_quantity, result->failed_time_s);
    bt_report_table_remark(table, "%s", failed);
}

/// One sweep for people; its rows also go into the table of all of them.
static bt_status print_table(const bt_study* study, const plan* p, const bt_sweep* sweep) {
    bt_report_table* table = create_table();
    for (int i = 0; i < sweep->count; ++i)
        add_row(table, p, &sweep->rows[i]);
    if (p->reference && bt_study_is_reference(study))
        bt_report_table_remark(table, "(%s)", p->reference);
    printf("%s\n", p->key);
    const bt_status status = bt_report_table_print(table, stdout);
    bt_report_table_destroy(table);
    return status;
}

static void write_json(bt_json* json, const plan* p, const bt_sweep* sweep) {
    const bt_field* field = sweep->field;
    bt_json_begin_object(json, NULL);
    bt_json_string(json, "key", p->key);
    bt_json_string(json, "unit", field->kind == BT_FIELD_REAL ? bt_unit_text(field->unit) : "");
    bt_json_string(json, "figure", p->name);
    bt_json_begin_array(json, "rows");
    for (int i = 0; i < sweep->count; ++i) {
        const bt_landing_result* result = &sweep->rows[i].result;
        const bt_bounce bounce = first_bounce(result);
        bt_json_begin_object(json, NULL);
        bt_json_number(json, "value", sweep->rows[i].value);
        bt_json_string(json, "outcome", bt_outcome_name(result->outcome));
        bt_json_string(json, "mode", bt_mode_name(result->mode));
        bt_json_number(json, "height_m", bounce.height_m);
        bt_json_number(json, "distance_m", bounce.distance_m);
        bt_json_number(json, "impact_force_N", bounce.impact_force_N);
        bt_json_number(json, "margin_m", result->margin_m);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
    bt_json_end_object(json);
}

// --- figure -----------------------------------------------------------------------------------

/// Where the figure ends: a little after the longest first bounce.
static double figure_end_m(const bt_sweep* sweep) {
    double longest = 0;
    for (int i = 0; i < sweep->count; ++i) {
        const double distance = first_bounce(&sweep->rows[i].result).distance_m;
        if (distance > longest)
            longest = distance;
    }
    return ceil(1.3 * longest + 0.5);
}

static bt_status write_figure(const bt_study* study, const plan* p, bt_sweep* sweep,
                              const char* folder, bool plot, bt_diag* diag) {
    char title[400];
    const bool reference = bt_study_is_reference(study);
    snprintf(title, sizeof title, "%s%s%s%s", study->title, p->title ? ": " : "",
             p->title ? p->title : "", p->title && reference ? p->paper : "");
    bt_series series[BT_SWEEP_VALUES_MAX + 1];
    char labels[BT_SWEEP_VALUES_MAX][LABEL_SIZE];
    const double x[CORNERS] = {0, p->reference_distance_m, p->reference_distance_m};
    const double y[CORNERS] = {p->reference_height_mm, p->reference_height_mm, 0};
    for (int i = 0; i < sweep->count; ++i) {
        bt_hook_path* path = &sweep->rows[i].path;
        for (int k = 0; k < path->count; ++k)
            path->height_m[k] *= 1e3; // drawn in millimetres
        value_label(p, sweep->rows[i].value, labels[i]);
        series[i] = (bt_series){
            .label = labels[i], .count = path->count, .x = path->travelled_m, .y = path->height_m};
    }
    int count = sweep->count;
    if (p->reference && reference && count < BT_SERIES_MAX)
        series[count++] = (bt_series){.label = p->reference_label,
                                      .style = BT_SERIES_REFERENCE,
                                      .count = CORNERS,
                                      .x = x,
                                      .y = y};
    const bt_figure figure = {.name = p->name,
                              .title = title,
                              .x_label = "distance travelled from first contact, m",
                              .y_label = "height of the hook above the deck, mm",
                              .key_title = p->title ? NULL : p->key,
                              .ordered = true,
                              .from_zero = true,
                              .x_max = figure_end_m(sweep),
                              .series_count = count,
                              .series = series};
    if (plot)
        bt_figure_print(&figure, stdout);
    return bt_figure_write(&figure, folder, diag);
}

// --- verb -------------------------------------------------------------------------------------

/// One landing well before the cable, unless the distance itself is what varies.
static bt_model_params sweep_model(const bt_study* study, const char* key) {
    bt_model_params model = study->model;
    if (strcmp(key, "landing.distance") != 0 && model.landing.distance_m < BT_CLEAR_DISTANCE_M)
        model.landing.distance_m = BT_CLEAR_DISTANCE_M;
    return model;
}

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

static bt_status show(sweeping* s, const plan* p, bt_sweep* sweep) {
    for (int i = 0; i < sweep->count; ++i) {
        add_row(s->all, p, &sweep->rows[i]);
        s->failed += sweep->rows[i].result.outcome == BT_FAILED;
    }
    if (s->command->json)
        write_json(&s->json, p, sweep);
    else
        BT_TRY(print_table(s->study, p, sweep));
    if (bt_output_kind(s->command->output) == BT_OUTPUT_TABLE)
        return BT_OK; // only the table was asked for
    return write_figure(s->study, p, sweep, s->folder, s->command->option[2] && !s->command->json,
                        &s->diag);
}

static bt_status compute(const bt_study* study, const plan* p, bt_sweep* sweep, bt_diag* diag) {
    const bt_model_params model = sweep_model(study, p->key);
    const bt_field* field = NULL;
    double values[BT_SWEEP_VALUES_MAX];
    size_t offset;
    int count = 0;
    BT_TRY(bt_sweep_find(&model, p->key, &field, &offset, diag));
    BT_TRY(bt_sweep_values(field, p->key, p->values, values, &count, diag));
    return bt_sweep_run(&model, p->key, values, count, (int)study->campaign.threads,
                        &bt_interrupted, sweep, diag);
}

static bt_status run_plan(sweeping* s, const plan* p) {
    bt_sweep sweep;
    BT_TRY(compute(s->study, p, &sweep, &s->diag));
    const bt_status status = show(s, p, &sweep);
    bt_sweep_destroy(&sweep);
    return status;
}

bt_status bt_sweep_figures(const bt_study* study, const char* folder, bt_diag* diag) {
    bt_status status = BT_OK;
    for (int i = 0; i < PAPER_COUNT && status == BT_OK; ++i) {
        bt_sweep sweep;
        BT_TRY(compute(study, &paper[i], &sweep, diag));
        status = write_figure(study, &paper[i], &sweep, folder, false, diag);
        bt_sweep_destroy(&sweep);
    }
    return status;
}

static bt_status run_plans(sweeping* s, const plan* plans, int count) {
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
static bt_status sweep_into(sweeping* s, const plan* plans, int count) {
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

static bt_status run_sweeps(const bt_command* command, const bt_study* study, const plan* plans,
                            int count) {
    sweeping s = {.command = command,
                  .study = study,
                  .all = create_table(),
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
    BT_TRY(key ? bt_command_rigs(command, &study) : bt_command_study(command, &study));
    if (study.rigs_only || (key && strncmp(key, "rigs.", 5) == 0)) {
        const bt_status swept = bt_rig_sweep(command, &study, key, list);
        bt_study_destroy(&study);
        return swept;
    }
    const plan own = own_plan(key ? key : "", list);
    const bt_status status =
        run_sweeps(command, &study, key ? &own : paper, key ? 1 : (int)PAPER_COUNT);
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
