/// What describes a landing: aircraft, deck and the landing itself. One bt_model_params holds
/// everything a run depends on; it is plain data, copied and overridden per run.
#ifndef BT_LANDING_PARAMS_H
#define BT_LANDING_PARAMS_H

#include "base/fields.h"
#include "cable/cable.h"
#include "elements/hook_damper.h"
#include "elements/impact.h"
#include "elements/oleo.h"
#include "elements/tyre.h"

enum { BT_LEG_TELESCOPIC, BT_LEG_LEVERED };
extern const char* const bt_gear_type_names[];

#define BT_ARM_FIELDS(F)                                                                           \
    F(REAL, pivot_x, m, OPTIONAL, 0, -5, 5, "",                                                    \
      "pivot of the arm on the airframe, from the axle of the extended leg, forward positive "     \
      "(above 0: a trailing arm)")                                                                 \
    F(REAL, pivot_z, m, OPTIONAL, 0, -5, 5, "", "and up positive")                                 \
    F(REAL, foot_x, m, OPTIONAL, 0, -5, 5, "", "strut's attachment on the arm, likewise")          \
    F(REAL, foot_z, m, OPTIONAL, 0, -5, 5, "", "and up positive")                                  \
    F(REAL, head_x, m, OPTIONAL, 0, -5, 5, "", "strut's attachment on the airframe, likewise")     \
    F(REAL, head_z, m, OPTIONAL, 0, -5, 5, "", "and up positive")
BT_DECLARE_GROUP(arm, BT_ARM_FIELDS)

#define BT_GEAR_FIELDS(F)                                                                          \
    F(CHOICE, type, bt_gear_type_names, OPTIONAL, 0, 0, 0, "",                                     \
      "telescopic: the wheel is on the strut's piston; levered: on an arm that turns about a "     \
      "pivot, the strut between arm and airframe")                                                 \
    F(REAL, rake, rad, OPTIONAL, 0, -0.7, 0.7, "",                                                 \
      "telescopic: angle of the strut from the airframe's upright, foot forward positive")         \
    F(GROUP, arm, arm, OPTIONAL, 0, 0, 0, "", "levered: the arm")                                  \
    F(REAL, station, m, REQUIRED, -1.2, -30, 30, "",                                               \
      "x of the axle from the centre of gravity, leg extended, forward positive")                  \
    F(REAL, half_track, m, REQUIRED, 2.445, 0, 20, "",                                             \
      "distance of the axle from the plane of symmetry; 0 for the nose gear")                      \
    F(REAL, underside, m, REQUIRED, -2.59, -20, 0, "",                                             \
      "height of the extended tyre's underside from the centre of gravity (negative)")             \
    F(REAL, piston_mass, kg, REQUIRED, 120, 1e-6, 1e4, "",                                         \
      "mass of the sliding part without wheels; of a levered leg's arm, a slender rod from pivot " \
      "to axle [assumed]")                                                                         \
    F(REAL, wheel_mass, kg, REQUIRED, 50, 1e-6, 1e4, "", "mass of the turning part")               \
    F(REAL, wheel_inertia, kgm2, REQUIRED, 8, 1e-3, 1e4, "",                                       \
      "inertia of the turning part about its axle")                                                \
    F(GROUP, oleo, oleo, REQUIRED, 0, 0, 0, "", "shock strut")                                     \
    F(GROUP, tyre, tyre, REQUIRED, 0, 0, 0, "", "tyre, all of one leg together")
BT_DECLARE_GROUP(gear, BT_GEAR_FIELDS)

#define BT_HOOK_PROFILE_FIELDS(F)                                                                  \
    F(REAL, head_angle, rad, REQUIRED, 0.9076, 0.2, 1.5, "",                                       \
      "shank angle below the horizontal at which the shoe lies level")                             \
    F(REAL, shoe_radius, m, REQUIRED, 0.080, 0.005, 1, "",                                         \
      "radius of the shoe arc in the plane of symmetry")                                           \
    F(REAL, point_ahead, m, REQUIRED, 0.050, 0.005, 1, "",                                         \
      "lip centre ahead of the shoe arc's centre, shoe level")                                     \
    F(REAL, lip_height, m, REQUIRED, 0.030, 0.002, 0.5, "",                                        \
      "lip centre above the lowest point of the shoe, shoe level")                                 \
    F(REAL, lip_radius, m, REQUIRED, 0.010, 0.001, 0.1, "", "rounding of the lip")                 \
    F(REAL, throat_radius, m, REQUIRED, 0.0195, 0.002, 0.5, "",                                    \
      "radius of the throat; at least the cable's")                                                \
    F(REAL, throat_length, m, REQUIRED, 0.020, 0, 0.5, "", "straight between lip and throat")      \
    F(REAL, arm_radius, m, REQUIRED, 0.020, 0.002, 0.5, "", "radius of the arm (shank)")           \
    F(REAL, width, m, REQUIRED, 0.12, 0.01, 1, "", "width of the head across the plane of symmetry")
