/// What became of a landing: bounces, the meeting of hook and cable, outcome, mode and margin
/// [Peng2023 Eq. 18]. A small machine that is told what happened and keeps what matters.
#ifndef BT_LANDING_OUTCOME_H
#define BT_LANDING_OUTCOME_H

#include "landing/landing.h"
#include "landing/profile.h"

typedef struct bt_tracker {
    // bounces
    bool touched;         ///< the hook has touched the deck at least once
    bool airborne;        ///< after a touch
    double leave_x_m;     ///< where the present bounce left the deck
    double last_x_m;      ///< of the shoe, at the latest step
    double top_m;         ///< of the present bounce
    double impact_peak_N; ///< of the contact that preceded it
    // meeting of lip and cable
    bool met;
    double margin_m;
    double last_gap_m, last_rise_m; ///< cable ahead of and above the lip, at the latest step
    bool clear_of_deck_when_met;    ///< no deck contact before the meeting
    // contacts with the cable
    bool zone_touched[BT_ZONE_COUNT];
    bool arm_before_throat;
    double first_contact_s, catch_s;
    double last_cable_force_N; ///< throat and arm together, at the latest step
} bt_tracker;

void bt_tracker_start(bt_tracker* tracker, bt_landing_result* result);

/// After an airframe step: the shoe's place, clearance and deck force.
void bt_tracker_deck(bt_tracker* tracker, bt_landing_result* result, double shoe_x_m,
                     double height_m, double force_N);

/// After a cable step: normal forces on the zones, and lip and cable centres in the hook's plane.
/// The cable's height above the lip when the lip passes under or over its centre is the margin: a
/// rope rolls on the lip, so that friction does not decide which way it goes. If point or shoe
/// touch before, the rest of the way is extrapolated: after a touch the rope is pushed clear on one
/// side or the other.
void bt_tracker_cable(bt_tracker* tracker, bt_landing_result* result, double time_s,
                      const double zone_force_N[BT_ZONE_COUNT], const double lip_m[3],
                      const double cable_m[3]);

/// Whether the throat has caught the cable, and since when it has had to hold it.
bool bt_tracker_caught(const bt_tracker* tracker);

/// Closes the books: outcome, mode, margin, the bounce that was still in the air.
void bt_tracker_finish(bt_tracker* tracker, bt_landing_result* result);

#endif
