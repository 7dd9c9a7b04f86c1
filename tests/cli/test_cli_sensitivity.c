/// `bolter sensitivity` as a user types it.
#include "cli_fixture.h"

#define TYPED "sensitivity " REFERENCE " --samples 2 --quiet "

static void a_key_goes_through_the_range_that_is_typed(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, TYPED "--keys "
                                     "'aircraft.hook.damper_angle=85 deg..100 deg,"
                                     "deck.cable.mass'"),
                     0);
    assert_has(f->out, "| aircraft.hook.damper_angle | 1.571 | 1.484 | 1.745 | rad | ");
    assert_has(f->out, "| deck.cable.mass | 5.536 | 4.982 | 6.09 | kg/m | "); // 10 % of it
    assert_null(strstr(f->out, "## D"));
}

static void an_assumption_has_a_likely_range_of_its_own(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, TYPED "--keys deck.cable.wheel_friction"), 0);
    assert_has(f->out, "| deck.cable.wheel_friction | 0.2 | 0 | 0.8 |  | ");
}

static void each_distance_has_a_table(void** state) {
    fixture* f = *state;
    assert_int_equal(
        bolter(f, TYPED "--at '2 m,5.5 m' --keys aircraft.main_gear.tyre.bridging_length"), 0);
    assert_has(f->out, "## D = 2 m");
    assert_has(f->out, "## D = 5.5 m");
    assert_has(f->out, "| aircraft.main_gear.tyre.bridging_length | 0.05 | 0 | 0.15 | m | ");
    assert_int_equal(bolter(f, TYPED "--at '2 m,5.5 m' --keys deck.cable.mass -o %/k.csv"), 0);
    char* table = read_text(f, "k.csv");
    assert_has(table, "\n2,");
    assert_has(table, "\n5.5,");
    assert_has(table, ",deck.cable.mass,5.536,");
    free(table);
}

/// Held at a distance the landing is that of the study with this distance, the others drawn.
static void a_held_distance_may_be_a_key_no_longer_drawn(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, TYPED "--at '2 m' --keys 'landing.distance=2 m..8 m' --json"), 0);
    assert_true(f->out[0] == '{');
    static const char* const keys[] = {"\"distances\": [", "\"distance_m\": 2", "\"low\": 2",
                                       "\"high\": 8", "\"margin_lower_m\": 0"};
    for (size_t k = 0; k < sizeof keys / sizeof *keys; ++k)
        assert_has(f->out, keys[k]);
}

static void what_the_model_cannot_be_is_said_in_its_row(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, TYPED "--keys 'deck.cable.mass=-1 kg/m..5 kg/m'"), 0);
    assert_has(f->out, "| refused | ");
}

static void wrong_use_is_refused(void** state) {
    fixture* f = *state;
    static const char* const wrong[][2] = {
        {"--keys deck.cable.foo", "is no number of the model"},
        {"--keys landing.distance", "is drawn from its distribution"},
        {"--keys aircraft.main_gear.tyre.damping_ratio", "is 0, of which there is no share"},
        {"--keys aircraft.hook.damper_angle=85..100", "has no unit"},
        {"--keys deck.cable.wheel_friction=0.5", "write LOW..HIGH"},
        {"--keys deck.cable.wheel_friction=0.5..0.1", "not below the second"},
        {"--at 2", "has no unit"},
        {"--at ''", "no distance"},
        {"--change 2", "is no share"}};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        char line[256];
        snprintf(line, sizeof line, TYPED "%s", wrong[k][0]);
        assert_int_equal(bolter(f, line), 2);
        assert_has(f->err, wrong[k][1]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(a_key_goes_through_the_range_that_is_typed),
        TEST(an_assumption_has_a_likely_range_of_its_own),
        TEST(each_distance_has_a_table),
        TEST(a_held_distance_may_be_a_key_no_longer_drawn),
        TEST(what_the_model_cannot_be_is_said_in_its_row),
        TEST(wrong_use_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
