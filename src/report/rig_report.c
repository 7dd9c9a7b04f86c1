#include "report/rig_report.h"

#include "base/text.h"
#include "report/rig_loop.h"

#include <math.h>
#include <string.h>

void bt_rig_curve_error(const bt_rig_record* record, const bt_measured* measured, double* rms,
                        double* share) {
    double sum = 0, most = 0;
    int count = 0;
    const bool single = bt_rig_record_grows(record, measured->x_column);
    for (int i = 0; single && i < measured->count; ++i) {
        const double got =
            bt_rig_record_at(record, measured->y_column, measured->x_column, measured->x[i]);
        most = fmax(most, fabs(measured->y[i]));
        if (!isfinite(got))
            continue;
        sum += (got - measured->y[i]) * (got - measured->y[i]);
        ++count;
    }
    *rms = count > 0 ? sqrt(sum / count) : NAN;
    *share = most > 0 ? *rms / most : NAN;
}

// --- table ------------------------------------------------------------------------------------

static const bt_column columns[] = {
    {.name = "metric", .head = "metric", .unit = ""},
    {.name = "value", .head = "value", .unit = ""},
    {.name = "unit", .head = "unit", .unit = ""},
    {.name = "reference", .head = "reference", .unit = ""},
    {.name = "error_percent", .head = "error", .unit = "%", .decimals = 2},
    {.name = "tolerance_percent", .head = "tolerance", .unit = "%", .decimals = 1},
    {.name = "accepted", .head = "accepted", .unit = "", .flag = true},
};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0] };

/// Five digits, and no exponent where none is needed.
static void put_value(double value, char* text, size_t size) {
    if (fabs(value) >= 1e4 && fabs(value) < 1e9)
        snprintf(text, size, "%.0f", value);
    else
        bt_text_print_rounded(value, 5, text, size);
}

/// A value, or what is said where there is none.
static void add_value(bt_report_table* table, double value, const char* otherwise) {
    char text[40];
    put_value(value, text, sizeof text);
    bt_report_table_said(table, value, isfinite(value) ? text : otherwise);
}

static void add_metric(bt_report_table* table, const bt_metric* m, const char* without_value) {
    bt_report_table_row(table);
    bt_report_table_text(table, m->name);
    add_value(table, m->value, without_value);
    bt_report_table_text(table, strcmp(m->unit, "1") == 0 ? "" : m->unit);
    add_value(table, m->reference, "-");
    bt_report_table_number(table, m->error_percent);
    bt_report_table_number(table, isfinite(m->reference) ? 100 * m->tolerance : NAN);
    if (isfinite(m->error_percent))
        bt_report_table_flag_said(table, m->accepted, m->accepted ? "yes" : "NO");
    else
        bt_report_table_empty(table);
}

double bt_rig_point_tolerance(bt_rig_kind kind, const bt_rigs_params* rigs) {
    if (kind != BT_RIG_NOSE_STATIC && kind != BT_RIG_MAIN_STATIC)
        return 0;
    return bt_rig_is_nose(kind) ? rigs->nose_static.reference.tolerance
                                : rigs->main_static.reference.tolerance;
}

/// One point of a measured curve as if it were a metric.
static bt_metric point_of(const bt_rig_record* record, const bt_measured* m, int i,
                          double tolerance) {
    bt_metric p = {.name = record->names[m->y_column],
                   .unit = m->y_token,
                   .value = bt_rig_record_at(record, m->y_column, m->x_column, m->x[i]),
                   .reference = m->y[i],
                   .tolerance = tolerance};
    // no share of nothing: a point at 0 is drawn, and not judged
    p.error_percent = p.reference != 0 ? 100 * (p.value - p.reference) / fabs(p.reference) : NAN;
    p.accepted = fabs(p.error_percent) <= 100 * tolerance;
    return p;
}

static void add_points(bt_report_table* table, const bt_rig_record* record, const bt_measured* m,
                       double tolerance) {
    int good = 0, judged = 0;
    double worst = 0;
    for (int i = 0; i < m->count; ++i) {
        char name[64], x[40];
        bt_metric p = point_of(record, m, i, tolerance);
        put_value(m->x[i], x, sizeof x);
        snprintf(name, sizeof name, "  at %.30s %.20s", record->names[m->x_column], x);
        p.name = name;
        add_metric(table, &p, "beyond the run");
        if (!isfinite(p.error_percent))
            continue;
        ++judged;
        good += p.accepted;
        worst = fmax(worst, fabs(p.error_percent));
    }
    bt_report_table_remark(table, "%d of %d points within %g %%, largest error %.2f %%", good,
                           judged, 100 * tolerance, worst);
}

static void add_curve(bt_report_table* table, const bt_rig_record* record, const bt_measured* m,
                      double tolerance) {
    double rms, share;
    bt_rig_curve_error(record, m, &rms, &share);
    if (!isfinite(rms)) {
        bt_report_table_remark(table, "%s: %s over %s, drawn only", m->file, m->y_name, m->x_name);
        return;
    }
    bt_report_table_remark(table, "%s: rms difference %.4g in %s, %.1f %% of the largest measured",
                           m->file, rms, record->names[m->y_column], 100 * share);
    if (tolerance > 0)
        add_points(table, record, m, tolerance);
}

