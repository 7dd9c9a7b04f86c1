/// What a user types: exit codes, help, messages, and the whole chain at small size.
#include "cli_fixture.h"

#include <fcntl.h>
#include <signal.h>
#include <time.h>

/* A coarse cable and few landings: the whole chain in seconds. */
#define SMALL                                                                                      \
    "--set deck.cable.mesh.fine_length='0.2 m' --set deck.cable.mesh.medium_length='0.3 m' "       \
    "--set deck.cable.mesh.coarse_length='0.6 m' --set campaign.samples=96 "                       \
    "--set reliability.samples=20000 --set reliability.high_fidelity_runs=2 "

/// The number after "key": in a JSON text.
static double json_number(const char* text, const char* key) {
    char quoted[64];
    snprintf(quoted, sizeof quoted, "\"%s\": ", key);
    const char* at = strstr(text, quoted);
    if (!at)
        fail_msg("no key %s in:\n%s", key, text);
    return atof(at + strlen(quoted));
}

static void help_and_version_are_no_errors(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "--help"), 0);
    assert_has(f->out, "Usage: bolter VERB");
    assert_has(f->out, "Exit codes");
    assert_int_equal(bolter(f, "--version"), 0);
    assert_has(f->out, "bolter ");
    assert_int_equal(bolter(f, "--version --verbose"), 0);
    static const char* const told[] = {"processor ", " usable", "system ", "glibc ", "numbers ",
                                       "kernels ",   "libsvm ", "sqlite ", "mpi ",   "page "};
    for (size_t i = 0; i < sizeof told / sizeof told[0]; ++i)
        assert_has(f->out, told[i]);
    assert_has(f->out, "-ffp-contract=off");
    static const char* const verbs[] = {"check",     "keys",     "land",       "rig", "sweep",
                                        "calibrate", "campaign", "replay",     "fit", "reliability",
                                        "study",     "noise",    "sensitivity"};
    for (size_t i = 0; i < sizeof verbs / sizeof verbs[0]; ++i) {
        char arguments[64];
        snprintf(arguments, sizeof arguments, "%s --help", verbs[i]);
        assert_int_equal(bolter(f, arguments), 0);
        assert_has(f->out, "Usage: bolter ");
        assert_has(f->out, "--set=PATH=VALUE");
    }
}

static void wrong_use_is_exit_code_2(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, ""), 2);
    assert_int_equal(bolter(f, "chekc " REFERENCE), 2);
    assert_has(f->err, "did you mean \"check\"?");
    assert_int_equal(bolter(f, "aircraft"), 2);
    assert_null(strstr(f->err, "did you mean"));
    assert_int_equal(bolter(f, "check"), 2);
    assert_has(f->err, "STUDY.yaml expected");
    assert_int_equal(bolter(f, "check " REFERENCE " more"), 2);
    assert_int_equal(bolter(f, "land " REFERENCE " --no-such-option"), 2);
    assert_int_equal(bolter(f, "replay " REFERENCE " seven"), 2);
    assert_has(f->err, "not a whole number");
    assert_int_equal(bolter(f, "campaign " REFERENCE " -o % --shard 9/8"), 2);
    assert_int_equal(bolter(f, "campaign merge " REFERENCE), 2);
}

static void the_defaults_are_a_study_that_can_be_run(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "keys --defaults"), 0);
    write_file(f, "mine.yaml", f->out);
    assert_int_equal(bolter(f, "check %/mine.yaml"), 0);
    assert_has(f->out, "over landing.sink_speed, landing.distance");
    assert_has(f->out, "3 conditions");
    assert_string_equal(f->err, "");
}

/// A command of the shell, "%" standing for the test's directory.
static int system_in(const fixture* f, const char* command) {
    char text[9000] = "";
    for (const char* c = command; *c; ++c)
        if (*c == '%')
            strcat(text, f->directory);
        else
            strncat(text, c, 1);
    return system(text);
}

