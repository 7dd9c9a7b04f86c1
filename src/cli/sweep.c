#include "cli/cli.h"
#include "cli/output.h"
#include "cli/values.h"

#include "base/directory.h"
#include "base/text.h"
#include "base/units.h"
#include "pipeline/sweep.h"
#include "report/figure.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LABEL_SIZE = 48, CORNERS = 3 };

/// What to sweep, and what the paper says of it.
typedef struct plan {
    char name[160]; ///< of the figure
    const char *key, *values, *title;
    const char* reference;       ///< what the paper prints; NULL: nothing
    const char* reference_label; ///< in the figure
    double reference_height_mm, reference_distance_m;
} plan;

static const plan paper[] = {
    {"fig14", "landing.sink_speed", "3.6 m/s, 4 m/s, 5 m/s, 6.3 m/s",
     "Hook bounce and sinking velocity (Fig. 14)", "paper, 6.3 m/s: 53 mm, at most 4 m",
     "paper, 6.3 m/s", 53, 4},
    {"fig15", "landing.pitch", "0 deg, 2 deg, 4 deg, 6 deg, 8 deg",
     "Hook bounce and pitch angle (Fig. 15)", "paper, 8 deg: 81 mm, 4.57 m", "paper, 8 deg", 81,
     4.57},
    {"fig16", "landing.horizontal_speed", "55 m/s, 50 m/s, 45 m/s, 40 m/s",
     "Hook bounce and horizontal velocity (Fig. 16)", NULL, NULL, 0, 0},
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

static void print_row(const plan* p, const bt_sweep_row* row) {
    char label[LABEL_SIZE];
    const bt_bounce bounce = first_bounce(&row->result);
    value_label(p, row->value, label);
    printf("  %-16s", label);
    if (row->result.outcome == BT_FAILED)
        printf("failed: %s, %s at %.4g s\n", row->result.failed_element,
               row->result.failed_quantity, row->result.failed_time_s);
    else if (isnan(bounce.height_m))
        printf("no whole bounce before the cable\n");
    else
        printf("%11.1f mm %11.2f m %10.0f kN\n", 1e3 * bounce.height_m, bounce.distance_m,
               1e-3 * bounce.impact_force_N);
}

static void print_table(const plan* p, const bt_sweep* sweep) {
    printf("%s\n  first bounce        height      distance   impact load\n", p->key);
    for (int i = 0; i < sweep->count; ++i)
        print_row(p, &sweep->rows[i]);
    if (p->reference)
        printf("  (%s)\n", p->reference);
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

static bt_status write_figure(const plan* p, bt_sweep* sweep, const char* folder, bt_diag* diag) {
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
    if (p->reference && count < BT_SERIES_MAX)
        series[count++] = (bt_series){.label = p->reference_label,
                                      .style = BT_SERIES_REFERENCE,
                                      .count = CORNERS,
                                      .x = x,
                                      .y = y};
    const bt_figure figure = {.name = p->name,
                              .title = p->title,
                              .x_label = "distance travelled from first contact, m",
                              .y_label = "height of the hook above the deck, mm",
                              .key_title = p->title ? NULL : p->key,
                              .ordered = true,
                              .from_zero = true,
                              .x_max = figure_end_m(sweep),
                              .series_count = count,
                              .series = series};
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

static bt_status run_plan(const bt_command* command, const bt_study* study, const plan* p,
                          const char* folder, bt_json* json, int* failed) {
    bt_diag diag = bt_stderr_diag();
    const bt_model_params model = sweep_model(study, p->key);
    const bt_field* field = NULL;
    double values[BT_SWEEP_VALUES_MAX];
    size_t offset;
    int count = 0;
    bt_sweep sweep;
    BT_TRY(bt_sweep_find(&model, p->key, &field, &offset, &diag));
    BT_TRY(bt_sweep_values(field, p->key, p->values, values, &count, &diag));
    BT_TRY(bt_sweep_run(&model, p->key, values, count, (int)study->campaign.threads,
                        &bt_interrupted, &sweep, &diag));
    if (command->json)
        write_json(json, p, &sweep);
    else
        print_table(p, &sweep);
    for (int i = 0; i < count; ++i)
        *failed += sweep.rows[i].result.outcome == BT_FAILED;
    const bt_status status = write_figure(p, &sweep, folder, &diag);
    bt_sweep_destroy(&sweep);
    return status;
}

static bt_status run_plans(const bt_command* command, const bt_study* study, const plan* plans,
                           int count) {
    bt_diag diag = bt_stderr_diag();
    bt_directory directory;
    char folder[BT_FILE_PATH_MAX];
    bt_json json = {.out = stdout};
    int failed = 0;
    BT_TRY(bt_file_path(folder, study->directory, "figures"));
    BT_TRY(bt_directory_open(&directory, study->directory, &diag));
    if (command->json) {
        bt_json_begin_object(&json, NULL);
        bt_json_begin_array(&json, "sweeps");
    }
    bt_status status = BT_OK;
    for (int i = 0; i < count && status == BT_OK; ++i)
        status = run_plan(command, study, &plans[i], folder, &json, &failed);
    if (command->json) {
        bt_json_end_array(&json);
        bt_json_end_object(&json);
    }
    bt_directory_close(&directory);
    if (status == BT_OK && !command->quiet && !command->json)
        printf("figures: %s\n", folder);
    if (status != BT_OK || failed == 0)
        return status;
    bt_say_error(command, "%d landing%s failed, as the table says", failed, failed == 1 ? "" : "s");
    return BT_ERR_FAILED_RUNS;
}

static bt_status run(const bt_command* command) {
    const char *key = command->option[0], *values = command->option[1];
    if (!key != !values)
        return bt_usage_error(command, "--key and --values go together");
    char list[4096] = "", why[512];
    if (values && bt_values_expand(values, list, sizeof list, why, sizeof why) != BT_OK)
        return bt_usage_error(command, "--values: %s", why);
    bt_study study;
    BT_TRY(bt_command_study(command, &study));
    const plan own = own_plan(key ? key : "", list);
    const bt_status status =
        run_plans(command, &study, key ? &own : paper, key ? 1 : (int)PAPER_COUNT);
    bt_study_destroy(&study);
    return status;
}

static const struct argp_option options[] = {
    {"key", BT_OPTION + 0, "PATH", 0, "the key to vary, for example landing.sink_speed", 1},
    {"values", BT_OPTION + 1, "LIST", 0,
     "its values: '3.6, 4, 5 m/s', or a range: '0..8 deg' (nine values), '0..8 deg in 5', "
     "'0..8 deg by 2'",
     1},
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
        "  bolter sweep study.yaml          the paper's three: Figs. 14, 15 and 16\n\n"
        "With --key landing.distance the cable lies where the value says.",
    .options = options,
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_DIRECTORY,
    .run = run,
};
