#include "cli/example.h"
#include "cli/output.h"
#include "cli/overlay.h"

#include "base/units.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct argp_option common_options[] = {
    {"set", 's', "PATH=VALUE", 0,
     "change one key of the study, for example --set landing.pitch='4 deg'; @FILE reads lines "
     "PATH: VALUE; may be repeated",
     10},
    {"example", 'e', "NAME", 0,
     "a study that comes with the program, in the place of STUDY.yaml: reference, rigs/currey, "
     "...; "
     "its results go into a directory NAME here",
     10},
    {"output", 'o', "PATH", 0,
     "where results go, by suffix: FILE.h5 time histories, FILE.csv the table, FILE.html a page, "
     "FILE.pvd for ParaView, "
     "else a directory "
     "(default: one named after the study)",
     10},
    {"json", 'j', 0, 0, "print one JSON object on standard output and nothing else", 10},
    {"quiet", 'q', 0, 0, "no progress, no remarks; results and errors are still printed", 10},
    {0},
};

/// The ways to use a verb stand one per line in its row.
static void refuse_too_few(struct argp_state* state, const bt_verb* verb) {
    char wanted[512];
    snprintf(wanted, sizeof wanted, "%s", verb->arguments);
    for (char* c = wanted; *c; ++c)
        if (*c == '\n')
            *c = '|';
    argp_error(state, "%s expected", wanted);
}

static error_t parse_option(int key, char* argument, struct argp_state* state) {
    bt_command* command = state->input;
    switch (key) {
    case 's':
        if (*argument == '@') {
            if (command->set_file_count < BT_SETS_MAX)
                command->set_files[command->set_file_count++] = argument + 1;
            const bt_status status = bt_overlay_read(command, argument + 1);
            if (status != BT_OK)
                exit(bt_exit_code(status));
            return 0;
        }
        if (command->set_count == BT_SETS_MAX)
            argp_error(state, "more than %d --set", BT_SETS_MAX);
        command->sets[command->set_count++] = argument;
        return 0;
    case 'e':
        command->example = argument;
        return 0;
    case 'o':
        command->output = argument;
        return 0;
    case 'j':
        command->json = true;
        return 0;
    case 'q':
        command->quiet = true;
        return 0;
    case ARGP_KEY_ARG:
        if (command->word_count == command->verb->most_words)
            argp_error(state, "\"%s\" is one argument too many", argument);
        command->words[command->word_count++] = argument;
        return 0;
    case ARGP_KEY_END:
        if (command->example && !bt_example_take(command))
            exit(bt_exit_code(BT_ERR_ARG));
        if (command->word_count < command->verb->least_words)
            refuse_too_few(state, command->verb);
        return 0;
    default:
        if (key < BT_OPTION || key >= BT_OPTION + BT_OWN_OPTIONS_MAX)
            return ARGP_ERR_UNKNOWN;
        command->option[key - BT_OPTION] = argument ? argument : "";
        return 0;
    }
}

void bt_command_parse(const bt_verb* verb, int argc, char** argv, bt_command* command) {
    *command = (bt_command){.verb = verb};
    struct argp_option options[BT_OWN_OPTIONS_MAX + 8] = {{0}};
    int count = 0;
    for (const struct argp_option* o = verb->options; o && o->name; ++o)
        options[count++] = *o;
    memcpy(options + count, common_options, sizeof common_options);

    char name[64], text[4096];
    snprintf(name, sizeof name, "bolter %s", verb->name);
    snprintf(text, sizeof text, "%s.\v%s", verb->summary, verb->text);
    argv[0] = name;
    argp_err_exit_status = bt_exit_code(BT_ERR_ARG);
    const struct argp argp = {options, parse_option, verb->arguments, text, NULL, NULL, NULL};
    if (argp_parse(&argp, argc, argv, 0, NULL, command) != 0)
        exit(bt_exit_code(BT_ERR_ARG));
    argv[0] = NULL;
}

int bt_exit_code(bt_status status) {
    switch (status) {
    case BT_OK:
        return 0;
    case BT_ERR_ARG:
        return 2;
    case BT_ERR_INPUT:
        return 3;
    case BT_ERR_FAILED_RUNS:
        return 4;
    case BT_ERR_IO:
        return 5;
    case BT_ERR_INTERRUPTED:
        return BT_EXIT_INTERRUPTED;
    default:
        return 1;
    }
}

static bool error_said;

bool bt_error_was_said(void) {
    return error_said;
}

static void say(const bt_command* command, const char* format, va_list args) {
    error_said = true;
    fprintf(stderr, "bolter %s: ", command->verb->name);
    vfprintf(stderr, format, args);
    fputc('\n', stderr);
}

void bt_say_error(const bt_command* command, const char* format, ...) {
    va_list args;
    va_start(args, format);
    say(command, format, args);
    va_end(args);
}

static void print_message(void* user, bt_severity severity, bt_where where, const char* text) {
    char line[2048];
    (void)user;
    error_said = error_said || severity == BT_ERROR;
    bt_diag_format(line, sizeof line, severity, where, text);
    fprintf(stderr, "%s\n", line);
}

bt_diag bt_stderr_diag(void) {
    return (bt_diag){.sink = print_message};
}

bt_status bt_command_rigs(const bt_command* command, bt_study* study) {
    bt_diag diag = bt_stderr_diag();
    const char* file = command->words[0];
    bt_status status = bt_study_read_rigs(file, command->sets, command->set_count, study, &diag);
    if (status != BT_OK) {
        fprintf(stderr, "%s: %d error%s, nothing was run\n", file, diag.errors,
                diag.errors == 1 ? "" : "s");
        return status;
    }
    status = bt_output_spare(command, study);
    if (status != BT_OK)
        bt_study_destroy(study);
    else if (bt_output_kind(command->output) == BT_OUTPUT_DIRECTORY)
        snprintf(study->directory, sizeof study->directory, "%s", command->output);
    else if (command->example)
        snprintf(study->directory, sizeof study->directory, "%s", command->example);
    return status;
}

bt_status bt_command_study(const bt_command* command, bt_study* study) {
    BT_TRY(bt_command_rigs(command, study));
    if (!study->rigs_only)
        return BT_OK;
    bt_diag diag = bt_stderr_diag();
    bt_diag_add(&diag, BT_ERROR, (bt_where){.file = command->words[0]},
                "describes tests on rigs and no landing: there is no `landing:' in it; run it with "
                "bolter rig %s",
                command->words[0]);
    bt_study_destroy(study);
    return BT_ERR_INPUT;
}

bt_status bt_usage_error(const bt_command* command, const char* format, ...) {
    va_list args;
    va_start(args, format);
    say(command, format, args);
    va_end(args);
    fprintf(stderr, "Try `bolter %s --help' for more information.\n", command->verb->name);
    return BT_ERR_ARG;
}

bool bt_whole_number(const bt_command* command, const char* name, const char* text, int64_t least,
                     int64_t* value) {
    double number = 0;
    if (bt_number_parse(text, &number) == BT_OK && number == floor(number) &&
        number >= (double)least && number <= 9e15) {
        *value = (int64_t)number;
        return true;
    }
    bt_usage_error(command, "%s: \"%s\" is not a whole number from %lld on", name, text,
                   (long long)least);
    return false;
}
