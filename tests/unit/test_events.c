#define _GNU_SOURCE
#include "near.h"
#include "toy_study.h"

#include "base/rng.h"
#include "reliability/event_rows.h"

#include <math.h>

// --- indicators -------------------------------------------------------------------------------

static bt_landing_result landing(bt_outcome outcome, int64_t wire, const bt_mode* modes,
                                 int count) {
    bt_landing_result r = {.outcome = outcome, .wire = wire, .contact_count = count};
    for (int i = 0; i < count; ++i)
        r.contacts[i] = (bt_contact){.wire = i + 1, .mode = modes[i]};
    return r;
}

static int holds(const bt_study* study, const char* name, const bt_landing_result* r) {
    bt_event events[BT_EVENT_MAX];
    const int count = bt_events_of(study, events);
    for (int k = 0; k < count; ++k)
        if (strcmp(events[k].name, name) == 0)
            return bt_event_holds(&events[k], r);
    fail_msg("no event %s", name);
    return -2;
}

static void events_of_a_deck_of_three_wires(void** state) {
    (void)state;
    bt_study* s = calloc(1, sizeof *s);
    toy_study(s, BT_DESIGN_MONTE_CARLO, 8);
    bt_event events[BT_EVENT_MAX];
    assert_int_equal(bt_events_of(s, events), 0); // one wire: the table itself
    s->model.deck.wires.number = 3;
    assert_int_equal(bt_events_of(s, events), 6);

    const bt_mode second[] = {BT_MODE_BOUNCED_OVER, BT_MODE_DIRECT};
    const bt_landing_result caught = landing(BT_ENGAGED, 2, second, 2);
    assert_int_equal(holds(s, "engaged", &caught), 1);
    assert_int_equal(holds(s, "wire_1", &caught), 0);
    assert_int_equal(holds(s, "wire_2", &caught), 1);
    assert_int_equal(holds(s, "bolter", &caught), 0);
    assert_int_equal(holds(s, "skip", &caught), 1); // it left wire 1 behind

    const bt_mode over[] = {BT_MODE_PASSED_OVER, BT_MODE_PASSED_OVER, BT_MODE_PASSED_OVER};
    const bt_landing_result far = landing(BT_MISSED, 0, over, 3); // touched down beyond all
    assert_int_equal(holds(s, "bolter", &far), 1);
    assert_int_equal(holds(s, "skip", &far), 0);

    const bt_mode ridden[] = {BT_MODE_PASSED_OVER, BT_MODE_PASSED_OVER, BT_MODE_RIDDEN_OVER};
    const bt_landing_result lost = landing(BT_MISSED, 0, ridden, 3);
    assert_int_equal(holds(s, "skip", &lost), 1);

    const bt_landing_result failed = landing(BT_FAILED, 0, NULL, 0);
    assert_int_equal(holds(s, "bolter", &failed), -1);
    assert_int_equal(holds(s, "wire_3", &failed), -1);
    free(s);
}

// --- zones ------------------------------------------------------------------------------------

static void zones_lie_between_the_wires(void** state) {
    (void)state;
    bt_study* s = calloc(1, sizeof *s);
    toy_study(s, BT_DESIGN_MONTE_CARLO, 8);
    assert_int_equal(bt_zones_of(s).count, 0);
    s->model.deck.wires.number = 3;
    s->model.deck.wires.spacing_m = 10;
    s->model.landing.distance_to = 2;
    s->inputs[3].distribution = (bt_distribution){.kind = BT_UNIFORM, .lower = -15, .upper = 25};
    const bt_zones z = bt_zones_of(s);
    assert_int_equal(z.count, 4);
    const double share[] = {15. / 40, 10. / 40, 10. / 40, 5. / 40};
    for (int k = 0; k < 4; ++k)
        BT_ASSERT_NEAR(z.share[k], share[k], 1e-14, 0);
    assert_int_equal(bt_zones_find(&z, 10), 0); // at wire 1 itself: it is still ahead
    assert_int_equal(bt_zones_find(&z, 9.99), 1);
    assert_int_equal(bt_zones_find(&z, 0), 1);
    assert_int_equal(bt_zones_find(&z, -10.01), 3);
    free(s);
}

// --- estimates --------------------------------------------------------------------------------

enum { LANDINGS = 1024 };

/// A deck whose truth is known: the first wire that lies 4 m or more beyond the touchdown catches
/// when the sink speed is below 3 m/s, else the next; there are two, 10 m apart.
static int8_t caught(const double* x) {
    const int wire = x[1] >= 4 ? 1 : x[1] >= -6 ? 2 : 3;
    const int is = wire + (x[0] >= 3);
    return (int8_t)(is <= 2 ? is : 0);
}

static bt_study* deck_study(void) {
    bt_study* s = calloc(1, sizeof *s);
    toy_study(s, BT_DESIGN_MONTE_CARLO, LANDINGS);
    s->model.deck.wires.number = 2;
    s->model.deck.wires.spacing_m = 10;
    s->inputs[1] = s->inputs[3];
    s->input_count = 2;
    s->inputs[0].distribution = (bt_distribution){.kind = BT_UNIFORM, .lower = 2, .upper = 4};
    s->inputs[1].distribution = (bt_distribution){.kind = BT_UNIFORM, .lower = -16, .upper = 14};
    s->surrogate = (bt_surrogate_params){
        .folds = 5, .holdout = 0.2, .C = {2, {10, 100}}, .gamma = {2, {0.3, 1}}};
    s->reliability = (bt_reliability_params){.samples = 40000, .seed = 5};
    s->condition_count = 1;
    s->conditions[0] = (bt_condition){1, 4}; // D from -11 to 19: moved by 5 m
    return s;
}

