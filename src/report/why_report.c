#include "report/why_report.h"

#include "report/display.h"
#include "report/table.h"

#include <math.h>

static const bt_column columns[] = {
    {.name = "input", .unit = "", .head = "input"},
    {.name = "change_sd", .unit = "", .head = "change, sd", .decimals = 3},
    {.name = "width_sd", .unit = ""},
    {.name = "value", .unit = "", .head = "to"},
    {.name = "outcome", .unit = "", .head = "then"},
    {.name = "mode", .unit = "", .head = "how"},
    {.name = "margin_m", .head = "margin", .unit = "mm", .scale = 1000, .decimals = 2},
    {.name = "reach_sd", .unit = ""},
};

/// "3.42 deg", as people write it.
static void print_value(const bt_input* input, double value, char* text, size_t size) {
    double factor;
    const char* unit = bt_display_unit(input->field, &factor);
    snprintf(text, size, "%.4g%s%s", factor * value, *unit ? " " : "", unit);
}

static void add_flip(bt_report_table* table, const bt_study* study, const bt_axes* axes,
                     const bt_flip* f) {
    const bt_input* input = &study->inputs[axes->input[f->axis]];
    char value[64];
    print_value(input, f->value, value, sizeof value);
    bt_report_table_row(table);
    bt_report_table_text(table, input->path);
    bt_report_table_number(table, f->change_sd);
    bt_report_table_number(table, f->width_sd);
    bt_report_table_said(table, f->value, value);
    bt_report_table_text(table, bt_outcome_name(f->outcome));
    bt_report_table_text(table, bt_mode_name(f->mode));
    bt_report_table_number(table, f->margin_m);
    bt_report_table_number(table, f->reach_sd);
}

static bt_report_table* flips_table(const bt_why* why) {
    const bt_axes axes = bt_design_axes(why->study);
    bt_report_table* table =
        bt_report_table_create(NULL, columns, sizeof columns / sizeof columns[0]);
    int silent = 0;
    for (int i = 0; i < why->flips->count; ++i)
        if (why->flips->at[i].found)
            add_flip(table, why->study, &axes, &why->flips->at[i]);
        else
            ++silent;
    if (silent > 0)
        bt_report_table_remark(table,
                               "No other outcome in %d of %d directions, looked at up to %g sd or "
                               "the end of the distribution.",
                               silent, why->flips->count, BT_FLIP_REACH_SD);
    return table;
}

static void print_landing(const bt_why* why, FILE* out) {
    const bt_landing_result* r = why->result;
    const bt_axes axes = bt_design_axes(why->study);
    if (why->run >= 0)
        fprintf(out, "Landing %lld of \"%s\": ", (long long)why->run, why->study->title);
    else
        fprintf(out, "The landing of \"%s\": ", why->study->title);
    fprintf(out, "%s, %s: %s", bt_outcome_name(r->outcome), bt_mode_name(r->mode),
            bt_mode_text(r->mode));
    if (isfinite(r->margin_m))
        fprintf(out, "; margin %.1f mm", 1e3 * r->margin_m);
    fprintf(out, "\n");
    for (int i = 0; i < axes.count; ++i) {
        const bt_input* input = &why->study->inputs[axes.input[i]];
        char label[BT_PATH_MAX], value[64];
        bt_display_label(input->path, label, sizeof label);
        print_value(input, why->x[i], value, sizeof value);
        fprintf(out, "%s%s %s", i ? ", " : "  ", label, value);
    }
    fprintf(out, "\n\n");
}

static void print_timeline(const bt_why* why, FILE* out) {
    const bt_timeline* t = why->timeline;
    for (int i = 0; i < t->count; ++i)
        fprintf(out, "%8.4f s  %s\n", t->at[i].time_s, t->at[i].what);
    fprintf(out, "\n");
}

static void print_nearest(const bt_why* why, FILE* out) {
    const bt_flip* f = &why->flips->at[0];
    if (why->flips->count == 0 || !f->found) {
        fprintf(out,
                "No change of one input alone, up to %g sd, changes the outcome (%d landings).\n",
                BT_FLIP_REACH_SD, why->flips->landings);
        return;
    }
    const bt_axes axes = bt_design_axes(why->study);
    const bt_input* input = &why->study->inputs[axes.input[f->axis]];
    char label[BT_PATH_MAX], from[64], to[64];
    bt_display_label(input->path, label, sizeof label);
    print_value(input, why->x[f->axis], from, sizeof from);
    print_value(input, f->value, to, sizeof to);
    fprintf(out,
            "Nearest flip: %s %.3f sd %s, from %s to %s: %s, %s. The smallest change of each input "
            "alone, by %d landings:\n\n",
            label, fabs(f->change_sd), f->change_sd > 0 ? "up" : "down", from, to,
            bt_outcome_name(f->outcome), bt_mode_text(f->mode), why->flips->landings);
}

bt_status bt_why_print(const bt_why* why, FILE* out) {
    print_landing(why, out);
    print_timeline(why, out);
    if (why->result->outcome == BT_FAILED)
        return BT_OK;
    print_nearest(why, out);
    if (why->flips->count == 0 || !why->flips->at[0].found)
        return BT_OK;
    bt_report_table* table = flips_table(why);
    const bt_status status = bt_report_table_print(table, out);
    bt_report_table_destroy(table);
    return status;
}

bt_status bt_why_json(const bt_why* why, FILE* out) {
    bt_json json = {.out = out};
    bt_report_table* table = flips_table(why);
    bt_json_begin_object(&json, NULL);
    bt_json_integer(&json, "run", why->run);
    bt_json_string(&json, "outcome", bt_outcome_name(why->result->outcome));
    bt_json_string(&json, "mode", bt_mode_name(why->result->mode));
    bt_json_number(&json, "margin_m", why->result->margin_m);
    bt_json_begin_array(&json, "events");
    for (int i = 0; i < why->timeline->count; ++i) {
        bt_json_begin_object(&json, NULL);
        bt_json_number(&json, "time_s", why->timeline->at[i].time_s);
        bt_json_string(&json, "what", why->timeline->at[i].what);
        bt_json_end_object(&json);
    }
    bt_json_end_array(&json);
    const bt_status status = bt_report_table_json(table, &json, "flips");
    bt_json_integer(&json, "landings", why->flips->landings);
    bt_json_end_object(&json);
    bt_report_table_destroy(table);
    return status;
}
