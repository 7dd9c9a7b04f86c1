// The chapters around the model: random inputs, the box of the design, conditions, and how they
// must fit together. Each text begins with the lines under test; aircraft and deck come below.
#include "near.h"

#include "messages.h"
#include "study/study.h"

#include <stdlib.h>

static char* bulk; ///< aircraft, deck and landing of the reference study

static int setup(void** state) {
    (void)state;
    bt_study study;
    assert_int_equal(bt_study_read("studies/reference/study.yaml", NULL, 0, &study, NULL), BT_OK);
    char* end = strstr(study.text, "\nuncertainty:");
    assert_non_null(end);
    end[1] = '\0';
    bulk = strdup(strstr(study.text, "\naircraft:") + 1);
    bt_study_destroy(&study);
    return bulk ? 0 : -1;
}

static int teardown(void** state) {
    (void)state;
    free(bulk);
    return 0;
}

static bt_status read(const char* lines, bt_study* study, messages* m) {
    const size_t size = strlen(lines) + strlen(bulk) + 2;
    char* text = malloc(size);
    assert_non_null(text);
    snprintf(text, size, "%s\n%s", lines, bulk);
    *m = (messages){""};
    bt_diag diag = {.sink = messages_add, .user = m};
    const bt_status status =
        bt_study_read_text("s.yaml", text, strlen(text), NULL, 0, study, &diag);
    assert_int_equal(status == BT_OK, diag.errors == 0);
    free(text);
    return status;
}

static void assert_says(const char* lines, const char* want) {
    bt_study study;
    messages m;
    assert_int_equal(read(lines, &study, &m), BT_ERR_INPUT);
    assert_string_equal(m.text, want);
}

static void assert_reads(const char* lines, bt_study* study) {
    messages m;
    if (read(lines, study, &m) != BT_OK)
        fail_msg("%s", m.text);
    assert_string_equal(m.text, "");
}

#define PITCH "landing.pitch: {distribution: normal, mean: 3 deg, sd: 1 deg}"
#define SINK "landing.sink_speed: {distribution: normal, mean: 3.6 m/s, sd: 0.9 m/s}"

static void inputs_stand_in_the_order_of_the_tables(void** state) {
    (void)state;
    bt_study a, b;
    assert_reads("uncertainty: {" PITCH ", " SINK "}\n"
                 "campaign: {bounds: {landing.pitch: [0 deg, 8 deg], aircraft.mass: [20 t, 25 t],\n"
                 "  landing.sink_speed: [1 m/s, 6 m/s]}}\n",
                 &a);
    assert_reads("uncertainty: {" SINK ", " PITCH "}\n"
                 "campaign: {bounds: {aircraft.mass: [20 t, 25 t], landing.sink_speed: [1 m/s,\n"
                 "  6 m/s], landing.pitch: [0 deg, 8 deg]}}\n",
                 &b);
    assert_int_equal(a.input_count, 3);
    assert_string_equal(a.inputs[0].path, "aircraft.mass");
    assert_string_equal(a.inputs[1].path, "landing.sink_speed");
    assert_string_equal(a.inputs[2].path, "landing.pitch");
    assert_true(a.inputs[0].bounded && !a.inputs[0].random);
    assert_true(a.inputs[0].lower == 20000 && a.inputs[0].upper == 25000);
    assert_true(a.inputs[1].bounded && a.inputs[1].random);
    assert_int_equal(a.inputs[1].distribution.kind, BT_NORMAL);
    assert_true(a.inputs[1].distribution.sd == 0.9);
    assert_true(a.inputs[2].distribution.sd == M_PI / 180);
    assert_ptr_equal(a.inputs[2].field, bt_group_find(&bt_model_group, "landing.pitch", NULL));
    assert_int_equal(a.inputs[2].offset, offsetof(bt_model_params, landing.pitch_rad));
    assert_true(a.hash == b.hash);
    assert_string_equal(a.inputs[1].where.file, "s.yaml");
    assert_int_equal(a.inputs[1].where.line, 1);
    bt_study_destroy(&a);
    bt_study_destroy(&b);
}

