/// The surrogate: a support-vector classifier that answers "engaged or missed" for a landing it has
/// not seen  [Peng2023 Eqs. 19-20].
///
///   f(x) = sum_i coef_i exp(-gamma |z - s_i|^2) - rho,   z_k = (x_k - centre_k) / scale_k
///
/// label +1 (engaged) when f > 0, -1 (missed) otherwise; coef_i = y_i alpha_i, 0 < alpha_i <= C.
/// When the landings it learnt from were all of one kind it is constant: no support vectors, and f
/// is that label. Differs from the paper: inputs are standardised and weighted, and the score is
/// measured on landings that were kept out of training.
#ifndef BT_SURROGATE_SURROGATE_H
#define BT_SURROGATE_SURROGATE_H

#include "statistics/intervals.h"
#include "study/study.h"

#include <stdint.h>

/// Landings with known outcome. Failed runs never come here.
typedef struct bt_training_set {
    int dims, count;
    const double* x;  ///< [count * dims] row-major, SI
    const int* label; ///< [count] +1 engaged, -1 missed
} bt_training_set;

/// One (C, gamma) of the grid. It may be tried on growing parts of the training landings; the last
/// trial is kept.
typedef struct bt_grid_point {
    double C, gamma;
    int trained_on; ///< landings of the cross-validation; 0: not tried, its row had stopped gaining
    int correct;    ///< samples among them that are right when left out
    double loss;    ///< mean cross-entropy of the predictions (loss.h); INFINITY: too hard to train
    int round;      ///< 1, 2, 3: how many rounds it was in
} bt_grid_point;

enum { BT_GRID_MAX = BT_LIST_MAX * BT_LIST_MAX };

/// How well it answers.
typedef struct bt_surrogate_scores {
    int train_count, train_correct;
    int holdout_count, holdout_correct;
    bt_interval holdout_ci95; ///< Clopper-Pearson, of the hold-out accuracy
    int confusion[2][2];      ///< hold-out counts [outcome][prediction], 0 missed, 1 engaged
    int cv_count, cv_correct; ///< counts of the chosen grid point
    double seconds;           ///< model selection and training, wall clock
} bt_surrogate_scores;

typedef struct bt_surrogate {
    int dims;
    char path[BT_INPUT_MAX][BT_PATH_MAX]; ///< what each input is ("landing.pitch"); may be empty
    double centre[BT_INPUT_MAX], scale[BT_INPUT_MAX]; ///< standardisation, SI
    double weight[BT_INPUT_MAX]; ///< relevance, in the scale already: deviation / scale
    double least[BT_INPUT_MAX], greatest[BT_INPUT_MAX]; ///< box of the training landings, SI
    bool constant;                                      ///< all landings were of one kind
    double C, gamma, rho;
    int sv_count;
    double* sv;   ///< [sv_count * dims] standardised
    double* coef; ///< [sv_count]
    uint64_t study_hash, training_hash;
    bt_surrogate_scores scores;
} bt_surrogate;

/// How a surrogate came about: the whole grid.
typedef struct bt_grid {
    int count;
    bt_grid_point point[BT_GRID_MAX]; ///< C varies fastest; the chosen one is at `best`
    int best;
} bt_grid;

/// What model selection chooses: everything that a fit needs beside the landings.
typedef struct bt_hyperparameters {
    double C, gamma;
    double weight[BT_INPUT_MAX]; ///< weights of the inputs; powers of sqrt 2
    int cv_count, cv_correct;    ///< counts of the chosen grid point
} bt_hyperparameters;

/// Model selection: standardises the landings, weighs the inputs (relevance.h) and chooses
/// (C, gamma) by k-fold cross-validation over the grid. The same bits for any number of threads.
///
/// The grid is tried in up to three rounds: every point on about 2,000 landings, the best third of
/// them on about 6,000, the best three on about 16,000. Better is less loss (loss.h). Along a row
/// of constant gamma C rises, and the row is left when a step gained less than 1 % of the loss, or
/// when a training took more than 10^6 iterations, which rules the point out. The point of least
/// loss in the last round is chosen. Weights are compared at the grid's values nearest to C = 1000
/// and gamma = 0.1.
///
/// @param params   grid and folds; empty lists mean the default grid
/// @param holdout  share of the landings of each class that is left out of everything (the same
///                 that bt_surrogate_fit leaves out with this seed); 0: none
/// @param threads  0: one per core
/// @param grid     may be NULL
/// @return BT_OK; BT_ERR_ARG (no landings, more than BT_INPUT_MAX inputs, a label other than +1 or
///         -1, a value that is not finite; said in diag); BT_ERR_MEMORY
BT_CHECKED bt_status bt_surrogate_select(const bt_training_set* set,
                                         const bt_surrogate_params* params, double holdout,
                                         uint64_t seed, int threads, bt_hyperparameters* out,
                                         bt_grid* grid, bt_diag* diag);

/// Fits one classifier with given hyperparameters on everything but the hold-out (kept apart by
/// keyed random numbers, in each class alike), and scores it. A refit on more landings costs this
/// and no selection.
///
/// @param holdout  share kept out of training to measure the accuracy on; 0: none
/// @return as bt_surrogate_select. On BT_OK the caller owns *out: bt_surrogate_destroy, and fills
///         path and study_hash. Landings of one class, and a hold-out that lacks a class, are
///         warnings in diag.
BT_CHECKED bt_status bt_surrogate_fit(const bt_training_set* set, const bt_hyperparameters* chosen,
                                      double holdout, uint64_t seed, bt_surrogate* out,
                                      bt_diag* diag);

/// Selection and fit, with the hold-out of the params.
BT_CHECKED bt_status bt_surrogate_train(const bt_training_set* set,
                                        const bt_surrogate_params* params, uint64_t seed,
                                        int threads, bt_surrogate* out, bt_grid* grid,
                                        bt_diag* diag);
void bt_surrogate_destroy(bt_surrogate* surrogate);

/// f(x) in double, plainly summed: the definition that every faster way must agree with in sign.
/// It equals LIBSVM's decision value to the last bit.
/// @param x  [dims] SI
double bt_surrogate_decision(const bt_surrogate* surrogate, const double* x);

/// Shares of right answers; NAN when there is nothing to count.
double bt_surrogate_train_accuracy(const bt_surrogate_scores* scores);
double bt_surrogate_holdout_accuracy(const bt_surrogate_scores* scores);

/// Writes the model file: text, numbers as hexadecimal floats (exact to the bit), closed by a
/// checksum; under a temporary name, then renamed, so that a reader sees a whole file or the old
/// one. BT_ERR_IO (said in diag).
BT_CHECKED bt_status bt_surrogate_save(const bt_surrogate* surrogate, const char* file,
                                       bt_diag* diag);

/// Reads a model file back, every number to the bit. BT_ERR_IO: cannot be read; BT_ERR_INPUT: not
/// such a file, another version, ends early, or damaged (said in diag with the line);
/// BT_ERR_MEMORY. On BT_OK the caller owns *out: bt_surrogate_destroy.
BT_CHECKED bt_status bt_surrogate_load(const char* file, bt_surrogate* out, bt_diag* diag);

#endif
