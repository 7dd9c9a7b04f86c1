/// Oleo-pneumatic shock strut: gas spring, orifice damping, structural limit  [Peng2023 Eqs. 2-5].
///
/// Sign: the stroke s is positive in compression, 0 when fully extended; a force is positive when
/// it pushes the two parts of the strut apart.
#ifndef BT_ELEMENTS_OLEO_H
#define BT_ELEMENTS_OLEO_H

#include "elements/curve.h"
#include "elements/stops.h"
#include "mechanics/system.h"

extern const char* const bt_orifice_law_names[]; ///< in the order of bt_curve_law
extern const char* const bt_spring_names[];      ///< "gas", "points", NULL
enum { BT_SPRING_GAS, BT_SPRING_POINTS };

// clang-format off
#define BT_OLEO_FIELDS(F)                                                                          \
    F(CHOICE, spring, bt_spring_names, OPTIONAL, 0, 0, 0, "", "what carries the static load: gas (Eq. 3), or points (a leaf, steel or rubber spring, or a measured static curve; in a file that describes rigs only the keys of the gas may then be left out)") \
    F(TABLE, spring_points, m__N, OPTIONAL, 0, 0, 0, "", "spring: points: static load over stroke, from stroke 0 (the preload) on; loads never fall, the last slope goes on beyond the end") \
    F(REAL, air_area, m2, REQUIRED, 0.0113, 0, 10, "Eq. 3", "A_a: area the gas acts on") \
    F(REAL, precharge, Pa, REQUIRED, 2.8e6, 0, 1e9, "Eq. 3", "P_0: absolute gas pressure, strut extended") \
    F(REAL, air_volume, m3, REQUIRED, 8.04e-3, 0, 10, "Eq. 3", "V_0: gas volume, strut extended") \
    F(PLAIN, gas_exponent, _, OPTIONAL, 1.15, 1, 1.7, "Eq. 3", "n: polytropic exponent of the gas") \
    F(REAL, ambient, Pa, OPTIONAL, 101325, 0, 2e5, "Eq. 3", "P_atm: absolute ambient pressure") \
    F(REAL, high_precharge, Pa, OPTIONAL, 0, 0, 1e9, "", "P_02: absolute pressure at which the floating piston of a second chamber lifts; 0: no second chamber") \
    F(REAL, high_volume, m3, OPTIONAL, 0, 0, 10, "", "V_02: gas volume of the second chamber before it lifts") \
    F(PLAIN, high_exponent, _, OPTIONAL, 0, 0, 1.7, "", "n_2: polytropic exponent of the second chamber; 0: gas_exponent") \
    F(REAL, oil_area, m2, REQUIRED, 0.0098, 0, 10, "Eq. 4", "A_h: area that pushes oil through the main orifice; 0: no oil") \
    F(REAL, oil_density, kgpm3, OPTIONAL, 860, 100, 3000, "Eq. 4", "rho: density of the oil") \
    F(REAL, orifice_area, m2, OPTIONAL, 0, 0, 1, "Eq. 4", "A_d: main orifice, constant over the stroke; needed where orifice_table is not given") \
    F(TABLE, orifice_table, m__m2, OPTIONAL, 0, 0, 0, "Eq. 4", "A_d(s): main orifice over the stroke (metering pin), strokes increasing; the end values hold beyond the ends") \
    F(CHOICE, orifice_law, bt_orifice_law_names, OPTIONAL, 0, 0, 0, "Eq. 4", "between the rows of orifice_table: smooth (monotone cubic, no overshoot), linear, stepped (a row holds until the next)") \
    F(PLAIN, discharge, _, OPTIONAL, 0.65, 0.05, 2, "Eq. 4", "C_d: discharge coefficient of the main orifice") \
    F(PLAIN, rebound_ratio, _, OPTIONAL, 1, 1e-4, 100, "Eq. 4", "main orifice in extension over that in compression (rebound valve)") \
    F(REAL, rebound_area, m2, OPTIONAL, 0, 0, 1, "Eq. 4", "main orifice in extension, constant; 0: rebound_ratio holds") \
    F(REAL, side_area, m2, OPTIONAL, 0, 0, 10, "Eq. 4", "A_hs: area that pushes oil through the side (recoil) orifice; 0: none") \
    F(REAL, side_orifice_compression, m2, OPTIONAL, 0, 0, 1, "Eq. 4", "A_n: side orifice while the strut shortens; 0: it flows freely (valve open)") \
    F(REAL, side_orifice_extension, m2, OPTIONAL, 0, 0, 1, "Eq. 4", "A_n: side orifice while the strut extends (snubber closed); 0: it flows freely") \
    F(PLAIN, side_discharge, _, OPTIONAL, 0.65, 0.05, 2, "Eq. 4", "C_ds: discharge coefficient of the side orifice") \
    F(REAL, stroke_max, m, REQUIRED, 0.6, 1e-3, 10, "Eq. 5", "s_max: full stroke") \
    F(REAL, stop_stiffness, Npm, OPTIONAL, 3e7, 0, 1e12, "Eq. 5", "k_l: stiffness beyond either end of the stroke [assumed]") \
    F(REAL, stop_damping, Npmps, OPTIONAL, 0, 0, 1e9, "", "damping beyond either end of the stroke; the stop never pulls") \
    F(REAL, seal_friction, N, OPTIONAL, 0, 0, 1e7, "", "friction of the seals, independent of pressure") \
    F(PLAIN, seal_coefficient, _, OPTIONAL, 0, 0, 1, "", "friction of the seals over the gas force") \
    F(PLAIN, bearing_coefficient, _, OPTIONAL, 0, 0, 1, "", "Coulomb coefficient of the bearings") \
    F(PLAIN, side_load_ratio, _, OPTIONAL, 0, 0, 2, "", "side load at the axle over the strut force; loads the bearings; 0: tangent of the gear's rake") \
    F(REAL, axle_distance, m, OPTIONAL, 0.5, 1e-3, 10, "", "l_2: axle to the lower bearing, which is fixed to the cylinder, strut extended [assumed]") \
    F(REAL, bearing_distance, m, OPTIONAL, 0.2, 1e-3, 10, "", "l_1: lower bearing to the upper one, which moves with the piston, strut extended [assumed]") \
    F(REAL, friction_speed, mps, OPTIONAL, 0.02, 1e-5, 1, "", "speed at which seal and bearing friction are fully developed [assumed]") \
    F(REAL, oil_volume, m3, OPTIONAL, 0, 0, 10, "", "oil that is compressed in series with the gas; 0: incompressible oil") \
    F(REAL, oil_bulk_modulus, Pa, OPTIONAL, 1.0e9, 1e7, 1e11, "", "bulk modulus of the oil with its entrained gas [assumed]")