static void every_distribution_is_read_with_its_parameters(void** state) {
    (void)state;
    bt_study s;
    assert_reads(
        "uncertainty:\n"
        "  aircraft.mass: {distribution: truncated_normal, sd: 1 t, lower: 18 t, upper: 26 t}\n"
        "  aircraft.hook.mass: {distribution: lognormal, mean: 100 kg, sd: 5 kg}\n"
        "  aircraft.hook.deck_contact.friction: {distribution: uniform, lower: 0.1, upper: 0.4}\n"
        "  deck.cable.pretension: {distribution: triangular, lower: 20 kN, mode: 24 kN, upper: 30 "
        "kN}\n"
        "  landing.sink_speed: {distribution: weibull, scale: 4 m/s, shape: 3.5}\n"
        "  landing.horizontal_speed: {distribution: gumbel, mode: 47 m/s, scale: 2 m/s}\n"
        "  landing.pitch: {distribution: constant}\n"
        "  landing.distance: {distribution: exponential, mean: 6 m}\n",
        &s);
    assert_int_equal(s.input_count, 8);
    const bt_distribution* d = &s.inputs[0].distribution;
    assert_true(d->kind == BT_TRUNCATED_NORMAL && d->mean == s.model.aircraft.mass_kg &&
                d->sd == 1000 && d->lower == 18000 && d->upper == 26000);
    d = &s.inputs[1].distribution;
    assert_true(d->kind == BT_LOGNORMAL && d->mean == 100 && d->sd == 5);
    d = &s.inputs[2].distribution;
    assert_true(d->kind == BT_UNIFORM && d->lower == 0.1 && d->upper == 0.4);
    d = &s.inputs[3].distribution;
    assert_true(d->kind == BT_TRIANGULAR && d->mode == 24000);
    d = &s.inputs[4].distribution;
    assert_true(d->kind == BT_WEIBULL && d->scale == 4 && d->shape == 3.5 && d->lower == 0);
    d = &s.inputs[5].distribution;
    assert_true(d->kind == BT_GUMBEL && d->mode == 47 && d->scale == 2);
    d = &s.inputs[6].distribution;
    assert_true(d->kind == BT_CONSTANT && d->mean == s.model.landing.pitch_rad);
    d = &s.inputs[7].distribution;
    assert_true(d->kind == BT_EXPONENTIAL && d->mean == 6 && d->lower == 0);
    bt_study_destroy(&s);
}

static void unsound_distributions(void** state) {
    (void)state;
    assert_says("uncertainty:\n  landing.pitch: {mean: 3 deg, sd: 1 deg}\n",
                "s.yaml:2:3: error: uncertainty.landing.pitch.distribution: missing; wanted: "
                "normal, uniform, ...\n");
    assert_says("uncertainty:\n  landing.pitch: {distribution: nomal, sd: 1 deg}\n",
                "s.yaml:2:33: error: uncertainty.landing.pitch.distribution: \"nomal\" is none of "
                "normal, truncated_normal, lognormal, uniform, triangular, weibull, gumbel, "
                "exponential, constant, beta, gamma, rayleigh, logistic, log_uniform, student, "
                "discrete, empirical; did you mean \"normal\"?\n");
    assert_says("uncertainty:\n  landing.pitch: {distribution: normal, mean: 3 deg}\n",
                "s.yaml:2:3: error: uncertainty.landing.pitch.sd: missing; normal needs it\n");
    assert_says("uncertainty:\n  landing.pitch: {distribution: normal, sd: 1 deg, upper: 8 deg}\n",
                "s.yaml:2:52: error: uncertainty.landing.pitch.upper: unknown key; known here: "
                "distribution, mean, sd\n");
    assert_says("uncertainty:\n  landing.pitch: {distribution: normal, sd: 1 m}\n",
                "s.yaml:2:45: error: uncertainty.landing.pitch.sd: \"1 m\" has a unit of another "
                "dimension; use deg, rad or mrad\n");
    assert_says("uncertainty:\n  landing.pitch: {distribution: normal, sd: -1 deg}\n",
                "s.yaml:2:3: error: uncertainty.landing.pitch: sd must be positive\n");
    assert_says("uncertainty:\n  landing.pitch: {distribution: normal, mean: 40 deg, sd: 1 deg}\n",
                "s.yaml:2:47: error: uncertainty.landing.pitch.mean: 40 deg is outside -20.0535 .. "
                "20.0535 deg\n");
    assert_says(
        "uncertainty:\n  landing.pitch: {distribution: uniform, lower: 0 deg, upper: 30 deg}\n",
        "s.yaml:2:63: error: uncertainty.landing.pitch.upper: 30 deg is outside -20.0535 .. "
        "20.0535 deg\n");
    assert_says("uncertainty:\n  landing.pitch: normal\n",
                "s.yaml:2:18: error: uncertainty.landing.pitch: a mapping of keys is wanted here, "
                "not a value\n");
    assert_says("uncertainty: [1]\n", "s.yaml:1:14: error: uncertainty: a mapping of keys is "
                                      "wanted here, not a sequence\n");
    assert_says("uncertainty:\n  " PITCH "\n  " PITCH "\n",
                "s.yaml:3:3: error: uncertainty.landing.pitch: given twice; first in line 2\n");
}

