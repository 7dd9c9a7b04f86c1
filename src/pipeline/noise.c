#include "pipeline/noise.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define STEPS(factor)                                                                              \
    {"landing.solver.airframe_step", factor}, {                                                    \
        "landing.solver.contact_step", factor                                                      \
    }
#define SEGMENTS(factor)                                                                           \
    {"deck.cable.mesh.fine_length", factor}, {"deck.cable.mesh.medium_length", factor}, {          \
        "deck.cable.mesh.coarse_length", factor                                                    \
    }
#define COURANT(factor)                                                                            \
    { "landing.solver.cable_courant", factor }
#define STRIPS(factor)                                                                             \
    { "landing.solver.tyre_strips", factor }

const bt_noise_variant bt_noise_variants[] = {
    {"steps_halved", "all steps halved: airframe, contact, cable", {STEPS(0.5), COURANT(0.5)}},
    {"segments_doubled", "all segments of the cable half as long", {SEGMENTS(0.5)}},
    {"strips_doubled", "twice the strips of the tyres", {STRIPS(2)}},
    {"all_refined",
     "steps halved, segments doubled, strips doubled",
     {STEPS(0.5), SEGMENTS(0.5), STRIPS(2)}},
    {"steps_doubled", "airframe and contact steps doubled: the reserve", {STEPS(2)}},
    {"segments_coarser", "segments half as long again: the reserve", {SEGMENTS(1.5)}},
    {0},
};

/// One set of landings on its way through the executor.
typedef struct work {
    bt_design* design;
    int64_t next, count;
    bt_noise_landing* landings;
} work;

static bool give(void* user, bt_job* job) {
    work* w = user;
    if (w->next == w->count)
        return false;
    job->run = w->next++;
    bt_design_point(w->design, job->run, job->x);
    return true;
}

static bt_status take(void* user, const bt_job* job, const bt_landing_result* result) {
    const work* w = user;
    bt_noise_landing* landing = &w->landings[job->run];
    *landing = (bt_noise_landing){.outcome = result->outcome,
                                  .mode = result->mode,
                                  .wire = result->wire,
                                  .margin_m = result->margin_m,
                                  .wall_s = result->wall_s};
    memcpy(landing->x, job->x, sizeof landing->x);
    if (result->outcome == BT_FAILED)
        snprintf(landing->failure, sizeof landing->failure, "%s: %s", result->failed_element,
                 result->failed_quantity);
    return BT_OK;
}

static void refine(const bt_noise_variant* variant, bt_model_params* model) {
    for (const bt_noise_change* change = variant->changes; change->path; ++change) {
        size_t offset;
        const bt_field* field = bt_params_find(&bt_model_group, model, change->path, &offset);
        bt_field_set(field, model, offset, change->factor * bt_field_get(field, model, offset));
    }
}

static bt_status run_landings(bt_study* study, int64_t count, int threads, const atomic_int* stop,
                              const bt_backend* backend, bt_noise_landing* landings,
                              bt_diag* diag) {
    work w = {.count = count, .landings = landings};
    BT_TRY(bt_design_create(study, &w.design, diag));
    const bt_executor executor = {.model = &study->model,
                                  .inputs = study->inputs,
                                  .axes = bt_design_get_axes(w.design),
                                  .threads = threads,
                                  .stop = stop,
                                  .source = give,
                                  .sink = take,
                                  .user = &w,
                                  .backend = backend};
    const bt_status status = bt_executor_run(&executor, diag);
    bt_design_destroy(w.design);
    return status;
}

bt_status bt_noise_run(const bt_study* given, const bt_noise_variant* variant, int64_t count,
                       int threads, const atomic_int* stop, const bt_backend* backend,
                       bt_noise_landing* landings, bt_diag* diag) {
    bt_study* study = malloc(sizeof *study); // a copy that owns nothing
    if (!study)
        return BT_ERR_MEMORY;
    *study = *given;
    study->campaign.design = BT_DESIGN_MONTE_CARLO;
    study->campaign.samples = count;
    if (variant)
        refine(variant, &study->model);
    const bt_status status = run_landings(study, count, threads, stop, backend, landings, diag);
    free(study);
    return status;
}

