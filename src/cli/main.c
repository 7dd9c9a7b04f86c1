#include "cli/cli.h"
#include "cli/version.h"

#include "base/arithmetic.h"
#include "study/reader.h"

#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

static const bt_verb* const verbs[] = {
    &bt_verb_check,     &bt_verb_keys,     &bt_verb_land,        &bt_verb_rig, &bt_verb_sweep,
    &bt_verb_calibrate, &bt_verb_campaign, &bt_verb_replay,      &bt_verb_fit, &bt_verb_reliability,
    &bt_verb_study,     &bt_verb_noise,    &bt_verb_sensitivity,
};
enum { VERB_COUNT = sizeof verbs / sizeof verbs[0] };

atomic_int bt_interrupted;

static void interrupt(int signal_number) {
    (void)signal_number;
    atomic_store(&bt_interrupted, 1);
}

/// SIGINT and SIGTERM ask to stop; a second one ends the program at once. A file that grows too
/// large is an error to report, not a reason to die.
static void catch_signals(void) {
    struct sigaction action = {.sa_handler = interrupt, .sa_flags = (int)SA_RESETHAND | SA_RESTART};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    signal(SIGXFSZ, SIG_IGN);
}

static void print_help(FILE* out) {
    fprintf(out,
            "Usage: bolter VERB [FILE.yaml] [--set PATH=VALUE]... [--json] [--quiet] [-o PATH]\n"
            "\n"
            "Bolter simulates carrier landings and says with what probability the hook catches\n"
            "the wire. A study file describes the aircraft, the deck and how landings scatter;\n"
            "studies/reference/study.yaml is one to start from.\n"
            "\n"
            "Verbs:\n");
    for (int i = 0; i < VERB_COUNT; ++i)
        fprintf(out, "  %-12s %s\n", verbs[i]->name, verbs[i]->summary);
    fprintf(out, "\n"
                 "  bolter VERB --help           what a verb does and takes\n"
                 "  bolter --version             [--verbose: compiler, libraries, processor]\n"
                 "\n"
                 "Exit codes: 0 done, 1 internal error, 2 wrong use, 3 input rejected, 4 too many\n"
                 "runs failed, 5 file error, 130 interrupted (what was finished is kept).\n");
}

static const bt_verb* find_verb(const char* name) {
    for (int i = 0; i < VERB_COUNT; ++i)
        if (strcmp(verbs[i]->name, name) == 0)
            return verbs[i];
    return NULL;
}

static int refuse_verb(const char* name) {
    const char* nearest = NULL;
    int distance = INT_MAX;
    char hint[64];
    for (int i = 0; i < VERB_COUNT; ++i)
        bt_reader_nearest(name, verbs[i]->name, &nearest, &distance);
    bt_reader_suggest(name, nearest, distance, hint, sizeof hint);
    fprintf(stderr, "bolter: unknown verb \"%s\"%s See bolter --help\n", name, *hint ? hint : ".");
    return bt_exit_code(BT_ERR_ARG);
}

static bool is_any(const char* word, const char* a, const char* b) {
    return strcmp(word, a) == 0 || strcmp(word, b) == 0;
}

static int run_verb(const bt_verb* verb, int argc, char** argv) {
    bt_command command;
    bt_command_parse(verb, argc, argv, &command);
    const char* fault = bt_arithmetic_fault();
    if (fault) {
        fprintf(stderr, "bolter: %s\n", fault);
        return bt_exit_code(BT_ERR_INTERNAL);
    }
    catch_signals();
    bt_status status = verb->run(&command);
    if (status == BT_ERR_MEMORY || status == BT_ERR_INTERNAL || status == BT_ERR_NUMERIC)
        fprintf(stderr, "bolter %s: %s\n", verb->name, bt_status_text(status));
    return bt_exit_code(status);
}

int main(int argc, char** argv) {
    int code = 0;
    if (argc < 2) {
        print_help(stderr);
        code = bt_exit_code(BT_ERR_ARG);
    } else if (is_any(argv[1], "--help", "-h") || strcmp(argv[1], "help") == 0)
        print_help(stdout);
    else if (is_any(argv[1], "--version", "-V"))
        bt_version_print(stdout, argc > 2 && is_any(argv[2], "--verbose", "-v"));
    else {
        const bt_verb* verb = find_verb(argv[1]);
        code = verb ? run_verb(verb, argc - 1, argv + 1) : refuse_verb(argv[1]);
    }
    if (fflush(stdout) != 0 || ferror(stdout)) {
        fprintf(stderr, "bolter: standard output cannot be written\n");
        code = bt_exit_code(BT_ERR_IO);
    }
    return code;
}
