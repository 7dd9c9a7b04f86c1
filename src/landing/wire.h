/// One wire of the deck: its place, its cable, and what a landing does to it.
///
/// A wire's cable lives in the wire's own frame, in which it rests at x = 0; `position_m` is where
/// that lies on the deck. Wires that are alike may share cable model and resting shape.
#ifndef BT_LANDING_WIRE_H
#define BT_LANDING_WIRE_H

#include "landing/airframe.h"
#include "landing/cable_contact.h"
#include "landing/outcome.h"

/// The parts of the aircraft that can touch a wire: the wheels as BT_LEG_*, and the hook.
enum { BT_PART_HOOK = BT_LEG_COUNT, BT_PART_COUNT };

typedef struct bt_wire {
    int number;        ///< from 1, in the order in which a landing meets them
    double position_m; ///< x of the resting cable on the deck
    const bt_cable_model* cable;
    const bt_cable_state* resting; ///< static equilibrium
} bt_wire;

/// Works at the contacts of wheels and hook with the cables, J.
typedef struct bt_works {
    double on_cable, friction,
        friction_most; ///< so far; of friction in one cable step, the largest
} bt_works;

/// What changes. Contacts hold constants of the model besides.
typedef struct bt_wire_state {
    bt_cable_state cable;
    bt_wheel_contact wheel[BT_LEG_COUNT];
    bt_hook_contact hook;
    bt_meeting meeting;
    double clearance_m[BT_PART_COUNT]; ///< distance of each part from the cable
    bool clearer[BT_PART_COUNT];       ///< cannot touch the cable in the present step
    bool awake;                        ///< the cable has left its equilibrium
    bool loaded;                       ///< parts have put loads on the cable
    bool left; ///< nothing can come back to it: it is computed no more (bt_wire_leave)
} bt_wire_state;

/// What the parts bring to the wires: tyres with the strips of the contact law, head, friction.
void bt_wire_contacts(const bt_airframe* airframe, const bt_model_params* params,
                      bt_wire_state* state);

/// Puts the wire at rest, with nothing touching it.
void bt_wire_start(const bt_wire* wire, bt_wire_state* state);

/// Clearances of the parts at the start of an airframe step.
void bt_wire_follow(const bt_wire* wire, bt_wire_state* state,
                    const bt_moving_body part[BT_PART_COUNT]);

/// The cable's own steps within one airframe step: it meets what comes within reach_m, and the
/// parts are given the opposite. It sleeps in its equilibrium until something can touch it, which
/// is exact. `works` may be NULL. Returns the number of cable steps.
int bt_wire_step(const bt_wire* wire, bt_wire_state* state, bt_moving_body part[BT_PART_COUNT],
                 bt_slides* slides, bt_works* works, double time_s, double step_s, double stable_s,
                 double reach_m, bool touched_deck);

/// After the airframe step: the hook's passing where it is too far for contact, and the tension.
void bt_wire_record(const bt_wire* wire, bt_wire_state* state, double time_s, bool touched_deck);

/// Notes whether the hook has left the wire behind: past_m beyond the cable, or
/// BT_PAST_CABLE_MOST_M past where it lay (it may ride on the arm for ever).
void bt_wire_pass(bt_wire_state* state, double past_m);

/// The hook crossed the wire on the glide before the run began, which is exact as nothing touches
/// anything there: notes by what height. For the start of a run.
void bt_wire_crossed_before(bt_wire_state* state, double time_s, double speed_mps,
                            double sink_speed_mps);

/// A wire that lies behind the hook when the run begins is left and was not met; another stays.
void bt_wire_leave_behind(bt_wire_state* state);

/// Stops computing a wire that the aircraft has left for good: the hook has passed it, every part
/// is BT_WIRE_SETTLING_M ahead of its foremost point, and no point of it moves forward at half the
/// aircraft's speed. The gap then opens faster than at half that speed, and what acts on the wire
/// from there on, its own tension, pulls it back.
#define BT_WIRE_SETTLING_M 2
void bt_wire_leave(const bt_wire* wire, bt_wire_state* state,
                   const bt_moving_body part[BT_PART_COUNT]);

#endif
