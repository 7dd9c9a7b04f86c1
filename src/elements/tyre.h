/// Tyre: load over deflection, enveloping contact with deck and cable, lateral and longitudinal
/// force  [Peng2023 Eqs. 6-8].
#ifndef BT_ELEMENTS_TYRE_H
#define BT_ELEMENTS_TYRE_H

#include "elements/curve.h"
#include "mechanics/system.h"

extern const char* const bt_tyre_law_names[]; ///< "smiley_horne", "points", "power", NULL
enum { BT_TYRE_SMILEY_HORNE, BT_TYRE_POINTS, BT_TYRE_POWER };

// clang-format off
#define BT_TYRE_FIELDS(F)                                                                          \
    F(REAL, radius, m, REQUIRED, 0.47, 0.01, 5, "Eqs. 6-7", "R: outer radius, unloaded") \
    F(REAL, width, m, REQUIRED, 0.292, 0.005, 2, "", "w: width of one tyre") \
    F(COUNT, tyres, _, OPTIONAL, 1, 1, 16, "", "tyres side by side on the axle; the load of the law is that of one") \
    F(CHOICE, law, bt_tyre_law_names, OPTIONAL, 0, 0, 0, "", "load over deflection: smiley_horne (from size and pressure), points, power") \
    F(REAL, pressure, Pa, OPTIONAL, 2.41e6, 1e4, 1e8, "", "p: inflation pressure (gauge)") \
    F(REAL, rated_pressure, Pa, OPTIONAL, 1.7e6, 1e4, 1e8, "", "p_r: rated pressure (gauge) [assumed]") \
    F(PLAIN, vertical_constant, _, OPTIONAL, 0.03, 1e-3, 0.5, "", "C_z of NASA TR R-64: 0.03 for types III and VII, 0.02 for type I") \
    F(TABLE, load_points, m__N, OPTIONAL, 0, 0, 0, "", "load of one tyre over deflection, increasing from above (0, 0), which is implied") \
    F(REAL, power_deflection, m, OPTIONAL, 0.1, 1e-6, 5, "", "power law: deflection d_0 at power_load [assumed]") \
    F(REAL, power_load, N, OPTIONAL, 1e5, 1e-3, 1e9, "", "power law: F = power_load (d / d_0)^m [assumed]") \
    F(PLAIN, power_exponent, _, OPTIONAL, 1.34, 0.5, 5, "", "power law: m") \
    F(REAL, damping, Npmps, OPTIONAL, 2000, 0, 1e8, "", "c of f(d) + c d', all tyres of the axle [assumed]") \
    F(PLAIN, damping_ratio, _, OPTIONAL, 0, 0, 2, "", "zeta: adds damping 2 zeta sqrt(m f'(d)), m being damping_mass: none at first touch, growing with the tyre's stiffness") \
    F(REAL, damping_mass, kg, OPTIONAL, 0, 0, 1e5, "", "m of damping_ratio: the unsprung mass of the axle; needed with it") \
    F(REAL, bottoming_deflection, m, OPTIONAL, 0, 0, 5, "", "deflection at which the tyre bottoms on its rim; 0: never") \
    F(REAL, rim_stiffness, Npm, OPTIONAL, 2e7, 0, 1e12, "", "stiffness added beyond bottoming_deflection, all tyres [assumed]") \
    F(REAL, bridging_length, m, OPTIONAL, 0, 0, 1, "Eqs. 6-7", "lambda: over which the carcass, a string under tension on the air spring, spans the corners beside a cable; 0.05 m from footprint lengths (NASA TR R-64), 0.15 m from the tension of a cord net; 0: loose strips") \
    F(REAL, cornering_stiffness, Nprad, OPTIONAL, 0, 0, 1e9, "Eq. 8", "C_alpha, all tyres of the axle; 0: from size, pressure and deflection (NASA TR R-64, type VII)") \
    F(PLAIN, friction, _, OPTIONAL, 0.75, 0, 3, "Eq. 8", "mu: peak friction on the deck [assumed]") \
    F(PLAIN, locked_friction, _, OPTIONAL, 0.55, 0, 3, "", "friction of a locked wheel [assumed]") \
    F(PLAIN, peak_slip, _, OPTIONAL, 0.12, 0.005, 0.9, "", "longitudinal slip at peak friction [assumed]") \
    F(REAL, slip_speed, mps, OPTIONAL, 0.5, 1e-4, 20, "", "speed below which slip is softened so that a wheel may stand [assumed]")
