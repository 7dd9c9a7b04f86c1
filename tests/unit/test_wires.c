/// A deck with several wires.
#include "reference.h"

#include "landing/model.h"
#include "landing/parts.h"
#include "landing/view.h"
#include "landing/wires.h"

#include <stdlib.h>

static bt_landing_result land_once(const bt_model_params* model) {
    bt_lander* lander = new_lander();
    const bt_landing_result r = land(lander, model, NULL, NULL);
    bt_lander_destroy(lander);
    return r;
}

/// What does not tell two landings apart that are the same to rounding.
static void assert_alike(const bt_landing_result* a, const bt_landing_result* b, double atol_m) {
    assert_string_equal(bt_outcome_name(a->outcome), bt_outcome_name(b->outcome));
    assert_string_equal(bt_mode_name(a->mode), bt_mode_name(b->mode));
    BT_ASSERT_NEAR(a->margin_m, b->margin_m, 0, atol_m);
}

/* ---- far apart ---- */

static void two_wires_far_apart_are_two_landings_with_one(void** state) {
    (void)state;
    static const double distance_m[] = {5, 1.5, 8.25, -2, 0.4};
    for (int k = 0; k < 5; ++k) {
        bt_model_params one = REFERENCE("landing.sink_speed=5 m/s");
        one.landing.distance_m = distance_m[k];
        const bt_landing_result alone = land_once(&one);
        bt_model_params two = one;
        two.deck.wires.number = 2;
        two.deck.wires.spacing_m = 60;
        // the first wire does not know of the one far ahead: the same to the bit
        const bt_landing_result first = land_once(&two);
        assert_true(first.contact_count >= 1 && first.contacts[0].wire == 1);
        assert_true(first.contacts[0].margin_m == alone.margin_m);
        assert_int_equal(first.contacts[0].mode, alone.mode);
        assert_true(first.contacts[0].throat_force_peak_N == alone.throat_force_peak_N);
        assert_int_equal(first.wire == 1, alone.outcome == BT_ENGAGED);
        // nor the second of the one far behind: the same to rounding at 60 m
        two.landing.distance_to = 2;
        const bt_landing_result second = land_once(&two);
        assert_alike(&second, &alone, 1e-6);
        assert_int_equal(second.contacts[0].mode, BT_MODE_PASSED_OVER);
        assert_int_equal(second.wire, alone.outcome == BT_ENGAGED ? 2 : 0);
    }
}

/// A wire crossed long before the run begins has the margin of the glide's straight line, which is
/// also what a run that begins before it sees, at its first step past the wire.
static void a_wire_crossed_high_before_the_run_has_the_margin_of_the_glide(void** state) {
    (void)state;
    bt_model_params seen = REFERENCE("landing.distance=-7 m");
    const bt_landing_result alone = land_once(&seen);
    assert_int_equal(alone.mode, BT_MODE_PASSED_OVER);
    bt_model_params before = REFERENCE("landing.distance=5 m", "deck.wires.number=2",
                                       "landing.distance_to=2", "deck.wires.spacing=12 m");
    const bt_landing_result r = land_once(&before);
    assert_int_equal(r.contact_count, 2);
    assert_int_equal(r.contacts[0].mode, BT_MODE_PASSED_OVER);
    const bt_landing_params* p = &before.landing;
    const double later_m = alone.margin_m - r.contacts[0].margin_m;
    assert_true(later_m >= 0 && later_m <= p->sink_speed_mps * p->solver.airframe_step_s);
    BT_ASSERT_NEAR(r.contacts[0].time_s, -7 / before.landing.horizontal_speed_mps, 0, 2e-3);
}

/* ---- on past a wire ---- */

static const char* const misses_first[] = {"landing.sink_speed=6.3 m/s", "landing.distance=1.5 m",
                                           "deck.wires.number=4"};

