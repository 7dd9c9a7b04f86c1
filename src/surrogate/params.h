/// What a study says of its surrogate.
#ifndef BT_SURROGATE_PARAMS_H
#define BT_SURROGATE_PARAMS_H

#include "base/fields.h"

#define BT_SURROGATE_FIELDS(F)                                                                     \
    F(LIST, C, 1, OPTIONAL, 0, 1e-6, 1e12, "Eq. 19",                                               \
      "penalties tried by cross-validation; default 10^0..10^5")                                   \
    F(LIST, gamma, 1, OPTIONAL, 0, 1e-6, 1e6, "Eq. 20",                                            \
      "kernel widths tried by cross-validation; default 0.1..10, on standardised inputs")          \
    F(COUNT, folds, _, OPTIONAL, 5, 2, 100, "Sec. 5.2", "folds of the cross-validation")           \
    F(PLAIN, holdout, _, OPTIONAL, 0.2, 0.01, 0.9, "",                                             \
      "share of the landings kept out of training to measure the accuracy on")                     \
    F(FLAG, features, _, OPTIONAL, 1, 0, 1, "",                                                    \
      "learn from the wheels' height over the cable too, which geometry and inputs tell")
BT_DECLARE_GROUP(surrogate, BT_SURROGATE_FIELDS)

#endif