static void read_landings(const bt_study* s, const bt_event* events, int count, bt_evidence* e) {
    bt_design* design;
    assert_int_equal(bt_design_create(s, &design, NULL), BT_OK);
    assert_int_equal(bt_evidence_create(2, LANDINGS, e), BT_OK);
    e->event = calloc((size_t)count * (size_t)e->room, 1);
    for (int i = 0; i < LANDINGS; ++i) {
        double* x = e->x + 2 * i;
        for (int k = 0; k < 2; ++k)
            x[k] = bt_distribution_quantile(&s->inputs[k].distribution,
                                            bt_rng_uniform(9, (uint64_t)i, (uint32_t)k));
        const int8_t wire = caught(x);
        const bt_landing_result r = {.outcome = wire ? BT_ENGAGED : BT_MISSED, .wire = wire};
        e->label[i] = wire > 0;
        e->log_density[i] = bt_design_log_density(design, x);
        for (int k = 0; k < count; ++k)
            e->event[k * e->room + i] = (int8_t)bt_event_holds(&events[k], &r);
        ++e->count;
    }
    bt_design_destroy(design);
}

static const bt_event_row* find(const bt_reliability_result* r, const char* name) {
    for (int k = 0; k < r->event_count; ++k)
        if (strcmp(r->event[k].name, name) == 0)
            return &r->event[k];
    fail_msg("no event %s", name);
    return NULL;
}

static void covers(const bt_event_estimate* e, double exact, double within) {
    BT_ASSERT_NEAR(e->probability, exact, 0, within);
    assert_true(e->ci95.least <= exact && exact <= e->ci95.greatest);
    assert_true(e->ci95.least <= e->probability && e->probability <= e->ci95.greatest);
}

static bt_reliability_result* evaluate(const bt_study* s, int threads) {
    bt_event events[BT_EVENT_MAX];
    const int count = bt_events_of(s, events);
    bt_evidence e;
    bt_judged* judged;
    bt_surrogate surrogate = {.dims = 2, .constant = true, .C = 1, .gamma = 1, .rho = -1};
    const int inputs[] = {0, 1};
    for (int k = 0; k < 2; ++k)
        surrogate.scale[k] = surrogate.weight[k] = 1;
    bt_surrogate_name(&surrogate, s, inputs, 2);
    read_landings(s, events, count, &e);
    assert_int_equal(bt_judged_create(s, &e, &judged, NULL), BT_OK);
    bt_reliability_result* r = calloc(1, sizeof *r);
    const bt_reliability_options options = {
        .judged = judged, .events = events, .event_count = count, .threads = threads};
    assert_int_equal(bt_reliability_run(s, &surrogate, &options, r, NULL), BT_OK);
    bt_judged_destroy(judged);
    bt_evidence_destroy(&e);
    return r;
}

static void events_have_the_known_probabilities(void** state) {
    (void)state;
    bt_study* s = deck_study();
    bt_reliability_result* r = evaluate(s, 2);
    assert_int_equal(r->event_count, 5); // engaged, wire_1, wire_2, bolter, skip
    // D uniform from -16 to 14: the first wire that can catch is 1, 2, none on 10 m each
    const bt_event_row *engaged = find(r, "engaged"), *bolter = find(r, "bolter");
    covers(&engaged->overall, 1. / 2, 0.02);
    covers(&find(r, "wire_1")->overall, 1. / 6, 0.02);
    covers(&find(r, "wire_2")->overall, 1. / 3, 0.02);
    covers(&bolter->overall, 1. / 2, 0.02);
    assert_true(bolter->overall.probability == 1 - engaged->overall.probability);
    assert_true(bolter->condition[0].ci95.least == 1 - engaged->condition[0].ci95.greatest);
    // engaged is the row of the table
    assert_true(engaged->overall.probability == r->overall.corrected);
    assert_true(engaged->overall.ci95.least == r->overall.corrected_ci95.least);
    // D from -11 to 19: 15, 10 and 5 m; 5 m of it were never drawn, and are in the interval
    const bt_event_estimate moved = find(r, "wire_1")->condition[0];
    assert_true(moved.ci95.least < 0.25 && moved.ci95.greatest > 0.25);
    // a skip needs contacts, and these landings have none
    covers(&find(r, "skip")->overall, 0, 0.01);
    free(r);
    free(s);
}

static void events_by_zone(void** state) {
    (void)state;
    bt_study* s = deck_study();
    bt_reliability_result* r = evaluate(s, 1);
    assert_int_equal(r->zones.count, 3);
    // D in [0, 14] before wire 1, [-10, 0) between, [-16, -10) beyond
    BT_ASSERT_NEAR(r->zones.share[0], 14. / 30, 1e-14, 0);
    const bt_event_row *one = find(r, "wire_1"), *two = find(r, "wire_2");
    covers(&one->zone[0], 5. / 14, 0.04);
    covers(&one->zone[1], 0, 0.02);
    covers(&two->zone[0], (5. + 2.) / 14, 0.04);
    covers(&two->zone[1], 3. / 10, 0.04);
    covers(&find(r, "bolter")->zone[2], 1, 0.04);
    free(r);
    free(s);
}

static void events_are_the_same_for_any_number_of_threads(void** state) {
    (void)state;
    bt_study* s = deck_study();
    bt_reliability_result *a = evaluate(s, 1), *b = evaluate(s, 3);
    assert_memory_equal(a->event, b->event, sizeof a->event);
    free(a);
    free(b);
    free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(events_of_a_deck_of_three_wires),
        cmocka_unit_test(zones_lie_between_the_wires),
        cmocka_unit_test(events_have_the_known_probabilities),
        cmocka_unit_test(events_by_zone),
        cmocka_unit_test(events_are_the_same_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
