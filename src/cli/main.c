#include "cli/output.h"
#include "cli/version.h"

#include "base/arithmetic.h"
#include "base/text.h"
#include "cluster/cluster.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const bt_verb* const verbs[] = {
    &bt_verb_check,       &bt_verb_keys,        &bt_verb_land,     &bt_verb_rig,
    &bt_verb_sweep,       &bt_verb_calibrate,   &bt_verb_campaign, &bt_verb_replay,
    &bt_verb_fit,         &bt_verb_reliability, &bt_verb_study,    &bt_verb_noise,
    &bt_verb_sensitivity, &bt_verb_report,      &bt_verb_figures,  &bt_verb_paper,
    &bt_verb_atlas,       &bt_verb_why,         &bt_verb_compare,  &bt_verb_pack,
    &bt_verb_verify,
};
enum { VERB_COUNT = sizeof verbs / sizeof verbs[0] };

atomic_int bt_interrupted;
atomic_int bt_grace_s = 1;

static void interrupt(int signal_number) {
    (void)signal_number;
    if (atomic_exchange(&bt_interrupted, 1) == 0)
        alarm((unsigned)atomic_load(&bt_grace_s));
}

/// What has not come to its end after the grace has nothing to keep, or has kept it already
/// (the ledger and every file change in one step).
static void give_up(int signal_number) {
    static const char text[] = "bolter: interrupted\n";
    (void)signal_number;
    (void)!write(STDERR_FILENO, text, sizeof text - 1);
    _exit(BT_EXIT_INTERRUPTED);
}

/// Signals by which people, terminals and batch systems ask a program to end: an orderly end. A
/// second SIGINT or SIGTERM ends it at once. SIGHUP stays ignored under nohup. A file that
/// grows too large is an error to report, not a reason to die.
static void catch_signals(void) {
    static const struct {
        int number, flags;
    } asked[] = {{SIGINT, (int)SA_RESETHAND},
                 {SIGTERM, (int)SA_RESETHAND},
                 {SIGHUP, 0},
                 {SIGUSR1, 0},
                 {SIGXCPU, 0}};
    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; ++i) {
        struct sigaction action, before;
        memset(&action, 0, sizeof action);
        action.sa_handler = interrupt;
        action.sa_flags = asked[i].flags | SA_RESTART;
        sigaction(asked[i].number, NULL, &before);
        if (asked[i].number != SIGHUP || before.sa_handler != SIG_IGN)
            sigaction(asked[i].number, &action, NULL);
    }
    signal(SIGALRM, give_up);
    signal(SIGXFSZ, SIG_IGN);
}

/// A closed standard stream is opened again on nothing, so that no file of ours gets its number
/// and with it what is printed. Standard output stays unwritable, which is said at the end.
static void keep_streams(void) {
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF)
            (void)!open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
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
    bt_text_nearest nearest = bt_text_search(name);
    char hint[64];
    for (int i = 0; i < VERB_COUNT; ++i)
        bt_text_look(&nearest, verbs[i]->name);
    bt_text_suggest(&nearest, hint, sizeof hint);
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
    bt_status status = bt_output_check(&command, verb->outputs);
    if (status == BT_OK)
        status = verb->run(&command);
    if (status != BT_OK && !bt_error_was_said())
        fprintf(stderr, "bolter %s: %s\n", verb->name, bt_status_text(status));
    return bt_exit_code(status);
}

/// One of several ranks: rank 0 goes on as if it were alone, the others work for it and end.
/// Returns whether this process goes on; `code` receives how it ends when it does not.
static bool join_cluster(int* code) {
    bt_diag diag = bt_stderr_diag();
    bt_cluster_role role;
    const bt_status status = bt_cluster_start(&role, &diag);
    atexit(bt_cluster_end);
    *code = bt_exit_code(status);
    if (status == BT_OK && role == BT_CLUSTER_HELP)
        bt_cluster_serve();
    return status == BT_OK && role != BT_CLUSTER_HELP;
}

int main(int argc, char** argv) {
    int code = 0;
    keep_streams();
    if (!join_cluster(&code))
        return code;
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
