/// The airframe as a multibody system [Peng2023 Eq. 1]: fuselage, three pistons on prismatic
/// joints (or arms on revolute ones), three wheels on revolute joints, the hook on a universal
/// joint (and a shank that bends on a sprung revolute one); struts, tyres, hook damper, yaw damper,
/// shoe on deck and lift as elements.
#ifndef BT_LANDING_AIRFRAME_H
#define BT_LANDING_AIRFRAME_H

#include "elements/oleo.h"
#include "landing/leg.h"
#include "landing/lift.h"
#include "landing/profile.h"
#include "landing/shank.h"
#include "landing/shoe.h"
#include "landing/view.h"
#include "mechanics/system.h"

typedef struct bt_airframe {
    bt_system* system;
    int body_count; ///< BT_BODY_COUNT, and one more when the shank bends: its root, the last body
    bt_shank shank;
    bt_profile profile;
    bt_tyre tyre[BT_LEG_COUNT];
    bt_oleo oleo[BT_LEG_COUNT];
    bt_leg leg[BT_LEG_COUNT];
    double tyre_width_m[BT_LEG_COUNT]; ///< all tyres of the leg
    double fuselage_m[3];              ///< fuselage's centre of mass from the aircraft's
    double axle_m[BT_LEG_COUNT][3];    ///< axles from the centre of gravity, struts extended
    double pivot_m[3];                 ///< hook pivot from the centre of gravity
    bool has_tail;                     ///< a point of the fuselage must clear the deck
    double tail_m[3];                  ///< that point in the fuselage's body frame
    double shoe_m[3];                  ///< shoe arc's centre in the hook's body frame
    bt_shoe shoe_contact;
    bt_lift lift;                  ///< the system reads it here: an airframe does not move
    double stroke_m[BT_LEG_COUNT]; ///< in the glide: struts at rest on their stops
    double hook_angle_rad;         ///< in the glide: shank below the fuselage axis
    double head_angle_rad;         ///< and its part with the head: bent by its weight
    int strut[BT_LEG_COUNT], wheel[BT_LEG_COUNT], damper, shoe; ///< elements
    int strut_joint[BT_LEG_COUNT], hook_joint;
} bt_airframe;

/// Builds and assembles the system with the aircraft at the origin, level and at rest, as it hangs
/// in the glide. BT_ERR_INPUT (said in diag) or BT_ERR_MEMORY. Release with bt_airframe_destroy.
BT_CHECKED bt_status bt_airframe_build(const bt_aircraft_params* params, double gravity_mps2,
                                       double cable_radius_m, bt_airframe* airframe, bt_diag* diag);
void bt_airframe_destroy(bt_airframe* airframe);

/// Lowest points of the gliding aircraft's tyres and hook, world frame.
typedef struct bt_glide {
    double tyre_m[BT_LEG_COUNT][3], hook_m[3];
} bt_glide;

/// Sets the state to the glide: the hanging aircraft (the state as assembled) turned to the
/// landing's attitude, all parts at its velocity, wheels not turning, the centre of gravity at
/// (0, off_centre, 0). The velocity stays along x whatever the yaw.
void bt_airframe_place(const bt_airframe* airframe, const bt_landing_params* landing,
                       const bt_state* hanging, bt_state* state, bt_glide* glide);

/// Height of the tail above the deck, m; INFINITY where it is not looked at.
double bt_airframe_tail_height(const bt_airframe* airframe, const bt_state* state);

/// Moves all bodies by the same shift.
void bt_airframe_move(const bt_airframe* airframe, const double shift_m[3], bt_state* state);

#endif
