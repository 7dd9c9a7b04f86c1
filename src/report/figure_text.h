/// A figure as text, for the terminal.
#ifndef BT_REPORT_FIGURE_TEXT_H
#define BT_REPORT_FIGURE_TEXT_H

#include "report/figure.h"

#include <stdio.h>

enum { BT_FIGURE_TEXT_WIDTH = 72, BT_FIGURE_TEXT_HEIGHT = 16 }; ///< of the field, characters

/// Prints title, axes with their ends, and a mark per point in ASCII: lines are followed from
/// column to column, error bars stand as "|". Series of the second axis are left out. Nothing when
/// there are no points. Write errors stay with the file.
void bt_figure_print(const bt_figure* figure, FILE* out);

#endif