static void add_loop(bt_report_table* table, const bt_rig_record* record,
                     const bt_rig_curves* curves) {
    bt_loop_score s;
    if (!bt_rig_loop_score(record, curves->measured, curves->count, &s))
        return;
    bt_report_table_remark(
        table,
        "load over stroke, computed (measured): %.4g kJ (%.4g) to a stroke of "
        "%.4g mm (%.4g), efficiency %.3f (%.3f); area between the loops %.1f %% of "
        "the measured work",
        1e-3 * s.computed.energy_J, 1e-3 * s.measured.energy_J, 1e3 * s.computed.stroke_max_m,
        1e3 * s.measured.stroke_max_m, s.computed.efficiency, s.measured.efficiency,
        100 * s.area_share);
}

bt_report_table* bt_rig_table(const bt_rig_result* result, const bt_rig_record* record,
                              const bt_rig_curves* curves, double tolerance) {
    bt_report_table* table = bt_report_table_create(NULL, columns, COLUMN_COUNT);
    for (int i = 0; i < result->metric_count; ++i)
        add_metric(table, &result->metrics[i], "none");
    for (int i = 0; i < result->remark_count; ++i)
        bt_report_table_remark(table, "remark: %s at %.4g s", result->remarks[i].what,
                               result->remarks[i].time_s);
    for (int i = 0; i < curves->count; ++i)
        add_curve(table, record, curves->measured[i], tolerance);
    add_loop(table, record, curves);
    return table;
}

static void write_metric(bt_json* json, const bt_metric* m) {
    bt_json_begin_object(json, m->name);
    bt_json_number(json, "value", m->value);
    bt_json_string(json, "unit", m->unit);
    bt_json_number(json, "reference", m->reference);
    bt_json_number(json, "error_percent", m->error_percent);
    bt_json_number(json, "tolerance_percent", 100 * m->tolerance);
    if (isfinite(m->reference))
        bt_json_bool(json, "accepted", m->accepted);
    bt_json_end_object(json);
}

static void write_points(bt_json* json, const bt_rig_record* record, const bt_measured* m,
                         double tolerance) {
    bt_json_begin_array(json, "points");
    for (int i = 0; i < m->count; ++i) {
        const bt_metric p = point_of(record, m, i, tolerance);
        bt_json_begin_object(json, NULL);
        bt_json_number(json, record->names[m->x_column], m->x[i]);
        bt_json_number(json, "value", p.value);
        bt_json_number(json, "reference", p.reference);
        bt_json_number(json, "error_percent", p.error_percent);
        bt_json_bool(json, "accepted", p.accepted);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}

static void write_loop(bt_json* json, const char* key, const bt_loop* loop) {
    bt_json_begin_object(json, key);
    bt_json_number(json, "stroke_max_m", loop->stroke_max_m);
    bt_json_number(json, "force_max_N", loop->force_max_N);
    bt_json_number(json, "energy_J", loop->energy_J);
    bt_json_number(json, "efficiency", loop->efficiency);
    bt_json_end_object(json);
}

static void write_loops(bt_json* json, const bt_rig_record* record, const bt_rig_curves* curves) {
    bt_loop_score s;
    if (!bt_rig_loop_score(record, curves->measured, curves->count, &s))
        return;
    bt_json_begin_object(json, "load_over_stroke");
    write_loop(json, "measured", &s.measured);
    write_loop(json, "computed", &s.computed);
    bt_json_number(json, "area_between_percent", 100 * s.area_share);
    bt_json_end_object(json);
}

void bt_rig_write_json(bt_json* json, const bt_rig_result* result, const bt_rig_record* record,
                       const bt_rig_curves* curves, double tolerance) {
    bt_json_begin_object(json, "metrics");
    for (int i = 0; i < result->metric_count; ++i)
        write_metric(json, &result->metrics[i]);
    bt_json_end_object(json);
    bt_json_begin_array(json, "remarks");
    for (int i = 0; i < result->remark_count; ++i) {
        bt_json_begin_object(json, NULL);
        bt_json_string(json, "what", result->remarks[i].what);
        bt_json_string(json, "element", result->remarks[i].element);
        bt_json_number(json, "time_s", result->remarks[i].time_s);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
    bt_json_begin_array(json, "curves");
    for (int i = 0; i < curves->count; ++i) {
        double rms, share;
        bt_rig_curve_error(record, curves->measured[i], &rms, &share);
        bt_json_begin_object(json, NULL);
        bt_json_string(json, "file", curves->measured[i]->file);
        bt_json_string(json, "channel", record->names[curves->measured[i]->y_column]);
        bt_json_number(json, "rms", rms);
        bt_json_number(json, "rms_percent", 100 * share);
        if (tolerance > 0 && isfinite(rms))
            write_points(json, record, curves->measured[i], tolerance);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
    write_loops(json, record, curves);
    bt_json_integer(json, "steps", result->steps);
    bt_json_number(json, "end_time_s", result->end_time_s);
}
