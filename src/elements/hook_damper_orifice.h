/// Hook damper `orifice`: gas spring, oil through a constant orifice, stops  [Peng2023 Eq. 9].
#ifndef BT_ELEMENTS_HOOK_DAMPER_ORIFICE_H
#define BT_ELEMENTS_HOOK_DAMPER_ORIFICE_H

#include "elements/gas.h"
#include "elements/hook_damper.h"
#include "elements/stops.h"

// clang-format off
#define BT_HOOK_DAMPER_ORIFICE_FIELDS(F)                                                                   \
    F(REAL, air_area, m2, REQUIRED, 1.96e-3, 1e-7, 10, "Eq. 9", "A_Z: area the gas acts on") \
    F(REAL, precharge, Pa, REQUIRED, 11.0e6, 1e3, 1e9, "Eq. 9", "P_0: absolute gas pressure, damper extended") \
    F(REAL, air_volume, m3, REQUIRED, 3.0e-3, 1e-8, 10, "Eq. 9", "V_0: gas volume, damper extended") \
    F(PLAIN, gas_exponent, _, OPTIONAL, 1.2, 1, 1.7, "Eq. 9", "n: polytropic exponent of the gas") \
    F(REAL, ambient, Pa, OPTIONAL, 101325, 0, 2e5, "Eq. 9", "P_atm: absolute ambient pressure") \
    F(REAL, oil_area, m2, REQUIRED, 1.6e-3, 1e-7, 10, "Eq. 9", "A_Zh: area that pushes oil through the orifice") \
    F(REAL, orifice_area, m2, REQUIRED, 2.9798e-5, 1e-9, 1, "Eq. 9", "A_Zd: orifice; the fallback gives 4695 N s^2/m^2") \
    F(REAL, rebound_area, m2, OPTIONAL, 0, 0, 1, "Eq. 9", "orifice while the damper extends; 0: as in compression") \
    F(PLAIN, discharge, _, OPTIONAL, 0.65, 0.05, 2, "Eq. 9", "C_d: discharge coefficient") \
    F(REAL, oil_density, kgpm3, OPTIONAL, 860, 100, 3000, "Eq. 9", "rho: density of the oil") \
    F(REAL, stroke_max, m, OPTIONAL, 0.6, 1e-3, 10, "Eq. 5", "full stroke [assumed]") \
    F(REAL, stop_stiffness, Npm, OPTIONAL, 2e7, 0, 1e12, "Eq. 5", "stiffness beyond either end; at s < 0 it is the hook's down stop [calibrated]") \
    F(REAL, stop_damping, Npmps, OPTIONAL, 0, 0, 1e9, "", "damping beyond either end; a stop never pulls")
// clang-format on
BT_DECLARE_GROUP(hook_damper_orifice, BT_HOOK_DAMPER_ORIFICE_FIELDS)

/// The law's constants.
typedef struct bt_hook_damper_orifice_data {
    bt_gas_spring gas;
    double compression, extension; ///< quadratic damping, N s^2/m^2
    bt_stops stops;                ///< at s < 0 the hook's down stop
} bt_hook_damper_orifice_data;

extern const bt_hook_damper_type bt_hook_damper_orifice;

/// F_h = 1/2 rho s' |s'| A_Zh^3 / (C_d A_Zd)^2, N, positive while the damper shortens
/// [Peng2023 Eq. 9]. Tests: eq9_* in test_hook_damper.c. Differs from the paper: a separate orifice
/// in extension may be given.
double bt_hook_damper_orifice_oil(const bt_hook_damper_orifice_data* damper, double rate_mps);

#endif
