#include "base/arena.h"

#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64 };

bt_status bt_arena_create(bt_arena* arena, size_t size) {
    *arena = (bt_arena){0};
    size = (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    arena->base = aligned_alloc(ALIGNMENT, size);
    if (!arena->base)
        return BT_ERR_MEMORY;
    arena->size = size;
    return BT_OK;
}

void bt_arena_destroy(bt_arena* arena) {
    free(arena->base);
    *arena = (bt_arena){0};
}

void* bt_arena_take(bt_arena* arena, size_t size) {
    if (size > arena->size - arena->used)
        return NULL;
    const size_t padded = (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    void* piece = arena->base + arena->used;
    arena->used += padded < arena->size - arena->used ? padded : arena->size - arena->used;
    if (arena->used > arena->peak)
        arena->peak = arena->used;
    return memset(piece, 0, size);
}

void bt_arena_reset(bt_arena* arena, size_t mark) {
    arena->used = mark;
}
