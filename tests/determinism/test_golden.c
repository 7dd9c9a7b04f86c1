/// Golden hashes: 64 landings of the reference study and 24 of the carrier study, four wires and a
/// ship that heaves, drawn from their distributions, at each level of the cable's kernel. They
/// change only in a commit that says "numbers change".
#include "near.h"

#include "base/hash.h"
#include "campaign/design.h"
#include "landing/model.h"

typedef struct golden {
    bt_kernel_level level;
    const char* name;
    uint64_t hash;
} golden;

// clang-format off
static const golden carrier[] = {
    {BT_KERNEL_V1, "v1", UINT64_C(0x642b4938afe18e9b)},
    {BT_KERNEL_V3, "v3", UINT64_C(0xab6281d152cdec8b)},
    {BT_KERNEL_V4, "v4", UINT64_C(0xab6281d152cdec8b)},
};
static const golden reference[] = {
    {BT_KERNEL_V1, "v1", UINT64_C(0xf63206ab3d51a045)},
    {BT_KERNEL_V3, "v3", UINT64_C(0x35681593cdb0832f)},
    {BT_KERNEL_V4, "v4", UINT64_C(0x35681593cdb0832f)},
};
// clang-format on

/// The libm of a machine without these takes other roundings in sine and cosine; and a build for
/// the sanitizers contracts other products in the kernel.
static bool bits_are_those_of_a_release(void) {
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    __builtin_cpu_init();
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
    return false;
#endif
}

static bool machine_has(bt_kernel_level level) {
#if defined(__x86_64__)
    return level != BT_KERNEL_V4 ||
           (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
            __builtin_cpu_supports("avx512cd"));
#else
    return level == BT_KERNEL_V1;
#endif
}

static bt_landing_result land_at(bt_landing_model* model, const bt_model_params* params) {
    bt_landing_state* state = NULL;
    bt_landing_result result;
    assert_int_equal(bt_landing_model_prepare(model, params, NULL), BT_OK);
    assert_int_equal(bt_landing_state_create(model, &state), BT_OK);
    for (bool on = bt_landing_start(model, state); on; on = bt_landing_step(model, state))
        ;
    bt_landing_finish(model, state, &result);
    bt_landing_state_destroy(state);
    return result;
}

static uint64_t hash_at(const bt_study* study, bt_kernel_level level, int landings) {
    bt_design* design = NULL;
    bt_landing_model* model = NULL;
    bt_model_params params = study->model;
    uint64_t hash = BT_HASH_START;
    assert_int_equal(bt_design_create(study, &design, NULL), BT_OK);
    assert_int_equal(bt_landing_model_create(&model), BT_OK);
    bt_landing_model_use_kernel(model, level);
    const bt_axes* axes = bt_design_get_axes(design);
    for (int64_t run = 0; run < landings; ++run) {
        double x[BT_INPUT_MAX];
        bt_design_point(design, run, x);
        for (int i = 0; i < axes->count; ++i) {
            const bt_input* input = &study->inputs[axes->input[i]];
            bt_field_set(input->field, &params, input->offset, x[i]);
        }
        const bt_landing_result r = land_at(model, &params);
        assert_int_not_equal(r.outcome, BT_FAILED);
        hash = bt_hash_bytes(hash, &r.state_hash, sizeof r.state_hash);
        hash = bt_hash_bytes(hash, &r.margin_m, sizeof r.margin_m);
        hash = bt_hash_bytes(hash, &r.outcome, sizeof r.outcome);
        for (int k = 0; r.contact_count > 1 && k < r.contact_count; ++k)
            hash = bt_hash_bytes(hash, &r.contacts[k].margin_m, sizeof r.contacts[k].margin_m);
    }
    bt_landing_model_destroy(model);
    bt_design_destroy(design);
    return hash;
}

static void keeps_its_bits(const char* file, const golden expected[3], int landings) {
    static const char* const sets[] = {"campaign.design=monte_carlo", "campaign.samples=64"};
    static bt_study study;
    int wrong = 0, tried = 0;
    if (!bits_are_those_of_a_release())
        skip();
    assert_int_equal(bt_study_read(file, sets, 2, &study, NULL), BT_OK);
    for (int k = 0; k < 3; ++k) {
        if (!machine_has(expected[k].level))
            continue;
        const uint64_t hash = hash_at(&study, expected[k].level, landings);
        ++tried;
        if (hash != expected[k].hash) {
            print_error("%s: the hash is UINT64_C(0x%016llx)\n", expected[k].name,
                        (unsigned long long)hash);
            ++wrong;
        }
    }
    bt_study_destroy(&study);
    assert_true(tried >= 2);
    if (wrong)
        fail_msg(
            "%d of %d levels changed the bits of %d landings: if that is meant, the commit says "
            "\"numbers change\"",
            wrong, tried, landings);
}

static void the_reference_keeps_its_bits(void** state) {
    (void)state;
    keeps_its_bits("studies/reference/study.yaml", reference, 64);
}

static void four_wires_keep_their_bits(void** state) {
    (void)state;
    keeps_its_bits("studies/carrier/study.yaml", carrier, 24);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_reference_keeps_its_bits),
        cmocka_unit_test(four_wires_keep_their_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
