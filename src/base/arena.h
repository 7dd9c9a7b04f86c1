/// Arena: one block, handed out in pieces, given back all at once. What a landing needs is taken
/// from one arena when the model is assembled; nothing is allocated while stepping.
#ifndef BT_BASE_ARENA_H
#define BT_BASE_ARENA_H

#include "base/status.h"

#include <stddef.h>

typedef struct bt_arena {
    unsigned char* base;
    size_t size, used;
    size_t peak; ///< the largest `used` since creation
} bt_arena;

/// Acquires the block. BT_ERR_MEMORY when the system has none.
BT_CHECKED bt_status bt_arena_create(bt_arena* arena, size_t size);

/// Releases the block; accepts a zeroed arena.
void bt_arena_destroy(bt_arena* arena);

/// A zeroed piece of `size` bytes, aligned to 64 bytes; NULL when the arena is full.
void* bt_arena_take(bt_arena* arena, size_t size);

/// Gives everything back at once; `mark` is an earlier value of `used` (0 for all).
void bt_arena_reset(bt_arena* arena, size_t mark);

/// A typed piece: BT_TAKE(arena, double, 7 * n)
#define BT_TAKE(arena, type, count) ((type*)bt_arena_take((arena), sizeof(type) * (size_t)(count)))

#endif
