/// A surrogate as a classifier of a study's inputs.
#ifndef BT_RELIABILITY_CLASSIFIER_H
#define BT_RELIABILITY_CLASSIFIER_H

#include "reliability/monte_carlo.h"
#include "surrogate/surrogate.h"

typedef struct bt_surrogate_classifier bt_surrogate_classifier;

/// Lays the surrogate out for the vector units and finds its inputs and features among the
/// study's. BT_ERR_INPUT (an input of the surrogate is not an input of the study; said in diag),
/// BT_ERR_MEMORY. The surrogate must outlive it.
BT_CHECKED bt_status bt_surrogate_classifier_create(const bt_study* study,
                                                    const bt_surrogate* surrogate,
                                                    bt_surrogate_classifier** made, bt_diag* diag);
void bt_surrogate_classifier_destroy(bt_surrogate_classifier* made);
const bt_classifier* bt_surrogate_classifier_get(const bt_surrogate_classifier* made);

/// Writes the names of the inputs, and of the features after them, into a surrogate's paths.
void bt_surrogate_name(bt_surrogate* surrogate, const bt_study* study, const int* inputs,
                       int count);

#endif
