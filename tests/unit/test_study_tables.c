// What a study takes from tables of others: samples of an input.
#include "near.h"

#include "folder.h"
#include "messages.h"
#include "study/study.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

typedef struct fixture {
    char folder[FOLDER_SIZE], study[FOLDER_SIZE + 16], table[FOLDER_SIZE + 16];
    char* bulk; ///< aircraft, deck and landing of the reference study
    messages said;
} fixture;

static int setup(void** state) {
    fixture* f = calloc(1, sizeof *f);
    bt_study reference;
    *state = f;
    if (folder_make(f->folder) != 0 ||
        bt_study_read("studies/reference/study.yaml", NULL, 0, &reference, NULL) != BT_OK)
        return -1;
    snprintf(f->study, sizeof f->study, "%s/s.yaml", f->folder);
    snprintf(f->table, sizeof f->table, "%s/t.csv", f->folder);
    *strstr(reference.text, "\nuncertainty:") = '\0';
    f->bulk = strdup(strstr(reference.text, "\naircraft:"));
    bt_study_destroy(&reference);
    return f->bulk ? 0 : -1;
}

static int teardown(void** state) {
    fixture* f = *state;
    unlink(f->study);
    unlink(f->table);
    rmdir(f->folder);
    free(f->bulk);
    free(f);
    return 0;
}

static void put(const char* path, const char* text, const char* more) {
    FILE* file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "%s%s", text, more);
    fclose(file);
}

static bt_status read_study(fixture* f, const char* lines, const char* table, bt_study* study) {
    put(f->study, lines, f->bulk);
    put(f->table, table, "");
    f->said = (messages){""};
    bt_diag diag = {.sink = messages_add, .user = &f->said};
    return bt_study_read(f->study, NULL, 0, study, &diag);
}

/// `want` is what is said, without the folder in front.
static void assert_says(fixture* f, const char* lines, const char* table, const char* want) {
    bt_study study;
    assert_int_equal(read_study(f, lines, table, &study), BT_ERR_INPUT);
    const size_t length = strlen(f->folder) + 1;
    char plain[4096];
    size_t used = 0;
    for (const char* at = f->said.text; *at && used + 1 < sizeof plain;)
        if (strncmp(at, f->folder, length - 1) == 0)
            at += length;
        else
            plain[used++] = *at++;
    plain[used] = '\0';
    assert_string_equal(plain, want);
}

static void assert_reads(fixture* f, const char* lines, const char* table, bt_study* study) {
    if (read_study(f, lines, table, study) != BT_OK)
        fail_msg("%s", f->said.text);
}

/// The text of a study holds all it needs: it reads back to the same.
static void assert_text_is_whole(const bt_study* study) {
    bt_study again;
    messages said = {""};
    bt_diag diag = {.sink = messages_add, .user = &said};
    if (bt_study_read_text("again", study->text, strlen(study->text), NULL, 0, &again, &diag) !=
        BT_OK)
        fail_msg("%s", said.text);
    const char *now = strstr(study->text, "\nuncertainty:"),
               *then = strstr(again.text, "\nuncertainty:");
    assert_memory_equal(now, then, (size_t)(strstr(now, "\ncampaign:") - now));
    assert_true(again.hash == study->hash);
    bt_study_destroy(&again);
}

#define SINK "uncertainty:\n  landing.sink_speed: {distribution: "
#define DRAWN "campaign: {design: monte_carlo}\n"

static void a_column_of_a_file_is_a_distribution(void** state) {
    fixture* f = *state;
    bt_study study;
    assert_reads(f, DRAWN SINK "empirical, file: t.csv, column: Sink rate}\n",
                 "run;Sink rate (ft/min);by\n1;600;A\n2;720,5;B\n3;600;A\n", &study);
    const bt_distribution* d = &study.inputs[0].distribution;
    assert_int_equal(d->kind, BT_EMPIRICAL);
    assert_true(bt_distribution_quantile(d, 0.5) == 600 * 0.3048 / 60);
    BT_ASSERT_NEAR(bt_distribution_quantile(d, 0.7), 720.5 * 0.3048 / 60, 1e-15, 0);
    BT_ASSERT_NEAR(d->mean, (2 * 600 + 720.5) / 3 * 0.3048 / 60, 1e-15, 0);
    assert_text_is_whole(&study);
    assert_true(bt_study_reads(&study, f->table));
    bt_study_destroy(&study);

    assert_reads(f, DRAWN SINK "empirical, file: t.csv, bandwidth: auto}\n",
                 "Sink rate [m/s]\n3\n4\n3.5\n5\n", &study);
    assert_true(bt_sample_is_smooth(study.inputs[0].distribution.sample));
    assert_text_is_whole(&study);
    bt_study_destroy(&study);

    assert_reads(f, DRAWN SINK "discrete, values: [4 m/s, 3 m/s], probabilities: [0.3, 0.7]}\n", "",
                 &study);
    BT_ASSERT_NEAR(study.inputs[0].distribution.mean, 3.3, 1e-15, 0);
    assert_text_is_whole(&study);
    bt_study_destroy(&study);
}