static void a_landing_that_misses_the_first_catches_the_second(void** state) {
    (void)state;
    const bt_model_params four = reference_model(misses_first, 3);
    const bt_model_params one = reference_model(misses_first, 2);
    const bt_landing_result r = land_once(&four), alone = land_once(&one);
    assert_int_equal(alone.outcome, BT_MISSED);
    assert_int_equal(r.outcome, BT_ENGAGED);
    assert_int_equal(r.wire, 2);
    assert_int_equal(r.contact_count, 2);
    assert_int_equal(r.contacts[0].wire, 1);
    assert_int_equal(r.contacts[0].mode, BT_MODE_RIDDEN_OVER);
    assert_true(r.contacts[0].margin_m == alone.margin_m);
    assert_true(r.contacts[0].throat_force_peak_N == 0);
    assert_int_equal(r.contacts[1].wire, 2);
    assert_true(r.contacts[1].margin_m == r.margin_m && r.margin_m > 0);
    assert_true(r.contacts[1].throat_force_peak_N > 0);
    // the second lies 12 m on; the aircraft has lost little speed
    const double between_s = r.contacts[1].time_s - r.contacts[0].time_s;
    BT_ASSERT_NEAR(between_s, 12 / four.landing.horizontal_speed_mps, 0.1, 0);
}

/// All of the deck is missed by a hook that cannot come down: one row per wire, none caught.
static void a_bolter_meets_every_wire_and_catches_none(void** state) {
    (void)state;
    const bt_model_params model =
        REFERENCE("landing.distance=-0.5 m", "deck.wires.number=3", "landing.distance_to=3");
    const bt_landing_result r = land_once(&model);
    assert_int_equal(r.outcome, BT_MISSED);
    assert_int_equal(r.wire, 0);
    assert_int_equal(r.contact_count, 3);
    for (int k = 0; k < 3; ++k)
        assert_int_equal(r.contacts[k].wire, k + 1);
    assert_true(r.contacts[0].margin_m < r.contacts[1].margin_m);
    assert_true(r.contacts[1].margin_m < r.contacts[2].margin_m);
    assert_true(r.margin_m == r.contacts[2].margin_m);
}

/* ---- at the touchdown ---- */

static void a_wire_may_lie_at_the_very_spot_of_touchdown(void** state) {
    (void)state;
    const bt_model_params one = REFERENCE("landing.distance=0 m");
    bt_model_params four = one;
    four.deck.wires.number = 4;
    four.landing.distance_to = 2;
    const bt_landing_result alone = land_once(&one), r = land_once(&four);
    assert_true(r.contact_count >= 2);
    assert_int_equal(r.contacts[1].wire, 2);
    BT_ASSERT_NEAR(r.contacts[1].margin_m, alone.margin_m, 0, 1e-6);
    assert_int_equal(r.contacts[1].mode, alone.mode);
    if (alone.outcome == BT_ENGAGED)
        assert_int_equal(r.wire, 2);
    else
        assert_true(r.contact_count > 2);
}

/// Forces of the cables on wheels and hook at the same time.
typedef struct together {
    bool hook, wheels, both;
} together;

static void see_together(void* user, const bt_landing_view* view) {
    together* t = user;
    double hook = 0, wheels = 0;
    for (int zone = 0; zone < BT_ZONE_COUNT; ++zone)
        hook += view->zone_force_N[zone];
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        wheels += view->tyre_cable_force_N[leg];
    t->hook |= hook > 0;
    t->wheels |= wheels > 0;
    t->both |= hook > 0 && wheels > 0;
}

/// The lip follows the main wheels at 6.1 m; so far apart are the wires.
static void wheels_roll_over_one_wire_while_the_hook_meets_another(void** state) {
    (void)state;
    const bt_model_params one = REFERENCE("landing.distance=8 m", "landing.sink_speed=5 m/s");
    bt_model_params two = one;
    two.deck.wires.number = 2;
    two.deck.wires.spacing_m = 6.1;
    bt_lander* lander = new_lander();
    together t = {0};
    const bt_landing_result r = land(lander, &two, see_together, &t);
    assert_true(t.hook && t.wheels && t.both);
    const bt_landing_result alone = land(lander, &one, NULL, NULL);
    bt_lander_destroy(lander);
    assert_int_equal(r.contacts[0].mode, alone.mode);
    assert_int_equal(r.outcome, alone.outcome);
    BT_ASSERT_NEAR(r.contacts[0].margin_m, alone.margin_m, 0, 5e-4);
}