BT_DECLARE_GROUP(hook_profile, BT_HOOK_PROFILE_FIELDS)

#define BT_HOOK_CABLE_FIELDS(F)                                                                    \
    F(REAL, stiffness, Npm2, OPTIONAL, 5e8, 1e6, 1e12, "",                                         \
      "contact stiffness per metre of cable [assumed]")                                            \
    F(PLAIN, damping_ratio, _, OPTIONAL, 0.2, 0, 2, "",                                            \
      "contact damping of critical, cable against a fixed hook [assumed]")                         \
    F(PLAIN, friction, _, OPTIONAL, 0.2, 0, 2, "", "Coulomb friction, rope on steel")              \
    F(REAL, slip_speed, mps, OPTIONAL, 0.1, 1e-4, 10, "",                                          \
      "sliding speed at which friction is fully developed, also of the tyres on the cable "        \
      "[assumed; a smaller one changes no outcome]")
BT_DECLARE_GROUP(hook_cable, BT_HOOK_CABLE_FIELDS)

#define BT_HOOK_FIELDS(F)                                                                          \
    F(REAL, pivot_x, m, REQUIRED, -5.2, -40, 40, "",                                               \
      "hook pivot from the centre of gravity, forward positive")                                   \
    F(REAL, pivot_z, m, REQUIRED, -0.306, -20, 20, "",                                             \
      "hook pivot from the centre of gravity, up positive")                                        \
    F(REAL, length, m, REQUIRED, 2.352, 0.2, 10, "", "pivot to the centre of the shoe arc")        \
    F(REAL, mass, kg, REQUIRED, 107.9, 1, 5000, "", "mass of hook and shank")                      \
    F(REAL, mass_centre, m, REQUIRED, 1.293, 0, 10, "",                                            \
      "pivot to the centre of mass, along the shank")                                              \
    F(REAL, inertia, kgm2, REQUIRED, 227.4, 0.1, 1e5, "", "inertia about the pivot")               \
    F(REAL, axial_inertia, kgm2, OPTIONAL, 1.0, 1e-3, 1e4, "",                                     \
      "inertia about the shank's own axis [assumed]")                                              \
    F(REAL, shank_bending_stiffness, Nm2, OPTIONAL, 0, 0, 1e9, "",                                 \
      "EI of the shank, bent at one sprung joint in the plane of symmetry; 0: rigid")              \
    F(PLAIN, shank_damping_ratio, _, OPTIONAL, 0.02, 0, 2, "",                                     \
      "damping of that joint, of critical for the part with the head [assumed]")                   \
    F(REAL, down_stop, rad, REQUIRED, 1.2147, 0.2, 1.6, "",                                        \
      "shank angle below the fuselage axis at which the damper is fully extended")                 \
    F(REAL, damper_lever, m, REQUIRED, 0.417, 0.01, 5, "Eq. 9",                                    \
      "distance of the damper's attachment on the shank from the pivot")                           \
    F(REAL, damper_angle, rad, OPTIONAL, 1.5708, 0.3, 2.8, "Eq. 9",                                \
      "angle between damper and shank at the down stop; the lever arm is damper_lever sin of it")  \
    F(REAL, damper_length, m, OPTIONAL, 0.9, 0.05, 5, "Eq. 9",                                     \
      "damper between its attachment points at the down stop; the lever arm then follows the "     \
      "angle")                                                                                     \
    F(VARIANT, damper, hook_damper, REQUIRED, 0, 0, 0, "Eq. 9", "longitudinal damper")             \
    F(REAL, centring_stiffness, Nmprad, OPTIONAL, 2e4, 0, 1e9, "",                                 \
      "yaw damper: stiffness about the yaw axis [assumed]")                                        \
    F(REAL, centring_damping, Nmsprad, OPTIONAL, 800, 0, 1e7, "",                                  \
      "yaw damper: damping about the yaw axis [assumed]")                                          \
    F(GROUP, profile, hook_profile, REQUIRED, 0, 0, 0, "",                                         \
      "outline of the head in its plane of symmetry")                                              \
    F(GROUP, deck_contact, impact, REQUIRED, 0, 0, 0, "Eq. 10", "shoe on deck")                    \
    F(GROUP, cable_contact, hook_cable, OPTIONAL, 0, 0, 0, "", "hook on cable")
