#include "report/reliability_csv.h"

#include "base/directory.h"
#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { CELLS_MAX = 64, ROWS_MAX = BT_CONDITION_MAX + 1 };
static const char* const column_names[BT_CURVE_COLUMNS] = {"value", "corrected", "corrected_least",
                                                           "corrected_greatest", "surrogate"};

struct bt_reliability_csv {
    char* text; ///< cut into cells
    int count;
    const char* parameter[ROWS_MAX];
    double at[BT_CURVE_COLUMNS][ROWS_MAX];
    int parameter_cell, cell[BT_CURVE_COLUMNS]; ///< places of the columns in a line
};

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

static bt_status read_head(bt_reliability_csv* csv, char* line, const char* path, bt_diag* diag) {
    char* cell[CELLS_MAX];
    const int count = cut(line, cell);
    csv->parameter_cell = find(cell, count, "parameter");
    bool whole = csv->parameter_cell >= 0;
    for (int k = 0; k < BT_CURVE_COLUMNS; ++k) {
        csv->cell[k] = find(cell, count, column_names[k]);
        whole = whole && csv->cell[k] >= 0;
    }
    if (whole)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, (bt_where){path, 1, 0},
                "these are not the columns of a reliability table of this version; run `bolter "
                "reliability --again'");
    return BT_ERR_INPUT;
}

static void read_row(bt_reliability_csv* csv, char* line) {
    char* cell[CELLS_MAX];
    const int count = cut(line, cell);
    if (csv->count == ROWS_MAX || count <= csv->parameter_cell || count < 2)
        return;
    csv->parameter[csv->count] = cell[csv->parameter_cell];
    for (int k = 0; k < BT_CURVE_COLUMNS; ++k) {
        double value = NAN;
        if (csv->cell[k] < count && *cell[csv->cell[k]])
            bt_text_scan_number(cell[csv->cell[k]], &value);
        csv->at[k][csv->count] = value;
    }
    ++csv->count;
}

static bt_status read_all(bt_reliability_csv* csv, const char* path, bt_diag* diag) {
    BT_TRY(bt_file_read(path, &csv->text, NULL, diag));
    char* rest = csv->text;
    BT_TRY(read_head(csv, strsep(&rest, "\n"), path, diag));
    for (char* line = strsep(&rest, "\n"); line; line = strsep(&rest, "\n"))
        read_row(csv, line);
    return BT_OK;
}

bt_status bt_reliability_csv_read(const bt_study* study, bt_reliability_csv** csv, bt_diag* diag) {
    char path[BT_FILE_PATH_MAX];
    *csv = NULL;
    BT_TRY(bt_file_path(path, study->directory, "reliability.csv"));
    if (access(path, F_OK) != 0)
        return BT_OK;
    bt_reliability_csv* made = calloc(1, sizeof *made);
    const bt_status status = made ? read_all(made, path, diag) : BT_ERR_MEMORY;
    if (status == BT_OK)
        *csv = made;
    else
        bt_reliability_csv_destroy(made);
    return status;
}

void bt_reliability_csv_destroy(bt_reliability_csv* csv) {
    if (csv)
        free(csv->text);
    free(csv);
}

void bt_reliability_csv_curve(const bt_reliability_csv* csv, const char* path,
                              bt_reliability_curve* curve) {
    curve->count = 0;
    for (int i = 0; csv && i < csv->count && curve->count < BT_CONDITION_MAX; ++i) {
        if (strcmp(csv->parameter[i], path) != 0)
            continue;
        for (int k = 0; k < BT_CURVE_COLUMNS; ++k)
            curve->at[k][curve->count] = csv->at[k][i];
        ++curve->count;
    }
}
