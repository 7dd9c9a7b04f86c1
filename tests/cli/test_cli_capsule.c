/// pack and verify: a study in one file, and its landings repeated to the bit.
#include "cli_fixture.h"

#include "campaign/capsule.h"

#include <sqlite3.h>

#define STUDY REFERENCE " --set campaign.samples=24 --set campaign.seed=5 -q "

static void make_campaign(fixture* f) {
    assert_int_equal(bolter(f, "campaign " STUDY "-o %/s"), 0);
}

static void sql(const fixture* f, const char* name, const char* text) {
    char path[4096];
    sqlite3* db = NULL;
    assert_int_equal(sqlite3_open(toy_path(path, f->directory, name), &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, text, NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
}

static void packed_study_verifies_to_the_bit(void** state) {
    fixture* f = *state;
    make_campaign(f);
    assert_int_equal(bolter(f, "pack " STUDY "-o %/s"), 0);
    assert_has(f->out, "methods.md");
    assert_true(exists(f, "s.bolter"));
    assert_int_equal(bolter(f, "verify %/s.bolter"), 0);
    assert_has(f->out, "20 of 20 landings");
    assert_has(f->out, "(24 in the ledger)");
    assert_int_equal(bolter(f, "verify %/s.bolter 1000 --json"), 0);
    assert_has(f->out, "\"repeated\": 24");
    assert_has(f->out, "\"same\": 24");
}

static void capsule_needs_nothing_beside_it(void** state) {
    fixture* f = *state;
    make_campaign(f);
    assert_int_equal(bolter(f, "pack " STUDY "-o %/s"), 0);
    char command[9000];
    snprintf(command, sizeof command,
             "rm -r '%s/s' && mkdir '%s/else' && mv '%s/s.bolter' '%s/else'", f->directory,
             f->directory, f->directory, f->directory);
    assert_int_equal(system(command), 0);
    assert_int_equal(bolter(f, "verify %/else/s.bolter 5"), 0);
    assert_false(exists(f, "s"));
}

static void capsule_has_the_study_the_results_and_the_methods(void** state) {
    fixture* f = *state;
    char path[4096], *text = NULL;
    make_campaign(f);
    write_file(f, "s/reliability.json", "{\"kept\": true}\n");
    snprintf(path, sizeof path, "mkdir '%s/s/figures' && echo figure >'%s/s/figures/a.svg'",
             f->directory, f->directory);
    assert_int_equal(system(path), 0);
    assert_int_equal(bolter(f, "pack " STUDY "-o %/s"), 0);
    toy_path(path, f->directory, "s.bolter");

    assert_int_equal(bt_capsule_read(path, "reliability.json", &text, NULL, NULL), BT_OK);
    assert_string_equal(text, "{\"kept\": true}\n");
    free(text);
    assert_int_equal(bt_capsule_read(path, "figures/a.svg", &text, NULL, NULL), BT_OK);
    assert_string_equal(text, "figure\n");
    free(text);
    assert_int_equal(bt_capsule_read(path, "versions.txt", &text, NULL, NULL), BT_OK);
    assert_has(text, "kernels ");
    free(text);
    assert_int_equal(bt_capsule_read(path, "methods.md", &text, NULL, NULL), BT_OK);
    assert_has(text, "24 carrier landings");
    assert_has(text, "(seed 5)");
    assert_has(text, "| `landing.sink_speed` | normal | 3.6 m/s |");
    free(text);
    assert_int_equal(bt_capsule_read(path, "no such file", &text, NULL, NULL), BT_ERR_IO);
}

static void landing_that_differs_is_named_with_what_differs(void** state) {
    fixture* f = *state;
    make_campaign(f);
    assert_int_equal(bolter(f, "pack " STUDY "-o %/s"), 0);
    sql(f, "s.bolter", "UPDATE runs SET margin_m = margin_m + 0.002 WHERE run = 3");
    assert_int_equal(bolter(f, "verify %/s.bolter 24"), 1);
    assert_has(f->out, "23 of 24 landings");
    assert_has(f->err, "1 landings differ, run 3 the first; 0 have another outcome");
    assert_has(f->err, "2 mm at most");
    assert_has(f->err, "a changed file");
    sql(f, "s.bolter", "UPDATE meta SET value = 'bolter 9.9.9, kernels v0' WHERE key = 'made_by'");
    assert_int_equal(bolter(f, "verify %/s.bolter 24"), 1);
    assert_has(f->out, "made by     bolter 9.9.9, kernels v0");
    assert_has(f->err, "another version or instruction set");
}

static void file_that_is_no_capsule_is_refused(void** state) {
    fixture* f = *state;
    make_campaign(f);
    write_file(f, "text.bolter", "not a capsule");
    assert_int_equal(bolter(f, "verify %/text.bolter"), 5);
    assert_has(f->err, "this is no capsule (bolter pack writes one)");
    assert_int_equal(bolter(f, "verify %/s/campaign.sqlite"), 5);
    assert_has(f->err, "this is no capsule");
    assert_int_equal(bolter(f, "verify %/none.bolter"), 5);
    assert_int_equal(bolter(f, "verify %/text.bolter --set landing.pitch='3 deg'"), 2);
    assert_int_equal(bolter(f, "verify %/text.bolter 0"), 2);
    // and is not overwritten
    write_file(f, "s.bolter", "not a capsule");
    assert_int_equal(bolter(f, "pack " STUDY "-o %/s"), 5);
    assert_has(f->err, "not written by Bolter");
    char* text = read_text(f, "s.bolter");
    assert_string_equal(text, "not a capsule");
    free(text);
}

static void packing_again_replaces_the_capsule(void** state) {
    fixture* f = *state;
    make_campaign(f);
    assert_int_equal(bolter(f, "pack " STUDY "-o %/s"), 0);
    assert_int_equal(bolter(f, "pack " STUDY "-o %/s"), 0);
    assert_int_equal(bolter(f, "verify %/s.bolter 2"), 0);
    assert_int_equal(bolter(f, "pack " STUDY "-o %/none"), 5);
    assert_has(f->err, "there is no ledger yet");
}

static void damaged_capsule_says_so(void** state) {
    fixture* f = *state;
    make_campaign(f);
    assert_int_equal(bolter(f, "pack " STUDY "-o %/s"), 0);
    sql(f, "s.bolter", "UPDATE sqlar SET data = 'aircraft: {' WHERE name = 'study.yaml'");
    assert_int_equal(bolter(f, "verify %/s.bolter"), 5);
    assert_has(f->err, "the capsule is damaged: it lacks: study.yaml");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(packed_study_verifies_to_the_bit),
        TEST(capsule_needs_nothing_beside_it),
        TEST(capsule_has_the_study_the_results_and_the_methods),
        TEST(landing_that_differs_is_named_with_what_differs),
        TEST(file_that_is_no_capsule_is_refused),
        TEST(packing_again_replaces_the_capsule),
        TEST(damaged_capsule_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
