#include "base/text.h"
#include "cli/output.h"
#include "report/result_keys.h"
#include "report/table.h"

#include <stdio.h>

static const bt_column columns[] = {
    {.name = "key", .head = "key", .unit = ""},
    {.name = "unit", .head = "unit", .unit = ""},
    {.name = "default", .head = "default", .unit = ""},
    {.name = "range", .head = "range", .unit = ""},
    {.name = "paper", .head = "paper", .unit = ""},
    {.name = "meaning", .head = "meaning", .unit = ""},
};

static void print(void* user, const char* text) {
    (void)user;
    fputs(text, stdout);
}

static void add_row(void* table, const bt_key_text* key) {
    bt_report_table_row(table);
    bt_report_table_text(table, key->path);
    bt_report_table_text(table, key->unit);
    bt_report_table_text(table, key->fallback);
    bt_report_table_text(table, key->range);
    bt_report_table_text(table, key->equation);
    bt_report_table_text(table, key->meaning);
}

static void look_at_key(void* user, const bt_key_text* key) {
    bt_text_look(user, key->path);
}

static bt_status refuse_part(const bt_command* command, const char* part) {
    bt_text_nearest nearest = bt_text_search(part);
    char hint[320];
    (void)bt_study_each_key(NULL, look_at_key, &nearest);
    return bt_usage_error(command, "there is no key \"%s\"%s", part,
                          bt_text_suggest(&nearest, hint, sizeof hint));
}

static bt_status put(const bt_command* command, const bt_report_table* table) {
    bt_json json = {.out = stdout};
    if (!command->json)
        return bt_report_table_print(table, stdout);
    bt_json_begin_object(&json, NULL);
    BT_TRY(bt_report_table_json(table, &json, "keys"));
    bt_json_end_object(&json);
    return BT_OK;
}

/// A part of the reference, or all of it for programs.
static bt_status print_part(const bt_command* command, const char* part) {
    bt_report_table* table =
        bt_report_table_create(NULL, columns, (int)(sizeof columns / sizeof columns[0]));
    const int count = bt_study_each_key(part, add_row, table);
    const bt_status status = count > 0 ? put(command, table) : refuse_part(command, part);
    bt_report_table_destroy(table);
    return status;
}

static bt_status run_keys(const bt_command* command) {
    const char* part = command->word_count > 0 ? command->words[0] : NULL;
    const bool results = command->option[1] != NULL;
    if (results && (part || command->option[0]))
        return bt_usage_error(command, "--results stands alone");
    if (command->set_count > 0)
        return bt_usage_error(command, "there is no study here that --set could change");
    if (command->option[0] && (part || command->json))
        return bt_usage_error(command, "--defaults writes a whole study, as YAML");
    if (results)
        return command->json ? bt_result_keys_json(stdout) : bt_result_keys_markdown(stdout);
    if (command->option[0])
        bt_study_defaults(print, NULL);
    else if (part || command->json)
        return print_part(command, part);
    else
        bt_study_keys(print, NULL);
    return BT_OK;
}

static const struct argp_option options[] = {
    {"defaults", BT_OPTION, 0, 0, "write a complete commented study with every default", 1},
    {"results", BT_OPTION + 1, 0, 0,
     "list what a landing gives instead: results, modes, remarks, histories", 1},
    {0},
};

const bt_verb bt_verb_keys = {
    .name = "keys",
    .summary = "list every key of a study: unit, default, range, equation, meaning",
    .arguments = "[PATH]",
    .text = "Any numeric key can be changed with --set, given a distribution in `uncertainty:', "
            "and made an axis of the campaign in `campaign.bounds:'.\n\n"
            "  bolter keys aircraft.hook          a part of it, or one key\n"
            "  bolter keys --json                 for programs\n"
            "  bolter keys --defaults > mine.yaml     to begin a study of your own",
    .options = options,
    .most_words = 1,
    .run = run_keys,
};
