/// What became of a landing: the hook's bounces, its meeting with each wire, outcome, mode and
/// margin [Peng2023 Eq. 18]. Small machines that are told what happened and keep what matters.
#ifndef BT_LANDING_OUTCOME_H
#define BT_LANDING_OUTCOME_H

#include "landing/cable_contact.h"
#include "landing/landing.h"
#include "landing/profile.h"

/// The hook's bounces on the deck, up to its first contact with a wire: what a cable does to the
/// hook is no bounce.
typedef struct bt_hops {
    bool touched;         ///< the hook has touched the deck at least once
    bool airborne;        ///< after a touch
    double leave_x_m;     ///< where the present bounce left the deck
    double last_x_m;      ///< place of the shoe at the latest step
    double top_m;         ///< top of the present bounce
    double impact_peak_N; ///< peak load of the contact before it
} bt_hops;

/// After an airframe step: the shoe's place, clearance and deck force; whether a wire has touched
/// the hook by now.
void bt_hops_see(bt_hops* hops, bt_landing_result* result, double shoe_x_m, double height_m,
                 double force_N, bool on_wire);

/// The meeting of the hook and one wire.
typedef struct bt_meeting {
    int wire;     ///< its number, from 1
    bool passed;  ///< the hook has left the cable behind
    bool met;     ///< the lip has reached the cable
    bool beside;  ///< where it did there is no cable
    double met_s; ///< when; NAN until then
    double margin_m;
    double last_gap_m, last_rise_m; ///< cable ahead of and above the lip, at the latest step
    bool clear_of_deck_when_met;    ///< no deck contact before the meeting
    // contacts with the cable
    bool zone_touched[BT_ZONE_COUNT];
    bool arm_before_throat;
    double first_contact_s, catch_s; ///< NAN until then
    double throat_force_peak_N, tension_max_N;
    double last_cable_force_N; ///< throat and arm together, at the latest step
} bt_meeting;

void bt_meeting_start(bt_meeting* meeting);

/// The hook crossed the wire at time_s, high above it, before the run began; rise_m: the cable's
/// height above the lip, negative.
void bt_meeting_crossed_before(bt_meeting* meeting, double time_s, double rise_m, bool beside);

/// After a cable step: normal forces on the zones, and lip and cable centres in the hook's plane.
/// The cable's height above the lip when the lip passes under or over its centre is the margin: a
/// rope rolls on the lip, so that friction does not decide which way it goes. If point or shoe
/// touch before, the rest of the way is extrapolated: after a touch the rope is pushed clear on one
/// side or the other. A hook that passes beyond the end of the cable has no margin.
void bt_meeting_see(bt_meeting* meeting, const bt_hook_contact* hook, double time_s,
                    bool touched_deck);

/// Whether the throat has caught the cable, at catch_s, and has had to hold it since
/// [Peng2023 Eq. 18].
bool bt_meeting_caught(const bt_meeting* meeting);

/// What is known of the landing from its meetings with `count` wires so far: forces, times, margin.
/// The wire that was caught first speaks for the landing, else the last one met, else the first.
void bt_outcome_gather(const bt_meeting* const* meetings, int count, bt_landing_result* result);

/// Closes the books: outcome, mode, margin, the bounce that was still in the air. `stopped`: the
/// aircraft came to rest before it had passed the wires.
void bt_outcome_finish(const bt_hops* hops, const bt_meeting* const* meetings, int count,
                       bool stopped, bt_landing_result* result);

#endif
