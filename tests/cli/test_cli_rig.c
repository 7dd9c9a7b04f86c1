/// `bolter rig` as a user types it, and what `bolter check` says of bad test data.
#include "cli_fixture.h"

#define TR1154 "studies/rigs/tr1154.yaml"

/// The TR 1154 file with one line replaced (the first that has `key`), as rig.yaml.
static void write_spoilt(const fixture* f, const char* key, const char* line) {
    char *text = NULL, *spoilt = NULL;
    size_t size = 0;
    assert_int_equal(bt_file_read(TR1154, &text, NULL, NULL), BT_OK);
    const char* at = strstr(text, key);
    assert_non_null(at);
    FILE* out = open_memstream(&spoilt, &size);
    fprintf(out, "%.*s%s%s", (int)(at - text), text, line, at + strcspn(at, "\n"));
    fclose(out);
    write_file(f, "rig.yaml", spoilt);
    free(spoilt);
    free(text);
}

static void rig_prints_metrics_beside_their_references(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "rig nose-drop " REFERENCE " -o %/x"), 0);
    assert_string_equal(f->err, "");
    static const char* const parts[] = {
        "stroke_max_m",     "sinkage_max_m", "tyre_compression_max_m",
        "tyre_force_max_N", "0.435",         "yes"};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i)
        assert_has(f->out, parts[i]);
    free(read_text(f, "x/figures/nose_drop_stroke.csv"));
    free(read_text(f, "x/figures/nose_drop_tyre.gp"));
    char* history = read_text(f, "x/nose_drop.h5");
    assert_memory_equal(history, "\x89HDF\r\n\x1a\n", 8);
    free(history);
}

static void rig_prints_the_promised_json_keys(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "rig main-drop " REFERENCE " --json -o %/x.h5"), 0);
    assert_string_equal(f->err, "");
    assert_true(f->out[0] == '{');
    static const char* const parts[] = {
        "\"metrics\": {",       "\"stroke_max_m\": {", "\"value\": ",       "\"unit\": \"m\"",
        "\"reference\": 0.577", "\"error_percent\": ", "\"accepted\": true"};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i)
        assert_has(f->out, parts[i]);
    assert_int_equal(bolter(f, "rig hook-rebound " REFERENCE " --json -o %/y.h5"), 0);
    assert_has(f->out, "\"rebound_height_m\": {");
    assert_has(f->out, "\"impact_force_N\": {");
    assert_has(f->out, "\"reference\": null");
}

static void wrong_use_is_exit_code_2(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "rig nose-dorp " REFERENCE), 2);
    assert_has(f->err, "none of nose-drop, main-drop, hook-rebound");
    assert_int_equal(bolter(f, "rig nose-drop"), 2);
}

static void static_rig_prints_its_points_beside_the_measured_ones(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "rig nose-static studies/rigs/currey.yaml -o %/x"), 0);
    assert_has(f->out, "  at stroke_m 0.39423");
    assert_has(f->out, "363495     -2.87           4.0       yes");
    assert_has(f->out, "20 of 20 points within 4 %, largest error 3.54 %");
    free(read_text(f, "x/figures/nose_static_strut.csv"));
    assert_int_equal(bolter(f, "rig nose-static studies/rigs/currey.yaml --json -o %/x.h5"), 0);
    assert_has(f->out, "\"points\": [");
    assert_int_equal(bolter(f, "rig nose-static studies/rigs/currey.yaml -o %/x.csv"), 0);
    char* table = read_text(f, "x.csv");
    assert_has(table, "metric,value,unit,reference,error_percent,tolerance_percent,accepted\n");
    assert_has(table, "  at stroke_m 0.39423,");
    free(table);
}

static void press_beyond_the_gas_is_refused_with_its_place(void** state) {
    fixture* f = *state;
    char* text = NULL;
    assert_int_equal(bt_file_read("studies/rigs/currey.yaml", &text, NULL, NULL), BT_OK);
    char* reference = strstr(text, "    reference:");
    assert_non_null(reference);
    strcpy(reference, "    stroke: 20 in\n");
    write_file(f, "press.yaml", text);
    free(text);
    assert_int_equal(bolter(f, "check %/press.yaml"), 3);
    assert_has(f->err, "press.yaml:23:13: error: rigs.nose_static.stroke: no gas volume is left");
}

/// Calibration against a static curve: the fit of currey_fit.yaml.
static void static_curve_can_be_calibrated(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "calibrate studies/rigs/currey.yaml studies/rigs/currey_fit.yaml "
                               "-o %/fitted.yaml"),
                     0);
    assert_has(f->out, "currey.csv of nose_static");
    assert_has(f->out, "NOT identified");
    assert_int_equal(bolter(f, "calibrate studies/rigs/currey.yaml studies/rigs/currey_fit.yaml "
                               "--json -o %/again.yaml"),
                     0);
    static const char* const keys[] = {"\"letter\": \"c\"", "\"sensitivity\": [",
                                       "\"correlation\": [", "\"identified\": false",
                                       "\"residual_tolerances\": "};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i)
        assert_has(f->out, keys[i]);
    assert_int_equal(
        bolter(f, "rig nose-static studies/rigs/currey.yaml --set @%/fitted.yaml -o %/x"), 0);
    assert_has(f->out, "rms difference 2817");
}