static void what_a_command_reads_is_never_written_over(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "keys --defaults"), 0);
    char* study = strdup(f->out);
    write_file(f, "study.yaml", study);
    assert_int_equal(system_in(f, "ln %/study.yaml %/link.yaml"), 0);
    static const char* const commands[] = {"land %/study.yaml -o %/study.yaml",
                                           "rig nose-drop %/study.yaml -o %/study.yaml",
                                           "calibrate %/study.yaml %/none.yaml -o %/study.yaml",
                                           "calibrate %/study.yaml %/none.yaml -o %/link.yaml"};
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; ++i) {
        assert_int_equal(bolter(f, commands[i]), 2);
        assert_has(f->err, "would be lost");
    }
    // the study directory keeps a study.yaml of its own, unless the study is that file
    assert_int_equal(bolter(f, "campaign %/study.yaml -o % --set campaign.samples=1"), 0);
    char* after = read_text(f, "study.yaml");
    assert_string_equal(after, study);
    free(after);
    free(study);
}

/// Files that are included, that --set reads, or that are a user's own.
static void no_file_of_the_users_is_replaced(void** state) {
    fixture* f = *state;
    assert_int_equal(system_in(f, "cp studies/reference/*.yaml %; ln -s deck.yaml %/deck.h5; "
                                  "cp studies/reference/study.yaml %/mine.yaml; "
                                  "echo 'landing.pitch: 4 deg' >%/set.yaml; echo mine >%/own.h5; "
                                  "(cd % && md5sum *.yaml own.h5 >sums)"),
                     0);
    static const struct {
        const char* command;
        int code;
    } rows[] = {
        {"calibrate %/study.yaml %/calibration.yaml -o %/aircraft.yaml", 2},
        {"land %/study.yaml -o %/deck.h5", 2},
        {"calibrate %/study.yaml %/calibration.yaml --set @%/set.yaml -o %/set.yaml", 2},
        {"land %/study.yaml -o %/own.h5", 5},
        {"campaign %/mine.yaml -o % --set campaign.samples=1", 5},
        {"land %/study.yaml -o %/deck.yaml", 2},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        if (bolter(f, rows[i].command) != rows[i].code)
            fail_msg("%s: not %d\n%s", rows[i].command, rows[i].code, f->err);
        assert_true(f->err[0] != '\0');
    }
    assert_int_equal(system_in(f, "cd % && md5sum --quiet -c sums"), 0);
    // a file that Bolter wrote is replaced
    assert_int_equal(bolter(f, "land %/study.yaml -o %/mine.h5"), 0);
    assert_int_equal(bolter(f, "land %/study.yaml -o %/mine.h5"), 0);
}

static void output_is_by_suffix_in_every_verb(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "land " REFERENCE " -o %/l.vtp"), 2);
    assert_has(f->err, "FILE.h5 (time histories), FILE.csv (table or histories), FILE.html "
                       "(page for a browser), FILE.pvd (for ParaView), a directory");
    assert_false(exists(f, "l.vtp"));
    assert_int_equal(bolter(f, "rig nose-drop " REFERENCE " -o %/out.pvd"), 2);
    assert_false(exists(f, "out.pvd"));
    assert_int_equal(bolter(f, "campaign " REFERENCE " -o %/out.h5"), 2);
    assert_int_equal(bolter(f, "land " REFERENCE " -o %/histories.csv"), 0);
    assert_int_equal(bolter(f, "land " REFERENCE " -o %/ref"), 0);
    assert_true(exists(f, "ref/landing.h5"));
}

static void quiet_keeps_results(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "land " REFERENCE " -q"), 0);
    assert_has(f->out, "margin");
    assert_int_equal(bolter(f, "check " REFERENCE " -q"), 0);
    assert_has(f->out, "stable step");
}

