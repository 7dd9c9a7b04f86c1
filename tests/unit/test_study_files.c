// Files, --set, the echo and the hash.
#include "near.h"

#include "folder.h"
#include "messages.h"
#include "study/study.h"

#include <errno.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static const char* const reference = "studies/reference/study.yaml";
static char directory[FOLDER_SIZE];

static int setup(void** state) {
    (void)state;
    return folder_make(directory);
}

static int teardown(void** state) {
    (void)state;
    return rmdir(directory);
}

static bt_status read_file(const char* path, const char* const* sets, int count, bt_study* study,
                           messages* m) {
    *m = (messages){""};
    bt_diag diag = {.sink = messages_add, .user = m};
    return bt_study_read(path, sets, count, study, &diag);
}

static bt_status read_text(const char* text, bt_study* study, messages* m) {
    *m = (messages){""};
    bt_diag diag = {.sink = messages_add, .user = m};
    return bt_study_read_text("echo.yaml", text, strlen(text), NULL, 0, study, &diag);
}

static bt_study read_reference(const char* const* sets, int count) {
    bt_study study;
    messages m;
    if (read_file(reference, sets, count, &study, &m) != BT_OK)
        fail_msg("%s", m.text);
    return study;
}

/// Reads the reference with one --set; gives the hash.
/// Of the reference study with a design, and one key set when it is not NULL.
static uint64_t hash_of(const char* design, const char* set) {
    const char* const sets[] = {design, set};
    bt_study study = read_reference(sets, set ? 2 : 1);
    const uint64_t hash = study.hash;
    bt_study_destroy(&study);
    return hash;
}

/// In the box of a design.
static uint64_t hash_with(const char* set) {
    const bool design = set && strncmp(set, "campaign.design", 15) == 0;
    return hash_of(design ? set : "campaign.design=sobol", design ? NULL : set);
}

static void assert_set_says(const char* set, const char* want) {
    bt_study study;
    messages m;
    assert_int_equal(read_file(reference, &set, 1, &study, &m), BT_ERR_INPUT);
    assert_string_equal(m.text, want);
}

static void write_file(const char* name, const char* text) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    FILE* out = fopen(path, "w");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fclose(out), 0);
}

static void remove_file(const char* name) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    assert_int_equal(unlink(path), 0);
}

/// Replaces the directory's name by DIR in messages.
static void hide_directory(messages* m) {
    for (char* at; (at = strstr(m->text, directory));) {
        const size_t n = strlen(directory);
        memcpy(at, "DIR", 3);
        memmove(at + 3, at + n, strlen(at + n) + 1);
    }
}

static void the_reference_study_is_sound(void** state) {
    (void)state;
    bt_study s = read_reference(NULL, 0);
    assert_int_equal(s.input_count, 4);
    assert_int_equal(s.condition_count, 24);
    static const char* const paths[] = {"landing.sink_speed", "landing.horizontal_speed",
                                        "landing.pitch", "landing.distance"};
    for (int i = 0; i < 4; ++i) {
        assert_string_equal(s.inputs[i].path, paths[i]);
        assert_true(s.inputs[i].random && s.inputs[i].bounded);
    }
    assert_string_equal(s.directory, "studies/reference/study");
    assert_true(s.model.aircraft.main_gear.oleo.orifice_table.count == 4);
    assert_true(s.model.landing.sink_speed_mps == 3.6);
    bt_study_destroy(&s);
    bt_study_destroy(&s); // a second time does nothing
}

typedef struct both {
    const bt_model_params *a, *b;
} both;

static bool same_bits(void* user, const bt_field* field, const char* path, size_t offset) {
    const both* m = user;
    const size_t size = field->kind == BT_FIELD_LIST     ? sizeof(bt_list)
                        : field->kind == BT_FIELD_TABLE  ? sizeof(bt_table)
                        : field->kind == BT_FIELD_FLAG   ? sizeof(bool)
                        : field->kind == BT_FIELD_CHOICE ? sizeof(int)
                                                         : sizeof(double);
    if (memcmp((const char*)m->a + offset, (const char*)m->b + offset, size) != 0)
        fail_msg("%s differs", path);
    return true;
}