BT_DECLARE_GROUP(hook, BT_HOOK_FIELDS)

#define BT_TAIL_FIELDS(F)                                                                          \
    F(REAL, x, m, OPTIONAL, 0, -60, 60, "",                                                        \
      "lowest point of the tail from the centre of gravity, forward positive; x and z both 0: "    \
      "not looked at")                                                                             \
    F(REAL, z, m, OPTIONAL, 0, -20, 20, "", "and up positive")
BT_DECLARE_GROUP(tail, BT_TAIL_FIELDS)

#define BT_AIRCRAFT_FIELDS(F)                                                                      \
    F(REAL, mass, kg, REQUIRED, 22000, 100, 1e6, "Eq. 1", "landing mass, everything included")     \
    F(REAL, inertia_xx, kgm2, REQUIRED, 9.0e4, 10, 1e9, "Eq. 1",                                   \
      "roll inertia of the whole aircraft about its centre of gravity, gear extended, hook down")  \
    F(REAL, inertia_yy, kgm2, REQUIRED, 3.6e5, 10, 1e9, "Eq. 1", "pitch inertia, as above")        \
    F(REAL, inertia_zz, kgm2, REQUIRED, 4.44e5, 10, 1e9, "Eq. 1", "yaw inertia, as above")         \
    F(REAL, inertia_xz, kgm2, OPTIONAL, 0, -1e8, 1e8, "Eq. 1",                                     \
      "tensor entry -integral x z dm, as above")                                                   \
    F(PLAIN, lift_ratio, _, OPTIONAL, 1, 0, 2, "",                                                 \
      "lift over weight at the first touch of the deck, from then on as landing.lift says; until " \
      "then the glide is steady")                                                                  \
    F(GROUP, nose_gear, gear, REQUIRED, 0, 0, 0, "", "nose leg")                                   \
    F(GROUP, main_gear, gear, REQUIRED, 0, 0, 0, "", "main legs, left and right alike")            \
    F(GROUP, hook, hook, REQUIRED, 0, 0, 0, "", "arresting hook")                                  \
    F(GROUP, tail, tail, OPTIONAL, 0, 0, 0, "", "what of the fuselage may come down to the deck")
BT_DECLARE_GROUP(aircraft, BT_AIRCRAFT_FIELDS)

#define BT_HEAVE_FIELDS(F)                                                                         \
    F(REAL, velocity, mps, OPTIONAL, 0, -10, 10, "",                                               \
      "of the deck at the first wire at touchdown, up positive; it adds to the sinking velocity")  \
    F(REAL, acceleration, mps2, OPTIONAL, 0, -5, 5, "", "likewise, constant over the landing")     \
    F(REAL, amplitude, m, OPTIONAL, 0, 0, 20, "",                                                  \
      "of a sinusoid added to it: amplitude sin(2 pi t / period + phase), t from touchdown on")    \
    F(REAL, period, s, OPTIONAL, 8, 1, 60, "", "of that sinusoid [assumed]")                       \
    F(REAL, phase, rad, OPTIONAL, 0, -6.2832, 6.2832, "", "of that sinusoid at touchdown")
BT_DECLARE_GROUP(heave, BT_HEAVE_FIELDS)

#define BT_SWAY_FIELDS(F)                                                                          \
    F(REAL, angle, rad, OPTIONAL, 0, -0.15, 0.15, "", "of the deck from level at touchdown")       \
    F(REAL, rate, radps, OPTIONAL, 0, -0.2, 0.2, "", "at touchdown")                               \
    F(REAL, acceleration, radps2, OPTIONAL, 0, -0.2, 0.2, "", "constant over the landing")         \
    F(REAL, amplitude, rad, OPTIONAL, 0, 0, 0.15, "",                                              \
      "of a sinusoid added to it: amplitude sin(2 pi t / period + phase), t from touchdown on")    \
    F(REAL, period, s, OPTIONAL, 8, 1, 60, "", "of that sinusoid [assumed]")                       \
    F(REAL, phase, rad, OPTIONAL, 0, -6.2832, 6.2832, "", "of that sinusoid at touchdown")
