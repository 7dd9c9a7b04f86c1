#include "report/calibration_report.h"

#include "base/units.h"

#include <math.h>

// --- targets ----------------------------------------------------------------------------------

static const bt_column target_columns[] = {
    {.name = "name", .head = "target", .unit = ""},
    {.name = "unit", .head = NULL, .unit = ""},
    {.name = "wanted", .head = "wanted", .unit = ""},
    {.name = "before", .head = "before", .unit = ""},
    {.name = "got", .head = "got", .unit = ""},
    {.name = "residual_tolerances", .head = "error", .unit = ""},
    {.name = "met", .head = "met", .unit = "", .flag = true},
};
enum { TARGET_COLUMNS = sizeof target_columns / sizeof target_columns[0] };

/// A value of a target, for people in the unit it was typed in, or in SI.
static void add_value(bt_report_table* table, const bt_target* t, double value) {
    char typed[64], text[96];
    snprintf(typed, sizeof typed, "1 %s", bt_unit_text(t->token));
    bt_calibration_text(value, t->typed[0] ? t->typed : typed, text, sizeof text);
    bt_report_table_said(table, value, text);
}

static void add_wanted(bt_report_table* table, const bt_target* t) {
    static const char* const wish[] = {"",           "<= ",      ">= ",      "increasing",
                                       "decreasing", "constant", "the curve"};
    const bool single = t->kind <= BT_TARGET_AT_LEAST;
    char text[96];
    snprintf(text, sizeof text, "%s%s", wish[t->kind], single ? t->typed : "");
    bt_report_table_said(table, single ? t->wanted : NAN, text);
}

static void add_error(bt_report_table* table, const bt_target* t, const bt_target_fit* fit) {
    char text[48];
    if (t->kind == BT_TARGET_VALUE && t->wanted != 0)
        snprintf(text, sizeof text, "%+.2f %%", 100 * (fit->got / t->wanted - 1));
    else
        snprintf(text, sizeof text, "%.2f tolerances", fit->residual);
    bt_report_table_said(table, fit->residual, text);
}

bt_report_table* bt_calibrate_targets(const bt_calibrate_result* result) {
    bt_report_table* table = bt_report_table_create(NULL, target_columns, TARGET_COLUMNS);
    for (int i = 0; i < result->calibration.target_count; ++i) {
        const bt_target* t = &result->calibration.targets[i];
        const bt_target_fit* fit = &result->fit.targets[i];
        bt_report_table_row(table);
        bt_report_table_text(table, t->name);
        bt_report_table_text(table, bt_unit_text(t->token));
        add_wanted(table, t);
        add_value(table, t, result->fit.before[i].got);
        add_value(table, t, fit->got);
        add_error(table, t, fit);
        bt_report_table_flag_said(table, fit->met, fit->met ? "yes" : "NOT MET");
    }
    return table;
}

// --- parameters -------------------------------------------------------------------------------

static const char* const letters[] = {"a", "b", "c", "d", "e", "f", "g", "h",
                                      "i", "j", "k", "l", "m", "n", "o", "p"};
_Static_assert(sizeof letters / sizeof letters[0] == BT_PARAMETER_MAX, "a letter per parameter");

static const bt_column parameter_columns[] = {
    {.name = "letter", .head = "", .unit = ""},
    {.name = "path", .head = "parameter", .unit = ""},
    {.name = "unit", .head = NULL, .unit = ""},
    {.name = "lower", .head = NULL, .unit = ""},
    {.name = "upper", .head = NULL, .unit = ""},
    {.name = "start", .head = "start", .unit = ""},
    {.name = "value", .head = "found", .unit = ""},
    {.name = "standard_error", .head = "standard error", .unit = ""},
    {.name = "prior_share", .head = "of that before", .unit = "%", .scale = 100},
    {.name = "identified", .head = "by the data", .unit = "", .flag = true},
};
enum { PARAMETER_COLUMNS = sizeof parameter_columns / sizeof parameter_columns[0] };

