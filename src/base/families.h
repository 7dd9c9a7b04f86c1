/// What each family of distributions answers; bt_distribution_* ask here by kind.
#ifndef BT_BASE_FAMILIES_H
#define BT_BASE_FAMILIES_H

#include "base/distribution.h"

/// How a condition moves it.
typedef enum bt_family_move {
    BT_MOVE_MEAN,  ///< its parameter `mean` is its mean; what else is a place moves along
    BT_MOVE_ALL,   ///< every place moves by the same way
    BT_MOVE_ALONE, ///< `mean` alone
    BT_MOVE_SCALE, ///< lower and upper by the same factor
} bt_family_move;

typedef struct bt_family {
    const char* parameters[5];                      ///< ends in NULL
    const char* (*check)(const bt_distribution* d); ///< parameters are finite, but for the bounds
                                                    ///< of a truncated normal
    double (*quantile)(const bt_distribution* d, double u);
    double (*cdf)(const bt_distribution* d, double x);
    double (*log_density)(const bt_distribution* d, double x);
    double (*mean)(const bt_distribution* d);
    bt_family_move move;
} bt_family;

#define BT_FAMILY_DECLARE(NAME, name) extern const bt_family bt_family_##name;
BT_DISTRIBUTIONS(BT_FAMILY_DECLARE)

/// log of the density of a normal at z standard deviations from its mean.
double bt_log_normal_density(double z, double sd);

/// ln X of a lognormal is N(log_mean, log_sd^2).
void bt_lognormal_logs(const bt_distribution* d, double* log_mean, double* log_sd);

#endif
