#include "base/clock.h"
#include "cli/cli.h"
#include "cli/output.h"

#include "base/directory.h"
#include "base/units.h"
#include "calibration/calibration.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- for people -------------------------------------------------------------------------------

/// A value of a target in the unit it was typed in, or in SI.
static void target_text(const bt_target* t, double value, char* text, size_t size) {
    char typed[64];
    snprintf(typed, sizeof typed, "1 %s", bt_unit_text(t->token));
    bt_calibration_text(value, t->typed[0] ? t->typed : typed, text, size);
}

static void wish_text(const bt_target* t, char* text, size_t size) {
    static const char* const wish[] = {"",           "<= ",      ">= ",      "increasing",
                                       "decreasing", "constant", "the curve"};
    snprintf(text, size, "%s%s", wish[t->kind], t->kind <= BT_TARGET_AT_LEAST ? t->typed : "");
}

static void print_targets(const bt_calibration* c, const bt_fit* fit) {
    printf("%-60s %-12s %-14s %-14s %s\n", "target", "wanted", "before", "got", "error");
    for (int i = 0; i < c->target_count; ++i) {
        const bt_target* t = &c->targets[i];
        char wanted[96], before[96], got[96], error[32];
        wish_text(t, wanted, sizeof wanted);
        target_text(t, fit->before[i].got, before, sizeof before);
        target_text(t, fit->targets[i].got, got, sizeof got);
        if (t->kind == BT_TARGET_VALUE && t->wanted != 0)
            snprintf(error, sizeof error, "%+.2f %%", 100 * (fit->targets[i].got / t->wanted - 1));
        else
            snprintf(error, sizeof error, "%.2f tolerances", fit->targets[i].residual);
        printf("%-60.60s %-12s %-14s %-14s %s%s\n", t->name, wanted, before, got, error,
               fit->targets[i].met ? "" : "  NOT MET");
    }
}

static void print_parameters(const bt_calibration* c, const bt_fit* fit) {
    printf("\n%-44s %-14s %-14s %-22s %s\n", "parameter", "start", "found", "standard error",
           "by the data");
    for (int k = 0; k < c->parameter_count; ++k) {
        const bt_parameter* p = &c->parameters[k];
        char start[96], found[96], error[96], shown[128];
        const double share = 100 * fit->standard_error[k] * sqrt(12.0) / (p->upper - p->lower);
        bt_calibration_text(p->start, p->typed, start, sizeof start);
        bt_calibration_text(fit->value[k], p->typed, found, sizeof found);
        bt_calibration_text(fit->standard_error[k], p->typed, error, sizeof error);
        snprintf(shown, sizeof shown, "%s (%.0f %%)", error, share);
        printf("%-44s %-14s %-14s %-22s %s\n", p->path, start, found, shown,
               fit->identified[k] ? "identified" : "NOT identified");
    }
    printf("(in brackets: of the standard error before any data, when only the bounds are known; "
           "identified: below 50 %%)\n");
}

static void print_sensitivity(const bt_calibration* c, const bt_fit* fit) {
    printf(
        "\nsensitivity: change of a target, in its tolerances, per tenth of a parameter's range\n");
    printf("%-60s", "");
    for (int k = 0; k < c->parameter_count; ++k)
        printf(" %9c", 'a' + k);
    putchar('\n');
    for (int i = 0; i < c->target_count; ++i) {
        printf("%-60.60s", c->targets[i].name);
        for (int k = 0; k < c->parameter_count; ++k)
            printf(" %9.2f", fit->sensitivity[i][k] / 10);
        putchar('\n');
    }
    for (int k = 0; k < c->parameter_count; ++k)
        printf("  %c: %s\n", 'a' + k, c->parameters[k].path);
}

static void print_directions(const bt_calibration* c, const bt_fit* fit) {
    printf("\ncombinations of parameters: the data identify %d of %d, by the same criterion\n",
           fit->identified_directions, c->parameter_count);
    for (int i = 0; i < c->parameter_count; ++i) {
        printf("  %10.3g  %-14s", fit->singular[i],
               i < fit->identified_directions ? "identified" : "not identified");
        for (int k = 0; k < c->parameter_count; ++k)
            printf(" %+.2f %c", fit->direction[i][k], 'a' + k);
        putchar('\n');
    }
    printf("correlations\n");
    for (int a = 0; a < c->parameter_count; ++a) {
        printf("  %c", 'a' + a);
        for (int b = 0; b <= a; ++b)
            printf(" %6.2f", fit->correlation[a][b]);
        putchar('\n');
    }
}

