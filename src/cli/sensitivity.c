#include "base/units.h"
#include "cli/cli.h"
#include "cli/sensitivity_keys.h"
#include "pipeline/noise.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { OPTION_SAMPLES, OPTION_CHANGE, OPTION_KEYS, OPTION_AT, KEYS_MAX = 64, PLACES_MAX = 16 };

/// One key: the landings with it at either end of its range, against those as the study sets it.
typedef struct effect {
    char path[BT_PATH_MAX];
    double value, end[2]; ///< SI: as the study sets it; low, high
    const char* unit;     ///< as people write it
    bool refused[2];      ///< the model cannot be run with the key at that end
    double engaged[2];    ///< share; NAN where refused
    double margin_m[2];   ///< mean move of the margin
    int64_t flips;        ///< of both together
} effect;

typedef struct table {
    const bt_command* command;
    bt_study study;
    int64_t count;
    double change; ///< share of the value, for keys without a range
    int effect_count;
    effect effects[KEYS_MAX];
    int place_count;
    double place_m[PLACES_MAX]; ///< distances at which landing.distance is held; none: as drawn
    bt_noise_landing *base, *other;
} table;

static double mean_move(const bt_noise_landing* from, const bt_noise_landing* to, int64_t count) {
    double sum = 0;
    int64_t both = 0;
    for (int64_t i = 0; i < count; ++i)
        if (isfinite(to[i].margin_m - from[i].margin_m)) {
            sum += to[i].margin_m - from[i].margin_m;
            ++both;
        }
    return both > 0 ? sum / (double)both : NAN;
}

/// Sets one number of the study's model; what it was.
static double set_key(bt_study* study, const char* path, double value) {
    size_t offset;
    const bt_field* field = bt_params_find(&bt_model_group, &study->model, path, &offset);
    const double before = bt_field_get(field, &study->model, offset);
    bt_field_set(field, &study->model, offset, value);
    return before;
}

static bt_status run_landings(table* t, bt_noise_landing* landings, bt_diag* diag) {
    return bt_noise_run(&t->study, NULL, t->count, (int)t->study.campaign.threads, &bt_interrupted,
                        landings, diag);
}

static bt_status measure_end(table* t, effect* e, int side, bt_diag* diag) {
    e->refused[side] = bt_group_check(&bt_model_group, &t->study.model, "", NULL) != BT_OK;
    e->engaged[side] = e->margin_m[side] = NAN;
    if (e->refused[side])
        return BT_OK;
    bt_noise_difference difference;
    BT_TRY(run_landings(t, t->other, diag));
    BT_TRY(bt_noise_compare(t->base, t->other, t->count, &difference));
    e->engaged[side] = bt_noise_engaged_share(t->other, t->count);
    e->margin_m[side] = mean_move(t->base, t->other, t->count);
    e->flips += difference.flips;
    return BT_OK;
}

static bt_status measure(table* t, effect* e, bt_diag* diag) {
    bt_status status = BT_OK;
    e->flips = 0;
    for (int side = 0; side < 2 && status == BT_OK; ++side) {
        const double before = set_key(&t->study, e->path, e->end[side]);
        status = measure_end(t, e, side, diag);
        (void)set_key(&t->study, e->path, before);
    }
    return status;
}

/// Reads "LOW..HIGH", each with its unit; false (said on stderr) when it is none.
static bool read_range(const table* t, const bt_field* field, const char* text, effect* e) {
    char low[64], why[256] = "write LOW..HIGH";
    const char* dots = strstr(text, "..");
    const char* unit = field->unit[0] ? field->unit : "1";
    const size_t length = dots ? (size_t)(dots - text) : 0;
    bool good = dots && length < sizeof low;
    if (good) {
        memcpy(low, text, length);
        low[length] = 0;
        good = bt_unit_parse(low, unit, &e->end[0], why, sizeof why) == BT_OK &&
               bt_unit_parse(dots + 2, unit, &e->end[1], why, sizeof why) == BT_OK;
    }
    if (good && !(e->end[0] < e->end[1])) {
        good = false;
        snprintf(why, sizeof why, "the first is not below the second");
    }
    if (!good)
        (void)bt_usage_error(t->command, "--keys: %s=%s: %s", e->path, text, why);
    return good;
}

/// The ends of a key's range: as typed, else the likely one, else a share of its value.
static bool find_ends(const table* t, const bt_field* field, const char* typed, effect* e) {
    if (typed)
        return read_range(t, field, typed, e);
    const bt_likely_range* likely = bt_likely_range_find(e->path);
    e->end[0] = likely ? likely->low : (1 - t->change) * e->value;
    e->end[1] = likely ? likely->high : (1 + t->change) * e->value;
    if (e->end[0] == e->end[1]) {
        (void)bt_usage_error(t->command,
                             "--keys: \"%s\" is 0, of which there is no share; write %s=LOW..HIGH",
                             e->path, e->path);
        return false;
    }
    return true;
}

