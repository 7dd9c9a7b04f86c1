/// The classifier that stands for the model: trained on the landings of the ledger.
#ifndef BOLTER_SURROGATE_H
#define BOLTER_SURROGATE_H

#include "bolter/campaign.h"

#ifdef __cplusplus
extern "C" {
#endif

/// How good a classifier is. Set size to sizeof(bt_fit_report) before the call.
typedef struct bt_fit_report {
    size_t size;
    bool trained_now;               ///< false: the one on disk was up to date
    int train_count, train_correct; ///< its own landings: no evidence of accuracy
    int holdout_count, holdout_correct;
    double holdout_ci95[2]; ///< Clopper-Pearson, of the share that is correct
    int confusion[2][2];    ///< hold-out counts [true][predicted], 0 missed, 1 engaged
    bool constant;          ///< every landing was of one kind
    double C, gamma;
    int support_vectors;
    double seconds; ///< time of selection and training
} bt_fit_report;

/// What to do. Set size to sizeof(bt_fit_def).
typedef struct bt_fit_def {
    size_t size;
    bool again; ///< train even when the classifier on disk is up to date
} bt_fit_def;

/// Trains the classifier of the study on its ledger and keeps it in surrogate.model, or takes the
/// one that is there when it came from the same landings and settings. The case keeps it for
/// bt_case_predict. BT_ERR_IO (no ledger), BT_ERR_ARG (nothing to train on, no size),
/// BT_ERR_MEMORY; said to the case's message function.
BT_PUBLIC BT_CHECKED bt_status bt_case_fit(bt_case* opened, const bt_fit_def* def,
                                           bt_fit_report* report);

/// What the classifier of the last bt_case_fit takes: how many inputs, and the path of each.
BT_PUBLIC int bt_case_fit_inputs(const bt_case* opened); ///< 0 before a fit
BT_PUBLIC const char* bt_case_fit_input(const bt_case* opened, int input);

/// Predicts landings.
///
/// @param points    [count * inputs] row-major, SI, in the order of bt_case_fit_input
/// @param decision  [count] receives the decision value f(x): engaged when above 0
/// @return BT_OK; BT_ERR_ARG before a fit
BT_PUBLIC BT_CHECKED bt_status bt_case_predict(const bt_case* opened, const double* points,
                                               int count, double* decision);

#ifdef __cplusplus
}
#endif

#endif
