#include "near.h"

#include "reliability/sample_kernel.h"
#include "reliability/sampler.h"
#include "surrogate/predictor.h"

#include <Random123/philox.h>
#include <gsl/gsl_cdf.h>

static bt_sample_uniforms* const uniforms[] = {
    bt_sample_uniforms_v1,
#if defined(__x86_64__)
    bt_sample_uniforms_v3,
    bt_sample_uniforms_v4,
#endif
};
static bt_sample_normals* const normals[] = {
    bt_sample_normals_v1,
#if defined(__x86_64__)
    bt_sample_normals_v3,
    bt_sample_normals_v4,
#endif
};

static double top_bits(uint32_t high, uint32_t low) {
    return ((double)(((uint64_t)high << 32 | low) >> 12) + 0.5) * 0x1p-52;
}

static void uniforms_are_philox_4x32_10_at_every_level(void** state) {
    (void)state;
    const uint64_t seed = 0x123456789abcdef0, first = (7ULL << 32) - 128; // over a carry
    double a[BT_SAMPLE_BLOCK], b[BT_SAMPLE_BLOCK];
    for (int level = 0; level <= (int)bt_isa_best(); ++level) {
        uniforms[level](seed, first, 5, 9, a, b);
        for (int i = 0; i < BT_SAMPLE_BLOCK; ++i) {
            const uint64_t sample = first + (uint64_t)i;
            const philox4x32_ctr_t counter = {{(uint32_t)sample, (uint32_t)(sample >> 32), 5, 9}};
            const philox4x32_key_t key = {{(uint32_t)seed, (uint32_t)(seed >> 32)}};
            const philox4x32_ctr_t block = philox4x32(counter, key);
            const double want_a = top_bits(block.v[1], block.v[0]);
            const double want_b = top_bits(block.v[3], block.v[2]);
            assert_memory_equal(&a[i], &want_a, sizeof want_a);
            assert_memory_equal(&b[i], &want_b, sizeof want_b);
        }
    }
}

static void normals_are_the_quantile_at_every_level(void** state) {
    (void)state;
    for (int level = 0; level <= (int)bt_isa_best(); ++level)
        for (int block = 0; block < 400; ++block) {
            double u[BT_SAMPLE_BLOCK], z[BT_SAMPLE_BLOCK];
            for (int i = 0; i < BT_SAMPLE_BLOCK; ++i) {
                const int j = block * BT_SAMPLE_BLOCK + i;
                // both tails on a logarithmic scale, and the middle evenly
                const double tail = exp2(-1 - 52.0 * j / (400 * BT_SAMPLE_BLOCK));
                u[i] = j % 3 == 0 ? tail : j % 3 == 1 ? 1 - tail : (j + 0.5) / 102400;
            }
            memcpy(z, u, sizeof u);
            normals[level](z);
            for (int i = 0; i < BT_SAMPLE_BLOCK; ++i)
                BT_ASSERT_NEAR(z[i], gsl_cdf_ugaussian_Pinv(u[i]), 2e-9, 1e-15);
        }
}

static void normals_at_the_ends_are_finite_and_opposite(void** state) {
    (void)state;
    for (int level = 0; level <= (int)bt_isa_best(); ++level) {
        double z[BT_SAMPLE_BLOCK];
        for (int i = 0; i < BT_SAMPLE_BLOCK; ++i)
            z[i] = i % 2 ? 0x1p-53 : 1 - 0x1p-53; // the least and the greatest uniform number
        normals[level](z);
        BT_ASSERT_NEAR(z[1], -8.209536151601387, 1e-12, 0);
        BT_ASSERT_NEAR(z[0], 8.209536151601387, 1e-12, 0);
    }
}

