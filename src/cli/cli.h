/// The command line: what the verbs share. Each verb is one file and one row of the table in
/// main.c; a verb returns a status, and the status is the exit code.
#ifndef BT_CLI_CLI_H
#define BT_CLI_CLI_H

#include "report/json.h"
#include "study/study.h"

#include <argp.h>
#include <stdatomic.h>

enum { BT_SETS_MAX = 64, BT_WORDS_MAX = 256, BT_OWN_OPTIONS_MAX = 8 };

/// Keys of a verb's own options: BT_OPTION + 0, + 1, ...
enum { BT_OPTION = 0x1000 };

/// A command as typed.
typedef struct bt_command {
    const struct bt_verb* verb;
    int word_count;
    const char* words[BT_WORDS_MAX]; ///< what is no option: the file first
    int set_count;
    const char* sets[BT_SETS_MAX];
    char overlay[16384]; ///< texts of `sets` that were read from files
    size_t overlay_used;
    int set_file_count;
    const char* set_files[BT_SETS_MAX]; ///< files of --set @FILE
    const char* example;                ///< --example; NULL when not given
    char example_file[4096];            ///< the study that it names
    bool json, quiet;
    const char* output;                     ///< -o; NULL when not given
    const char* option[BT_OWN_OPTIONS_MAX]; ///< own options: argument, "" for a flag, or NULL
} bt_command;

typedef struct bt_verb {
    const char* name;
    const char* summary;               ///< one line, for `bolter --help`
    const char* arguments;             ///< "STUDY.yaml"
    const char* text;                  ///< what `bolter VERB --help` says
    const struct argp_option* options; ///< own options, or NULL
    int least_words, most_words;
    int outputs; ///< what -o may name: BT_OUTPUT_... (output.h); 0: nothing is written
    bt_status (*run)(const bt_command* command);
} bt_verb;

extern const bt_verb bt_verb_check, bt_verb_keys, bt_verb_land, bt_verb_campaign, bt_verb_replay,
    bt_verb_fit, bt_verb_reliability, bt_verb_study, bt_verb_sweep, bt_verb_calibrate, bt_verb_rig,
    bt_verb_noise, bt_verb_sensitivity, bt_verb_report, bt_verb_figures, bt_verb_paper,
    bt_verb_atlas, bt_verb_why, bt_verb_compare, bt_verb_pack, bt_verb_verify;

/// Writes the report page of a study that was read from the command's file.
BT_CHECKED bt_status bt_command_report(const bt_command* command, const bt_study* study,
                                       const char* path);

/// Reads the words after the verb. On a mistake says so and ends the program with exit code 2.
void bt_command_parse(const bt_verb* verb, int argc, char** argv, bt_command* command);

/// Exit code of a status.
enum { BT_EXIT_INTERRUPTED = 130 };
int bt_exit_code(bt_status status);

/// A sink that prints to stderr as "file:line:column: error: text".
bt_diag bt_stderr_diag(void);

/// Whether an error was printed by such a sink, by bt_usage_error or by bt_say_error: a verb that
/// fails without a word is given the text of its status.
bool bt_error_was_said(void);
/// "bolter VERB: text" on stderr.
void bt_say_error(const bt_command* command, const char* format, ...)
    __attribute__((format(printf, 2, 3)));

/// Reads the study of a command (first word, --set, -o); says everything that is wrong with it, or
/// in one line that it describes rigs and no landing. BT_OK: the caller owns it (bt_study_destroy).
BT_CHECKED bt_status bt_command_study(const bt_command* command, bt_study* study);

/// The same for what needs no landing: bt_study_read_rigs.
BT_CHECKED bt_status bt_command_rigs(const bt_command* command, bt_study* study);

/// Reports a wrong use of a verb and returns BT_ERR_ARG.
bt_status bt_usage_error(const bt_command* command, const char* format, ...)
    __attribute__((format(printf, 2, 3)));

/// A whole number of an option; false (said on stderr) when it is not one from `least` on.
bool bt_whole_number(const bt_command* command, const char* name, const char* text, int64_t least,
                     int64_t* value);

/// Not 0 once the user asked to stop (SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU).
extern atomic_int bt_interrupted;

/// Seconds after such a signal until the program ends as it is. Work whose results are kept sets
/// it higher: it ends well within a second, but a slow disk may want longer for the last of them.
extern atomic_int bt_grace_s;

/// Asks the program to end in order after a time ("50 min"), as SIGUSR1 would. NULL: no limit.
/// BT_ERR_ARG, said on stderr.
BT_CHECKED bt_status bt_time_limit(const bt_command* command, const char* text);

/// The line that long work shows: rewritten on a terminal, one a minute elsewhere, none if quiet.
typedef struct bt_progress {
    const char* name;
    bool quiet, terminal;
    double shown_s; ///< when the last line was written
} bt_progress;

bt_progress bt_progress_start(const char* name, bool quiet);
/// Shows a line if it is due. `last` shows it in any case and ends it.
void bt_progress_show(bt_progress* progress, bool last, const char* format, ...)
    __attribute__((format(printf, 3, 4)));

/// "3 s", "4 min 10 s", "2 h 05 min"
void bt_duration_text(double seconds, char* text, size_t size);

#endif