// clang-format on
BT_DECLARE_GROUP(tyre, BT_TYRE_FIELDS)

enum { BT_BUMP_MAX = 8, BT_TYRE_STRIPS = 24 };

/// A tyre ready to be evaluated; plain data.
typedef struct bt_tyre {
    double radius, width, tyres, damping;
    int law;
    bt_curve points;           ///< points: through (0, 0) and the rows
    double scale, cz;          ///< smiley_horne: F = scale f(d / w)
    double power_scale, power; ///< power: F = power_scale d^power
    double bottoming, rim_stiffness;
    double bridging; ///< lambda of the carcass
    double cornering, cornering_scale;
    double friction, locked_friction, peak_slip, slip_speed;
    double critical; ///< 2 zeta sqrt(m) of damping_ratio
    int strips; ///< strips over each bump's part of the contact patch; the caller may change it
} bt_tyre;

/// Prepares checked parameters. No allocation, cannot fail.
void bt_tyre_prepare(const bt_tyre_params* params, bt_tyre* tyre);

/// Load f(d) of the axle's tyres at rest, N; 0 for d <= 0.
double bt_tyre_load(const bt_tyre* tyre, double deflection_m);
/// Energy of that load, J: f is its derivative.
double bt_tyre_energy(const bt_tyre* tyre, double deflection_m);
/// Stiffness f'(d), N/m; 0 for d <= 0.
double bt_tyre_stiffness(const bt_tyre* tyre, double deflection_m);
/// Whether the law holds at a deflection. At its limit where the tyre stands on its rim: beyond
/// bottoming_deflection, or where none is given, beyond the width of the tyre, which no aircraft
/// tyre's section exceeds in height ("tyre on its rim"). Left where the axle would reach the deck
/// ("axle at the deck").
bt_law bt_tyre_law(const bt_tyre* tyre, double deflection_m, const char** what);
/// Magnitude f(d) + (c + 2 zeta sqrt(m f'(d))) d', never negative, 0 off the ground, N.
double bt_tyre_normal_force(const bt_tyre* tyre, double deflection_m, double rate_mps);

/// What stands above the deck in the plane of a wheel: a circle (the cable's cross-section) or a
/// step (a block that ends upright). Coordinates from the axle: u forward, w up, in the wheel's
/// plane.
typedef enum bt_bump_kind { BT_BUMP_CIRCLE, BT_BUMP_STEP } bt_bump_kind;

typedef struct bt_bump {
    bt_bump_kind kind;
    double u_m, w_m; ///< circle: its centre; step: begin and end of its top along u
    double size_m;   ///< circle: its radius; step: its height above the deck
} bt_bump;

/// One share of the contact patch.
typedef struct bt_patch {
    double area_m2;  ///< cut off the wheel's disc
    double u_m, w_m; ///< its centroid C_p from the axle
    double g_u, g_w; ///< mean inward direction (area-weighted; length at most 1)
} bt_patch;

typedef struct bt_envelope {
    double deflection_m;        ///< equivalent deflection d; 0: no contact
    bt_patch all;               ///< Eqs. 6 and 7
    bt_patch ground;            ///< the share bounded by the deck
    bt_patch bump[BT_BUMP_MAX]; ///< the share bounded by each bump
} bt_envelope;

