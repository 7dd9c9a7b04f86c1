#include "report/compare_report.h"

#include "cli/cli.h"
#include "cli/output.h"
#include "cluster/cluster.h"

#include <stdio.h>
#include <stdlib.h>

enum { OPTION_SAMPLES, SAMPLES = 2000 };

static bt_status print_text(const bt_study* const study[2], const bt_comparison* c,
                            const bt_report_table* table, const bt_report_table* keys) {
    for (int k = 0; k < 2; ++k)
        printf("%s: %s\n", k ? "second" : "first ", study[k]->title);
    printf("\n%s\n\n", c->key_count ? "What differs, in SI:" : "The studies do not differ.");
    if (c->key_count > 0) {
        BT_TRY(bt_report_table_print(keys, stdout));
        printf("\nShares engaged on the same landings, with 95 %% limits:\n\n");
    }
    return bt_report_table_print(table, stdout);
}

static bt_status print_json(const bt_report_table* table, const bt_report_table* keys) {
    bt_json json = {.out = stdout};
    bt_json_begin_object(&json, NULL);
    bt_status status = bt_report_table_json(table, &json, "comparison");
    if (status == BT_OK)
        status = bt_report_table_json(keys, &json, "keys");
    bt_json_end_object(&json);
    return status;
}

static bt_status compare(const bt_command* command, const bt_study* const study[2], int64_t count,
                         bt_comparison* c) {
    bt_diag diag = bt_stderr_diag();
    const bt_compare_stage stage = {study[0], study[1], count, &bt_interrupted,
                                    bt_cluster_backend()};
    BT_TRY(bt_stage_compare(&stage, c, &diag));
    bt_report_table* table = bt_compare_table(c);
    bt_report_table* keys = bt_compare_keys_table(c);
    bt_status status = bt_output_table(command, table, &diag);
    if (status == BT_OK)
        status = command->json ? print_json(table, keys) : print_text(study, c, table, keys);
    bt_report_table_destroy(table);
    bt_report_table_destroy(keys);
    return status;
}

/// The second study, as bt_command_study reads the first.
static bt_status read_second(const bt_command* command, bt_study* study) {
    bt_command* second = malloc(sizeof *second);
    if (!second)
        return BT_ERR_MEMORY;
    *second = *command;
    second->words[0] = command->words[1];
    const bt_status status = bt_command_study(second, study);
    free(second);
    return status;
}

static bt_status run_compare(const bt_command* command) {
    int64_t count = SAMPLES;
    const char* samples = command->option[OPTION_SAMPLES];
    if (samples && !bt_whole_number(command, "--samples", samples, 1, &count))
        return BT_ERR_ARG;
    if (count > 10000000)
        return bt_usage_error(command, "--samples: at most 10000000");
    bt_study* study = calloc(2, sizeof *study);
    bt_comparison* comparison = malloc(sizeof *comparison);
    bt_status status = study && comparison ? bt_command_study(command, &study[0]) : BT_ERR_MEMORY;
    if (status == BT_OK)
        status = read_second(command, &study[1]);
    if (status == BT_OK)
        status =
            compare(command, (const bt_study* const[2]){&study[0], &study[1]}, count, comparison);
    for (int k = 0; study && k < 2; ++k)
        bt_study_destroy(&study[k]);
    free(study);
    free(comparison);
    return status;
}

static const struct argp_option options[] = {
    {"samples", BT_OPTION + OPTION_SAMPLES, "N", 0, "landings of each study (2000)", 1},
    {0},
};

const bt_verb bt_verb_compare = {
    .name = "compare",
    .summary = "two studies on the same random numbers: what differs, and by how much",
    .arguments = "FIRST.yaml SECOND.yaml",
    .text = "Names the keys that differ, draws landings of both studies from their distributions "
            "at the same random numbers, and prints both shares engaged and their difference with "
            "its 95 % interval: of landings that are alike, only those whose outcome changes "
            "count. --set changes both studies. Needs no study directory and writes none.\n\n"
            "  bolter compare study.yaml other.yaml --samples 4000\n"
            "  bolter compare study.yaml other.yaml -o comparison.csv",
    .options = options,
    .least_words = 2,
    .most_words = 2,
    .outputs = BT_OUTPUT_TABLE,
    .run = run_compare,
};
