/// What a study says of its reliability analysis.
#ifndef BT_RELIABILITY_PARAMS_H
#define BT_RELIABILITY_PARAMS_H

#include "base/fields.h"

extern const char* const bt_others_names[]; ///< scatter, frozen
enum { BT_OTHERS_SCATTER, BT_OTHERS_FROZEN };

#define BT_RELIABILITY_FIELDS(F)                                                                   \
    F(COUNT, samples, _, OPTIONAL, 1000000, 100, 1e10, "Sec. 5.3",                                 \
      "points per condition on the surrogate")                                                     \
    F(COUNT, high_fidelity_runs, _, OPTIONAL, 200, 0, 1e9, "",                                     \
      "fresh simulated landings per condition that check and correct the surrogate")               \
    F(CHOICE, others, bt_others_names, OPTIONAL, 0, 0, 0, "Sec. 5.3",                              \
      "what the other inputs do in a condition: scatter about their means, or stay frozen at "     \
      "them")                                                                                      \
    F(PLAIN, half_width, _, OPTIONAL, 0, 0, 0.5, "",                                               \
      "landings go on in rounds until the interval of every condition is so narrow: half its "     \
      "width, 0.005 for half a point; 0: campaign.samples landings")                               \
    F(PLAIN, cov, _, OPTIONAL, 0, 0, 10, "",                                                       \
      "landings go on in rounds until the miss probability of every condition is known with this " \
      "coefficient of variation; 0: not asked for")                                                \
    F(COUNT, seed, _, OPTIONAL, 2, 0, 9e15, "", "key of the random numbers of the analysis")
BT_DECLARE_GROUP(reliability, BT_RELIABILITY_FIELDS)

#endif