static void families_read_back_to_the_same(void** state) {
    fixture* f = *state;
    static const char* const families[] = {"beta, sd: 0.5 m/s, lower: 1 m/s, upper: 8 m/s",
                                           "gamma, sd: 0.5 m/s, lower: 1 ft/s",
                                           "rayleigh, scale: 2 m/s",
                                           "logistic, mean: 3 m/s, sd: 0.4 m/s",
                                           "log_uniform, lower: 1 m/s, upper: 6 m/s",
                                           "student, scale: 0.3 m/s, freedom: 5"};
    for (size_t i = 0; i < sizeof families / sizeof families[0]; ++i) {
        char lines[256];
        bt_study study;
        snprintf(lines, sizeof lines, DRAWN SINK "%s}\n", families[i]);
        assert_reads(f, lines, "", &study);
        assert_text_is_whole(&study);
        bt_study_destroy(&study);
    }
}

static void samples_that_cannot_be_are_refused_at_their_place(void** state) {
    fixture* f = *state;
    const char* const file = DRAWN SINK "empirical, file: t.csv}\n";
    assert_says(f, file, "v [m/s]\n3.1\n",
                "s.yaml:3:55: error: uncertainty.landing.sink_speed: an empirical distribution "
                "needs two different values at least; here is one\n");
    assert_says(f, file, "v [m/s]\n3.1\n3.1\n",
                "s.yaml:3:55: error: uncertainty.landing.sink_speed: an empirical distribution "
                "needs two different values at least; here are only equal ones\n");
    assert_says(f, file, "v [m/s]\n3.1\nNaN\n3\n",
                "t.csv:3:1: error: v: \"NaN\" is not a number\n");
    assert_says(f, file, "v\n3.1\n3\n",
                "t.csv:1:1: error: v: its unit is missing; write it in brackets: v [m/s]\n");
    assert_says(f, file, "v [kg]\n3.1\n3\n",
                "t.csv:1:1: error: v: the unit of its heading is wrong: \"1 kg\" has a unit of "
                "another dimension; use m/s, km/h, kn, ft/s or ft/min\n");
    assert_says(f, file, "v [m/s]\n3.1\n-3\n",
                "t.csv:3:1: error: v: -3 m/s is outside 0.01 .. 15 m/s\n");
    assert_says(f, file, "v [m/s], w [m/s]\n3.1, 3\n",
                "t.csv:1:10: error: uncertainty.landing.sink_speed.column: missing; it says which "
                "of the 2 columns is meant: v, w\n");
    assert_says(f, DRAWN SINK "empirical, file: t.csv, column: u}\n", "v [m/s], w [m/s]\n3.1, 3\n",
                "s.yaml:3:70: error: uncertainty.landing.sink_speed.column: t.csv has no column "
                "\"u\"; it has v, w\n");
    assert_says(f, DRAWN SINK "empirical}\n", "",
                "s.yaml:3:3: error: uncertainty.landing.sink_speed: no file and no values; "
                "empirical needs one of them\n");
    assert_says(f, DRAWN SINK "empirical, values: [3 m/s, 4 m/s], bandwidth: -1 m/s}\n", "",
                "s.yaml:3:84: error: uncertainty.landing.sink_speed.bandwidth: must be positive, "
                "or auto\n");
    assert_says(f, DRAWN SINK "discrete, values: [3 m/s, 4 m/s], probabilities: [0.5, 0.4]}\n", "",
                "s.yaml:3:87: error: uncertainty.landing.sink_speed.probabilities: their sum is "
                "0.9, not 1\n");
    assert_says(f, DRAWN SINK "discrete, values: [3 m/s, 3 m/s], probabilities: [0.5, 0.5]}\n", "",
                "s.yaml:3:64: error: uncertainty.landing.sink_speed.values: 3 m/s is given "
                "twice\n");
    assert_says(f, DRAWN SINK "discrete, values: [3 m/s], probabilities: [0.5, 0.5]}\n", "",
                "s.yaml:3:80: error: uncertainty.landing.sink_speed.probabilities: 2 probabilities "
                "for 1 values\n");
    // once, not for every condition that would move its mean
    assert_says(f,
                DRAWN SINK "empirical, file: t.csv}\n"
                           "reliability:\n  conditions: {landing.sink_speed: [3 m/s, 4 m/s]}\n",
                "v [m/s]\n3.1\n",
                "s.yaml:3:55: error: uncertainty.landing.sink_speed: an empirical distribution "
                "needs two different values at least; here is one\n");
}

