/// Random numbers by key, not by sequence: (seed, run, variable) names one number. Any run can be
/// drawn alone, on any thread, in any order, and gives the same bits (Philox4x32-10, Random123).
#ifndef BT_BASE_RNG_H
#define BT_BASE_RNG_H

#include <stdint.h>

/// A uniform number, 2^-53 <= u <= 1 - 2^-53 (never 0 or 1).
double bt_rng_uniform(uint64_t seed, uint64_t run, uint32_t variable);

/// 64 random bits of the same key.
uint64_t bt_rng_bits(uint64_t seed, uint64_t run, uint32_t variable);

#endif
