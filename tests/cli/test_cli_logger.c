/// A drop test as a logger records it, put beside the rig: semicolons, decimal commas, units in
/// parentheses, four columns, 20,001 rows at 50 kHz whose times are printed to 0.1 ms and so
/// repeat, and a trigger before the first contact.
#include "cli_fixture.h"

#include "rigs/record.h"

#define GEAR "studies/rigs/open_nose_gear.yaml"

enum { ROWS = 20001 };
static const double trigger_s = 0.0124;

static void put(FILE* out, double value, int digits, char end) {
    char text[40];
    snprintf(text, sizeof text, "%.*f", digits, value);
    char* point = strchr(text, '.');
    if (point)
        *point = ',';
    fprintf(out, "%s%c", text, end);
}

static int column_of(const bt_rig_record* record, const char* name) {
    int c = 0;
    while (strcmp(record->names[c], name) != 0)
        ++c;
    return c;
}

/// The rig's own run as the logger would have seen it.
static void write_recording(const fixture* f) {
    bt_study study;
    bt_rig_record record;
    bt_rig_result result;
    char path[4096];
    assert_int_equal(bt_study_read_rigs(GEAR, NULL, 0, &study, NULL), BT_OK);
    bt_rig_record_start(&record, BT_RIG_NOSE_DROP);
    assert_int_equal(bt_rig_run(BT_RIG_NOSE_DROP, &study.model.aircraft, &study.rigs, &result,
                                bt_rig_record_observe, &record, NULL),
                     BT_OK);
    const int stroke = column_of(&record, "stroke_m"), load = column_of(&record, "strut_force_N");
    FILE* out = fopen(toy_path(path, f->directory, "drop.csv"), "w");
    assert_non_null(out);
    fputs("Time (s);Stroke (mm);Load cell (kN);Accel (g)\r\n", out);
    for (int i = 0; i < ROWS; ++i) {
        const double time = 20e-6 * i, at = fmax(time - trigger_s, 0);
        put(out, time, 4, ';');
        put(out, 1e3 * bt_rig_record_at(&record, stroke, 0, at), 3, ';');
        put(out, 1e-3 * bt_rig_record_at(&record, load, 0, at), 4, ';');
        put(out, 0.1, 3, '\r');
        fputc('\n', out);
    }
    fclose(out);
    bt_rig_record_destroy(&record);
    bt_study_destroy(&study);
}

/// The gear's file with a measured curve.
static void write_study(const fixture* f, const char* curve) {
    char *text = NULL, *with = NULL;
    size_t size = 0;
    assert_int_equal(bt_file_read(GEAR, &text, NULL, NULL), BT_OK);
    const char* at = strstr(text, "      tolerance: 0.001");
    assert_non_null(at);
    FILE* out = open_memstream(&with, &size);
    fprintf(out, "%.*s      curve: %s\n%s", (int)(at - text), text, curve, at);
    fclose(out);
    write_file(f, "drop.yaml", with);
    free(with);
    free(text);
}

/// The number behind the n-th appearance of a key in the JSON that was printed.
static double number(const fixture* f, const char* key, int n) {
    const char* at = f->out;
    for (int i = 0; i <= n; ++i) {
        at = strstr(at, key);
        assert_non_null(at);
        at += strlen(key);
    }
    return strtod(at + 2, NULL);
}

static void recording_is_compared_by_its_names_and_offset(void** state) {
    fixture* f = *state;
    write_recording(f);
    write_study(f, "{file: drop.csv, x: Time, y: {stroke: Stroke, strut_force: Load cell}, "
                   "offset: 12.4 ms}");
    assert_int_equal(bolter(f, "check %/drop.yaml"), 0);
    assert_has(f->out, "2 measured curves");
    assert_int_equal(bolter(f, "rig nose-drop %/drop.yaml --json -o %/x"), 0);
    // times printed to 0.1 ms are up to 50 us off: at 3 m/s, 0.15 mm; 0.04 mm root mean square
    assert_true(number(f, "\"rms_percent\"", 0) < 0.02);
    assert_true(number(f, "\"rms_percent\"", 1) < 0.02);
    assert_true(number(f, "\"area_between_percent\"", 0) < 0.1);
    BT_ASSERT_NEAR(number(f, "\"energy_J\"", 0), number(f, "\"energy_J\"", 1), 1e-5, 0);
    char* drawn = read_text(f, "x/figures/nose_drop_stroke.csv");
    assert_true(strlen(drawn) < 400000); // thinned, of 1.1 MB
    free(drawn);
    // without the offset the same recording is 12.4 ms late
    write_study(f, "{file: drop.csv, x: Time, y: {stroke: Stroke}}");
    assert_int_equal(bolter(f, "rig nose-drop %/drop.yaml --json -o %/x"), 0);
    assert_true(number(f, "\"rms_percent\"", 0) > 3);
}

static void load_over_stroke_is_scored_as_a_loop(void** state) {
    fixture* f = *state;
    write_recording(f);
    write_study(f, "{file: drop.csv, x: {stroke: Stroke}, y: {strut_force: Load cell}}");
    assert_int_equal(bolter(f, "rig nose-drop %/drop.yaml -o %/x"), 0);
    assert_has(f->out,
               "load over stroke, computed (measured): 50.19 kJ (50.19) to a stroke of 361.9 "
               "mm (361.9), efficiency 0.599 (0.599); area between the loops 0.0 %");
    assert_int_equal(bolter(f, "rig nose-drop %/drop.yaml -o %/x --json --set "
                               "aircraft.nose_gear.oleo.discharge=0.75"),
                     0);
    assert_true(number(f, "\"area_between_percent\"", 0) > 2);
}

static void wrong_mapping_is_refused_with_its_place(void** state) {
    fixture* f = *state;
    static const struct {
        const char *curve, *said;
    } rows[] = {
        {"drop.csv", "drop.csv:1:22: error: 4 columns (Time, Stroke, Load cell, Accel): say which"},
        {"{file: drop.csv, x: Tme, y: {stroke: Stroke}}",
         "has no column \"Tme\"; it has Time, Stroke, Load cell, Accel"},
        {"{file: drop.csv, y: {strok: Stroke}}", "error: strok: no such column"},
        {"{file: drop.csv, y: Stroke}", "reference.curve.y: columns are wanted here by their name"},
        {"{x: Time}", "reference.curve.file: missing"},
        {"{file: drop.csv, ofset: 3 ms}", "unknown key; did you mean \"offset\"?"},
    };
    write_recording(f);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        write_study(f, rows[i].curve);
        assert_int_equal(bolter(f, "check %/drop.yaml"), 3);
        assert_has(f->err, rows[i].said);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(recording_is_compared_by_its_names_and_offset),
        TEST(load_over_stroke_is_scored_as_a_loop),
        TEST(wrong_mapping_is_refused_with_its_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