/// A value of a parameter, for people in the unit it was typed in.
static void add_typed(bt_report_table* table, const bt_parameter* p, double value) {
    char text[96];
    bt_calibration_text(value, p->typed, text, sizeof text);
    bt_report_table_said(table, value, text);
}

bt_report_table* bt_calibrate_parameters(const bt_calibrate_result* result) {
    const bt_fit* fit = &result->fit;
    bt_report_table* table = bt_report_table_create(NULL, parameter_columns, PARAMETER_COLUMNS);
    for (int k = 0; k < result->calibration.parameter_count; ++k) {
        const bt_parameter* p = &result->calibration.parameters[k];
        bt_report_table_row(table);
        bt_report_table_text(table, letters[k]);
        bt_report_table_text(table, p->path);
        bt_report_table_text(table,
                             p->field->kind == BT_FIELD_REAL ? bt_unit_text(p->field->unit) : "");
        bt_report_table_number(table, p->lower);
        bt_report_table_number(table, p->upper);
        add_typed(table, p, p->start);
        add_typed(table, p, fit->value[k]);
        add_typed(table, p, fit->standard_error[k]);
        // the standard deviation of what is known to lie between two bounds and no more
        bt_report_table_number(table, fit->standard_error[k] * sqrt(12.0) / (p->upper - p->lower));
        bt_report_table_flag_said(table, fit->identified[k],
                                  fit->identified[k] ? "identified" : "NOT identified");
    }
    bt_report_table_remark(table, "(before any data, when only the bounds are known; identified: "
                                  "below 50 %%)");
    return table;
}

// --- matrices: a column per parameter, by its letter -------------------------------------------

#define LETTER(c)                                                                                  \
    { .name = c, .head = c, .unit = "", .decimals = 2 }
#define LETTERS                                                                                    \
    LETTER("a"), LETTER("b"), LETTER("c"), LETTER("d"), LETTER("e"), LETTER("f"), LETTER("g"),     \
        LETTER("h"), LETTER("i"), LETTER("j"), LETTER("k"), LETTER("l"), LETTER("m"), LETTER("n"), \
        LETTER("o"), LETTER("p")

static bt_report_table* sensitivity_table(const bt_calibrate_result* result) {
    static const bt_column columns[] = {{.name = "name", .head = "target", .unit = ""}, LETTERS};
    const int count = result->calibration.parameter_count;
    bt_report_table* table = bt_report_table_create(
        "\nsensitivity: change of a target, in its tolerances, per tenth of a parameter's range",
        columns, 1 + count);
    for (int i = 0; i < result->calibration.target_count; ++i) {
        bt_report_table_row(table);
        bt_report_table_text(table, result->calibration.targets[i].name);
        for (int k = 0; k < count; ++k)
            bt_report_table_number(table, result->fit.sensitivity[i][k] / 10);
    }
    return table;
}

static bt_report_table* direction_table(const bt_calibrate_result* result) {
    static const bt_column columns[] = {
        {.name = "identified", .head = "by the data", .unit = "", .flag = true},
        {.name = "singular_value", .head = "singular value", .unit = ""},
        LETTERS};
    const int count = result->calibration.parameter_count;
    bt_report_table* table =
        bt_report_table_create("\ncombinations of parameters", columns, 2 + count);
    for (int i = 0; i < count; ++i) {
        const bool identified = i < result->fit.identified_directions;
        char text[32];
        snprintf(text, sizeof text, "%.3g", result->fit.singular[i]);
        bt_report_table_row(table);
        bt_report_table_flag_said(table, identified, identified ? "identified" : "not identified");
        bt_report_table_said(table, result->fit.singular[i], text);
        for (int k = 0; k < count; ++k)
            bt_report_table_number(table, result->fit.direction[i][k]);
    }
    bt_report_table_remark(table, "the data identify %d of %d, by the same criterion",
                           result->fit.identified_directions, count);
    return table;
}

