/// Reliability over the mean of each input, as pictures: the paper's Figs. 19 to 22.
#ifndef BT_REPORT_RELIABILITY_FIGURE_H
#define BT_REPORT_RELIABILITY_FIGURE_H

#include "study/study.h"

#include <stdio.h>

/// Draws STUDY/reliability.csv into a folder (bt_figure_write): fig19 to fig22 in the reference
/// study, else reliability_KEY; corrected with its interval, the classifier alone beside it. They
/// bear the study's title.
///
/// STUDY/convergence.csv beside it: half-width over the number of landings, in points.
///
/// @return BT_OK, also when there are no such files; BT_ERR_IO, BT_ERR_INPUT (a column is missing),
///         said in diag; BT_ERR_MEMORY
BT_CHECKED bt_status bt_reliability_draw(const bt_study* study, const char* folder, bt_diag* diag);

/// The same as text (figure_text.h).
BT_CHECKED bt_status bt_reliability_print(const bt_study* study, FILE* out, bt_diag* diag);

#endif
