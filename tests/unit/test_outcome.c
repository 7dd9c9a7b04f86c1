#include "near.h"

#include "landing/outcome.h"

/// A landing with the cable at rest at the origin, 75 mm up, and what is concluded of it.
typedef struct meeting {
    bt_hops hops;
    bt_meeting wire;
    bt_landing_result result;
    double time_s;
} meeting;

static const double far_away[3] = {-5, 0, 0.03};
static const double cable[3] = {0, 0, 0.075};

static meeting begin(void) {
    meeting m = {.result.time_of_contact_s = NAN};
    bt_meeting_start(&m.wire);
    return m;
}

static void deck(meeting* m, double x, double height, double force) {
    bt_hops_see(&m->hops, &m->result, x, height, force, !isnan(m->wire.first_contact_s));
}

/// One cable step: normal forces on shoe, point, throat, arm; lip and cable centres.
static void touch(meeting* m, double shoe, double point, double throat, double arm,
                  const double lip[3]) {
    bt_hook_contact hook = {.zone_force_N = {[BT_ZONE_SHOE] = shoe,
                                             [BT_ZONE_POINT] = point,
                                             [BT_ZONE_THROAT] = throat,
                                             [BT_ZONE_ARM] = arm}};
    memcpy(hook.lip_m, lip, sizeof hook.lip_m);
    memcpy(hook.cable_m, cable, sizeof hook.cable_m);
    m->time_s += 1e-5;
    bt_meeting_see(&m->wire, &hook, m->time_s, m->hops.touched);
}

static const bt_landing_result* finish(meeting* m) {
    const bt_meeting* const one[] = {&m->wire};
    bt_outcome_finish(&m->hops, one, 1, false, &m->result);
    return &m->result;
}

static void assert_ended(const bt_landing_result* r, bt_outcome outcome, bt_mode mode) {
    assert_string_equal(bt_outcome_name(r->outcome), bt_outcome_name(outcome));
    assert_string_equal(bt_mode_name(r->mode), bt_mode_name(mode));
}

/// Eq. 18.
static void throat_first_is_direct(void** state) {
    (void)state;
    meeting m = begin();
    deck(&m, -6, 0, 1e5);
    touch(&m, 0, 0, 0, 0, far_away);
    touch(&m, 0, 0, 5e3, 0, (double[]){0.03, 0, 0.03});
    const bt_landing_result* r = finish(&m);
    assert_ended(r, BT_ENGAGED, BT_MODE_DIRECT);
    assert_true(r->throat_force_peak_N == 5e3);
}

static void arm_before_throat_is_arm(void** state) {
    (void)state;
    meeting m = begin();
    deck(&m, -6, 0, 1e5);
    touch(&m, 0, 0, 0, 2e3, (double[]){0.02, 0, 0.03});
    touch(&m, 0, 0, 0, 0, (double[]){0.03, 0, 0.03});
    touch(&m, 0, 0, 4e3, 0, (double[]){0.04, 0, 0.03});
    assert_ended(finish(&m), BT_ENGAGED, BT_MODE_ARM);
}

static void point_then_throat_is_engaged(void** state) {
    (void)state;
    meeting m = begin();
    deck(&m, -6, 0, 1e5);
    touch(&m, 0, 7e3, 0, 0, (double[]){-0.02, 0, 0.06});
    touch(&m, 0, 0, 1, 0, (double[]){0.02, 0, 0.03});
    const bt_landing_result* r = finish(&m);
    assert_ended(r, BT_ENGAGED, BT_MODE_DIRECT);
    BT_ASSERT_NEAR(r->time_of_contact_s, 1e-5, 1e-12, 0);
}

static void point_without_throat_is_ridden_over(void** state) {
    (void)state;
    meeting m = begin();
    deck(&m, -6, 0, 1e5);
    touch(&m, 3e3, 0, 0, 0, (double[]){-0.02, 0, 0.09});
    touch(&m, 0, 0, 0, 0, (double[]){1.2, 0, 0.12});
    const bt_landing_result* r = finish(&m);
    assert_ended(r, BT_MISSED, BT_MODE_RIDDEN_OVER);
    assert_true(r->margin_m < 0);
    assert_true(r->throat_force_peak_N == 0);
    assert_false(r->retained);
}

