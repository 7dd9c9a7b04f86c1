#include "base/units.h"
#include "cli/chain.h"
#include "cli/output.h"
#include "report/history.h"
#include "report/landing_report.h"

#include <inttypes.h>
#include <stdlib.h>

/// Repeats a run of the ledger.
static bt_status repeat(bt_chain* chain, const bt_ledger_row* row, bt_history* history,
                        bt_landing_result* result) {
    const bt_axes axes = bt_design_axes(&chain->study);
    bt_model_params* model = malloc(sizeof *model);
    bt_lander* lander = NULL;
    bt_status status = model ? bt_lander_create(&lander) : BT_ERR_MEMORY;
    if (status == BT_OK) {
        bt_lander_obey(lander, &bt_interrupted);
        *model = chain->study.model;
        status = bt_landing_at(lander, model, chain->study.inputs, &axes, row->x, result,
                               history ? bt_history_observe : NULL, history);
    }
    bt_lander_destroy(lander);
    free(model);
    return status;
}

static bt_status compare(const bt_ledger_row* row, const bt_landing_result* result, bt_diag* diag) {
    if (result->state_hash == row->result.state_hash && result->outcome == row->result.outcome &&
        result->steps == row->result.steps)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                "run %lld does not repeat to the bit: state %016" PRIx64 " now, %016" PRIx64
                " in the ledger. Was it computed by another version or on another processor?",
                (long long)row->run, result->state_hash, row->result.state_hash);
    return BT_ERR_INTERNAL;
}

static bt_status replay(bt_chain* chain, const bt_ledger_row* row, bt_history* history) {
    bt_landing_result result;
    BT_TRY(repeat(chain, row, history, &result));
    BT_TRY(compare(row, &result, &chain->diag));
    const bt_command* command = chain->command;
    if (history)
        BT_TRY(bt_history_write(history, command->option[0], &chain->study, &result, &chain->diag));
    if (command->json) {
        bt_json json = {.out = stdout};
        bt_landing_write_json(&json, &result);
    } else {
        const bt_axes axes = bt_design_axes(&chain->study);
        printf("run %lld, the same to the bit (state %016" PRIx64 ")\n", (long long)row->run,
               result.state_hash);
        for (int i = 0; i < axes.count; ++i) {
            char text[64];
            const bt_input* input = &chain->study.inputs[axes.input[i]];
            bt_unit_print(row->x[i], input->field->unit[0] ? input->field->unit : "1", text,
                          sizeof text);
            printf("  %s = %s\n", input->path, text);
        }
        bt_landing_print(stdout, &result);
    }
    return BT_OK;
}

static bt_status find_and_replay(bt_chain* chain, int64_t run_number) {
    bt_ledger_row row;
    const bt_status found = bt_ledger_get(chain->ledger, run_number, &row, &chain->diag);
    if (found == BT_ERR_ARG)
        return bt_usage_error(chain->command, "the ledger has no run %lld", (long long)run_number);
    BT_TRY(found);
    bt_history* history = NULL;
    if (chain->command->option[0])
        BT_TRY(bt_history_create(&history));
    const bt_status status = replay(chain, &row, history);
    bt_history_destroy(history);
    return status;
}

static bt_status run(const bt_command* command) {
    int64_t run_number = 0;
    if (!bt_whole_number(command, "N", command->words[1], 0, &run_number))
        return BT_ERR_ARG;
    bt_chain chain;
    bt_status status = bt_chain_open(command, BT_LEDGER_READ, &chain);
    if (status == BT_OK)
        status = find_and_replay(&chain, run_number);
    bt_chain_close(&chain);
    return status;
}

static const struct argp_option options[] = {
    {"history", BT_OPTION, "FILE.h5", 0, "write the run's time histories", 1},
    {0},
};

const bt_verb bt_verb_replay = {
    .name = "replay",
    .summary = "repeat run N of a campaign to the bit, with full output",
    .arguments = "STUDY.yaml N",
    .text = "Takes the inputs of run N from the ledger, runs that landing again, and compares the "
            "final state with the one recorded; a difference is an error.",
    .options = options,
    .least_words = 2,
    .most_words = 2,
    .outputs = BT_OUTPUT_DIRECTORY,
    .run = run,
};
