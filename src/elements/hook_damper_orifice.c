#include "elements/hook_damper_orifice.h"

#include "elements/orifice.h"

BT_HOOK_DAMPER_FITS(bt_hook_damper_orifice_params, bt_hook_damper_orifice_data)

static void check_orifice_damper(const void* params, const char* path, bt_diag* diag) {
    const bt_hook_damper_orifice_params* p = params;
    bt_gas_check(p->precharge_Pa, p->ambient_Pa, p->air_volume_m3, p->air_area_m2 * p->stroke_max_m,
                 path, diag);
}

// clang-format off
#define ROW(kind, name, ...) BT_ROW_##kind(bt_hook_damper_orifice_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(hook_damper_orifice, BT_HOOK_DAMPER_ORIFICE_FIELDS, ROW, check_orifice_damper, "longitudinal damper of the hook: gas spring and a constant orifice")
// clang-format on

static void prepare(const void* params, void* data) {
    const bt_hook_damper_orifice_params* p = params;
    const double extending = p->rebound_area_m2 > 0 ? p->rebound_area_m2 : p->orifice_area_m2;
    *(bt_hook_damper_orifice_data*)data = (bt_hook_damper_orifice_data){
        .gas = {{p->air_volume_m3, p->precharge_Pa, p->gas_exponent},
                p->air_area_m2,
                p->ambient_Pa},
        .compression = bt_orifice_damping(p->oil_density_kgpm3, p->oil_area_m2,
                                          p->discharge * p->orifice_area_m2),
        .extension =
            bt_orifice_damping(p->oil_density_kgpm3, p->oil_area_m2, p->discharge * extending),
        .stops = {p->stroke_max_m, p->stop_stiffness_Npm, p->stop_damping_Npmps},
    };
}

double bt_hook_damper_orifice_oil(const bt_hook_damper_orifice_data* damper, double rate_mps) {
    return (rate_mps < 0 ? damper->extension : damper->compression) * rate_mps * fabs(rate_mps);
}

static double force(const void* data, double stroke_m, double rate_mps) {
    const bt_hook_damper_orifice_data* d = data;
    return bt_gas_spring_force(&d->gas, stroke_m) + bt_hook_damper_orifice_oil(d, rate_mps) +
           bt_stops_force(&d->stops, stroke_m, rate_mps);
}

static double energy(const void* data, double stroke_m) {
    const bt_hook_damper_orifice_data* d = data;
    return bt_gas_spring_energy(&d->gas, stroke_m) + bt_stops_energy(&d->stops, stroke_m);
}

/// The stop is far stiffer than the gas.
static double step_limit(const void* data, double mass_kg) {
    const bt_hook_damper_orifice_data* d = data;
    return 2 / sqrt(d->stops.stiffness / mass_kg);
}

static bt_law law(const void* data, double stroke_m, const char** what) {
    const bt_hook_damper_orifice_data* d = data;
    return bt_hook_damper_gas_law(&d->gas, &d->stops, stroke_m, what);
}

const bt_hook_damper_type bt_hook_damper_orifice = {
    .data_size = sizeof(bt_hook_damper_orifice_data),
    .prepare = prepare,
    .force = force,
    .energy = energy,
    .step_limit = step_limit,
    .law = law,
};
