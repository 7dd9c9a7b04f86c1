#include "cli/chain.h"
#include "cli/output.h"
#include "report/atlas_report.h"

#include <stdio.h>

static bt_status show(bt_chain* chain, const bt_report_table* table, const bt_atlas* atlas) {
    BT_TRY(bt_output_table(chain->command, table, &chain->diag));
    if (!chain->command->json)
        return bt_report_table_print(table, stdout);
    bt_json json = {.out = stdout};
    bt_json_begin_object(&json, NULL);
    bt_json_number(&json, "missed", atlas->missed);
    bt_json_begin_array(&json, "missed_ci95");
    bt_json_number(&json, NULL, atlas->missed_ci95.least);
    bt_json_number(&json, NULL, atlas->missed_ci95.greatest);
    bt_json_end_array(&json);
    const bt_status status = bt_report_table_json(table, &json, "groups");
    bt_json_end_object(&json);
    return status;
}

static bt_status sort_out(bt_chain* chain) {
    bt_landings landings;
    bt_atlas atlas;
    BT_TRY(bt_landings_read(&chain->study, chain->ledger, &landings, &chain->diag));
    bt_status status = bt_atlas_make(&landings, &atlas);
    if (status == BT_OK) {
        bt_report_table* table = bt_atlas_table(&chain->study, &landings, &atlas);
        status = show(chain, table, &atlas);
        bt_report_table_destroy(table);
    }
    bt_landings_destroy(&landings);
    return status;
}

static bt_status run_atlas(const bt_command* command) {
    bt_chain chain;
    bt_status status = bt_chain_open(command, BT_LEDGER_READ, &chain);
    if (status == BT_OK)
        status = sort_out(&chain);
    bt_chain_close(&chain);
    return status;
}

const bt_verb bt_verb_atlas = {
    .name = "atlas",
    .summary = "where the hook misses, how, and how much of 1 - R each kind has",
    .arguments = "STUDY.yaml",
    .text = "Sorts the misses of the ledger by mode and by the part of the inputs' range where "
            "they lie, each with its share of 1 - R under the study's distributions and a typical "
            "landing to look at (bolter why STUDY.yaml RUN). The ledger is only read.\n\n"
            "  bolter atlas study.yaml\n"
            "  bolter atlas study.yaml -o atlas.csv     the table as CSV, SI",
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_TABLE | BT_OUTPUT_DIRECTORY,
    .run = run_atlas,
};
