#include "base/tasks.h"

#include <limits.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

typedef struct crew {
    bt_task* run;
    void* user;
    int count;
    atomic_int next, stop;
    pthread_mutex_t lock; ///< guards the two below
    int failed_task;
    bt_status status;
} crew;

typedef struct worker {
    crew* crew;
    int id;
    pthread_t thread;
} worker;

int bt_tasks_threads(int threads) {
    const long cores = threads > 0 ? threads : sysconf(_SC_NPROCESSORS_ONLN);
    return cores < 1 ? 1 : cores > 1024 ? 1024 : (int)cores;
}

static void* work(void* argument) {
    const worker* self = argument;
    crew* c = self->crew;
    while (!atomic_load(&c->stop)) {
        const int task = atomic_fetch_add(&c->next, 1);
        if (task >= c->count)
            break;
        const bt_status status = c->run(c->user, task, self->id);
        if (status == BT_OK)
            continue;
        atomic_store(&c->stop, 1);
        pthread_mutex_lock(&c->lock);
        if (task < c->failed_task) {
            c->failed_task = task;
            c->status = status;
        }
        pthread_mutex_unlock(&c->lock);
    }
    return NULL;
}

bt_status bt_tasks_run(int threads, int count, bt_task* run, void* user) {
    threads = bt_tasks_threads(threads);
    if (threads > count)
        threads = count;
    crew c = {.run = run, .user = user, .count = count, .failed_task = INT_MAX, .status = BT_OK};
    pthread_mutex_init(&c.lock, NULL);
    worker* workers = calloc((size_t)threads + 1, sizeof *workers);
    int started = 1;
    if (workers) {
        for (int i = 0; i < threads; ++i)
            workers[i] = (worker){.crew = &c, .id = i};
        while (started < threads &&
               !pthread_create(&workers[started].thread, NULL, work, &workers[started]))
            ++started;
    }
    worker self = {.crew = &c, .id = 0};
    work(&self);
    for (int i = 1; workers && i < started; ++i)
        pthread_join(workers[i].thread, NULL);
    free(workers);
    pthread_mutex_destroy(&c.lock);
    return c.status;
}