static void paths_that_are_no_inputs(void** state) {
    (void)state;
    assert_says("uncertainty:\n  landing.ptch: {distribution: normal, sd: 1 deg}\n",
                "s.yaml:2:3: error: uncertainty.landing.ptch: no such key of the model; did you "
                "mean \"landing.pitch\"?\n");
    assert_says("uncertainty:\n  nothing: {distribution: normal, sd: 1 deg}\n",
                "s.yaml:2:3: error: uncertainty.nothing: no such key of the model; it must be a "
                "path as in landing.sink_speed\n");
    assert_says(
        "campaign:\n  bounds:\n    aircraft.hook: [1 m, 2 m]\n",
        "s.yaml:3:5: error: campaign.bounds.aircraft.hook: a group of keys; name one of its "
        "values, as in aircraft.hook.pivot_x\n");
    assert_says("campaign:\n  bounds:\n    landing.distance_from: [hook, main_wheels]\n",
                "s.yaml:3:5: error: campaign.bounds.landing.distance_from: only a number that may "
                "take any value in a range can vary\n");
}

static void unsound_bounds(void** state) {
    (void)state;
    assert_says("campaign:\n  bounds:\n    landing.pitch: 3 deg\n",
                "s.yaml:3:20: error: campaign.bounds.landing.pitch: a range [least, greatest] is "
                "wanted here\n");
    assert_says("campaign:\n  bounds:\n    landing.pitch: [3 deg]\n",
                "s.yaml:3:20: error: campaign.bounds.landing.pitch: a range has two values; this "
                "has 1\n");
    assert_says("campaign:\n  bounds:\n    landing.pitch: [3 deg, 3 deg]\n",
                "s.yaml:3:20: error: campaign.bounds.landing.pitch: 3 deg is not below 3 deg\n");
    assert_says(
        "campaign:\n  bounds:\n    landing.pitch: [3, 40 deg]\n",
        "s.yaml:3:21: error: campaign.bounds.landing.pitch: \"3\" has no unit; use deg, rad "
        "or mrad\n"
        "s.yaml:3:24: error: campaign.bounds.landing.pitch: 40 deg is outside -20.0535 .. "
        "20.0535 deg\n");
}

static void random_inputs_must_be_axes_of_the_design(void** state) {
    (void)state;
    assert_says("uncertainty:\n  " PITCH "\n  " SINK "\n"
                "campaign:\n  bounds:\n    landing.pitch: [0 deg, 8 deg]\n",
                "s.yaml:3:3: error: uncertainty.landing.sink_speed: random, but no axis of the "
                "design; give it a range in campaign.bounds\n");
    assert_says("uncertainty:\n  " PITCH "\n"
                "campaign:\n  bounds:\n    landing.pitch: [4 deg, 8 deg]\n",
                "s.yaml:2:3: error: uncertainty.landing.pitch: its mean lies outside its "
                "campaign.bounds\n");
    bt_study s;
    assert_reads("uncertainty:\n  " PITCH "\n  " SINK "\n"
                 "campaign:\n  design: monte_carlo\n",
                 &s); // no surrogate's box to be inside of
    assert_int_equal(s.campaign.design, BT_DESIGN_MONTE_CARLO);
    bt_study_destroy(&s);
}

static void levels_belong_to_axes_of_a_full_factorial(void** state) {
    (void)state;
    bt_study s;
    assert_reads("campaign:\n  design: full_factorial\n  bounds: {landing.pitch: [0 deg, 8 deg]}\n"
                 "  levels: {landing.pitch: 9}\n",
                 &s);
    assert_int_equal(s.inputs[0].levels, 9);
    bt_study_destroy(&s);
    assert_says("campaign:\n  design: full_factorial\n  bounds: {landing.pitch: [0 deg, 8 deg]}\n"
                "  levels: {landing.yaw: 9, landing.pitch: 1}\n",
                "s.yaml:4:12: error: campaign.levels.landing.yaw: has no range in "
                "campaign.bounds\n"
                "s.yaml:4:43: error: campaign.levels.landing.pitch: 1 is outside 2 .. 1e6\n");
    assert_says("campaign:\n  design: sobol\n  bounds: {landing.pitch: [0 deg, 8 deg]}\n"
                "  levels: {landing.pitch: 9}\n",
                "s.yaml:4:3: error: campaign.levels: only the design full_factorial has levels, "
                "not sobol\n");
}