/// Enveloping contact of the wheel's disc with the deck and up to BT_BUMP_MAX bumps.
///
/// The disc is cut into narrow radial strips. A strip that the ground profile bounds at a distance
/// rho < R from the axle loses A_i = (R^2 - rho^2) dtheta / 2 with centroid C_pi and inward
/// direction g_i, the normal of what bounds it:
///
///     C_p = sum(A_i C_pi) / sum(A_i)      [Peng2023 Eq. 6]
///     g   = sum(A_i g_i)  / sum(A_i)      [Peng2023 Eq. 7]
///
/// and sum(A_i) = R^2 acos((R - d) / R) - (R - d) sqrt(2 R d - d^2) defines the equivalent
/// deflection d, for which the load curve gives the force. Strips bounded by the deck are summed in
/// closed form, so that a flat deck gives d = R - h exactly; those bounded by a bump are narrow.
/// With bridging_length lambda > 0 the carcass presses in more than the disc loses: the area beside
/// a bump of kind circle (bt_carcass_over_cylinder) is added to its share, that beside a flat patch
/// to the deck's, and to both sides of the equation for d, so that a flat deck keeps d = R - h
/// (carcass.h). A rope alone is pressed by a force along the line of centres that depends on its
/// depth only: conservative.
///
/// Force F on the wheel = sum over the shares of F (A_k / A) g_k; each share acts at its centroid
/// and its opposite on what bounds it.
///
/// @param wheel_height_m  axle above the deck along w (the disc stands on the line w = -height)
/// @param bumps           [n] n <= BT_BUMP_MAX
///
/// Tests: eq6_*, eq7_* in test_tyre.c. Differs from the paper: strips are not of equal width.
void bt_tyre_envelope(const bt_tyre* tyre, double wheel_height_m, const bt_bump* bumps, int n,
                      bt_envelope* out);

/// Deflection of a disc of radius R on a flat floor whose segment has the area, m.
double bt_tyre_equivalent_deflection(double radius_m, double area_m2);
/// The inverse: area of the segment, m2.
double bt_tyre_segment_area(double radius_m, double deflection_m);

/// Longitudinal friction coefficient over slip: rises to `friction` at peak_slip, falls to
/// `locked_friction` at slip 1; odd in slip; value and slope continuous.
double bt_tyre_slip_friction(const bt_tyre* tyre, double slip);

/// Slip (V - omega r) / sqrt(V^2 + slip_speed^2): 0 rolling, near 1 locked, negative driven.
double bt_tyre_slip(const bt_tyre* tyre, double forward_mps, double rolling_mps);

/// Cornering stiffness C_alpha at a deflection, N/rad, all tyres.
double bt_tyre_cornering(const bt_tyre* tyre, double deflection_m);

/// Lateral force over slip angle.
///
///     F_lat = F (phi - 4/27 phi^3),  phi = C_alpha alpha / F,  F = mu F_norm,
///     up to alpha_n = 1.5 F / C_alpha; F beyond                        [Peng2023 Eq. 8]
///
/// @return N, sign of alpha (it acts against the lateral velocity)
/// Tests: eq8_*. Differs from the paper: its form between 0 and alpha_n is not printed; this is the
/// cubic of its four symbols without square term (NASA TR R-64).
double bt_tyre_lateral_force(const bt_tyre* tyre, double normal_N, double deflection_m,
                             double slip_angle_rad);

/// Force in the deck's plane, friction circle included.
///
/// @param forward_mps, lateral_mps  velocity of the wheel's centre along its heading and to the
/// left
/// @param rolling_mps               omega times rolling radius, positive when rolling forward
/// @param force                     [2] forward and left, N; |force| <= mu F_norm
void bt_tyre_ground_force(const bt_tyre* tyre, double normal_N, double deflection_m,
                          double forward_mps, double lateral_mps, double rolling_mps,
                          double force[2]);

/// Rolling radius R - d / 3, m.
double bt_tyre_rolling_radius(const bt_tyre* tyre, double deflection_m);

#endif
