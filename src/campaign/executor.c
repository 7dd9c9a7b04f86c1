#define _GNU_SOURCE /* sched_getaffinity */
#include "campaign/executor.h"

#include <math.h>
#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { QUEUE_LENGTH = 64, PULSE_MS = 200 };

typedef struct finished {
    bt_job job;
    bt_landing_result result;
} finished;

/// What the threads share, all of it under one lock.
typedef struct pool {
    const bt_executor* executor;
    pthread_mutex_t lock;
    pthread_cond_t not_empty, not_full;
    finished queue[QUEUE_LENGTH];
    int first, count;  ///< of the queue
    int working;       ///< threads that may still deliver
    bool closed;       ///< no more jobs are given out
    bool left_over;    ///< stopped while there was another job
    bt_status status;  ///< the first error
    char message[512]; ///< its text
} pool;

int bt_thread_count(int requested) {
    if (requested > 0)
        return requested;
    cpu_set_t cores;
    if (sched_getaffinity(0, sizeof cores, &cores) != 0)
        return 1;
    return CPU_COUNT(&cores);
}

/// Keeps the first message of a check.
typedef struct first_message {
    char text[512];
} first_message;

static void keep_first(void* user, bt_severity severity, bt_where where, const char* text) {
    first_message* first = user;
    (void)where;
    if (severity == BT_ERROR && !first->text[0])
        snprintf(first->text, sizeof first->text, "%s", text);
}

/// A point that the model does not allow is a failed run that names the key.
static void refuse_point(bt_landing_result* result, const char* message) {
    *result = (bt_landing_result){.outcome = BT_FAILED, .mode = BT_MODE_NONE};
    result->margin_m = NAN;
    result->time_of_contact_s = NAN;
    const int length = (int)strcspn(message, ":");
    snprintf(result->failed_element, sizeof result->failed_element, "%.*s", length, message);
    snprintf(result->failed_quantity, sizeof result->failed_quantity, "value not allowed");
}

bt_status bt_landing_at(bt_lander* lander, bt_model_params* model, const bt_input* inputs,
                        const bt_axes* axes, const double* x, bt_landing_result* result,
                        bt_landing_observer* observer, void* user, bt_diag* diag) {
    for (int i = 0; i < axes->count; ++i) {
        const bt_input* input = &inputs[axes->input[i]];
        bt_field_set(input->field, model, input->offset, x[i]);
    }
    first_message first = {""};
    bt_diag check = {.sink = keep_first, .user = &first};
    if (bt_group_check(&bt_model_group, model, "", &check) != BT_OK) {
        refuse_point(result, first.text);
        return BT_OK;
    }
    return bt_lander_run(lander, model, result, observer, user, diag);
}

/// The next job, or false: none left, stopped, or another thread met an error.
static bool take_job(pool* p, bt_job* job) {
    const bt_executor* e = p->executor;
    pthread_mutex_lock(&p->lock);
    bool taken = !p->closed && e->source(e->user, job);
    if (taken && e->stop && atomic_load(e->stop) != 0) {
        p->left_over = true;
        taken = false;
    }
    if (!taken)
        p->closed = true;
    pthread_mutex_unlock(&p->lock);
    return taken;
}

static void deliver(pool* p, const finished* done) {
    pthread_mutex_lock(&p->lock);
    while (p->count == QUEUE_LENGTH)
        pthread_cond_wait(&p->not_full, &p->lock);
    p->queue[(p->first + p->count++) % QUEUE_LENGTH] = *done;
    pthread_cond_signal(&p->not_empty);
    pthread_mutex_unlock(&p->lock);
}

/// Called with the lock held: remembers the first error and lets the threads run dry.
static void fail_locked(pool* p, bt_status status, const char* message) {
    if (p->status == BT_OK) {
        p->status = status;
        snprintf(p->message, sizeof p->message, "%s", message);
    }
    p->closed = true;
}

/// Work of one thread with what it owns; returns its first error.
static bt_status work(pool* p, bt_lander* lander, bt_model_params* model, bt_diag* diag) {
    const bt_executor* e = p->executor;
    finished done;
    memset(&done, 0, sizeof done);
    while (take_job(p, &done.job)) {
        BT_TRY(bt_landing_at(lander, model, e->inputs, e->axes, done.job.x, &done.result, NULL,
                             NULL, diag));
        deliver(p, &done);
    }
    return BT_OK;
}

