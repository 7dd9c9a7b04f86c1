/// Hook damper `friction`: gas spring, Coulomb friction of its seals, stops. The example that
/// CONTRIBUTING.md is followed with.
#ifndef BT_ELEMENTS_HOOK_DAMPER_FRICTION_H
#define BT_ELEMENTS_HOOK_DAMPER_FRICTION_H

#include "elements/hook_damper.h"

// clang-format off
#define BT_HOOK_DAMPER_FRICTION_FIELDS(F)                                                          \
    F(REAL, air_area, m2, REQUIRED, 1.96e-3, 1e-7, 10, "Eq. 3", "A: area the gas acts on") \
    F(REAL, precharge, Pa, REQUIRED, 11.0e6, 1e3, 1e9, "Eq. 3", "P_0: absolute gas pressure, damper extended") \
    F(REAL, air_volume, m3, REQUIRED, 3.0e-3, 1e-8, 10, "Eq. 3", "V_0: gas volume, damper extended") \
    F(REAL, friction, N, REQUIRED, 2000, 0, 1e7, "", "friction of the seals") \
    F(REAL, slip_speed, mps, OPTIONAL, 0.05, 1e-4, 1, "", "rate at which friction is fully developed [assumed]") \
    F(REAL, stop_stiffness, Npm, OPTIONAL, 2e7, 0, 1e12, "Eq. 5", "stiffness beyond either end [assumed]")
// clang-format on
BT_DECLARE_GROUP(hook_damper_friction, BT_HOOK_DAMPER_FRICTION_FIELDS)

/// F = F_a(s) + N phi(s') + F_l(s), phi of friction.h.
typedef struct bt_hook_damper_friction_data {
    bt_gas_spring gas;
    double friction_N, slip_speed_mps;
    bt_stops stops;
} bt_hook_damper_friction_data;

extern const bt_hook_damper_type bt_hook_damper_friction;

#endif