static void the_echo_reads_back_to_the_same_bits(void** state) {
    (void)state;
    static const char* const sets[] = {
        "title='A \"quoted\" \\ title, with: signs # and more'",
        "landing.pitch=2.7182818284590451 deg",
        "aircraft.hook.mass=237.9 lb",
        "campaign.design=full_factorial",
        "campaign.levels.landing.pitch=7",
        "campaign.bounds.aircraft.mass=[20 t, 24 t]",
        "uncertainty.aircraft.hook.mass={distribution: weibull, scale: 100 kg, shape: 9}",
        "campaign.bounds.aircraft.hook.mass=[1 kg, 500 kg]",
        "aircraft.main_gear.oleo.orifice_table=[[0 mm, 333 mm^2], [0.3 ft, 0.3 in^2]]",
        "surrogate.C=[0.3, 3e5]",
        "rigs.main_drop={mass: 9.3 t, sink_speed: 20 ft/s, reference: {stroke_max: 571 mm}}",
    };
    bt_study a = read_reference(sets, sizeof sets / sizeof sets[0]), b;
    messages m;
    if (read_text(a.text, &b, &m) != BT_OK)
        fail_msg("%s", m.text);
    both models = {&a.model, &b.model};
    bt_group_walk(&bt_model_group, same_bits, &models);
    assert_string_equal(a.title, b.title);
    assert_memory_equal(&a.surrogate, &b.surrogate, sizeof a.surrogate);
    assert_memory_equal(&a.campaign, &b.campaign, sizeof a.campaign);
    assert_memory_equal(&a.reliability, &b.reliability, sizeof a.reliability);
    assert_memory_equal(&a.rigs, &b.rigs, sizeof a.rigs);
    assert_true(a.rigs.main_drop.reference.stroke_max_m == 0.571);
    assert_int_equal(a.input_count, 6);
    assert_int_equal(a.input_count, b.input_count);
    for (int i = 0; i < a.input_count; ++i) {
        a.inputs[i].where = b.inputs[i].where = BT_NOWHERE;
        assert_string_equal(a.inputs[i].path, b.inputs[i].path);
        assert_memory_equal(&a.inputs[i].distribution, &b.inputs[i].distribution,
                            sizeof a.inputs[i].distribution);
        assert_true(
            a.inputs[i].lower == b.inputs[i].lower && a.inputs[i].upper == b.inputs[i].upper &&
            a.inputs[i].levels == b.inputs[i].levels && a.inputs[i].random == b.inputs[i].random);
    }
    assert_int_equal(a.condition_count, b.condition_count);
    assert_memory_equal(a.conditions, b.conditions,
                        sizeof a.conditions[0] * (size_t)a.condition_count);
    assert_true(a.hash == b.hash);
    bt_study_destroy(&a);
    bt_study_destroy(&b);
}

static void the_echo_shows_the_value_typed_and_the_value_used(void** state) {
    (void)state;
    bt_study s = read_reference(NULL, 0);
    assert_non_null(strstr(s.text, "\n  mass: 22000 kg\n"));
    assert_non_null(strstr(s.text, " precharge: 2e6 Pa  # typed: 2.0 MPa\n"));
    assert_non_null(strstr(s.text, "\n  roll: 0 rad  # default\n"));
    bt_study_destroy(&s);
}

static void set_replaces_and_adds(void** state) {
    (void)state;
    static const char* const sets[] = {
        "landing.pitch=8 deg",
        "landing.roll=1 deg",
        "landing.solver.past_cable=2 m", // a group that is not in the file
        "surrogate.C=[1, 10]",
        "uncertainty.landing.pitch.sd=2 deg",
        "campaign.bounds.landing.roll=[-1 deg, 1 deg]",
        "landing.pitch=7 deg", // the last one holds
    };
    bt_study s = read_reference(sets, sizeof sets / sizeof sets[0]);
    assert_true(s.model.landing.pitch_rad == 7 * M_PI / 180);
    assert_true(s.model.landing.roll_rad == M_PI / 180);
    assert_true(s.model.landing.solver.past_cable_m == 2);
    assert_int_equal(s.surrogate.C.count, 2);
    assert_int_equal(s.input_count, 5);
    assert_string_equal(s.inputs[3].path, "landing.roll");
    assert_true(s.inputs[2].distribution.sd == 2 * M_PI / 180);
    bt_study_destroy(&s);
}

