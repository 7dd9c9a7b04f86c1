#include "elements/hook_damper_viscous.h"

BT_HOOK_DAMPER_FITS(bt_hook_damper_viscous_params, bt_hook_damper_viscous_data)

static void check_viscous_damper(const void* params, const char* path, bt_diag* diag) {
    const bt_hook_damper_viscous_params* p = params;
    bt_gas_check(p->precharge_Pa, p->ambient_Pa, p->air_volume_m3, p->air_area_m2 * p->stroke_max_m,
                 path, diag);
}

// clang-format off
#define ROW(kind, name, ...) BT_ROW_##kind(bt_hook_damper_viscous_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(hook_damper_viscous, BT_HOOK_DAMPER_VISCOUS_FIELDS, ROW, check_viscous_damper, "longitudinal damper of the hook: gas spring and damping in proportion to the rate")
// clang-format on

static void prepare(const void* params, void* data) {
    const bt_hook_damper_viscous_params* p = params;
    *(bt_hook_damper_viscous_data*)data = (bt_hook_damper_viscous_data){
        .gas = {{p->air_volume_m3, p->precharge_Pa, p->gas_exponent},
                p->air_area_m2,
                p->ambient_Pa},
        .compression = p->damping_Npmps,
        .extension = p->rebound_damping_Npmps > 0 ? p->rebound_damping_Npmps : p->damping_Npmps,
        .stops = {p->stroke_max_m, p->stop_stiffness_Npm, p->stop_damping_Npmps},
    };
}

static double force(const void* data, double stroke_m, double rate_mps) {
    const bt_hook_damper_viscous_data* d = data;
    return bt_gas_spring_force(&d->gas, stroke_m) +
           (rate_mps < 0 ? d->extension : d->compression) * rate_mps +
           bt_stops_force(&d->stops, stroke_m, rate_mps);
}

static double energy(const void* data, double stroke_m) {
    const bt_hook_damper_viscous_data* d = data;
    return bt_gas_spring_energy(&d->gas, stroke_m) + bt_stops_energy(&d->stops, stroke_m);
}

/// omega^2 h^2 + 2 g h <= 4 on the stop, with the damping g = c / m of the last half step.
static double step_limit(const void* data, double mass_kg) {
    const bt_hook_damper_viscous_data* d = data;
    const double omega2 = d->stops.stiffness / mass_kg;
    const double g = fmax(d->compression, d->extension) / mass_kg;
    return 4 / (g + sqrt(g * g + 4 * omega2));
}

static bt_law law(const void* data, double stroke_m, const char** what) {
    const bt_hook_damper_viscous_data* d = data;
    return bt_hook_damper_gas_law(&d->gas, &d->stops, stroke_m, what);
}

const bt_hook_damper_type bt_hook_damper_viscous = {
    .data_size = sizeof(bt_hook_damper_viscous_data),
    .prepare = prepare,
    .force = force,
    .energy = energy,
    .step_limit = step_limit,
    .law = law,
};
