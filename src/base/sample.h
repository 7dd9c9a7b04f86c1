/// Values given one by one, with their probabilities: what a discrete distribution takes, and an
/// empirical one as measured or smoothed by kernels.
#ifndef BT_BASE_SAMPLE_H
#define BT_BASE_SAMPLE_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

enum { BT_SAMPLE_MAX = 10000 };

typedef struct bt_sample bt_sample;

/// Copies the values (any order; equal ones become one) and their weights (NULL: equal), which are
/// brought to a sum of 1.
///
/// bandwidth  0: every value keeps its own probability. Above 0: the mean of Gaussian kernels of
///            this standard deviation about the values, evaluated at points a fifth of it apart and
///            straight in between, up to 5 bandwidths beyond the outer values; so density,
///            probability and quantile belong together exactly.
/// @return BT_OK; BT_ERR_ARG (fewer than 1 or more than BT_SAMPLE_MAX values, a bandwidth that
/// needs
///         more than 2^16 points); BT_ERR_MEMORY
BT_CHECKED bt_status bt_sample_create(const double* value, const double* weight, int count,
                                      double bandwidth, bt_sample** made);
void bt_sample_destroy(const bt_sample* sample); ///< accepts NULL

/// Silverman's rule for the bandwidth of n > 1 values, 0.9 min(sd, IQR / 1.34) n^(-1/5); 0 when all
/// are equal. Sorts the values.
double bt_sample_bandwidth(double* value, int count);

bool bt_sample_is_smooth(const bt_sample* sample);
double bt_sample_mean(const bt_sample* sample);
double bt_sample_quantile(const bt_sample* sample, double u);
double bt_sample_cdf(const bt_sample* sample, double x);
/// Density; mass where the sample is not smooth. `shift`: of all values; x is in the shifted scale.
double bt_sample_density(const bt_sample* sample, double x, double shift);

/// What it was made of, equal values as one, in ascending order: it makes the same bits again.
int bt_sample_count(const bt_sample* sample);
void bt_sample_get(const bt_sample* sample, int i, double* value, double* weight);
double bt_sample_bandwidth_of(const bt_sample* sample);
/// Of values, weights and bandwidth.
uint64_t bt_sample_hash(const bt_sample* sample);

#endif
