#include "landing/leg.h"
#include "rigs/rig.h"

#include <math.h>

enum { STROKE, CLOSING, OPENING };

const char* const bt_static_channels[BT_STATIC_CHANNELS] = {"stroke_m", "strut_force_N",
                                                            "opening_force_N"};

/// The strut at a stroke: pressed together (direction 1) or let out (-1), friction fully developed.
static double load(const bt_oleo* oleo, double stroke_m, double speed_mps, double direction) {
    const double rate = direction * speed_mps;
    const double gas = bt_oleo_gas_force(oleo, stroke_m);
    const double oil = bt_oleo_oil_force(oleo, stroke_m, rate);
    const double friction =
        bt_oleo_friction_force(oleo, stroke_m, direction * oleo->friction_speed, gas, oil);
    return gas + oil + bt_oleo_limit_force(oleo, stroke_m, rate) + friction;
}

typedef struct static_test {
    bt_oleo oleo;
    double speed_mps, step_m;
    double value[BT_STATIC_CHANNELS];
    double extended_N, work_J, given_back_J;
} static_test;

/// One point of the press; what lies since the last one is added to the work.
static void advance(static_test* p, int64_t i) {
    const double stroke = (double)i * p->step_m;
    const double closing = load(&p->oleo, stroke, p->speed_mps, 1);
    const double opening = load(&p->oleo, stroke, p->speed_mps, -1);
    if (i == 0)
        p->extended_N = closing;
    else {
        p->work_J += 0.5 * p->step_m * (closing + p->value[CLOSING]);
        p->given_back_J += 0.5 * p->step_m * (opening + p->value[OPENING]);
    }
    p->value[STROKE] = stroke;
    p->value[CLOSING] = closing;
    p->value[OPENING] = opening;
}

bt_status bt_rig_run_static(const bt_gear_params* gear, const bt_static_params* params,
                            bt_rig_result* result, bt_rig_observer* observer, void* user,
                            bt_diag* diag) {
    const double stroke = params->stroke_m > 0 ? params->stroke_m : gear->oleo.stroke_max_m;
    const bt_static_reference_params* ref = &params->reference;
    const bt_rig rig = {.observer = observer, .user = user};
    static_test p = {.speed_mps = params->speed_mps, .step_m = stroke / (double)params->points};
    bt_gear_prepare_oleo(gear, &p.oleo);
    if (!isfinite(bt_oleo_gas_force(&p.oleo, stroke))) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "stroke: no gas volume is left at %g m", stroke);
        return BT_ERR_INPUT;
    }
    for (int64_t i = 0; i <= params->points; ++i) {
        advance(&p, i);
        bt_rig_show_at(&rig, p.value[STROKE] / p.speed_mps, BT_STATIC_CHANNELS, bt_static_channels,
                       p.value);
    }
    *result = (bt_rig_result){.steps = params->points, .end_time_s = stroke / p.speed_mps};
    const char* what = NULL;
    if (bt_oleo_law(&p.oleo, stroke, &what) == BT_LAW_AT_LIMIT)
        result->remarks[result->remark_count++] = (bt_rig_remark){
            .element = "strut", .what = what, .time_s = p.oleo.stops.stroke_max / p.speed_mps};
    bt_rig_add(result, "load_extended_N", "N", p.extended_N, ref->load_extended_N, ref->tolerance);
    bt_rig_add(result, "load_compressed_N", "N", p.value[CLOSING], ref->load_compressed_N,
               ref->tolerance);
    bt_rig_add(result, "energy_J", "J", p.work_J, ref->energy_J, ref->tolerance);
    bt_rig_add(result, "hysteresis_J", "J", p.work_J - p.given_back_J, 0, 0);
    return BT_OK;
}
