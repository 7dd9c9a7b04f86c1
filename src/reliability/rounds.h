/// Rounds: a landing is first judged by a classifier that learnt from the rounds before, then
/// learnt from. So every landing is evidence about the classifier's error and training material,
/// but never both at once (prequential validation: Dawid 1984; Blum, Kalai and Langford 1999).
///
/// A round begins at 0, 128, 192, 256, 384, 512, 768, ...: the powers of two and their means. The
/// beginnings depend on nothing, so a campaign may grow.
#ifndef BT_RELIABILITY_ROUNDS_H
#define BT_RELIABILITY_ROUNDS_H

#include "reliability/evidence.h"
#include "surrogate/features.h"
#include "surrogate/surrogate.h"

/// The first run after `run` with which a round begins.
int64_t bt_round_end(int64_t run);

/// The landings before this one only train: the last beginning of a round within the first eighth
/// of n landings, at least 128. A classifier of so few would be judged for what the later ones
/// know.
int bt_round_first(int n);

/// Trains the classifiers of rounds; remembers what its last model selection chose.
typedef struct bt_rounds {
    const bt_features* features;       ///< NULL: none
    const bt_surrogate_params* params; ///< NULL: `chosen` is given, nothing is selected
    uint64_t seed;
    int threads;
    int candidates;  ///< points of the mixture from which the unsure ones are picked; 0: 65,536
    int selected_at; ///< landings that `chosen` was selected on; 0: none yet
    bt_hyperparameters chosen;
} bt_rounds;

/// The classifier of the round that begins at `begin`: it learns from the landings before, failed
/// ones left out. Hyperparameters are selected on the first 128, 512, 2,048, ... landings and kept
/// in between: a function of the rows before `begin` and of the seed. The caller owns *out.
/// When every landing before failed it is constant: engaged. Returns what bt_surrogate_fit does.
BT_CHECKED bt_status bt_rounds_classifier(bt_rounds* rounds, const bt_evidence* evidence, int begin,
                                          bt_surrogate* out, bt_diag* diag);

/// What the classifier of a round says of n points (without features): f, and 1 where it is above
/// 0, else 0. Either may be NULL. BT_ERR_MEMORY.
BT_CHECKED bt_status bt_rounds_predict(const bt_rounds* rounds, const bt_surrogate* classifier,
                                       const double* x, int n, int8_t* engaged, float* decision);

/// Draws the points of a round: of n runs from `begin` on, the share `unsure` in proportion to
/// q(x) s(x), s = sqrt(sum_c (p_c / q)^2) / (1 + (f / tau)^4), where f is the classifier of the
/// round and |f| <= tau has twice the mass of the errors that cross-validation expects (the best
/// density for the sum of all conditions' variances, were the chance of an error the square of the
/// second factor); the others from the mixture q.
/// They come mixed in a fixed order, and each has the density of both together,
///
///   log(q(x) ((1 - unsure) + unsure s(x) / mean_q(s))).
///
/// @param x            [n * dims]
/// @param log_density  [n]
BT_CHECKED bt_status bt_rounds_draw(const bt_rounds* rounds, const bt_mixture* mixture,
                                    const bt_surrogate* classifier, int begin, int n, double unsure,
                                    double* x, double* log_density);

#endif