static void every_mistake_in_a_set_is_said_with_it(void** state) {
    (void)state;
    assert_set_says("landing.pitch=8 m",
                    "--set landing.pitch: error: landing.pitch: \"8 m\" has a unit of another "
                    "dimension; use deg, rad or mrad\n");
    assert_set_says("landing.pich=8 deg",
                    "--set landing.pich: error: landing.pich: unknown key; did you mean "
                    "\"pitch\"?\n");
    assert_set_says("landing.pitch.more=8 deg", "--set landing.pitch.more: error: "
                                                "landing.pitch.more: unknown key; a value stands "
                                                "above it\n");
    assert_set_says("landing.pitch", "--set landing.pitch: error: PATH=VALUE is wanted, as in "
                                     "landing.pitch='4 deg'\n");
    assert_set_says("=3", "--set : error: PATH=VALUE is wanted, as in landing.pitch='4 deg'\n");
    assert_set_says("landing.pitch=", "--set landing.pitch: error: landing.pitch: \"\" is not a "
                                      "number; use deg, rad or mrad\n");
    assert_set_says("landing.pitch=[1", "--set landing.pitch: error: not valid YAML: did not find "
                                        "expected ',' or ']' while parsing a flow sequence\n");
    assert_set_says("landing.pitch=&a 3 deg",
                    "--set landing.pitch: error: anchors (&a) are not accepted; write the value "
                    "where it is needed\n");
    assert_set_says("campaign.bounds.landing.pich=[1 deg, 2 deg]",
                    "--set campaign.bounds.landing.pich: error: campaign.bounds.landing.pich: no "
                    "such key of the model; did you mean \"landing.pitch\"?\n");
    assert_set_says("aircraft=", "--set aircraft: error: aircraft: a mapping of keys is wanted "
                                 "here, not nothing\n");
}

static void errors_carry_the_file_they_are_in(void** state) {
    (void)state;
    write_file("study.yaml", "aircraft: plane.yaml\n"
                             "deck: deck.yaml\n"
                             "landing: {sink_speed: 3 m}\n");
    write_file("plane.yaml", "mas: 22 t\n");
    write_file("deck.yaml", "cable: {}\ngravity: 10\n");
    char path[512];
    snprintf(path, sizeof path, "%s/study.yaml", directory);
    bt_study s;
    messages m;
    assert_int_equal(read_file(path, NULL, 0, &s, &m), BT_ERR_INPUT);
    hide_directory(&m);
    assert_non_null(strstr(m.text,
                           "DIR/plane.yaml:1:1: error: aircraft.mas: unknown key; did you mean "
                           "\"mass\"?\n"));
    assert_non_null(strstr(m.text, "DIR/deck.yaml:2:10: error: deck.gravity: \"10\" has no unit; "
                                   "use m/s^2 or ft/s^2\n"));
    assert_non_null(strstr(m.text, "DIR/study.yaml:3:23: error: landing.sink_speed: \"3 m\" has a "
                                   "unit of another dimension; use m/s, km/h, kn, ft/s or "
                                   "ft/min\n"));
    remove_file("study.yaml");
    remove_file("plane.yaml");
    remove_file("deck.yaml");
}

static void files_that_cannot_be_read(void** state) {
    (void)state;
    char path[512];
    bt_study s;
    messages m;
    snprintf(path, sizeof path, "%s/none.yaml", directory);
    assert_int_equal(read_file(path, NULL, 0, &s, &m), BT_ERR_IO);
    hide_directory(&m);
    assert_string_equal(m.text,
                        "DIR/none.yaml: error: cannot be read: No such file or directory\n");

    assert_int_equal(read_file(directory, NULL, 0, &s, &m), BT_ERR_IO);
    hide_directory(&m);
    assert_string_equal(m.text, "DIR: error: cannot be read: Is a directory\n");

    write_file("empty.yaml", "# nothing\n");
    snprintf(path, sizeof path, "%s/empty.yaml", directory);
    assert_int_equal(read_file(path, NULL, 0, &s, &m), BT_ERR_INPUT);
    hide_directory(&m);
    assert_string_equal(m.text, "DIR/empty.yaml: error: the study is empty\n");

    const char* set = "aircraft=none.yaml";
    assert_int_equal(read_file(reference, &set, 1, &s, &m), BT_ERR_IO);
    assert_string_equal(m.text, "--set aircraft: error: aircraft: "
                                "\"studies/reference/none.yaml\" cannot be read: No such file or "
                                "directory\n");
    char empty[600];
    snprintf(empty, sizeof empty, "deck=%s/empty.yaml", directory);
    set = empty;
    assert_int_equal(read_file(reference, &set, 1, &s, &m), BT_ERR_INPUT);
    hide_directory(&m);
    assert_string_equal(m.text, "--set deck: error: deck: \"DIR/empty.yaml\" is empty\n");
    remove_file("empty.yaml");
}

static void a_text_in_memory_names_no_files(void** state) {
    (void)state;
    bt_study s;
    messages m;
    assert_int_equal(read_text("aircraft: a.yaml\n", &s, &m), BT_ERR_INPUT);
    assert_non_null(
        strstr(m.text, "echo.yaml:1:11: error: aircraft: a file cannot be named here\n"));
}

