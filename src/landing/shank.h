/// The hook's shank as one or two rigid parts. A shank that bends is two parts on one sprung joint
/// in the plane of symmetry, placed so that a load at the shoe gives the deflection and the slope
/// of a cantilever held at the damper:
///
///     F l^3 / (3 EI) = F (L - s)^2 / k,   F l^2 / (2 EI) = F (L - s) / k
///     s = lever + l / 3,   k = 4 EI / (3 l),   l = L - lever
///
/// The mass is split at s by the density a + b P_1 + c P_2 (Legendre, over the length) that has the
/// hook's mass, centre of mass and inertia about the pivot, so that the straight hook is the rigid
/// one.
#ifndef BT_LANDING_SHANK_H
#define BT_LANDING_SHANK_H

#include "landing/params.h"

#include <stdbool.h>

/// One rigid part of the hook.
typedef struct bt_shank_part {
    double mass_kg;
    double centre_m;           ///< centre of mass, from the pivot along the straight shank
    double inertia_kgm2;       ///< about that centre, across the shank
    double axial_inertia_kgm2; ///< about the shank
} bt_shank_part;

typedef struct bt_shank {
    bool bends;
    bt_shank_part head;      ///< the part with the head; all of the hook when it does not bend
    bt_shank_part root;      ///< the part on the pivot, with the damper; only when it bends
    double joint_m;          ///< s: from the pivot
    double stiffness_Nmprad; ///< k
    double damping_Nmsprad;  ///< 2 zeta sqrt(k I), I of the head part about the joint
} bt_shank;

/// Cannot fail; parts without mass or inertia (`false` from bt_shank_is_sound) must not be built.
void bt_shank_prepare(const bt_hook_params* params, bt_shank* shank);
bool bt_shank_is_sound(const bt_shank* shank);

/// Squared angular frequency of the joint, the root free about the pivot, rad2/s2; 0 when it does
/// not bend.
double bt_shank_frequency2(const bt_shank* shank);

/// Mass that a vertical force meets at the shoe, kg: the shank `angle_rad` below the horizontal,
/// pivot held, damper and joint slack (an impact is over before they push).
double bt_shank_effective_mass(const bt_shank* shank, double length_m, double angle_rad);

/// Inertia of the root about the pivot as a moment there meets it with the joint slack; the whole
/// hook's when it does not bend, kg m2.
double bt_shank_root_inertia(const bt_shank* shank);

#endif
