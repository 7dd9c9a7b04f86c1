#include "base/threads.h"
#include "campaign/backend.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/// What one thread needs for its landings.
typedef struct scratch {
    bt_lander* lander;
    bt_model_params model;
} scratch;

/// Jobs and results, all of it under one lock. Neither queue can be full: together they hold no
/// more than `room`.
typedef struct threads {
    const bt_executor* executor;
    bt_workers* workers;
    scratch* scratch;
    int count, room;
    atomic_int abandoned;
    pthread_mutex_t lock;
    pthread_cond_t job_there, result_there;
    bool closed;
    bt_job* jobs; ///< [room] ring
    int first_job, job_count;
    bt_finished* results; ///< [room] ring
    int first_result, result_count;
} threads;

static bool stop_asked(const threads* t) {
    return t->executor->stop && atomic_load(t->executor->stop) != 0;
}

/// The next job; waits for one. False when there will be none.
static bool take_job(threads* t, bt_job* job) {
    pthread_mutex_lock(&t->lock);
    while (!t->closed && (t->job_count == 0 || stop_asked(t)))
        pthread_cond_wait(&t->job_there, &t->lock);
    const bool taken = !t->closed;
    if (taken) {
        *job = t->jobs[t->first_job];
        t->first_job = (t->first_job + 1) % t->room;
        --t->job_count;
    }
    pthread_mutex_unlock(&t->lock);
    return taken;
}

static void deliver(threads* t, const bt_finished* finished) {
    pthread_mutex_lock(&t->lock);
    t->results[(t->first_result + t->result_count++) % t->room] = *finished;
    pthread_cond_signal(&t->result_there);
    pthread_mutex_unlock(&t->lock);
}

static void work(void* user, int worker) {
    threads* t = user;
    const bt_executor* e = t->executor;
    scratch* s = &t->scratch[worker];
    bt_finished done;
    memset(&done, 0, sizeof done);
    while (take_job(t, &done.job)) {
        void* observed = e->observed ? e->observed(e->user, &done.job) : e->user;
        done.status = bt_landing_at(s->lander, &s->model, e->inputs, e->axes, done.job.x,
                                    &done.result, e->observer, observed);
        deliver(t, &done);
    }
}

static void close_threads(void* state) {
    threads* t = state;
    if (!t)
        return;
    pthread_mutex_lock(&t->lock);
    t->closed = true;
    pthread_cond_broadcast(&t->job_there);
    pthread_mutex_unlock(&t->lock);
    bt_workers_join(t->workers);
    for (int i = 0; t->scratch && i < t->count; ++i)
        bt_lander_destroy(t->scratch[i].lander);
    pthread_cond_destroy(&t->result_there);
    pthread_cond_destroy(&t->job_there);
    pthread_mutex_destroy(&t->lock);
    free(t->scratch);
    free(t->jobs);
    free(t->results);
    free(t);
}

static void prepare_locks(threads* t) {
    pthread_condattr_t monotonic;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_mutex_init(&t->lock, NULL);
    pthread_cond_init(&t->job_there, NULL);
    pthread_cond_init(&t->result_there, &monotonic);
    pthread_condattr_destroy(&monotonic);
}

static bt_status prepare_scratch(threads* t) {
    t->scratch = calloc((size_t)t->count, sizeof *t->scratch);
    t->jobs = calloc((size_t)t->room, sizeof *t->jobs);
    t->results = calloc((size_t)t->room, sizeof *t->results);
    if (!t->scratch || !t->jobs || !t->results)
        return BT_ERR_MEMORY;
    for (int i = 0; i < t->count; ++i) {
        t->scratch[i].model = *t->executor->model;
        BT_TRY(bt_lander_create(&t->scratch[i].lander));
        bt_lander_obey(t->scratch[i].lander, &t->abandoned);
    }
    return BT_OK;
}

static bt_status open_threads(const bt_executor* executor, void** state, int* room, bt_diag* diag) {
    threads* t = calloc(1, sizeof *t);
    *state = NULL;
    if (!t)
        return BT_ERR_MEMORY;
    t->executor = executor;
    t->count = bt_thread_count(executor->threads);
    *room = t->room = BT_JOBS_PER_THREAD * t->count;
    prepare_locks(t);
    bt_status status = prepare_scratch(t);
    if (status == BT_OK) {
        status = bt_workers_start(t->count, work, t, &t->workers);
        if (status != BT_OK)
            bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "cannot start a thread");
    }
    if (status == BT_OK)
        *state = t;
    else
        close_threads(t);
    return status;
}

static void submit(void* state, const bt_job* job) {
    threads* t = state;
    pthread_mutex_lock(&t->lock);
    t->jobs[(t->first_job + t->job_count++) % t->room] = *job;
    pthread_cond_signal(&t->job_there);
    pthread_mutex_unlock(&t->lock);
}

static struct timespec after(double wait_s) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    t.tv_sec += (time_t)wait_s;
    t.tv_nsec += (long)(1e9 * (wait_s - floor(wait_s)));
    t.tv_sec += t.tv_nsec / 1000000000;
    t.tv_nsec %= 1000000000;
    return t;
}

static int receive(void* state, bt_finished* finished, int most, double wait_s) {
    threads* t = state;
    const struct timespec deadline = after(wait_s);
    int count = 0, waited = 0;
    pthread_mutex_lock(&t->lock);
    while (t->result_count == 0 && waited == 0)
        waited = pthread_cond_timedwait(&t->result_there, &t->lock, &deadline);
    for (; count < most && t->result_count > 0; ++count) {
        finished[count] = t->results[t->first_result];
        t->first_result = (t->first_result + 1) % t->room;
        --t->result_count;
    }
    pthread_mutex_unlock(&t->lock);
    return count;
}

static int cancel(void* state, bool abandon) {
    threads* t = state;
    pthread_mutex_lock(&t->lock);
    const int forgotten = t->job_count;
    t->job_count = 0;
    pthread_mutex_unlock(&t->lock);
    if (abandon)
        atomic_store(&t->abandoned, 1);
    return forgotten;
}

const bt_backend bt_thread_backend = {
    .name = "threads",
    .open = open_threads,
    .submit = submit,
    .receive = receive,
    .cancel = cancel,
    .close = close_threads,
};
