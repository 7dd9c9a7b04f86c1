/// The other ranks: threads compute what rank 0 sends; the main thread alone speaks MPI.
#include "cluster/cluster.h"

#ifdef BT_HAVE_MPI
#include "cluster/world.h"

#include "base/clock.h"

#include <mpi.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { RESULTS_MOST = 8 };

/// A batch under way in this rank.
typedef struct desk {
    bt_batch_text text;
    bt_input inputs[BT_INPUT_MAX];
    bt_axes axes;
    bt_executor executor;
    void* threads; ///< NULL: they could not be started
    bt_status status;
    int in_hand;
    double beat_s; ///< when rank 0 last heard of this rank
    bool open;
} desk;

static void nap(void) {
    const struct timespec look = {.tv_nsec = (long)(1e9 * bt_look_s)};
    nanosleep(&look, NULL);
}

static void send_home(const desk* d, const bt_finished* finished, int tag) {
    bt_delivery delivery;
    memset(&delivery, 0, sizeof delivery);
    delivery.batch = d->text.batch;
    if (finished)
        delivery.finished = *finished;
    MPI_Send(&delivery, sizeof delivery, MPI_BYTE, 0, tag, MPI_COMM_WORLD);
}

static void send_failure(desk* d, const bt_job* job, bt_status status) {
    bt_finished finished;
    memset(&finished, 0, sizeof finished);
    if (job)
        finished.job = *job;
    finished.status = status;
    send_home(d, &finished, BT_TAG_RESULT);
}

static void open_batch(desk* d) {
    int room;
    MPI_Recv(&d->text, sizeof d->text, MPI_BYTE, 0, BT_TAG_BATCH, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    d->axes.count = d->text.axis_count;
    for (int i = 0; i < d->axes.count; ++i) {
        d->axes.input[i] = i;
        d->inputs[i].field =
            bt_params_find(&bt_model_group, &d->text.model, d->text.path[i], &d->inputs[i].offset);
    }
    const int share = bt_cluster_threads(bt_the_world.rank);
    d->executor = (bt_executor){.model = &d->text.model,
                                .inputs = d->inputs,
                                .axes = &d->axes,
                                .threads = d->text.threads > 0 ? d->text.threads : share};
    d->status = bt_thread_backend.open(&d->executor, &d->threads, &room, NULL);
    d->in_hand = 0;
    d->open = true;
    d->beat_s = bt_clock_s();
}

static void begin_job(desk* d, const bt_job* job) {
    if (d->status != BT_OK) {
        send_failure(d, job, d->status);
        return;
    }
    bt_thread_backend.submit(d->threads, job);
    ++d->in_hand;
}

static void give_up(desk* d, bool abandon) {
    const int forgotten = d->threads ? bt_thread_backend.cancel(d->threads, abandon) : 0;
    d->in_hand -= forgotten;
    for (int i = 0; i < forgotten; ++i)
        send_failure(d, NULL, BT_ERR_INTERRUPTED);
}

static void close_batch(desk* d) {
    bt_thread_backend.close(d->threads);
    d->threads = NULL;
    d->open = false;
}

/// Rank 0 is at its end. Where a rank is dead MPI_Finalize would wait for it.
static bool go_home(desk* d, bool farewell) {
    if (d->open)
        close_batch(d);
    if (!farewell)
        _exit(0);
    return false;
}

static bool obey(desk* d, const bt_order* order) {
    switch ((bt_order_kind)order->kind) {
    case BT_ORDER_JOB:
        begin_job(d, &order->job);
        return true;
    case BT_ORDER_CANCEL:
    case BT_ORDER_ABANDON:
        give_up(d, order->kind == BT_ORDER_ABANDON);
        return true;
    case BT_ORDER_CLOSE:
        close_batch(d);
        return true;
    case BT_ORDER_END:
    case BT_ORDER_LEAVE:
        return go_home(d, order->kind == BT_ORDER_END);
    }
    return true;
}

/// Everything that rank 0 has sent by now; false: go home. Messages of rank 0 arrive in order.
static bool take_orders(desk* d) {
    int there = 1;
    bool on = true;
    while (on) {
        MPI_Status from;
        if (MPI_Iprobe(0, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &from) != MPI_SUCCESS || !there)
            break;
        if (from.MPI_TAG == BT_TAG_BATCH) {
            open_batch(d);
            continue;
        }
        bt_order order;
        MPI_Recv(&order, sizeof order, MPI_BYTE, 0, BT_TAG_ORDER, MPI_COMM_WORLD,
                 MPI_STATUS_IGNORE);
        on = obey(d, &order);
    }
    return on;
}

static void send_results(desk* d) {
    bt_finished finished[RESULTS_MOST];
    const int count = bt_thread_backend.receive(d->threads, finished, RESULTS_MOST, bt_look_s);
    for (int i = 0; i < count; ++i)
        send_home(d, &finished[i], BT_TAG_RESULT);
    d->in_hand -= count;
    if (count > 0)
        d->beat_s = bt_clock_s();
}

void bt_cluster_serve(void) {
    desk* d = calloc(1, sizeof *d);
    if (!d)
        MPI_Abort(MPI_COMM_WORLD, 1);
    while (take_orders(d)) {
        if (d->open && d->in_hand > 0)
            send_results(d);
        else
            nap();
        if (d->open && bt_clock_s() - d->beat_s > bt_beat_s) {
            send_home(d, NULL, BT_TAG_BEAT);
            d->beat_s = bt_clock_s();
        }
    }
    free(d);
}
#endif
