#include "report/reliability_report.h"

#include "base/text.h"
#include "base/units.h"

#include <math.h>
#include <string.h>

static const bt_column columns[] = {
    {.name = "parameter", .head = "condition", .unit = ""},
    {.name = "value", .head = "mean", .unit = ""},
    {.name = "unit", .head = NULL, .unit = ""},
    {.name = "corrected", .head = "corrected", .unit = "", .decimals = 4, .interval = true},
    {.name = "corrected_sampling", .head = "sampling", .unit = "%", .scale = 100, .decimals = 2},
    {.name = "corrected_unseen", .head = "unseen", .unit = "%", .scale = 100, .decimals = 2},
    {.name = "landings", .head = NULL, .unit = ""},
    {.name = "reweighted", .head = "reweighted", .unit = "", .decimals = 4, .interval = true},
    {.name = "effective_landings", .head = "worth", .unit = "", .decimals = 0},
    {.name = "surrogate", .head = "surrogate", .unit = "", .decimals = 4, .interval = true},
    {.name = "samples", .head = NULL, .unit = ""},
    {.name = "disagreements", .head = "disagree", .unit = ""},
    {.name = "high_fidelity_runs", .head = NULL, .unit = ""},
    {.name = "high_fidelity_failed", .head = NULL, .unit = ""},
    {.name = "disagreement", .head = "share", .unit = "%", .scale = 100, .decimals = 2},
    {.name = "outside_share", .head = "outside", .unit = "%", .scale = 100, .decimals = 2},
};

static const char* name_of(const bt_reliability_row* row) {
    return row->parameter[0] ? row->parameter : "all as distributed";
}

/// The condition's mean in the unit people use: degrees for radians, SI for the rest.
static void value_text(const bt_reliability_row* row, char* text, size_t size) {
    char number[40];
    const bool angle = row->unit && !strcmp(row->unit, "rad");
    bt_text_print_rounded(angle ? row->value * 180 / M_PI : row->value, 4, number, sizeof number);
    const char* unit = angle ? "deg" : bt_unit_text(row->unit);
    snprintf(text, size, "%s%s%s", number, unit && *unit ? " " : "", unit ? unit : "");
}

static void add_row(bt_report_table* table, const bt_reliability_row* row) {
    char value[64] = "", disagree[48] = "not checked";
    const char* unit = row->parameter[0] && *row->unit ? bt_unit_text(row->unit) : "";
    const bool checked = row->high_fidelity_runs > 0;
    if (row->parameter[0])
        value_text(row, value, sizeof value);
    if (checked)
        snprintf(disagree, sizeof disagree, "%d of %d", row->disagreements,
                 row->high_fidelity_runs);
    bt_report_table_row(table);
    bt_report_table_text(table, name_of(row));
    bt_report_table_said(table, row->parameter[0] ? row->value : NAN, value);
    bt_report_table_text(table, unit ? unit : "");
    bt_report_table_interval(table, row->corrected, &row->corrected_ci95);
    bt_report_table_number(table, row->corrected_sampling);
    bt_report_table_number(table, row->corrected_unseen);
    bt_report_table_count(table, row->landings);
    bt_report_table_interval(table, row->reweighted, &row->reweighted_ci95);
    bt_report_table_number(table, row->effective_landings);
    bt_report_table_interval(table, row->surrogate, &row->surrogate_ci95);
    bt_report_table_count(table, row->samples);
    bt_report_table_said(table, checked ? (double)row->disagreements : NAN, disagree);
    bt_report_table_count(table, row->high_fidelity_runs);
    bt_report_table_count(table, row->high_fidelity_failed);
    bt_report_table_number(table, checked ? row->disagreement : NAN);
    bt_report_table_number(table, row->outside_share);
}

static void remark_outside(bt_report_table* table, const bt_reliability_row* far) {
    char value[64] = "";
    if (far->parameter[0])
        value_text(far, value, sizeof value);
    bt_report_table_remark(table,
                           "outside: share of the samples beyond the range of the training "
                           "landings; at worst (%s%s%s) the surrogate would give %.5f if all of "
                           "them missed and %.5f if all engaged",
                           name_of(far), *value ? " " : "", value, far->outside_missed,
                           far->outside_engaged);
}

static void remark_difference(bt_report_table* table, const bt_reliability_result* result,
                              const bt_reliability_difference* d) {
    char from[64], to[64];
    const bt_reliability_row* row = &result->condition[d->to];
    value_text(&result->condition[d->from], from, sizeof from);
    value_text(row, to, sizeof to);
    bt_report_table_remark(table, "%s, %s against %s: %+.4f [%+.4f, %+.4f]", row->parameter, to,
                           from, d->difference, d->ci95.least, d->ci95.greatest);
}

