#include "surrogate/predict_kernel.h"

#include <stdint.h>
#include <string.h>

#if defined(__AVX512F__)
#define BT_VECTOR_BYTES 64
#elif defined(__AVX2__)
#define BT_VECTOR_BYTES 32
#else
#define BT_VECTOR_BYTES 16
#endif

#define BT_PASTE_(a, b, c) a##b##_##c
#define BT_PASTE(a, b, c) BT_PASTE_(a, b, c)

// Coefficients: interpolation of 2^f at the Chebyshev nodes of [-1/2, 1/2]; relative error
// 1.0e-7 (degree 5) and 4.2e-18 (degree 11).
#define REAL float
#define INTEGER uint32_t
#define KERNEL BT_KERNEL_LEVEL
#define NAME(word) BT_PASTE(bt_predict_, float, word)
#define EXPONENT_SHIFT 23
#define LEAST_EXPONENT -125.5f
#define ROUNDER 0x1.8p23f
#define EXP2_COEFFICIENTS                                                                          \
    0x1.0000014413897p+0f, 0x1.62e4302fc626ep-1f, 0x1.ebf906e26e833p-3f, 0x1.c6af6cdbbdcc7p-5f,    \
        0x1.3d10705276a1dp-7f, 0x1.5f0890162a90ap-10f
#include "surrogate/predict_lanes.h"
#undef REAL
#undef INTEGER
#undef NAME
#undef EXPONENT_SHIFT
#undef LEAST_EXPONENT
#undef ROUNDER
#undef EXP2_COEFFICIENTS

#define REAL double
#define INTEGER uint64_t
#define NAME(word) BT_PASTE(bt_predict_, double, word)
#define EXPONENT_SHIFT 52
#define LEAST_EXPONENT -1021.5
#define ROUNDER 0x1.8p52
#define EXP2_COEFFICIENTS                                                                          \
    0x1.0000000000000p+0, 0x1.62e42fefa39efp-1, 0x1.ebfbdff82c5aep-3, 0x1.c6b08d704a0c6p-5,        \
        0x1.3b2ab6fb9f1a5p-7, 0x1.5d87fe78a3f9cp-10, 0x1.430913112c61bp-13, 0x1.ffcbfc6da6ed1p-17, \
        0x1.62bfc2c86d700p-20, 0x1.b524ebd13a55fp-24, 0x1.e6228acd1c6e5p-28, 0x1.e9ec1fcb69a7fp-32
#include "surrogate/predict_lanes.h"