static void names_of_measured_curves_stay_in_the_echo(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "rig nose-static studies/rigs/currey.yaml -o %/x.h5"), 0);
    char path[4096];
    char* history = NULL;
    size_t size = 0;
    assert_int_equal(bt_file_read(toy_path(path, f->directory, "x.h5"), &history, &size, NULL),
                     BT_OK);
    static const char line[] = "# rigs.nose_static.reference.curve: \"currey.csv\"";
    assert_non_null(memmem(history, size, line, sizeof line - 1));
    free(history);
}

static void rig_that_the_study_lacks_is_exit_code_3(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "rig nose-drop " TR1154 " -o %/x"), 3);
    assert_has(f->err, "rigs.nose_drop: missing");
}

static void rig_file_is_no_study_of_landings(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "check " TR1154), 0);
    assert_has(f->out, "main_drop");
    assert_int_equal(bolter(f, "land " TR1154), 3);
    assert_has(f->err, "describes tests on rigs and no landing");
}

/// What is wrong with a line of a rig file: refused by `check` with this place and reason.
static void assert_refused(fixture* f, const char* key, const char* line, const char* place,
                           const char* reason) {
    write_spoilt(f, key, line);
    assert_int_equal(bolter(f, "check %/rig.yaml"), 3);
    assert_has(f->err, place);
    assert_has(f->err, reason);
    assert_string_equal(f->out, "");
}

static void bad_gear_is_refused_with_its_place(void** state) {
    fixture* f = *state;
    assert_refused(f, "      orifice_area:",
                   "      orifice_table: [[0 mm, 30 mm^2], [90 mm, 20 mm^2], [80 mm, 10 mm^2]]",
                   "rig.yaml:21:22: error: aircraft.main_gear.oleo.orifice_table", "must increase");
    assert_refused(f, "      air_volume:", "      air_volume: 0.5 L",
                   "rig.yaml:18:19: error: aircraft.main_gear.oleo.air_volume", "swept volume");
}

static void drop_height_beside_a_sink_speed_is_refused(void** state) {
    fixture* f = *state;
    assert_refused(f, "    lift_ratio: 1", "    drop_height: 1 ft",
                   "rig.yaml:39:18: error: rigs.main_drop.drop_height", "give one of them");
}

static void spring_points_that_fall_are_refused_with_their_place(void** state) {
    fixture* f = *state;
    assert_refused(f, "      orifice_area:",
                   "      orifice_area: 50 mm^2\n      spring: points\n"
                   "      spring_points: [[0 mm, 9 kN], [20 mm, 8 kN]]",
                   "rig.yaml:23:22: error: aircraft.main_gear.oleo.spring_points", "decreases");
}

static void precharge_below_ambient_is_refused_with_its_place(void** state) {
    fixture* f = *state;
    write_spoilt(f, "      precharge:", "      precharge: 0.9 bar");
    assert_int_equal(
        bolter(f, "check %/rig.yaml --set aircraft.main_gear.oleo.ambient='101325 Pa'"), 3);
    assert_has(f->err, "rig.yaml:16:18: error: aircraft.main_gear.oleo.precharge");
    assert_has(f->err, "below the ambient pressure");
}

static void tyre_curve_that_decreases_is_refused_with_its_place(void** state) {
    fixture* f = *state;
    assert_refused(f, "      law: power",
                   "      law: points\n      load_points: [[10 mm, 9 kN], [20 mm, 8 kN]]",
                   "rig.yaml:29:20: error: aircraft.main_gear.tyre.load_points", "decreases");
}

static void drop_mass_below_the_leg_is_refused_with_its_place(void** state) {
    fixture* f = *state;
    assert_refused(f, "    mass: 2542 lb", "    mass: 100 lb",
                   "rig.yaml:37:11: error: rigs.main_drop.mass",
                   "is not above that of piston and wheel");
}

/// Names data.csv in the TR 1154 file and gives it a content.
static int check_data(fixture* f, const char* csv) {
    write_spoilt(f, "      tolerance: 0.001", "      curve: data.csv");
    write_file(f, "data.csv", csv);
    return bolter(f, "check %/rig.yaml");
}

static void measured_curve_is_drawn_beside_the_run(void** state) {
    fixture* f = *state;
    assert_int_equal(check_data(f, "\xef\xbb\xbftime [ms], stroke [in]\r\n0, 0\r\n50, 2\r\n"
                                   "100, 5\r\n"), // as a spreadsheet writes it
                     0);
    assert_has(f->out, "1 measured curve");
    assert_int_equal(bolter(f, "rig main-drop %/rig.yaml -o %/x"), 0);
    assert_has(f->out, "data.csv: rms difference");
    char* data = read_text(f, "x/figures/main_drop_stroke.csv");
    assert_has(data, "100,127"); // 5 in at 100 ms
    free(data);
}