/// Adds a key, PATH or PATH=LOW..HIGH; false (said on stderr) when it is no number of the model.
static bool add_key(table* t, const char* text, size_t length) {
    effect* e = &t->effects[t->effect_count];
    char typed[BT_PATH_MAX + 128];
    size_t offset;
    if (t->effect_count == KEYS_MAX || length >= sizeof typed) {
        (void)bt_usage_error(t->command, "--keys: at most %d keys", KEYS_MAX);
        return false;
    }
    memcpy(typed, text, length);
    typed[length] = 0;
    char* range = strchr(typed, '=');
    if (range)
        *range++ = 0;
    snprintf(e->path, sizeof e->path, "%.*s", (int)sizeof e->path - 1, typed);
    const bt_field* field = bt_params_find(&bt_model_group, &t->study.model, e->path, &offset);
    if (!field || (field->kind != BT_FIELD_REAL && field->kind != BT_FIELD_PLAIN)) {
        (void)bt_usage_error(t->command,
                             "--keys: \"%s\" is no number of the model; see bolter keys", e->path);
        return false;
    }
    e->value = bt_field_get(field, &t->study.model, offset);
    e->unit = field->unit[0] ? bt_unit_text(field->unit) : "";
    if (!find_ends(t, field, range, e))
        return false;
    ++t->effect_count;
    return true;
}

/// A random input has no value of its own to be changed: it is drawn.
static bool is_input(const table* t, const char* path) {
    for (int k = 0; k < t->study.input_count; ++k)
        if (t->study.inputs[k].random && strcmp(t->study.inputs[k].path, path) == 0)
            return true;
    return false;
}

static bool add_keys(table* t, const char* list) {
    if (!list) {
        for (const bt_likely_range* range = bt_likely_ranges; range->path; ++range)
            if (bt_params_find(&bt_model_group, &t->study.model, range->path, NULL) &&
                !is_input(t, range->path) && !add_key(t, range->path, strlen(range->path)))
                return false;
        return true;
    }
    for (const char* at = list; *at; at += strcspn(at, ","), at += *at == ',')
        if (!add_key(t, at, strcspn(at, ",")))
            return false;
    for (int i = 0; i < t->effect_count; ++i)
        if (is_input(t, t->effects[i].path)) {
            (void)bt_usage_error(t->command,
                                 "--keys: \"%s\" is drawn from its distribution; `bolter "
                                 "reliability` shows what moving it does",
                                 t->effects[i].path);
            return false;
        }
    return true;
}

/// How far the key moves the share engaged, and then how many outcomes it changes.
static double strength(const effect* e) {
    double shift = 0;
    if (!e->refused[0] && !e->refused[1])
        shift = fabs(e->engaged[1] - e->engaged[0]);
    return shift + 1e-3 * (double)e->flips;
}

static int strongest_first(const void* a, const void* b) {
    const double x = strength(a), y = strength(b);
    return (x < y) - (x > y);
}

