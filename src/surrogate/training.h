/// What model selection and fitting share: landings standardised and laid out for LIBSVM, and one
/// support-vector classifier trained on some of them. Private to the surrogate.
#ifndef BT_SURROGATE_TRAINING_H
#define BT_SURROGATE_TRAINING_H

#include "surrogate/surrogate.h"

#include <libsvm/svm.h>

/// Landings in use: split into hold-out and training, standardised.
typedef struct bt_training {
    const bt_training_set* set;
    int dims;
    struct svm_node* nodes; ///< [count * (dims + 1)] standardised
    double* z;              ///< [count * dims] the same, dense
    int* list;              ///< indices of the training landings: +1 first, each class shuffled
    int train[2];           ///< training landings of class +1, -1
    int* holdout;           ///< indices of the landings kept apart
    int holdout_count;
    double centre[BT_INPUT_MAX],
        scale[BT_INPUT_MAX]; ///< mean and spread of the training landings, SI
    double least[BT_INPUT_MAX], greatest[BT_INPUT_MAX]; ///< their box, SI
} bt_training;

/// Checks the landings, splits them by keyed random numbers (each class gives the same share of
/// hold-out) and standardises them with weights 1. Errors as bt_surrogate_select. The caller gives
/// it back with bt_training_destroy, whatever was returned.
BT_CHECKED bt_status bt_training_create(const bt_training_set* set, double holdout, uint64_t seed,
                                        bt_training* t, bt_diag* diag);
void bt_training_destroy(bt_training* t);

/// Weighs the inputs: divides scale by weight and standardises again.
void bt_training_weigh(bt_training* t, const double* weight);

/// How one training ended.
typedef struct bt_svm_effort {
    long iterations; ///< iterations of LIBSVM
    bool gave_up;    ///< it stopped at its limit: 10^7, or 100 per landing
} bt_svm_effort;

/// Trains a support-vector classifier on the n landings of `list` (class +1 first), for points that
/// are standardised already: its centre is 0, its scale 1. Landings of one class give a constant
/// classifier. On BT_OK the caller owns *out.
BT_CHECKED bt_status bt_svm_train(const bt_training* t, const int* list, int n, double C,
                                  double gamma, double tolerance, bt_surrogate* out,
                                  bt_svm_effort* effort);

#endif
