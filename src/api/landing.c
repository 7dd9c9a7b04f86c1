#include "bolter/landing.h"

#include "api/case.h"

#include <stdio.h>

bt_status bt_case_land(bt_case* opened, bt_landing_report* report) {
    bt_diag diag = bt_case_diag(opened);
    bt_landing_result result;
    *report = (bt_landing_report){0};
    BT_TRY(bt_group_check(&bt_model_group, &opened->study.model, "", &diag));
    BT_TRY(bt_lander_run(opened->lander, &opened->study.model, &result, NULL, NULL, &diag));

    report->failed = result.outcome == BT_FAILED;
    report->engaged = result.outcome == BT_ENGAGED;
    report->retained = result.retained;
    snprintf(report->mode, sizeof report->mode, "%s", bt_mode_name(result.mode));
    report->margin_m = result.margin_m;
    report->throat_force_peak_N = result.throat_force_peak_N;
    report->hook_deck_force_peak_N = result.hook_deck_force_peak_N;
    report->cable_tension_peak_N = result.cable_tension_max_N;
    report->bounces = result.bounce_count;
    if (result.bounce_count > 0) {
        report->first_bounce_height_m = result.bounces[0].height_m;
        report->first_bounce_distance_m = result.bounces[0].distance_m;
    }
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        report->strut_stroke_max_m[leg] = result.strut_stroke_max_m[leg];
        report->tyre_force_max_N[leg] = result.tyre_force_max_N[leg];
    }
    report->state_hash = result.state_hash;
    if (report->failed)
        snprintf(report->failure, sizeof report->failure, "%s: %s at %g s", result.failed_element,
                 result.failed_quantity, result.failed_time_s);
    return BT_OK;
}
