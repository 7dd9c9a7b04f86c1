/// Many processes on one campaign. Under mpirun every process is the same program: rank 0 reads the
/// study, owns the ledger and prints, the others compute the landings it sends. A part of the
/// program, not of the library: who links libbolter need not have MPI.
#ifndef BT_CLUSTER_CLUSTER_H
#define BT_CLUSTER_CLUSTER_H

#include "campaign/backend.h"

/// What this process is to do.
typedef enum bt_cluster_role {
    BT_CLUSTER_ALONE, ///< not launched under mpirun, or as its only process
    BT_CLUSTER_LEAD,  ///< rank 0 of several
    BT_CLUSTER_HELP,  ///< another rank: bt_cluster_serve, then end
} bt_cluster_role;

/// Joins the processes that were launched together; without them nothing of MPI is touched.
/// BT_ERR_ARG, said in diag of rank 0 alone: built without MPI, or the ranks are not the same
/// program on the same instruction set (their bits would differ); BT_ERR_INTERNAL: MPI refuses.
BT_CHECKED bt_status bt_cluster_start(bt_cluster_role* role, bt_diag* diag);

/// Computes what rank 0 sends, until it ends. Signals that ask to end are left to rank 0.
void bt_cluster_serve(void);

/// Sends the others home. Called by rank 0 at its end, however it ends.
void bt_cluster_end(void);

/// The back end that spreads landings over the ranks; NULL for a process alone.
const bt_backend* bt_cluster_backend(void);

/// Version of the MPI library that the program was built with; NULL: without.
const char* bt_cluster_version(void);

#endif
