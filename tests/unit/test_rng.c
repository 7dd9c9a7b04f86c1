#include "near.h"

#include "base/rng.h"

#include <Random123/philox.h>

static void philox_gives_the_published_known_answers(void** state) {
    (void)state;
    // Random123, kat_vectors: philox4x32, 10 rounds
    static const struct {
        philox4x32_ctr_t counter;
        philox4x32_key_t key;
        uint32_t answer[4];
    } rows[] = {
        {{{0, 0, 0, 0}}, {{0, 0}}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
        {{{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}},
         {{0xffffffff, 0xffffffff}},
         {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
        {{{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}},
         {{0xa4093822, 0x299f31d0}},
         {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        const philox4x32_ctr_t block = philox4x32(rows[i].counter, rows[i].key);
        assert_memory_equal(block.v, rows[i].answer, sizeof rows[i].answer);
    }
    assert_int_equal(bt_rng_bits(0, 0, 0), 0xe169c58d6627e8d5u);
}

static void key_parts_reach_the_counter_in_full(void** state) {
    (void)state;
    const uint64_t seed = 0xa409382212345678u, run = 0x85a308d3243f6a88u;
    const philox4x32_ctr_t counter = {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0}};
    const philox4x32_key_t key = {{0x12345678, 0xa4093822}};
    const philox4x32_ctr_t block = philox4x32(counter, key);
    assert_true(bt_rng_bits(seed, run, 0x13198a2e) == ((uint64_t)block.v[1] << 32 | block.v[0]));
}

static void uniform_numbers_stay_inside_zero_and_one(void** state) {
    (void)state;
    // both ends of the conversion
    assert_true((0 + 0.5) * 0x1p-52 == 0x1p-53);
    assert_true(((double)((UINT64_C(1) << 52) - 1) + 0.5) * 0x1p-52 == 1 - 0x1p-53);
    for (uint64_t run = 0; run < 100000; ++run) {
        const double u = bt_rng_uniform(3, run, 1);
        assert_true(u >= 0x1p-53 && u <= 1 - 0x1p-53);
    }
}

static void uniform_numbers_fill_the_unit_interval_evenly(void** state) {
    (void)state;
    enum { BINS = 64, DRAWS = 64000 };
    int count[BINS] = {0};
    double sum = 0;
    for (uint64_t run = 0; run < DRAWS; ++run) {
        const double u = bt_rng_uniform(11, run, 2);
        ++count[(int)(u * BINS)];
        sum += u;
    }
    double chi2 = 0;
    for (int i = 0; i < BINS; ++i)
        chi2 += (count[i] - DRAWS / BINS) * (count[i] - DRAWS / BINS) / (double)(DRAWS / BINS);
    assert_true(chi2 > 30.7 && chi2 < 111.1); // 63 degrees of freedom, 0.01 .. 99.99 %
    BT_ASSERT_NEAR(sum / DRAWS, 0.5, 0, 4 / sqrt(12.0 * DRAWS)); // four standard errors
}

static void a_number_depends_on_its_key_alone(void** state) {
    (void)state;
    const double first = bt_rng_uniform(5, 17342, 3);
    (void)bt_rng_uniform(5, 1, 0);
    assert_true(bt_rng_uniform(5, 17342, 3) == first);
    assert_true(bt_rng_uniform(6, 17342, 3) != first);
    assert_true(bt_rng_uniform(5, 17343, 3) != first);
    assert_true(bt_rng_uniform(5, 17342, 4) != first);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(philox_gives_the_published_known_answers),
        cmocka_unit_test(key_parts_reach_the_counter_in_full),
        cmocka_unit_test(uniform_numbers_stay_inside_zero_and_one),
        cmocka_unit_test(uniform_numbers_fill_the_unit_interval_evenly),
        cmocka_unit_test(a_number_depends_on_its_key_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
