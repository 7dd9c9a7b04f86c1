/// The figures of bt_stage_figures, drawn by gnuplot (figure.h).
#ifndef BT_REPORT_STUDY_FIGURES_H
#define BT_REPORT_STUDY_FIGURES_H

#include "pipeline/figures.h"

extern const bt_figure_writers bt_study_figures;

#endif
