#include "elements/hook_damper.h"

#include "elements/check.h"

#include <math.h>

static void check_hook_damper(const void* params, const char* path, bt_diag* diag) {
    const bt_hook_damper_params* p = params;
    const double swept = p->air_area_m2 * p->stroke_max_m;
    if (p->precharge_Pa < p->ambient_Pa)
        bt_key_error(diag, path, "precharge",
                     "%g Pa is below the ambient pressure of %g Pa; the precharge is absolute",
                     p->precharge_Pa, p->ambient_Pa);
    if (p->air_volume_m3 <= swept)
        bt_key_error(
            diag, path, "air_volume",
            "the gas volume of %g m^3 is not above the swept volume air_area x stroke_max = %g m^3",
            p->air_volume_m3, swept);
}

// clang-format off
#define ROW(kind, name, ...) BT_ROW_##kind(bt_hook_damper_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(hook_damper, BT_HOOK_DAMPER_FIELDS, ROW, check_hook_damper, "longitudinal damper of the hook")
// clang-format on

/// rho A^3 / (2 C^2 a^2), N s^2/m^2
static double quadratic_damping(const bt_hook_damper_params* p, double orifice) {
    const double a = p->oil_area_m2, flow = p->discharge * orifice;
    return p->oil_density_kgpm3 * a * a * a / (2 * flow * flow);
}

void bt_hook_damper_prepare(const bt_hook_damper_params* params, bt_hook_damper* damper) {
    const bt_hook_damper_params* p = params;
    *damper = (bt_hook_damper){
        .air_area = p->air_area_m2,
        .precharge = p->precharge_Pa,
        .air_volume = p->air_volume_m3,
        .exponent = p->gas_exponent,
        .ambient = p->ambient_Pa,
        .compression = quadratic_damping(p, p->orifice_area_m2),
        .extension =
            quadratic_damping(p, p->rebound_area_m2 > 0 ? p->rebound_area_m2 : p->orifice_area_m2),
        .stroke_max = p->stroke_max_m,
        .stop_stiffness = p->stop_stiffness_Npm,
        .stop_damping = p->stop_damping_Npmps,
    };
}

double bt_hook_damper_gas_force(const bt_hook_damper* damper, double stroke_m) {
    const double room = damper->air_volume - damper->air_area * stroke_m;
    if (!(room > 0))
        return INFINITY;
    return damper->air_area *
           (damper->precharge * pow(damper->air_volume / room, damper->exponent) - damper->ambient);
}

double bt_hook_damper_oil_force(const bt_hook_damper* damper, double rate_mps) {
    return (rate_mps < 0 ? damper->extension : damper->compression) * rate_mps * fabs(rate_mps);
}

double bt_hook_damper_limit_force(const bt_hook_damper* damper, double stroke_m, double rate_mps) {
    const double k = damper->stop_stiffness, c = damper->stop_damping;
    if (stroke_m < 0)
        return fmin(k * stroke_m + c * rate_mps, 0);
    if (stroke_m > damper->stroke_max)
        return fmax(k * (stroke_m - damper->stroke_max) + c * rate_mps, 0);
    return 0;
}

double bt_hook_damper_force(const bt_hook_damper* damper, double stroke_m, double rate_mps) {
    return bt_hook_damper_gas_force(damper, stroke_m) + bt_hook_damper_oil_force(damper, rate_mps) +
           bt_hook_damper_limit_force(damper, stroke_m, rate_mps);
}

bt_law bt_hook_damper_law(const bt_hook_damper* damper, double stroke_m, const char** what) {
    if (!(stroke_m > damper->stroke_max))
        return BT_LAW_HOLDS;
    const bool gas = isfinite(bt_hook_damper_gas_force(damper, stroke_m));
    *what = gas ? "hook damper bottomed" : "no gas volume in the hook damper";
    return gas ? BT_LAW_AT_LIMIT : BT_LAW_LEFT;
}

double bt_hook_damper_energy(const bt_hook_damper* damper, double stroke_m) {
    const double n = damper->exponent, v0 = damper->air_volume, area = damper->air_area;
    const double ratio = -log1p(-area * stroke_m / v0);
    const double gas = damper->precharge * v0 * (n == 1 ? ratio : expm1((n - 1) * ratio) / (n - 1));
    const double beyond = stroke_m < 0 ? stroke_m : fmax(stroke_m - damper->stroke_max, 0);
    return gas - damper->ambient * area * stroke_m + 0.5 * damper->stop_stiffness * beyond * beyond;
}
