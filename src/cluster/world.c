/// Joining the ranks and sending them home.
#define _GNU_SOURCE /* sched_getaffinity */
#include "cluster/world.h"
#include "cluster/cluster.h"

#include "base/hash.h"
#include "base/threads.h"
#include "surrogate/predictor.h"

#include <stdlib.h>
#include <string.h>

/// A count from the environment; `fallback` where it says none.
static int number_of(const char* text, int fallback) {
    char* end = NULL;
    const long value = text ? strtol(text, &end, 10) : fallback;
    return end == text || value < 0 || value > 1000000 ? fallback : (int)value;
}

/// How many processes were launched together with this one, as Open MPI's launcher says, and which
/// of them it is. PMIX_RANK alone: launched by srun --mpi=pmix, the number is known after MPI_Init.
static int launched(int* rank) {
    const char *size = getenv("OMPI_COMM_WORLD_SIZE"), *own = getenv("OMPI_COMM_WORLD_RANK");
    const char* pmix = getenv("PMIX_RANK");
    *rank = number_of(own ? own : pmix, 0);
    return number_of(size, pmix ? 2 : 1);
}

#ifdef BT_HAVE_MPI

#include <math.h>
#include <mpi.h>
#include <sched.h>
#include <signal.h>
#include <unistd.h>

bt_world bt_the_world = {.size = 1};

/// What must be the same in every rank for the same bits.
static uint64_t fingerprint(void) {
    const bt_isa_level isa = bt_isa_best();
    const size_t size[2] = {sizeof(bt_model_params), sizeof(bt_finished)};
    uint64_t hash = bt_hash_bytes(BT_HASH_START, BT_VERSION, strlen(BT_VERSION));
    hash = bt_hash_bytes(hash, BT_FLAGS, strlen(BT_FLAGS));
    hash = bt_hash_bytes(hash, &isa, sizeof isa);
    return bt_hash_bytes(hash, size, sizeof size);
}

static bool all_the_same(void) {
    const uint64_t mine = fingerprint();
    uint64_t least = 0, greatest = 0;
    MPI_Allreduce(&mine, &least, 1, MPI_UINT64_T, MPI_MIN, MPI_COMM_WORLD);
    MPI_Allreduce(&mine, &greatest, 1, MPI_UINT64_T, MPI_MAX, MPI_COMM_WORLD);
    return least == greatest;
}

/// This rank's share of the cores it may use: a core that several ranks of this machine may use is
/// divided among them. Whole threads: the shares are added up in order of rank and rounded down, so
/// that the threads of a machine are as many as its cores, and rank 0, which has the ledger to
/// keep, comes off worst (none, where there are more ranks than cores).
static int share_of_cores(void) {
    cpu_set_t set;
    int mine[CPU_SETSIZE] = {0}, all[CPU_SETSIZE] = {0};
    if (sched_getaffinity(0, sizeof set, &set) != 0)
        return 1;
    for (size_t core = 0; core < CPU_SETSIZE; ++core)
        mine[core] = CPU_ISSET(core, &set) != 0;
    MPI_Comm machine;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Allreduce(mine, all, CPU_SETSIZE, MPI_INT, MPI_SUM, machine);
    double share = 0, before = 0;
    for (size_t core = 0; core < CPU_SETSIZE; ++core)
        share += mine[core] ? 1.0 / all[core] : 0;
    int place = 0;
    MPI_Comm_rank(machine, &place);
    MPI_Exscan(&share, &before, 1, MPI_DOUBLE, MPI_SUM, machine);
    if (place == 0)
        before = 0; // what Exscan leaves undefined
    MPI_Comm_free(&machine);
    const double rounding = 1e-6;
    return (int)(floor(before + share + rounding) - floor(before + rounding));
}

