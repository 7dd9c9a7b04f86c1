#include "landing/outcome.h"

#include <math.h>

/// Lower hops are contact chatter: an air gap that no cable or gauge would notice.
static const double bounce_least_m = 1e-4;

void bt_tracker_start(bt_tracker* tracker, bt_landing_result* result) {
    *tracker =
        (bt_tracker){.margin_m = NAN, .last_gap_m = NAN, .first_contact_s = NAN, .catch_s = NAN};
    *result = (bt_landing_result){.margin_m = NAN, .time_of_contact_s = NAN};
}

static void close_bounce(bt_tracker* tracker, bt_landing_result* result, bool complete) {
    if (tracker->top_m < bounce_least_m || result->bounce_count == BT_BOUNCE_MAX)
        return;
    result->bounces[result->bounce_count++] = (bt_bounce){
        .height_m = tracker->top_m,
        .distance_m = tracker->last_x_m - tracker->leave_x_m,
        .impact_force_N = tracker->impact_peak_N,
        .complete = complete,
    };
    tracker->impact_peak_N = 0;
}

void bt_tracker_deck(bt_tracker* tracker, bt_landing_result* result, double shoe_x_m,
                     double height_m, double force_N) {
    result->hook_deck_force_peak_N = fmax(result->hook_deck_force_peak_N, force_N);
    if (!isnan(tracker->first_contact_s))
        return; // what the cable does to the hook is no bounce
    tracker->last_x_m = shoe_x_m;
    if (force_N > 0) {
        if (tracker->airborne)
            close_bounce(tracker, result, true);
        tracker->touched = true;
        tracker->airborne = false;
        tracker->leave_x_m = shoe_x_m;
        tracker->top_m = 0;
        tracker->impact_peak_N = fmax(tracker->impact_peak_N, force_N);
    } else if (tracker->touched) {
        tracker->airborne = true;
        tracker->top_m = fmax(tracker->top_m, height_m);
    }
}

/// Height of the cable above the lip where the lip will pass it: carried on along a straight line
/// over the gap that is left.
static double rise_at_passing(const bt_tracker* tracker, double gap_m, double rise_m) {
    const double closed = tracker->last_gap_m - gap_m;
    if (!(closed > 0 && gap_m > 0))
        return rise_m;
    return rise_m + gap_m * (rise_m - tracker->last_rise_m) / closed;
}

void bt_tracker_cable(bt_tracker* tracker, bt_landing_result* result, double time_s,
                      const double zone_force_N[BT_ZONE_COUNT], const double lip_m[3],
                      const double cable_m[3]) {
    const bool point = zone_force_N[BT_ZONE_POINT] > 0 || zone_force_N[BT_ZONE_SHOE] > 0;
    const bool throat = zone_force_N[BT_ZONE_THROAT] > 0;
    const bool any = point || throat || zone_force_N[BT_ZONE_ARM] > 0;

    if (any && isnan(tracker->first_contact_s))
        tracker->first_contact_s = result->time_of_contact_s = time_s;
    const double gap = cable_m[0] - lip_m[0], rise = cable_m[2] - lip_m[2];
    if (!tracker->met && (point || gap <= 0)) {
        tracker->met = true;
        tracker->margin_m = rise_at_passing(tracker, gap, rise);
        tracker->clear_of_deck_when_met = !tracker->touched;
    }
    tracker->last_gap_m = gap;
    tracker->last_rise_m = rise;
    if (throat && isnan(tracker->catch_s)) {
        tracker->catch_s = time_s;
        tracker->arm_before_throat = tracker->zone_touched[BT_ZONE_ARM];
    }
    for (int zone = 0; zone < BT_ZONE_COUNT; ++zone)
        tracker->zone_touched[zone] |= zone_force_N[zone] > 0;
    tracker->last_cable_force_N = zone_force_N[BT_ZONE_THROAT] + zone_force_N[BT_ZONE_ARM];
    result->throat_force_peak_N = fmax(result->throat_force_peak_N, zone_force_N[BT_ZONE_THROAT]);
}

bool bt_tracker_caught(const bt_tracker* tracker) {
    return !isnan(tracker->catch_s);
}

static bt_mode mode_of(const bt_tracker* tracker) {
    if (bt_tracker_caught(tracker))
        return tracker->arm_before_throat ? BT_MODE_ARM : BT_MODE_DIRECT;
    if (!isnan(tracker->first_contact_s))
        return BT_MODE_RIDDEN_OVER;
    return tracker->clear_of_deck_when_met ? BT_MODE_PASSED_OVER : BT_MODE_BOUNCED_OVER;
}

void bt_tracker_finish(bt_tracker* tracker, bt_landing_result* result) {
    if (tracker->airborne)
        close_bounce(tracker, result, false);
    result->outcome = bt_tracker_caught(tracker) ? BT_ENGAGED : BT_MISSED;
    result->mode = mode_of(tracker);
    result->margin_m = tracker->margin_m;
    result->retained = result->outcome == BT_ENGAGED && tracker->last_cable_force_N > 0;
}
