/// A back end for questions of scale: workers that exist on paper only, so that a thousand of them
/// fit into one process. Only the time that the executor itself spends is real.
#ifndef BT_CAMPAIGN_SIMULATED_BACKEND_H
#define BT_CAMPAIGN_SIMULATED_BACKEND_H

#include "campaign/backend.h"

/// `threads` of the executor is the number of workers, x[0] of a job its cost in seconds. A result
/// has nothing but wall_s, that cost, and end_time_s: the simulated time at which the executor
/// receives it, since the beginning of the batch.
///
/// The clock of the executor's side runs with the processor time that its thread takes (the
/// scheduler's, the sink's), and jumps to the next result when it waits. A job begins when it has
/// been given out and its worker is free. Jobs are given to the worker with the emptiest hands, by
/// the same search as over the ranks of MPI.
extern const bt_backend bt_simulated_backend;

#endif