static bt_sampler mixed_sampler(void) {
    bt_sampler s = {.dims = 5, .seed = 11, .stream = 3};
    s.distribution[0] = (bt_distribution){.kind = BT_NORMAL, .mean = 3.6, .sd = 0.5};
    s.distribution[1] = (bt_distribution){.kind = BT_UNIFORM, .lower = -1, .upper = 3};
    s.distribution[2] = (bt_distribution){.kind = BT_CONSTANT, .mean = 47.5};
    s.distribution[3] = (bt_distribution){.kind = BT_LOGNORMAL, .mean = 2, .sd = 0.4};
    s.distribution[4] = (bt_distribution){.kind = BT_NORMAL, .mean = 0, .sd = 1};
    return s;
}

static void a_sample_is_the_same_however_it_is_asked_for(void** state) {
    (void)state;
    const bt_sampler s = mixed_sampler();
    enum { N = 1000 };
    static double all[5 * N], one[5], part[5 * N];
    bt_sampler_draw(&s, 100, N, all);
    for (int i = 0; i < N; i += 37) {
        bt_sampler_draw(&s, (uint64_t)(100 + i), 1, one);
        assert_memory_equal(one, all + 5 * i, sizeof one);
    }
    for (int at = 0; at < N;) {
        const int n = N - at < 333 ? N - at : 333;
        bt_sampler_draw(&s, (uint64_t)(100 + at), n, part + 5 * at);
        at += n;
    }
    assert_memory_equal(part, all, sizeof all);
}

static void streams_seeds_and_variables_are_independent(void** state) {
    (void)state;
    bt_sampler s = {.dims = 4, .seed = 1, .stream = 0};
    for (int k = 0; k < 4; ++k)
        s.distribution[k] = (bt_distribution){.kind = BT_NORMAL, .mean = 0, .sd = 1};
    enum { N = 100000 };
    static double a[4 * N], b[4 * N], c[4 * N];
    bt_sampler_draw(&s, 0, N, a);
    s.stream = 1;
    bt_sampler_draw(&s, 0, N, b);
    s.seed = 2;
    bt_sampler_draw(&s, 0, N, c);
    const double* column[] = {a, a + 1, a + 2, a + 3, b, b + 1, c, c + 1};
    for (int p = 0; p < 8; ++p)
        for (int q = 0; q < p; ++q) {
            double product = 0;
            for (int i = 0; i < N; ++i)
                product += column[p][4 * i] * column[q][4 * i];
            BT_ASSERT_NEAR(product / N, 0, 0, 4.5 / sqrt(N));
        }
}

static void moments_and_shares_are_those_of_the_distributions(void** state) {
    (void)state;
    const bt_sampler s = mixed_sampler();
    enum { N = 200000 };
    static double x[5 * N];
    bt_sampler_draw(&s, 0, N, x);
    for (int k = 0; k < 5; ++k) {
        const bt_distribution* d = &s.distribution[k];
        double sum = 0, square = 0;
        int below = 0;
        const double median = bt_distribution_quantile(d, 0.5);
        for (int i = 0; i < N; ++i) {
            sum += x[5 * i + k];
            square += x[5 * i + k] * x[5 * i + k];
            below += x[5 * i + k] < median;
        }
        const double mean = bt_distribution_mean(d);
        double variance = 0; // of the quantiles, by the midpoint rule
        for (int i = 0; i < N; ++i) {
            const double away = bt_distribution_quantile(d, (i + 0.5) / N) - mean;
            variance += away * away / N;
        }
        const double sd = sqrt(variance);
        BT_ASSERT_NEAR(sum / N, mean, 1e-12, 4.5 * sd / sqrt(N));
        if (k == 2)
            continue;
        BT_ASSERT_NEAR(sqrt(square / N - sum / N * sum / N), sd, 0.01, 0);
        BT_ASSERT_NEAR((double)below / N, 0.5, 0, 4.5 * 0.5 / sqrt(N));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(uniforms_are_philox_4x32_10_at_every_level),
        cmocka_unit_test(normals_are_the_quantile_at_every_level),
        cmocka_unit_test(normals_at_the_ends_are_finite_and_opposite),
        cmocka_unit_test(a_sample_is_the_same_however_it_is_asked_for),
        cmocka_unit_test(streams_seeds_and_variables_are_independent),
        cmocka_unit_test(moments_and_shares_are_those_of_the_distributions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