static bt_report_table* correlation_table(const bt_calibrate_result* result) {
    static const bt_column columns[] = {{.name = "letter", .head = "", .unit = ""}, LETTERS};
    const int count = result->calibration.parameter_count;
    bt_report_table* table = bt_report_table_create("\ncorrelations", columns, 1 + count);
    for (int a = 0; a < count; ++a) {
        bt_report_table_row(table);
        bt_report_table_text(table, letters[a]);
        for (int b = 0; b < count; ++b)
            bt_report_table_number(table, result->fit.correlation[a][b]);
    }
    return table;
}

// --- all of it --------------------------------------------------------------------------------

static bt_status print_and_destroy(bt_report_table* table, FILE* out) {
    const bt_status status = bt_report_table_print(table, out);
    bt_report_table_destroy(table);
    return status;
}

bt_status bt_calibrate_print(const bt_calibrate_result* result, FILE* out) {
    const bt_fit* fit = &result->fit;
    BT_TRY(print_and_destroy(bt_calibrate_targets(result), out));
    fputc('\n', out);
    BT_TRY(print_and_destroy(bt_calibrate_parameters(result), out));
    BT_TRY(print_and_destroy(sensitivity_table(result), out));
    BT_TRY(print_and_destroy(direction_table(result), out));
    BT_TRY(print_and_destroy(correlation_table(result), out));
    fprintf(out, "\n%d steps, %d runs of the model, %.1f s; cost %.4g, at the start %.4g%s\n",
            fit->steps, fit->landings, result->seconds, fit->cost, fit->start_cost,
            fit->converged ? "" : "; NOT converged, allow more `steps`");
    if (!bt_calibrate_met(result))
        fprintf(out, "Some targets are not met: nothing within the bounds does better near here; "
                     "`starts: 8` looks elsewhere too.\n");
    fprintf(out, "%s holds the values found; use it with --set @%s\n", result->overlay,
            result->overlay);
    return BT_OK;
}

static void write_row(bt_json* json, const char* key, const double* row, int count) {
    bt_json_begin_array(json, key);
    for (int k = 0; k < count; ++k)
        bt_json_number(json, NULL, row[k]);
    bt_json_end_array(json);
}

/// The matrices as arrays of rows, in the order of targets and parameters.
static void write_matrices(bt_json* json, const bt_calibrate_result* result) {
    const bt_fit* fit = &result->fit;
    const int count = result->calibration.parameter_count;
    bt_json_begin_array(json, "sensitivity");
    for (int i = 0; i < result->calibration.target_count; ++i)
        write_row(json, NULL, fit->sensitivity[i], count);
    bt_json_end_array(json);
    bt_json_begin_array(json, "correlation");
    for (int k = 0; k < count; ++k)
        write_row(json, NULL, fit->correlation[k], count);
    bt_json_end_array(json);
    bt_json_begin_array(json, "singular_directions");
    for (int i = 0; i < count; ++i) {
        bt_json_begin_object(json, NULL);
        bt_json_number(json, "singular_value", fit->singular[i]);
        bt_json_bool(json, "identified", i < fit->identified_directions);
        write_row(json, "direction", fit->direction[i], count);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}

static bt_status write_and_destroy(bt_report_table* table, bt_json* json, const char* key) {
    const bt_status status = bt_report_table_json(table, json, key);
    bt_report_table_destroy(table);
    return status;
}

bt_status bt_calibrate_write_json(const bt_calibrate_result* result, FILE* out) {
    const bt_fit* fit = &result->fit;
    bt_json json = {.out = out};
    bt_json_begin_object(&json, NULL);
    BT_TRY(write_and_destroy(bt_calibrate_parameters(result), &json, "parameters"));
    BT_TRY(write_and_destroy(bt_calibrate_targets(result), &json, "targets"));
    write_matrices(&json, result);
    bt_json_bool(&json, "converged", fit->converged);
    bt_json_bool(&json, "met", bt_calibrate_met(result));
    bt_json_number(&json, "start_cost", fit->start_cost);
    bt_json_number(&json, "cost", fit->cost);
    bt_json_integer(&json, "steps", fit->steps);
    bt_json_integer(&json, "runs", fit->landings);
    bt_json_number(&json, "seconds", result->seconds);
    bt_json_string(&json, "overlay", result->overlay);
    bt_json_end_object(&json);
    return BT_OK;
}
