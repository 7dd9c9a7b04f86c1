/// The executor: one call for a batch of landings, "these points, these results". Points come from
/// a source, results go to a sink, and a back end (campaign/backend.h) computes them.
#ifndef BT_CAMPAIGN_EXECUTOR_H
#define BT_CAMPAIGN_EXECUTOR_H

#include "campaign/design.h"

#include <stdatomic.h>

/// One landing to run: a number the caller knows it by, and its point x [axes.count], SI.
typedef struct bt_job {
    int64_t run;
    double x[BT_INPUT_MAX];
} bt_job;

/// Gives the next job; false when there is none left, and then it is not asked again. Called, like
/// the sink and the pulse, on the thread that called bt_executor_run.
typedef bool bt_job_source(void* user, bt_job* job);

/// Receives a finished landing, in order of arrival. A status other than BT_OK ends the work.
typedef bt_status bt_job_sink(void* user, const bt_job* job, const bt_landing_result* result);

/// Called at least four times a second: commit, show progress.
typedef bt_status bt_job_pulse(void* user);

/// What the observer of a job's landing is given; called on the thread that runs it, at the same
/// time as others: it may only look up what belongs to this job.
typedef void* bt_job_observed(void* user, const bt_job* job);

typedef struct bt_backend bt_backend;

typedef struct bt_executor {
    const bt_model_params* model; ///< what every landing shares
    const bt_input* inputs;       ///< the study's inputs
    const bt_axes* axes;          ///< which of them x is made of
    int threads;                  ///< see bt_thread_count
    /// May be NULL. Once not 0 no more landings begin; those in flight may end, or are given up
    /// half a second later.
    const atomic_int* stop;
    bt_job_source* source;
    bt_job_sink* sink;
    bt_job_pulse* pulse;           ///< may be NULL
    bt_landing_observer* observer; ///< may be NULL; needs a back end in this process
    bt_job_observed* observed;     ///< its user, for each job
    void* user;                    ///< handed to source, sink, pulse and observed
    const bt_backend* backend;     ///< NULL: threads
} bt_executor;

/// Runs every job. What a job's own numbers make impossible is a result, not an error: a landing
/// that diverges, a point outside what the model allows, and one that cannot be assembled or has
/// no equilibrium (failed_element names the key, failed_quantity the reason).
/// Returns BT_OK, BT_ERR_INTERRUPTED (stop was set while jobs were left), what the sink or the
/// pulse returned, BT_ERR_MEMORY.
BT_CHECKED bt_status bt_executor_run(const bt_executor* executor, bt_diag* diag);

/// One landing on the calling thread: the model with x in place of its axes; impossible numbers as
/// in bt_executor_run. `model` is scratch: its axes are overwritten. Returns BT_OK,
/// BT_ERR_INTERRUPTED (bt_lander_obey), BT_ERR_MEMORY.
BT_CHECKED bt_status bt_landing_at(bt_lander* lander, bt_model_params* model,
                                   const bt_input* inputs, const bt_axes* axes, const double* x,
                                   bt_landing_result* result, bt_landing_observer* observer,
                                   void* user);

/// Whether a landing with this model could begin. BT_ERR_INPUT: `why` [size] receives the first
/// reason, "key: limit"; BT_ERR_MEMORY.
BT_CHECKED bt_status bt_landing_possible(bt_lander* lander, const bt_model_params* model, char* why,
                                         size_t size);

/// One landing of a model that has no fault yet: checks it first; otherwise as bt_landing_at.
BT_CHECKED bt_status bt_landing_try(bt_lander* lander, const bt_model_params* model,
                                    bt_landing_result* result, bt_landing_observer* observer,
                                    void* user);

#endif
