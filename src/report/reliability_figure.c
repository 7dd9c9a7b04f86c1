#include "report/reliability_figure.h"

#include "base/directory.h"
#include "base/text.h"
#include "report/display.h"
#include "report/figure.h"
#include "report/figure_text.h"
#include "report/reliability_csv.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// --- figure -----------------------------------------------------------------------------------

/// The paper's figure of an input; 0: none.
static int paper_figure(const char* path) {
    static const struct {
        const char* path;
        int number;
    } figures[] = {{"landing.sink_speed", 19},
                   {"landing.pitch", 20},
                   {"landing.horizontal_speed", 21},
                   {"landing.distance", 22}};
    for (size_t i = 0; i < sizeof figures / sizeof figures[0]; ++i)
        if (strcmp(path, figures[i].path) == 0)
            return figures[i].number;
    return 0;
}

static void name_figure(const bt_study* study, const bt_input* input, char name[160]) {
    const int number = bt_study_is_reference(study) ? paper_figure(input->path) : 0;
    if (number)
        snprintf(name, 160, "fig%d", number);
    else
        snprintf(name, 160, "reliability_%s", input->path);
    for (char* c = name; *c; ++c)
        if (!isalnum((unsigned char)*c))
            *c = '_';
}

/// Where figures go: into a folder, or onto `out`.
typedef struct target {
    const char* folder;
    FILE* out;
    bt_diag* diag;
} target;

static bt_status draw(const bt_study* study, const bt_input* input, const bt_reliability_curve* c,
                      const target* to) {
    char name[160], title[512], label[BT_PATH_MAX], x_label[BT_PATH_MAX + 64];
    double factor;
    const char* unit = bt_display_unit(input->field, &factor);
    const int number = bt_study_is_reference(study) ? paper_figure(input->path) : 0;
    bt_display_label(input->path, label, sizeof label);
    name_figure(study, input, name);
    snprintf(x_label, sizeof x_label, "mean of %s%s%s", label, *unit ? ", " : "", unit);
    const int used = snprintf(title, sizeof title, "%s: reliability over %s", study->title, label);
    if (number && used > 0 && (size_t)used < sizeof title)
        snprintf(title + used, sizeof title - (size_t)used, " (Fig. %d)", number);
    const bt_series series[] = {{.label = "corrected, 95 % interval",
                                 .style = BT_SERIES_LINE_POINTS,
                                 .count = c->count,
                                 .x = c->at[BT_CURVE_VALUE],
                                 .y = c->at[BT_CURVE_CORRECTED],
                                 .low = c->at[BT_CURVE_LEAST],
                                 .high = c->at[BT_CURVE_GREATEST]},
                                {.label = "classifier alone",
                                 .style = BT_SERIES_POINTS,
                                 .count = c->count,
                                 .x = c->at[BT_CURVE_VALUE],
                                 .y = c->at[BT_CURVE_SURROGATE]}};
    const bt_figure figure = {.name = name,
                              .title = title,
                              .x_label = x_label,
                              .y_label = "probability of engagement, %",
                              .key_below = true,
                              .x_free = true,
                              .series_count = 2,
                              .series = series};
    if (!to->out)
        return bt_figure_write(&figure, to->folder, to->diag);
    bt_figure_print(&figure, to->out);
    return BT_OK;
}

/// Into the unit that people use, and percent.
static void to_display(bt_reliability_curve* c, double factor) {
    for (int k = 0; k < BT_CURVE_COLUMNS; ++k)
        for (int i = 0; i < c->count; ++i)
            c->at[k][i] *= k == BT_CURVE_VALUE ? factor : 100;
}

enum { WIDTHS = 4, WIDTH_ROWS = 64 };

/// Columns of convergence.csv: landings, overall, median, largest; widths in points.
typedef struct width_curve {
    int count;
    double at[WIDTHS][WIDTH_ROWS];
} width_curve;

/// Rows that are no four numbers (the heading, widths that were not known) are left out.
static void read_widths(const char* text, width_curve* c) {
    c->count = 0;
    for (const char* line = text; line && c->count < WIDTH_ROWS;) {
        const char* at = line;
        int k = 0;
        for (; k < WIDTHS; ++k) {
            const char* end = bt_text_scan_number(at, &c->at[k][c->count]);
            if (end == at)
                break;
            c->at[k][c->count] *= k ? 100 : 1;
            at = *end == ',' ? end + 1 : end;
        }
        c->count += k == WIDTHS;
        line = strchr(line, '\n');
        line = line ? line + 1 : NULL;
    }
}

static bt_status draw_widths(const bt_study* study, const target* to) {
    static const char* const labels[WIDTHS] = {"", "as it stands", "median condition",
                                               "widest condition"};
    char path[BT_FILE_PATH_MAX], title[512], *text = NULL;
    width_curve c;
    BT_TRY(bt_file_path(path, study->directory, "convergence.csv"));
    if (access(path, F_OK) != 0)
        return BT_OK;
    BT_TRY(bt_file_read(path, &text, NULL, to->diag));
    read_widths(text, &c);
    free(text);
    if (c.count < 2)
        return BT_OK;
    snprintf(title, sizeof title, "%s: half-width over landings", study->title);
    bt_series series[WIDTHS - 1];
    for (int k = 1; k < WIDTHS; ++k)
        series[k - 1] = (bt_series){.label = labels[k],
                                    .style = BT_SERIES_LINE_POINTS,
                                    .count = c.count,
                                    .x = c.at[0],
                                    .y = c.at[k]};
    const bt_figure figure = {.name = "convergence",
                              .title = title,
                              .x_label = "landings",
                              .y_label = "half-width of the 95 % interval, points",
                              .key_below = true,
                              .from_zero = true,
                              .series_count = WIDTHS - 1,
                              .series = series};
    return bt_figure_write(&figure, to->folder, to->diag);
}

static bt_status draw_all(const bt_study* study, const target* to) {
    bt_reliability_csv* csv = NULL;
    bt_status status = bt_reliability_csv_read(study, &csv, to->diag);
    for (int i = 0; csv && i < study->input_count && status == BT_OK; ++i) {
        bt_reliability_curve c;
        double factor;
        bt_display_unit(study->inputs[i].field, &factor);
        bt_reliability_csv_curve(csv, study->inputs[i].path, &c);
        to_display(&c, factor);
        if (c.count > 1)
            status = draw(study, &study->inputs[i], &c, to);
    }
    bt_reliability_csv_destroy(csv);
    if (status == BT_OK && !to->out)
        status = draw_widths(study, to);
    return status;
}

bt_status bt_reliability_draw(const bt_study* study, const char* folder, bt_diag* diag) {
    return draw_all(study, &(target){.folder = folder, .diag = diag});
}

bt_status bt_reliability_print(const bt_study* study, FILE* out, bt_diag* diag) {
    return draw_all(study, &(target){.out = out, .diag = diag});
}
