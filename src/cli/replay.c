#include "base/units.h"
#include "cli/chain.h"
#include "cli/output.h"
#include "report/history.h"
#include "report/landing_report.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { OPTION_HISTORY, OPTION_MISSED, OPTION_NEAREST };

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

static bt_status replay(bt_chain* chain, const bt_ledger_row* row, bt_history* history) {
    bt_landing_result result;
    BT_TRY(repeat(chain, row, history, &result));
    BT_TRY(compare(row, &result, &chain->diag));
    const bt_command* command = chain->command;
    if (history)
        BT_TRY(bt_history_write(history, command->option[OPTION_HISTORY], &chain->study, &result,
                                &chain->diag));
    if (command->json) {
        bt_json json = {.out = stdout};
        bt_landing_write_json(&json, &result);
    } else {
        const bt_axes axes = bt_design_axes(&chain->study);
        printf("run %lld, the same to the bit (state %016" PRIx64 ")\n", (long long)row->run,
               result.state_hash);
        for (int i = 0; i < axes.count; ++i)
            print_input(&chain->study.inputs[axes.input[i]], row->x[i]);
        bt_landing_print(stdout, &result);
    }
    return BT_OK;
}

// --- which run ------------------------------------------------------------------------------

/// A search through the ledger: the first run, or the one nearest to a point, of all or of the
/// missed ones.
typedef struct search {
    const bt_study* study;
    bt_axes axes;
    bool missed, near;
    bool wanted[BT_INPUT_MAX]; ///< axes that the point names
    double point[BT_INPUT_MAX];
    double distance;
    bool found;
    bt_ledger_row row;
} search;

/// A length along an axis: its range, or else its standard deviation.
static double scale_of(const bt_input* input) {
    const double scale = input->bounded ? input->upper - input->lower : input->distribution.sd;
    return scale > 0 ? scale : 1;
}

static double distance_to(const search* s, const double* x) {
    double sum = 0;
    for (int i = 0; i < s->axes.count; ++i) {
        const double d = (x[i] - s->point[i]) / scale_of(&s->study->inputs[s->axes.input[i]]);
        sum += s->wanted[i] ? d * d : 0;
    }
    return sum;
}

static bool consider(void* user, const bt_ledger_row* row) {
    search* s = user;
    if (s->missed && row->result.outcome != BT_MISSED)
        return true;
    const double distance = distance_to(s, row->x);
    if (!s->found || distance < s->distance) {
        s->row = *row;
        s->distance = distance;
        s->found = true;
    }
    return s->near;
}

/// One "landing.pitch=3 deg" of a point.
static bt_status read_coordinate(const bt_command* command, search* s, const char* text) {
    char why[256] = "is no axis of the campaign";
    const size_t length = strcspn(text, "=");
    for (int i = 0; i < s->axes.count && text[length]; ++i) {
        const bt_input* input = &s->study->inputs[s->axes.input[i]];
        if (strlen(input->path) != length || strncmp(input->path, text, length) != 0)
            continue;
        s->wanted[i] = true;
        if (bt_unit_parse(text + length + 1, *input->field->unit ? input->field->unit : "1",
                          &s->point[i], why, sizeof why) == BT_OK)
            return BT_OK;
        break;
    }
    return bt_usage_error(command, "--nearest takes 'PATH=VALUE, ...': %.*s: %s", (int)length, text,
                          why);
}

static bt_status read_point(const bt_command* command, search* s) {
    char text[1024];
    snprintf(text, sizeof text, "%s", command->option[OPTION_NEAREST]);
    char* rest = NULL;
    for (char* word = strtok_r(text, ",", &rest); word; word = strtok_r(NULL, ",", &rest))
        BT_TRY(read_coordinate(command, s, word + strspn(word, " ")));
    s->near = true;
    return BT_OK;
}

static bt_status find(bt_chain* chain, bt_ledger_row* row) {
    const bt_command* command = chain->command;
    search s = {.study = &chain->study, .axes = bt_design_axes(&chain->study)};
    s.missed = command->option[OPTION_MISSED] != NULL;
    if (command->option[OPTION_NEAREST])
        BT_TRY(read_point(command, &s));
    BT_TRY(bt_ledger_walk(chain->ledger, consider, &s, &chain->diag));
    if (!s.found)
        return bt_usage_error(command, "the ledger has no %s", s.missed ? "missed run" : "run");
    *row = s.row;
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
    bt_history* history = NULL;
    if (chain->command->option[OPTION_HISTORY])
        BT_TRY(bt_history_create(&history));
    const bt_status status = replay(chain, &row, history);
    bt_history_destroy(history);
    return status;
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
     "write the run's time histories, .h5 or .csv", 1},
    {"missed", BT_OPTION + OPTION_MISSED, 0, 0, "the first run that missed, instead of run N", 1},
    {"nearest", BT_OPTION + OPTION_NEAREST, "'PATH=VALUE, ...'", 0,
     "the run nearest to these inputs (with --missed: of those that missed), instead of run N", 1},
    {0},
};

const bt_verb bt_verb_replay = {
    .name = "replay",
    .summary = "repeat run N of a campaign to the bit, with full output",
    .arguments = "STUDY.yaml [N]",
    .text = "Takes the inputs of run N from the ledger, runs that landing again, and compares the "
            "final state with the one recorded; a difference is an error.\n\n"
            "  bolter replay study.yaml 17\n"
            "  bolter replay study.yaml --missed --nearest 'landing.pitch=3 deg'",
    .options = options,
    .least_words = 1,
    .most_words = 2,
    .outputs = BT_OUTPUT_DIRECTORY,
    .run = run_replay,
};
