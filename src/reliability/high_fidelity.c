#include "reliability/high_fidelity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct bt_high_fidelity {
    const bt_study* study;
    bt_axes inputs; ///< all of them
    int threads;
    const atomic_int* stop;
    const bt_backend* backend;
    int64_t runs, failed; ///< so far; of them without an outcome
    int64_t first_failed; ///< number of the earliest of those
    char reason[160];     ///< its own
};

bt_status bt_high_fidelity_create(const bt_study* study, int threads, const atomic_int* stop,
                                  const bt_backend* backend, bt_high_fidelity** made) {
    bt_high_fidelity* h = *made = calloc(1, sizeof *h);
    if (!h)
        return BT_ERR_MEMORY;
    h->study = study;
    h->threads = threads;
    h->stop = stop;
    h->backend = backend;
    h->inputs.count = study->input_count;
    for (int i = 0; i < study->input_count; ++i)
        h->inputs.input[i] = i;
    return BT_OK;
}

void bt_high_fidelity_destroy(bt_high_fidelity* high_fidelity) {
    free(high_fidelity);
}

/// Points on their way through the executor.
typedef struct batch {
    bt_high_fidelity* high_fidelity;
    const double* x;
    int dims, count, next;
    int* label;
} batch;

static bool give(void* user, bt_job* job) {
    batch* b = user;
    if (b->next == b->count)
        return false;
    job->run = b->next++;
    memcpy(job->x, b->x + job->run * b->dims, (size_t)b->dims * sizeof *job->x);
    return true;
}

/// Keeps the reason of the earliest failure, in whatever order they come.
static void note_failure(bt_high_fidelity* h, int64_t run, const bt_landing_result* result) {
    if (h->failed++ > 0 && run > h->first_failed)
        return;
    h->first_failed = run;
    snprintf(h->reason, sizeof h->reason, "%s: %s", result->failed_element,
             result->failed_quantity);
}

static bt_status take(void* user, const bt_job* job, const bt_landing_result* result) {
    const batch* b = user;
    if (result->outcome == BT_FAILED)
        note_failure(b->high_fidelity, b->high_fidelity->runs + job->run, result);
    b->label[job->run] = result->outcome == BT_FAILED ? -1 : result->outcome == BT_ENGAGED;
    return BT_OK;
}

bt_status bt_high_fidelity_run(void* high_fidelity, const double* x, int n, int* label) {
    bt_high_fidelity* h = high_fidelity;
    batch b = {.high_fidelity = h, .x = x, .dims = h->inputs.count, .count = n, .label = label};
    const bt_executor executor = {.model = &h->study->model,
                                  .inputs = h->study->inputs,
                                  .axes = &h->inputs,
                                  .threads = h->threads,
                                  .stop = h->stop,
                                  .source = give,
                                  .sink = take,
                                  .user = &b,
                                  .backend = h->backend};
    const bt_status status = bt_executor_run(&executor, NULL);
    h->runs += n;
    return status;
}

bt_status bt_high_fidelity_check_failed(const bt_high_fidelity* h, bt_diag* diag) {
    const double allowed = h->study->campaign.max_failed;
    if ((double)h->failed <= allowed * (double)h->runs)
        return BT_OK;
    bt_diag_add(
        diag, BT_ERROR, BT_NOWHERE,
        "%lld of %lld high-fidelity runs failed, more than campaign.max_failed = %g allows; "
        "the first: %s",
        (long long)h->failed, (long long)h->runs, allowed, h->reason);
    return BT_ERR_FAILED_RUNS;
}

/* ---- without a surrogate ---- */

enum { BATCH = 1024 };

bt_status bt_direct_monte_carlo(const bt_sampler* sampler, bt_high_fidelity_batch* high_fidelity,
                                void* user, int64_t samples, bt_direct_result* result) {
    *result = (bt_direct_result){0};
    double* x = malloc((size_t)BATCH * (size_t)sampler->dims * sizeof *x);
    int* label = malloc(BATCH * sizeof *label);
    bt_status status = x && label ? BT_OK : BT_ERR_MEMORY;
    for (int64_t at = 0; at < samples && status == BT_OK; at += BATCH) {
        const int n = samples - at < BATCH ? (int)(samples - at) : BATCH;
        bt_sampler_draw(sampler, (uint64_t)at, n, x);
        status = high_fidelity(user, x, n, label);
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
