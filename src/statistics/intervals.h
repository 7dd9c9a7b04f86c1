/// Exact confidence intervals for a proportion, and the beta distribution they need.
#ifndef BT_STATISTICS_INTERVALS_H
#define BT_STATISTICS_INTERVALS_H

#include <stdint.h>

/// An interval with the estimate it belongs to: least <= value <= greatest, all within [0, 1].
typedef struct bt_interval {
    double least, greatest;
} bt_interval;

/// Half its width.
double bt_interval_half(const bt_interval* interval);

/// Regularised incomplete beta function I_x(a, b), a, b > 0, 0 <= x <= 1: continued fraction
/// [DLMF 8.17.22] by Lentz's method, on the side of the mean where it converges fast; as many
/// terms as it needs (about sqrt(max(a, b))), so that counts of 10^10 are right too.
double bt_beta_cdf(double x, double a, double b);

/// Clopper-Pearson interval for a proportion after `hits` of `trials`: the p for which this count
/// or more (or: or less) has probability (1 - level) / 2. It covers at least `level` for every p
/// and is never of zero width.
///
/// least    = the x with I_x(hits, trials - hits + 1) = (1 - level) / 2, 0 when hits = 0
/// greatest = the x with I_x(hits + 1, trials - hits) = (1 + level) / 2, 1 when hits = trials
///
/// @param trials  0 gives [0, 1]: nothing is known
/// @param level   0 < level < 1, for example 0.95
bt_interval bt_clopper_pearson(int64_t hits, int64_t trials, double level);

#endif
