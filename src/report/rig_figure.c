#include "report/figure.h"
#include "report/rig_report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// One line of a figure.
typedef struct trace {
    const char *channel, *label;
    double scale;
    bool second; ///< axis at the right
} trace;

enum { TRACES_MAX = 2, TITLE_SIZE = 400 };

/// One of the rig's figures, over time or over the stroke.
typedef struct plan {
    bt_rig_kind kind;
    const char *name, *title, *y_label, *y2_label;
    bool impact;      ///< only the first impact is shown
    bool over_stroke; ///< instead of over time
    trace traces[TRACES_MAX];
} plan;

static const plan plans[] = {
    {BT_RIG_NOSE_DROP,
     "nose_drop_stroke",
     "Drop of the nose gear: strut and centre of gravity",
     "stroke, sinkage, mm",
     NULL,
     false,
     false,
     {{"stroke_m", "stroke of the strut", 1e3, false},
      {"sinkage_m", "sinkage of the centre of gravity", 1e3, false}}},
    {BT_RIG_NOSE_DROP,
     "nose_drop_tyre",
     "Drop of the nose gear: tyre",
     "compression, mm",
     "load, kN",
     false,
     false,
     {{"tyre_compression_m", "compression, left axis", 1e3, false},
      {"tyre_force_N", "load, right axis", 1e-3, true}}},
    {BT_RIG_NOSE_DROP,
     "nose_drop_strut",
     "Drop of the nose gear: the strut",
     "load, kN",
     NULL,
     false,
     true,
     {{"strut_force_N", "load of the strut", 1e-3, false}}},
    {BT_RIG_MAIN_DROP,
     "main_drop_stroke",
     "Drop of the main gear: strut and centre of gravity",
     "stroke, sinkage, mm",
     NULL,
     false,
     false,
     {{"stroke_m", "stroke of the strut", 1e3, false},
      {"sinkage_m", "sinkage of the centre of gravity", 1e3, false}}},
    {BT_RIG_MAIN_DROP,
     "main_drop_tyre",
     "Drop of the main gear: tyre",
     "compression, mm",
     "load, kN",
     false,
     false,
     {{"tyre_compression_m", "compression, left axis", 1e3, false},
      {"tyre_force_N", "load, right axis", 1e-3, true}}},
    {BT_RIG_MAIN_DROP,
     "main_drop_strut",
     "Drop of the main gear: the strut",
     "load, kN",
     NULL,
     false,
     true,
     {{"strut_force_N", "load of the strut", 1e-3, false}}},
    {BT_RIG_HOOK_REBOUND,
     "hook_rebound_height",
     "Rebound of the hook: the head above the disc",
     "height, mm",
     "stroke of the damper, mm",
     false,
     false,
     {{"hook_height_m", "height of the head, left axis", 1e3, false},
      {"damper_stroke_m", "stroke of the damper, right axis", 1e3, true}}},
    {BT_RIG_HOOK_REBOUND,
     "hook_rebound_impact",
     "Rebound of the hook: load of the first impact",
     "load, kN",
     NULL,
     true,
     false,
     {{"hook_force_N", "load of the disc on the head", 1e-3, false}}},
    {BT_RIG_NOSE_STATIC,
     "nose_static_strut",
     "Static test of the nose gear: load over stroke",
     "load, kN",
     NULL,
     false,
     true,
     {{"strut_force_N", "while shortening", 1e-3, false},
      {"opening_force_N", "while extending", 1e-3, false}}},
    {BT_RIG_MAIN_STATIC,
     "main_static_strut",
     "Static test of the main gear: load over stroke",
     "load, kN",
     NULL,
     false,
     true,
     {{"strut_force_N", "while shortening", 1e-3, false},
      {"opening_force_N", "while extending", 1e-3, false}}},
};
enum { PLAN_COUNT = sizeof plans / sizeof plans[0] };

/// The series of a figure with the numbers drawn, which it owns.
typedef struct drawing {
    bt_series series[TRACES_MAX + BT_CURVES_MAX];
    double* numbers[2 * (TRACES_MAX + BT_CURVES_MAX)];
    char labels[TRACES_MAX + BT_CURVES_MAX][96];
    int count, number_count;
} drawing;

