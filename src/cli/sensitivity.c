#include "base/units.h"
#include "cli/cli.h"
#include "pipeline/noise.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { OPTION_SAMPLES, OPTION_CHANGE, OPTION_KEYS, KEYS_MAX = 64 };

/// What is ours to choose in the reference study, and what the paper varies.
static const char* const default_keys[] = {
    "landing.sink_speed",
    "landing.horizontal_speed",
    "landing.pitch",
    "landing.distance",
    "deck.cable.supports.first",
    "deck.cable.supports.height",
    "deck.cable.supports.stiffness",
    "deck.cable.pretension",
    "deck.cable.mass",
    "deck.cable.axial_stiffness",
    "deck.cable.bending_stiffness",
    "deck.cable.bending_damping",
    "deck.cable.axial_damping",
    "deck.cable.wheel_friction",
    "deck.cable.deck.restitution",
    "aircraft.main_gear.half_track",
    "aircraft.main_gear.station",
    "aircraft.main_gear.underside",
    "aircraft.hook.pivot_x",
    "aircraft.hook.pivot_z",
    "aircraft.hook.length",
    "aircraft.hook.down_stop",
    "aircraft.hook.damper.precharge",
    "aircraft.hook.damper.orifice_area",
    "aircraft.hook.damper.stop_stiffness",
    "aircraft.hook.profile.head_angle",
    "aircraft.hook.profile.lip_height",
    "aircraft.hook.deck_contact.stiffness",
    "aircraft.hook.deck_contact.dissipation",
    "aircraft.hook.deck_contact.friction",
    "aircraft.hook.cable_contact.friction",
    NULL,
};

/// One key: the landings with it lowered and raised, against those as the study sets it.
typedef struct effect {
    char path[BT_PATH_MAX], value[64];
    bool refused[2];    ///< the model cannot be run with the key lowered, raised
    double engaged[2];  ///< share, key lowered and raised; NAN where refused
    double margin_m[2]; ///< mean move of the margin
    int64_t flips;      ///< of both together
} effect;

typedef struct table {
    const bt_command* command;
    bt_study study;
    int64_t count;
    double change; ///< share of the value
    int effect_count;
    effect effects[KEYS_MAX];
    bt_noise_landing *base, *other;
} table;

static double engaged_share(const bt_noise_landing* landings, int64_t count) {
    int64_t engaged = 0;
    for (int64_t i = 0; i < count; ++i)
        engaged += landings[i].outcome == BT_ENGAGED;
    return (double)engaged / (double)count;
}

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

/// Whether the model with one key multiplied is still one that can be run.
static bool acceptable(const bt_study* study, const char* path, double factor) {
    bt_model_params model = study->model;
    size_t offset;
    const bt_field* field = bt_group_find(&bt_model_group, path, &offset);
    bt_field_set(field, &model, offset, factor * bt_field_get(field, &model, offset));
    return bt_group_check(&bt_model_group, &model, "", NULL) == BT_OK;
}

static bt_status measure(table* t, effect* e, bt_diag* diag) {
    for (int side = 0; side < 2; ++side) {
        const double factor = side == 0 ? 1 - t->change : 1 + t->change;
        const bt_noise_variant variant = {.changes = {{e->path, factor}}};
        if (!acceptable(&t->study, e->path, factor)) {
            e->refused[side] = true;
            e->engaged[side] = e->margin_m[side] = NAN;
            continue;
        }
        BT_TRY(bt_noise_run(&t->study, &variant, t->count, (int)t->study.campaign.threads,
                            &bt_interrupted, t->other, diag));
        bt_noise_difference difference;
        BT_TRY(bt_noise_compare(t->base, t->other, t->count, &difference));
        e->engaged[side] = engaged_share(t->other, t->count);
        e->margin_m[side] = mean_move(t->base, t->other, t->count);
        e->flips += difference.flips;
    }
    return BT_OK;
}

/// Adds a key; false (said on stderr) when it is none that can be multiplied.
static bool add_key(table* t, const char* path, size_t length) {
    effect* e = &t->effects[t->effect_count];
    size_t offset;
    if (t->effect_count == KEYS_MAX || length >= sizeof e->path) {
        (void)bt_usage_error(t->command, "--keys: at most %d keys", KEYS_MAX);
        return false;
    }
    memcpy(e->path, path, length);
    e->path[length] = 0;
    const bt_field* field = bt_group_find(&bt_model_group, e->path, &offset);
    if (!field || (field->kind != BT_FIELD_REAL && field->kind != BT_FIELD_PLAIN)) {
        (void)bt_usage_error(t->command,
                             "--keys: \"%s\" is no number of the model; see bolter keys", e->path);
        return false;
    }
    snprintf(e->value, sizeof e->value, "%.4g %s", bt_field_get(field, &t->study.model, offset),
             field->unit[0] ? bt_unit_text(field->unit) : "");
    ++t->effect_count;
    return true;
}

/// A random input has no value of its own to be changed: it is drawn.
static bool is_input(const table* t, const char* path) {
    for (int k = 0; k < t->study.input_count; ++k)
        if (strcmp(t->study.inputs[k].path, path) == 0)
            return true;
    return false;
}

