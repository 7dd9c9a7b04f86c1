#include "report/sensitivity_report.h"

#include "base/units.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "cluster/cluster.h"

#include <math.h>
#include <stdlib.h>

enum { OPTION_SAMPLES, OPTION_CHANGE, OPTION_KEYS, OPTION_AT };

/// A command on its way: what it moves, and the rows of all its tables for -o FILE.csv.
typedef struct sensing {
    const bt_command* command;
    bt_sensitivity* sensitivity;
    bt_report_table* all;
    bt_progress progress;
    bt_json json;
} sensing;

static void show_progress(void* user, int done, int total) {
    bt_progress_show(user, done == total, "%d of %d keys", done, total);
}

static bt_status print_result(const bt_sensitivity_result* result, const bt_report_table* table) {
    if (isfinite(result->distance_m))
        printf("\n## D = %g m\n\n", result->distance_m);
    printf("%.2f %% engaged as the study sets it.\n\n", 100 * result->engaged);
    return bt_report_table_markdown(table, stdout);
}

static bt_status write_result(bt_json* json, const bt_sensitivity_result* result,
                              const bt_report_table* table) {
    const bool held = isfinite(result->distance_m);
    if (held) {
        bt_json_begin_object(json, NULL);
        bt_json_number(json, "distance_m", result->distance_m);
    }
    bt_json_number(json, "engaged", result->engaged);
    BT_TRY(bt_report_table_json(table, json, "keys"));
    if (held)
        bt_json_end_object(json);
    return BT_OK;
}

/// One table: all keys, with the distance as drawn (NAN) or held.
static bt_status move_keys(sensing* s, double distance_m, bt_diag* diag) {
    bt_sensitivity_result result;
    s->progress = bt_progress_start("sensitivity", s->command->quiet);
    BT_TRY(bt_stage_sensitivity(s->sensitivity, distance_m, show_progress, &s->progress, &result,
                                diag));
    bt_report_table* table = bt_sensitivity_table_create();
    bt_sensitivity_table_add(table, &result);
    bt_sensitivity_table_add(s->all, &result);
    const bt_status status =
        s->command->json ? write_result(&s->json, &result, table) : print_result(&result, table);
    bt_report_table_destroy(table);
    return status;
}

static bt_status move_at_distances(sensing* s, bt_diag* diag) {
    const bt_sensitivity* given = s->sensitivity;
    if (given->distance_count == 0)
        return move_keys(s, NAN, diag);
    if (s->command->json)
        bt_json_begin_array(&s->json, "distances");
    for (int i = 0; i < given->distance_count; ++i)
        BT_TRY(move_keys(s, given->distance_m[i], diag));
    if (s->command->json)
        bt_json_end_array(&s->json);
    return BT_OK;
}

static bt_status move_and_print(sensing* s) {
    bt_diag diag = bt_stderr_diag();
    const bt_sensitivity* given = s->sensitivity;
    char count[32];
    if (s->command->json) {
        bt_json_begin_object(&s->json, NULL);
        bt_json_integer(&s->json, "landings", given->count);
        bt_json_number(&s->json, "change", given->change);
    } else
        printf("%s landings of \"%s\", the same each time; a key goes to both ends of its range, "
               "or down and up by %g %% where it has none.\n\n",
               bt_count_text(given->count, count), given->study->title, 100 * given->change);
    BT_TRY(move_at_distances(s, &diag));
    if (s->command->json)
        bt_json_end_object(&s->json);
    return bt_output_table(s->command, s->all, &diag);
}

/// What the options say, into `given`.
static bt_status read_options(const bt_command* command, bt_sensitivity* given) {
    const char* samples = command->option[OPTION_SAMPLES];
    const char* change = command->option[OPTION_CHANGE];
    if (samples && !bt_whole_number(command, "--samples", samples, 1, &given->count))
        return BT_ERR_ARG;
    if (given->count > 1000000)
        return bt_usage_error(command, "--samples: at most 1000000");
    if (change && (bt_number_parse(change, &given->change) != BT_OK ||
                   !(given->change > 0 && given->change < 1)))
        return bt_usage_error(command, "--change: \"%s\" is no share between 0 and 1", change);
    return BT_OK;
}

static bt_status sense(const bt_command* command, bt_sensitivity* given) {
    char why[512];
    if (bt_sensitivity_add_distances(given, command->option[OPTION_AT], why, sizeof why) != BT_OK)
        return bt_usage_error(command, "--at: %s", why);
    if (bt_sensitivity_add_keys(given, command->option[OPTION_KEYS], why, sizeof why) != BT_OK)
        return bt_usage_error(command, "--keys: %s", why);
    sensing s = {.command = command,
                 .sensitivity = given,
                 .all = bt_sensitivity_table_create(),
                 .json = {.out = stdout}};
    const bt_status status = move_and_print(&s);
    bt_report_table_destroy(s.all);
    return status;
}

static bt_status run_sensitivity(const bt_command* command) {
    bt_sensitivity given = {
        .count = 400, .change = 0.1, .stop = &bt_interrupted, .backend = bt_cluster_backend()};
    bt_study study;
    BT_TRY(read_options(command, &given));
    BT_TRY(bt_command_study(command, &study));
    given.study = &study;
    const bt_status status = sense(command, &given);
    bt_study_destroy(&study);
    return status;
}

static const struct argp_option options[] = {
    {"samples", BT_OPTION + OPTION_SAMPLES, "N", 0, "landings per row (400)", 1},
    {"change", BT_OPTION + OPTION_CHANGE, "SHARE", 0,
     "share by which a key without a range is changed (0.1)", 1},
    {"keys", BT_OPTION + OPTION_KEYS, "A,B=LOW..HIGH", 0,
     "these keys of the model, each with its range if it has one; without it those that the "
     "reference study had to choose, with ranges where an assumption may be off by a factor",
     1},
    {"at", BT_OPTION + OPTION_AT, "D,D", 0,
     "one table for each of these distances, held; without it landing.distance is drawn", 1},
    {0},
};

const bt_verb bt_verb_sensitivity = {
    .name = "sensitivity",
    .summary = "which keys of aircraft and deck decide, each moved through its range",
    .arguments = "STUDY.yaml",
    .text = "Draws landings from the study's distributions and runs the same landings with one key "
            "after the other at both ends of its range, or lowered and raised by a share of its "
            "value where it has none. Prints Markdown, the strongest key first.\n\n"
            "  bolter sensitivity study.yaml --at '2 m,5.5 m,8 m'\n"
            "  bolter sensitivity study.yaml -o keys.csv     the table as CSV too, SI\n"
            "  bolter sensitivity study.yaml --keys "
            "'aircraft.hook.damper_angle=85 deg..100 deg,deck.cable.mass'",
    .options = options,
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_TABLE,
    .run = run_sensitivity,
};
