/// Rank 0: gives every job to the rank with the emptiest hands, itself among them, and takes the
/// results as they come. A job stays known until its result is here, so those of a rank that died
/// are given to another.
#include "cluster/cluster.h"

#ifdef BT_HAVE_MPI
#include "cluster/world.h"

#include "base/clock.h"

#include <math.h>
#include <mpi.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/// A rank as rank 0 sees it.
typedef struct peer {
    int rank, room, in_hand;
    double heard_s; ///< when it last said something
    bt_job* jobs;   ///< [room] those in its hands
    MPI_Request request;
} peer;

typedef struct ranks {
    bt_batch_text text;
    bt_diag* diag;
    void* own;      ///< threads of this process
    bool own_works; ///< false while the others have the cores
    int own_room, own_in_hand;
    int peer_count;
    peer* peers;     ///< [peer_count] rank i + 1
    bt_job* waiting; ///< stack of jobs that nobody has
    int waiting_count;
    int given_up; ///< jobs to be handed back as interrupted
    bool cancelled;
} ranks;

static bool is_lost(const peer* p) {
    return bt_the_world.lost[p->rank];
}

static int count_alive(const ranks* c) {
    int alive = 0;
    for (int i = 0; i < c->peer_count; ++i)
        alive += !is_lost(&c->peers[i]);
    return alive;
}

/// Takes a rank for dead; what it had in hand waits for another.
static void lose(ranks* c, peer* p) {
    bt_the_world.lost[p->rank] = true;
    bt_diag_add(c->diag, BT_WARNING, BT_NOWHERE,
                "rank %d is gone; its %d landings are given to the others", p->rank, p->in_hand);
    for (int i = 0; i < p->in_hand && !c->cancelled; ++i)
        c->waiting[c->waiting_count++] = p->jobs[i];
    c->given_up += c->cancelled ? p->in_hand : 0;
    p->in_hand = 0;
    c->own_works = c->own_works || count_alive(c) == 0;
}

static void send_order(ranks* c, peer* p, bt_order_kind kind, const bt_job* job) {
    bt_order order;
    memset(&order, 0, sizeof order);
    order.batch = c->text.batch;
    order.kind = kind;
    if (job)
        order.job = *job;
    if (!is_lost(p) && MPI_Send(&order, sizeof order, MPI_BYTE, p->rank, BT_TAG_ORDER,
                                MPI_COMM_WORLD) != MPI_SUCCESS)
        lose(c, p);
}

// --- opening and closing ----------------------------------------------------------------------

static int peer_threads(const bt_executor* executor, int rank) {
    return executor->threads > 0 ? executor->threads : bt_cluster_threads(rank);
}

/// Ranks cannot show a landing while it runs, nor find a key that has no path.
static bool can_be_sent(const bt_executor* executor) {
    bool found = !executor->observer;
    for (int i = 0; found && i < executor->axes->count; ++i) {
        const bt_input* input = &executor->inputs[executor->axes->input[i]];
        size_t offset = 0;
        found = input->path[0] && bt_params_find(&bt_model_group, executor->model, input->path,
                                                 &offset) == input->field;
        found = found && offset == input->offset;
    }
    return found;
}

static void write_batch(ranks* c, const bt_executor* executor, int64_t batch) {
    c->text.batch = batch;
    c->text.threads = executor->threads;
    c->text.axis_count = executor->axes->count;
    c->text.model = *executor->model;
    for (int i = 0; i < executor->axes->count; ++i)
        memcpy(c->text.path[i], executor->inputs[executor->axes->input[i]].path, BT_PATH_MAX);
}

static bt_status call_peers(ranks* c, const bt_executor* executor) {
    c->peers = calloc((size_t)bt_the_world.size, sizeof *c->peers);
    if (!c->peers)
        return BT_ERR_MEMORY;
    for (int rank = 1; rank < bt_the_world.size; ++rank) {
        peer* p = &c->peers[c->peer_count++];
        p->rank = rank;
        if (is_lost(p))
            continue;
        p->room = BT_JOBS_PER_THREAD * peer_threads(executor, rank);
        p->heard_s = bt_clock_s();
        p->jobs = calloc((size_t)p->room, sizeof *p->jobs);
        if (!p->jobs)
            return BT_ERR_MEMORY;
        MPI_Isend(&c->text, sizeof c->text, MPI_BYTE, rank, BT_TAG_BATCH, MPI_COMM_WORLD,
                  &p->request);
    }
    return BT_OK;
}

static void close_ranks(void* state) {
    ranks* c = state;
    if (!c)
        return;
    for (int i = 0; c->peers && i < c->peer_count; ++i) {
        peer* p = &c->peers[i];
        send_order(c, p, BT_ORDER_CLOSE, NULL);
        if (is_lost(p) && p->request)
            MPI_Request_free(&p->request);
        else if (p->request)
            MPI_Wait(&p->request, MPI_STATUS_IGNORE);
        free(p->jobs);
    }
    bt_thread_backend.close(c->own);
    free(c->peers);
    free(c->waiting);
    free(c);
}

static bt_status open_parts(ranks* c, const bt_executor* executor, int* room, bt_diag* diag) {
    if (can_be_sent(executor))
        BT_TRY(call_peers(c, executor));
    const int own = executor->threads > 0 ? executor->threads : bt_cluster_threads(0);
    c->own_works = own > 0 || count_alive(c) == 0;
    bt_executor here = *executor;
    here.threads = own > 0 ? own : 1;
    BT_TRY(bt_thread_backend.open(&here, &c->own, &c->own_room, diag));
    *room = c->own_works ? c->own_room : 0;
    for (int i = 0; i < c->peer_count; ++i)
        *room += c->peers[i].room;
    c->waiting = calloc((size_t)*room, sizeof *c->waiting);
    return c->waiting ? BT_OK : BT_ERR_MEMORY;
}

