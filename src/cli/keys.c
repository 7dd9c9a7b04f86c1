#include "cli/cli.h"
#include "report/result_keys.h"

#include <stdio.h>

static void print(void* user, const char* text) {
    (void)user;
    fputs(text, stdout);
}

static bt_status run(const bt_command* command) {
    const bool results = command->option[1] != NULL;
    if (results && command->option[0])
        return bt_usage_error(command, "--defaults and --results are two things");
    if (command->json && !results)
        return bt_usage_error(command, "there is no --json form of the keys");
    if (command->set_count > 0)
        return bt_usage_error(command, "there is no study here that --set could change");
    BT_TRY(bt_refuse_output(command));
    if (results)
        return command->json ? bt_result_keys_json(stdout) : bt_result_keys_markdown(stdout);
    if (command->option[0])
        bt_study_defaults(print, NULL);
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
    .arguments = "",
    .text = "Any numeric key can be changed with --set, given a distribution in `uncertainty:', "
            "and made an axis of the campaign in `campaign.bounds:'.\n\n"
            "To begin a study of your own:  bolter keys --defaults > mine.yaml",
    .options = options,
    .most_words = 0,
    .run = run,
};