/// Every rank's share, as all ranks know it.
static bt_status share_cores(bt_world* w) {
    const int mine = share_of_cores();
    w->threads = calloc((size_t)w->size, sizeof *w->threads);
    w->lost = calloc((size_t)w->size, sizeof *w->lost);
    MPI_Allgather(&mine, 1, MPI_INT, w->threads, 1, MPI_INT, MPI_COMM_WORLD);
    return w->threads && w->lost ? BT_OK : BT_ERR_MEMORY;
}

int bt_cluster_threads(int rank) {
    const int share = bt_the_world.threads[rank];
    return rank > 0 && share < 1 ? 1 : share;
}

/// The launcher sends the signals of a job to every rank; rank 0 decides what becomes of them.
static void leave_signals_to_lead(void) {
    static const int asked[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU};
    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; ++i)
        signal(asked[i], SIG_IGN);
}

static bt_status join(bt_world* w, bt_diag* diag) {
    int level = 0;
    if (MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &level) != MPI_SUCCESS ||
        level < MPI_THREAD_FUNNELED) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "MPI cannot be started with threads");
        return BT_ERR_INTERNAL;
    }
    w->started = true;
    MPI_Comm_size(MPI_COMM_WORLD, &w->size);
    MPI_Comm_rank(MPI_COMM_WORLD, &w->rank);
    if (w->rank > 0)
        leave_signals_to_lead();
    const bool same = all_the_same();
    BT_TRY(share_cores(w));
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    if (same)
        return BT_OK;
    if (w->rank == 0)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "the ranks are not the same program on processors of the same instruction set: "
                    "their landings would differ in the last bits. Ask for one kind of node");
    return BT_ERR_ARG;
}

bt_status bt_cluster_start(bt_cluster_role* role, bt_diag* diag) {
    bt_world* w = &bt_the_world;
    int rank;
    *role = BT_CLUSTER_ALONE;
    if (launched(&rank) < 2)
        return BT_OK;
    const bt_status status = join(w, diag);
    if (w->size > 1)
        *role = w->rank == 0 ? BT_CLUSTER_LEAD : BT_CLUSTER_HELP;
    return status;
}

void bt_cluster_end(void) {
    bt_world* w = &bt_the_world;
    bool lost = false;
    for (int rank = 1; w->started && rank < w->size; ++rank)
        lost = lost || w->lost[rank];
    const bt_order order = {.kind = lost ? BT_ORDER_LEAVE : BT_ORDER_END};
    for (int rank = 1; w->started && w->rank == 0 && rank < w->size; ++rank)
        if (!w->lost[rank])
            MPI_Send(&order, sizeof order, MPI_BYTE, rank, BT_TAG_ORDER, MPI_COMM_WORLD);
    free(w->threads);
    free(w->lost);
    if (w->started && !lost)
        MPI_Finalize();
    *w = (bt_world){.size = 1};
}

const bt_backend* bt_cluster_backend(void) {
    return bt_the_world.size > 1 ? &bt_mpi_backend : NULL;
}

#define AS_TEXT(number) #number
#define TEXT_OF(number) AS_TEXT(number)

const char* bt_cluster_version(void) {
    return "Open MPI " TEXT_OF(OMPI_MAJOR_VERSION) "." TEXT_OF(OMPI_MINOR_VERSION) "." TEXT_OF(
        OMPI_RELEASE_VERSION);
}

#else

const char* bt_cluster_version(void) {
    return NULL;
}

bt_status bt_cluster_start(bt_cluster_role* role, bt_diag* diag) {
    int rank;
    *role = BT_CLUSTER_ALONE;
    if (launched(&rank) < 2)
        return BT_OK;
    *role = rank > 0 ? BT_CLUSTER_HELP : BT_CLUSTER_LEAD;
    if (rank > 0)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                "this bolter was built without MPI (CMake option BT_MPI; it needs libopenmpi-dev): "
                "run it without mpirun, or in parts with --shard");
    return BT_ERR_ARG;
}

void bt_cluster_serve(void) {
}
void bt_cluster_end(void) {
}

const bt_backend* bt_cluster_backend(void) {
    return NULL;
}

#endif
