/// How an aircraft stands on its struts, hook on deck, while it rolls: static equilibrium of the
/// assembled airframe itself, found by Newton's method on its accelerations
/// (docs/theory/rolling.md).
#ifndef BT_LANDING_STANCE_H
#define BT_LANDING_STANCE_H

#include "landing/airframe.h"

typedef struct bt_stance {
    double height_m;               ///< of the fuselage's centre of mass
    double pitch_rad;              ///< nose up
    double stroke_m[BT_LEG_COUNT]; ///< left as right
    double hook_rad;               ///< shank below the fuselage axis
    double head_rad;               ///< and its part with the head; as hook_rad where it is rigid
    double load_N[BT_LEG_COUNT];   ///< tyre forces
    double hook_N;                 ///< deck on shoe
    bt_glide at;                   ///< lowest points of tyres and hook, see bt_stance_place
    double left_mps2;              ///< the largest acceleration that is left
} bt_stance;

/// Finds the stance under the frame's gravity and the lift at touchdown. BT_ERR_INPUT, said in diag
/// with key and value that would do: an aircraft that tips on its tail, whose struts bottom or
/// tyres stand on their rims, that lift carries, whose hook does not reach the deck or is pushed
/// against its stop. BT_ERR_MEMORY.
BT_CHECKED bt_status bt_stance_find(const bt_airframe* airframe, const bt_model_params* params,
                                    const bt_state* hanging, const bt_frame* frame,
                                    bt_stance* stance, bt_diag* diag);

/// Sets the state to the stance: rolling at the landing's speed, wheels turning without slip, the
/// plane of symmetry at y = off_centre, the aircraft's centre of gravity near x = 0. `glide` gets
/// the lowest points of tyres and hook.
void bt_stance_place(const bt_airframe* airframe, const bt_landing_params* landing,
                     const bt_state* hanging, const bt_stance* stance, bt_state* state,
                     bt_glide* glide);

#endif
