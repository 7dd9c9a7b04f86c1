/// The executor: many independent landings on several threads. Each thread has its own lander and
/// its own copy of the model; the threads share only the queue of points and the queue of results.
#ifndef BT_CAMPAIGN_EXECUTOR_H
#define BT_CAMPAIGN_EXECUTOR_H

#include "campaign/design.h"

#include <stdatomic.h>

/// One landing to run: a number the caller knows it by, and its point x [axes.count], SI.
typedef struct bt_job {
    int64_t run;
    double x[BT_INPUT_MAX];
} bt_job;

/// Gives the next job; false when there is none left. Called by one thread at a time.
typedef bool bt_job_source(void* user, bt_job* job);

/// Receives a finished landing, on the thread that called bt_executor_run, in order of arrival.
/// A status other than BT_OK ends the work.
typedef bt_status bt_job_sink(void* user, const bt_job* job, const bt_landing_result* result);

/// Called on the same thread at least four times a second: commit, show progress.
typedef bt_status bt_job_pulse(void* user);

typedef struct bt_executor {
    const bt_model_params* model; ///< what every landing shares
    const bt_input* inputs;       ///< the study's inputs
    const bt_axes* axes;          ///< which of them x is made of
    int threads;                  ///< 0: one per core
    const atomic_int* stop; ///< may be NULL; once not 0, landings in flight end and no more begin
    bt_job_source* source;
    bt_job_sink* sink;
    bt_job_pulse* pulse; ///< may be NULL
    void* user;          ///< of source, sink and pulse
} bt_executor;

/// Runs every job. A landing that diverges is a result, not an error; so is a point that lies
/// outside what the model allows (failed_element names the key, failed_quantity says so).
/// Returns BT_OK, BT_ERR_INTERRUPTED (stop was set while jobs were left), what the sink or the
/// pulse returned, BT_ERR_INPUT (the landing cannot be assembled, said in diag), BT_ERR_MEMORY.
BT_CHECKED bt_status bt_executor_run(const bt_executor* executor, bt_diag* diag);

/// One landing on the calling thread: the model with x in place of its axes. Errors as
/// bt_lander_run. `model` is scratch: its axes are overwritten.
BT_CHECKED bt_status bt_landing_at(bt_lander* lander, bt_model_params* model,
                                   const bt_input* inputs, const bt_axes* axes, const double* x,
                                   bt_landing_result* result, bt_landing_observer* observer,
                                   void* user, bt_diag* diag);

/// Threads for a request: itself, or one per core the process may use.
int bt_thread_count(int requested);

#endif
