/// The inner loops of sampling: Philox4x32-10 and the inverse normal, over many samples at once.
/// One source (sample_kernel.c), built once per instruction-set level; sampler.c chooses.
#ifndef BT_RELIABILITY_SAMPLE_KERNEL_H
#define BT_RELIABILITY_SAMPLE_KERNEL_H

#include <stdint.h>

enum { BT_SAMPLE_BLOCK = 256 }; ///< samples made at a time

/// Two uniform numbers per sample from one Philox block:
///   counter = (sample low, sample high, word2, word3), key = (seed low, seed high)
///   a = (bits 63..12 of words 1, 0 + 1/2) 2^-52,   b = the same of words 3, 2
/// for samples first .. first + BT_SAMPLE_BLOCK - 1; 2^-53 <= a, b <= 1 - 2^-53. The same bits at
/// every level.
typedef void bt_sample_uniforms(uint64_t seed, uint64_t first, uint32_t word2, uint32_t word3,
                                double a[BT_SAMPLE_BLOCK], double b[BT_SAMPLE_BLOCK]);

/// Replaces each u by the standard normal quantile at u, relative error below 2e-9:
///   z = q P(w),  q = u - 1/2,  w = -log(4 u (1 - u)) <= 6.25
/// with a polynomial P; beyond (|z| > 3.1) GSL's quantile. The levels differ in the last bits.
typedef void bt_sample_normals(double u[BT_SAMPLE_BLOCK]);

bt_sample_uniforms bt_sample_uniforms_v1, bt_sample_uniforms_v3, bt_sample_uniforms_v4;
bt_sample_normals bt_sample_normals_v1, bt_sample_normals_v3, bt_sample_normals_v4;

#endif
