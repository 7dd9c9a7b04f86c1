#include "pipeline/verify.h"

#include "campaign/capsule.h"
#include "cli/cli.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { DEFAULT_COUNT = 20 };

static void print_result(const bt_verification* v, const char* file) {
    printf("%lld of %lld landings of %s the same to the bit (%lld in the ledger)\n",
           (long long)v->same, (long long)v->repeated, file, (long long)v->runs);
    printf("made by     %s\nrepeated by %s\n", v->made_by, v->here);
}

static void json_result(const bt_verification* v) {
    bt_json json = {.out = stdout};
    bt_json_begin_object(&json, NULL);
    bt_json_integer(&json, "runs", v->runs);
    bt_json_integer(&json, "repeated", v->repeated);
    bt_json_integer(&json, "same", v->same);
    bt_json_integer(&json, "other_outcome", v->other_outcome);
    bt_json_number(&json, "margin_change_m", v->margin_change_m);
    bt_json_string(&json, "made_by", v->made_by);
    bt_json_string(&json, "repeated_by", v->here);
    bt_json_end_object(&json);
}

static bt_status say_different(const bt_command* command, const bt_verification* v) {
    const char* why = strcmp(v->made_by, v->here) != 0
                          ? "another version or instruction set computes other last bits"
                          : "version and instruction set are the same: another compiler or C "
                            "library, a changed file, or a processor at fault";
    bt_say_error(command,
                 "%lld landings differ, run %lld the first; %lld have another outcome, margins "
                 "differ by %.3g mm at most (%s)",
                 (long long)(v->repeated - v->same), (long long)v->first_other,
                 (long long)v->other_outcome, 1e3 * v->margin_change_m, why);
    return BT_ERR_INTERNAL;
}

static bt_status verify(const bt_command* command, const bt_study* study, int64_t count) {
    bt_ledger* ledger = NULL;
    bt_diag diag = bt_stderr_diag();
    bt_verification v;
    BT_TRY(bt_ledger_open(command->words[0], study, BT_LEDGER_READ, &ledger, &diag));
    const bt_status status = bt_ledger_verify(study, ledger, count, &bt_interrupted, &v, &diag);
    bt_ledger_close(ledger);
    if (status != BT_OK)
        return status;
    if (command->json)
        json_result(&v);
    else
        print_result(&v, command->words[0]);
    return v.same == v.repeated ? BT_OK : say_different(command, &v);
}

static bt_status run_verify(const bt_command* command) {
    int64_t count = DEFAULT_COUNT;
    size_t size = 0;
    char* text = NULL;
    bt_study study;
    bt_diag diag = bt_stderr_diag();
    if (command->set_count > 0 || command->set_file_count > 0)
        return bt_usage_error(command, "a capsule is verified as it is: no --set");
    if (command->word_count > 1 && !bt_whole_number(command, "N", command->words[1], 1, &count))
        return BT_ERR_ARG;
    BT_TRY(bt_capsule_read(command->words[0], "study.yaml", &text, &size, &diag));
    bt_status status = bt_study_read_text(command->words[0], text, size, NULL, 0, &study, &diag);
    free(text);
    if (status != BT_OK)
        return status;
    status = verify(command, &study, count);
    bt_study_destroy(&study);
    return status;
}

const bt_verb bt_verb_verify = {
    .name = "verify",
    .summary = "repeat landings of a packed study to the bit",
    .arguments = "FILE.bolter [N]",
    .text = "Computes N landings (20) of a file that bolter pack wrote again, spread evenly over "
            "it, and compares their final states with those recorded. On a machine with the same "
            "instruction set and version they are the same to the bit; otherwise it says what "
            "made the file, what this program is, and how far outcomes and margins differ, with "
            "exit code 1.",
    .least_words = 1,
    .most_words = 2,
    .run = run_verify,
};