#define PAIRS                                                                                      \
    DRAWN "uncertainty:\n  landing.sink_speed: {distribution: normal, sd: 0.5 m/s}\n"              \
          "  landing.pitch: {distribution: normal, sd: 1 deg}\n"                                   \
          "  landing.distance: {distribution: gamma, sd: 1 m}\n"                                   \
          "  aircraft.mass: {distribution: discrete, values: [20 t, 21 t], probabilities: [0.5, "  \
          "0.5]}\n"                                                                                \
          "  correlation: "

static void correlations_are_read_and_echoed(void** state) {
    fixture* f = *state;
    bt_study study;
    assert_reads(f, PAIRS "[[landing.distance, landing.pitch, -0.4]]\n", "", &study);
    assert_int_equal(study.correlation_count, 1);
    assert_string_equal(study.inputs[study.correlations[0].first].path, "landing.distance");
    assert_true(study.copula.dims == study.input_count);
    assert_text_is_whole(&study);
    bt_study_destroy(&study);
}

static void correlations_that_cannot_be_are_refused_at_their_place(void** state) {
    fixture* f = *state;
    assert_says(f, PAIRS "[[landing.sinkspeed, landing.pitch, 0.4]]\n", "",
                "s.yaml:7:18: error: uncertainty.correlation: \"landing.sinkspeed\" has no "
                "distribution in uncertainty; did you mean \"landing.sink_speed\"?\n");
    assert_says(f, PAIRS "[[landing.sink_speed, landing.pitch, 1.4]]\n", "",
                "s.yaml:7:53: error: uncertainty.correlation: 1.4 is outside -1 .. 1\n");
    assert_says(f, PAIRS "[[landing.sink_speed, aircraft.mass, 0.4]]\n", "",
                "s.yaml:7:38: error: uncertainty.correlation: aircraft.mass takes single values "
                "(discrete), which have no density that a correlation could change; an empirical "
                "one has with a bandwidth\n");
    assert_says(f,
                PAIRS "[[landing.sink_speed, landing.pitch, 0.9], [landing.pitch, "
                      "landing.distance, 0.9], [landing.sink_speed, landing.distance, -0.5]]\n",
                "",
                "s.yaml:7:99: error: uncertainty.correlation: with landing.sink_speed and "
                "landing.distance at -0.5 the correlations are not positive definite: no variables "
                "can be correlated so (pairs not given are 0); weaken this one or others of these "
                "inputs\n");
    assert_says(f,
                PAIRS "[[landing.sink_speed, landing.pitch, 0.1], [landing.pitch, "
                      "landing.sink_speed, 0.2]]\n",
                "", "s.yaml:7:59: error: uncertainty.correlation: this pair is given twice\n");
    assert_says(f, PAIRS "[landing.pitch]\n", "",
                "s.yaml:7:17: error: uncertainty.correlation: two inputs and their rank "
                "correlation are wanted here, as in [landing.sink_speed, landing.pitch, -0.4]\n");
}

/// A mean that a condition moves to must leave a distribution.
static void a_condition_that_leaves_no_distribution_is_refused(void** state) {
    fixture* f = *state;
    assert_says(f,
                DRAWN "uncertainty:\n  landing.distance: {distribution: log_uniform, lower: 1 m, "
                      "upper: 9 m}\nreliability: {conditions: {landing.distance: [4 m, -1 m]}}\n",
                "",
                "s.yaml:4:52: error: reliability.conditions.landing.distance: lower must be "
                "positive with the mean at -1 m\n");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_column_of_a_file_is_a_distribution, setup, teardown),
        cmocka_unit_test_setup_teardown(families_read_back_to_the_same, setup, teardown),
        cmocka_unit_test_setup_teardown(samples_that_cannot_be_are_refused_at_their_place, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(correlations_are_read_and_echoed, setup, teardown),
        cmocka_unit_test_setup_teardown(correlations_that_cannot_be_are_refused_at_their_place,
                                        setup, teardown),
        cmocka_unit_test_setup_teardown(a_condition_that_leaves_no_distribution_is_refused, setup,
                                        teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
