/// How wide the pooled intervals are after so many landings, without a single sample of the
/// classifiers: for the curve of width over landings, and for stopping at a width.
#ifndef BT_RELIABILITY_WIDTHS_H
#define BT_RELIABILITY_WIDTHS_H

#include "reliability/pooled.h"

/// The laws of all conditions' weights.
typedef struct bt_widths {
    const bt_mixture* mixture;
    double tail;
    int64_t samples;    ///< that the classifiers' means will come from
    bt_weight_law* law; ///< [mixture->components]
} bt_widths;

/// Half-widths over the conditions after `landings` landings; NAN where there is no interval yet.
typedef struct bt_width {
    int64_t landings;
    double overall, median, largest; ///< of the study as it stands; over the conditions
    double cov; ///< largest coefficient of variation of a miss probability, sampling alone
} bt_width;

/// @param least  the landings are drawn with at least so many times the density of the design
/// BT_ERR_MEMORY. The mixture must outlive it; bt_widths_destroy gives it back.
BT_CHECKED bt_status bt_widths_create(const bt_study* study, const bt_mixture* mixture,
                                      const bt_design* design, double least, bt_widths* widths);
void bt_widths_destroy(bt_widths* widths);

/// The half-widths from the first n landings of the evidence.
///
/// @param said    [n] 1 engaged, 0 missed by the classifier of its round; -1: of the first round
/// @param weight  [components][evidence->count] by bt_pooled_weigh
bt_width bt_width_after(const bt_widths* widths, const bt_evidence* evidence, const int8_t* said,
                        const double* weight, int n);

/// Median and largest of n half-widths (sorted by it), beside the others.
bt_width bt_width_over(double overall, double* half, int n, int64_t landings, double cov);

#endif
