/// No verb ends otherwise than well without a word, every verb obeys signals, and nothing that is
/// printed lands in a file of Bolter's own.
#include "cli_fixture.h"

#include <time.h>

#define COARSE                                                                                     \
    "--set deck.cable.mesh.fine_length='0.2 m' --set deck.cable.mesh.medium_length='0.3 m' "       \
    "--set deck.cable.mesh.coarse_length='0.6 m' "
/* a selection and a landing of seconds */
#define MANY "--set surrogate.folds=100 "
#define FINE                                                                                       \
    " --set landing.solver.airframe_step='5e-7 s' --set landing.solver.contact_step='5e-7 s' "
#define SMALL REFERENCE " --set campaign.samples=4 "

/// A failure of every verb, and what it must end with.
static void every_failure_says_why(void** state) {
    fixture* f = *state;
    static const struct {
        const char* arguments;
        int code;
    } cases[] = {
        {"check no/such.yaml", 5},
        {"check " REFERENCE " --set aircraft.mass=wrong", 3},
        {"check " REFERENCE " --set campaign.design=sobol --set reliability.half_width=0.01", 3},
        {"check " REFERENCE " --set campaign.max_landings=9000", 3},
        {"keys one two three", 2},
        {"land no/such.yaml", 5},
        {"land " REFERENCE " --set aircraft.mass='300 kg'", 3},
        {"land " REFERENCE " --set aircraft.inertia_yy='3.58e5 kg m2'", 3},
        {"land " REFERENCE " --set deck.cable.supports.spacing='12 m' "
         "--set deck.cable.pretension='11 kN'",
         3},
        {"rig no-such-rig " REFERENCE, 2},
        {"sweep " REFERENCE " -q -o %/s --key aircraft.mas --values '1 kg'", 3},
        {"sweep " REFERENCE " -q -o %/s --key aircraft.mass --values '300 kg, 18200 kg'", 4},
        {"calibrate " REFERENCE " no/such.yaml", 5},
        {"campaign " REFERENCE " -q -o %/a --set campaign.samples=0", 3},
        {"campaign " SMALL " -q -o %/b --set aircraft.mass='300 kg'", 4},
        {"study " SMALL " -q -o %/c --set aircraft.mass='300 kg'", 4},
        {"replay " REFERENCE " 0 -o %/none", 5},
        {"fit " REFERENCE " -o %/none", 5},
        {"reliability " REFERENCE " -o %/none", 5},
        {"noise " REFERENCE " --samples 2 --variants steps_doubled --set aircraft.mass='300 kg'",
         4},
        {"sensitivity " REFERENCE " --samples 2 --keys deck.cable.mass "
         "--set aircraft.mass='300 kg'",
         4},
        {"why " REFERENCE " 0 -o %/none", 5},
        {"atlas " REFERENCE " -o %/none", 5},
        {"compare " REFERENCE " no/such.yaml", 5},
        {"land", 2},
        {"nothing", 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        const int code = bolter(f, cases[i].arguments);
        if (code != cases[i].code)
            fail_msg("%s: exit %d, not %d: %s", cases[i].arguments, code, cases[i].code, f->err);
        if (!f->err[0])
            fail_msg("%s: exit %d without a word", cases[i].arguments, code);
    }
}

static double now_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/// Whatever asks the program to end: it is 130, with a word, well before the work is done.
static void every_long_verb_obeys_every_signal(void** state) {
    fixture* f = *state;
    static const char* const signals[] = {"INT", "TERM", "HUP", "USR1", "XCPU"};
    static const char* const verbs[] = {
        "noise " REFERENCE " --samples 100000",
        "sensitivity " REFERENCE " --samples 100000",
        "campaign " REFERENCE " --set campaign.samples=100000 -o %/c",
        "study " REFERENCE " --set campaign.samples=100000 -o %/s",
        "calibrate " REFERENCE " studies/reference/calibration.yaml -o %/found.yaml",
        "land " REFERENCE FINE,
        "rig nose-drop " REFERENCE " --set rigs.nose_drop.step='1e-7 s' -o %/r",
        "sweep " REFERENCE FINE "--key landing.pitch --values '0..8 deg' -o %/w",
        "replay " REFERENCE FINE "0 -o %/one",
        "fit " REFERENCE " " COARSE MANY "-o %/few --again",
        "reliability " REFERENCE " " COARSE "--set reliability.samples=1e10 -o %/few",
    };
    assert_int_equal(bolter(f, "campaign " REFERENCE FINE "--set campaign.samples=1 -o %/one"), 0);
    assert_int_equal(bolter(f, "campaign " REFERENCE " " COARSE "--set campaign.samples=300 "
                               "-o %/few"),
                     0);
    for (size_t v = 0; v < sizeof verbs / sizeof verbs[0]; ++v)
        for (size_t s = 0; s < sizeof signals / sizeof signals[0]; ++s) {
            char line[1024];
            if (s > 0 && (s + v) % 4 != 0)
                continue; // each verb its own, each signal some
            snprintf(line, sizeof line, "%s & p=$!; sleep 0.7; kill -%s $p; wait $p", verbs[v],
                     signals[s]);
            const double begun_s = now_s();
            const int code = bolter(f, line);
            if (code != 130)
                fail_msg("%s: exit %d", line, code);
            assert_true(now_s() - begun_s < 0.7 + 2.5); // a second, on a machine that is busy
        }
}

/// With its standard error closed, the first file that is opened would get its number.
static void closed_streams_lead_into_no_file(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "campaign " SMALL " -o %/c 2>&- ; true"), 0);
    char* lock = read_text(f, "c/lock");
    assert_null(strstr(lock, "landings"));
    free(lock);
    assert_int_equal(bolter(f, "campaign status " SMALL " -o %/c"), 0);
    assert_has(f->out, "4 of 4 landings");
}