static bool add_keys(table* t, const char* list) {
    if (!list) {
        for (const char* const* path = default_keys; *path; ++path)
            if (!is_input(t, *path) && !add_key(t, *path, strlen(*path)))
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

static void print_json(const table* t, double base) {
    bt_json json = {.out = stdout};
    bt_json_begin_object(&json, NULL);
    bt_json_integer(&json, "landings", t->count);
    bt_json_number(&json, "change", t->change);
    bt_json_number(&json, "engaged", base);
    bt_json_begin_array(&json, "keys");
    for (int i = 0; i < t->effect_count; ++i) {
        const effect* e = &t->effects[i];
        bt_json_begin_object(&json, NULL);
        bt_json_string(&json, "path", e->path);
        bt_json_number(&json, "engaged_lower", e->engaged[0]);
        bt_json_number(&json, "engaged_higher", e->engaged[1]);
        bt_json_number(&json, "margin_lower_m", e->margin_m[0]);
        bt_json_number(&json, "margin_higher_m", e->margin_m[1]);
        bt_json_integer(&json, "flips", e->flips);
        bt_json_end_object(&json);
    }
    bt_json_end_array(&json);
    bt_json_end_object(&json);
}

static void print_table(const table* t, double base) {
    const double percent = 100 * t->change;
    printf(
        "%lld landings of \"%s\", %.2f %% engaged as the study sets it; each key lowered and "
        "raised by %g %%, the same landings each time.\n\n"
        "| key | value | engaged at -%g %% | engaged at +%g %% | margin moves at -%g %%, mm | at "
        "+%g %%, mm | outcomes changed |\n| --- | --- | --- | --- | --- | --- | --- |\n",
        (long long)t->count, t->study.title, 100 * base, percent, percent, percent, percent,
        percent);
    for (int i = 0; i < t->effect_count; ++i) {
        const effect* e = &t->effects[i];
        char engaged[2][32], moved[2][32];
        for (int side = 0; side < 2; ++side) {
            snprintf(engaged[side], sizeof engaged[side], "%.2f %%", 100 * e->engaged[side]);
            snprintf(moved[side], sizeof moved[side], "%+.2f", 1e3 * e->margin_m[side]);
        }
        printf("| %s | %s | %s | %s | %s | %s | %lld |\n", e->path, e->value,
               e->refused[0] ? "refused" : engaged[0], e->refused[1] ? "refused" : engaged[1],
               e->refused[0] ? "-" : moved[0], e->refused[1] ? "-" : moved[1], (long long)e->flips);
    }
}

static bt_status run_all(table* t) {
    bt_diag diag = bt_stderr_diag();
    t->base = calloc((size_t)t->count, sizeof *t->base);
    t->other = calloc((size_t)t->count, sizeof *t->other);
    if (!t->base || !t->other)
        return BT_ERR_MEMORY;
    BT_TRY(bt_noise_run(&t->study, NULL, t->count, (int)t->study.campaign.threads, &bt_interrupted,
                        t->base, &diag));
    bt_progress progress = bt_progress_start("sensitivity", t->command->quiet);
    for (int i = 0; i < t->effect_count; ++i) {
        bt_progress_show(&progress, false, "%d of %d keys", i, t->effect_count);
        BT_TRY(measure(t, &t->effects[i], &diag));
    }
    bt_progress_show(&progress, true, "%d of %d keys", t->effect_count, t->effect_count);
    qsort(t->effects, (size_t)t->effect_count, sizeof *t->effects, strongest_first);
    const double base = engaged_share(t->base, t->count);
    if (t->command->json)
        print_json(t, base);
    else
        print_table(t, base);
    return BT_OK;
}

static bt_status run(const bt_command* command) {
    table t = {.command = command, .count = 400, .change = 0.1};
    const char* samples = command->option[OPTION_SAMPLES];
    const char* change = command->option[OPTION_CHANGE];
    if (samples && !bt_whole_number(command, "--samples", samples, 1, &t.count))
        return BT_ERR_ARG;
    BT_TRY(bt_refuse_output(command));
    if (t.count > 1000000)
        return bt_usage_error(command, "--samples: at most 1000000");
    if (change && (bt_number_parse(change, &t.change) != BT_OK || !(t.change > 0 && t.change < 1)))
        return bt_usage_error(command, "--change: \"%s\" is no share between 0 and 1", change);
    BT_TRY(bt_command_study(command, &t.study));
    const bt_status status = add_keys(&t, command->option[OPTION_KEYS]) ? run_all(&t) : BT_ERR_ARG;
    free(t.base);
    free(t.other);
    bt_study_destroy(&t.study);
    return status;
}

static const struct argp_option options[] = {
    {"samples", BT_OPTION + OPTION_SAMPLES, "N", 0, "landings per row (400)", 1},
    {"change", BT_OPTION + OPTION_CHANGE, "SHARE", 0, "share by which a key is changed (0.1)", 1},
    {"keys", BT_OPTION + OPTION_KEYS, "A,B", 0,
     "these keys of the model; without it those that the reference study had to choose", 1},
    {0},
};

const bt_verb bt_verb_sensitivity = {
    .name = "sensitivity",
    .summary = "which keys of aircraft and deck decide, each changed a little",
    .arguments = "STUDY.yaml",
    .text = "Draws landings from the study's distributions and runs the same landings with one key "
            "after the other lowered and raised by a share of its value. Prints a Markdown table, "
            "the strongest key first.\n\n"
            "  bolter sensitivity studies/reference/study.yaml > docs/sensitivity.md",
    .options = options,
    .least_words = 1,
    .most_words = 1,
    .run = run,
};
