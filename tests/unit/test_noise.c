#include "reference.h"

#include "pipeline/noise.h"
#include <stdlib.h>

static bt_noise_landing landing(bt_outcome outcome, double margin_m) {
    return (bt_noise_landing){.outcome = outcome, .margin_m = margin_m, .wall_s = 0.02};
}

static void counts_flips_failures_and_margins_on_the_wrong_side(void** state) {
    (void)state;
    const bt_noise_landing first[] = {landing(BT_ENGAGED, 0.02), landing(BT_MISSED, -0.01),
                                      landing(BT_ENGAGED, 0.001), landing(BT_MISSED, -0.03),
                                      landing(BT_ENGAGED, 0.04)};
    const bt_noise_landing second[] = {landing(BT_ENGAGED, 0.021), landing(BT_MISSED, 0.002),
                                       landing(BT_MISSED, -0.001), landing(BT_FAILED, NAN),
                                       landing(BT_ENGAGED, 0.04)};
    bt_noise_difference d;
    assert_int_equal(bt_noise_compare(first, second, 5, &d), BT_OK);
    assert_int_equal(d.flips, 2); // engaged to missed, missed to failed
    assert_int_equal(d.failed, 1);
    assert_int_equal(d.wrong_side, 1);
    // moved by 0, 1, 2, 12 mm where both have a margin
    BT_ASSERT_NEAR(d.margin_median_m, 0.001, 1e-9, 0);
    BT_ASSERT_NEAR(d.margin_p99_m, 0.012, 1e-9, 0);
    BT_ASSERT_NEAR(d.wall_s, 0.02, 1e-12, 0);
}

static void nothing_differs_from_itself(void** state) {
    (void)state;
    const bt_noise_landing all_failed[] = {landing(BT_FAILED, NAN), landing(BT_FAILED, NAN)};
    bt_noise_difference d;
    assert_int_equal(bt_noise_compare(all_failed, all_failed, 2, &d), BT_OK);
    assert_int_equal(d.flips, 0);
    assert_int_equal(d.failed, 2);
    assert_int_equal(d.wrong_side, 0);
    assert_true(isnan(d.margin_median_m));
}

static void every_variant_changes_keys_that_exist(void** state) {
    (void)state;
    int variants = 0;
    for (const bt_noise_variant* v = bt_noise_variants; v->name; ++v, ++variants) {
        assert_true(v->changes[0].path != NULL);
        for (const bt_noise_change* change = v->changes; change->path; ++change) {
            size_t offset;
            const bt_field* field = bt_group_find(&bt_model_group, change->path, &offset);
            assert_non_null(field);
            // twice as coarse or fine as the default must be an allowed value
            const double value = change->factor * field->fallback;
            if (!(value >= field->least && value <= field->greatest))
                fail_msg("%s: %s = %g is not allowed", v->name, change->path, value);
        }
    }
    assert_true(variants >= 4);
}

/// Landings depend on seed and number only: not on threads, nor on how many are drawn.
static void landings_are_the_same_for_any_number_of_threads_and_landings(void** state) {
    (void)state;
    bt_study* study = malloc(sizeof *study);
    assert_int_equal(bt_study_read("studies/reference/study.yaml", NULL, 0, study, NULL), BT_OK);
    study->campaign.seed = 5;
    bt_noise_landing few[3], many[6];
    memset(few, 0, sizeof few);
    memset(many, 0, sizeof many);
    assert_int_equal(bt_noise_run(study, NULL, 3, 1, NULL, NULL, few, NULL), BT_OK);
    assert_int_equal(bt_noise_run(study, NULL, 6, 2, NULL, NULL, many, NULL), BT_OK);
    for (int i = 0; i < 3; ++i) {
        assert_true(few[i].outcome != BT_FAILED);
        assert_int_equal(few[i].outcome, many[i].outcome);
        assert_memory_equal(&few[i].margin_m, &many[i].margin_m, sizeof few[i].margin_m);
        assert_memory_equal(few[i].x, many[i].x, sizeof few[i].x);
    }
    assert_int_equal(study->campaign.design, BT_DESIGN_CONDITIONS); // the study is left as it was
    bt_study_destroy(study);
    free(study);
}

static void another_wire_is_another_outcome(void** state) {
    (void)state;
    bt_noise_landing first[] = {landing(BT_ENGAGED, 0.02), landing(BT_ENGAGED, 0.02)};
    bt_noise_landing second[] = {landing(BT_ENGAGED, 0.02), landing(BT_ENGAGED, 0.02)};
    first[0].wire = first[1].wire = second[0].wire = 2;
    second[1].wire = 3;
    bt_noise_difference d;
    assert_int_equal(bt_noise_compare(first, second, 2, &d), BT_OK);
    assert_int_equal(d.flips, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(another_wire_is_another_outcome),
        cmocka_unit_test(counts_flips_failures_and_margins_on_the_wrong_side),
        cmocka_unit_test(nothing_differs_from_itself),
        cmocka_unit_test(every_variant_changes_keys_that_exist),
        cmocka_unit_test(landings_are_the_same_for_any_number_of_threads_and_landings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