static void clear_of_it_after_a_deck_contact_is_bounced_over(void** state) {
    (void)state;
    meeting m = begin();
    deck(&m, -2, 0, 1e5);
    deck(&m, -1, 0.15, 0);
    touch(&m, 0, 0, 0, 0, (double[]){-1, 0, 0.18});
    touch(&m, 0, 0, 0, 0, (double[]){0.01, 0, 0.20});
    const bt_landing_result* r = finish(&m);
    assert_ended(r, BT_MISSED, BT_MODE_BOUNCED_OVER);
    assert_true(isnan(r->time_of_contact_s));
}

static void clear_of_it_before_any_deck_contact_is_passed_over(void** state) {
    (void)state;
    meeting m = begin();
    deck(&m, -1, 0.2, 0);
    touch(&m, 0, 0, 0, 0, (double[]){-1, 0, 0.22});
    touch(&m, 0, 0, 0, 0, (double[]){0.01, 0, 0.21});
    deck(&m, 0.5, 0, 1e5); // touching down behind the cable changes nothing
    assert_ended(finish(&m), BT_MISSED, BT_MODE_PASSED_OVER);
}

static void the_margin_is_taken_once_when_they_meet(void** state) {
    (void)state;
    // by touch
    meeting m = begin();
    touch(&m, 0, 0, 0, 0, (double[]){-0.5, 0, 0.06});
    touch(&m, 0, 1e3, 0, 0, (double[]){-0.025, 0, 0.06});
    touch(&m, 0, 0, 0, 0, (double[]){0.1, 0, 0.02});
    const double at_touch = finish(&m)->margin_m;
    // by passing clear of it
    m = begin();
    touch(&m, 0, 0, 0, 0, (double[]){-1e-4, 0, 0.2});
    touch(&m, 0, 0, 0, 0, (double[]){0, 0, 0.06});
    touch(&m, 0, 0, 0, 0, (double[]){0.1, 0, 0.02});
    const double at_passing = finish(&m)->margin_m;
    BT_ASSERT_NEAR(at_touch, at_passing, 0, 1e-15);
    // 10 mm lower is 10 mm more
    m = begin();
    touch(&m, 0, 1e3, 0, 0, (double[]){-0.025, 0, 0.05});
    BT_ASSERT_NEAR(finish(&m)->margin_m - at_touch, 0.01, 1e-13, 0);
}

/// A lip on a straight way gives the margin of its passing wherever on it the rope is touched.
static void the_way_left_at_the_touch_is_carried_on(void** state) {
    (void)state;
    double margin[3];
    for (int k = 0; k < 3; ++k) {
        const double touched_at = -0.03 + 0.01 * k, slope = 0.02;
        meeting m = begin();
        touch(&m, 0, 0, 0, 0, (double[]){touched_at - 7e-4, 0, 0.05 + slope * (touched_at - 7e-4)});
        touch(&m, 0, 1e3, 0, 0, (double[]){touched_at, 0, 0.05 + slope * touched_at});
        margin[k] = finish(&m)->margin_m;
    }
    meeting m = begin();
    touch(&m, 0, 0, 0, 0, (double[]){0, 0, 0.05});
    const double at_passing = finish(&m)->margin_m;
    for (int k = 0; k < 3; ++k)
        BT_ASSERT_NEAR(margin[k], at_passing, 0, 1e-14);
}

