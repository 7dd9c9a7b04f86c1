#include "campaign/params.h"

const char* const bt_design_names[] = {"sobol",       "latin_hypercube", "full_factorial",
                                       "monte_carlo", "conditions",      NULL};

bool bt_design_is_random(int design) {
    return design == BT_DESIGN_MONTE_CARLO || design == BT_DESIGN_CONDITIONS;
}

#define ROW(kind, name, ...) BT_ROW_##kind(bt_campaign_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(campaign, BT_CAMPAIGN_FIELDS, ROW, NULL, "the landings to run")
