/// `bolter noise` as a user types it.
#include "cli_fixture.h"

static void prints_a_row_for_each_computation(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "noise " REFERENCE " --samples 2 --variants steps_doubled"), 0);
    assert_has(f->out, "2 landings of ");
    assert_has(f->out, "| as the study sets it | - | - | - | ");
    assert_has(f->out, "| airframe and contact steps doubled: the reserve | ");
    assert_null(strstr(f->out, "segments of the cable half as long"));
}

static void json_is_one_object_with_all_counts(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "noise " REFERENCE " --samples 2 --variants strips_doubled --json"),
                     0);
    assert_true(f->out[0] == '{');
    static const char* const keys[] = {
        "\"landings\": 2", "\"name\": \"as_set\"", "\"name\": \"strips_doubled\"",
        "\"flips\": ",     "\"wrong_side\": ",     "\"failed\": 0"};
    for (size_t k = 0; k < sizeof keys / sizeof *keys; ++k)
        assert_has(f->out, keys[k]);
}

static void csv_has_a_row_for_each_computation(void** state) {
    fixture* f = *state;
    assert_int_equal(
        bolter(f, "noise " REFERENCE " --samples 2 --variants strips_doubled -q -o %/n.csv"), 0);
    assert_string_equal(f->err, "");
    char* table = read_text(f, "n.csv");
    assert_has(table, "name,computation,flips,flips_share,flips_share_least,");
    assert_has(table, "\nas_set,");
    assert_has(table, "\nstrips_doubled,twice the strips of the tyres,0,0,0,"); // 0 of 2 changed
    free(table);
}

static void wrong_use_is_refused(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "noise " REFERENCE " --samples 0"), 2);
    assert_int_equal(bolter(f, "noise " REFERENCE " --variants steps_halved,foo"), 2);
    assert_has(f->err, "there is no \"foo\"");
    assert_int_equal(bolter(f, "noise no/such/file.yaml"), 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(prints_a_row_for_each_computation),
        TEST(json_is_one_object_with_all_counts),
        TEST(csv_has_a_row_for_each_computation),
        TEST(wrong_use_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
