#include "report/noise_report.h"

#include "base/units.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "cluster/cluster.h"

#include <string.h>

enum { OPTION_SAMPLES, OPTION_VARIANTS, OPTION_FLIPS, VARIANTS_MAX = 16 };

/// The study of a command, and its table as it grows.
typedef struct noise {
    const bt_command* command;
    bt_study study;
    int64_t count;
    bool wanted[VARIANTS_MAX];
    int done, total; ///< computations
    bt_report_table* table;
    bt_progress progress;
} noise;

/// Notes which variants a list "a,b,c" names (all, without one); the first that there is not is
/// reported.
static bool read_variants(noise* n, const char* list) {
    for (int i = 0; bt_noise_variants[i].name; ++i)
        n->total += n->wanted[i] = !list;
    for (const char* at = list; at && *at; at += strcspn(at, ","), at += *at == ',') {
        const size_t length = strcspn(at, ",");
        int i = 0;
        while (bt_noise_variants[i].name && (strlen(bt_noise_variants[i].name) != length ||
                                             strncmp(bt_noise_variants[i].name, at, length) != 0))
            ++i;
        if (!bt_noise_variants[i].name) {
            bt_usage_error(n->command, "--variants: there is no \"%.*s\"", (int)length, at);
            return false;
        }
        n->total += !n->wanted[i];
        n->wanted[i] = true;
    }
    return true;
}

/// The landings that changed, one line each, on stderr.
static void print_flips(const noise* n, const bt_noise_variant* variant,
                        const bt_noise_landing* base, const bt_noise_landing* other) {
    for (int64_t i = 0; i < n->count; ++i) {
        const bt_noise_landing *a = &base[i], *b = &other[i];
        if (a->outcome == b->outcome && a->wire == b->wire)
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

static bt_status take_computation(void* user, const bt_noise_variant* variant,
                                  const bt_noise_landing* base, const bt_noise_landing* landings,
                                  const bt_noise_difference* difference) {
    noise* n = user;
    bt_noise_table_add(n->table, variant, n->count, difference);
    ++n->done;
    bt_progress_show(&n->progress, n->done == n->total, "%d of %d computations", n->done, n->total);
    if (variant && n->command->option[OPTION_FLIPS])
        print_flips(n, variant, base, landings);
    return BT_OK;
}

static bt_status print_text(const noise* n) {
    const bt_model_params* model = &n->study.model;
    const bt_cable_mesh_params* mesh = &model->deck.cable.mesh;
    const bt_solver_params* solver = &model->landing.solver;
    char count[32];
    printf("# Label noise\n\n"
           "%s landings of \"%s\", drawn from its distributions with seed %lld. Written by "
           "`bolter noise`.\n\n"
           "As the study sets it: segments %g, %g and %g m, airframe steps %g and %g us, cable "
           "step %g of the stable one, %lld strips, hook on cable slip_speed %g m/s.\n"
           "Shares with 95 %% Clopper-Pearson limits. Constraints are projected to rounding at "
           "every step: there is no setting of that to vary.\n\n",
           bt_count_text(n->count, count), n->study.title, (long long)n->study.campaign.seed,
           mesh->fine_length_m, mesh->medium_length_m, mesh->coarse_length_m,
           1e6 * solver->airframe_step_s, 1e6 * solver->contact_step_s, solver->cable_courant,
           (long long)solver->tyre_strips, model->aircraft.hook.cable_contact.slip_speed_mps);
    return bt_report_table_markdown(n->table, stdout);
}

static bt_status print_json(const noise* n) {
    bt_json json = {.out = stdout};
    bt_json_begin_object(&json, NULL);
    bt_json_integer(&json, "landings", n->count);
    bt_json_integer(&json, "seed", n->study.campaign.seed);
    BT_TRY(bt_report_table_json(n->table, &json, "runs"));
    bt_json_end_object(&json);
    return BT_OK;
}

static bt_status measure(noise* n) {
    bt_diag diag = bt_stderr_diag();
    const bt_noise_stage stage = {.count = n->count,
                                  .threads = (int)n->study.campaign.threads,
                                  .stop = &bt_interrupted,
                                  .backend = bt_cluster_backend(),
                                  .wanted = n->wanted,
                                  .sink = take_computation,
                                  .user = n};
    n->progress = bt_progress_start("noise", n->command->quiet);
    BT_TRY(bt_stage_noise(&n->study, &stage, &diag));
    BT_TRY(bt_output_table(n->command, n->table, &diag));
    return n->command->json ? print_json(n) : print_text(n);
}

static bt_status run_noise(const bt_command* command) {
    noise n = {.command = command, .count = 2000, .total = 1};
    const char* samples = command->option[OPTION_SAMPLES];
    if (samples && !bt_whole_number(command, "--samples", samples, 1, &n.count))
        return BT_ERR_ARG;
    if (!read_variants(&n, command->option[OPTION_VARIANTS]))
        return BT_ERR_ARG;
    if (n.count > 1000000)
        return bt_usage_error(command, "--samples: at most 1000000");
    BT_TRY(bt_command_study(command, &n.study));
    n.table = bt_noise_table_create();
    const bt_status status = measure(&n);
    bt_report_table_destroy(n.table);
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
            "  bolter noise studies/reference/study.yaml > docs/label-noise.md\n"
            "  bolter noise study.yaml -o noise.csv     the table as CSV too, SI",
    .options = options,
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_TABLE,
    .run = run_noise,
};
