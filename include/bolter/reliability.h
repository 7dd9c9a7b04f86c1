/// The probability that the hook catches the wire, for every condition of a study.
#ifndef BOLTER_RELIABILITY_H
#define BOLTER_RELIABILITY_H

#include "bolter/surrogate.h"

#ifdef __cplusplus
extern "C" {
#endif

/// One condition: the mean of one input at a value, the others as distributed. Texts are valid
/// during the call only. Intervals are at 95 %; what was not found out is NAN.
typedef struct bt_reliability_line {
    const char* parameter; ///< path of the input; "" for the study as it stands
    const char* unit;      ///< SI, of value
    double value;          ///< the mean
    /// The number to defend: classifier and landings together. Its interval covers sampling, the
    /// classifier's error, and errors of a kind that was never seen.
    double corrected, corrected_ci95[2];
    double corrected_sampling, corrected_unseen; ///< parts of its half-width
    double reweighted, reweighted_ci95[2];       ///< from the landings alone, no classifier
    double effective_landings; ///< landings of the condition itself that would weigh as much
    double surrogate, surrogate_ci95[2]; ///< the classifier alone; the interval is sampling only
    double outside_share;                ///< of the samples, outside what was trained
    int64_t landings;                    ///< behind the corrected number
} bt_reliability_line;

/// Receives the conditions in the study's order, and last the study as it stands.
typedef void bt_reliability_visit(void* user, const bt_reliability_line* line);

/// Called after each condition; false: the call returns BT_ERR_INTERRUPTED.
typedef bool bt_reliability_progressed(void* user, int done, int total);

/// What to do. Set size to sizeof(bt_reliability_def); what is zero is the default.
typedef struct bt_reliability_def {
    size_t size;
    bt_reliability_progressed* progress; ///< may be NULL
    void* user;                          ///< of progress
} bt_reliability_def;

/// Computes the reliability of every condition of the study on its ledger and classifier (which is
/// trained when it is not up to date), and shows it line by line. Warnings (columns that disagree,
/// a classifier that cannot carry the number) go to the case's message function.
/// BT_ERR_IO (no ledger), BT_ERR_INPUT, BT_ERR_INTERRUPTED, BT_ERR_MEMORY, BT_ERR_ARG (no size).
BT_PUBLIC BT_CHECKED bt_status bt_case_reliability(bt_case* opened, const bt_reliability_def* def,
                                                   bt_reliability_visit* visit, void* user);

#ifdef __cplusplus
}
#endif

#endif
