/// Distributions of one variable: what `uncertainty:` may say of a key.
#ifndef BT_BASE_DISTRIBUTION_H
#define BT_BASE_DISTRIBUTION_H

#include "base/status.h"

#include <stdbool.h>

typedef enum bt_distribution_kind {
    BT_NORMAL,           ///< mean, sd
    BT_TRUNCATED_NORMAL, ///< mean, sd (of the parent), lower, upper; one bound may be infinite
    BT_LOGNORMAL,        ///< mean, sd of the variable itself
    BT_UNIFORM,          ///< lower, upper
    BT_TRIANGULAR,       ///< lower, mode, upper
    BT_WEIBULL,          ///< scale, shape, lower (location)
    BT_GUMBEL,           ///< mode, scale (largest values)
    BT_EXPONENTIAL,      ///< mean, lower (location)
    BT_CONSTANT,         ///< mean
    BT_DISTRIBUTION_KINDS
} bt_distribution_kind;

typedef struct bt_distribution {
    bt_distribution_kind kind;
    double mean, sd, lower, upper, mode, scale, shape;
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
/// Natural logarithm of the density at x; -INFINITY outside the support. A constant has the density
/// 1 at its value: its mass.
double bt_distribution_log_density(const bt_distribution* d, double x);
double bt_distribution_mean(const bt_distribution* d);

/// The same distribution moved so that its mean is `mean` (spread unchanged; a condition).
bt_distribution bt_distribution_moved(const bt_distribution* d, double mean);

#endif
