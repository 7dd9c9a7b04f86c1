/// Friction of bodies on the cable. docs/theory/hook_on_cable.md, "Friction".
#ifndef BT_CABLE_SLIDE_H
#define BT_CABLE_SLIDE_H

#include "cable/cable.h"

/// One point at which something slides over a segment.
typedef struct bt_cable_slide {
    int segment;
    double point_m[3];     ///< where they touch, on the surface of the rope
    double normal[3];      ///< unit, either way
    double other_mps[3];   ///< velocity of the other body's material there
    double limit_N;        ///< friction coefficient times normal force
    double slip_speed_mps; ///< sliding speed at which friction is fully developed
    double force_N[3];     ///< result: friction on the rope
    double arm_m[3];       ///< result: from the segment's centre to the point
} bt_cable_slide;

/// Finds the friction at `count` points and adds it to the loads of the cable, one point after the
/// other. Call it after bt_cable_forces and after all other loads are set, before bt_cable_advance
/// with the same step.
///
/// The slip is that of the two material points in contact, v + omega x arm - v_other, without its
/// part along the normal: a rope that rolls does not slip. It is taken in the middle of the coming
/// kick (velocities are half a step old), as everything but the frictions still to be found will
/// make it. Coulomb's law against that slip, regularised (elements/friction.h), and never more than
/// halves it, by the mass that answers to a force in that direction at that point:
///
///     1/m_t = 1/m + (a x e) . I^-1 (a x e),   a the arm from the segment's centre, e the direction
///
/// (1/m + r^2/I_spin across the rope). So the work of friction, with the mean of the slips before
/// and after the kick, is never positive, whatever else acts, and however many points share a
/// segment.
///
/// @return the work of all these frictions during the kick, J, <= 0
double bt_cable_slides(const bt_cable_model* model, bt_cable_state* cable, double step_s,
                       bt_cable_slide* slides, int count);

/// Power of the frictions found last, at the velocities that the cable has now, W. For audits: its
/// mean before and after bt_cable_advance, times the kick, is their work.
double bt_cable_slides_power(const bt_cable_state* cable, const bt_cable_slide* slides, int count);

#endif
