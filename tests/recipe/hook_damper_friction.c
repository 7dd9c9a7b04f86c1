#include "hook_damper_friction.h"

#include "elements/friction.h"

BT_HOOK_DAMPER_FITS(bt_hook_damper_friction_params, bt_hook_damper_friction_data)

static const double stroke_max_m = 0.6;

static void check_friction_damper(const void* params, const char* path, bt_diag* diag) {
    const bt_hook_damper_friction_params* p = params;
    bt_gas_check(p->precharge_Pa, 101325, p->air_volume_m3, p->air_area_m2 * stroke_max_m, path,
                 diag);
}

// clang-format off
#define ROW(kind, name, ...) BT_ROW_##kind(bt_hook_damper_friction_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(hook_damper_friction, BT_HOOK_DAMPER_FRICTION_FIELDS, ROW, check_friction_damper, "longitudinal damper of the hook: gas spring and friction")
// clang-format on

static void prepare(const void* params, void* data) {
    const bt_hook_damper_friction_params* p = params;
    *(bt_hook_damper_friction_data*)data = (bt_hook_damper_friction_data){
        .gas = {{p->air_volume_m3, p->precharge_Pa, 1.2}, p->air_area_m2, 101325},
        .friction_N = p->friction_N,
        .slip_speed_mps = p->slip_speed_mps,
        .stops = {stroke_max_m, p->stop_stiffness_Npm, 0},
    };
}

static double force(const void* data, double stroke_m, double rate_mps) {
    const bt_hook_damper_friction_data* d = data;
    return bt_gas_spring_force(&d->gas, stroke_m) +
           d->friction_N * bt_friction_factor(rate_mps, d->slip_speed_mps) +
           bt_stops_force(&d->stops, stroke_m, rate_mps);
}

static double energy(const void* data, double stroke_m) {
    const bt_hook_damper_friction_data* d = data;
    return bt_gas_spring_energy(&d->gas, stroke_m) + bt_stops_energy(&d->stops, stroke_m);
}

/// As for a damper of the friction's slope at rest, 3 N / (2 slip_speed), on the stop.
static double step_limit(const void* data, double mass_kg) {
    const bt_hook_damper_friction_data* d = data;
    const double omega2 = d->stops.stiffness / mass_kg;
    const double g = 1.5 * d->friction_N / d->slip_speed_mps / mass_kg;
    return 4 / (g + sqrt(g * g + 4 * omega2));
}

static bt_law law(const void* data, double stroke_m, const char** what) {
    const bt_hook_damper_friction_data* d = data;
    return bt_hook_damper_gas_law(&d->gas, &d->stops, stroke_m, what);
}

const bt_hook_damper_type bt_hook_damper_friction = {
    .data_size = sizeof(bt_hook_damper_friction_data),
    .prepare = prepare,
    .force = force,
    .energy = energy,
    .step_limit = step_limit,
    .law = law,
};
