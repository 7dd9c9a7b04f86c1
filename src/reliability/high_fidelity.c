#include "reliability/high_fidelity.h"

#include "base/tasks.h"
#include "campaign/executor.h"

#include <math.h>
#include <stdlib.h>

/// What one thread needs for its landings.
typedef struct seat {
    bt_lander* lander;
    bt_model_params model;
} seat;

struct bt_high_fidelity {
    const bt_study* study;
    bt_axes inputs; ///< all of them
    int threads;
    const atomic_int* stop;
    seat* seats;
};

bt_status bt_high_fidelity_create(const bt_study* study, int threads, const atomic_int* stop,
                                  bt_high_fidelity** truth) {
    bt_high_fidelity* t = calloc(1, sizeof *t);
    *truth = NULL;
    if (!t)
        return BT_ERR_MEMORY;
    t->study = study;
    t->threads = bt_tasks_threads(threads);
    t->stop = stop;
    t->inputs.count = study->input_count;
    for (int i = 0; i < study->input_count; ++i)
        t->inputs.input[i] = i;
    t->seats = calloc((size_t)t->threads, sizeof *t->seats);
    bt_status status = t->seats ? BT_OK : BT_ERR_MEMORY;
    for (int i = 0; i < t->threads && status == BT_OK; ++i) {
        t->seats[i].model = study->model;
        status = bt_lander_create(&t->seats[i].lander);
    }
    if (status == BT_OK)
        *truth = t;
    else
        bt_high_fidelity_destroy(t);
    return status;
}

void bt_high_fidelity_destroy(bt_high_fidelity* truth) {
    if (!truth)
        return;
    for (int i = 0; truth->seats && i < truth->threads; ++i)
        bt_lander_destroy(truth->seats[i].lander);
    free(truth->seats);
    free(truth);
}

typedef struct batch {
    const bt_high_fidelity* truth;
    const double* x;
    int* label;
} batch;

static bt_status run_point(void* user, int point, int worker) {
    const batch* b = user;
    const bt_high_fidelity* t = b->truth;
    if (t->stop && atomic_load(t->stop))
        return BT_ERR_INTERRUPTED;
    seat* s = &t->seats[worker];
    const double* x = b->x + (size_t)point * (size_t)t->inputs.count;
    bt_landing_result result;
    BT_TRY(bt_landing_at(s->lander, &s->model, t->study->inputs, &t->inputs, x, &result, NULL, NULL,
                         NULL));
    b->label[point] = result.outcome == BT_FAILED ? -1 : result.outcome == BT_ENGAGED;
    return BT_OK;
}

bt_status bt_high_fidelity_run(void* truth, const double* x, int n, int* label) {
    const bt_high_fidelity* t = truth;
    batch b = {t, x, label};
    return bt_tasks_run(t->threads, n, run_point, &b);
}

/* ---- the referee ---- */

enum { BATCH = 1024 };

bt_status bt_direct_monte_carlo(const bt_sampler* sampler, bt_high_fidelity_batch* truth,
                                void* user, int64_t samples, bt_direct_result* result) {
    *result = (bt_direct_result){0};
    double* x = malloc((size_t)BATCH * (size_t)sampler->dims * sizeof *x);
    int* label = malloc(BATCH * sizeof *label);
    bt_status status = x && label ? BT_OK : BT_ERR_MEMORY;
    for (int64_t at = 0; at < samples && status == BT_OK; at += BATCH) {
        const int n = samples - at < BATCH ? (int)(samples - at) : BATCH;
        bt_sampler_draw(sampler, (uint64_t)at, n, x);
        status = truth(user, x, n, label);
        for (int i = 0; i < n && status == BT_OK; ++i) {
            result->engaged += label[i] == 1;
            result->failed += label[i] < 0;
            ++result->samples;
        }
    }
    free(x);
    free(label);
    const int64_t done = result->samples - result->failed;
    result->probability = done > 0 ? (double)result->engaged / (double)done : NAN;
    result->ci95.least = bt_clopper_pearson(result->engaged, result->samples, 0.95).least;
    result->ci95.greatest =
        bt_clopper_pearson(result->engaged + result->failed, result->samples, 0.95).greatest;
    return status;
}
