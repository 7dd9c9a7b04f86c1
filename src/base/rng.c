#include "base/rng.h"

#include <Random123/philox.h>

uint64_t bt_rng_bits(uint64_t seed, uint64_t run, uint32_t variable) {
    const philox4x32_ctr_t counter = {{(uint32_t)run, (uint32_t)(run >> 32), variable, 0}};
    const philox4x32_key_t key = {{(uint32_t)seed, (uint32_t)(seed >> 32)}};
    const philox4x32_ctr_t block = philox4x32(counter, key);
    return (uint64_t)block.v[1] << 32 | block.v[0];
}

double bt_rng_uniform(uint64_t seed, uint64_t run, uint32_t variable) {
    // 52 bits and a half: exact in a double. With 53 bits the top value would round to 1 and the
    // inverse normal to infinity.
    const uint64_t bits52 = bt_rng_bits(seed, run, variable) >> 12;
    return ((double)bits52 + 0.5) * 0x1p-52;
}
