/// Element `wheel`: a tyre on the level deck z = 0  [Peng2023 Eqs. 6-8 on flat ground].
#ifndef BT_ELEMENTS_WHEEL_H
#define BT_ELEMENTS_WHEEL_H

#include "elements/tyre.h"
#include "mechanics/system.h"

/// Data of one wheel. body_a turns about its own y axis, centre of mass on the axle; body_b is
/// BT_GROUND.
typedef struct bt_wheel {
    bt_tyre tyre;
    double deck_velocity_mps[3]; ///< velocity of the deck's surface (a rig's belt); level
} bt_wheel;

enum { BT_WHEEL_DEFLECTION, BT_WHEEL_NORMAL, BT_WHEEL_FORWARD, BT_WHEEL_LATERAL, BT_WHEEL_OUTPUTS };

/// Outputs deflection_m, normal_N, longitudinal_N (forward positive), lateral_N (left positive).
/// Energy and law: the tyre's.
extern const bt_element_type bt_wheel_type;

/// Inertia of a wheel about a diameter, kg m2, from that about its axle.
///
/// Half of it for a flat disc; a width w adds m w^2 / 12, a tenth of that half for the proportions
/// of a tyre (reference: 9 % on both legs).
double bt_wheel_inertia_across(double about_axle_kgm2);

/// The plane of a wheel over a level deck. axle x z is the heading u; w = u x axle points up in
/// the wheel's plane. With the wheel's plane upright, w is z.
typedef struct bt_wheel_plane {
    double heading[3]; ///< u: unit, level
    double left[3];    ///< z x u: unit, level
    double up[3];      ///< w: unit, in the wheel's plane
    double height_m;   ///< axle above the deck along w
} bt_wheel_plane;

/// @param axle      [3] unit, to the left
/// @param centre_z  height of the axle above the deck, m
void bt_wheel_plane_find(const double axle[3], double centre_z, bt_wheel_plane* plane);

/// What a level deck does to a wheel.
typedef struct bt_wheel_load {
    double deflection_m, rate_mps;
    double normal_N, forward_N, lateral_N;
    double point_m[3]; ///< contact point: under the wheel, in its plane
    double force_N[3]; ///< world, at the contact point
    double torque_Nm;  ///< about the axle, added so that rolling takes no power (see below)
} bt_wheel_load;

/// Contact of a wheel with the deck; returns false off the ground (load is all zero then).
///
/// d = R - h with h along w; normal force (f(d) + c d') / w_z along z, which makes the tyre's part
/// of it the gradient of its energy also with camber. In the deck's plane bt_tyre_ground_force,
/// with the rolling speed of the radius R - d / 3; its moment about the axle has that radius too,
/// so that what the deck takes out is force times slip, never negative.
bool bt_wheel_on_deck(const bt_wheel* wheel, const double centre_m[3], const double velocity_mps[3],
                      const double axle[3], const double spin_radps[3], bt_wheel_load* load);

#endif