/* ---- the order in which the program holds them ---- */

typedef struct flight {
    bt_landing_model* model;
    bt_landing_state* state;
} flight;

static flight prepared(const bt_model_params* params) {
    flight f;
    assert_int_equal(bt_landing_model_create(&f.model), BT_OK);
    assert_int_equal(bt_landing_model_prepare(f.model, params, NULL), BT_OK);
    assert_int_equal(bt_landing_state_create(f.model, &f.state), BT_OK);
    return f;
}

static bt_landing_result flown(flight* f) {
    bt_landing_result r;
    for (bool on = bt_landing_start(f->model, f->state); on;
         on = bt_landing_step(f->model, f->state))
        ;
    bt_landing_finish(f->model, f->state, &r);
    bt_landing_state_destroy(f->state);
    bt_landing_model_destroy(f->model);
    return r;
}

static void assert_same_bits(const bt_landing_result* a, const bt_landing_result* b) {
    assert_int_equal(a->wire, b->wire);
    assert_int_equal(a->steps, b->steps);
    assert_int_equal(a->contact_count, b->contact_count);
    assert_memory_equal(a->contacts, b->contacts, (size_t)a->contact_count * sizeof a->contacts[0]);
    assert_true(a->margin_m == b->margin_m && a->end_time_s == b->end_time_s);
    assert_memory_equal(a->tyre_force_max_N, b->tyre_force_max_N, sizeof a->tyre_force_max_N);
}

static void the_order_of_the_wires_does_not_matter(void** state) {
    (void)state;
    static const int orders[][4] = {{3, 2, 1, 0}, {2, 0, 3, 1}};
    const bt_model_params params = reference_model(misses_first, 3);
    flight f = prepared(&params);
    const bt_landing_result straight = flown(&f);
    for (int k = 0; k < 2; ++k) {
        f = prepared(&params);
        bt_wire wires[4];
        memcpy(wires, f.model->wire, sizeof wires);
        for (int i = 0; i < 4; ++i)
            f.model->wire[i] = wires[orders[k][i]];
        const bt_landing_result r = flown(&f);
        assert_same_bits(&r, &straight);
    }
    // nor whether they are counted or listed, from whatever origin
    bt_model_params listed = params;
    listed.deck.wires.number = 1;
    listed.deck.wires.positions = (bt_list){.count = 4, .value = {-8, 4, 16, 28}};
    f = prepared(&listed);
    const bt_landing_result r = flown(&f);
    assert_same_bits(&r, &straight);
    assert_true(r.state_hash == straight.state_hash);
}

/// Wires that the aircraft has left are computed no more; the results are those of computing them.
static void leaving_a_wire_behind_changes_nothing(void** state) {
    (void)state;
    int64_t saved = 0;
    for (int k = 0; k < 6; ++k) {
        bt_model_params params = reference_model(misses_first, 3);
        params.landing.distance_m = 0.5 + 0.4 * k;
        flight f = prepared(&params);
        const bt_landing_result left = flown(&f);
        f = prepared(&params);
        f.model->keeps_wires = true;
        const bt_landing_result kept = flown(&f);
        assert_same_bits(&left, &kept);
        assert_true(kept.cable_steps >= left.cable_steps);
        saved += kept.cable_steps - left.cable_steps;
    }
    assert_true(saved > 0);
}

/* ---- wires that differ ---- */

/// A lower wire leaves the lip less room by as much; a taut one carries more.
static void a_wire_may_have_its_own_height_and_tension(void** state) {
    (void)state;
    bt_model_params model = REFERENCE("landing.distance=5 m", "deck.wires.number=2");
    const double as_ever_m = model.deck.cable.supports.height_m;
    model.deck.wires.support_heights = (bt_list){.count = 2, .value = {0.9 * as_ever_m, as_ever_m}};
    const bt_landing_result low = land_once(&model);
    model.deck.wires.support_heights.value[0] = as_ever_m;
    const bt_landing_result high = land_once(&model);
    assert_true(low.contacts[0].margin_m < high.contacts[0].margin_m);
    assert_int_equal(high.wire, 1);

    model.deck.wires.pretensions = (bt_list){.count = 2, .value = {60e3, 24e3}};
    const bt_landing_result taut = land_once(&model);
    assert_true(taut.contacts[0].tension_max_N > high.contacts[0].tension_max_N);
}