bt_status bt_noise_check_failed(const bt_study* study, const bt_noise_landing* landings,
                                int64_t count, bt_diag* diag) {
    int64_t failed = 0;
    const char* first = "";
    for (int64_t i = count - 1; i >= 0; --i)
        if (landings[i].outcome == BT_FAILED) {
            ++failed;
            first = landings[i].failure;
        }
    if ((double)failed <= study->campaign.max_failed * (double)count)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                "%lld of %lld landings failed, more than campaign.max_failed = %g allows; the "
                "first: %s",
                (long long)failed, (long long)count, study->campaign.max_failed, first);
    return BT_ERR_FAILED_RUNS;
}

double bt_noise_engaged_share(const bt_noise_landing* landings, int64_t count) {
    int64_t engaged = 0, known = 0;
    for (int64_t i = 0; i < count; ++i) {
        engaged += landings[i].outcome == BT_ENGAGED;
        known += landings[i].outcome != BT_FAILED;
    }
    return known > 0 ? (double)engaged / (double)known : NAN;
}

static int ascending(const void* a, const void* b) {
    const double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

/// The value that a share of the sorted values does not exceed.
static double percentile(const double* sorted, int64_t count, double share) {
    if (count == 0)
        return NAN;
    const int64_t at = (int64_t)ceil(share * (double)count) - 1;
    return sorted[at < 0 ? 0 : at];
}

bt_status bt_noise_compare(const bt_noise_landing* first, const bt_noise_landing* second,
                           int64_t count, bt_noise_difference* difference) {
    double* moved = malloc((size_t)(count > 0 ? count : 1) * sizeof *moved);
    if (!moved)
        return BT_ERR_MEMORY;
    bt_noise_difference d = {0};
    int64_t both = 0;
    for (int64_t i = 0; i < count; ++i) {
        const bt_noise_landing *a = &first[i], *b = &second[i];
        d.flips += a->outcome != b->outcome || a->wire != b->wire;
        d.failed += b->outcome == BT_FAILED;
        d.wrong_side += b->outcome != BT_FAILED && (b->margin_m > 0) != (b->outcome == BT_ENGAGED);
        d.wall_s += b->wall_s / (double)count;
        const double move = fabs(a->margin_m - b->margin_m);
        if (isfinite(move))
            moved[both++] = move;
    }
    qsort(moved, (size_t)both, sizeof *moved, ascending);
    d.margin_median_m = percentile(moved, both, 0.5);
    d.margin_p90_m = percentile(moved, both, 0.9);
    d.margin_p99_m = percentile(moved, both, 0.99);
    free(moved);
    *difference = d;
    return BT_OK;
}

static bt_status run_variant(const bt_study* study, const bt_noise_stage* stage,
                             const bt_noise_variant* variant, const bt_noise_landing* base,
                             bt_noise_landing* landings, bt_diag* diag) {
    bt_noise_difference difference;
    BT_TRY(bt_noise_run(study, variant, stage->count, stage->threads, stage->stop, stage->backend,
                        landings, diag));
    BT_TRY(bt_noise_check_failed(study, landings, stage->count, diag));
    BT_TRY(bt_noise_compare(base, landings, stage->count, &difference));
    return stage->sink(stage->user, variant, base, landings, &difference);
}

bt_status bt_stage_noise(const bt_study* study, const bt_noise_stage* stage, bt_diag* diag) {
    bt_noise_landing* base = calloc((size_t)stage->count, sizeof *base);
    bt_noise_landing* other = calloc((size_t)stage->count, sizeof *other);
    bt_status status = base && other ? BT_OK : BT_ERR_MEMORY;
    if (status == BT_OK)
        status = run_variant(study, stage, NULL, base, base, diag);
    for (int i = 0; bt_noise_variants[i].name && status == BT_OK; ++i)
        if (!stage->wanted || stage->wanted[i])
            status = run_variant(study, stage, &bt_noise_variants[i], base, other, diag);
    free(other);
    free(base);
    return status;
}
