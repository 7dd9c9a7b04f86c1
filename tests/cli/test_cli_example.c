/// --example: a shipped study in the place of STUDY.yaml.
#include "cli_fixture.h"

static void example_stands_for_the_study_file(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "land " REFERENCE " --json --quiet"), 0);
    char* file = strdup(f->out);
    assert_int_equal(bolter(f, "land --json --quiet --example reference"), 0);
    static const char key[] = "\"state_hash\":";
    const char *wanted = strstr(file, key), *found = strstr(f->out, key);
    assert_non_null(wanted);
    assert_non_null(found);
    assert_memory_equal(found, wanted, strcspn(wanted, ",}"));
    free(file);
}

static void results_of_an_example_go_here_by_its_name(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "check --example reference"), 0);
    assert_has(f->out, "results     reference\n");
    assert_int_equal(bolter(f, "check -e reference -o %/mine"), 0);
    assert_has(f->out, "/mine\n");
}

static void example_goes_behind_the_word_that_its_verb_wants_first(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "rig nose-drop -e rigs/open_nose_gear -o %/x"), 0);
    assert_has(f->out, "Open nose gear");
    assert_int_equal(bolter(f, "campaign status -e reference -o %/none"), 5);
    assert_has(f->err, "there is no ledger yet");
}

static void example_that_is_not_there_is_a_wrong_use_that_lists_them(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "land -e referense"), 2);
    assert_has(
        f->err,
        "there is no \"referense\"; there are: carrier, paper, rare, reference, rigs/currey");
    assert_int_equal(bolter(f, "land -e ../studies/reference"), 2);
    assert_int_equal(bolter(f, "land " REFERENCE " -e reference"), 2);
    assert_has(f->err, "one argument too many");
    assert_int_equal(bolter(f, "keys -e reference"), 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(example_stands_for_the_study_file),
        TEST(results_of_an_example_go_here_by_its_name),
        TEST(example_goes_behind_the_word_that_its_verb_wants_first),
        TEST(example_that_is_not_there_is_a_wrong_use_that_lists_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
