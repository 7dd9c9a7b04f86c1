/// Coulomb friction without stick, for seals and bearings, the shoe on the deck, and wheels and
/// hook on the cable. Two contacts have their own: the cable on the deck v / sqrt(v^2 + v_s^2),
/// smooth for the vector kernel (cable/deck.h), and the tyre on the deck its slip curve
/// (elements/tyre.h).
#ifndef BT_ELEMENTS_FRICTION_H
#define BT_ELEMENTS_FRICTION_H

#include <math.h>

/// Friction factor: what share of mu N acts, with the sign of the sliding speed.
///
///     phi(x) = x (3 - x^2) / 2 for |x| < 1,  sign(x) beyond,   x = v / slip_speed
///
/// Exactly Coulomb once the speed reaches slip_speed; value and slope continuous. Bodies at rest
/// under a side load creep at a share of slip_speed: that is the price, and slip_speed its size.
///
/// @param speed_mps       sliding speed, either sign
/// @param slip_speed_mps  speed at which friction is fully developed, > 0
/// @return                -1 .. 1, same sign as the speed
///
/// Pure. Tests: friction_* in test_impact.c. Differs from the paper: it does not give the law.
static inline double bt_friction_factor(double speed_mps, double slip_speed_mps) {
    const double x = speed_mps / slip_speed_mps;
    if (x >= 1)
        return 1;
    if (x <= -1)
        return -1;
    return 0.5 * x * (3 - x * x);
}

/// Friction force of a point that slides in a plane: -mu N phi(|v|) v / |v|.
///
/// @param mu_N      coefficient times normal force, N, >= 0
/// @param velocity  [3] sliding velocity (the part tangential to the contact), m/s
/// @param force     [3] result, N; its power is never positive
void bt_friction_force(double mu_N, double slip_speed_mps, const double velocity[3],
                       double force[3]);

#endif
