// Calibration: the reference hook is what it finds; known parameters come back; what the data do
// not tell is said.
#include "reference.h"

#include "calibration/calibration.h"
#include "calibration/identify.h"
#include "folder.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static char folder[FOLDER_SIZE];

static int make_folder(void** state) {
    (void)state;
    return folder_make(folder);
}

static int remove_folder(void** state) {
    char path[512];
    (void)state;
    static const char* const names[] = {"calibration.yaml", "curve.csv"};
    for (size_t i = 0; i < 2; ++i) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    return rmdir(folder);
}

static void write_file(const char* name, const char* text) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE* out = fopen(path, "w");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fclose(out), 0);
}

/// Reads a calibration file against the reference study; messages go to `kept`.
static bt_status read_against_reference(const char* path, bt_calibration* c, messages* kept) {
    static bt_study study; // large
    *kept = (messages){""};
    bt_diag diag = {.sink = keep_message, .user = kept};
    assert_int_equal(bt_study_read("studies/reference/study.yaml", NULL, 0, &study, &diag), BT_OK);
    const bt_status status = bt_calibration_read(path, &study, c, &diag);
    bt_study_destroy(&study);
    return status;
}

static void fit_file(const char* path, bt_calibration* c, bt_fit* fit) {
    messages kept;
    bt_diag diag = {.sink = keep_message, .user = &kept};
    if (read_against_reference(path, c, &kept) != BT_OK ||
        bt_calibration_fit(c, fit, NULL, NULL, NULL, &diag) != BT_OK)
        fail_msg("%s", kept.text);
}

/// The same for a text.
static void fit_text(const char* text, bt_calibration* c, bt_fit* fit) {
    char path[512];
    write_file("calibration.yaml", text);
    snprintf(path, sizeof path, "%s/calibration.yaml", folder);
    fit_file(path, c, fit);
}

/// The reference study; the caller destroys it.
static bt_study* read_reference(void) {
    static bt_study study; // large
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    if (bt_study_read("studies/reference/study.yaml", NULL, 0, &study, &diag) != BT_OK)
        fail_msg("%s", kept.text);
    return &study;
}

// --- the reference ----------------------------------------------------------------------------

static void reference_hook_is_what_the_calibration_finds(void** state) {
    (void)state;
    bt_calibration c;
    bt_fit fit;
    fit_file("studies/reference/calibration.yaml", &c, &fit);
    assert_true(fit.converged);
    for (int i = 0; i < c.target_count; ++i)
        if (!fit.targets[i].met)
            fail_msg("not met: %s", c.targets[i].name);
    const bt_model_params reference = REFERENCE("landing.roll=0 deg");
    for (int k = 0; k < c.parameter_count; ++k) {
        const bt_parameter* p = &c.parameters[k];
        // rounded in aircraft.yaml, by far less than the data tell
        BT_ASSERT_NEAR(bt_field_get(p->field, &reference, p->offset), fit.value[k], 0,
                       0.1 * fit.standard_error[k]);
    }
    // two heights and one distance cannot tell four numbers
    assert_int_equal(fit.identified_directions, 3);
    bt_calibration_destroy(&c);
}

// --- known parameters -------------------------------------------------------------------------

