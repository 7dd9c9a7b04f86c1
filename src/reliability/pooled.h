/// The pooled estimate: every landing of the ledger is evidence for every condition.
///
///   R_c = sum_t a_t E_c[h_t] + sum_i v_i (y_i - h_i),   v_i = min(p_c / q, cap)(x_i) / n
///
/// h_t: the classifier of round t, h_i: the one that judged landing i before it learnt from it
/// (rounds.h); a_t: the share of round t in the n judged landings; p_c: the density of condition
/// c, q: the one that the landing was drawn with. Derived in docs/theory/reliability.md.
#ifndef BT_RELIABILITY_POOLED_H
#define BT_RELIABILITY_POOLED_H

#include "reliability/evidence.h"
#include "statistics/intervals.h"
#include "statistics/weighted.h"

/// Weights of one condition: cut at `cap`, where what is cut off has the mass `cut` of the
/// condition. And the tail of its intervals: the truth may lie beyond either end with this
/// probability.
typedef struct bt_cut {
    double cap, cut, tail;
} bt_cut;

enum { BT_LAW_POINTS = 16384 };

/// How the weights of a condition are distributed under the condition itself.
typedef struct bt_weight_law {
    bt_cut bound;                 ///< what is known without points: greatest weight, mass beyond
    double weight[BT_LAW_POINTS]; ///< of points of the condition, ascending; INFINITY: the design
                                  ///< has no density there
} bt_weight_law;

/// What the pool says about one condition. Widths are distances, not negative.
typedef struct bt_pooled {
    double value;     ///< R_c
    bt_interval ci95; ///< at 1 - 2 tail: sampling, the classifier's error, failed landings either
                      ///< way, and errors of a kind never seen
    double sampling;  ///< half the width that what was seen gives
    double unseen;    ///< what the bound for the unseen adds to half the width
    double effective; ///< landings of the condition itself that would weigh as much
    double disagreement;   ///< share of landings that the classifiers judged wrongly, weighted
    int judged, disagreed; ///< landings judged, wrongly judged
} bt_pooled;

/// The weights p_c / q of all landings, not cut: [mixture->components][evidence->count].
void bt_pooled_weigh(const bt_mixture* mixture, const bt_evidence* evidence, double* weight);

/// Fills the law of a condition's weights, for landings drawn with at least `least` times the
/// density of the design (NULL: of the mixture), from points of the condition keyed by the seed.
/// Where the design has no density (outside a box) the weights are infinite, and cut off.
void bt_pooled_law(const bt_mixture* mixture, const bt_design* design, int component, double least,
                   uint64_t seed, bt_weight_law* law);

/// The cap that makes the bound for errors never seen least, for n judged landings.
bt_cut bt_pooled_cut(const bt_weight_law* law, int n, double tail);

/// @param evidence  landings
/// @param judged    [count] 1 engaged, 0 missed by the classifier of its round; -1: not judged
/// @param weight    [count] p_c / q, not cut
/// @param hits, samples  how many samples of the condition, shared among the rounds' classifiers as
///                       the judged landings are, they called engaged
bt_pooled bt_pooled_estimate(const bt_evidence* evidence, const int8_t* judged,
                             const double* weight, const bt_cut* cut, int64_t hits,
                             int64_t samples);

/// The estimate without any classifier: the weighted share of misses, taken from 1, with the
/// limits of statistics/weighted.h; with equal weights the plain proportion and its exact limits.
/// It needs no condition but the weights.
bt_pooled bt_reweighted_estimate(const bt_evidence* evidence, const double* weight,
                                 const bt_cut* cut);

/// The difference R_a - R_b of two conditions on the same landings.
///
/// @param apart  interval of the difference of the classifiers' means, E_a[h] - E_b[h], about
///               its value
bt_pooled bt_pooled_difference(const bt_evidence* evidence, const int8_t* judged,
                               const double* weight_a, const double* weight_b, const bt_cut* cut_a,
                               const bt_cut* cut_b, double means, bt_interval apart);

#endif
