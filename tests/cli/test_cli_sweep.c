/// `bolter sweep`, `bolter calibrate` and `--set @FILE` as a user types them.
#include "cli_fixture.h"

#define COARSE                                                                                     \
    "--set deck.cable.mesh.fine_length='0.6 m' --set deck.cable.mesh.medium_length='0.6 m' "       \
    "--set deck.cable.mesh.coarse_length='0.6 m' "

static void sweep_draws_the_papers_three_figures(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "sweep " REFERENCE " " COARSE "-o %/study"), 0);
    assert_has(f->out, "landing.sink_speed");
    assert_has(f->out, "(paper, 8 deg: 81 mm, 4.57 m)");
    static const char* const names[] = {"fig14", "fig15", "fig16"};
    for (int i = 0; i < 3; ++i) {
        char name[64];
        snprintf(name, sizeof name, "study/figures/%s.csv", names[i]);
        assert_true(exists(f, name));
        snprintf(name, sizeof name, "study/figures/%s.gp", names[i]);
        assert_true(exists(f, name));
    }
}

static void sweep_prints_one_json_object(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "sweep " REFERENCE " " COARSE "--json -o %/study --key "
                               "landing.pitch --values '0 deg, 8 deg'"),
                     0);
    assert_int_equal(f->out[0], '{');
    assert_has(f->out, "\"key\": \"landing.pitch\"");
    assert_has(f->out, "\"unit\": \"rad\"");
    assert_has(f->out, "\"height_m\": 0.0");
    assert_true(exists(f, "study/figures/sweep_landing_pitch.csv"));
}

static void sweep_without_gnuplot_leaves_data_and_script(void** state) {
    fixture* f = *state;
    char* path = strdup(getenv("PATH"));
    setenv("PATH", f->directory, 1);
    const int code = bolter(f, "sweep " REFERENCE " " COARSE "-o %/study --key landing.pitch "
                               "--values '2 deg'");
    setenv("PATH", path, 1);
    free(path);
    assert_int_equal(code, 0);
    assert_has(f->err, "warning: sweep_landing_pitch was not drawn: there is no gnuplot here");
    assert_true(exists(f, "study/figures/sweep_landing_pitch.gp"));
    assert_false(exists(f, "study/figures/sweep_landing_pitch.png"));
}

static void sweep_takes_ranges_and_one_unit_for_a_list(void** state) {
    fixture* f = *state;
    static const struct {
        const char* values;
        int rows;
        const char* last; ///< rad
    } rows[] = {
        {"0..8 deg in 3", 3, "0.1396"}, {"0..8 deg by 4", 3, "0.1396"}, {"0, 4 deg", 2, "0.0698"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char line[512];
        snprintf(line, sizeof line,
                 "sweep " REFERENCE " " COARSE
                 "--json -o %%/study --key landing.pitch --values '%s'",
                 rows[i].values);
        assert_int_equal(bolter(f, line), 0);
        int count = 0;
        const char* last = f->out;
        for (const char* at = f->out; (at = strstr(at, "\"value\": ")); ++at, ++count)
            last = at;
        assert_int_equal(count, rows[i].rows);
        assert_int_equal(strncmp(last + strlen("\"value\": "), rows[i].last, 6), 0);
    }
    static const char* const wrong[] = {"0..8 deg in 1", "0..8 deg by -1", "0.. deg",
                                        "0..8 deg by 1 m"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        char line[512];
        snprintf(line, sizeof line,
                 "sweep " REFERENCE " -o %%/study --key landing.pitch --values '%s'", wrong[i]);
        assert_int_equal(bolter(f, line), 2);
        assert_has(f->err, "FROM..TO UNIT by STEP");
    }
}

static void sweep_writes_its_table_as_csv(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "sweep " REFERENCE " " COARSE "-o %/t.csv --key landing.pitch "
                               "--values '0, 8 deg'"),
                     0);
    char* text = read_text(f, "t.csv");
    assert_has(text, "key,value,outcome,mode,height_m,distance_m,impact_force_N,margin_m\n"
                     "landing.pitch,0,");
    assert_has(text, "\nlanding.pitch,0.139626340159546");
    free(text);
    // a table of the user's stays, Bolter's own is replaced
    assert_int_equal(bolter(f, "sweep " REFERENCE " " COARSE "-o %/t.csv --key landing.pitch "
                               "--values '0 deg'"),
                     0);
    write_file(f, "t.csv", "time,load\n");
    assert_int_equal(bolter(f, "sweep " REFERENCE " " COARSE "-o %/t.csv --key landing.pitch "
                               "--values '0 deg'"),
                     5);
    assert_has(f->err, "not written by Bolter");
}