static void keys_of_a_part_and_for_programs(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "keys aircraft.hook.profile"), 0);
    assert_has(f->out, "aircraft.hook.profile.head_angle");
    assert_null(strstr(f->out, "aircraft.hook.length"));
    assert_int_equal(bolter(f, "keys landing.pitch --json"), 0);
    assert_has(f->out, "\"key\": \"landing.pitch\"");
    assert_has(f->out, "\"unit\": \"rad\"");
    assert_int_equal(bolter(f, "keys --json"), 0);
    assert_has(f->out, "\"key\": \"rigs.nose_drop.sink_speed\"");
    assert_int_equal(bolter(f, "keys landing.pich"), 2);
    assert_has(f->err, "did you mean \"landing.pitch\"?");
}

static void a_byte_order_mark_in_a_set_file_is_skipped(void** state) {
    fixture* f = *state;
    write_file(f, "set.txt", "\xef\xbb\xbflanding.pitch: 4 deg\r\n");
    assert_int_equal(bolter(f, "check " REFERENCE " --set @%/set.txt"), 0);
}

static void a_file_of_rigs_says_what_it_is(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "land studies/rigs/tr1154.yaml"), 3);
    assert_has(f->err, "describes tests on rigs and no landing");
    assert_has(f->err, "bolter rig studies/rigs/tr1154.yaml");
    int lines = 0;
    for (const char* c = f->err; *c; ++c)
        lines += *c == '\n';
    assert_int_equal(lines, 1);
    assert_int_equal(bolter(f, "rig studies/rigs/currey.yaml -o %/results"), 0);
    assert_has(f->out, "nose_static: Static curve");
    assert_int_equal(bolter(f, "rig " REFERENCE), 2);
    assert_has(f->err, "say which");
    assert_int_equal(bolter(f, "rig nose-drop"), 2);
    assert_has(f->err, "STUDY.yaml expected");
}

static void an_o_that_a_verb_cannot_write_is_refused(void** state) {
    fixture* f = *state;
    static const char* const commands[] = {"keys -o %/x", "noise " REFERENCE " -o %/x",
                                           "sensitivity " REFERENCE " -o %/x.h5"};
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; ++i)
        assert_int_equal(bolter(f, commands[i]), 2);
}

static void check_accepts_the_reference_and_prints_stable_steps(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "check " REFERENCE), 0);
    assert_has(f->out, "deck.cable");
    assert_has(f->out, "aircraft.main_gear.oleo");
    assert_string_equal(f->err, "");
    assert_int_equal(bolter(f, "check " REFERENCE " --json"), 0);
    assert_has(f->out, "\"stable_s\"");
    assert_int_equal(bolter(f, "check " REFERENCE " -o %/steps.csv"), 0);
    char* table = read_text(f, "steps.csv");
    assert_has(table, "element,setting,stable_s,used_s\n");
    free(table);
}

static void a_step_above_the_stable_one_is_refused_with_the_step_that_would_do(void** state) {
    fixture* f = *state;
    static const char* const verbs[] = {"check ", "land "};
    for (int k = 0; k < 2; ++k) {
        char line[256];
        snprintf(line, sizeof line,
                 "%s" REFERENCE " --set landing.solver.airframe_step='5 ms'"
                 " --set landing.solver.contact_step='1 ms'",
                 verbs[k]);
        assert_int_equal(bolter(f, line), 3);
        assert_has(f->err, "error: landing.solver.contact_step: 1000 us is above the stable step "
                           "of aircraft.hook.deck_contact; at most");
        assert_has(f->err, "error: landing.solver.airframe_step: 5000 us is above the stable step "
                           "of aircraft.nose_gear.oleo; at most");
    }
}

static void a_mesh_too_fine_for_the_memory_of_a_landing_is_refused(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "check " REFERENCE " --set deck.cable.mesh.fine_length='5 mm'"), 3);
    assert_has(f->err, "error: deck.cable.mesh: gives");
    assert_has(f->err, "a landing has room for 1000; segments");
}

