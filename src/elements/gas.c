#include "elements/gas.h"

#include "elements/check.h"

double bt_gas_work(double constant, double exponent, double from_Pa, double to_Pa) {
    const double n = exponent, a = (n - 1) / n, ratio = log(to_Pa / from_Pa);
    if (a == 0)
        return constant * ratio;
    return constant / n * pow(from_Pa, a) * expm1(a * ratio) / a;
}

double bt_gas_spring_force(const bt_gas_spring* spring, double stroke_m) {
    const double room = spring->gas.volume - spring->area * stroke_m;
    if (!(room > 0))
        return INFINITY;
    return spring->area * (bt_gas_pressure(&spring->gas, room) - spring->ambient);
}

double bt_gas_spring_energy(const bt_gas_spring* spring, double stroke_m) {
    const bt_gas* g = &spring->gas;
    const double room = g->volume - spring->area * stroke_m;
    if (!(room > 0))
        return INFINITY;
    const double constant = g->volume * pow(g->pressure, 1 / g->exponent);
    return bt_gas_work(constant, g->exponent, g->pressure, bt_gas_pressure(g, room)) -
           spring->ambient * spring->area * stroke_m;
}

void bt_gas_check(double precharge_Pa, double ambient_Pa, double volume_m3, double swept_m3,
                  const char* path, bt_diag* diag) {
    if (precharge_Pa < ambient_Pa)
        bt_key_error(diag, path, "precharge",
                     "%g Pa is below the ambient pressure of %g Pa; the precharge is absolute",
                     precharge_Pa, ambient_Pa);
    if (volume_m3 <= swept_m3)
        bt_key_error(
            diag, path, "air_volume",
            "the gas volume of %g m^3 is not above the swept volume air_area x stroke_max = %g m^3",
            volume_m3, swept_m3);
}