#define TR1154 "studies/rigs/tr1154.yaml"

static void sweep_of_a_rig_is_a_table_and_a_figure(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "sweep " TR1154 " -o %/study --key rigs.main_drop.sink_speed "
                               "--values '2, 3 m/s'"),
                     0);
    assert_has(f->out, "main_drop: Gear of NACA TR 1154");
    assert_has(f->out, "strut_force_max_N, N");
    assert_has(f->out, "\n2 m/s ");
    assert_has(f->out, "\n3 m/s ");
    assert_true(exists(f, "study/figures/sweep_rigs_main_drop_sink_speed.gp"));
    char* script = read_text(f, "study/figures/sweep_rigs_main_drop_sink_speed.gp");
    assert_has(script, "Gear of NACA TR 1154");
    free(script);
    // twice the speed is four times the energy: the strut takes more, in SI in the CSV
    assert_int_equal(bolter(f, "sweep " TR1154 " -o %/t.csv --key rigs.main_drop.sink_speed "
                               "--values '1.5..3 m/s in 2'"),
                     0);
    char* text = read_text(f, "t.csv");
    assert_has(text, "value,stroke_max_m,");
    double slow = 0, fast = 0;
    assert_int_equal(sscanf(strchr(text, '\n'), "\n1.5 m/s,%lf", &slow), 1);
    assert_int_equal(sscanf(strstr(text, "\n3 m/s"), "\n3 m/s,%lf", &fast), 1);
    assert_true(fast > 1.2 * slow);
    free(text);
    assert_int_equal(bolter(f, "sweep " TR1154 " --key rigs.nose_drop.sink_speed --values 1"), 2);
    assert_has(f->err, "does not describe rigs.nose_drop");
}

static void figures_bear_the_papers_numbers_in_the_reference_study_only(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "rig main-drop " TR1154 " -o %/own"), 0);
    char* script = read_text(f, "own/figures/main_drop_tyre.gp");
    assert_has(script, "Gear of NACA TR 1154");
    assert_null(strstr(script, "Fig."));
    free(script);
    assert_int_equal(bolter(f, "rig main-drop " REFERENCE " -o %/ref"), 0);
    script = read_text(f, "ref/figures/main_drop_tyre.gp");
    assert_has(script, "Hook and cable, four random inputs: Drop of the main gear: tyre (Fig. 12)");
    free(script);
}

static void sweep_refuses_what_it_cannot_vary(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "sweep " REFERENCE " --key landing.pitch"), 2);
    assert_has(f->err, "--key and --values go together");
    assert_int_equal(bolter(f, "sweep " REFERENCE " -o %/study --key landing.pich --values 1"), 3);
    assert_has(f->err, "did you mean \"landing.pitch\"?");
    assert_int_equal(
        bolter(f, "sweep " REFERENCE " -o %/study --key landing.pitch --values '1 deg, 90 deg'"),
        3);
    assert_has(f->err, "landing.pitch: 90 deg is outside");
}

static const char calibration[] =
    "parameters:\n"
    "  aircraft.main_gear.oleo.discharge: {lower: 0.5, upper: 1.2, start: 1.1}\n"
    "targets:\n"
    "  - {metric: main_drop.stroke_max, value: 0.5143 ft, tolerance: 1 %}\n"
    "  - {metric: main_drop.tyre_force_max, value: 7262.9 lbf, tolerance: 1 %}\n";

