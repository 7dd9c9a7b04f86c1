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
    double clearance_m[BT_PART_COUNT]; ///< of the parts from the cable
    bool clearer[BT_PART_COUNT];       ///< cannot touch the cable in the present step
    bool awake;                        ///< the cable has left its equilibrium
    bool loaded;                       ///< parts have put loads on the cable
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

/// How far the hook's lip is past the cable, m.
double bt_wire_passed_m(const bt_wire_state* state);

#endif
