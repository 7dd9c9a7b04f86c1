#include "base/hash.h"

uint64_t bt_hash_bytes(uint64_t hash, const void* data, size_t size) {
    const unsigned char* byte = data;
    for (size_t i = 0; i < size; ++i)
        hash = (hash ^ byte[i]) * UINT64_C(1099511628211);
    return hash;
}