static void add_remarks(bt_report_table* table, const bt_reliability_result* result) {
    char samples[32];
    int failed = result->overall.high_fidelity_failed, runs = result->overall.high_fidelity_runs;
    const bt_reliability_row* far = &result->overall; // most samples outside the box
    for (int i = 0; i < result->condition_count; ++i) {
        failed += result->condition[i].high_fidelity_failed;
        runs += result->condition[i].high_fidelity_runs;
        if (result->condition[i].outside_share > far->outside_share)
            far = &result->condition[i];
    }
    bt_report_table_remark(table, "%s samples of the surrogate per row, %.1f s in all",
                           bt_count_text(result->overall.samples, samples), result->seconds);
    bt_report_table_remark(table, "intervals: 95 %%; the corrected one covers the error of the "
                                  "surrogate, the surrogate's own only the sampling");
    if (result->overall.pooled) {
        bt_report_table_remark(table,
                               "%s landings in all, each evidence for every row; sampling and "
                               "unseen: half-widths that what was seen gives, and that errors of a "
                               "kind never seen add",
                               bt_count_text(result->landings, samples));
        bt_report_table_remark(table, "reweighted: without any classifier; worth: landings of the "
                                      "condition alone that would weigh as much");
    }
    for (int i = 0; i < result->difference_count; ++i)
        remark_difference(table, result, &result->difference[i]);
    for (int i = 0; i < result->warning_count; ++i)
        bt_report_table_remark(table, "warning: %s", result->warning[i]);
    if (runs > 0) {
        bt_report_table_remark(table, "disagree: high-fidelity runs whose outcome differs from "
                                      "the surrogate's; share: weighted back to the distribution");
        bt_report_table_remark(table, "failed: %d of %d high-fidelity runs%s", failed, runs,
                               failed ? "; the corrected intervals hold either outcome for them"
                                      : "");
    }
    if (far->outside_share > 0)
        remark_outside(table, far);
}

bt_report_table* bt_reliability_table(const bt_reliability_result* result) {
    bt_report_table* table =
        bt_report_table_create(NULL, columns, (int)(sizeof columns / sizeof columns[0]));
    for (int i = 0; i < result->condition_count; ++i)
        add_row(table, &result->condition[i]);
    add_row(table, &result->overall);
    add_remarks(table, result);
    return table;
}

static bt_status write_text(FILE* out, const bt_reliability_result* result) {
    bt_report_table* table = bt_reliability_table(result);
    bt_status status = bt_report_table_print(table, out);
    bt_report_table_destroy(table);
    if (status != BT_OK || result->event_count == 0)
        return status;
    fputc('\n', out);
    bt_report_table* events = bt_reliability_event_table(result, false);
    status = bt_report_table_print(events, out);
    bt_report_table_destroy(events);
    return status;
}

static bt_status write_csv(FILE* out, const bt_reliability_result* result) {
    bt_report_table* table = bt_reliability_table(result);
    const bt_status status = bt_report_table_csv(table, out);
    bt_report_table_destroy(table);
    return status;
}

static bt_status write_event_csv(FILE* out, const bt_reliability_result* result) {
    bt_report_table* table = bt_reliability_event_table(result, true);
    const bt_status status = bt_report_table_csv(table, out);
    bt_report_table_destroy(table);
    return status;
}

/// The half-widths after every round, for reliability_figure.c and for other programs.
static bt_status write_widths(FILE* out, const bt_reliability_result* result) {
    fputs("landings,overall,median,largest\n", out);
    for (int i = 0; i < result->width_count; ++i) {
        const bt_width* w = &result->width[i];
        fprintf(out, "%lld,%.6g,%.6g,%.6g\n", (long long)w->landings, w->overall, w->median,
                w->largest);
    }
    return BT_OK;
}

static bt_status write_json(FILE* out, const bt_reliability_result* result) {
    bt_json json = {.out = out};
    bt_reliability_write_json(&json, result);
    return BT_OK;
}

const bt_reliability_file bt_reliability_files[] = {
    {"reliability.txt", write_text, false},  {"reliability.csv", write_csv, false},
    {"reliability.json", write_json, false}, {"convergence.csv", write_widths, false},
    {"events.csv", write_event_csv, true},   {NULL, NULL, false},
};