/// The nose leg's gas volume and discharge coefficient, from its own drop test: targets are what
/// the model gives with 3.33 L and 0.65.
static void known_parameters_come_back_from_a_drop_test(void** state) {
    (void)state;
    bt_study* study = read_reference();
    const bt_aircraft_params truth = study->model.aircraft;
    bt_rig_result drop;
    study->rigs.nose_drop.mass_kg = 3300;
    assert_int_equal(bt_rig_run(BT_RIG_NOSE_DROP, &truth, &study->rigs, &drop, NULL, NULL, NULL),
                     BT_OK);
    bt_study_destroy(study);
    char text[2048];
    int length =
        snprintf(text, sizeof text,
                 "parameters:\n"
                 "  aircraft.nose_gear.oleo.air_volume: {lower: 3 L, upper: 5 L, start: 4 L}\n"
                 "  aircraft.nose_gear.oleo.discharge: {lower: 0.5, upper: 0.9, start: 0.8}\n"
                 "under: {rigs.nose_drop.mass: 3300 kg}\n"
                 "starts: 4\n" // from the first the leg bottoms: a valley of its own
                 "targets:\n");
    for (int i = 0; i < drop.metric_count && i < 4; ++i) {
        const bt_metric* m = &drop.metrics[i];
        const int name = (int)(strrchr(m->name, '_') - m->name);
        length += snprintf(text + length, sizeof text - (size_t)length,
                           "  - {metric: nose_drop.%.*s, value: %.12g %s, tolerance: 1 %%}\n", name,
                           m->name, m->value, m->unit);
    }
    bt_calibration c;
    bt_fit fit;
    fit_text(text, &c, &fit);
    assert_true(fit.cost < 1e-4);
    assert_int_equal(fit.identified_directions, 2);
    BT_ASSERT_NEAR(fit.value[0], truth.nose_gear.oleo.air_volume_m3, 2e-3, 0);
    BT_ASSERT_NEAR(fit.value[1], truth.nose_gear.oleo.discharge, 2e-3, 0);
    bt_calibration_destroy(&c);
}

/// Keeps the stroke of a drop at every hundredth of a second.
typedef struct sampler {
    char text[8192];
    double next_s;
} sampler;

static void keep_stroke(void* user, const bt_rig_sample* sample) {
    sampler* s = user;
    if (sample->time_s < s->next_s - 1e-9 || s->next_s > 0.395)
        return;
    s->next_s += 0.01;
    for (int i = 0; i < sample->count; ++i)
        if (strcmp(sample->names[i], "stroke_m") == 0) {
            const size_t used = strlen(s->text);
            snprintf(s->text + used, sizeof s->text - used, "%.9g, %.9g\n", 1e3 * sample->time_s,
                     1e3 * sample->values[i]);
        }
}

static void a_measured_curve_gives_its_parameter_back(void** state) {
    (void)state;
    bt_study* study = read_reference();
    const bt_aircraft_params truth = study->model.aircraft;
    static sampler curve;
    curve = (sampler){"# stroke of the drop\ntime [ms], stroke [mm]\n", 0};
    bt_rig_result drop;
    assert_int_equal(
        bt_rig_run(BT_RIG_MAIN_DROP, &truth, &study->rigs, &drop, keep_stroke, &curve, NULL),
        BT_OK);
    bt_study_destroy(study);
    write_file("curve.csv", curve.text);
    bt_calibration c;
    bt_fit fit;
    fit_text("parameters:\n"
             "  aircraft.main_gear.oleo.discharge: {lower: 0.5, upper: 0.9, start: 0.8}\n"
             "targets:\n"
             "  - {curve: curve.csv, of: main_drop, tolerance: 5 mm}\n",
             &c, &fit);
    assert_true(fit.targets[0].got < 1e-4); // root mean square error, m
    BT_ASSERT_NEAR(fit.value[0], truth.main_gear.oleo.discharge, 1e-3, 0);
    bt_calibration_destroy(&c);
}

static void a_parameter_without_effect_is_not_identified(void** state) {
    (void)state;
    bt_calibration c;
    bt_fit fit;
    fit_text("parameters:\n"
             "  aircraft.main_gear.oleo.discharge: {lower: 0.5, upper: 0.9}\n"
             "  aircraft.nose_gear.oleo.discharge: {lower: 0.5, upper: 0.9}\n"
             "targets:\n"
             "  - {metric: main_drop.stroke_max, value: 0.5 m, tolerance: 5 mm}\n",
             &c, &fit);
    assert_int_equal(fit.identified_directions, 1);
    assert_true(fit.identified[0]);
    assert_false(fit.identified[1]);
    // nothing is known of it but its bounds
    BT_ASSERT_NEAR(fit.standard_error[1], 0.4 / sqrt(12), 1e-9, 0);
    BT_ASSERT_NEAR(fit.singular[1], 0, 0, 1e-9);
    BT_ASSERT_NEAR(fit.direction[1][1], 1, 1e-12, 0);
    bt_calibration_destroy(&c);
}

