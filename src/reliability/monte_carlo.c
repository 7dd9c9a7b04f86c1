#include "reliability/monte_carlo.h"

#include "base/threads.h"

#include <stdlib.h>
#include <string.h>

enum {
    BATCH = 1024,    ///< samples drawn and labelled together
    TASK = 65536,    ///< samples per task: a multiple of BATCH
    ROUND = 1 << 20, ///< tasks per call of bt_tasks_run
};

typedef struct scratch {
    double x[BATCH * BT_INPUT_MAX];
    int8_t label[BATCH];
    float decision[BATCH];
    bt_tally tally;
} scratch;

typedef struct job {
    const bt_sampler* sampler;
    const bt_classifier* classifier;
    const bt_pool* pool;
    int64_t samples, first; ///< first sample of task 0
    scratch* scratch;       ///< one per worker
} job;

static bool is_outside(const bt_classifier* c, const double* x, int dims) {
    if (!c->boxed)
        return false;
    bool outside = false;
    for (int k = 0; k < dims; ++k)
        outside |= x[k] < c->least[k] || x[k] > c->greatest[k];
    return outside;
}

static void run_batch(const job* j, scratch* s, int64_t first, int n) {
    const int dims = j->sampler->dims;
    bt_sampler_draw(j->sampler, (uint64_t)first, n, s->x);
    j->classifier->classify(j->classifier->user, s->x, n, s->label, s->decision);
    s->tally.samples += n;
    for (int i = 0; i < n; ++i) {
        const int engaged = s->label[i] > 0,
                  outside = is_outside(j->classifier, s->x + i * dims, dims);
        s->tally.engaged += engaged;
        s->tally.outside += outside;
        s->tally.outside_engaged += engaged & outside;
    }
    if (!j->pool || first >= j->pool->count)
        return;
    const int64_t left = j->pool->count - first, kept = left < n ? left : n;
    memcpy(j->pool->label + first, s->label, (size_t)kept * sizeof *s->label);
    if (j->pool->decision)
        memcpy(j->pool->decision + first, s->decision, (size_t)kept * sizeof *s->decision);
}

static bt_status run_task(void* user, int task, int worker) {
    const job* j = user;
    const int64_t begin = j->first + (int64_t)task * TASK;
    const int64_t end = begin + TASK < j->samples ? begin + TASK : j->samples;
    for (int64_t at = begin; at < end; at += BATCH)
        run_batch(j, &j->scratch[worker], at, (int)(end - at < BATCH ? end - at : BATCH));
    return BT_OK;
}

/// Samples first .. end - 1.
static bt_status run_range(const bt_sampler* sampler, const bt_classifier* classifier,
                           int64_t first, int64_t end, int threads, const bt_pool* pool,
                           bt_tally* tally) {
    *tally = (bt_tally){0};
    threads = bt_thread_count(threads);
    job j = {sampler, classifier, pool, end, first, calloc((size_t)threads, sizeof(scratch))};
    if (!j.scratch)
        return BT_ERR_MEMORY;
    bt_status status = BT_OK;
    while (j.first < end && status == BT_OK) {
        const int64_t tasks = (end - j.first + TASK - 1) / TASK;
        const int count = tasks < ROUND ? (int)tasks : ROUND;
        status = bt_tasks_run(threads, count, run_task, &j);
        j.first += (int64_t)count * TASK;
    }
    for (int i = 0; i < threads; ++i) {
        const bt_tally* part = &j.scratch[i].tally;
        tally->samples += part->samples;
        tally->engaged += part->engaged;
        tally->outside += part->outside;
        tally->outside_engaged += part->outside_engaged;
    }
    free(j.scratch);
    return status;
}

bt_status bt_monte_carlo(const bt_sampler* sampler, const bt_classifier* classifier,
                         int64_t samples, int threads, const bt_pool* pool, bt_tally* tally) {
    return run_range(sampler, classifier, 0, samples, threads, pool, tally);
}

bt_status bt_monte_carlo_range(const bt_sampler* sampler, const bt_classifier* classifier,
                               int64_t first, int64_t samples, int threads, const bt_pool* pool,
                               int64_t* engaged) {
    bt_tally tally;
    const bt_status status =
        run_range(sampler, classifier, first, first + samples, threads, pool, &tally);
    *engaged = tally.engaged;
    return status;
}