static void measured_curve_with_wrong_columns_or_units_is_refused(void** state) {
    fixture* f = *state;
    assert_int_equal(check_data(f, "time [s], strok [mm]\n0, 0\n1, 1\n"), 3);
    assert_has(f->err, "data.csv:1:11: error: strok: no such column");
    assert_int_equal(check_data(f, "time [s], stroke [kN]\n0, 0\n1, 1\n"), 3);
    assert_has(f->err, "data.csv:1:11: error: stroke: the unit of its heading is wrong");
    assert_int_equal(check_data(f, "time [s], stroke\n0, 0\n1, 1\n"), 3);
    assert_has(f->err, "data.csv:1:11: error: stroke: its unit is missing; write it in brackets");
    assert_int_equal(check_data(f, "time [s]\n0\n1\n"), 3);
    assert_has(f->err, "data.csv:1:9: error: a second column is wanted here");
    assert_int_equal(check_data(f, "time [s], stroke [mm]\n0,0, 0\n0,1, 1\n"), 3);
    assert_has(f->err, "data.csv:2:6: error: a row has 2 numbers, not more");
    assert_int_equal(check_data(f, "0, 0\n1, 1\n"), 3);
    assert_has(f->err, "data.csv:1:1: error: the first line must name the columns");
    assert_int_equal(check_data(f, "time [s], stroke [mm]\n0, 0\n1, one\n"), 3);
    assert_has(f->err, "data.csv:3:4: error: stroke: \"one\" is not a number");
    assert_int_equal(check_data(f, "time [s], stroke [mm]\n1, 0\n0, 1\n"), 3);
    assert_has(f->err, "data.csv:3:1: error: time goes back");
}

/// The energy of the drop is what its mass brings at first contact.
static void bore_and_energy_stand_for_area_and_speed(void** state) {
    fixture* f = *state;
    write_file(f, "nose.yaml",
               "title: x\naircraft: {nose_gear: {piston_mass: 60 kg, wheel_mass: 20 kg, "
               "wheel_inertia: 1 kg m^2, oleo: {air_diameter: 88.8 mm, precharge: 275 psig, "
               "air_volume: 203 cu in, gas_exponent: 1.1, stroke_max: 400 mm, oil_diameter: 81 mm, "
               "orifice_diameter: 14 "
               "mm}, tyre: {radius: 279.5 mm, width: 168 mm}}}\n"
               "rigs: {nose_drop: {mass: 2000 kg, drop_energy: 9 kJ}}\n");
    assert_int_equal(bolter(f, "rig nose-drop %/nose.yaml -o %/b --json"), 0);
    const char* energy = strstr(f->out, "\"impact_energy_J\"");
    assert_non_null(energy);
    BT_ASSERT_NEAR(strtod(strstr(energy, "\"value\":") + 8, NULL), 9000, 1e-12, 0);
    assert_int_equal(bolter(f, "check %/nose.yaml --set "
                               "aircraft.nose_gear.oleo.air_area='6200 mm^2'"),
                     3);
    assert_has(f->err, "air_diameter: stands in the place of air_area; give one of them");
    assert_int_equal(bolter(f, "check %/nose.yaml --set "
                               "aircraft.nose_gear.oleo.air_diameter='6200 mm^2'"),
                     3);
    assert_has(f->err, "has a unit of another dimension");
}

static void measured_curve_that_is_not_there_is_exit_code_5(void** state) {
    fixture* f = *state;
    write_spoilt(f, "      tolerance: 0.001", "      curve: none.csv");
    assert_int_equal(bolter(f, "check %/rig.yaml"), 5);
    assert_has(f->err, "rig.yaml:48:14: error: curve: ");
    assert_has(f->err, "none.csv\": cannot read: No such file or directory");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(rig_prints_metrics_beside_their_references),
        TEST(rig_prints_the_promised_json_keys),
        TEST(wrong_use_is_exit_code_2),
        TEST(static_rig_prints_its_points_beside_the_measured_ones),
        TEST(press_beyond_the_gas_is_refused_with_its_place),
        TEST(static_curve_can_be_calibrated),
        TEST(names_of_measured_curves_stay_in_the_echo),
        TEST(rig_that_the_study_lacks_is_exit_code_3),
        TEST(rig_file_is_no_study_of_landings),
        TEST(bad_gear_is_refused_with_its_place),
        TEST(drop_height_beside_a_sink_speed_is_refused),
        TEST(spring_points_that_fall_are_refused_with_their_place),
        TEST(precharge_below_ambient_is_refused_with_its_place),
        TEST(tyre_curve_that_decreases_is_refused_with_its_place),
        TEST(drop_mass_below_the_leg_is_refused_with_its_place),
        TEST(measured_curve_is_drawn_beside_the_run),
        TEST(measured_curve_with_wrong_columns_or_units_is_refused),
        TEST(bore_and_energy_stand_for_area_and_speed),
        TEST(measured_curve_that_is_not_there_is_exit_code_5),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