static bt_status open_ranks(const bt_executor* executor, void** state, int* room, bt_diag* diag) {
    ranks* c = calloc(1, sizeof *c);
    *state = NULL;
    if (!c)
        return BT_ERR_MEMORY;
    c->diag = diag;
    write_batch(c, executor, ++bt_the_world.batches);
    const bt_status status = open_parts(c, executor, room, diag);
    if (status == BT_OK)
        *state = c;
    else
        close_ranks(c);
    return status;
}

// --- giving -----------------------------------------------------------------------------------

/// The rank whose hands are emptiest; NULL: this process, or nobody (`room` 0).
static peer* emptiest(ranks* c, int* room) {
    peer* best = NULL;
    *room = c->own_works ? c->own_room - c->own_in_hand : 0;
    for (int i = 0; i < c->peer_count; ++i) {
        peer* p = &c->peers[i];
        if (is_lost(p) || p->room - p->in_hand <= *room)
            continue;
        best = p;
        *room = p->room - p->in_hand;
    }
    return best;
}

static void give(ranks* c) {
    while (c->waiting_count > 0) {
        int room;
        peer* p = emptiest(c, &room);
        if (room == 0)
            return;
        const bt_job job = c->waiting[--c->waiting_count];
        if (!p) {
            bt_thread_backend.submit(c->own, &job);
            ++c->own_in_hand;
            continue;
        }
        p->jobs[p->in_hand++] = job;
        send_order(c, p, BT_ORDER_JOB, &job);
    }
}

static void submit(void* state, const bt_job* job) {
    ranks* c = state;
    c->waiting[c->waiting_count++] = *job;
    give(c);
}

// --- taking -----------------------------------------------------------------------------------

/// Takes a job out of a rank's hands; one that was forgotten has no number, and any will do.
static void strike(peer* p, const bt_finished* finished) {
    int at = 0;
    while (finished->status != BT_ERR_INTERRUPTED && at < p->in_hand &&
           p->jobs[at].run != finished->job.run)
        ++at;
    if (at < p->in_hand)
        p->jobs[at] = p->jobs[--p->in_hand];
}

/// One message, if there is one; whether it was a result of this batch.
static bool take_message(ranks* c, bt_finished* finished, bool* any) {
    int there = 0;
    MPI_Status from;
    *any = false;
    if (MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &from) != MPI_SUCCESS ||
        !there)
        return false;
    bt_delivery delivery;
    *any = true;
    if (MPI_Recv(&delivery, sizeof delivery, MPI_BYTE, from.MPI_SOURCE, from.MPI_TAG,
                 MPI_COMM_WORLD, MPI_STATUS_IGNORE) != MPI_SUCCESS)
        return false;
    peer* p = c->peer_count > 0 ? &c->peers[from.MPI_SOURCE - 1] : NULL;
    if (!p || is_lost(p) || delivery.batch != c->text.batch)
        return false;
    p->heard_s = bt_clock_s();
    if (from.MPI_TAG != BT_TAG_RESULT)
        return false;
    strike(p, &delivery.finished);
    *finished = delivery.finished;
    return true;
}

static int take_messages(ranks* c, bt_finished* finished, int most) {
    int count = 0;
    for (bool any = true; any && count < most;)
        count += take_message(c, &finished[count], &any);
    return count;
}

/// Jobs that nobody will finish after a cancel.
static int hand_back(ranks* c, bt_finished* finished, int most) {
    int count = 0;
    for (; count < most && c->given_up > 0; ++count, --c->given_up) {
        memset(&finished[count], 0, sizeof *finished);
        finished[count].status = BT_ERR_INTERRUPTED;
    }
    return count;
}

static void look_for_dead(ranks* c) {
    const double now_s = bt_clock_s();
    for (int i = 0; i < c->peer_count; ++i) {
        peer* p = &c->peers[i];
        if (!is_lost(p) && now_s - p->heard_s > bt_silence_s)
            lose(c, p);
    }
}

/// What is here now; sleeps a little when it is nothing.
static int take(ranks* c, bt_finished* finished, int most, double wait_s) {
    int count = hand_back(c, finished, most);
    count += take_messages(c, finished + count, most - count);
    if (count == most)
        return count;
    const double nap_s = count > 0 ? 0 : fmin(wait_s, bt_look_s);
    const int own = bt_thread_backend.receive(c->own, finished + count, most - count, nap_s);
    c->own_in_hand -= own;
    return count + own;
}

static int receive(void* state, bt_finished* finished, int most, double wait_s) {
    ranks* c = state;
    const double until_s = bt_clock_s() + wait_s;
    int count = 0;
    for (bool more = true; more; more = count == 0 && bt_clock_s() < until_s) {
        count = take(c, finished, most, fmax(0, until_s - bt_clock_s()));
        look_for_dead(c);
        give(c);
    }
    return count;
}

static int cancel(void* state, bool abandon) {
    ranks* c = state;
    const int own = bt_thread_backend.cancel(c->own, abandon);
    const int forgotten = own + c->waiting_count;
    c->own_in_hand -= own;
    c->waiting_count = 0;
    c->cancelled = true;
    for (int i = 0; i < c->peer_count; ++i)
        send_order(c, &c->peers[i], abandon ? BT_ORDER_ABANDON : BT_ORDER_CANCEL, NULL);
    return forgotten;
}

const bt_backend bt_mpi_backend = {
    .name = "mpi",
    .open = open_ranks,
    .submit = submit,
    .receive = receive,
    .cancel = cancel,
    .close = close_ranks,
};
#endif