static void check_says_what_passes_beside_the_wire(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "check " REFERENCE " --set deck.cable.span='20 m'"
                               " --set landing.off_centre='12 m'"),
                     0);
    assert_has(f->err, "warning: landing.off_centre: at 12 m the hook passes 2.06 m beyond the end "
                       "of the wire (deck.cable.span 20 m); at most 9.94 m off the centre, or a "
                       "span of 24.12 m, would do");
    assert_int_equal(bolter(f, "check " REFERENCE " --set deck.cable.span='20 m'"
                               " --set landing.off_centre='-8 m'"),
                     0);
    assert_has(f->err, "landing.off_centre: at -8 m a main wheel passes");
    assert_int_equal(bolter(f, "check " REFERENCE " --set deck.cable.span='20 m'"
                               " --set landing.off_centre='-7 m'"),
                     0);
    assert_string_equal(f->err, "");
}

/// Replaces the first line that begins with `key` by another.
static char* with_line(char* text, const char* key, const char* line) {
    char* at = strstr(text, key);
    assert_non_null(at);
    char* spoilt = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&spoilt, &size);
    fprintf(out, "%.*s%s%s", (int)(at - text), text, line, at + 1 + strcspn(at + 1, "\n"));
    fclose(out);
    free(text);
    return spoilt;
}

static void check_reports_five_mistakes_with_their_places(void** state) {
    fixture* f = *state;
    char* text = NULL;
    assert_int_equal(bt_file_read(REFERENCE, &text, NULL, NULL), BT_OK);
    text = with_line(text, "\n  sink_speed:", "\n  sink_speed: 3.6 kg");
    text = with_line(text, "\n  horizontal_speed:", "\n  horizontal_sped: 47.5 m/s");
    text = with_line(text, "\n  pitch:", "\n  pitch: 3");
    text = with_line(text, "\n  distance:", "\n  distance: nan m");
    text = with_line(text, "\n  samples:", "\n  samples: 20.5");
    write_file(f, "study.yaml", text);
    free(text);
    char command[9000];
    snprintf(command, sizeof command, "cp studies/reference/[ad]*.yaml '%s'", f->directory);
    assert_int_equal(system(command), 0);

    assert_int_equal(bolter(f, "check %/study.yaml"), 3);
    int errors = 0;
    for (const char* at = f->err; (at = strstr(at, ": error: ")); ++at)
        ++errors;
    assert_true(errors >= 5);
    static const char* const parts[] = {
        "study.yaml:",   "landing.sink_speed", "horizontal_sped",  "did you mean",
        "landing.pitch", "landing.distance",   "campaign.samples", "nothing was run"};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i)
        assert_has(f->err, parts[i]);
    assert_string_equal(f->out, "");
}

static void a_file_that_is_not_there_is_exit_code_5(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "check %/none.yaml"), 5);
    assert_has(f->err, "none.yaml");
}

static void land_prints_the_promised_keys_and_nothing_else(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "land " REFERENCE " --json"), 0);
    assert_string_equal(f->err, "");
    assert_true(f->out[0] == '{');
    static const char* const keys[] = {"outcome",
                                       "mode",
                                       "margin_m",
                                       "throat_force_peak_N",
                                       "time_of_contact_s",
                                       "bounces",
                                       "height_m",
                                       "distance_m",
                                       "impact_force_N",
                                       "hook_deck_force_peak_N",
                                       "strut_stroke_max_m",
                                       "tyre_force_max_N",
                                       "nose",
                                       "left",
                                       "right",
                                       "steps",
                                       "wall_s"};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; ++i) {
        char quoted[64];
        snprintf(quoted, sizeof quoted, "\"%s\": ", keys[i]);
        assert_has(f->out, quoted);
    }
}

static void land_writes_time_histories_in_hdf5(void** state) {
    fixture* f = *state;
    char path[4096];
    assert_int_equal(bolter(f, "land " REFERENCE " --quiet -o %/one.h5"), 0);
    char* data = NULL;
    assert_int_equal(bt_file_read(toy_path(path, f->directory, "one.h5"), &data, NULL, NULL),
                     BT_OK);
    assert_memory_equal(data, "\x89HDF\r\n\x1a\n", 8);
    free(data);
    assert_int_equal(bolter(f, "land " REFERENCE " --quiet -o %/none/one.h5"), 5);
    assert_has(f->err, "cannot write: ");
}

