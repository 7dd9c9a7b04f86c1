#include "pipeline/noise.h"
#include "base/units.h"
#include "cli/cli.h"
#include "statistics/intervals.h"

#include <stdlib.h>
#include <string.h>

enum { OPTION_SAMPLES, OPTION_VARIANTS, OPTION_FLIPS };

/// The study of a command, and the landings of the run that the others are compared with.
typedef struct noise {
    const bt_command* command;
    bt_study study;
    int64_t count;
    bt_noise_landing *base, *other;
    bt_json json;
} noise;

/// Whether a name stands in a list "a,b,c"; every name stands in no list at all.
static bool listed(const char* list, const char* name) {
    const size_t length = strlen(name);
    for (const char* at = list; at && *at; at += strcspn(at, ",") + (at[strcspn(at, ",")] == ','))
        if (strcspn(at, ",") == length && strncmp(at, name, length) == 0)
            return true;
    return !list;
}

/// Whether every name of a list is that of a variant; the first that is not is reported.
static bool all_known(const bt_command* command, const char* list) {
    for (const char* at = list; at && *at; at += strcspn(at, ",") + (at[strcspn(at, ",")] == ',')) {
        const int length = (int)strcspn(at, ",");
        const bt_noise_variant* variant = bt_noise_variants;
        while (variant->name && ((int)strlen(variant->name) != length ||
                                 strncmp(variant->name, at, (size_t)length) != 0))
            ++variant;
        if (!variant->name) {
            bt_usage_error(command, "--variants: there is no \"%.*s\"", length, at);
            return false;
        }
    }
    return true;
}

/// One run and its row; the first has no variant.
static void print_row(noise* n, const bt_noise_variant* variant, const bt_noise_difference* d) {
    const bt_interval flips = bt_clopper_pearson(d->flips, n->count, 0.95);
    const bt_interval wrong = bt_clopper_pearson(d->wrong_side, n->count, 0.95);
    if (n->command->json) {
        bt_json* json = &n->json;
        bt_json_begin_object(json, NULL);
        bt_json_string(json, "name", variant ? variant->name : "as_set");
        bt_json_integer(json, "flips", d->flips);
        bt_json_number(json, "flips_least", flips.least);
        bt_json_number(json, "flips_greatest", flips.greatest);
        bt_json_integer(json, "wrong_side", d->wrong_side);
        bt_json_number(json, "wrong_side_greatest", wrong.greatest);
        bt_json_integer(json, "failed", d->failed);
        bt_json_number(json, "margin_median_m", d->margin_median_m);
        bt_json_number(json, "margin_p90_m", d->margin_p90_m);
        bt_json_number(json, "margin_p99_m", d->margin_p99_m);
        bt_json_number(json, "wall_s", d->wall_s);
        bt_json_end_object(json);
        return;
    }
    char changed[96] = "-", moved[64] = "-";
    if (variant) {
        snprintf(changed, sizeof changed, "%lld: %.2f %% (%.2f to %.2f)", (long long)d->flips,
                 100 * (double)d->flips / (double)n->count, 100 * flips.least,
                 100 * flips.greatest);
        snprintf(moved, sizeof moved, "%.2f, %.2f, %.2f", 1e3 * d->margin_median_m,
                 1e3 * d->margin_p90_m, 1e3 * d->margin_p99_m);
    }
    printf("| %s | %s | %s | %lld: %.2f %% (to %.2f) | %lld | %.1f |\n",
           variant ? variant->text : "as the study sets it", changed, moved,
           (long long)d->wrong_side, 100 * (double)d->wrong_side / (double)n->count,
           100 * wrong.greatest, (long long)d->failed, 1e3 * d->wall_s);
    fflush(stdout);
}

/// The landings that changed, one line each, on stderr.
static void print_flips(const noise* n, const bt_noise_variant* variant) {
    for (int64_t i = 0; i < n->count; ++i) {
        const bt_noise_landing *a = &n->base[i], *b = &n->other[i];
        if (a->outcome == b->outcome)
            continue;
        fprintf(stderr, "%s: landing %lld: %s (%s, %.2f mm) -> %s (%s, %.2f mm)", variant->name,
                (long long)i, bt_outcome_name(a->outcome), bt_mode_name(a->mode), 1e3 * a->margin_m,
                bt_outcome_name(b->outcome), bt_mode_name(b->mode), 1e3 * b->margin_m);
        for (int k = 0, axis = 0; k < n->study.input_count; ++k) {
            const bt_input* input = &n->study.inputs[k];
            char text[64];
            if (!input->random)
                continue;
            bt_unit_print(a->x[axis++], input->field->unit[0] ? input->field->unit : "1", text,
                          sizeof text);
            fprintf(stderr, ", %s %s", input->field->name, text);
        }
        fprintf(stderr, "\n");
    }
}

