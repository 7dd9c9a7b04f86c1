/// The frame in which motion is described: at rest, or fixed to the deck of a ship that moves.
///
/// Coordinates, velocities and angular velocities are those seen in the frame. With a0 the
/// acceleration of its origin, W its angular velocity and W' the rate of that, all in its own axes,
/// a free particle at r that moves with v has the acceleration
///
///     a = (g - a0) - W' x r - W x (W x r) - 2 W x v          (Euler, centrifugal, Coriolis)
///
/// and a free body of inertia J, its angular velocity w relative to the frame, u = A^T W, u' =
/// A^T W', all in its own axes, obeys J w' = -w x J w + T with the torque
///
///     T = w x J w - (w + u) x J (w + u) - J u' + J (w x u)
///
/// from d/dt (J (w + u)) = -(w + u) x J (w + u) and d/dt (A^T W) = u' - w x u.
#ifndef BT_MECHANICS_FRAME_H
#define BT_MECHANICS_FRAME_H

#include <stdbool.h>

typedef struct bt_frame {
    double gravity_mps2[3];     ///< g - a0: gravity less the acceleration of the origin
    double spin_radps[3];       ///< W
    double spin_rate_radps2[3]; ///< W'
} bt_frame;

/// Whether the frame turns, or begins to.
bool bt_frame_turns(const bt_frame* frame);

/// Acceleration of a free particle at r that moves with v, m/s2.
void bt_frame_field(const bt_frame* frame, const double r_m[3], const double v_mps[3],
                    double field_mps2[3]);

/// T on a body: rotation A (row-major, body to frame), inertia J (row-major), w; body axes, N m.
void bt_frame_torque(const bt_frame* frame, const double rotation[9], const double inertia[9],
                     const double spin_radps[3], double torque_Nm[3]);

/// Centrifugal potential of a body, -(m |W x r|^2 + u . J u) / 2, J. With a constant frame the sum
/// of kinetic energy (as seen in it), gravity's and this is kept.
double bt_frame_potential(const bt_frame* frame, double mass_kg, const double r_m[3],
                          const double rotation[9], const double inertia[9]);

#endif