/// Zero where the centres of rope and lip are level: a rope rolls on the lip.
static void the_margin_is_the_height_of_rope_over_lip(void** state) {
    (void)state;
    meeting m = begin();
    touch(&m, 0, 1e3, 0, 0, (double[]){-0.025, 0, cable[2]});
    BT_ASSERT_NEAR(finish(&m)->margin_m, 0, 0, 0);
    m = begin();
    touch(&m, 0, 1e3, 0, 0, (double[]){-0.025, 0, cable[2] - 0.01});
    BT_ASSERT_NEAR(finish(&m)->margin_m, 0.01, 1e-13, 0);
}

static void beyond_the_end_of_the_cable_it_is_passed_beside(void** state) {
    (void)state;
    meeting m = begin();
    deck(&m, -6, 0, 1e5);
    bt_hook_contact hook = {.beside = true, .lip_m = {-0.1, 12, 0.03}};
    bt_meeting_see(&m.wire, &hook, 0.1, true);
    hook.lip_m[0] = 0.1;
    bt_meeting_see(&m.wire, &hook, 0.2, true);
    const bt_landing_result* r = finish(&m);
    assert_ended(r, BT_MISSED, BT_MODE_PASSED_BESIDE);
    assert_true(isnan(r->margin_m));
}

static void at_rest_before_the_cable_it_has_stopped(void** state) {
    (void)state;
    meeting m = begin();
    deck(&m, -6, 0, 1e5);
    const bt_meeting* const one[] = {&m.wire};
    bt_outcome_finish(&m.hops, one, 1, true, &m.result);
    assert_ended(&m.result, BT_MISSED, BT_MODE_STOPPED);
    assert_true(isnan(m.result.margin_m));
}

/// Of several wires the one that was caught speaks for the landing, else the last one met.
static void the_wire_that_decides(void** state) {
    (void)state;
    bt_meeting wire[3];
    const bt_meeting* const all[] = {&wire[0], &wire[1], &wire[2]};
    for (int k = 0; k < 3; ++k)
        bt_meeting_start(&wire[k]);
    wire[0].met = wire[1].met = true;
    wire[0].margin_m = -0.03;
    wire[1].margin_m = -0.01;
    wire[1].first_contact_s = 0.4;
    wire[0].throat_force_peak_N = 7;
    const bt_hops hops = {.touched = true};
    bt_landing_result r = {0};
    bt_outcome_finish(&hops, all, 3, false, &r);
    assert_ended(&r, BT_MISSED, BT_MODE_RIDDEN_OVER);
    assert_true(r.margin_m == -0.01 && r.time_of_contact_s == 0.4 && r.throat_force_peak_N == 7);
    wire[2].met = true;
    wire[2].margin_m = 0.02;
    wire[2].catch_s = wire[2].first_contact_s = 0.7;
    bt_outcome_finish(&hops, all, 3, false, &r);
    assert_ended(&r, BT_ENGAGED, BT_MODE_DIRECT);
    assert_true(r.margin_m == 0.02 && r.time_of_contact_s == 0.4);
}

static void retained_while_throat_or_arm_still_holds_at_the_end(void** state) {
    (void)state;
    static const double there[3] = {0.05, 0, 0.03};
    meeting m = begin();
    touch(&m, 0, 0, 4e3, 0, there);
    touch(&m, 0, 0, 0, 2e3, there);
    assert_true(finish(&m)->retained);
    m = begin();
    touch(&m, 0, 0, 4e3, 0, there);
    touch(&m, 0, 0, 0, 0, there);
    const bt_landing_result* r = finish(&m);
    assert_false(r->retained);
    assert_int_equal(r->outcome, BT_ENGAGED);
}

