/// How good a classifier's answers are, by more than their number: the cross-entropy.
#ifndef BT_SURROGATE_LOSS_H
#define BT_SURROGATE_LOSS_H

/// Cross-entropy of n answers when f is made a probability by its best slope, P(+1) =
/// 1 / (1 + exp(-a f))  [Platt 1999, without the offset]:
///
///   least over 0 <= a <= 1000 of  sum_i log(1 + exp(-a y_i f_i))   in nats
///
/// Convex in a, so the least is where the derivative passes zero (bisection). Below n log 2 when f
/// knows anything about y; unlike the number of right answers it also tells a near miss from a
/// confident error, and so tells two classifiers apart on fewer points.
///
/// @param margin  [n] functional margins y_i f_i, finite: positive where the answer is right
double bt_score_loss(const double* margin, int n);

#endif
