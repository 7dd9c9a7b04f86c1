/// Figures by gnuplot, run as a process. Each figure NAME is three files in one folder: its data
/// (NAME.csv), the script that draws it (NAME.gp) and the pictures (NAME.png, NAME.svg; for print
/// NAME.pdf, 17.5 cm wide, and NAME-column.pdf, 8.5 cm wide).
#ifndef BT_REPORT_FIGURE_H
#define BT_REPORT_FIGURE_H

#include "base/diag.h"

#include <stdbool.h>

enum { BT_SERIES_MAX = 64 };

typedef enum bt_series_style {
    BT_SERIES_LINE,
    BT_SERIES_POINTS,
    BT_SERIES_LINE_POINTS,
    BT_SERIES_REFERENCE, ///< grey, dashed: what the others are compared with
} bt_series_style;

typedef struct bt_series {
    const char* label; ///< in the key; NULL: not there
    bt_series_style style;
    int count;
    const double *x, *y;      ///< [count]; the caller's
    const double *low, *high; ///< [count] ends of the error bars; NULL: none
    bool second;              ///< belongs to the second y axis, at the right
} bt_series;

typedef struct bt_figure {
    const char* name;                                  ///< name of the files, without suffix
    const char *title, *x_label, *y_label, *key_title; ///< may be NULL
    const char* y2_label; ///< label of a second y axis; NULL: there is none
    bool ordered;         ///< the series are steps of one quantity: colours from dark to light
    bool key_below;       ///< the key lies under the figure instead of beside it
    bool from_zero;       ///< the y axis begins at 0
    bool x_free;          ///< the x axis begins where the data do, not at 0
    double x_max, y_max;  ///< ends of the axes; 0: found by gnuplot
    int series_count;
    const bt_series* series;
} bt_figure;

/// Writes data and script, then lets gnuplot draw. The folder is made if it does not exist (its
/// parent must). Without gnuplot on the PATH, data and script are there and a warning in diag says
/// how to draw them later; gnuplot's own errors are handed on as warnings too.
/// BT_ERR_IO: data or script cannot be written; BT_ERR_MEMORY.
BT_CHECKED bt_status bt_figure_write(const bt_figure* figure, const char* folder, bt_diag* diag);

#endif