// clang-format on
BT_DECLARE_GROUP(oleo, BT_OLEO_FIELDS)

/// One gas stage: C p^(-1/n), C being the volume at 1 Pa, is the volume of the gas that takes part,
/// plus C_2 p^(-1/n_2) where the second chamber has an exponent of its own.
typedef struct bt_gas_stage {
    double constant; ///< C = sum of V P^(1/n)
    double other;    ///< C_2 = V_02 P_02^(1/n_2); 0 where both chambers have one exponent
    double volume;   ///< all gas volume with the strut extended
    double pressure; ///< at which the stage begins
    double energy;   ///< energy of the gas when it begins
} bt_gas_stage;

/// A strut ready to be evaluated: constants of the formulas, plain data.
typedef struct bt_oleo {
    double air_area, precharge, ambient, exponent, high_exponent;
    double second_stroke;  ///< where the second chamber lifts; infinite without one
    bt_gas_stage stage[2]; ///< first chamber alone; both
    double oil_compliance; ///< V_oil / B, m3/Pa
    double main_constant;  ///< rho A_h^3 / (2 C_d^2): over A_d^2 gives N s^2/m^2
    double side_compression, side_extension; ///< side orifice, N s^2/m^2
    double rebound_ratio, rebound_area;
    bt_curve orifice; ///< A_d(s)
    bt_stops stops;
    bool has_friction;
    double seal_N, seal_coefficient, bearing, axle_distance, bearing_distance, friction_speed;
    bool by_points; ///< the spring is given by points
    bt_curve spring;
} bt_oleo;