static void titles(void** state) {
    (void)state;
    char set[400] = "title=";
    memset(set + 6, 'x', 300);
    assert_set_says(set, "--set title: error: title: longer than 255 bytes\n");
    assert_set_says("title=[a]", "--set title: error: title: a text is wanted here\n");
}

static void the_study_directory_is_named_after_the_file(void** state) {
    (void)state;
    static const struct {
        const char *path, *directory;
    } rows[] = {{"a/b.yaml", "a/b"}, {"b.yml", "b"}, {"b", "b.study"}, {".yaml", ".yaml.study"}};
    bt_study reference_study = read_reference(NULL, 0);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        bt_study s;
        assert_int_equal(bt_study_read_text(rows[i].path, reference_study.text,
                                            strlen(reference_study.text), NULL, 0, &s, NULL),
                         BT_OK);
        assert_string_equal(s.directory, rows[i].directory);
        bt_study_destroy(&s);
    }
    bt_study_destroy(&reference_study);
}

/// The design conditions draws from the distributions and conditions, and fills no box.
static void the_hash_of_conditions_follows_what_is_asked(void** state) {
    (void)state;
    static const char design[] = "campaign.design=conditions";
    const uint64_t hash = hash_of(design, NULL);
    assert_true(hash_of(design, "uncertainty.landing.pitch.sd=1 deg") != hash);
    assert_true(hash_of(design, "reliability.conditions.landing.pitch=[1 deg]") != hash);
    assert_true(hash_of(design, "campaign.unsure=0.2") != hash);
    assert_true(hash_of(design, "campaign.samples=99") == hash);
    assert_true(hash_of(design, "campaign.bounds.landing.pitch=[-1.1 deg, 8 deg]") == hash);
}

static void the_hash_follows_what_runs_depend_on(void** state) {
    (void)state;
    const uint64_t hash = hash_with(NULL);
    static const char* const same[] = {
        "title=other",
        "campaign.samples=99",
        "campaign.threads=3",
        "campaign.max_failed=0.5",
        "surrogate.folds=3",
        "reliability.seed=9",
        "landing.pitch=3.0 deg",
        "landing.pitch=2 deg", // an axis: no run has it
        "aircraft.mass=22 t",
        "landing.roll=0 deg",
        "uncertainty.landing.pitch.sd=1 deg", // the box of the design is what is run
    };
    static const char* const other[] = {
        "campaign.seed=2",
        "campaign.design=latin_hypercube",
        "landing.roll=0.001 deg",
        "landing.distance_from=main_wheels",
        "deck.cable.pretension=24.001 kN",
        "campaign.bounds.landing.pitch=[-1.1 deg, 8 deg]",
        "campaign.bounds.landing.yaw=[-1 deg, 1 deg]",
        "aircraft.main_gear.oleo.orifice_table=[[0 mm, 375 mm^2], [600 mm, 160 mm^2]]",
    };
    for (size_t i = 0; i < sizeof same / sizeof same[0]; ++i)
        if (hash_with(same[i]) != hash)
            fail_msg("%s changes the hash", same[i]);
    for (size_t i = 0; i < sizeof other / sizeof other[0]; ++i)
        if (hash_with(other[i]) == hash)
            fail_msg("%s does not change the hash", other[i]);

    static const char* const monte_carlo[] = {"campaign.design=monte_carlo",
                                              "uncertainty.landing.pitch.sd=1 deg",
                                              "campaign.bounds.landing.pitch=[-1.1 deg, 8 deg]"};
    bt_study a = read_reference(monte_carlo, 1), b = read_reference(monte_carlo, 2);
    bt_study c = read_reference(monte_carlo, 3);
    assert_true(a.hash != b.hash);
    assert_true(b.hash == c.hash); // no box in this design
    bt_study_destroy(&a);
    bt_study_destroy(&b);
    bt_study_destroy(&c);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_reference_study_is_sound),
        cmocka_unit_test(the_echo_reads_back_to_the_same_bits),
        cmocka_unit_test(the_echo_shows_the_value_typed_and_the_value_used),
        cmocka_unit_test(set_replaces_and_adds),
        cmocka_unit_test(every_mistake_in_a_set_is_said_with_it),
        cmocka_unit_test(errors_carry_the_file_they_are_in),
        cmocka_unit_test(files_that_cannot_be_read),
        cmocka_unit_test(a_text_in_memory_names_no_files),
        cmocka_unit_test(titles),
        cmocka_unit_test(the_study_directory_is_named_after_the_file),
        cmocka_unit_test(the_hash_follows_what_runs_depend_on),
        cmocka_unit_test(the_hash_of_conditions_follows_what_is_asked),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