static void bounces_have_height_distance_and_the_force_that_began_them(void** state) {
    (void)state;
    meeting m = begin();
    deck(&m, -10, 0.05, 0); // in the glide: no bounce
    deck(&m, -9, -1e-3, 4e5);
    deck(&m, -8.9, -5e-4, 8e5); // leaves the deck here
    deck(&m, -8.8, 0.01, 0);
    deck(&m, -7, 0.04, 0);
    deck(&m, -5.9, 0.005, 0);
    deck(&m, -5.8, -1e-4, 3e5);
    deck(&m, -5.7, 0.02, 0);
    const bt_landing_result* r = finish(&m);
    assert_int_equal(r->bounce_count, 2);
    BT_ASSERT_NEAR(r->bounces[0].height_m, 0.04, 1e-15, 0);
    BT_ASSERT_NEAR(r->bounces[0].distance_m, -5.9 + 8.9, 0.04, 0); // to the last step in the air
    assert_true(r->bounces[0].impact_force_N == 8e5);
    assert_true(r->bounces[0].complete);
    BT_ASSERT_NEAR(r->bounces[1].height_m, 0.02, 1e-15, 0);
    assert_true(r->bounces[1].impact_force_N == 3e5);
    assert_false(r->bounces[1].complete);
    assert_true(r->hook_deck_force_peak_N == 8e5);
}

static void what_the_cable_does_to_the_hook_is_no_bounce(void** state) {
    (void)state;
    meeting m = begin();
    deck(&m, -1, -1e-3, 4e5);
    touch(&m, 0, 1e4, 0, 0, (double[]){-0.02, 0, 0.03});
    deck(&m, 0.5, 0.3, 0);
    deck(&m, 1.0, -1e-3, 9e5);
    const bt_landing_result* r = finish(&m);
    assert_int_equal(r->bounce_count, 0);
    assert_true(r->hook_deck_force_peak_N == 9e5);
}

static void more_bounces_than_there_is_room_for_are_dropped(void** state) {
    (void)state;
    meeting m = begin();
    for (int k = 0; k < 3 * BT_BOUNCE_MAX; ++k) {
        deck(&m, k, -1e-3, 1e5);
        deck(&m, k + 0.5, 0.01, 0);
    }
    assert_int_equal(finish(&m)->bounce_count, BT_BOUNCE_MAX);
}

static void names_are_those_of_the_report(void** state) {
    (void)state;
    assert_string_equal(bt_outcome_name(BT_ENGAGED), "engaged");
    assert_string_equal(bt_outcome_name(BT_MISSED), "missed");
    assert_string_equal(bt_outcome_name(BT_FAILED), "failed");
    assert_string_equal(bt_mode_name(BT_MODE_NONE), "none");
    assert_string_equal(bt_mode_name(BT_MODE_DIRECT), "direct");
    assert_string_equal(bt_mode_name(BT_MODE_ARM), "arm");
    assert_string_equal(bt_mode_name(BT_MODE_BOUNCED_OVER), "bounced_over");
    assert_string_equal(bt_mode_name(BT_MODE_PASSED_OVER), "passed_over");
    assert_string_equal(bt_mode_name(BT_MODE_RIDDEN_OVER), "ridden_over");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(throat_first_is_direct),
        cmocka_unit_test(arm_before_throat_is_arm),
        cmocka_unit_test(point_then_throat_is_engaged),
        cmocka_unit_test(point_without_throat_is_ridden_over),
        cmocka_unit_test(clear_of_it_after_a_deck_contact_is_bounced_over),
        cmocka_unit_test(clear_of_it_before_any_deck_contact_is_passed_over),
        cmocka_unit_test(the_margin_is_taken_once_when_they_meet),
        cmocka_unit_test(the_way_left_at_the_touch_is_carried_on),
        cmocka_unit_test(the_margin_is_the_height_of_rope_over_lip),
        cmocka_unit_test(beyond_the_end_of_the_cable_it_is_passed_beside),
        cmocka_unit_test(at_rest_before_the_cable_it_has_stopped),
        cmocka_unit_test(the_wire_that_decides),
        cmocka_unit_test(retained_while_throat_or_arm_still_holds_at_the_end),
        cmocka_unit_test(bounces_have_height_distance_and_the_force_that_began_them),
        cmocka_unit_test(what_the_cable_does_to_the_hook_is_no_bounce),
        cmocka_unit_test(more_bounces_than_there_is_room_for_are_dropped),
        cmocka_unit_test(names_are_those_of_the_report),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
