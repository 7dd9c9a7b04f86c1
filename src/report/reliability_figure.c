#include "report/reliability_figure.h"

#include "base/directory.h"
#include "base/text.h"
#include "report/display.h"
#include "report/figure.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/// Columns of reliability.csv that are drawn.
enum { VALUE, CORRECTED, LEAST, GREATEST, SURROGATE, COLUMNS };
static const char* const column_names[COLUMNS] = {"value", "corrected", "corrected_least",
                                                  "corrected_greatest", "surrogate"};
enum { CELLS_MAX = 64 };

/// One input's conditions in the order of their means.
typedef struct curve {
    int count;
    double at[COLUMNS][BT_CONDITION_MAX]; ///< display unit; shares in percent
} curve;

/// Cuts a line at its commas, in place; returns how many cells it has.
static int cut(char* line, char* cell[CELLS_MAX]) {
    int count = 0;
    for (char* rest = line; rest && count < CELLS_MAX;)
        cell[count++] = strsep(&rest, ",");
    return count;
}

static int find(char* const cell[CELLS_MAX], int count, const char* name) {
    for (int i = 0; i < count; ++i)
        if (strcmp(cell[i], name) == 0)
            return i;
    return -1;
}

/// The places of its columns in a line.
typedef struct csv {
    int parameter, column[COLUMNS];
} csv;

static bt_status read_head(csv* t, char* line, const char* path, bt_diag* diag) {
    char* cell[CELLS_MAX];
    const int count = cut(line, cell);
    t->parameter = find(cell, count, "parameter");
    bool whole = t->parameter >= 0;
    for (int k = 0; k < COLUMNS; ++k) {
        t->column[k] = find(cell, count, column_names[k]);
        whole = whole && t->column[k] >= 0;
    }
    if (whole)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, (bt_where){path, 1, 0},
                "these are not the columns of a reliability table of this version; run `bolter "
                "reliability --again'");
    return BT_ERR_INPUT;
}

static void read_row(const csv* t, char* line, const char* path, double factor, curve* c) {
    char* cell[CELLS_MAX];
    const int count = cut(line, cell);
    if (c->count == BT_CONDITION_MAX || t->parameter >= count ||
        strcmp(cell[t->parameter], path) != 0)
        return;
    for (int k = 0; k < COLUMNS; ++k) {
        double value = NAN;
        if (t->column[k] < count && *cell[t->column[k]])
            bt_text_scan_number(cell[t->column[k]], &value);
        c->at[k][c->count] = (k == VALUE ? factor : 100) * value;
    }
    ++c->count;
}

/// The rows of one input, of a copy of the table that is cut up.
static bt_status read_curve(const csv* t, const char* rows, const char* path, double factor,
                            curve* c) {
    char* copy = strdup(rows);
    char* rest = copy;
    c->count = 0;
    if (!copy)
        return BT_ERR_MEMORY;
    for (char* line = strsep(&rest, "\n"); line; line = strsep(&rest, "\n"))
        read_row(t, line, path, factor, c);
    free(copy);
    return BT_OK;
}

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

static bt_status draw(const bt_study* study, const bt_input* input, const curve* c,
                      const char* folder, bt_diag* diag) {
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
                                 .x = c->at[VALUE],
                                 .y = c->at[CORRECTED],
                                 .low = c->at[LEAST],
                                 .high = c->at[GREATEST]},
                                {.label = "classifier alone",
                                 .style = BT_SERIES_POINTS,
                                 .count = c->count,
                                 .x = c->at[VALUE],
                                 .y = c->at[SURROGATE]}};
    const bt_figure figure = {.name = name,
                              .title = title,
                              .x_label = x_label,
                              .y_label = "probability of engagement, %",
                              .key_below = true,
                              .x_free = true,
                              .series_count = 2,
                              .series = series};
    return bt_figure_write(&figure, folder, diag);
}

static bt_status draw_all(const bt_study* study, char* text, const char* path, const char* folder,
                          bt_diag* diag) {
    csv t;
    char* rows = text;
    char* head = strsep(&rows, "\n");
    BT_TRY(read_head(&t, head, path, diag));
    for (int i = 0; i < study->input_count && rows; ++i) {
        curve c;
        double factor;
        bt_display_unit(study->inputs[i].field, &factor);
        BT_TRY(read_curve(&t, rows, study->inputs[i].path, factor, &c));
        if (c.count > 1)
            BT_TRY(draw(study, &study->inputs[i], &c, folder, diag));
    }
    return BT_OK;
}

bt_status bt_reliability_draw(const bt_study* study, const char* folder, bt_diag* diag) {
    char path[BT_FILE_PATH_MAX], *text = NULL;
    BT_TRY(bt_file_path(path, study->directory, "reliability.csv"));
    if (access(path, F_OK) != 0)
        return BT_OK;
    BT_TRY(bt_file_read(path, &text, NULL, diag));
    const bt_status status = draw_all(study, text, path, folder, diag);
    free(text);
    return status;
}