static void a_full_standard_output_is_exit_code_5(void** state) {
    fixture* f = *state;
    const char* program = getenv("BOLTER");
    char command[8192];
    snprintf(command, sizeof command, "'%s' keys >/dev/full 2>'%s/err'",
             program ? program : "build/bolter", f->directory);
    const int code = system(command);
    assert_int_equal(WEXITSTATUS(code), 5);
}

static void the_whole_chain_at_small_size(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "study " REFERENCE " " SMALL "-o %/small"), 0);
    assert_has(f->out, "hold-out");
    assert_has(f->out, "landing.sink_speed");
    assert_has(f->out, "landing.distance");
    char* first = strdup(f->out);

    /* nothing is left to do: the same text at once */
    assert_int_equal(bolter(f, "study " REFERENCE " " SMALL "-o %/small"), 0);
    assert_string_equal(f->out, first);
    free(first);

    assert_int_equal(bolter(f, "campaign status " REFERENCE " " SMALL "-o %/small --json"), 0);
    BT_ASSERT_NEAR(json_number(f->out, "done"), 96, 0, 0);
    BT_ASSERT_NEAR(json_number(f->out, "failed"), 0, 0, 0);
    assert_int_equal(bolter(f, "fit " REFERENCE " " SMALL "-o %/small --json"), 0);
    assert_true(json_number(f->out, "holdout_accuracy") > 0.5);
    assert_true(json_number(f->out, "holdout_n") > 10);
    assert_int_equal(bolter(f, "replay " REFERENCE " 5 " SMALL "-o %/small"), 0);
    assert_has(f->out, "the same to the bit");
    assert_has(f->out, "landing.pitch = ");
    assert_has(f->out, " deg\n"); // the unit of the study
    assert_int_equal(bolter(f, "replay " REFERENCE " 500 " SMALL "-o %/small"), 2);
    assert_int_equal(bolter(f, "replay " REFERENCE " --missed " SMALL "-o %/small --json"), 0);
    assert_has(f->out, "\"outcome\": \"missed\"");
    assert_int_equal(
        bolter(f, "replay " REFERENCE " --nearest 'landing.pitch=8 deg' " SMALL "-o %/small"), 0);
    // as near as the landings of the condition with 8 deg come
    assert_true(strstr(f->out, "landing.pitch = 7.") || strstr(f->out, "landing.pitch = 8."));
    assert_int_equal(bolter(f, "replay " REFERENCE " " SMALL "-o %/small"), 2);
    assert_int_equal(
        bolter(f, "replay " REFERENCE " --nearest 'landing.roll=1 deg' " SMALL "-o %/small"), 2);
    assert_has(f->err, "is no axis of the campaign");

    assert_int_equal(bolter(f, "reliability " REFERENCE " " SMALL "-o %/small --json"), 0);
    int conditions = 0;
    for (const char* at = f->out; (at = strstr(at, "\"parameter\": ")); ++at)
        ++conditions;
    assert_int_equal(conditions, 24);
    static const char* const keys[] = {"value",
                                       "surrogate",
                                       "surrogate_ci95",
                                       "corrected",
                                       "corrected_ci95",
                                       "samples",
                                       "high_fidelity_runs",
                                       "disagreements",
                                       "reweighted",
                                       "corrected_unseen",
                                       "effective_landings",
                                       "differences",
                                       "classifier",
                                       "holdout_n",
                                       "warnings"};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; ++i)
        assert_has(f->out, keys[i]);
    char* stored = read_text(f, "small/reliability.json");
    assert_string_equal(f->out, stored);
    free(stored);

    assert_int_equal(bolter(f, "reliability " REFERENCE " " SMALL "-o %/small --indices --json"),
                     0);
    double alone = 0, together = 0;
    int inputs = 0;
    for (const char* at = f->out; (at = strstr(at, "\"path\": ")); ++at, ++inputs) {
        alone += json_number(at, "first");
        together += json_number(at, "total");
    }
    assert_int_equal(inputs, 4);
    // shares alone add up to 1 at most, totals to 1 at least; 20,000 rows know them to some 0.02
    assert_true(alone < 1.05 && together > 0.95);
    assert_int_equal(bolter(f, "reliability " REFERENCE " " SMALL "-o %/small --indices"), 0);
    assert_has(f->out, "with all its interactions");
}

