/// The mixture of the input distributions of every condition that a study asks about: landings
/// drawn from it count in every condition, each with the weight density of the condition / density
/// of the mixture (balance heuristic: Veach and Guibas 1995; Owen and Zhou 2000).
///
///   q(x) = sum_k share_k p_k(x),   p_k / q <= 1 / share_k
#ifndef BT_CAMPAIGN_MIXTURE_H
#define BT_CAMPAIGN_MIXTURE_H

#include "study/study.h"

enum { BT_COMPONENT_MAX = BT_CONDITION_MAX + 1 };

/// Component 0 is the study as it stands, component c + 1 its condition c. The variables are the
/// inputs with a distribution, in the study's order.
typedef struct bt_mixture {
    int dims, components;
    double share[BT_COMPONENT_MAX]; ///< sum 1
    bt_distribution base[BT_INPUT_MAX];
    int moved[BT_COMPONENT_MAX];          ///< the variable that a component moves; -1: none
    bt_distribution to[BT_COMPONENT_MAX]; ///< its distribution there
    bt_copula copula;                     ///< of the variables, the same in every component
} bt_mixture;

/// The mixture of a study's conditions. The shares minimise the sum over the conditions of the
/// square of the factor by which weighing raises a variance, E_c[p_c / q] (the square, so that no
/// condition is left behind; a convex problem, solved by multiplicative steps on points keyed by
/// the study's seed); no share is below a tenth of the equal one.
///
/// BT_ERR_INPUT (no random input; conditions whose other inputs are frozen have no density; said in
/// diag); BT_ERR_MEMORY. On BT_OK the caller frees *made.
BT_CHECKED bt_status bt_mixture_create(const bt_study* study, bt_mixture** made, bt_diag* diag);

/// The copula of the inputs with a distribution, in the study's order.
void bt_mixture_copula(const bt_study* study, bt_copula* copula);

/// log q(x). x [dims].
/// @param log_p  [components] log density of every component; may be NULL
double bt_mixture_log_density(const bt_mixture* mixture, const double* x, double* log_p);

/// The point of a component at uniform numbers u [dims]: x [dims].
void bt_mixture_point(const bt_mixture* mixture, int component, const double* u, double* x);

/// The component that a uniform number picks.
int bt_mixture_pick(const bt_mixture* mixture, double u);

#endif