static void the_fit_does_not_depend_on_threads(void** state) {
    (void)state;
    bt_calibration c;
    bt_fit one, three;
    const char* text = "parameters:\n"
                       "  aircraft.main_gear.oleo.discharge: {lower: 0.5, upper: 0.9}\n"
                       "starts: 2\n"
                       "targets:\n"
                       "  - {metric: main_drop.stroke_max, value: 0.5 m, tolerance: 5 mm}\n";
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    fit_text(text, &c, &one);
    c.threads = 3;
    assert_int_equal(bt_calibration_fit(&c, &three, NULL, NULL, NULL, &diag), BT_OK);
    assert_memory_equal(one.value, three.value, sizeof one.value);
    assert_memory_equal(one.singular, three.singular, sizeof one.singular);
    bt_calibration_destroy(&c);
}

// --- the overlay ------------------------------------------------------------------------------

static void the_overlay_names_values_and_targets(void** state) {
    (void)state;
    bt_calibration c;
    bt_fit fit;
    char* text = NULL;
    size_t size = 0;
    fit_text("parameters:\n"
             "  aircraft.main_gear.oleo.air_volume: {lower: 7 L, upper: 10 L}\n"
             "targets:\n"
             "  - {metric: main_drop.stroke_max, value: 500 mm, tolerance: 5 mm}\n",
             &c, &fit);
    assert_int_equal(bt_calibration_overlay(&c, &fit, &text, &size), BT_OK);
    assert_non_null(strstr(text, "main_drop.stroke_max: wanted 500 mm, got "));
    const char* line = strstr(text, "\naircraft.main_gear.oleo.air_volume: ");
    assert_non_null(line);
    assert_non_null(strstr(line, " L # [calibrated] +- "));
    free(text);
    bt_calibration_destroy(&c);
}

// --- linear algebra ---------------------------------------------------------------------------

/// Two parameters that only count as their sum: J = [s s].
static void identify_finds_the_combination_that_counts(void** state) {
    (void)state;
    static bt_calibration c;
    static bt_fit fit;
    const double rows[1] = {0}, weight[1] = {1}, jacobian[2] = {30, 30};
    c.parameter_count = 2;
    c.parameters[0] = c.parameters[1] = (bt_parameter){.lower = 0, .upper = 2};
    c.target_count = c.row_count = 1;
    c.targets[0] = (bt_target){.row_count = 1, .weight = 1};
    assert_int_equal(bt_fit_identify(&c, rows, jacobian, weight, &fit), BT_OK);
    BT_ASSERT_NEAR(fit.singular[0], 30 * sqrt(2), 1e-12, 0);
    BT_ASSERT_NEAR(fit.singular[1], 0, 0, 1e-12);
    BT_ASSERT_NEAR(fit.direction[0][0], sqrt(0.5), 1e-12, 0);
    BT_ASSERT_NEAR(fit.direction[0][1], sqrt(0.5), 1e-12, 0);
    assert_int_equal(fit.identified_directions, 1);
    // (J^T J + 12 I)^-1 by hand: the sum has variance 2 / (2 s^2 + 12), the difference 2 / 12
    const double sum = 1 / (2 * 900.0 + 12), difference = 1 / 12.0;
    BT_ASSERT_NEAR(fit.standard_error[0], 2 * sqrt((sum + difference) / 2), 1e-12, 0);
    BT_ASSERT_NEAR(fit.correlation[0][1], (sum - difference) / (sum + difference), 1e-12, 0);
    assert_false(fit.identified[0]);
}

