/// Sobol' sensitivity indices: which input drives the scatter of an outcome.
///
///   S_k  = Var(E[f | x_k]) / Var f                     first order
///   ST_k = 1 - Var(E[f | all but x_k]) / Var f         total
///
/// from samples A and B and, for each k, A with column k of B (A_k):
///   S_k  = mean(f(B) (f(A_k) - f(A))) / V              [Saltelli2010 Eq. (b) of Table 2]
///   ST_k = mean((f(A) - f(A_k))^2) / (2 V)             [Jansen1999]
/// V is the variance of f over A and B together, and f is taken from its mean first (which changes
/// no expected value and takes the noise out of S_k).
#ifndef BT_RELIABILITY_SOBOL_INDICES_H
#define BT_RELIABILITY_SOBOL_INDICES_H

#include "reliability/monte_carlo.h"
#include "statistics/intervals.h"

/// f at n points (row-major, the sampler's variables). Called from several threads at once.
typedef void bt_function(void* user, const double* x, int n, double* f);

typedef struct bt_index {
    double value;
    bt_interval ci95; ///< bootstrap percentiles; the estimate itself may leave [0, 1] by noise
} bt_index;

typedef struct bt_sobol_result {
    int dims;
    int64_t evaluations; ///< calls of f
    double mean, variance;
    bt_index first[BT_INPUT_MAX], total[BT_INPUT_MAX];
} bt_sobol_result;

/// @param samples    rows of A and of B, 16 .. 1e7; (dims + 2) samples evaluations
/// @param bootstrap  resamples of the rows for the intervals, 0 .. 10000; 0: intervals are NAN
/// @return BT_OK; BT_ERR_ARG; BT_ERR_MEMORY; BT_ERR_NUMERIC when f does not vary at all (the
/// indices
///         are then NAN). The same bits for any number of threads.
BT_CHECKED bt_status bt_sobol_indices(const bt_sampler* sampler, bt_function* f, void* user,
                                      int samples, int bootstrap, int threads,
                                      bt_sobol_result* result);

/// A bt_function whose user is a bt_classifier: 1 engaged, 0 missed.
void bt_engaged(void* classifier, const double* x, int n, double* f);

#endif
