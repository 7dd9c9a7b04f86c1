#include "campaign/simulated_backend.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/// A job under way: known to its worker, and in the heap by the time at which it will be done.
typedef struct event {
    double done_s;
    int worker;
    bt_job job;
} event;

typedef struct simulated {
    int workers, room;
    int* in_hand;   ///< [workers]
    double* free_s; ///< [workers] when the last of its jobs is done
    event* heap;    ///< [room] the earliest first
    int count;
    double now_s;  ///< simulated time at the executor
    double real_s; ///< its processor time when that was
} simulated;

static double processor_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/// What the executor has worked since the last call passes in the simulation too.
static void let_pass(simulated* s) {
    const double real_s = processor_s();
    s->now_s += real_s - s->real_s;
    s->real_s = real_s;
}

static void push(simulated* s, const event* e) {
    int at = s->count++;
    for (; at > 0 && s->heap[(at - 1) / 2].done_s > e->done_s; at = (at - 1) / 2)
        s->heap[at] = s->heap[(at - 1) / 2];
    s->heap[at] = *e;
}

static event pop(simulated* s) {
    const event first = s->heap[0], last = s->heap[--s->count];
    int at = 0;
    for (int child = 1; child < s->count; child = 2 * at + 1) {
        if (child + 1 < s->count && s->heap[child + 1].done_s < s->heap[child].done_s)
            ++child;
        if (s->heap[child].done_s >= last.done_s)
            break;
        s->heap[at] = s->heap[child];
        at = child;
    }
    s->heap[at] = last;
    return first;
}

static void close_simulated(void* state) {
    simulated* s = state;
    if (!s)
        return;
    free(s->in_hand);
    free(s->free_s);
    free(s->heap);
    free(s);
}

static bt_status open_simulated(const bt_executor* executor, void** state, int* room,
                                bt_diag* diag) {
    (void)diag;
    simulated* s = *state = calloc(1, sizeof *s);
    if (!s)
        return BT_ERR_MEMORY;
    s->workers = executor->threads > 0 ? executor->threads : 1;
    *room = s->room = BT_JOBS_PER_THREAD * s->workers;
    s->in_hand = calloc((size_t)s->workers, sizeof *s->in_hand);
    s->free_s = calloc((size_t)s->workers, sizeof *s->free_s);
    s->heap = calloc((size_t)s->room, sizeof *s->heap);
    s->real_s = processor_s();
    if (s->in_hand && s->free_s && s->heap)
        return BT_OK;
    close_simulated(s);
    *state = NULL;
    return BT_ERR_MEMORY;
}

static int emptiest(const simulated* s) {
    int best = 0;
    for (int i = 1; i < s->workers && s->in_hand[best] > 0; ++i)
        if (s->in_hand[i] < s->in_hand[best])
            best = i;
    return best;
}

static void submit(void* state, const bt_job* job) {
    simulated* s = state;
    let_pass(s);
    event e = {.worker = emptiest(s), .job = *job};
    ++s->in_hand[e.worker];
    s->free_s[e.worker] = e.done_s = fmax(s->now_s, s->free_s[e.worker]) + job->x[0];
    push(s, &e);
}

static int receive(void* state, bt_finished* finished, int most, double wait_s) {
    simulated* s = state;
    int count = 0;
    let_pass(s);
    if (s->count > 0)
        s->now_s = fmax(s->now_s, fmin(s->heap[0].done_s, s->now_s + wait_s));
    while (count < most && s->count > 0 && s->heap[0].done_s <= s->now_s) {
        const event e = pop(s);
        bt_finished* f = &finished[count++];
        --s->in_hand[e.worker];
        memset(f, 0, sizeof *f);
        f->job = e.job;
        f->result.wall_s = e.job.x[0];
        f->result.end_time_s = s->now_s;
    }
    return count;
}

/// What has begun by now stays.
static int cancel(void* state, bool abandon) {
    simulated* s = state;
    int kept = 0;
    const int had = s->count;
    (void)abandon;
    let_pass(s);
    for (int i = 0; i < had; ++i)
        if (s->heap[i].done_s - s->heap[i].job.x[0] <= s->now_s)
            s->heap[kept++] = s->heap[i];
    s->count = 0;
    for (int i = 0; i < kept; ++i) {
        const event e = s->heap[i];
        push(s, &e);
    }
    return had - kept;
}

const bt_backend bt_simulated_backend = {
    .name = "simulated",
    .open = open_simulated,
    .submit = submit,
    .receive = receive,
    .cancel = cancel,
    .close = close_simulated,
};
