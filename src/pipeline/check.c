#include "pipeline/check.h"

#include "base/units.h"
#include "campaign/design.h"
#include "campaign/executor.h"
#include "reliability/stop.h"

#include <math.h>
#include <string.h>

/// Settings at which the label-noise study (docs/label-noise.md) has shown that outcomes do not
/// hang on the computation: the defaults of these keys. Coarser ones have not been shown to be
/// good.
static void warn_of_settings(const bt_model_params* model, bt_diag* diag) {
    static const struct {
        const char* path;
        bool at_least; ///< the default is the least that was shown; otherwise the greatest
    } shown[] = {
        {"landing.solver.airframe_step", false},
        {"landing.solver.contact_step", false},
        {"landing.solver.cable_courant", false},
        {"landing.solver.tyre_strips", true},
        {"deck.cable.mesh.fine_length", false},
        {"deck.cable.mesh.medium_length", false},
        {"deck.cable.mesh.coarse_length", false},
        {"deck.cable.mesh.fine_half_width", true},
        {"deck.cable.mesh.medium_half_width", true},
        {"aircraft.hook.cable_contact.slip_speed", true},
    };
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; ++i) {
        size_t offset;
        const bt_field* field = bt_group_find(&bt_model_group, shown[i].path, &offset);
        const double value = bt_field_get(field, model, offset);
        if (shown[i].at_least ? value >= field->fallback : value <= field->fallback)
            continue;
        bt_diag_add(diag, BT_WARNING, BT_NOWHERE,
                    "%s: %.4g %s is %s than what the label-noise study has shown to be good, %.4g; "
                    "`bolter noise` shows it for this study",
                    shown[i].path, value, field->unit[0] ? bt_unit_text(field->unit) : "",
                    shown[i].at_least ? "less" : "more", field->fallback);
    }
}

/// What is allowed but seldom meant: each line is a warning on stderr.
static void warn(const bt_study* study, bt_diag* diag) {
    warn_of_settings(&study->model, diag);
    for (int i = 0; i < study->input_count; ++i) {
        const bt_input* input = &study->inputs[i];
        if (bt_design_is_random(study->campaign.design) || !input->random)
            continue;
        if (!input->bounded) {
            bt_diag_add(diag, BT_WARNING, input->where,
                        "%s scatters but has no range in campaign.bounds: the campaign keeps it at "
                        "its value, so the surrogate cannot know what it does",
                        input->path);
            continue;
        }
        const bt_distribution* d = &input->distribution;
        const double outside =
            bt_distribution_cdf(d, input->lower) + 1 - bt_distribution_cdf(d, input->upper);
        if (outside > 0.05)
            bt_diag_add(diag, BT_WARNING, input->where,
                        "%s: %.0f %% of its distribution lies outside its range in campaign.bounds",
                        input->path, 100 * outside);
    }
}

/// The ends of what an input may be: of its range in the design, or 99.8 % of its distribution.
static void ends_of(const bt_study* study, const bt_input* input, double ends[2]) {
    const bool drawn = bt_design_is_random(study->campaign.design) || !input->bounded;
    ends[0] = drawn ? bt_distribution_quantile(&input->distribution, 0.001) : input->lower;
    ends[1] = drawn ? bt_distribution_quantile(&input->distribution, 0.999) : input->upper;
}

