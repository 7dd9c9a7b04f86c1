/// Distributions of one variable: what `uncertainty:` may say of a key.
#ifndef BT_BASE_DISTRIBUTION_H
#define BT_BASE_DISTRIBUTION_H

#include "base/sample.h"
#include "base/status.h"

#include <stdbool.h>

/// D(NAME, name); the parameters of each
#define BT_DISTRIBUTIONS(D)                                                                        \
    D(NORMAL, normal)                     /* mean, sd */                                           \
    D(TRUNCATED_NORMAL, truncated_normal) /* mean, sd (of the parent), lower, upper; one bound may \
                                             be infinite */                                        \
    D(LOGNORMAL, lognormal)               /* mean, sd of the variable itself */                    \
    D(UNIFORM, uniform)                   /* lower, upper */                                       \
    D(TRIANGULAR, triangular)             /* lower, mode, upper */                                 \
    D(WEIBULL, weibull)                   /* scale, shape, lower (location) */                     \
    D(GUMBEL, gumbel)                     /* mode, scale (largest values) */                       \
    D(EXPONENTIAL, exponential)           /* mean, lower (location) */                             \
    D(CONSTANT, constant)                 /* mean */                                               \
    D(BETA, beta)                         /* mean, sd, lower, upper */                             \
    D(GAMMA, gamma)                       /* mean, sd, lower (location) */                         \
    D(RAYLEIGH, rayleigh)                 /* scale, lower (location) */                            \
    D(LOGISTIC, logistic)                 /* mean, sd */                                           \
    D(LOG_UNIFORM, log_uniform)           /* lower, upper */                                       \
    D(STUDENT, student)                   /* mean, scale, freedom */                               \
    D(DISCRETE, discrete)                 /* sample; mean: where it has been moved to */           \
    D(EMPIRICAL, empirical)               /* the same */

#define BT_DISTRIBUTION_ENUM(NAME, name) BT_##NAME,
typedef enum bt_distribution_kind {
    BT_DISTRIBUTIONS(BT_DISTRIBUTION_ENUM) BT_DISTRIBUTION_KINDS
} bt_distribution_kind;

typedef struct bt_distribution {
    bt_distribution_kind kind;
    double mean, sd, lower, upper, mode, scale, shape; ///< shape: degrees of freedom of a student
    const bt_sample* sample;                           ///< of what has one; the owner's
} bt_distribution;

extern const char* const bt_distribution_names[]; ///< "normal", ..., NULL

/// Which parameters a kind takes, as a NULL-terminated list of names ("mean", "sd", ...).
const char* const* bt_distribution_parameters(bt_distribution_kind kind);

/// NULL when the parameters are sound, otherwise a sentence that says what is wrong.
const char* bt_distribution_check(const bt_distribution* d);

/// Quantile at u in (0, 1). Pure; monotone.
double bt_distribution_quantile(const bt_distribution* d, double u);
/// Cumulative probability at x.
double bt_distribution_cdf(const bt_distribution* d, double x);
/// Natural logarithm of the density at x; -INFINITY outside the support. Where single values have
/// a mass (bt_distribution_has_atoms) it is that of their mass.
double bt_distribution_log_density(const bt_distribution* d, double x);
double bt_distribution_mean(const bt_distribution* d);

/// Whether single values have a probability of their own: constant, discrete, and empirical without
/// smoothing. Such a variable has no density beside a box's, and no Gaussian copula.
bool bt_distribution_has_atoms(const bt_distribution* d);

/// The standard normal score of x, Phi^-1(F(x)), and the x of a score. Within +-8.2 for all but
/// normal and lognormal, where they are exact.
double bt_distribution_score(const bt_distribution* d, double x);
double bt_distribution_at_score(const bt_distribution* d, double score);

/// The same distribution moved so that its mean is `mean` (a condition): shifted as a whole, but a
/// lognormal, which keeps its standard deviation and its support, and a log_uniform, which keeps
/// upper / lower.
bt_distribution bt_distribution_moved(const bt_distribution* d, double mean);

#endif
