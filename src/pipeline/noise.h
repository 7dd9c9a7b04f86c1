/// Label noise: the share of landings whose outcome changes when the computation is refined. No
/// surrogate can be more right than its labels are; this says how right they are.
#ifndef BT_PIPELINE_NOISE_H
#define BT_PIPELINE_NOISE_H

#include "campaign/executor.h"

enum { BT_NOISE_CHANGES_MAX = 6 };

/// One key of the model and what its value is multiplied by.
typedef struct bt_noise_change {
    const char* path; ///< "landing.solver.contact_step"; NULL ends the list
    double factor;
} bt_noise_change;

/// A way to refine (or coarsen) the computation.
typedef struct bt_noise_variant {
    const char* name; ///< "steps_halved"
    const char* text; ///< what it does, for people
    bt_noise_change changes[BT_NOISE_CHANGES_MAX + 1];
} bt_noise_variant;

/// The variants that the label-noise study runs; the last one has no name.
extern const bt_noise_variant bt_noise_variants[];

/// What is kept of a landing.
typedef struct bt_noise_landing {
    bt_outcome outcome;
    bt_mode mode;
    int64_t wire; ///< that was caught; 0: none
    double margin_m, wall_s;
    double x[BT_INPUT_MAX]; ///< its inputs, SI
    char failure[160];      ///< "key: reason" of a failed one
} bt_noise_landing;

/// Runs `count` landings drawn from the study's distributions (`uncertainty:`), keyed by the seed
/// of its campaign: landing i has the same inputs whatever the variant.
///
/// @param variant   NULL: the study as it is
/// @param threads   0: one per core
/// @param stop      may be NULL; see bt_executor
/// @param backend   NULL: threads of this process
/// @param landings  [count] receives the landings
/// @return BT_OK; BT_ERR_INPUT (no random input, or a landing that cannot be assembled; said in
///         diag), BT_ERR_INTERRUPTED, BT_ERR_MEMORY
BT_CHECKED bt_status bt_noise_run(const bt_study* study, const bt_noise_variant* variant,
                                  int64_t count, int threads, const atomic_int* stop,
                                  const bt_backend* backend, bt_noise_landing* landings,
                                  bt_diag* diag);

/// Whether no more landings failed than campaign.max_failed allows. BT_ERR_FAILED_RUNS, said in
/// diag with the first of their reasons.
BT_CHECKED bt_status bt_noise_check_failed(const bt_study* study, const bt_noise_landing* landings,
                                           int64_t count, bt_diag* diag);

/// The share engaged of those that have an outcome; NAN when none has.
double bt_noise_engaged_share(const bt_noise_landing* landings, int64_t count);

/// What two runs of the same landings differ in.
typedef struct bt_noise_difference {
    int64_t flips;          ///< landings with another outcome, or another wire caught
    int64_t failed;         ///< landings of the second run that failed
    int64_t wrong_side;     ///< landings of the second run whose margin and outcome disagree
    double margin_median_m; ///< median of |margin - margin|, over landings that have both
    double margin_p90_m, margin_p99_m; ///< its 90th and 99th percentile
    double wall_s;                     ///< mean per landing of the second run
} bt_noise_difference;

/// Compares; `first` may be `second` (then only its own counts are of interest).
BT_CHECKED bt_status bt_noise_compare(const bt_noise_landing* first, const bt_noise_landing* second,
                                      int64_t count, bt_noise_difference* difference);

/// What a label-noise study runs, and who is told of it.
typedef struct bt_noise_stage {
    int64_t count;             ///< landings per computation
    int threads;               ///< 0: one per core
    const atomic_int* stop;    ///< may be NULL; see bt_executor
    const bt_backend* backend; ///< NULL: threads of this process
    const bool* wanted;        ///< one flag per row of bt_noise_variants; NULL: all of them
    /// Told of each computation: the study as it is first (variant NULL), then the variants.
    bt_status (*sink)(void* user, const bt_noise_variant* variant, const bt_noise_landing* base,
                      const bt_noise_landing* landings, const bt_noise_difference* difference);
    void* user;
} bt_noise_stage;

/// The label-noise study: the same landings as the study sets them and with each variant.
///
/// @return BT_OK; BT_ERR_FAILED_RUNS (more than campaign.max_failed, in any computation); what
///         bt_noise_run and the sink return
BT_CHECKED bt_status bt_stage_noise(const bt_study* study, const bt_noise_stage* stage,
                                    bt_diag* diag);

#endif