static void write_keys(bt_json* json, const table* t, double base) {
    bt_json_number(json, "engaged", base);
    bt_json_begin_array(json, "keys");
    for (int i = 0; i < t->effect_count; ++i) {
        const effect* e = &t->effects[i];
        bt_json_begin_object(json, NULL);
        bt_json_string(json, "path", e->path);
        bt_json_number(json, "value", e->value);
        bt_json_number(json, "low", e->end[0]);
        bt_json_number(json, "high", e->end[1]);
        bt_json_number(json, "engaged_lower", e->engaged[0]);
        bt_json_number(json, "engaged_higher", e->engaged[1]);
        bt_json_number(json, "margin_lower_m", e->margin_m[0]);
        bt_json_number(json, "margin_higher_m", e->margin_m[1]);
        bt_json_integer(json, "flips", e->flips);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}

static void print_table(const table* t, double base) {
    printf(
        "%.2f %% engaged as the study sets it.\n\n"
        "| key | value | low | high | unit | engaged at low | at high | margin moves at low, mm | "
        "at high, mm | outcomes changed |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
        100 * base);
    for (int i = 0; i < t->effect_count; ++i) {
        const effect* e = &t->effects[i];
        char engaged[2][32], moved[2][32];
        for (int side = 0; side < 2; ++side) {
            snprintf(engaged[side], sizeof engaged[side], "%.2f %%", 100 * e->engaged[side]);
            snprintf(moved[side], sizeof moved[side], "%+.2f", 1e3 * e->margin_m[side]);
        }
        printf("| %s | %.4g | %.4g | %.4g | %s | %s | %s | %s | %s | %lld |\n", e->path, e->value,
               e->end[0], e->end[1], e->unit, e->refused[0] ? "refused" : engaged[0],
               e->refused[1] ? "refused" : engaged[1], e->refused[0] ? "-" : moved[0],
               e->refused[1] ? "-" : moved[1], (long long)e->flips);
    }
}

/// One table: all keys, with the distance as drawn (NAN) or held.
static bt_status run_table(table* t, double place_m, bt_json* json, bt_diag* diag) {
    const bool held = isfinite(place_m);
    if (held)
        (void)set_key(&t->study, "landing.distance", place_m);
    BT_TRY(run_landings(t, t->base, diag));
    BT_TRY(bt_noise_check_failed(&t->study, t->base, t->count, diag));
    bt_progress progress = bt_progress_start("sensitivity", t->command->quiet);
    for (int i = 0; i < t->effect_count; ++i) {
        bt_progress_show(&progress, false, "%d of %d keys", i, t->effect_count);
        BT_TRY(measure(t, &t->effects[i], diag));
    }
    bt_progress_show(&progress, true, "%d of %d keys", t->effect_count, t->effect_count);
    qsort(t->effects, (size_t)t->effect_count, sizeof *t->effects, strongest_first);
    const double base = bt_noise_engaged_share(t->base, t->count);
    if (json && held)
        bt_json_begin_object(json, NULL);
    if (json && held)
        bt_json_number(json, "distance_m", place_m);
    if (json)
        write_keys(json, t, base);
    if (json && held)
        bt_json_end_object(json);
    if (!json && held)
        printf("\n## D = %g m\n\n", place_m);
    if (!json)
        print_table(t, base);
    return BT_OK;
}

static bt_status run_tables(table* t, bt_json* json, bt_diag* diag) {
    if (t->place_count == 0)
        return run_table(t, NAN, json, diag);
    if (json)
        bt_json_begin_array(json, "distances");
    for (int i = 0; i < t->place_count; ++i)
        BT_TRY(run_table(t, t->place_m[i], json, diag));
    if (json)
        bt_json_end_array(json);
    return BT_OK;
}

static bt_status run_all(table* t) {
    bt_diag diag = bt_stderr_diag();
    bt_json json = {.out = stdout};
    t->base = calloc((size_t)t->count, sizeof *t->base);
    t->other = calloc((size_t)t->count, sizeof *t->other);
    if (!t->base || !t->other)
        return BT_ERR_MEMORY;
    if (!t->command->json) {
        printf(
            "%lld landings of \"%s\", the same each time; a key goes to both ends of its range, or "
            "down and up by %g %% where it has none.\n\n",
            (long long)t->count, t->study.title, 100 * t->change);
        return run_tables(t, NULL, &diag);
    }
    bt_json_begin_object(&json, NULL);
    bt_json_integer(&json, "landings", t->count);
    bt_json_number(&json, "change", t->change);
    BT_TRY(run_tables(t, &json, &diag));
    bt_json_end_object(&json);
    return BT_OK;
}

/// Holds the distance at each value of "2 m,5.5 m,8 m" in turn; it is no longer drawn.
static bool hold_distance(table* t, const char* list) {
    for (const char* at = list; at && *at; at += strcspn(at, ","), at += *at == ',') {
        char text[64], why[256] = "write distances, as 2 m,5.5 m";
        const size_t length = strcspn(at, ",");
        double* place = &t->place_m[t->place_count];
        snprintf(text, sizeof text, "%.*s", (int)(length < sizeof text ? length : sizeof text - 1),
                 at);
        if (t->place_count == PLACES_MAX) {
            (void)bt_usage_error(t->command, "--at: at most %d distances", PLACES_MAX);
            return false;
        }
        if (bt_unit_parse(text, "m", place, why, sizeof why) != BT_OK) {
            (void)bt_usage_error(t->command, "--at: %s", why);
            return false;
        }
        ++t->place_count;
    }
    if (list && t->place_count == 0) {
        (void)bt_usage_error(t->command, "--at: no distance; write 2 m,5.5 m");
        return false;
    }
    for (int k = 0; list && k < t->study.input_count; ++k)
        if (strcmp(t->study.inputs[k].path, "landing.distance") == 0)
            t->study.inputs[k].random = false;
    return true;
}

static bt_status run(const bt_command* command) {
    table t = {.command = command, .count = 400, .change = 0.1};
    const char* samples = command->option[OPTION_SAMPLES];
    const char* change = command->option[OPTION_CHANGE];
    if (samples && !bt_whole_number(command, "--samples", samples, 1, &t.count))
        return BT_ERR_ARG;
    if (t.count > 1000000)
        return bt_usage_error(command, "--samples: at most 1000000");
    if (change && (bt_number_parse(change, &t.change) != BT_OK || !(t.change > 0 && t.change < 1)))
        return bt_usage_error(command, "--change: \"%s\" is no share between 0 and 1", change);
    BT_TRY(bt_command_study(command, &t.study));
    const bool good =
        hold_distance(&t, command->option[OPTION_AT]) && add_keys(&t, command->option[OPTION_KEYS]);
    const bt_status status = good ? run_all(&t) : BT_ERR_ARG;
    free(t.base);
    free(t.other);
    bt_study_destroy(&t.study);
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
            "  bolter sensitivity study.yaml --keys "
            "'aircraft.hook.damper_angle=85 deg..100 deg,deck.cable.mass'",
    .options = options,
    .least_words = 1,
    .most_words = 1,
    .run = run,
};
