/// What a study says of its campaign.
#ifndef BT_CAMPAIGN_PARAMS_H
#define BT_CAMPAIGN_PARAMS_H

#include "base/fields.h"

/// sobol, latin_hypercube, full_factorial, monte_carlo, conditions
extern const char* const bt_design_names[];
enum {
    BT_DESIGN_SOBOL,
    BT_DESIGN_LATIN_HYPERCUBE,
    BT_DESIGN_FULL_FACTORIAL,
    BT_DESIGN_MONTE_CARLO,
    BT_DESIGN_CONDITIONS
};

#define BT_CAMPAIGN_FIELDS(F)                                                                      \
    F(CHOICE, design, bt_design_names, OPTIONAL, 0, 0, 0, "Sec. 5.2",                              \
      "design of experiments over the box of `bounds` (monte_carlo: over the distributions; "      \
      "conditions: over the distributions of all conditions together)")                            \
    F(PLAIN, unsure, _, OPTIONAL, 0.3, 0, 0.9, "",                                                 \
      "conditions: share of each round's landings where the classifier is unsure; 0: no rounds")   \
    F(COUNT, samples, _, OPTIONAL, 4096, 1, 1e9, "Sec. 5.2",                                       \
      "number of landings; the paper ran 42,000")                                                  \
    F(COUNT, max_landings, _, OPTIONAL, 0, 0, 1e9, "",                                             \
      "most landings when reliability.half_width or reliability.cov is asked for; 0: samples")     \
    F(COUNT, seed, _, OPTIONAL, 1, 0, 9e15, "", "key of all random numbers of the study")          \
    F(COUNT, threads, _, OPTIONAL, 0, 0, 4096, "",                                                 \
      "threads; 0 for one per core. Never changes a result")                                       \
    F(PLAIN, max_failed, _, OPTIONAL, 0.01, 0, 1, "",                                              \
      "share of failed runs above which the campaign is in error")
BT_DECLARE_GROUP(campaign, BT_CAMPAIGN_FIELDS)

/// Whether a design draws from the distributions of `uncertainty` (its axes are the random inputs);
/// the others fill the box of `bounds`.
bool bt_design_is_random(int design);

#endif
