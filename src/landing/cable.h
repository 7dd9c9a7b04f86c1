/// The arresting cable: a chain of rigid cylinders with six degrees of freedom each, joined by
/// axial, shear, bending and torsion springs and dampers  [Peng2023 Eqs. 11-17], lying on the deck
/// and its supports, held by the purchase cable behind two sheaves. docs/theory/cable.md has the
/// derivation, what differs from the paper, and the tests.
///
/// Frame: the deck frame (x forward, y to port, z up, deck z = 0); the rope runs along y from
/// segment 0 (starboard, -y) to segment count - 1 (port, +y). SI units.
#ifndef BT_LANDING_CABLE_H
#define BT_LANDING_CABLE_H

#include "base/arena.h"
#include "base/diag.h"
#include "base/fields.h"
#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

// clang-format off
#define BT_CABLE_MESH_FIELDS(F)                                                                    \
    F(REAL, fine_length, m, OPTIONAL, 0.05, 0.005, 2, "Eq. 11", "segment length where wheels and hook meet the cable") \
    F(REAL, fine_half_width, m, OPTIONAL, 3.0, 0, 50, "", "the fine segments lie within this distance of the middle") \
    F(REAL, medium_length, m, OPTIONAL, 0.1, 0.005, 2, "Eq. 11", "segment length outside the fine part") \
    F(REAL, medium_half_width, m, OPTIONAL, 5.0, 0, 50, "", "the medium segments lie within this distance of the middle") \
    F(REAL, coarse_length, m, OPTIONAL, 0.3, 0.005, 2, "Eq. 11", "segment length outside the medium part") \
    F(PLAIN, growth, _, OPTIONAL, 1.25, 1.02, 10, "", "largest ratio of neighbouring segment lengths where the length changes [assumed]")
BT_DECLARE_GROUP(cable_mesh, BT_CABLE_MESH_FIELDS)

#define BT_CABLE_SUPPORTS_FIELDS(F)                                                                \
    F(REAL, first, m, OPTIONAL, 6.0, 0.3, 50, "", "distance of the first support on each side from the middle") \
    F(REAL, spacing, m, OPTIONAL, 6.0, 0.5, 50, "", "distance between supports further out; none nearer than half of it to a sheave") \
    F(REAL, height, m, OPTIONAL, 0.103, 0.001, 1, "", "top of the unloaded support above the deck; the cable's underside lies on it") \
    F(REAL, stiffness, Npm, OPTIONAL, 50e3, 1e2, 1e7, "", "one-sided spring under the cable; it flattens to the deck [assumed]") \
    F(REAL, damping, Npmps, OPTIONAL, 100, 0, 1e5, "", "damping while the cable lies on it [assumed]")
BT_DECLARE_GROUP(cable_supports, BT_CABLE_SUPPORTS_FIELDS)

#define BT_CABLE_DECK_FIELDS(F)                                                                    \
    F(REAL, stiffness, Npm2, OPTIONAL, 5e9, 1e6, 1e12, "", "deck contact: force per metre of cable and metre of penetration [assumed]") \
    F(PLAIN, restitution, _, OPTIONAL, 0.3, 0.02, 1, "", "rebound over impact speed of a piece of cable on the deck [assumed]") \
    F(PLAIN, friction, _, OPTIONAL, 0.3, 0, 2, "", "Coulomb friction, cable on deck [assumed]") \
    F(REAL, slip_speed, mps, OPTIONAL, 0.1, 1e-4, 10, "", "sliding speed at which friction reaches 0.71 of its value [assumed]")
BT_DECLARE_GROUP(cable_deck, BT_CABLE_DECK_FIELDS)

#define BT_CABLE_SHEAVES_FIELDS(F)                                                                 \
    F(REAL, height, m, OPTIONAL, 0.1, 0, 2, "", "centre of the cable above the deck where it leaves the sheave [assumed]") \
    F(REAL, purchase_stiffness, Npm, OPTIONAL, 5e5, 0, 1e9, "", "purchase cable below deck: spring along the cable [assumed: 100 m of the same rope]") \
    F(REAL, purchase_damping, Npmps, OPTIONAL, 1.68e4, 0, 1e6, "", "purchase cable: damping along the cable [assumed: sqrt(EA mass), swallows an axial wave]")
BT_DECLARE_GROUP(cable_sheaves, BT_CABLE_SHEAVES_FIELDS)

#define BT_CABLE_FIELDS(F)                                                                         \
    F(REAL, span, m, OPTIONAL, 36.0, 2, 200, "", "distance of the two sheaves") \
    F(REAL, diameter, m, OPTIONAL, 0.0365, 0.002, 0.2, "Eq. 11", "diameter of the rope") \
    F(REAL, mass, kgpm, OPTIONAL, 5.536, 0.01, 100, "Eq. 11", "mass per metre") \
    F(REAL, axial_stiffness, N, OPTIONAL, 5.1e7, 1e3, 1e10, "Eq. 12", "K0 axial: EA") \
    F(REAL, bending_stiffness, Nm2, OPTIONAL, 150, 0, 1e5, "Eq. 14", "K0 bending: EI") \
    F(REAL, twist_stiffness, Nm2, OPTIONAL, 60, 0, 1e5, "Eq. 16", "K0 twist: GJ") \
    F(REAL, axial_damping, Ns, OPTIONAL, 80, 0, 1e5, "Eq. 13", "C0 axial; the step pays for more than 80 N s at 0.05 m segments [assumed]") \
    F(REAL, bending_damping, Nm2s, OPTIONAL, 0.08, 0, 100, "Eq. 15", "C0 bending [assumed]") \
    F(REAL, twist_damping, Nm2s, OPTIONAL, 0.03, 0, 100, "Eq. 17", "C0 twist [assumed]") \
    F(PLAIN, shear_ratio, _, OPTIONAL, 0.3333333333333333, 0.01, 0.6, "", "shear over axial stiffness and damping of a joint; not in the paper [assumed]") \
    F(PLAIN, compression_ratio, _, OPTIONAL, 0.01, 0, 1, "", "stiffness in compression over that in tension: a rope does not push [assumed]") \
    F(REAL, pretension, N, OPTIONAL, 24e3, 1, 1e6, "", "tension at the sheaves at rest") \
    F(PLAIN, wheel_friction, _, OPTIONAL, 0.2, 0, 2, "", "Coulomb friction, tyre on cable") \
    F(GROUP, mesh, cable_mesh, OPTIONAL, 0, 0, 0, "Eq. 11", "segment lengths") \
    F(GROUP, supports, cable_supports, OPTIONAL, 0, 0, 0, "", "wire supports under the cable") \
    F(GROUP, deck, cable_deck, OPTIONAL, 0, 0, 0, "", "cable on deck") \
    F(GROUP, sheaves, cable_sheaves, OPTIONAL, 0, 0, 0, "", "ends of the cable")
BT_DECLARE_GROUP(cable, BT_CABLE_FIELDS)
// clang-format on

#endif
