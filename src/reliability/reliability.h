/// The probability that the hook catches the wire, for every condition of a study, with an
/// interval that includes the surrogate's own error  [Peng2023 Sec. 5.3, Tables 4 and 5].
#ifndef BT_RELIABILITY_RELIABILITY_H
#define BT_RELIABILITY_RELIABILITY_H

#include "reliability/check.h"
#include "reliability/high_fidelity.h"
#include "surrogate/surrogate.h"

/// One condition: samples of the input distributions on the surrogate, and true runs of some of
/// them. Numbers that were not found out (no true runs) are NAN.
typedef struct bt_reliability_row {
    char parameter[BT_PATH_MAX]; ///< the input whose mean was moved; "" for the study as it stands
    const char* unit;            ///< its unit token; ""
    double value;                ///< the mean, SI; NAN for the study as it stands
    int64_t samples, engaged;    ///< on the surrogate
    double surrogate;            ///< engaged / samples
    bt_interval surrogate_ci95;  ///< Clopper-Pearson: sampling only
    double outside_share;        ///< of the samples, outside the box of the training landings
    bt_interval outside_ci95;
    double outside_missed;  ///< the surrogate estimate were all of those missed ...
    double outside_engaged; ///< ... or all engaged
    int truth_runs;         ///< made, failed ones included
    int truth_failed;       ///< of them, without an outcome
    int disagreements;      ///< of them, with another outcome than the surrogate's
    double disagreement;    ///< share of disagreements, weighted back to the distribution
    bt_interval disagreement_ci95;
    double corrected;           ///< mean(surrogate) + mean(truth - surrogate), weighted
    bt_interval corrected_ci95; ///< covers sampling and surrogate error
    bt_stratum stratum[BT_STRATA];
    double seconds; ///< wall clock; differs from run to run
} bt_reliability_row;

typedef struct bt_reliability_result {
    int condition_count;
    bt_reliability_row condition[BT_CONDITION_MAX];
    bt_reliability_row overall; ///< every input about its own mean
    double seconds;
} bt_reliability_result;

/// Called after each condition, and once more after the overall row.
typedef void bt_reliability_watch(void* user, int done, int total);

typedef struct bt_reliability_options {
    bt_high_fidelity_batch* truth; ///< NULL: no true runs, whatever the study asks for
    void* truth_user;
    int threads;                 ///< for the samples; 0: one per core
    const atomic_int* stop;      ///< may be NULL; once not 0: BT_ERR_INTERRUPTED
    bt_reliability_watch* watch; ///< may be NULL
    void* watch_user;
} bt_reliability_options;

/// Evaluates one condition.
///
/// @param sampler         the distributions, in the truth's order of inputs; its seed and stream
/// are
///                        the key of everything random
/// @param classifier      the surrogate
/// @param truth           may be NULL: nothing is checked
/// @param truth_runs      fresh true runs
/// @param expected_error  guess of the surrogate's error rate (places the true runs)
/// @param row             parameter, unit and value are left as they are
/// @return BT_OK, BT_ERR_MEMORY, or what the truth returned
BT_CHECKED bt_status bt_reliability_condition(const bt_sampler* sampler,
                                              const bt_classifier* classifier, int64_t samples,
                                              int threads, bt_high_fidelity_batch* truth,
                                              void* truth_user, int truth_runs,
                                              double expected_error, bt_reliability_row* row);

/// Evaluates every condition of a study and the study as it stands. The same bits for any number
/// of threads but for the seconds.
///
/// An input with a distribution is drawn from it (in its own condition, moved to the condition's
/// mean); one without stays at its value in the model; with `others: frozen` every input but the
/// condition's stays at its mean.
///
/// @return BT_OK; BT_ERR_INPUT (an input of the surrogate is not an input of the study; said in
///         diag); BT_ERR_INTERRUPTED; BT_ERR_MEMORY; what the truth returned
BT_CHECKED bt_status bt_reliability_run(const bt_study* study, const bt_surrogate* surrogate,
                                        const bt_reliability_options* options,
                                        bt_reliability_result* result, bt_diag* diag);

/// The distributions of one condition; condition -1 is the study as it stands.
bt_sampler bt_reliability_sampler(const bt_study* study, int condition);

/// A surrogate as a classifier of a study's inputs.
typedef struct bt_surrogate_classifier bt_surrogate_classifier;

/// Lays the surrogate out for the vector units and finds its inputs among the study's.
/// BT_ERR_INPUT as above, BT_ERR_MEMORY. The surrogate must outlive it.
BT_CHECKED bt_status bt_surrogate_classifier_create(const bt_study* study,
                                                    const bt_surrogate* surrogate,
                                                    bt_surrogate_classifier** made, bt_diag* diag);
void bt_surrogate_classifier_destroy(bt_surrogate_classifier* made);
const bt_classifier* bt_surrogate_classifier_get(const bt_surrogate_classifier* made);

#endif