static void another_study_in_the_same_directory_is_refused(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "campaign " REFERENCE " " SMALL "--set campaign.samples=2 -o %/a"),
                     0);
    assert_int_equal(bolter(f, "campaign " REFERENCE " " SMALL
                               "--set campaign.samples=2 --set aircraft.mass='20000 kg' -o %/a"),
                     5);
    assert_has(f->err, "aircraft.mass = ");
    assert_has(f->err, "-o");
}

static void a_directory_that_is_a_file_is_exit_code_5(void** state) {
    fixture* f = *state;
    write_file(f, "file", "");
    assert_int_equal(bolter(f, "campaign " REFERENCE " " SMALL "-o %/file/study"), 5);
    assert_has(f->err, "cannot make the study directory");
}

static void an_unknown_campaign_says_to_run_it_first(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "fit " REFERENCE " -o %/none"), 5);
    assert_has(f->err, "run the campaign first");
    assert_int_equal(bolter(f, "campaign status " REFERENCE " -o %/none"), 5);
}

/// A second process on the same study directory is sent away; SIGINT ends the first with exit code
/// 130 and keeps what was finished.
static void a_second_process_is_kept_out_and_an_interrupt_loses_nothing(void** state) {
    fixture* f = *state;
    setenv("STUDY", REFERENCE " --set campaign.samples=3000 -q -o", 1);
    assert_int_equal(bolter(f, "campaign $STUDY % & sleep 1.5; "
                               "\"$BOLTER\" campaign $STUDY % 2>%/second; echo $? >>%/second; "
                               "kill -INT $!; wait $!"),
                     130);
    char* second = read_text(f, "second");
    assert_has(second, "another bolter (process ");
    assert_has(second, "\n5\n");
    free(second);
    assert_int_equal(bolter(f, "campaign status $STUDY % --json"), 0);
    const double done = json_number(f->out, "done");
    assert_true(done >= 1 && done < 3000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(help_and_version_are_no_errors),
        TEST(wrong_use_is_exit_code_2),
        TEST(the_defaults_are_a_study_that_can_be_run),
        TEST(what_a_command_reads_is_never_written_over),
        TEST(an_o_that_a_verb_cannot_write_is_refused),
        TEST(no_file_of_the_users_is_replaced),
        TEST(output_is_by_suffix_in_every_verb),
        TEST(quiet_keeps_results),
        TEST(keys_of_a_part_and_for_programs),
        TEST(a_byte_order_mark_in_a_set_file_is_skipped),
        TEST(a_file_of_rigs_says_what_it_is),
        TEST(check_accepts_the_reference_and_prints_stable_steps),
        TEST(a_mesh_too_fine_for_the_memory_of_a_landing_is_refused),
        TEST(a_step_above_the_stable_one_is_refused_with_the_step_that_would_do),
        TEST(check_says_what_passes_beside_the_wire),
        TEST(check_reports_five_mistakes_with_their_places),
        TEST(a_file_that_is_not_there_is_exit_code_5),
        TEST(land_prints_the_promised_keys_and_nothing_else),
        TEST(land_writes_time_histories_in_hdf5),
        TEST(a_full_standard_output_is_exit_code_5),
        TEST(the_whole_chain_at_small_size),
        TEST(another_study_in_the_same_directory_is_refused),
        TEST(a_directory_that_is_a_file_is_exit_code_5),
        TEST(an_unknown_campaign_says_to_run_it_first),
        TEST(a_second_process_is_kept_out_and_an_interrupt_loses_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