static void calibrate_writes_an_overlay_that_set_reads(void** state) {
    fixture* f = *state;
    write_file(f, "calibration.yaml", calibration);
    // the file describes a rig and no landing: the discharge of its strut is 0.9
    assert_int_equal(bolter(f, "calibrate studies/rigs/tr1154.yaml %/calibration.yaml "
                               "-o %/found.yaml"),
                     0);
    assert_has(f->out, "the data identify 1 of 1");
    char* overlay = read_text(f, "found.yaml");
    const char* line = strstr(overlay, "\naircraft.main_gear.oleo.discharge: ");
    assert_non_null(line);
    BT_ASSERT_NEAR(atof(strchr(line, ' ')), 0.9, 1e-3, 0);
    assert_has(overlay, "[calibrated]");
    free(overlay);
    assert_int_equal(bolter(f, "rig main-drop studies/rigs/tr1154.yaml --json -o %/rig "
                               "--set aircraft.main_gear.oleo.discharge=0.5 --set @%/found.yaml"),
                     0);
    const char* stroke = strstr(f->out, "\"stroke_max_m\"");
    assert_non_null(stroke);
    BT_ASSERT_NEAR(atof(strstr(stroke, "\"value\": ") + 9), 0.5143 * 0.3048, 1e-3, 0);
}

static void calibrate_says_what_is_wrong(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "calibrate " REFERENCE), 2);
    assert_int_equal(bolter(f, "calibrate " REFERENCE " %/none.yaml"), 5);
    write_file(f, "calibration.yaml",
               "parameters:\n  aircraft.main_gear.oleo.discharge: {lower: 0.5, upper: 1.2}\n"
               "targets:\n  - {metric: bounce_height, value: 5 mm, tolerance: 1 %}\n");
    assert_int_equal(bolter(f, "calibrate studies/rigs/tr1154.yaml %/calibration.yaml"), 3);
    assert_has(f->err, "calibration.yaml:4:5: error: targets[1]: the study describes rigs and no "
                       "landing");
}

static void an_overlay_with_faults_is_refused_with_the_line(void** state) {
    fixture* f = *state;
    write_file(f, "bad.yaml", "# comment\n\nlanding.pitch: 4 deg # [calibrated]\nlanding.pitch\n");
    assert_int_equal(bolter(f, "check " REFERENCE " --set @%/bad.yaml"), 3);
    assert_has(f->err, "bad.yaml:4:1: error: a line PATH: VALUE is wanted");
    write_file(f, "bad.yaml", "landing.pich: 4 deg\n");
    assert_int_equal(bolter(f, "check " REFERENCE " --set @%/bad.yaml"), 3);
    assert_has(f->err, "landing.pich");
    assert_int_equal(bolter(f, "check " REFERENCE " --set @%/none.yaml"), 5);
}

int main(void) {
#define WITH_DIRECTORY(test) cmocka_unit_test_setup_teardown(test, setup, teardown)
    const struct CMUnitTest tests[] = {
        WITH_DIRECTORY(sweep_draws_the_papers_three_figures),
        WITH_DIRECTORY(sweep_prints_one_json_object),
        WITH_DIRECTORY(sweep_without_gnuplot_leaves_data_and_script),
        WITH_DIRECTORY(sweep_takes_ranges_and_one_unit_for_a_list),
        WITH_DIRECTORY(sweep_writes_its_table_as_csv),
        WITH_DIRECTORY(sweep_of_a_rig_is_a_table_and_a_figure),
        WITH_DIRECTORY(figures_bear_the_papers_numbers_in_the_reference_study_only),
        WITH_DIRECTORY(sweep_refuses_what_it_cannot_vary),
        WITH_DIRECTORY(calibrate_writes_an_overlay_that_set_reads),
        WITH_DIRECTORY(calibrate_says_what_is_wrong),
        WITH_DIRECTORY(an_overlay_with_faults_is_refused_with_the_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
