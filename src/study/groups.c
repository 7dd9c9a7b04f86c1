#include "study/study.h"

const char* const bt_design_names[] = {"sobol",       "latin_hypercube", "full_factorial",
                                       "monte_carlo", "conditions",      NULL};

bool bt_design_is_random(int design) {
    return design == BT_DESIGN_MONTE_CARLO || design == BT_DESIGN_CONDITIONS;
}

const char* const bt_others_names[] = {"scatter", "frozen", NULL};

#define ROW(kind, name, ...) BT_ROW_##kind(bt_campaign_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(campaign, BT_CAMPAIGN_FIELDS, ROW, NULL, "the landings to run")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_surrogate_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(surrogate, BT_SURROGATE_FIELDS, ROW, NULL, "the support-vector classifier")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_reliability_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(reliability, BT_RELIABILITY_FIELDS, ROW, NULL, "the probability of engagement")
#undef ROW