/// Tries whether a landing can begin as the study stands, and with each input at either end, the
/// others as they stand. The former is an error, the latter a warning: such landings will fail.
static bt_status try_ends(const bt_study* study, bt_diag* diag) {
    char why[512], value[64];
    bt_lander* lander = NULL;
    BT_TRY(bt_lander_create(&lander));
    bt_status status = bt_landing_possible(lander, &study->model, why, sizeof why);
    if (status == BT_ERR_INPUT)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s", why);
    for (int i = 0; i < 2 * study->input_count && status == BT_OK; ++i) {
        const bt_input* input = &study->inputs[i / 2];
        bt_model_params model = study->model;
        double ends[2];
        const bool axis = !bt_design_is_random(study->campaign.design) && input->bounded;
        if (!axis && !input->random)
            continue;
        ends_of(study, input, ends);
        bt_field_set(input->field, &model, input->offset, ends[i % 2]);
        const bt_status end = bt_landing_possible(lander, &model, why, sizeof why);
        bt_unit_print(ends[i % 2], input->field->unit[0] ? input->field->unit : "1", value,
                      sizeof value);
        if (end == BT_ERR_INPUT)
            bt_diag_add(diag, BT_WARNING, input->where,
                        "%s: at %s, where its values end, no landing can begin, and such runs "
                        "fail: %s",
                        input->path, value, why);
        else
            status = end;
    }
    bt_lander_destroy(lander);
    return status;
}

/// The part of the aircraft that reaches farthest from the centreline where it comes to the wire:
/// the outer edge of a main wheel, or the hook's head, swung out by a yawed aircraft. Level, struts
/// extended.
static double reach_from_centreline(const bt_model_params* model, double off_centre_m,
                                    const char** part) {
    const bt_gear_params* gear = &model->aircraft.main_gear;
    const bt_hook_params* hook = &model->aircraft.hook;
    const double s = sin(model->landing.yaw_rad), c = cos(model->landing.yaw_rad);
    const double half_track_m =
        gear->half_track_m + 0.5 * gear->tyre.width_m * (double)gear->tyre.tyres;
    const double wheel_m = fabs(off_centre_m + s * gear->station_m) + c * half_track_m;
    const double shoe_x_m = hook->pivot_x_m - hook->length_m * cos(hook->down_stop_rad);
    const double hook_m = fabs(off_centre_m + s * shoe_x_m) + 0.5 * hook->profile.width_m;
    const double half_span_m = 0.5 * model->deck.cable.span_m;
    *part = hook_m > half_span_m ? "the hook" : "a main wheel";
    return hook_m > half_span_m ? hook_m : wheel_m;
}

/// A landing may pass beside the wire, and does (mode passed_beside); it is seldom meant.
static void warn_beside(const bt_study* study, bt_where where, double off_centre_m, bt_diag* diag) {
    const char* part;
    const double reach_m = reach_from_centreline(&study->model, off_centre_m, &part);
    const double beyond_m = reach_m - 0.5 * study->model.deck.cable.span_m;
    if (beyond_m > 0)
        bt_diag_add(diag, BT_WARNING, where,
                    "landing.off_centre: at %.4g m %s passes %.3g m beyond the end of the wire "
                    "(deck.cable.span %.4g m); at most %.4g m off the centre, or a span of %.4g m, "
                    "would do",
                    off_centre_m, part, beyond_m, study->model.deck.cable.span_m,
                    fmax(0, fabs(off_centre_m) - beyond_m), 2 * reach_m);
}

/// As the study stands, or where the values of a scattering landing.off_centre end.
static void warn_of_span(const bt_study* study, bt_diag* diag) {
    double ends[2] = {study->model.landing.off_centre_m, study->model.landing.off_centre_m};
    bt_where where = BT_NOWHERE;
    for (int i = 0; i < study->input_count; ++i)
        if (strcmp(study->inputs[i].path, "landing.off_centre") == 0) {
            ends_of(study, &study->inputs[i], ends);
            where = study->inputs[i].where;
        }
    warn_beside(study, where, ends[0], diag);
    if (ends[1] != ends[0])
        warn_beside(study, where, ends[1], diag);
}

bt_status bt_stage_check(const bt_study* study, bt_check_result* result, bt_diag* diag) {
    bt_design* design = NULL;
    *result = (bt_check_result){0};
    BT_TRY(bt_stop_check(study, diag));
    BT_TRY(bt_design_create(study, &design, diag));
    result->runs = bt_design_count(design);
    bt_design_destroy(design);
    BT_TRY(bt_stable_steps(&study->model, result->steps, &result->step_count, diag));
    warn(study, diag);
    warn_of_span(study, diag);
    return try_ends(study, diag);
}
