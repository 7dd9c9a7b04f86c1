/// Reliability over the mean of each input, drawn from the table of a study directory.
#define _GNU_SOURCE
#include "near.h"

#include "base/directory.h"
#include "report/reliability_figure.h"
#include "toy_study.h"

static const char table[] = "parameter,value,unit,surrogate,corrected,corrected_least,"
                            "corrected_greatest\n"
                            "landing.pitch,0.0349065850398866,rad,0.99,0.95,0.9,0.975\n"
                            "landing.pitch,0.0698131700797732,rad,0.98,,,\n"
                            "landing.distance,4,m,0.97,0.96,0.94,0.98\n"
                            ",,,0.9,0.9,0.8,0.95\n";

typedef struct fixture {
    char* directory;
    bt_study study;
} fixture;

static int setup(void** state) {
    static fixture f;
    static const char* const sets[] = {"title=\"it's `date`\\nset output 'x'\""};
    f.directory = toy_directory();
    if (bt_study_read("studies/reference/study.yaml", sets, 1, &f.study, NULL) != BT_OK)
        return -1;
    snprintf(f.study.directory, sizeof f.study.directory, "%s", f.directory);
    *state = &f;
    return 0;
}

static int teardown(void** state) {
    fixture* f = *state;
    toy_directory_remove(f->directory);
    bt_study_destroy(&f->study);
    return 0;
}

static bt_status draw(const fixture* f, const char* text) {
    char path[4096], folder[4096];
    assert_int_equal(
        bt_file_write(toy_path(path, f->directory, "reliability.csv"), text, strlen(text), NULL),
        BT_OK);
    return bt_reliability_draw(&f->study, toy_path(folder, f->directory, "figures"), NULL);
}

static char* read_file(const fixture* f, const char* name) {
    char path[4096], *text = NULL;
    assert_int_equal(bt_file_read(toy_path(path, f->directory, name), &text, NULL, NULL), BT_OK);
    return text;
}

/// Degrees and percent; a number that is missing stays an empty cell; one condition is no curve.
static void curves_are_in_display_units(void** state) {
    const fixture* f = *state;
    assert_int_equal(draw(f, table), BT_OK);
    char* data = read_file(f, "figures/reliability_landing_pitch.csv");
    assert_non_null(strstr(data, "\n2,95,90,97.5\n4,,,\n"));
    assert_non_null(strstr(data, "\n2,99\n4,98\n"));
    free(data);
    char path[4096];
    assert_int_not_equal(
        access(toy_path(path, f->directory, "figures/reliability_landing_distance.csv"), F_OK), 0);
}

/// Points; the heading and a row without widths are no points of the curve.
static void widths_are_drawn_over_landings(void** state) {
    const fixture* f = *state;
    static const char widths[] = "landings,overall,median,largest\n"
                                 "128,nan,nan,nan\n"
                                 "256,0.1,0.2,0.3\n"
                                 "384,0.05,0.1,0.25\n";
    char path[4096];
    assert_int_equal(bt_file_write(toy_path(path, f->directory, "convergence.csv"), widths,
                                   strlen(widths), NULL),
                     BT_OK);
    assert_int_equal(draw(f, table), BT_OK);
    char* data = read_file(f, "figures/convergence.csv");
    assert_non_null(strstr(data, "\n256,10\n384,5\n"));
    assert_non_null(strstr(data, "\n256,30\n384,25\n"));
    assert_null(strstr(data, "128"));
    free(data);
}

/// A title is one quoted text of the script, whatever is in it.
static void titles_are_no_commands(void** state) {
    const fixture* f = *state;
    assert_int_equal(draw(f, table), BT_OK);
    char* script = read_file(f, "figures/reliability_landing_pitch.gp");
    assert_non_null(
        strstr(script, "set title 'it''s `date` set output ''x'': reliability over pitch'\n"));
    free(script);
}

static void other_columns_are_refused(void** state) {
    const fixture* f = *state;
    assert_int_equal(draw(f, "parameter,value,corrected\nlanding.pitch,0.1,0.9\n"), BT_ERR_INPUT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_are_in_display_units),
        cmocka_unit_test(widths_are_drawn_over_landings),
        cmocka_unit_test(titles_are_no_commands),
        cmocka_unit_test(other_columns_are_refused),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
