/// Impact of two solid bodies: Hertz stiffness, dissipation by restitution, friction
/// [Peng2023 Eq. 10].
#ifndef BT_ELEMENTS_IMPACT_H
#define BT_ELEMENTS_IMPACT_H

#include "base/fields.h"

extern const char* const bt_stiffness_from_names[]; ///< "given", "bodies", NULL
enum { BT_STIFFNESS_GIVEN, BT_STIFFNESS_BODIES };

/// "coefficient", "met", "hunt_crossley", "lankarani_nikravesh", "flores", "herbert_mcwhannell",
/// "lee_wang", NULL
extern const char* const bt_dissipation_law_names[];
enum {
    BT_DISSIPATION_COEFFICIENT,
    BT_DISSIPATION_MET,
    BT_DISSIPATION_HUNT_CROSSLEY,
    BT_DISSIPATION_LANKARANI_NIKRAVESH,
    BT_DISSIPATION_FLORES,
    BT_DISSIPATION_HERBERT_MCWHANNELL,
    BT_DISSIPATION_LEE_WANG,
};

// clang-format off
#define BT_IMPACT_FIELDS(F)                                                                        \
    F(CHOICE, stiffness_from, bt_stiffness_from_names, OPTIONAL, 0, 0, 0, "Eq. 10", "given: `stiffness` holds; bodies: K from moduli and radii") \
    F(REAL, stiffness, Npm15, OPTIONAL, 2.63e9, 1, 1e15, "Eq. 10", "K of F = K delta^1.5 [calibrated]") \
    F(REAL, first_modulus, Pa, OPTIONAL, 2.1e11, 1e3, 1e13, "Eq. 10", "E_1: Young's modulus of the first body (hook)") \
    F(PLAIN, first_poisson, _, OPTIONAL, 0.3, 0, 0.5, "Eq. 10", "nu_1: its Poisson ratio") \
    F(REAL, first_radius, m, OPTIONAL, 0.08, -1e3, 1e3, "Eq. 10", "R_1: a principal radius of its surface; 0: flat, negative: hollow [assumed]") \
    F(REAL, first_cross_radius, m, OPTIONAL, 0.1, -1e3, 1e3, "Eq. 10", "R_1': the other principal radius [assumed]") \
    F(REAL, second_modulus, Pa, OPTIONAL, 2.1e11, 1e3, 1e13, "Eq. 10", "E_2: Young's modulus of the second body (deck)") \
    F(PLAIN, second_poisson, _, OPTIONAL, 0.3, 0, 0.5, "Eq. 10", "nu_2: its Poisson ratio") \
    F(REAL, second_radius, m, OPTIONAL, 0, -1e3, 1e3, "Eq. 10", "R_2: a principal radius of its surface; 0: flat") \
    F(REAL, second_cross_radius, m, OPTIONAL, 0, -1e3, 1e3, "Eq. 10", "R_2': the other principal radius; 0: flat") \
    F(REAL, crossing_angle, rad, OPTIONAL, 0, -3.2, 3.2, "Eq. 10", "psi: between the directions of R_1 and R_2") \
    F(CHOICE, dissipation_law, bt_dissipation_law_names, OPTIONAL, 0, 0, 0, "", "coefficient: `dissipation` holds; met: the rebound at reference_speed has exactly `restitution`; the others: published formulas, which miss it") \
    F(REAL, dissipation, spm, OPTIONAL, 0.80, 0, 1e4, "", "lambda of F = K delta^1.5 (1 + lambda delta') [calibrated]") \
    F(PLAIN, restitution, _, OPTIONAL, 0.3, 1e-3, 1, "", "rebound speed over impact speed that is asked for [assumed]") \
    F(REAL, reference_speed, mps, OPTIONAL, 3.6, 1e-6, 1e3, "", "impact speed at which it is asked for") \
    F(PLAIN, friction, _, OPTIONAL, 0.24, 0, 5, "", "Coulomb coefficient [calibrated]") \
    F(REAL, slip_speed, mps, OPTIONAL, 0.2, 1e-6, 10, "", "sliding speed at which friction is fully developed [assumed]")
// clang-format on
BT_DECLARE_GROUP(impact, BT_IMPACT_FIELDS)

/// A contact ready to be evaluated; plain data.
typedef struct bt_impact {
    double stiffness;   ///< K, N/m^1.5
    double dissipation; ///< lambda, s/m
    double friction, slip_speed;
} bt_impact;

/// Prepares checked parameters: K from the bodies where asked, lambda from the law. No allocation.
void bt_impact_prepare(const bt_impact_params* params, bt_impact* impact);

/// Normal force.
///
///     F = K delta^1.5 ( 1 + lambda delta' ), never negative        [Peng2023 Eq. 10]
///
/// @param depth_m   approach delta, m; no force at or below 0
/// @param rate_mps  delta', m/s, positive while the bodies approach
/// @return          N, pushes the bodies apart
///
/// Tests: eq10_* in test_impact.c. Differs from the paper: the dissipation factor.
double bt_impact_force(const bt_impact* impact, double depth_m, double rate_mps);

/// Energy stored, 2/5 K delta^2.5, J.
double bt_impact_energy(const bt_impact* impact, double depth_m);

/// Friction on the first body that slides with the (tangential) velocity on the second, N.
void bt_impact_friction(const bt_impact* impact, double normal_N, const double velocity[3],
                        double force[3]);

/// One body of a Hertz contact. Radii: 0 is flat, negative hollow.
typedef struct bt_hertz_body {
    double modulus_Pa, poisson, radius_m, cross_radius_m;
} bt_hertz_body;

typedef struct bt_hertz {
    double stiffness;                  ///< K, N/m^1.5
    double radius_large, radius_small; ///< principal relative radii of curvature, m
    double axis_ratio;                 ///< long over short half axis of the contact ellipse
} bt_hertz;

/// Hertz contact of two bodies, exact.
///
///     F = K delta^1.5,  K = (2 pi / 3) E* sqrt( 2 R_large D / K(k)^3 )      [Peng2023 Eq. 10]
///
/// with 1 / E* = (1 - nu_1^2) / E_1 + (1 - nu_2^2) / E_2, the complete elliptic integrals K(k) and
/// D(k) = (K - E) / k^2, k^2 = 1 - (b/a)^2, and the half axes a >= b of the contact ellipse from
/// R_large / R_small = (a/b)^2 (K - D) / D  [Johnson, Contact Mechanics, 1985, 4.25-4.28].
///
/// @return BT_OK, or BT_ERR_ARG when the bodies do not touch in a point (a relative curvature
///         that is not positive: parallel cylinders, flat on flat, too hollow)
BT_CHECKED bt_status bt_hertz_contact(const bt_hertz_body* first, const bt_hertz_body* second,
                                      double crossing_angle_rad, bt_hertz* out);

/// Rebound ratio of F = K delta^n (1 + lambda delta') at impact speed v, x = lambda v >= 0: the
/// root of x (1 + e) = ln[ (1 + x) / (1 - e x) ], whatever K, n and mass.
double bt_impact_restitution(double x);

/// The inverse: x = lambda v for a rebound ratio 0 < e <= 1.
double bt_impact_dissipation(double restitution);

/// x = lambda v that a published law (BT_DISSIPATION_MET and up) takes for a restitution.
double bt_impact_law(int law, double restitution);

#endif
