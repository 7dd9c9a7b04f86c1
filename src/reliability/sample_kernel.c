#include "reliability/sample_kernel.h"

#include <gsl/gsl_cdf.h>
#include <string.h>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__)
#define BT_VECTOR_BYTES 64
#elif defined(__AVX2__)
#define BT_VECTOR_BYTES 32
#else
#define BT_VECTOR_BYTES 16
#endif

enum { LANES = BT_VECTOR_BYTES / 8 };

#define BT_PASTE_(a, b) a##_##b
#define BT_PASTE(a, b) BT_PASTE_(a, b)

typedef uint64_t words __attribute__((vector_size(BT_VECTOR_BYTES)));
typedef double reals __attribute__((vector_size(BT_VECTOR_BYTES)));

/// Products of the low 32 bits of each lane with a 32-bit constant, 64 bits wide.
static inline words multiply_low(words a, uint32_t b) {
#if defined(__AVX512F__)
    return (words)_mm512_mul_epu32((__m512i)a, _mm512_set1_epi64(b));
#elif defined(__AVX2__)
    return (words)_mm256_mul_epu32((__m256i)a, _mm256_set1_epi64x(b));
#elif defined(__SSE2__)
    return (words)_mm_mul_epu32((__m128i)a, _mm_set1_epi64x(b));
#else
    return (a & 0xffffffffu) * b;
#endif
}

/// Two 32-bit words to a number in (0, 1): the top 52 bits become the fraction of a double in
/// [1, 2); 1 is taken away and half a last place added, both exactly.
static inline reals to_uniform(words low, words high) {
    const words bits = (high << 32 | (low & 0xffffffffu)) >> 12;
    return ((reals)(bits | 0x3ff0000000000000u) - 1.0) + 0x1p-53;
}

/// Each 64-bit lane holds one 32-bit word of the state; what a product leaves in the upper half is
/// ignored by the next product and cut off at the end.
void BT_PASTE(bt_sample_uniforms, BT_KERNEL_LEVEL)(uint64_t seed, uint64_t first, uint32_t word2,
                                                   uint32_t word3, double a[BT_SAMPLE_BLOCK],
                                                   double b[BT_SAMPLE_BLOCK]) {
    words step;
    for (int lane = 0; lane < LANES; ++lane)
        step[lane] = (uint64_t)lane;
    for (int i = 0; i < BT_SAMPLE_BLOCK; i += LANES) {
        const words sample = step + (first + (uint64_t)i);
        words c0 = sample, c1 = sample >> 32, c2 = sample & 0, c3 = c2;
        c2 += word2;
        c3 += word3;
        uint32_t key0 = (uint32_t)seed, key1 = (uint32_t)(seed >> 32);
        for (int round = 0; round < 10; ++round) {
            const words p0 = multiply_low(c0, 0xD2511F53u), p1 = multiply_low(c2, 0xCD9E8D57u);
            c0 = p1 >> 32 ^ c1 ^ key0;
            c2 = p0 >> 32 ^ c3 ^ key1;
            c1 = p1;
            c3 = p0;
            key0 += 0x9E3779B9u;
            key1 += 0xBB67AE85u;
        }
        const reals first_number = to_uniform(c0, c1), second_number = to_uniform(c2, c3);
        memcpy(a + i, &first_number, sizeof first_number);
        memcpy(b + i, &second_number, sizeof second_number);
    }
}

/// log(1 + f) / f on [sqrt(1/2) - 1, sqrt(2) - 1], relative error 1.9e-11, and P on w - 3.125 in
/// [-3.125, 3.125], relative error 6.8e-10: interpolation at the Chebyshev nodes.
static const double log_ratio[] = {
    0x1.ffffffffe46f8p-1, -0x1.0000000316962p-1, 0x1.555555f2addd8p-2, -0x1.fffff63d83a30p-3,
    0x1.99990376c9a04p-3, -0x1.555735b4ac2f0p-3, 0x1.24ad02d454cb9p-3, -0x1.ffd022cb384b9p-4,
    0x1.c2cead04c4cb8p-4, -0x1.97635437b23e7p-4, 0x1.9b8894e04b194p-4, -0x1.9196cbb795019p-4,
    0x1.acec8a6e9ee43p-5};
static const double quantile[] = {
    0x1.2b57ec65a8009p+2,   0x1.5bc943e024c00p-1,   -0x1.179b25f11602fp-6,  -0x1.1298384a0ebd7p-9,
    0x1.14e9283c3bcc5p-11,  -0x1.499ce13bd4f6bp-15, -0x1.0340057d05872p-18, 0x1.443042dac0cacp-20,
    -0x1.5fcb2361440a9p-24, -0x1.cde4126f4bbf2p-27, 0x1.92e1a8dd40ed8p-29,  0x1.1b0916e04c55dp-36,
    -0x1.38c02aa4739ffp-35};

static inline reals polynomial(const double* c, int degree, reals x) {
    reals p = x * c[degree] + c[degree - 1];
    for (int i = degree - 2; i >= 0; --i)
        p = p * x + c[i];
    return p;
}

/// log t = e log 2 + log m, t = 2^e m, sqrt(1/2) <= m < sqrt(2).
static inline reals logarithm(reals t) {
    const words lowest = (words){0} + 0x3fe6a09e667f3bcdu; // sqrt(1/2)
    // Exponents of t in (0, 1] lie in -52 .. 0; 64 is added so that the shift needs no sign.
    const words exponent = ((words)t - lowest + ((uint64_t)64 << 52)) >> 52;
    const words mantissa = (words)t - ((exponent - 64) << 52);
    // The integer in the low bits of 2^52 + integer is exact.
    const reals e = (reals)(exponent | 0x4330000000000000u) - (0x1p52 + 64);
    const reals f = (reals)mantissa - 1.0;
    return e * 0x1.62e42fefa39efp-1 + f * polynomial(log_ratio, 12, f);
}

void BT_PASTE(bt_sample_normals, BT_KERNEL_LEVEL)(double u[BT_SAMPLE_BLOCK]) {
    const double middle = 0x1.fa0ep-10; // exp(-6.25): smaller t belong to the tails
    double kept[BT_SAMPLE_BLOCK];
    memcpy(kept, u, sizeof kept);
    words beyond = {0};
    for (int i = 0; i < BT_SAMPLE_BLOCK; i += LANES) {
        reals number;
        memcpy(&number, kept + i, sizeof number);
        const reals t = 4.0 * number * (1.0 - number);
        const reals z = (number - 0.5) * polynomial(quantile, 12, -logarithm(t) - 3.125);
        memcpy(u + i, &z, sizeof z);
        beyond |= (words)(t < middle);
    }
    uint64_t any = 0;
    for (int lane = 0; lane < LANES; ++lane)
        any |= beyond[lane];
    for (int i = 0; any && i < BT_SAMPLE_BLOCK; ++i)
        if (4.0 * kept[i] * (1.0 - kept[i]) < middle)
            u[i] = gsl_cdf_ugaussian_Pinv(kept[i]);
}
