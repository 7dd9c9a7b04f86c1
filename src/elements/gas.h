/// Gas in a closed volume: the spring of struts and hook dampers.
#ifndef BT_ELEMENTS_GAS_H
#define BT_ELEMENTS_GAS_H

#include "base/diag.h"

#include <math.h>

/// Polytropic gas, p V^n constant: it fills `volume` at `pressure`.
typedef struct bt_gas {
    double volume, pressure, exponent;
} bt_gas;

/// p = P (V / room)^n, Pa. room > 0, m3.
static inline double bt_gas_pressure(const bt_gas* gas, double room_m3) {
    return gas->pressure * pow(gas->volume / room_m3, gas->exponent);
}

/// Energy that gas takes up from one pressure to another, J: integral of -p dV with
/// V = constant p^(-1/n). Exact for n = 1 too.
double bt_gas_work(double constant, double exponent, double from_Pa, double to_Pa);

/// Gas behind a piston against the atmosphere.
typedef struct bt_gas_spring {
    bt_gas gas; ///< with the spring extended
    double area, ambient;
} bt_gas_spring;

/// A [ P_0 ( V_0 / (V_0 - A s) )^n - P_atm ], N  [Peng2023 Eq. 3]; infinite where no volume is
/// left.
double bt_gas_spring_force(const bt_gas_spring* spring, double stroke_m);

/// Energy, J, 0 at s = 0; the force is its derivative.
double bt_gas_spring_energy(const bt_gas_spring* spring, double stroke_m);

/// Whether gas is left over the stroke, and its precharge is absolute; errors name the keys
/// air_volume and precharge below `path`.
void bt_gas_check(double precharge_Pa, double ambient_Pa, double volume_m3, double swept_m3,
                  const char* path, bt_diag* diag);

#endif