static bool all_met(const bt_calibration* c, const bt_fit* fit) {
    for (int i = 0; i < c->target_count; ++i)
        if (!fit->targets[i].met)
            return false;
    return true;
}

static void print_fit(const bt_calibration* c, const bt_fit* fit, double seconds,
                      const char* file) {
    print_targets(c, fit);
    print_parameters(c, fit);
    print_sensitivity(c, fit);
    print_directions(c, fit);
    printf("\n%d steps, %d runs of the model, %.1f s; cost %.4g, at the start %.4g%s\n", fit->steps,
           fit->landings, seconds, fit->cost, fit->start_cost,
           fit->converged ? "" : "; NOT converged, allow more `steps`");
    if (!all_met(c, fit))
        printf("Some targets are not met: nothing within the bounds does better near here; "
               "`starts: 8` looks elsewhere too.\n");
    printf("%s holds the values found; use it with --set @%s\n", file, file);
}

// --- for programs -----------------------------------------------------------------------------

static void write_targets(bt_json* json, const bt_calibration* c, const bt_fit* fit) {
    bt_json_begin_array(json, "targets");
    for (int i = 0; i < c->target_count; ++i) {
        const bt_target* t = &c->targets[i];
        bt_json_begin_object(json, NULL);
        bt_json_string(json, "name", t->name);
        bt_json_string(json, "unit", bt_unit_text(t->token));
        bt_json_number(json, "wanted", t->kind <= BT_TARGET_AT_LEAST ? t->wanted : NAN);
        bt_json_number(json, "before", fit->before[i].got);
        bt_json_number(json, "got", fit->targets[i].got);
        bt_json_number(json, "residual_tolerances", fit->targets[i].residual);
        bt_json_bool(json, "met", fit->targets[i].met);
        bt_json_begin_array(json, "sensitivity");
        for (int k = 0; k < c->parameter_count; ++k)
            bt_json_number(json, NULL, fit->sensitivity[i][k]);
        bt_json_end_array(json);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}

static void write_parameters(bt_json* json, const bt_calibration* c, const bt_fit* fit) {
    bt_json_begin_array(json, "parameters");
    for (int k = 0; k < c->parameter_count; ++k) {
        const bt_parameter* p = &c->parameters[k];
        bt_json_begin_object(json, NULL);
        bt_json_string(json, "path", p->path);
        bt_json_string(json, "unit",
                       p->field->kind == BT_FIELD_REAL ? bt_unit_text(p->field->unit) : "");
        bt_json_number(json, "lower", p->lower);
        bt_json_number(json, "upper", p->upper);
        bt_json_number(json, "start", p->start);
        bt_json_number(json, "value", fit->value[k]);
        bt_json_number(json, "standard_error", fit->standard_error[k]);
        bt_json_bool(json, "identified", fit->identified[k]);
        bt_json_begin_array(json, "correlation");
        for (int b = 0; b < c->parameter_count; ++b)
            bt_json_number(json, NULL, fit->correlation[k][b]);
        bt_json_end_array(json);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}

static void write_fit(bt_json* json, const bt_calibration* c, const bt_fit* fit, double seconds,
                      const char* file) {
    bt_json_begin_object(json, NULL);
    write_parameters(json, c, fit);
    write_targets(json, c, fit);
    bt_json_begin_array(json, "singular_directions");
    for (int i = 0; i < c->parameter_count; ++i) {
        bt_json_begin_object(json, NULL);
        bt_json_number(json, "singular_value", fit->singular[i]);
        bt_json_bool(json, "identified", i < fit->identified_directions);
        bt_json_begin_array(json, "direction");
        for (int k = 0; k < c->parameter_count; ++k)
            bt_json_number(json, NULL, fit->direction[i][k]);
        bt_json_end_array(json);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
    bt_json_bool(json, "converged", fit->converged);
    bt_json_bool(json, "met", all_met(c, fit));
    bt_json_number(json, "start_cost", fit->start_cost);
    bt_json_number(json, "cost", fit->cost);
    bt_json_integer(json, "steps", fit->steps);
    bt_json_integer(json, "runs", fit->landings);
    bt_json_number(json, "seconds", seconds);
    bt_json_string(json, "overlay", file);
    bt_json_end_object(json);
}

// --- verb -------------------------------------------------------------------------------------

static void show_progress(void* user, int step, double cost) {
    bt_progress_show(user, false, "step %d, cost %.4g", step, cost);
}

static bt_status write_overlay(const bt_calibration* c, const bt_fit* fit, const char* file,
                               bt_diag* diag) {
    char* text = NULL;
    size_t size = 0;
    BT_TRY(bt_calibration_overlay(c, fit, &text, &size));
    const bt_status status =
        bt_file_replace(file, text, size, strlen("# Calibrated by bolter"), diag);
    free(text);
    return status;
}

static bt_status calibrate(const bt_command* command, const bt_calibration* c, const char* file) {
    bt_diag diag = bt_stderr_diag();
    bt_progress progress = bt_progress_start("calibrate", command->quiet);
    const double start_s = bt_clock_s();
    bt_fit* fit = malloc(sizeof *fit);
    if (!fit)
        return BT_ERR_MEMORY;
    bt_status status = bt_calibration_fit(c, fit, &bt_interrupted, show_progress, &progress, &diag);
    const double seconds = bt_clock_s() - start_s;
    if (status == BT_ERR_INTERRUPTED)
        fprintf(stderr, "calibrate: interrupted after %d steps, nothing was written\n", fit->steps);
    if (status == BT_OK) {
        bt_progress_show(&progress, true, "step %d, cost %.4g", fit->steps, fit->cost);
        status = write_overlay(c, fit, file, &diag);
    }
    if (status == BT_OK && command->json) {
        bt_json json = {.out = stdout};
        write_fit(&json, c, fit, seconds, file);
    } else if (status == BT_OK)
        print_fit(c, fit, seconds, file);
    free(fit);
    return status;
}

/// Fits and writes the overlay: where -o says, or calibrated.yaml in the study directory.
static bt_status calibrate_into(const bt_command* command, const bt_study* study,
                                const bt_calibration* c) {
    if (bt_output_kind(command->output) == BT_OUTPUT_VALUES)
        return calibrate(command, c, command->output);
    char file[BT_FILE_PATH_MAX];
    bt_diag diag = bt_stderr_diag();
    bt_directory directory;
    BT_TRY(bt_file_path(file, study->directory, "calibrated.yaml"));
    BT_TRY(bt_directory_open(&directory, study->directory, &diag));
    const bt_status status = calibrate(command, c, file);
    bt_directory_close(&directory);
    return status;
}

static bt_status run(const bt_command* command) {
    bt_diag diag = bt_stderr_diag();
    bt_study study;
    BT_TRY(bt_command_rigs(command, &study));
    bt_calibration* c = malloc(sizeof *c);
    bt_status status = BT_ERR_MEMORY;
    if (c)
        status = bt_calibration_read(command->words[1], &study, c, &diag);
    if (status == BT_OK) {
        status = calibrate_into(command, &study, c);
        bt_calibration_destroy(c);
    }
    free(c);
    bt_study_destroy(&study);
    return status;
}

const bt_verb bt_verb_calibrate = {
    .name = "calibrate",
    .summary = "find keys that meet measurements, and say which the data tell",
    .arguments = "STUDY.yaml CALIBRATION.yaml",
    .text =
        "Finds values of chosen keys, within bounds, with which landings and rigs meet the targets "
        "of a calibration file (see studies/reference/calibration.yaml): values with tolerances, "
        "bounds, trends, measured curves. Prints the fit, how sensitive each target is, and which "
        "parameters and combinations of them the data do not identify.\n\n"
        "  bolter calibrate study.yaml calibration.yaml           writes what it found\n"
        "  bolter land study.yaml --set @study/calibrated.yaml    uses it\n\n"
        "What is found goes into calibrated.yaml in the study directory, or where -o says.",
    .least_words = 2,
    .most_words = 2,
    .outputs = BT_OUTPUT_VALUES | BT_OUTPUT_DIRECTORY,
    .run = run,
};
