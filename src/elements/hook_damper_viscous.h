/// Hook damper `viscous`: gas spring, damping in proportion to the rate, stops.
#ifndef BT_ELEMENTS_HOOK_DAMPER_VISCOUS_H
#define BT_ELEMENTS_HOOK_DAMPER_VISCOUS_H

#include "elements/gas.h"
#include "elements/hook_damper.h"
#include "elements/stops.h"

// clang-format off
#define BT_HOOK_DAMPER_VISCOUS_FIELDS(F)                                                           \
    F(REAL, air_area, m2, REQUIRED, 1.96e-3, 1e-7, 10, "Eq. 3", "A: area the gas acts on") \
    F(REAL, precharge, Pa, REQUIRED, 11.0e6, 1e3, 1e9, "Eq. 3", "P_0: absolute gas pressure, damper extended") \
    F(REAL, air_volume, m3, REQUIRED, 3.0e-3, 1e-8, 10, "Eq. 3", "V_0: gas volume, damper extended") \
    F(PLAIN, gas_exponent, _, OPTIONAL, 1.2, 1, 1.7, "Eq. 3", "n: polytropic exponent of the gas") \
    F(REAL, ambient, Pa, OPTIONAL, 101325, 0, 2e5, "Eq. 3", "P_atm: absolute ambient pressure") \
    F(REAL, damping, Npmps, REQUIRED, 5000, 0, 1e8, "", "c: damping force over the rate while the damper shortens") \
    F(REAL, rebound_damping, Npmps, OPTIONAL, 0, 0, 1e8, "", "the same while it extends; 0: as in compression") \
    F(REAL, stroke_max, m, OPTIONAL, 0.6, 1e-3, 10, "Eq. 5", "full stroke [assumed]") \
    F(REAL, stop_stiffness, Npm, OPTIONAL, 2e7, 0, 1e12, "Eq. 5", "stiffness beyond either end; at s < 0 it is the hook's down stop [assumed]") \
    F(REAL, stop_damping, Npmps, OPTIONAL, 0, 0, 1e9, "", "damping beyond either end; a stop never pulls")
// clang-format on
BT_DECLARE_GROUP(hook_damper_viscous, BT_HOOK_DAMPER_VISCOUS_FIELDS)

/// The law's constants: F = F_a(s) + c s' + F_l(s, s'), c that of the direction of motion.
typedef struct bt_hook_damper_viscous_data {
    bt_gas_spring gas;
    double compression, extension; ///< c, N s/m
    bt_stops stops;
} bt_hook_damper_viscous_data;

extern const bt_hook_damper_type bt_hook_damper_viscous;

#endif