/// An axis that reaches where no aircraft is: the campaign ends, and those are its failed rows.
static void a_campaign_outlives_impossible_points(void** state) {
    fixture* f = *state;
    char* study = NULL;
    assert_int_equal(bt_file_read(REFERENCE, &study, NULL, NULL), BT_OK);
    char* bounds = strstr(study, "  bounds:");
    char path[4096];
    FILE* out = fopen(toy_path(path, f->directory, "study.yaml"), "w");
    assert_non_null(out);
    fprintf(out, "%.*s  bounds:\n    aircraft.mass: [200 kg, 22000 kg]\n%s", (int)(bounds - study),
            study, strchr(bounds, '\n') + 1);
    fclose(out);
    free(study);
    assert_int_equal(bolter(f, "--version; cp studies/reference/aircraft.yaml "
                               "studies/reference/deck.yaml %"),
                     0);
    assert_int_equal(bolter(f, "check %/study.yaml --set campaign.design=sobol"), 0);
    assert_has(f->err, "warning: aircraft.mass: at 200 kg, where its values end");
    assert_has(f->err, "not more than the mass of gear and hook, 527.9 kg");
    assert_int_equal(bolter(f, "check %/study.yaml --set campaign.design=sobol --set "
                               "aircraft.inertia_yy='3.58e5 kg m2'"),
                     3);
    assert_has(f->err, "aircraft.inertia_yy: 358000 kg m^2 is outside 358572 .. 529932 kg m^2");
    assert_int_equal(
        bolter(f,
               "campaign %/study.yaml -o %/c --set campaign.design=sobol --set campaign.samples=16 "
               "--set campaign.max_failed=0.5"),
        0);
    assert_has(f->out, "16 of 16 landings");
    assert_null(strstr(f->out, " 0 failed"));
    assert_int_equal(
        bolter(
            f,
            "campaign %/study.yaml -o %/d --set campaign.design=sobol --set campaign.samples=16"),
        4);
    assert_has(f->err, "more than max_failed = 0.01 allows");
}

/// Samples that reach where no aircraft is, though the campaign does not: the table is written, and
/// the high-fidelity runs that failed are counted and said, again at the next call.
static void too_many_failed_checks_end_the_analysis(void** state) {
    fixture* f = *state;
    char* study = NULL;
    assert_int_equal(bt_file_read(REFERENCE, &study, NULL, NULL), BT_OK);
    char *uncertainty = strstr(study, "uncertainty:\n"), *bounds = strstr(study, "  bounds:");
    char path[4096];
    FILE* out = fopen(toy_path(path, f->directory, "study.yaml"), "w");
    assert_non_null(out);
    fprintf(out,
            "%.*suncertainty:\n  aircraft.inertia_yy: {distribution: uniform, "
            "lower: 200000 kg m2, upper: 529000 kg m2}\n%.*s  bounds:\n"
            "    aircraft.inertia_yy: [360000 kg m2, 529000 kg m2]\n%s",
            (int)(uncertainty - study), study, (int)(bounds - strchr(uncertainty, '\n') - 1),
            strchr(uncertainty, '\n') + 1, strchr(bounds, '\n') + 1);
    fclose(out);
    free(study);
    assert_int_equal(bolter(f, "--version; cp studies/reference/aircraft.yaml "
                               "studies/reference/deck.yaml %"),
                     0);
    for (int again = 0; again < 2; ++again) {
        assert_int_equal(bolter(f, "study %/study.yaml -q -o %/s " COARSE
                                   "--set campaign.design=sobol --set campaign.samples=48 --set "
                                   "reliability.samples=2000 "
                                   "--set reliability.high_fidelity_runs=4"),
                         4);
        assert_has(f->err,
                   "high-fidelity runs failed, more than campaign.max_failed = 0.01 allows; "
                   "the first: ");
        assert_has(f->err, "aircraft.inertia_yy");
        free(read_text(f, "s/reliability.json"));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(every_failure_says_why),
        TEST(every_long_verb_obeys_every_signal),
        TEST(closed_streams_lead_into_no_file),
        TEST(a_campaign_outlives_impossible_points),
        TEST(too_many_failed_checks_end_the_analysis),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
