/// The ranks, as the sources of the cluster share them.
#ifndef BT_CLUSTER_WORLD_H
#define BT_CLUSTER_WORLD_H

#include "cluster/messages.h"

typedef struct bt_world {
    bool started;
    int size, rank;
    int64_t batches; ///< begun so far
    int* threads;    ///< [size] each rank's share of the cores
    bool* lost;      ///< [size] taken for dead
} bt_world;

/// MPI is one per process, and so is this.
extern bt_world bt_the_world;

extern const bt_backend bt_mpi_backend;

#endif
