/// Points drawn from distributions, independent or bound by a copula, each named by (seed, stream,
/// sample, variable): any sample can be drawn alone, on any thread, in any order, and gives the
/// same bits.
#ifndef BT_RELIABILITY_SAMPLER_H
#define BT_RELIABILITY_SAMPLER_H

#include "study/study.h"

typedef struct bt_sampler {
    int dims;
    bt_distribution distribution[BT_INPUT_MAX];
    const bt_copula* copula; ///< NULL: independent
    uint64_t seed;
    uint32_t stream; ///< below 2^23; tells conditions apart
} bt_sampler;

/// Samples first .. first + n - 1: x_k = quantile of distribution k at a uniform number of 52 bits.
/// Normal variables use a fast inverse normal of relative error below 2e-9 (sample_kernel.h).
/// Pure.
///
/// @param x  [n * dims] row-major
void bt_sampler_draw(const bt_sampler* sampler, uint64_t first, int n, double* x);

#endif