/// Prepares checked parameters (bt_group_check(&bt_oleo_group, ...)). No allocation, cannot fail.
void bt_oleo_prepare(const bt_oleo_params* params, bt_oleo* oleo);

/// Gas pressure, absolute, Pa, at a stroke below full compression of the gas.
double bt_oleo_gas_pressure(const bt_oleo* oleo, double stroke_m);

/// Gas spring force.
///
///     F_a = A_a [ P_0 ( V_0 / (V_0 - A_a s) )^n - P_atm ]             [Peng2023 Eq. 3]
///
/// Beyond the stroke where the pressure reaches P_02 both chambers share one pressure (the piston
/// between them floats): p = ( (V_0 P_0^1/n + V_02 P_02^1/n) / (V_0 + V_02 - A_a s) )^n, which is
/// continuous there. Where the second chamber has its own exponent n_2, p is the root of
/// V_0 (P_0/p)^(1/n) + V_02 (P_02/p)^(1/n_2) = V_0 + V_02 - A_a s. With compressible oil the gas
/// keeps V_oil (p - P_0) / B more room. A spring given by points has its curve instead.
///
/// @param stroke_m  m, below the stroke that leaves no gas volume (the check keeps s_max below it);
///                  at or beyond that stroke the result is infinite, which the step reports
/// @return          N, positive when it pushes the parts apart
///
/// Tests: eq3_* in test_oleo.c. Differs from the paper: second chamber and oil are optional extras.
double bt_oleo_gas_force(const bt_oleo* oleo, double stroke_m);

/// Energy stored in gas (and oil), J, 0 at s = 0; the gas force is its derivative.
double bt_oleo_gas_energy(const bt_oleo* oleo, double stroke_m);

/// Area A_d of the main orifice in compression at a stroke, m2.
double bt_oleo_orifice_area(const bt_oleo* oleo, double stroke_m);

/// Damping force of the oil.
///
///     F_h = 1/2 rho s' |s'| ( A_h^3 / (C_d A_d(s))^2 + A_hs^3 / (C_ds A_n)^2 )   [Peng2023 Eq. 4]
///
/// A_d and A_n are those of the direction of motion. Positive while the strut shortens: its power
/// on the strut, -F_h s', is never positive. Tests: eq4_*. Differs from the paper: no.
double bt_oleo_oil_force(const bt_oleo* oleo, double stroke_m, double rate_mps);

/// Structural limit.
///
///     F_l = k_l s (s < 0);  0 (0 <= s <= s_max);  k_l (s - s_max) (s > s_max)    [Peng2023 Eq. 5]
///
/// With stop damping c s' is added outside the stroke, never so much that a stop pulls.
/// Tests: eq5_*. Differs from the paper: the damping, 0 unless given.
double bt_oleo_limit_force(const bt_oleo* oleo, double stroke_m, double rate_mps);

/// Seal and bearing friction: ( N_seal + c_seal |F_a| + mu_b r (|N_1| + |N_2|) ) phi(s'), with the
/// bearing loads of a side load r |F_a + F_h| at the axle, N_1 + N_2 = 2 (l_2 - s) / (l_1 + s) + 1
/// times that side load. Same sign as F_h. Not in the paper.
double bt_oleo_friction_force(const bt_oleo* oleo, double stroke_m, double rate_mps,
                              double gas_force_N, double oil_force_N);

/// F_s = F_a + F_h + F_l  [Peng2023 Eq. 2], plus friction where there is any, N.
double bt_oleo_force(const bt_oleo* oleo, double stroke_m, double rate_mps);

/// Whether the law holds at a stroke: at its limit beyond the full stroke, where the stop carries
/// the load ("strut bottomed"); left where the gas has no volume ("no gas volume in the strut").
bt_law bt_oleo_law(const bt_oleo* oleo, double stroke_m, const char** what);

/// Energy of gas and stops, J: what the strut can give back.
double bt_oleo_energy(const bt_oleo* oleo, double stroke_m);

/// Stroke at which the strut, pulled apart by a load and at rest, hangs on its stop: the root of
/// F_s(s, 0) = -load, m (0 without a stop).
///
/// @param load_N  N, the weight of what hangs on the piston, >= 0
double bt_oleo_hanging_stroke(const bt_oleo* oleo, double load_N);

#endif