static void a_bound_that_is_kept_tells_nothing(void** state) {
    (void)state;
    static bt_calibration c;
    static bt_fit fit;
    const double weight[1] = {1}, jacobian[1] = {30};
    c.parameter_count = c.target_count = c.row_count = 1;
    c.parameters[0] = (bt_parameter){.lower = 0, .upper = 1};
    c.targets[0] = (bt_target){.kind = BT_TARGET_AT_MOST, .row_count = 1, .weight = 1};
    fit = (bt_fit){0};
    assert_int_equal(bt_fit_identify(&c, &(double){-0.5}, jacobian, weight, &fit), BT_OK);
    BT_ASSERT_NEAR(fit.standard_error[0], 1 / sqrt(12), 1e-12, 0);
    fit = (bt_fit){0};
    assert_int_equal(bt_fit_identify(&c, &(double){0.5}, jacobian, weight, &fit), BT_OK);
    BT_ASSERT_NEAR(fit.standard_error[0], 1 / sqrt(912), 1e-12, 0);
}

// --- what is refused --------------------------------------------------------------------------

static void assert_refused(const char* text, const char* want) {
    bt_calibration c;
    messages kept;
    char path[512];
    write_file("calibration.yaml", text);
    snprintf(path, sizeof path, "%s/calibration.yaml", folder);
    assert_int_equal(read_against_reference(path, &c, &kept), BT_ERR_INPUT);
    if (!strstr(kept.text, want))
        fail_msg("\"%s\" does not say \"%s\"", kept.text, want);
}

#define ONE_PARAMETER "parameters:\n  aircraft.main_gear.oleo.discharge: {lower: 0.5, upper: 0.9}\n"

static void wrong_files_are_refused_with_the_place(void** state) {
    (void)state;
    assert_refused("targets: []\n", "parameters: missing");
    assert_refused("parameters:\n  aircraft.hook.downstop: {lower: 1 deg, upper: 2 deg}\n",
                   "calibration.yaml:2:3: error: parameters.aircraft.hook.downstop: no such key; "
                   "did you mean \"aircraft.hook.down_stop\"?");
    assert_refused("parameters:\n  aircraft.hook.down_stop: {lower: 80 deg, upper: 60 deg}\n",
                   "lower is not below upper");
    assert_refused("parameters:\n  aircraft.hook.down_stop: {lower: 30 deg, upper: 60 deg}\n",
                   "is not between the bounds");
    assert_refused("parameters:\n  aircraft.hook.down_stop: {lower: 50 mm, upper: 80 deg}\n",
                   "calibration.yaml:2:36: error: ");
    assert_refused(ONE_PARAMETER "targets:\n  - {metric: bounce_hight, value: 53 mm, tolerance: "
                                 "5 %}\n",
                   "\"bounce_hight\" is no metric; did you mean \"bounce_height\"?");
    assert_refused(ONE_PARAMETER
                   "targets:\n  - {metric: impact_force, value: 1 N, tolerance: 1 %}\n",
                   "\"impact_force\" is no metric; did you mean \"bounce_impact_force\"?");
    assert_refused(ONE_PARAMETER "targets:\n  - {metric: bounce_height, value: 53 kN, tolerance: "
                                 "5 %}\n",
                   "calibration.yaml:4:36: error: targets[1].value: ");
    assert_refused(ONE_PARAMETER "targets:\n  - {metric: bounce_height, value: 53 mm}\n",
                   "targets[1].tolerance: missing");
    assert_refused(ONE_PARAMETER "targets:\n  - {metric: bounce_height, value: 53 mm, at_most: "
                                 "60 mm, tolerance: 5 %}\n",
                   "one of `value`, `at_most`, `at_least` and `trend` is wanted");
    assert_refused(ONE_PARAMETER "targets:\n  - {metric: bounce_height, under: {landing.pich: "
                                 "1 deg}, value: 53 mm, tolerance: 5 %}\n",
                   "did you mean \"landing.pitch\"?");
    assert_refused(ONE_PARAMETER "goals: 1\n", "goals: unknown key");
}

/// A curve with these contents, for the main gear's stroke.
static void assert_curve_refused(const char* csv, const char* want) {
    write_file("curve.csv", csv);
    assert_refused(ONE_PARAMETER "targets:\n  - {curve: curve.csv, of: main_drop, tolerance: "
                                 "5 mm}\n",
                   want);
}

