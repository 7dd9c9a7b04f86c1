#include "landing/outcome.h"

#include <math.h>

/// Lower hops are contact chatter: an air gap that no cable or gauge would notice.
static const double bounce_least_m = 1e-4;

static void close_bounce(const bt_hops* hops, bt_landing_result* result, bool complete) {
    if (hops->top_m < bounce_least_m || result->bounce_count == BT_BOUNCE_MAX)
        return;
    result->bounces[result->bounce_count++] = (bt_bounce){
        .height_m = hops->top_m,
        .distance_m = hops->last_x_m - hops->leave_x_m,
        .impact_force_N = hops->impact_peak_N,
        .complete = complete,
    };
}

void bt_hops_see(bt_hops* hops, bt_landing_result* result, double shoe_x_m, double height_m,
                 double force_N, bool on_wire) {
    result->hook_deck_force_peak_N = fmax(result->hook_deck_force_peak_N, force_N);
    hops->touched |= force_N > 0;
    if (on_wire)
        return;
    hops->last_x_m = shoe_x_m;
    if (force_N > 0) {
        const int before = result->bounce_count;
        if (hops->airborne)
            close_bounce(hops, result, true);
        if (result->bounce_count > before)
            hops->impact_peak_N = 0;
        hops->airborne = false;
        hops->leave_x_m = shoe_x_m;
        hops->top_m = 0;
        hops->impact_peak_N = fmax(hops->impact_peak_N, force_N);
    } else if (hops->touched) {
        hops->airborne = true;
        hops->top_m = fmax(hops->top_m, height_m);
    }
}

void bt_meeting_start(bt_meeting* meeting) {
    *meeting = (bt_meeting){
        .met_s = NAN, .margin_m = NAN, .last_gap_m = NAN, .first_contact_s = NAN, .catch_s = NAN};
}

void bt_meeting_crossed_before(bt_meeting* meeting, double time_s, double rise_m, bool beside) {
    meeting->met = meeting->passed = meeting->clear_of_deck_when_met = true;
    meeting->met_s = time_s;
    meeting->beside = beside;
    meeting->margin_m = beside ? NAN : rise_m;
}

/// Height of the cable above the lip where the lip will pass it: carried on along a straight line
/// over the gap that is left.
static double rise_at_passing(const bt_meeting* meeting, double gap_m, double rise_m) {
    const double closed = meeting->last_gap_m - gap_m;
    if (!(closed > 0 && gap_m > 0))
        return rise_m;
    return rise_m + gap_m * (rise_m - meeting->last_rise_m) / closed;
}

void bt_meeting_see(bt_meeting* meeting, const bt_hook_contact* hook, double time_s,
                    bool touched_deck) {
    const double* force_N = hook->zone_force_N;
    const bool point = force_N[BT_ZONE_POINT] > 0 || force_N[BT_ZONE_SHOE] > 0;
    const bool throat = force_N[BT_ZONE_THROAT] > 0;
    const bool any = point || throat || force_N[BT_ZONE_ARM] > 0;

    if (any && isnan(meeting->first_contact_s))
        meeting->first_contact_s = time_s;
    const double gap = hook->cable_m[0] - hook->lip_m[0], rise = hook->cable_m[2] - hook->lip_m[2];
    if (!meeting->met && (point || gap <= 0)) {
        meeting->met = true;
        meeting->met_s = time_s;
        meeting->beside = hook->beside;
        meeting->margin_m = hook->beside ? NAN : rise_at_passing(meeting, gap, rise);
        meeting->clear_of_deck_when_met = !touched_deck;
    }
    meeting->last_gap_m = gap;
    meeting->last_rise_m = rise;
    if (throat && isnan(meeting->catch_s)) {
        meeting->catch_s = time_s;
        meeting->arm_before_throat = meeting->zone_touched[BT_ZONE_ARM];
    }
    for (int zone = 0; zone < BT_ZONE_COUNT; ++zone)
        meeting->zone_touched[zone] |= force_N[zone] > 0;
    meeting->last_cable_force_N = force_N[BT_ZONE_THROAT] + force_N[BT_ZONE_ARM];
    meeting->throat_force_peak_N = fmax(meeting->throat_force_peak_N, force_N[BT_ZONE_THROAT]);
}