static void print_head(noise* n) {
    if (n->command->json) {
        n->json.out = stdout;
        bt_json_begin_object(&n->json, NULL);
        bt_json_integer(&n->json, "landings", n->count);
        bt_json_integer(&n->json, "seed", n->study.campaign.seed);
        bt_json_begin_array(&n->json, "runs");
        return;
    }
    const bt_model_params* model = &n->study.model;
    const bt_cable_mesh_params* mesh = &model->deck.cable.mesh;
    const bt_solver_params* solver = &model->landing.solver;
    printf(
        "# Label noise\n\n"
        "%lld landings of \"%s\", drawn from its distributions with seed %lld. Written by "
        "`bolter noise`.\n\n"
        "As the study sets it: segments %g, %g and %g m, airframe steps %g and %g us, cable step "
        "%g of the stable one, %lld strips, hook on cable slip_speed %g m/s.\n"
        "Shares with 95 %% Clopper-Pearson bounds. Constraints are projected to rounding at "
        "every step: there is no setting of that to vary.\n\n"
        "| computation | outcomes changed | margin moved: 50, 90, 99 %%, mm | margin on the "
        "wrong side | failed | ms per landing |\n| --- | --- | --- | --- | --- | --- |\n",
        (long long)n->count, n->study.title, (long long)n->study.campaign.seed, mesh->fine_length_m,
        mesh->medium_length_m, mesh->coarse_length_m, 1e6 * solver->airframe_step_s,
        1e6 * solver->contact_step_s, solver->cable_courant, (long long)solver->tyre_strips,
        model->aircraft.hook.cable_contact.slip_speed_mps);
}

static bt_status run_variant(noise* n, const bt_noise_variant* variant, bt_diag* diag) {
    bt_noise_landing* landings = variant ? n->other : n->base;
    bt_noise_difference difference;
    BT_TRY(bt_noise_run(&n->study, variant, n->count, (int)n->study.campaign.threads,
                        &bt_interrupted, landings, diag));
    BT_TRY(bt_noise_check_failed(&n->study, landings, n->count, diag));
    BT_TRY(bt_noise_compare(n->base, landings, n->count, &difference));
    print_row(n, variant, &difference);
    if (variant && n->command->option[OPTION_FLIPS])
        print_flips(n, variant);
    return BT_OK;
}

static bt_status run_all(noise* n) {
    bt_diag diag = bt_stderr_diag();
    n->base = calloc((size_t)n->count, sizeof *n->base);
    n->other = calloc((size_t)n->count, sizeof *n->other);
    if (!n->base || !n->other)
        return BT_ERR_MEMORY;
    print_head(n);
    bt_status status = run_variant(n, NULL, &diag);
    for (const bt_noise_variant* v = bt_noise_variants; v->name && status == BT_OK; ++v)
        if (listed(n->command->option[OPTION_VARIANTS], v->name))
            status = run_variant(n, v, &diag);
    if (n->command->json) {
        bt_json_end_array(&n->json);
        bt_json_end_object(&n->json);
    }
    return status;
}

static bt_status run(const bt_command* command) {
    noise n = {.command = command, .count = 2000};
    const char* samples = command->option[OPTION_SAMPLES];
    if (samples && !bt_whole_number(command, "--samples", samples, 1, &n.count))
        return BT_ERR_ARG;
    if (!all_known(command, command->option[OPTION_VARIANTS]))
        return BT_ERR_ARG;
    if (n.count > 1000000)
        return bt_usage_error(command, "--samples: at most 1000000");
    BT_TRY(bt_command_study(command, &n.study));
    const bt_status status = run_all(&n);
    free(n.base);
    free(n.other);
    bt_study_destroy(&n.study);
    return status;
}

static const struct argp_option options[] = {
    {"samples", BT_OPTION + OPTION_SAMPLES, "N", 0, "landings per computation (2000)", 1},
    {"variants", BT_OPTION + OPTION_VARIANTS, "A,B", 0,
     "only these of steps_halved, segments_doubled, strips_doubled, all_refined, steps_doubled, "
     "segments_coarser",
     1},
    {"flips", BT_OPTION + OPTION_FLIPS, 0, 0, "name every landing that changed, on stderr", 1},
    {0},
};

const bt_verb bt_verb_noise = {
    .name = "noise",
    .summary = "how many outcomes change when steps, segments or strips are refined",
    .arguments = "STUDY.yaml",
    .text = "Draws landings from the study's distributions and runs each of them as the study sets "
            "it and with refined (or coarser) computations. Prints a Markdown table: the share of "
            "outcomes that changed, how far the margin moved, the share of landings whose margin "
            "has the wrong sign, and the mean time of a landing.\n\n"
            "  bolter noise studies/reference/study.yaml > docs/label-noise.md",
    .options = options,
    .least_words = 1,
    .most_words = 1,
    .run = run,
};
