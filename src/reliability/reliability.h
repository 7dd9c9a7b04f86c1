/// The probability that the hook catches the wire, for every condition of a study, with an
/// interval that includes the surrogate's own error  [Peng2023 Sec. 5.3, Tables 4 and 5].
#ifndef BT_RELIABILITY_RELIABILITY_H
#define BT_RELIABILITY_RELIABILITY_H

#include "reliability/check.h"
#include "reliability/event.h"
#include "reliability/high_fidelity.h"
#include "reliability/judged.h"
#include "reliability/widths.h"
#include "reliability/zone.h"
#include "surrogate/surrogate.h"

/// One condition: samples of the input distributions on the surrogate, and high-fidelity runs of
/// some of them. Numbers that were not found out (no high-fidelity runs) are NAN.
typedef struct bt_reliability_row {
    char parameter[BT_PATH_MAX]; ///< the input whose mean was moved; "" for the study as it stands
    const char* unit;            ///< its unit token; ""
    double value;                ///< the mean, SI; NAN for the study as it stands
    int64_t samples, engaged;    ///< on the surrogate
    double surrogate;            ///< engaged / samples
    bt_interval surrogate_ci95;  ///< Clopper-Pearson: sampling only
    double outside_share;        ///< of the samples, outside the box of the training landings
    bt_interval outside_ci95;
    double outside_missed;    ///< the surrogate estimate were all of those missed ...
    double outside_engaged;   ///< ... or all engaged
    int high_fidelity_runs;   ///< made, failed ones included
    int high_fidelity_failed; ///< of them, without an outcome
    int disagreements;        ///< of them, with another outcome than the surrogate's
    double disagreement;      ///< share of disagreements, weighted back to the distribution
    bt_interval disagreement_ci95;
    double corrected;           ///< the number to defend: mean(surrogate) + mean(model - surrogate)
    bt_interval corrected_ci95; ///< covers sampling, surrogate error and what was never seen
    double corrected_sampling;  ///< half-width that what was seen gives
    double corrected_unseen;    ///< what errors of a kind never seen add to it; NAN when the fresh
                                ///< runs of the condition alone correct it
    bool pooled;                ///< the corrected number comes from the landings of the ledger
    int landings;               ///< behind the corrected number: judged landings, or fresh runs
    double reweighted;          ///< from the landings alone, without a classifier
    bt_interval reweighted_ci95;
    double effective_landings; ///< landings of the condition itself that would weigh as much
    bt_stratum stratum[BT_STRATA];
    double seconds; ///< wall clock; differs from run to run
} bt_reliability_row;

/// What moving an input's mean changes, on the same landings.
typedef struct bt_reliability_difference {
    int from, to;      ///< conditions
    double difference; ///< R(to) - R(from)
    bt_interval ci95;
} bt_reliability_difference;

/// The probability of an event, from the landings of the ledger as the corrected number of a row.
typedef struct bt_event_estimate {
    double probability; ///< NAN: the zone has none
    bt_interval ci95;   ///< covers sampling, the classifiers' error and what was never seen
    double sampling;    ///< half-width that what was seen gives
    double unseen;      ///< what errors of a kind never seen add to it
    double classifier;  ///< share that the event's classifiers predict; NAN: too few landings
} bt_event_estimate;

/// One event under every condition and in every touchdown zone.
typedef struct bt_event_row {
    char name[BT_EVENT_NAME_SIZE], text[BT_EVENT_TEXT_SIZE];
    int judged, disagreed; ///< landings that a classifier judged before it learnt from them, and
                           ///< wrongly: its error on landings it never saw
    bt_event_estimate condition[BT_CONDITION_MAX], overall;
    bt_event_estimate zone[BT_ZONE_MAX]; ///< given the zone, every input about its own mean
} bt_event_row;

/// The surrogate behind the table.
typedef struct bt_reliability_classifier {
    double holdout_accuracy; ///< NAN when nothing was held out
    int holdout_count, support_vectors;
    bool features; ///< it learnt from physics features too
    double C, gamma;
} bt_reliability_classifier;

enum { BT_WARNING_MAX = 8, BT_WARNING_SIZE = 320 };

typedef struct bt_reliability_result {
    int condition_count;
    bt_reliability_row condition[BT_CONDITION_MAX];
    bt_reliability_row overall; ///< every input about its own mean
    bt_reliability_classifier classifier;
    int64_t landings; ///< in the ledger, and fresh runs: each counted once
    int difference_count;
    bt_reliability_difference difference[BT_CONDITION_MAX]; ///< neighbours of one input
    int event_count;
    bt_event_row event[BT_EVENT_MAX];
    bt_zones zones;
    int width_count;
    bt_width width[BT_ROUNDS_MAX]; ///< after every round; last, all landings
    int warning_count;
    char warning[BT_WARNING_MAX][BT_WARNING_SIZE]; ///< what the reader of the table must know
    double seconds;
} bt_reliability_result;

/// Called after each condition, and once more after the overall row.
typedef void bt_reliability_watch(void* user, int done, int total);

typedef struct bt_reliability_options {
    const bt_judged* judged; ///< the landings of the ledger; NULL: the estimates use none
    const bt_event* events;  ///< [event_count] that the landings were read for
    int event_count;
    bt_high_fidelity_batch*
        high_fidelity; ///< NULL: no high-fidelity runs, whatever the study asks for
    void* high_fidelity_user;
    int threads;                 ///< for the samples; 0: one per core
    const atomic_int* stop;      ///< may be NULL; once not 0: BT_ERR_INTERRUPTED
    bt_reliability_watch* watch; ///< may be NULL
    void* watch_user;
} bt_reliability_options;

/// Evaluates one condition.
///
/// @param sampler         the distributions, in the study's order of inputs; its seed and stream
/// are
///                        the key of everything random
/// @param classifier      the surrogate
/// @param high_fidelity           may be NULL: nothing is checked
/// @param high_fidelity_runs      fresh high-fidelity runs
/// @param expected_error  guess of the surrogate's error rate (places the high-fidelity runs)
/// @param row             parameter, unit and value are left as they are
/// @return BT_OK, BT_ERR_MEMORY, or what `high_fidelity` returned
BT_CHECKED bt_status bt_reliability_condition(const bt_sampler* sampler,
                                              const bt_classifier* classifier, int64_t samples,
                                              int threads, bt_high_fidelity_batch* high_fidelity,
                                              void* high_fidelity_user, int high_fidelity_runs,
                                              double expected_error, bt_reliability_row* row);

/// Evaluates every condition of a study and the study as it stands. The same bits for any number
/// of threads but for the seconds.
///
/// An input with a distribution is drawn from it (in its own condition, moved to the condition's
/// mean); one without stays at its value in the model; with `others: frozen` every input but the
/// condition's stays at its mean.
///
/// @return BT_OK; BT_ERR_INPUT (an input of the surrogate is not an input of the study; said in
///         diag); BT_ERR_INTERRUPTED; BT_ERR_MEMORY; what `high_fidelity` returned
BT_CHECKED bt_status bt_reliability_run(const bt_study* study, const bt_surrogate* surrogate,
                                        const bt_reliability_options* options,
                                        bt_reliability_result* result, bt_diag* diag);

/// The distributions of one condition; condition -1 is the study as it stands.
bt_sampler bt_reliability_sampler(const bt_study* study, int condition);

#endif