BT_DECLARE_GROUP(sway, BT_SWAY_FIELDS)

#define BT_MOTION_FIELDS(F)                                                                        \
    F(GROUP, heave, heave, OPTIONAL, 0, 0, 0, "", "up and down")                                   \
    F(GROUP, pitch, sway, OPTIONAL, 0, 0, 0, "", "about the ship's beam, bow up positive")         \
    F(GROUP, roll, sway, OPTIONAL, 0, 0, 0, "", "about the ship's length, port side up positive")  \
    F(REAL, centre_ahead, m, OPTIONAL, 0, -300, 300, "",                                           \
      "of the first wire: the point that pitch and roll turn about and that heaves; 0: the wire")  \
    F(REAL, centre_below, m, OPTIONAL, 0, 0, 60, "", "of the deck: likewise")
BT_DECLARE_GROUP(motion, BT_MOTION_FIELDS)

enum { BT_WIRE_MAX = 8 }; ///< of a deck

#define BT_WIRES_FIELDS(F)                                                                         \
    F(COUNT, number, _, OPTIONAL, 1, 1, BT_WIRE_MAX, "",                                           \
      "wires of the deck, all as deck.cable says; wire 1 is the first that a landing meets")       \
    F(REAL, spacing, m, OPTIONAL, 12, 0.1, 100, "", "from each wire to the next")                  \
    F(LIST, positions, m, OPTIONAL, 0, -300, 300, "",                                              \
      "instead of both: x of every wire from any origin, forward positive, in order")              \
    F(LIST, pretensions, N, OPTIONAL, 0, 1, 1e6, "",                                               \
      "of every wire, instead of deck.cable.pretension")                                           \
    F(LIST, support_heights, m, OPTIONAL, 0, 0, 1, "",                                             \
      "of every wire, instead of deck.cable.supports.height")
BT_DECLARE_GROUP(wires, BT_WIRES_FIELDS)

#define BT_DECK_FIELDS(F)                                                                          \
    F(REAL, gravity, mps2, OPTIONAL, 9.80665, 0, 100, "", "acceleration of gravity")               \
    F(GROUP, motion, motion, OPTIONAL, 0, 0, 0, "", "how the ship moves during the landing")       \
    F(GROUP, cable, cable, REQUIRED, 0, 0, 0, "Eqs. 11-17",                                        \
      "the arresting cable and what holds it")                                                     \
    F(GROUP, wires, wires, OPTIONAL, 0, 0, 0, "", "how many such wires there are, and where")
BT_DECLARE_GROUP(deck, BT_DECK_FIELDS)

/// Every run ends when the lip is this far past where the cable lay, m: a cable may ride on the arm
/// and never slide home.
#define BT_PAST_CABLE_MOST_M 10

#define BT_SOLVER_FIELDS(F)                                                                        \
    F(REAL, airframe_step, s, OPTIONAL, 4e-4, 1e-7, 1e-2, "",                                      \
      "step of the airframe in flight; half of it while the hook slides on the deck")              \
    F(REAL, contact_step, s, OPTIONAL, 1e-4, 1e-7, 1e-2, "",                                       \
      "step of the airframe around an impact of the hook on the deck, and while it is near the "   \
      "cable")                                                                                     \
    F(PLAIN, cable_courant, _, OPTIONAL, 0.97, 0.05, 1, "", "cable step over its stable step")     \
    F(COUNT, tyre_strips, _, OPTIONAL, 16, 4, 2000, "Eqs. 6-7",                                    \
      "narrow strips of a tyre's disc over the cable's part of the contact patch")                 \
    F(REAL, past_cable, m, OPTIONAL, 1.0, 0.05, BT_PAST_CABLE_MOST_M, "Eq. 18",                    \
      "the run ends when the hook point is this far past the cable; in any case 10 m past where "  \
      "the cable lay")                                                                             \
    F(REAL, after_catch, s, OPTIONAL, 5e-3, 0, 1, "Eq. 18",                                        \
      "or this long after the throat has caught it; loads hold for the first 50 ms, since no "     \
      "arresting engine pays out")
BT_DECLARE_GROUP(solver, BT_SOLVER_FIELDS)

