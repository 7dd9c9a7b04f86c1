#include "reliability/sampler.h"

#include "reliability/sample_kernel.h"
#include "surrogate/predictor.h"

/// Word 3 of the counter: these numbers are not those of bt_rng_uniform, which has 0 there.
static const uint32_t DOMAIN_WORD = 0x426f6c74u;

typedef struct kernels {
    bt_sample_uniforms* uniforms;
    bt_sample_normals* normals;
} kernels;

static kernels choose_kernels(void) {
#if defined(__x86_64__)
    switch (bt_isa_best()) {
    case BT_ISA_V4:
        return (kernels){bt_sample_uniforms_v4, bt_sample_normals_v4};
    case BT_ISA_V3:
        return (kernels){bt_sample_uniforms_v3, bt_sample_normals_v3};
    default:
        break;
    }
#endif
    return (kernels){bt_sample_uniforms_v1, bt_sample_normals_v1};
}

/// Variable k of the block's samples from .. from + n - 1, written to x[k], x[dims + k], ...
static void put_variable(const kernels* kernel, const bt_distribution* d, double* u, int from,
                         int n, int dims, double* x) {
    if (d->kind == BT_NORMAL) {
        kernel->normals(u);
        for (int i = 0; i < n; ++i)
            x[i * dims] = d->mean + d->sd * u[from + i];
    } else if (d->kind == BT_CONSTANT) {
        for (int i = 0; i < n; ++i)
            x[i * dims] = d->mean;
    } else {
        for (int i = 0; i < n; ++i)
            x[i * dims] = bt_distribution_quantile(d, u[from + i]);
    }
}

/// The block's samples from .. from + n - 1 when the variables are bound: row by row.
static void draw_bound(const kernels* kernel, const bt_sampler* sampler, uint64_t first, int from,
                       int n, double* x) {
    const int dims = sampler->dims;
    double u[BT_INPUT_MAX + 1][BT_SAMPLE_BLOCK], row[BT_INPUT_MAX];
    for (int k = 0; k < dims; k += 2)
        kernel->uniforms(sampler->seed, first, (uint32_t)(k / 2) | sampler->stream << 8,
                         DOMAIN_WORD, u[k], u[k + 1]);
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < dims; ++k)
            row[k] = u[k][from + i];
        bt_copula_bind(sampler->copula, row);
        for (int k = 0; k < dims; ++k)
            x[i * dims + k] = bt_distribution_quantile(&sampler->distribution[k], row[k]);
    }
}

void bt_sampler_draw(const bt_sampler* sampler, uint64_t first, int n, double* x) {
    const kernels kernel = choose_kernels();
    const int dims = sampler->dims;
    double a[BT_SAMPLE_BLOCK], b[BT_SAMPLE_BLOCK];
    while (n > 0) {
        // Blocks lie on a fixed raster, so that a sample's bits do not depend on the call.
        const int from = (int)(first % BT_SAMPLE_BLOCK);
        const int count = n < BT_SAMPLE_BLOCK - from ? n : BT_SAMPLE_BLOCK - from;
        const bool bound = sampler->copula && sampler->copula->dims > 0;
        if (bound)
            draw_bound(&kernel, sampler, first - (uint64_t)from, from, count, x);
        for (int k = 0; k < dims && !bound; k += 2) {
            const uint32_t word2 = (uint32_t)(k / 2) | sampler->stream << 8;
            kernel.uniforms(sampler->seed, first - (uint64_t)from, word2, DOMAIN_WORD, a, b);
            put_variable(&kernel, &sampler->distribution[k], a, from, count, dims, x + k);
            if (k + 1 < dims)
                put_variable(&kernel, &sampler->distribution[k + 1], b, from, count, dims,
                             x + k + 1);
        }
        first += (uint64_t)count;
        n -= count;
        x += (size_t)count * (size_t)dims;
    }
}