bool bt_meeting_caught(const bt_meeting* meeting) {
    return !isnan(meeting->catch_s);
}

static bt_mode mode_of(const bt_meeting* meeting, bool stopped) {
    if (bt_meeting_caught(meeting))
        return meeting->arm_before_throat ? BT_MODE_ARM : BT_MODE_DIRECT;
    if (stopped)
        return BT_MODE_STOPPED;
    if (!isnan(meeting->first_contact_s))
        return BT_MODE_RIDDEN_OVER;
    if (meeting->beside)
        return BT_MODE_PASSED_BESIDE;
    return meeting->clear_of_deck_when_met ? BT_MODE_PASSED_OVER : BT_MODE_BOUNCED_OVER;
}

static bool decides_over(const bt_meeting* a, const bt_meeting* b) {
    if (bt_meeting_caught(a) || bt_meeting_caught(b))
        return !bt_meeting_caught(b) || a->catch_s < b->catch_s; // false of a NAN
    return a->met ? !b->met || a->wire >= b->wire : !b->met && a->wire < b->wire;
}

static const bt_meeting* deciding(const bt_meeting* const* meetings, int count) {
    const bt_meeting* best = meetings[0];
    for (int k = 1; k < count; ++k)
        if (decides_over(meetings[k], best))
            best = meetings[k];
    return best;
}

static bool is_contact(const bt_meeting* meeting) {
    return meeting->met || !isnan(meeting->first_contact_s);
}

/// One row per wire that was met, in the order of the deck.
static void list_contacts(const bt_meeting* const* meetings, int count, bool stopped,
                          bt_landing_result* result) {
    result->contact_count = 0;
    for (int k = 0; k < count; ++k) {
        const bt_meeting* m = meetings[k];
        if (!is_contact(m))
            continue;
        int at = result->contact_count++;
        for (; at > 0 && result->contacts[at - 1].wire > m->wire; --at)
            result->contacts[at] = result->contacts[at - 1];
        const bt_mode mode = mode_of(m, stopped && !m->passed);
        result->contacts[at] =
            (bt_contact){.wire = m->wire,
                         .mode = mode,
                         .margin_m = mode == BT_MODE_STOPPED ? NAN : m->margin_m,
                         .time_s = isnan(m->first_contact_s) ? m->met_s : m->first_contact_s,
                         .throat_force_peak_N = m->throat_force_peak_N,
                         .tension_max_N = m->tension_max_N};
    }
}

void bt_outcome_gather(const bt_meeting* const* meetings, int count, bt_landing_result* result) {
    result->time_of_contact_s = NAN;
    for (int k = 0; k < count; ++k) {
        const bt_meeting* m = meetings[k];
        result->throat_force_peak_N = fmax(result->throat_force_peak_N, m->throat_force_peak_N);
        result->cable_tension_max_N = fmax(result->cable_tension_max_N, m->tension_max_N);
        result->time_of_contact_s = fmin(result->time_of_contact_s, m->first_contact_s);
    }
    result->margin_m = deciding(meetings, count)->margin_m;
}

void bt_outcome_finish(const bt_hops* hops, const bt_meeting* const* meetings, int count,
                       bool stopped, bt_landing_result* result) {
    if (hops->airborne)
        close_bounce(hops, result, false);
    const bt_meeting* meeting = deciding(meetings, count);
    bt_outcome_gather(meetings, count, result);
    list_contacts(meetings, count, stopped, result);
    result->outcome = bt_meeting_caught(meeting) ? BT_ENGAGED : BT_MISSED;
    result->wire = bt_meeting_caught(meeting) ? meeting->wire : 0;
    result->mode = mode_of(meeting, stopped);
    if (result->mode == BT_MODE_STOPPED)
        result->margin_m = NAN;
    result->retained = result->outcome == BT_ENGAGED && meeting->last_cable_force_N > 0;
}
