/// What an observer of a landing may look at: everything in SI, nothing to be changed.
#ifndef BT_LANDING_VIEW_H
#define BT_LANDING_VIEW_H

#include "landing/landing.h"
#include "landing/profile.h"

enum {
    BT_BODY_FUSELAGE,
    BT_BODY_NOSE_PISTON,
    BT_BODY_LEFT_PISTON,
    BT_BODY_RIGHT_PISTON,
    BT_BODY_NOSE_WHEEL,
    BT_BODY_LEFT_WHEEL,
    BT_BODY_RIGHT_WHEEL,
    BT_BODY_HOOK,
    BT_BODY_COUNT
};
extern const char* const bt_body_names[BT_BODY_COUNT];

typedef struct bt_landing_view {
    double time_s; ///< 0 at the first contact of any part with the deck
    int64_t step;
    bool last; ///< the final call of the run

    const double* q;        ///< [7 * BT_BODY_COUNT] x y z (m), e0..e3; the cable rests at x = 0
    const double* v;        ///< [6 * BT_BODY_COUNT] m/s in the world, rad/s in the body
    const double* rotation; ///< [9 * BT_BODY_COUNT] row-major, body to world

    double hook_angle_rad;     ///< shank below the fuselage axis
    double hook_height_m;      ///< lowest point of the head above the deck
    double hook_shoe_m[3];     ///< centre of the shoe arc
    double hook_lip_m[3];      ///< centre of the lip
    double hook_deck_force_N;  ///< normal
    double hook_damper_force_N;
    double stroke_m[BT_LEG_COUNT], strut_force_N[BT_LEG_COUNT];
    double tyre_deflection_m[BT_LEG_COUNT], tyre_force_N[BT_LEG_COUNT]; ///< deck and cable
    double tyre_cable_force_N[BT_LEG_COUNT];                            ///< of it, on the cable
    double wheel_spin_radps[BT_LEG_COUNT];
    double hook_pivot_force_N[3];            ///< of the fuselage on the hook, world
    double strut_side_force_N[BT_LEG_COUNT]; ///< across the strut, of the fuselage on the piston
    double zone_force_N[BT_ZONE_COUNT];      ///< normal force of the cable on the zones of the head
    double energy_J;                         ///< of the airframe: kinetic, gravity, springs

    // what passes between the cable and wheels and hook
    const double* cable_wrench; ///< [6 * BT_BODY_COUNT] on the bodies, mean of the last step: N in
                                ///< the world, N m in the body
    double cable_work_J;        ///< on the cable, so far
    double friction_J;          ///< work of friction on both, so far: it never rises
    double friction_most_J;     ///< the largest of one cable step, so far; -INFINITY before any

    bool cable_awake; ///< false while it still lies in its equilibrium
    int cable_count;
    const double *cable_x, *cable_y, *cable_z; ///< [cable_count] centres of the segments
    const double* cable_tension_N;             ///< [cable_count - 1] between neighbours
    const void* run; ///< for bt_landing_cable_energy
} bt_landing_view;

/// Energy of the cable, its supports and deck contact, J: kinetic, elastic and gravity.
double bt_landing_cable_energy(const bt_landing_view* view);

#endif
