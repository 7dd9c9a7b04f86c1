/// FNV-1a, 64 bits: a fingerprint of bytes, for comparing states, files and studies. It guards
/// against accidents, not against an adversary.
#ifndef BT_BASE_HASH_H
#define BT_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

/// The hash of no bytes: what a first call of bt_hash_bytes goes on from.
#define BT_HASH_START UINT64_C(14695981039346656037)

/// The hash of what `hash` stands for, followed by these bytes.
uint64_t bt_hash_bytes(uint64_t hash, const void* data, size_t size);

#endif