/* ---- memory ---- */

static void a_lander_of_four_wires_takes_at_most_two_megabytes(void** state) {
    (void)state;
    bt_model_params model = reference_model(misses_first, 3);
    model.deck.wires.pretensions = (bt_list){.count = 4, .value = {24e3, 25e3, 26e3, 27e3}};
    bt_lander* lander = new_lander();
    land(lander, &model, NULL, NULL);
    const size_t taken = bt_lander_memory(lander);
    bt_lander_destroy(lander);
    if (taken > 2u * 1024 * 1024)
        fail_msg("a lander takes %zu bytes", taken);
}

/* ---- what is refused ---- */

static void assert_refused(const bt_model_params* model, const char* text) {
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    assert_int_equal(bt_group_check(&bt_model_group, model, "", &diag), BT_ERR_INPUT);
    if (!strstr(kept.text, text))
        fail_msg("\"%s\" is not in: %s", text, kept.text);
}

static void what_no_deck_has_is_refused_with_what_would_do(void** state) {
    (void)state;
    const bt_model_params good = reference_model(misses_first, 3);
    assert_int_equal(bt_group_check(&bt_model_group, &good, "", NULL), BT_OK);
    bt_model_params m = good;
    m.landing.distance_to = 5;
    assert_refused(&m, "landing.distance_to: there is no wire 5; 1 .. 4 (deck.wires) would do");
    m = good;
    m.deck.wires.spacing_m = 0.2;
    assert_refused(&m, "deck.wires.spacing: wires 1 and 2 lie 0.2 m apart");
    m = good;
    m.deck.wires.number = 1;
    m.deck.wires.positions = (bt_list){.count = 3, .value = {0, 24, 12}};
    assert_refused(&m, "deck.wires.positions: 12 m after 24 m is out of order");
    m.deck.wires.positions = (bt_list){.count = 3, .value = {0, 12, 400}};
    assert_refused(&m, "deck.wires.positions: 400 is outside -300 .. 300 m");
    m.deck.wires.positions = (bt_list){.count = 9, .value = {0, 1, 2, 3, 4, 5, 6, 7, 8}};
    assert_refused(&m, "deck.wires.positions: 9 wires; at most 8 would do");
    m = good;
    m.deck.wires.positions = (bt_list){.count = 2, .value = {0, 12}};
    assert_refused(&m, "lists 2 wires, deck.wires.number says 4");
    m = good;
    m.deck.wires.pretensions = (bt_list){.count = 2, .value = {24e3, 24e3}};
    assert_refused(&m, "deck.wires.pretensions: 2 values for 4 wires");
    m = good;
    m.deck.wires.number = 8;
    m.deck.cable.mesh.coarse_length_m = 0.1;
    assert_refused(&m, "more than the 2400 that a landing has room for");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_wires_far_apart_are_two_landings_with_one),
        cmocka_unit_test(a_wire_crossed_high_before_the_run_has_the_margin_of_the_glide),
        cmocka_unit_test(a_landing_that_misses_the_first_catches_the_second),
        cmocka_unit_test(a_bolter_meets_every_wire_and_catches_none),
        cmocka_unit_test(a_wire_may_lie_at_the_very_spot_of_touchdown),
        cmocka_unit_test(wheels_roll_over_one_wire_while_the_hook_meets_another),
        cmocka_unit_test(the_order_of_the_wires_does_not_matter),
        cmocka_unit_test(leaving_a_wire_behind_changes_nothing),
        cmocka_unit_test(a_wire_may_have_its_own_height_and_tension),
        cmocka_unit_test(a_lander_of_four_wires_takes_at_most_two_megabytes),
        cmocka_unit_test(what_no_deck_has_is_refused_with_what_would_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