static void* thread_main(void* argument) {
    pool* p = argument;
    first_message first = {""};
    bt_diag diag = {.sink = keep_first, .user = &first};
    bt_lander* lander = NULL;
    bt_model_params* model = malloc(sizeof *model);
    bt_status status = model ? bt_lander_create(&lander) : BT_ERR_MEMORY;
    if (status == BT_OK) {
        *model = *p->executor->model;
        status = work(p, lander, model, &diag);
    }
    bt_lander_destroy(lander);
    free(model);

    pthread_mutex_lock(&p->lock);
    if (status != BT_OK)
        fail_locked(p, status, first.text);
    --p->working;
    pthread_cond_signal(&p->not_empty);
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

static struct timespec after_ms(long ms) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    t.tv_nsec += ms * 1000000;
    t.tv_sec += t.tv_nsec / 1000000000;
    t.tv_nsec %= 1000000000;
    return t;
}

/// Waits for a result until the deadline; false when there is none yet, or no more will come.
static bool receive(pool* p, const struct timespec* deadline, finished* done, bool* over) {
    pthread_mutex_lock(&p->lock);
    int waited = 0;
    while (p->count == 0 && p->working > 0 && waited == 0)
        waited = pthread_cond_timedwait(&p->not_empty, &p->lock, deadline);
    const bool any = p->count > 0;
    if (any) {
        *done = p->queue[p->first];
        p->first = (p->first + 1) % QUEUE_LENGTH;
        --p->count;
        pthread_cond_signal(&p->not_full);
    }
    *over = !any && p->working == 0;
    pthread_mutex_unlock(&p->lock);
    return any;
}

static void fail(pool* p, bt_status status) {
    pthread_mutex_lock(&p->lock);
    fail_locked(p, status, "");
    pthread_mutex_unlock(&p->lock);
}

/// The calling thread's part: hands results to the sink until every thread has ended.
static void collect(pool* p) {
    const bt_executor* e = p->executor;
    bool over = false, good = true;
    struct timespec next_pulse = after_ms(PULSE_MS);
    while (!over) {
        finished done;
        bt_status status = BT_OK;
        if (receive(p, &next_pulse, &done, &over) && good)
            status = e->sink(e->user, &done.job, &done.result);
        struct timespec now = after_ms(0);
        if (now.tv_sec > next_pulse.tv_sec ||
            (now.tv_sec == next_pulse.tv_sec && now.tv_nsec >= next_pulse.tv_nsec)) {
            if (status == BT_OK && good && e->pulse)
                status = e->pulse(e->user);
            next_pulse = after_ms(PULSE_MS);
        }
        if (status != BT_OK) {
            good = false;
            fail(p, status);
        }
    }
}

/// Starts the threads, collects, joins them.
static void run_threads(pool* p, pthread_t* threads, int count) {
    p->working = count;
    int started = 0;
    while (started < count && pthread_create(&threads[started], NULL, thread_main, p) == 0)
        ++started;
    if (started < count) {
        pthread_mutex_lock(&p->lock);
        p->working -= count - started;
        if (started == 0)
            fail_locked(p, BT_ERR_MEMORY, "cannot start a thread");
        pthread_mutex_unlock(&p->lock);
    }
    collect(p);
    for (int i = 0; i < started; ++i)
        pthread_join(threads[i], NULL);
}

bt_status bt_executor_run(const bt_executor* executor, bt_diag* diag) {
    const int count = bt_thread_count(executor->threads);
    pool* p = calloc(1, sizeof *p);
    pthread_t* threads = calloc((size_t)count, sizeof *threads);
    bt_status status = BT_ERR_MEMORY;
    if (p && threads) {
        pthread_condattr_t monotonic;
        pthread_condattr_init(&monotonic);
        pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
        pthread_mutex_init(&p->lock, NULL);
        pthread_cond_init(&p->not_empty, &monotonic);
        pthread_cond_init(&p->not_full, NULL);
        p->executor = executor;
        run_threads(p, threads, count);
        status = p->status;
        if (status == BT_OK && p->left_over)
            status = BT_ERR_INTERRUPTED;
        if (p->message[0])
            bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s", p->message);
        pthread_cond_destroy(&p->not_full);
        pthread_cond_destroy(&p->not_empty);
        pthread_mutex_destroy(&p->lock);
        pthread_condattr_destroy(&monotonic);
    }
    free(threads);
    free(p);
    return status;
}