static void wrong_curves_are_refused_with_the_place(void** state) {
    (void)state;
    assert_curve_refused("", "curve.csv:1:1: error: the file is empty");
    assert_curve_refused("0, 1\n1, 2\n", "curve.csv:1:1: error: the first line must name");
    assert_curve_refused("time [s], stroke [mm], force [N]\n0, 1, 2\n",
                         "curve.csv:1:24: error: 3 columns (time, stroke, force): say which");
    assert_curve_refused("time [s], strok [mm]\n0, 1\n1, 2\n",
                         "curve.csv:1:11: error: strok: no such column");
    assert_curve_refused("time [s], stroke [kN]\n0, 1\n1, 2\n",
                         "curve.csv:1:11: error: stroke: the unit of its heading is wrong");
    assert_curve_refused(
        "time [s], stroke\n0, 1\n1, 2\n",
        "curve.csv:1:11: error: stroke: its unit is missing; write it in brackets: stroke [m]");
    assert_curve_refused("time [s], stroke [mm]\n1, 1\n0, 2\n",
                         "curve.csv:3:1: error: time goes back");
    assert_curve_refused("time [s], stroke [mm]\n0, 1\n1, x\n",
                         "curve.csv:3:4: error: stroke: \"x\" is not a number");
    assert_curve_refused("time [s], stroke [mm]\n0; 1\n",
                         "curve.csv:2:1: error: time: \"0; 1\" is not a number");
    assert_curve_refused("time [s], stroke [mm]\n0, 1\n", "two rows at least");
    assert_curve_refused("stroke [mm], strut_force [N]\n1, 1\n0, 2\n",
                         "curve.csv:3:1: error: stroke goes back");
    assert_refused(ONE_PARAMETER
                   "targets:\n  - {curve: {file: curve.csv, y: {stroke: A, strut_force: "
                   "B}}, of: main_drop, tolerance: 5 mm}\n",
                   "curve.y: one column is wanted here");
    write_file("curve.csv", "T (s);A (mm);B (kN)\n0;1;2\n1;2;3\n");
    assert_refused(ONE_PARAMETER
                   "targets:\n  - {curve: {file: curve.csv, x: T, y: {stroke: C}}, of: "
                   "main_drop, tolerance: 5 mm}\n",
                   "has no column \"C\"; it has T, A, B");
}

/// Measured longer than the rig runs.
static void a_target_without_a_value_is_named(void** state) {
    (void)state;
    bt_calibration c;
    bt_fit fit;
    messages kept;
    char path[512];
    bt_diag diag = {.sink = keep_message, .user = &kept};
    write_file("curve.csv", "time [s], stroke [mm]\n0, 1\n100, 2\n");
    write_file("calibration.yaml",
               ONE_PARAMETER "targets:\n  - {curve: curve.csv, of: main_drop, tolerance: 5 mm}\n");
    snprintf(path, sizeof path, "%s/calibration.yaml", folder);
    assert_int_equal(read_against_reference(path, &c, &kept), BT_OK);
    assert_int_equal(bt_calibration_fit(&c, &fit, NULL, NULL, NULL, &diag), BT_ERR_INPUT);
    assert_non_null(strstr(kept.text, "calibration.yaml:4:5: error: curve.csv of main_drop: the "
                                      "model gives no value"));
    bt_calibration_destroy(&c);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference_hook_is_what_the_calibration_finds),
        cmocka_unit_test(known_parameters_come_back_from_a_drop_test),
        cmocka_unit_test(a_measured_curve_gives_its_parameter_back),
        cmocka_unit_test(a_parameter_without_effect_is_not_identified),
        cmocka_unit_test(the_fit_does_not_depend_on_threads),
        cmocka_unit_test(the_overlay_names_values_and_targets),
        cmocka_unit_test(identify_finds_the_combination_that_counts),
        cmocka_unit_test(a_bound_that_is_kept_tells_nothing),
        cmocka_unit_test(wrong_files_are_refused_with_the_place),
        cmocka_unit_test(wrong_curves_are_refused_with_the_place),
        cmocka_unit_test(a_target_without_a_value_is_named),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