static double* scaled(drawing* d, const double* values, int count, double scale) {
    double* copy = malloc((size_t)(count > 0 ? count : 1) * sizeof *copy);
    if (!copy)
        return NULL;
    for (int i = 0; i < count; ++i)
        copy[i] = scale * values[i];
    return d->numbers[d->number_count++] = copy;
}

static void add(drawing* d, const char* label, bt_series_style style, const double* x,
                double x_scale, const double* y, int count, double scale, bool second) {
    const double *across = scaled(d, x, count, x_scale), *drawn = scaled(d, y, count, scale);
    if (!across || !drawn)
        return;
    snprintf(d->labels[d->count], sizeof d->labels[0], "%s", label);
    d->series[d->count] = (bt_series){.label = d->labels[d->count],
                                      .style = style,
                                      .count = count,
                                      .x = across,
                                      .y = drawn,
                                      .second = second};
    ++d->count;
}

static int column_of(const bt_rig_record* record, const char* channel) {
    int column = 1;
    while (strcmp(record->names[column], channel) != 0)
        ++column;
    return column;
}

/// The file's name without its folder, for the key.
static const char* base_name(const char* path) {
    const char* slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

enum { THINNED_MAX = 4100 };

/// Rows that are drawn, not much above 4000: a run of fine steps would make pictures of megabytes.
static int thinned(const double* values, int rows, double* kept) {
    const int stride = 1 + rows / 4000;
    int count = 0;
    for (int i = 0; i < rows; i += stride)
        kept[count++] = values[i];
    if (rows > 0 && (rows - 1) % stride != 0)
        kept[count++] = values[rows - 1];
    return count;
}

static void add_measured(drawing* d, const bt_measured* m, double x_scale, double scale,
                         bool second) {
    char label[96];
    double* x = malloc(THINNED_MAX * sizeof *x);
    double* y = malloc(THINNED_MAX * sizeof *y);
    snprintf(label, sizeof label, "%s (%.60s)", m->y_name, base_name(m->file));
    if (x && y) {
        const int count = thinned(m->x, m->count, x);
        thinned(m->y, m->count, y);
        add(d, label, BT_SERIES_POINTS, x, x_scale, y, count, scale, second);
    }
    free(x);
    free(y);
}

/// Until when the first impact lasts, and half as long again, s.
static double impact_end_s(const bt_rig_record* record) {
    const double* force = record->columns[column_of(record, "hook_force_N")];
    const double* height = record->columns[column_of(record, "hook_height_m")];
    int last = 0;
    for (int i = 0; i < record->count && height[i] < 1e-3; ++i)
        if (force[i] > 0)
            last = i;
    return 1.5 * record->columns[0][last];
}

static int rows_until(const bt_rig_record* record, double time_s) {
    int rows = 0;
    while (rows < record->count && record->columns[0][rows] <= time_s)
        ++rows;
    return rows;
}

static bt_status write(drawing* d, const bt_figure* about, const char* folder, bt_diag* diag) {
    bt_figure figure = *about;
    figure.series_count = d->count;
    figure.series = d->series;
    const bt_status status = bt_figure_write(&figure, folder, diag);
    for (int i = 0; i < d->number_count; ++i)
        free(d->numbers[i]);
    return status;
}

static void add_line(drawing* d, const bt_rig_record* record, const trace* line, int across,
                     int rows) {
    double* x = malloc(THINNED_MAX * sizeof *x);
    double* y = malloc(THINNED_MAX * sizeof *y);
    if (x && y) {
        const int count = thinned(record->columns[across], rows, x);
        thinned(record->columns[column_of(record, line->channel)], rows, y);
        add(d, line->label, BT_SERIES_LINE, x, 1e3, y, count, line->scale, line->second);
    }
    free(x);
    free(y);
}

/// Whether a trace says nothing that the one before does not: a strut without friction on the
/// press.
static bool repeats(const bt_rig_record* record, const plan* p, int t) {
    if (t == 0 || p->traces[t].second || strcmp(p->traces[t].channel, "opening_force_N") != 0)
        return false;
    const double* a = record->columns[column_of(record, p->traces[t - 1].channel)];
    const double* b = record->columns[column_of(record, p->traces[t].channel)];
    double most = 0, apart = 0;
    for (int i = 0; i < record->count; ++i) {
        most = fmax(most, fabs(a[i]));
        apart = fmax(apart, fabs(a[i] - b[i]));
    }
    return apart < 1e-3 * most;
}

/// Whether what lies below zero is too little to be seen: the axis then begins there.
static bool begins_at_zero(const drawing* d) {
    double least = 0, most = 0;
    for (int s = 0; s < d->count; ++s)
        for (int i = 0; i < d->series[s].count && !d->series[s].second; ++i) {
            least = fmin(least, d->series[s].y[i]);
            most = fmax(most, d->series[s].y[i]);
        }
    return -least < 0.01 * most;
}

/// The paper's number of a figure; 0 for none.
static int paper_number(const char* name) {
    static const struct {
        const char* name;
        int number;
    } numbered[] = {{"nose_drop_stroke", 9},
                    {"nose_drop_tyre", 10},
                    {"main_drop_stroke", 11},
                    {"main_drop_tyre", 12}};
    for (size_t i = 0; i < sizeof numbered / sizeof numbered[0]; ++i)
        if (strcmp(numbered[i].name, name) == 0)
            return numbered[i].number;
    return 0;
}

/// "Title of the study: what is shown"; of the reference study with the paper's number.
static void title_of(const bt_study* study, const plan* p, char* title) {
    const int number = bt_study_is_reference(study) ? paper_number(p->name) : 0;
    const int used = snprintf(title, TITLE_SIZE, "%s: %s", study->title, p->title);
    if (number > 0 && used < TITLE_SIZE)
        snprintf(title + used, (size_t)(TITLE_SIZE - used), " (Fig. %d)", number);
}

static bt_status draw_plan(const plan* p, const char* title, const bt_rig_record* record,
                           const bt_rig_curves* curves, bool* drawn, const char* folder,
                           bt_diag* diag) {
    drawing d = {0};
    const double end = p->impact ? impact_end_s(record) : record->columns[0][record->count - 1];
    const int rows = rows_until(record, end);
    const int across = p->over_stroke ? column_of(record, "stroke_m") : 0;
    for (int t = 0; t < TRACES_MAX && p->traces[t].channel; ++t)
        if (!repeats(record, p, t))
            add_line(&d, record, &p->traces[t], across, rows);
    for (int t = 0; t < TRACES_MAX && p->traces[t].channel; ++t)
        for (int i = 0; i < curves->count; ++i)
            if (curves->measured[i]->x_column == across &&
                curves->measured[i]->y_column == column_of(record, p->traces[t].channel)) {
                add_measured(&d, curves->measured[i], 1e3, p->traces[t].scale, p->traces[t].second);
                drawn[i] = true;
            }
    const bt_figure figure = {
        .name = p->name,
        .title = title,
        .x_label = p->over_stroke ? "stroke, mm" : "time from first contact, ms",
        .y_label = p->y_label,
        .y2_label = p->y2_label,
        .key_below = true,
        .from_zero = begins_at_zero(&d),
    };
    return write(&d, &figure, folder, diag);
}

/// A curve that no planned figure shows: its two columns as they are.
static bt_status draw_curve(const bt_study* study, const bt_rig_record* record,
                            const bt_measured* m, const char* folder, bt_diag* diag) {
    drawing d = {0};
    char name[192];
    const char *x = record->names[m->x_column], *y = record->names[m->y_column];
    snprintf(name, sizeof name, "%s_%s_over_%s", bt_rig_keys[record->kind], y, x);
    add(&d, "computed", BT_SERIES_LINE, record->columns[m->x_column], 1,
        record->columns[m->y_column], record->count, 1, false);
    add_measured(&d, m, 1, 1, false);
    const bt_figure figure = {
        .name = name, .title = study->title, .x_label = x, .y_label = y, .key_below = true};
    return write(&d, &figure, folder, diag);
}

bt_status bt_rig_draw(const bt_study* study, const bt_rig_record* record,
                      const bt_rig_curves* curves, const char* folder, bt_diag* diag) {
    bool drawn[BT_CURVES_MAX] = {false};
    if (record->out_of_memory)
        return BT_ERR_MEMORY;
    for (int i = 0; i < PLAN_COUNT; ++i)
        if (plans[i].kind == record->kind) {
            char title[TITLE_SIZE];
            title_of(study, &plans[i], title);
            BT_TRY(draw_plan(&plans[i], title, record, curves, drawn, folder, diag));
        }
    for (int i = 0; i < curves->count; ++i)
        if (!drawn[i])
            BT_TRY(draw_curve(study, record, curves->measured[i], folder, diag));
    return BT_OK;
}
