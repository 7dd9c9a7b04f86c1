/// `bolter why`, `atlas`, `compare` and the runs that `replay` finds, as a user types them.
#include "cli_fixture.h"

#define COARSE                                                                                     \
    "--set deck.cable.mesh.fine_length='0.2 m' --set deck.cable.mesh.medium_length='0.3 m' "       \
    "--set deck.cable.mesh.coarse_length='0.6 m' --set campaign.samples=96 "

/// The number after "key": in a JSON text.
static double number(const char* text, const char* key) {
    char quoted[64];
    snprintf(quoted, sizeof quoted, "\"%s\": ", key);
    assert_has(text, quoted);
    return strtod(strstr(text, quoted) + strlen(quoted), NULL);
}

/// The landing of the tutorial: the hook comes while the cable is down; the change that is named
/// changes the outcome, and a little less of it does not.
static void why_names_what_would_have_changed_it(void** state) {
    fixture* f = *state;
    char line[512];
    assert_int_equal(bolter(f, "why " REFERENCE " " COARSE "--set landing.distance='8 m' --json"),
                     0);
    const bool missed = strstr(f->out, "\"outcome\": \"missed\"") != NULL;
    static const char* const told[] = {"touchdown", "left wheel on the cable",
                                       "the wheels' wave reaches the hook's line",
                                       "wave back from the first support", "hook meets the cable"};
    for (size_t i = 0; i < sizeof told / sizeof *told; ++i)
        assert_has(f->out, told[i]);
    const char* flips = strstr(f->out, "\"flips\": [");
    assert_non_null(flips);
    char path[64];
    assert_int_equal(sscanf(strstr(flips, "\"input\": \"") + 10, "%63[^\"]", path), 1);
    const double change = number(flips, "change_sd"), width = number(flips, "width_sd"),
                 value = number(flips, "value");
    assert_true(fabs(change) < 4 && width > 0 && width < 0.01);
    snprintf(line, sizeof line,
             "land " REFERENCE " " COARSE "--set landing.distance='8 m' "
             "--set %s='%.17g %s' --json",
             path, value,
             strstr(path, "pitch")      ? "rad"
             : strstr(path, "distance") ? "m"
                                        : "m/s");
    assert_int_equal(bolter(f, line), 0);
    assert_has(f->out, missed ? "\"outcome\": \"engaged\"" : "\"outcome\": \"missed\"");
}

static void misses_are_sorted_and_found(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "campaign " REFERENCE " -q " COARSE "-o %/s"), 0);
    assert_int_equal(bolter(f, "atlas " REFERENCE " " COARSE "-o %/s --json"), 0);
    double share = 0;
    int landings = 0;
    for (const char* at = strstr(f->out, "\"groups\""); (at = strstr(at, "\"share\": ")); ++at) {
        share += number(at, "share");
        landings += (int)number(at, "landings");
    }
    BT_ASSERT_NEAR(share, 1, 1e-9, 0);
    assert_true(landings > 0 && number(f->out, "missed") < 0.3);
    assert_int_equal(bolter(f, "atlas " REFERENCE " " COARSE "-o %/s"), 0);
    assert_has(f->out, "typical run");
    assert_has(f->out, "1 - R from them alone");

    assert_int_equal(bolter(f, "replay " REFERENCE " --nearest limit " COARSE "-o %/s --json"), 0);
    const double nearest = fabs(number(f->out, "margin_m"));
    assert_int_equal(bolter(f, "replay " REFERENCE " --missed " COARSE "-o %/s --json"), 0);
    assert_true(nearest <= fabs(number(f->out, "margin_m")));
    assert_int_equal(bolter(f, "replay " REFERENCE " 3 " COARSE "-o %/s --history %/run.csv"), 0);
    assert_true(exists(f, "run.csv"));
    assert_int_equal(bolter(f, "why " REFERENCE " 96 " COARSE "-o %/s"), 2);
    assert_has(f->err, "the ledger has no run 96");
}

static void a_study_is_compared_with_another(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "compare " REFERENCE " " REFERENCE " " COARSE "--samples 6"), 0);
    assert_has(f->out, "The studies do not differ.");
    char command[8192];
    snprintf(command, sizeof command,
             "cp -r studies/reference '%s/other' && "
             "sed -i 's/height: 97 mm/height: 60 mm/' '%s/other/deck.yaml'",
             f->directory, f->directory);
    assert_int_equal(system(command), 0);
    assert_int_equal(
        bolter(f, "compare " REFERENCE " %/other/study.yaml " COARSE "--samples 12 --json"), 0);
    assert_has(f->out, "\"key\": \"deck.cable.supports.height\"");
    assert_null(strstr(f->out, "\"key\": \"landing"));
    assert_true(number(f->out, "difference") < 0); // the hook is above such a cable
    assert_true(number(f->out, "lost") >= 6);
    assert_int_equal(bolter(f, "compare " REFERENCE " no/such.yaml"), 5);
    assert_int_equal(bolter(f, "compare " REFERENCE), 2);
    assert_int_equal(bolter(f, "compare " REFERENCE " " REFERENCE " --samples no"), 2);
}

static void wrong_use_says_why(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "why " REFERENCE " 0 -o %/none"), 5);
    assert_int_equal(bolter(f, "why " REFERENCE " seven"), 2);
    assert_has(f->err, "not a whole number");
    assert_int_equal(bolter(f, "atlas " REFERENCE " -o %/none"), 5);
    assert_true(f->err[0] != 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(why_names_what_would_have_changed_it),
        TEST(misses_are_sorted_and_found),
        TEST(a_study_is_compared_with_another),
        TEST(wrong_use_says_why),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
