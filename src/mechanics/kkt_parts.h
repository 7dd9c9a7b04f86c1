/// What the files of the factorisation share; for them only.
#ifndef BT_MECHANICS_KKT_PARTS_H
#define BT_MECHANICS_KKT_PARTS_H

#include "mechanics/kkt.h"

#define BT_KKT_UNROLL _Pragma("GCC unroll 6")
#define BT_KKT_INLINE static inline __attribute__((always_inline))

/// Runs a statement with N, the size of a block (1 .. 6), known to the compiler.
#define BT_KKT_FOR_SIZE(size, ...)                                                                 \
    switch (size) {                                                                                \
        BT_KKT_CASE_(1, __VA_ARGS__)                                                               \
        BT_KKT_CASE_(2, __VA_ARGS__)                                                               \
        BT_KKT_CASE_(3, __VA_ARGS__)                                                               \
        BT_KKT_CASE_(4, __VA_ARGS__)                                                               \
        BT_KKT_CASE_(5, __VA_ARGS__)                                                               \
        BT_KKT_CASE_(6, __VA_ARGS__)                                                               \
    }
#define BT_KKT_CASE_(n, ...)                                                                       \
    case n: {                                                                                      \
        enum { N = n };                                                                            \
        __VA_ARGS__;                                                                               \
        break;                                                                                     \
    }

/// Memory for that many numbers, at least one; NULL when there is none.
int* bt_kkt_ints(int count);

/// Writes the sequence, the loop joints and the joint that each body hangs on. BT_ERR_MEMORY.
BT_CHECKED bt_status bt_kkt_order(bt_kkt* kkt, const bt_kkt_joint* joints);

/// Edges, updates, slots and the size of the factor, for the sequence. BT_ERR_MEMORY.
BT_CHECKED bt_status bt_kkt_lay_out(bt_kkt* kkt, const bt_kkt_joint* joints);

#endif