enum { BT_DISTANCE_FROM_HOOK, BT_DISTANCE_FROM_MAIN_WHEELS };
extern const char* const bt_distance_from_names[];

enum { BT_START_GLIDE, BT_START_ROLLING };
extern const char* const bt_start_names[];

enum { BT_LIFT_CONSTANT, BT_LIFT_AERODYNAMIC };
extern const char* const bt_lift_law_names[];

#define BT_LIFT_FIELDS(F)                                                                          \
    F(CHOICE, law, bt_lift_law_names, OPTIONAL, 0, 0, 0, "",                                       \
      "constant: aircraft.lift_ratio times the weight; aerodynamic: that at touchdown, then with " \
      "speed squared and angle of attack")                                                         \
    F(REAL, zero_lift_angle, rad, OPTIONAL, -0.03491, -0.35, 0.2, "",                              \
      "angle of attack without lift, from the pitch axis, flaps down [assumed]")                   \
    F(REAL, wind, mps, OPTIONAL, 0, -20, 40, "",                                                   \
      "wind over the deck, from ahead: speed through the air less horizontal_speed")               \
    F(REAL, dump_after, s, OPTIONAL, 0, 0, 60, "", "after first contact: lift begins to fall")     \
    F(REAL, dump_duration, s, OPTIONAL, 0.3, 1e-3, 60, "", "over which it falls [assumed]")        \
    F(PLAIN, dump_share, _, OPTIONAL, 1, -1, 1, "", "of the lift that is left then; 1: no dump")
BT_DECLARE_GROUP(lift, BT_LIFT_FIELDS)

#define BT_LANDING_FIELDS(F)                                                                       \
    F(CHOICE, start, bt_start_names, OPTIONAL, 0, 0, 0, "",                                        \
      "glide: comes down on the deck; rolling: stands on its struts in equilibrium, hook on "      \
      "deck, "                                                                                     \
      "and rolls in; pitch, roll and sink_speed then play no part")                                \
    F(REAL, sink_speed, mps, REQUIRED, 3.6, 0.01, 15, "Sec. 4.1", "V_V: sinking velocity")         \
    F(REAL, horizontal_speed, mps, REQUIRED, 47.5, 5, 120, "Sec. 4.3",                             \
      "V_E: horizontal velocity relative to the deck")                                             \
    F(REAL, pitch, rad, REQUIRED, 0.05236, -0.35, 0.35, "Sec. 4.2",                                \
      "theta_P: pitch angle, nose up positive")                                                    \
    F(REAL, roll, rad, OPTIONAL, 0, -0.35, 0.35, "", "roll angle, port side up positive")          \
    F(REAL, drift, mps, OPTIONAL, 0, -20, 20, "",                                                  \
      "lateral velocity over the deck, to port positive: crosswind not taken out")                 \
    F(REAL, yaw, rad, OPTIONAL, 0, -0.35, 0.35, "",                                                \
      "yaw angle, nose to port positive; the velocity stays as it is")                             \
    F(REAL, off_centre, m, OPTIONAL, 0, -12, 12, "", "y of the centre of gravity, port positive")  \
    F(REAL, distance, m, REQUIRED, 6, -60, 60, "Sec. 5.3",                                         \
      "D: along the deck from the part named by distance_from to the cable at rest, at first "     \
      "contact; negative when that part is past the cable by then")                                \
    F(CHOICE, distance_from, bt_distance_from_names, OPTIONAL, 0, 0, 0, "Sec. 5.3",                \
      "the part D is measured from")                                                               \
    F(COUNT, distance_to, _, OPTIONAL, 1, 1, BT_WIRE_MAX, "",                                      \
      "the wire D is measured to, by its number")                                                  \
    F(GROUP, lift, lift, OPTIONAL, 0, 0, 0, "", "lift after touchdown")                            \
    F(GROUP, solver, solver, OPTIONAL, 0, 0, 0, "", "steps and limits of the computation")
BT_DECLARE_GROUP(landing, BT_LANDING_FIELDS)

#define BT_MODEL_FIELDS(F)                                                                         \
    F(GROUP, aircraft, aircraft, REQUIRED, 0, 0, 0, "", "the aircraft")                            \
    F(GROUP, deck, deck, REQUIRED, 0, 0, 0, "", "deck and cable")                                  \
    F(GROUP, landing, landing, REQUIRED, 0, 0, 0, "", "the landing")
BT_DECLARE_GROUP(model, BT_MODEL_FIELDS)

#endif
