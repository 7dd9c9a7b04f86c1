/// The ship under the deck: how deck and frame move during a landing (`deck.motion`).
///
/// The deck frame has its origin at the resting place of the first wire, its axes move with the
/// ship. With the rotation vector f(t) = (roll, -pitch, 0), A = exp(f) takes deck axes to level
/// ones; with c the ship's centre of turning from the origin, h the heave and z the level vertical,
///
///     W  = f' - f x f' / 2             W' = f'' - f x f'' / 2         (to second order in f)
///     v0 = h' A^T z - W x c
///     a0 = h'' A^T z - W' x c - W x (W x c)
///     g  = -g_n A^T z
///
/// and the frame of the mechanics is (g - a0, W, W'), see mechanics/frame.h. Time 0 is the first
/// contact of the aircraft with the deck.
#ifndef BT_LANDING_SHIP_H
#define BT_LANDING_SHIP_H

#include "landing/params.h"
#include "mechanics/frame.h"

/// How long a landing is taken to last by the checks of `deck.motion`, s.
#define BT_SHIP_LASTS_S 1.5

/// The deck at a time, in its axes.
typedef struct bt_ship {
    double up[3];                ///< the level vertical
    double velocity_mps[3];      ///< v0
    double acceleration_mps2[3]; ///< a0
    double spin_radps[3], spin_rate_radps2[3];
    double shift_m[3]; ///< of the origin since time 0, in the axes of time 0
    double turn[9];    ///< row-major: axes of the time to axes of time 0
} bt_ship;

void bt_ship_at(const bt_motion_params* motion, double time_s, bt_ship* ship);

/// Its turn since touchdown as Euler parameters, axes of the time to axes of touchdown.
void bt_ship_turned(const bt_motion_params* motion, double time_s, double turned[4]);

/// Whether anything of the deck's frame differs from a frame at rest: it accelerates, turns or
/// leans. A steady heave velocity does not.
bool bt_ship_accelerates(const bt_motion_params* motion);

/// The frame at a time. `carried`: share of gravity (not of the frame's acceleration) that acts.
void bt_ship_frame(const bt_motion_params* motion, double gravity_mps2, double carried,
                   double time_s, bt_frame* frame);

/// That frame with its origin `ahead_m` further forward: of a wire there.
void bt_ship_frame_ahead(const bt_frame* frame, double ahead_m, bt_frame* moved);

/// What presses a resting wire down at touchdown, m/s2: gravity less the frame's acceleration,
/// normal to the deck.
double bt_ship_pressing(const bt_motion_params* motion, double gravity_mps2);

/// The landing as the deck sees it: its approach velocities less those of the deck at touchdown.
void bt_ship_relative(const bt_motion_params* motion, bt_landing_params* landing);

/// How far the middle of a wire that sleeps in its equilibrium of time 0 is at most from that of
/// any other time of a landing of lasts_s, m: the change of what presses it down times
/// mass l^2 / (8 pretension), l the widest gap between supports.
double bt_ship_sleeping_error(const bt_motion_params* motion, const bt_cable_params* cable,
                              double begins_s, double lasts_s);

/// What the laws above do not describe: large angles, a deck that falls away, an approach that does
/// not come down. Errors in diag, each with its key and what would do.
void bt_ship_check(const bt_model_params* model, const char* path, bt_diag* diag);

#endif
