#include "cli/chain.h"
#include "cli/output.h"
#include "cli/recorder.h"
#include "pipeline/find_run.h"
#include "pipeline/verify.h"
#include "report/landing_report.h"

#include "base/units.h"

#include <inttypes.h>
#include <stdlib.h>

enum { OPTION_HISTORY, OPTION_MISSED, OPTION_NEAREST };

/// A run of the ledger, repeated: into the file, when there is one.
typedef struct repetition {
    bt_chain* chain;
    const bt_ledger_row* row;
    const char* file; ///< NULL: none
    bt_recorder recorder;
    bt_landing_result result;
    bt_model_params model; ///< as it landed
} repetition;

static bt_status repeat(repetition* r) {
    return bt_run_repeat(&r->chain->study, r->row, &bt_interrupted, &r->model, &r->result,
                         r->file ? bt_recorder_observe : NULL, &r->recorder);
}

static bt_status compare(const bt_ledger* ledger, const bt_ledger_row* row,
                         const bt_landing_result* result, bt_diag* diag) {
    if (bt_run_is_same(ledger, row, result))
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                "run %lld does not repeat to the bit: state %016" PRIx64 " now, %016" PRIx64
                " in the ledger. Was it computed by another version or on another processor?",
                (long long)row->run, result->state_hash, row->result.state_hash);
    return BT_ERR_INTERNAL;
}

/// In the unit in which the study gives this input.
static void print_input(const bt_input* input, double value) {
    char text[64];
    const char* unit = "";
    if (*input->typed)
        bt_unit_print_as(value, input->typed, text, sizeof text, &unit);
    else
        bt_unit_print(value, *input->field->unit ? input->field->unit : "1", text, sizeof text);
    printf("  %s = %s%s%s\n", input->path, text, *unit ? " " : "", unit);
}

static bt_status write(const repetition* r) {
    char name[64];
    snprintf(name, sizeof name, "landing %lld", (long long)r->row->run);
    const bt_page_landing_of of = {r->row->run, name, &r->model, &r->result};
    return r->file ? bt_recorder_write(&r->recorder, r->chain->command, &r->chain->study, r->file,
                                       &of, &r->chain->diag)
                   : BT_OK;
}

static void print(const repetition* r) {
    const bt_study* study = &r->chain->study;
    const bt_axes axes = bt_design_axes(study);
    if (r->chain->command->json) {
        bt_json json = {.out = stdout};
        bt_landing_write_json(&json, &r->result);
        return;
    }
    printf("run %lld, the same to the bit (state %016" PRIx64 ")\n", (long long)r->row->run,
           r->result.state_hash);
    for (int i = 0; i < axes.count; ++i)
        print_input(&study->inputs[axes.input[i]], r->row->x[i]);
    bt_landing_print(stdout, &r->result);
}

/// FILE of --history or of -o.
static const char* file_of(const bt_command* command) {
    const char* file = command->option[OPTION_HISTORY];
    if (file)
        return file;
    return bt_output_kind(command->output) == BT_OUTPUT_DIRECTORY ? NULL : command->output;
}

static bt_status replay(bt_chain* chain, const bt_ledger_row* row) {
    repetition* r = calloc(1, sizeof *r);
    if (!r)
        return BT_ERR_MEMORY;
    r->chain = chain;
    r->row = row;
    r->file = file_of(chain->command);
    bt_status status =
        r->file ? bt_recorder_start(r->file, false, &r->recorder, &chain->diag) : BT_OK;
    if (status == BT_OK)
        status = repeat(r);
    if (status == BT_OK)
        status = compare(chain->ledger, row, &r->result, &chain->diag);
    if (status == BT_OK)
        status = write(r);
    if (status == BT_OK)
        print(r);
    bt_recorder_end(&r->recorder);
    free(r);
    return status;
}

// --- which run ------------------------------------------------------------------------------

static bt_status find(bt_chain* chain, bt_ledger_row* row) {
    const bt_command* command = chain->command;
    const char* nearest = command->option[OPTION_NEAREST];
    bt_run_search search = {.axes = bt_design_axes(&chain->study),
                            .missed = command->option[OPTION_MISSED] != NULL};
    char why[512];
    bool found = false;
    if (nearest && bt_run_search_read(&chain->study, nearest, &search, why, sizeof why) != BT_OK)
        return bt_usage_error(command, "--nearest %s", why);
    BT_TRY(bt_run_find(&chain->study, chain->ledger, &search, row, &found, &chain->diag));
    if (!found)
        return bt_usage_error(command, "the ledger has no %s",
                              search.missed ? "missed run" : "run");
    return BT_OK;
}

static bt_status get(bt_chain* chain, int64_t run_number, bt_ledger_row* row) {
    const bt_status found = bt_ledger_get(chain->ledger, run_number, row, &chain->diag);
    if (found == BT_ERR_ARG)
        return bt_usage_error(chain->command, "the ledger has no run %lld", (long long)run_number);
    return found;
}

static bt_status find_and_replay(bt_chain* chain, int64_t run_number) {
    bt_ledger_row row;
    BT_TRY(run_number < 0 ? find(chain, &row) : get(chain, run_number, &row));
    return replay(chain, &row);
}

static bt_status run_replay(const bt_command* command) {
    int64_t run_number = -1;
    const bool searched = command->option[OPTION_MISSED] || command->option[OPTION_NEAREST];
    if (searched == (command->word_count > 1))
        return bt_usage_error(command, "give a run N, or --missed or --nearest");
    if (!searched && !bt_whole_number(command, "N", command->words[1], 0, &run_number))
        return BT_ERR_ARG;
    bt_chain chain;
    bt_status status = bt_chain_open(command, BT_LEDGER_READ, &chain);
    if (status == BT_OK)
        status = find_and_replay(&chain, run_number);
    bt_chain_close(&chain);
    return status;
}

static const struct argp_option options[] = {
    {"history", BT_OPTION + OPTION_HISTORY, "FILE", 0,
     "write the run, as -o FILE does, when -o names the study directory", 1},
    {"missed", BT_OPTION + OPTION_MISSED, 0, 0, "the first run that missed, instead of run N", 1},
    {"nearest", BT_OPTION + OPTION_NEAREST, "'PATH=VALUE, ...'|limit", 0,
     "the run nearest to these inputs, or nearest to the limit between catch and miss (the least "
     "margin); with --missed: of those that missed",
     1},
    {0},
};

const bt_verb bt_verb_replay = {
    .name = "replay",
    .summary = "repeat run N of a campaign to the bit, with full output",
    .arguments = "STUDY.yaml [N]",
    .text = "Takes the inputs of run N from the ledger, runs that landing again, and compares the "
            "final state with the one recorded; a difference is an error.\n\n"
            "  bolter replay study.yaml 17\n"
            "  bolter replay study.yaml --missed --nearest 'landing.pitch=3 deg'\n"
            "  bolter replay study.yaml --nearest limit -o run.html   a page that plays it\n"
            "  bolter replay study.yaml 17 -o run.h5    time histories (.csv: CSV; .pvd: ParaView)",
    .options = options,
    .least_words = 1,
    .most_words = 2,
    .outputs = BT_OUTPUT_HISTORIES | BT_OUTPUT_TABLE | BT_OUTPUT_PAGE | BT_OUTPUT_PARAVIEW |
               BT_OUTPUT_DIRECTORY,
    .run = run_replay,
};
