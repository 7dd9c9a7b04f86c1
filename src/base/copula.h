/// A Gaussian copula: which inputs tend to be large together, whatever their distributions.
///
///   z_k = Phi^-1(F_k(x_k)),   z ~ N(0, R)
///   c(u) = |R|^(-1/2) exp(-z' (R^-1 - I) z / 2)
///
/// A rank correlation (Spearman's) rho of two inputs is r = 2 sin(pi rho / 6) of their scores
/// [Pearson 1907; Nelsen 2006, Sec. 5.1]: ranks do not change when an input is moved or scaled.
#ifndef BT_BASE_COPULA_H
#define BT_BASE_COPULA_H

#include "base/distribution.h"

enum { BT_COPULA_MAX = 32 };

/// The rank correlation of a pair of variables.
typedef struct bt_correlation {
    int first, second;
    double rank; ///< Spearman's, -1 .. 1
} bt_correlation;

/// Without pairs the variables are independent, and nothing here changes a bit of them.
typedef struct bt_copula {
    int dims;                                    ///< 0: independent
    double log_root_det;                         ///< log |R| / 2
    double root[BT_COPULA_MAX][BT_COPULA_MAX];   ///< L of R = L L', lower triangle
    double excess[BT_COPULA_MAX][BT_COPULA_MAX]; ///< R^-1 - I
    bool bound[BT_COPULA_MAX];                   ///< takes part in a pair
} bt_copula;

/// The copula of some pairs, all others 0. Returns `count`, or less when R is not positive
/// definite: the last pair of the first variable with which it is not.
int bt_copula_make(const bt_correlation* pairs, int count, int dims, bt_copula* copula);

/// Turns independent uniform numbers u [dims] in (0, 1) into dependent ones. Those of variables in
/// no pair, and of the first of all, keep their bits.
void bt_copula_bind(const bt_copula* copula, double* u);

/// Log density of the copula at scores z [dims] (bt_distribution_score; those of variables in no
/// pair do not matter). The log density of the variables together is the sum of their own and this.
double bt_copula_log_density(const bt_copula* copula, const double* z);

#endif
