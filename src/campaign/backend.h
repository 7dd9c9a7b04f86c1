/// A back end: what computes the jobs of a batch. The executor keeps a number of jobs in its hands
/// and takes results back in any order; threads of this process are one back end, processes on
/// other machines can be another, a stub of known cost a third.
///
/// Jobs and results are plain bytes without pointers: they may be sent as they are between
/// processes that run the same binary.
#ifndef BT_CAMPAIGN_BACKEND_H
#define BT_CAMPAIGN_BACKEND_H

#include "campaign/executor.h"

/// Jobs in hand per thread: a landing takes milliseconds, and the next must be there when it ends.
enum { BT_JOBS_PER_THREAD = 8 };

/// A job that has left the back end.
typedef struct bt_finished {
    bt_job job;
    bt_landing_result result; ///< valid with status BT_OK
    /// BT_OK; BT_ERR_INTERRUPTED: given up, it may be run again; else what must end the batch
    bt_status status;
    char message[256]; ///< text of a status that ends the batch
} bt_finished;

struct bt_backend {
    const char* name;

    /// Gets ready for the landings of an executor, which outlives the state. `room` receives how
    /// many jobs it wants in hand, so that no worker waits for the next.
    bt_status (*open)(const bt_executor* executor, void** state, int* room, bt_diag* diag);

    /// Takes one more job; never more than `room` are unfinished.
    void (*submit)(void* state, const bt_job* job);

    /// Takes up to `most` finished jobs; waits for the first of them, but not beyond `wait_s`.
    int (*receive)(void* state, bt_finished* finished, int most, double wait_s);

    /// Begins no more of the jobs in hand, and forgets them; returns how many. `abandon` also gives
    /// up what is being computed: it comes back as BT_ERR_INTERRUPTED, within milliseconds.
    int (*cancel)(void* state, bool abandon);

    void (*close)(void* state);
};

/// Landings on threads of this process, each with its own lander and its own copy of the model.
extern const bt_backend bt_thread_backend;

#endif
