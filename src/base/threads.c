#define _GNU_SOURCE /* sched_getaffinity */
#include "base/threads.h"

#include <errno.h>
#include <limits.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>

/* ---- cores ---- */

/// Cores that this process may use. The kernel refuses a set smaller than its own.
static int usable_cores(void) {
    int cores = 1;
    for (int room = CPU_SETSIZE; room <= (1 << 20); room *= 4) {
        cpu_set_t* set = CPU_ALLOC((size_t)room);
        const size_t size = CPU_ALLOC_SIZE((size_t)room);
        const bool got = set && sched_getaffinity(0, size, set) == 0;
        const bool too_small = set && !got && errno == EINVAL;
        if (got)
            cores = CPU_COUNT_S(size, set);
        CPU_FREE(set);
        if (!too_small)
            break;
    }
    return cores;
}

int bt_thread_count(int requested) {
    const int threads = requested > 0 ? requested : usable_cores();
    return threads < 1 ? 1 : threads > BT_THREADS_MAX ? BT_THREADS_MAX : threads;
}

/* ---- threads ---- */

typedef struct worker_thread {
    bt_workers* group;
    int id;
    pthread_t handle;
} worker_thread;

struct bt_workers {
    bt_worker_main* run;
    void* user;
    int started;
    worker_thread thread[];
};

static void* worker_main(void* argument) {
    const worker_thread* self = argument;
    self->group->run(self->group->user, self->id);
    return NULL;
}

bt_status bt_workers_start(int count, bt_worker_main* run, void* user, bt_workers** workers) {
    *workers = NULL;
    bt_workers* group = calloc(1, sizeof *group + (size_t)count * sizeof group->thread[0]);
    if (!group)
        return BT_ERR_MEMORY;
    group->run = run;
    group->user = user;
    while (group->started < count) {
        worker_thread* next = &group->thread[group->started];
        *next = (worker_thread){.group = group, .id = group->started};
        if (pthread_create(&next->handle, NULL, worker_main, next) != 0)
            break;
        ++group->started;
    }
    if (group->started == 0) {
        free(group);
        return BT_ERR_MEMORY;
    }
    *workers = group;
    return BT_OK;
}

void bt_workers_join(bt_workers* workers) {
    for (int i = 0; workers && i < workers->started; ++i)
        pthread_join(workers->thread[i].handle, NULL);
    free(workers);
}

/* ---- tasks ---- */

typedef struct queue {
    bt_task* run;
    void* user;
    int count;
    atomic_int next, stop;
    pthread_mutex_t lock; ///< guards the two below
    int failed_task;
    bt_status status;
} queue;

static void work(queue* q, int worker) {
    while (!atomic_load(&q->stop)) {
        const int task = atomic_fetch_add(&q->next, 1);
        if (task >= q->count)
            break;
        const bt_status status = q->run(q->user, task, worker);
        if (status == BT_OK)
            continue;
        atomic_store(&q->stop, 1);
        pthread_mutex_lock(&q->lock);
        if (task < q->failed_task) {
            q->failed_task = task;
            q->status = status;
        }
        pthread_mutex_unlock(&q->lock);
    }
}

/// The calling thread is worker 0.
static void help(void* user, int worker) {
    work(user, worker + 1);
}

bt_status bt_tasks_run(int threads, int count, bt_task* run, void* user) {
    threads = bt_thread_count(threads);
    if (threads > count)
        threads = count;
    queue q = {.run = run, .user = user, .count = count, .failed_task = INT_MAX, .status = BT_OK};
    pthread_mutex_init(&q.lock, NULL);
    bt_workers* helpers = NULL;
    if (threads > 1 && bt_workers_start(threads - 1, help, &q, &helpers) != BT_OK)
        helpers = NULL; // the calling thread does it all
    work(&q, 0);
    bt_workers_join(helpers);
    pthread_mutex_destroy(&q.lock);
    return q.status;
}