static void conditions_move_means_of_random_inputs_inside_the_box(void** state) {
    (void)state;
    bt_study s;
    assert_reads("uncertainty: {" PITCH "}\n"
                 "campaign: {bounds: {landing.pitch: [0 deg, 8 deg]}}\n"
                 "reliability: {samples: 5e5, conditions: {landing.pitch: [1 deg, 100 mrad]}}\n",
                 &s);
    assert_int_equal(s.condition_count, 2);
    assert_int_equal(s.conditions[1].input, 0);
    assert_true(s.conditions[0].mean == M_PI / 180 && s.conditions[1].mean == 0.1);
    assert_int_equal(s.reliability.samples, 500000);
    bt_study_destroy(&s);

    assert_says("uncertainty: {" PITCH "}\n"
                "campaign: {bounds: {landing.pitch: [0 deg, 8 deg]}}\n"
                "reliability:\n  conditions:\n    landing.pitch: [1 deg, 9 deg, 1 m]\n"
                "    landing.yaw: [1 deg]\n",
                "s.yaml:5:28: error: reliability.conditions.landing.pitch: 9 deg is outside "
                "campaign.bounds, 0 .. 8 deg\n"
                "s.yaml:5:35: error: reliability.conditions.landing.pitch: \"1 m\" has a unit of "
                "another dimension; use deg, rad or mrad\n"
                "s.yaml:6:5: error: reliability.conditions.landing.yaw: has no distribution in "
                "uncertainty whose mean could move\n");
    assert_says("uncertainty: {" PITCH "}\n"
                "reliability:\n  conditions:\n    landing.pitch: 1 deg\n",
                "s.yaml:4:20: error: reliability.conditions.landing.pitch: a sequence of means is "
                "wanted here\n");
}

static void a_key_keeps_its_former_name(void** state) {
    (void)state;
    bt_study s;
    assert_reads("reliability:\n  truth_runs: 17\n", &s);
    assert_int_equal(s.reliability.high_fidelity_runs, 17);
    assert_non_null(strstr(s.text, "high_fidelity_runs: 17"));
    bt_study_destroy(&s);
    assert_says(
        "reliability:\n  truth_runs: 17\n  high_fidelity_runs: 17\n",
        "s.yaml:2:3: error: truth_runs: stands in the place of high_fidelity_runs; give one of "
        "them\n");
}

static void mistakes_in_one_chapter_do_not_hide_those_in_another(void** state) {
    (void)state;
    assert_says(
        "titel: x\n"
        "uncertainty:\n  landing.pitch: {distribution: normal, sd: 1}\n"
        "campaign: {samples: 1.5}\n"
        "reliability:\n  conditions:\n    landing.pitch: [1 m]\n"
        "surrogate: {folds: 1}\n"
        "rigs: {nose_drop: 1}\n",
        "s.yaml:1:1: error: titel: unknown key; did you mean \"title\"?\n"
        "s.yaml:3:45: error: uncertainty.landing.pitch.sd: \"1\" has no unit; use deg, rad "
        "or mrad\n"
        "s.yaml:4:21: error: campaign.samples: \"1.5\" is not a whole number; write it as "
        "42000\n"
        "s.yaml:7:21: error: reliability.conditions.landing.pitch: \"1 m\" has a unit of "
        "another dimension; use deg, rad or mrad\n"
        "s.yaml:8:20: error: surrogate.folds: 1 is outside 2 .. 100\n"
        "s.yaml:9:19: error: rigs.nose_drop: a mapping of keys is wanted here, not a value\n");
}

static void there_is_room_for_so_many_inputs_and_conditions(void** state) {
    (void)state;
    char lines[4096] =
        "uncertainty: {" PITCH "}\nreliability:\n  conditions:\n    landing.pitch: [";
    for (int i = 0; i < BT_CONDITION_MAX + 1; ++i)
        strcat(lines, "1 deg,");
    strcat(lines, "]\n");
    assert_says(lines, "s.yaml:4:405: error: reliability.conditions.landing.pitch: more than 64 "
                       "conditions\n");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inputs_stand_in_the_order_of_the_tables),
        cmocka_unit_test(every_distribution_is_read_with_its_parameters),
        cmocka_unit_test(unsound_distributions),
        cmocka_unit_test(paths_that_are_no_inputs),
        cmocka_unit_test(unsound_bounds),
        cmocka_unit_test(random_inputs_must_be_axes_of_the_design),
        cmocka_unit_test(levels_belong_to_axes_of_a_full_factorial),
        cmocka_unit_test(conditions_move_means_of_random_inputs_inside_the_box),
        cmocka_unit_test(a_key_keeps_its_former_name),
        cmocka_unit_test(mistakes_in_one_chapter_do_not_hide_those_in_another),
        cmocka_unit_test(there_is_room_for_so_many_inputs_and_conditions),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
