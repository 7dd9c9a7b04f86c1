#include "campaign/executor.h"

#include "base/clock.h"
#include "campaign/backend.h"

#include <math.h>

enum { RECEIVED_MOST = 8 };

static const double pulse_s = 0.2;
/// What is in flight when a stop is asked for has this long to end by itself.
static const double patience_s = 0.4;

/// A batch under way.
typedef struct batch {
    const bt_executor* executor;
    const bt_backend* backend;
    void* state;      ///< the back end's own
    int room;         ///< jobs it may have in hand
    int in_hand;      ///< jobs it has
    bool closed;      ///< no more jobs are given out
    bool left_over;   ///< stopped while there was another job
    double stopped_s; ///< when the stop was seen; NAN: not yet
    bt_status status; ///< the first error
    bt_diag* diag;
} batch;

static bool stop_asked(const batch* b) {
    return b->executor->stop && atomic_load(b->executor->stop) != 0;
}

/// Gives out no more jobs and takes back those that have not begun.
static void close_batch(batch* b, bool abandon) {
    const int forgotten = b->backend->cancel(b->state, abandon);
    b->in_hand -= forgotten;
    b->left_over = b->left_over || forgotten > 0;
    b->closed = true;
}

static void fail(batch* b, bt_status status, const char* message) {
    if (b->status != BT_OK)
        return;
    b->status = status;
    if (message[0])
        bt_diag_add(b->diag, BT_ERROR, BT_NOWHERE, "%s", message);
    close_batch(b, false);
}

/// Fills the hands of the back end.
static void feed(batch* b) {
    const bt_executor* e = b->executor;
    bt_job job = {0}; // what a point does not use is the same in every process
    while (!b->closed && b->in_hand < b->room) {
        if (!e->source(e->user, &job))
            b->closed = true;
        else if (stop_asked(b))
            b->left_over = b->closed = true;
        else {
            b->backend->submit(b->state, &job);
            ++b->in_hand;
        }
    }
}

static void obey_stop(batch* b) {
    if (!stop_asked(b))
        return;
    const double now_s = bt_clock_s();
    if (isnan(b->stopped_s)) {
        b->stopped_s = now_s;
        bt_job job;
        b->left_over = b->left_over || (!b->closed && b->executor->source(b->executor->user, &job));
        close_batch(b, false);
    } else if (now_s - b->stopped_s > patience_s)
        close_batch(b, true);
}

static void take(batch* b, const bt_finished* finished) {
    const bt_executor* e = b->executor;
    --b->in_hand;
    if (finished->status == BT_ERR_INTERRUPTED)
        b->left_over = true;
    else if (finished->status != BT_OK)
        fail(b, finished->status, finished->message);
    else if (b->status == BT_OK) {
        const bt_status status = e->sink(e->user, &finished->job, &finished->result);
        if (status != BT_OK)
            fail(b, status, "");
    }
}

/// Hands results to the sink until the back end has nothing left to give.
static void run_batch(batch* b) {
    const bt_executor* e = b->executor;
    bt_finished finished[RECEIVED_MOST];
    double next_pulse_s = bt_clock_s() + pulse_s;
    for (feed(b); b->in_hand > 0; feed(b)) {
        const double wait_s = fmax(0, next_pulse_s - bt_clock_s());
        const int count = b->backend->receive(b->state, finished, RECEIVED_MOST, wait_s);
        for (int i = 0; i < count; ++i)
            take(b, &finished[i]);
        obey_stop(b);
        if (bt_clock_s() < next_pulse_s)
            continue;
        next_pulse_s = bt_clock_s() + pulse_s;
        const bt_status status = b->status == BT_OK && e->pulse ? e->pulse(e->user) : BT_OK;
        if (status != BT_OK)
            fail(b, status, "");
    }
}

bt_status bt_executor_run(const bt_executor* executor, bt_diag* diag) {
    batch b = {.executor = executor,
               .backend = executor->backend ? executor->backend : &bt_thread_backend,
               .stopped_s = NAN,
               .diag = diag};
    BT_TRY(b.backend->open(executor, &b.state, &b.room, diag));
    run_batch(&b);
    b.backend->close(b.state);
    return b.status == BT_OK && b.left_over ? BT_ERR_INTERRUPTED : b.status;
}
