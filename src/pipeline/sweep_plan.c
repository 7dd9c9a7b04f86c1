#include "pipeline/sweep.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const bt_sweep_plan bt_paper_sweeps[BT_PAPER_SWEEPS] = {
    {"fig14", "landing.sink_speed", "3.6 m/s, 4 m/s, 5 m/s, 6.3 m/s",
     "Hook bounce and sinking velocity", " (Fig. 14)", "paper, 6.3 m/s: 53 mm, at most 4 m",
     "paper, 6.3 m/s", 0.053, 4},
    {"fig15", "landing.pitch", "0 deg, 2 deg, 4 deg, 6 deg, 8 deg", "Hook bounce and pitch angle",
     " (Fig. 15)", "paper, 8 deg: 81 mm, 4.57 m", "paper, 8 deg", 0.081, 4.57},
    {"fig16", "landing.horizontal_speed", "40 m/s, 45 m/s, 50 m/s, 55 m/s",
     "Hook bounce and horizontal velocity", " (Fig. 16)", NULL, NULL, 0, 0},
};

bt_sweep_plan bt_sweep_plan_of(const char* key, const char* values) {
    bt_sweep_plan plan = {.key = key, .values = values};
    snprintf(plan.name, sizeof plan.name, "sweep_%s", key);
    for (char* c = plan.name; *c; ++c)
        if (!isalnum((unsigned char)*c))
            *c = '_';
    return plan;
}

bt_bounce bt_first_bounce(const bt_landing_result* result) {
    if (result->bounce_count > 0 && result->bounces[0].complete)
        return result->bounces[0];
    return (bt_bounce){.height_m = NAN, .distance_m = NAN, .impact_force_N = NAN};
}

static bt_status run_plan(const bt_model_params* model, const bt_sweep_plan* plan, int threads,
                          const atomic_int* stop, bt_sweep* sweep, bt_diag* diag) {
    const bt_field* field = NULL;
    double values[BT_SWEEP_VALUES_MAX];
    size_t offset;
    int count = 0;
    BT_TRY(bt_sweep_find(model, plan->key, &field, &offset, diag));
    BT_TRY(bt_sweep_values(field, plan->key, plan->values, values, &count, diag));
    return bt_sweep_run(model, plan->key, values, count, threads, stop, sweep, diag);
}

bt_status bt_stage_sweep(const bt_study* study, const bt_sweep_plan* plan, const atomic_int* stop,
                         bt_sweep* sweep, bt_diag* diag) {
    bt_model_params* model = malloc(sizeof *model);
    if (!model)
        return BT_ERR_MEMORY;
    *model = study->model;
    if (strcmp(plan->key, "landing.distance") != 0 &&
        model->landing.distance_m < BT_CLEAR_DISTANCE_M)
        model->landing.distance_m = BT_CLEAR_DISTANCE_M;
    const bt_status status = run_plan(model, plan, (int)study->campaign.threads, stop, sweep, diag);
    free(model);
    return status;
}
