/// CONTRIBUTING.md, "Add a law of the hook damper", followed to the letter: a header, a source and
/// one line, and everything that knows dampers knows this one. This program is linked with the
/// library as it is, but for the table that the line stands in.
#include "hook_damper_friction.h"
#include "messages.h"
#include "near.h"

#include "landing/landing.h"
#include "pipeline/sweep.h"
#include "study/study.h"

#include <stdlib.h>

#define NEW_DAMPER                                                                                 \
    "aircraft.hook.damper={type: friction, air_area: 4000 mm^2, precharge: 55 bar, "               \
    "air_volume: 6 L, friction: 2 kN}"

static bt_status read_study(const char* const* sets, int count, bt_study* study, messages* m) {
    *m = (messages){""};
    bt_diag diag = {.sink = messages_add, .user = m};
    return bt_study_read("studies/reference/study.yaml", sets, count, study, &diag);
}

/// The reference study with further settings; must be accepted.
static bt_study accepted(const char* const* sets, int count) {
    static bt_study study; // large
    messages m;
    if (read_study(sets, count, &study, &m) != BT_OK)
        fail_msg("%s", m.text);
    return study;
}

static bt_landing_result land(const bt_model_params* model) {
    bt_lander* lander = NULL;
    bt_landing_result result;
    assert_int_equal(bt_lander_create(&lander), BT_OK);
    assert_int_equal(bt_lander_run(lander, model, &result, NULL, NULL, NULL), BT_OK);
    bt_lander_destroy(lander);
    assert_int_not_equal(result.outcome, BT_FAILED);
    return result;
}

static void a_study_names_it_sets_it_and_echoes_it(void** state) {
    (void)state;
    const char* const sets[] = {NEW_DAMPER, "aircraft.hook.damper.friction=1500 N"};
    bt_study a = accepted(sets, 2), b;
    const bt_hook_damper_friction_params* p = (const void*)a.model.aircraft.hook.damper.params;
    assert_true(p->friction_N == 1500 && p->slip_speed_mps == 0.05);
    assert_non_null(strstr(a.text, "      type: friction\n"));
    assert_non_null(strstr(a.text, "      slip_speed: 0.05 m/s  # default\n"));
    assert_int_equal(bt_study_read_text("echo", a.text, strlen(a.text), NULL, 0, &b, NULL), BT_OK);
    assert_memory_equal(&a.model, &b.model, sizeof a.model);
    assert_int_equal(a.hash, b.hash);
    bt_study_destroy(&b);
    bt_study_destroy(&a);
}

static void its_keys_vary_and_can_be_swept(void** state) {
    (void)state;
    const char* const sets[] = {
        NEW_DAMPER, "uncertainty.aircraft.hook.damper.friction={distribution: normal, sd: 100 N}",
        "campaign.bounds.aircraft.hook.damper.friction=[1 kN, 3 kN]"};
    bt_study s = accepted(sets, 3);
    const bt_input* input = NULL;
    for (int i = 0; i < s.input_count; ++i)
        if (strcmp(s.inputs[i].path, "aircraft.hook.damper.friction") == 0)
            input = &s.inputs[i];
    assert_non_null(input);
    assert_true(input->distribution.mean == 2000);
    bt_field_set(input->field, &s.model, input->offset, 2500);
    const bt_hook_damper_friction_params* p = (const void*)s.model.aircraft.hook.damper.params;
    assert_true(p->friction_N == 2500);
    const bt_field* field;
    size_t offset;
    assert_int_equal(
        bt_sweep_find(&s.model, "aircraft.hook.damper.slip_speed", &field, &offset, NULL), BT_OK);
    bt_study_destroy(&s);
}

static void errors_tell_its_keys_and_ranges(void** state) {
    (void)state;
    static const struct {
        const char *set, *say;
    } rows[] = {
        {"aircraft.hook.damper.type=fricton",
         "aircraft.hook.damper.type: \"fricton\" is none of orifice, viscous, friction; did you "
         "mean \"friction\"?"},
        {"aircraft.hook.damper.orifice_area=30 mm^2",
         "aircraft.hook.damper.orifice_area: unknown key"},
        {"aircraft.hook.damper.friction=-1 N", "is outside"},
        {"aircraft.hook.damper.air_volume=1 L", "aircraft.hook.damper.air_volume: the gas volume"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        const char* const sets[] = {NEW_DAMPER, rows[i].set};
        bt_study s;
        messages m;
        assert_int_equal(read_study(sets, 2, &s, &m), BT_ERR_INPUT);
        if (!strstr(m.text, rows[i].say))
            fail_msg("%s\ndoes not say\n%s", m.text, rows[i].say);
    }
}

static void append(void* user, const char* text) {
    char** all = user;
    const size_t used = *all ? strlen(*all) : 0;
    *all = realloc(*all, used + strlen(text) + 1);
    assert_non_null(*all);
    strcpy(*all + used, text);
}

static void the_reference_of_keys_tells_it(void** state) {
    (void)state;
    char* text = NULL;
    bt_study_keys(append, &text);
    assert_non_null(strstr(text, "\n## aircraft.hook.damper (type: friction)\n"));
    assert_non_null(strstr(text, "| type: orifice, viscous, friction "));
    free(text);
}

/// Without friction it is the viscous damper without viscosity, to the last bit of a landing; with
/// much of it the hook comes down differently.
static void a_landing_hangs_on_it(void** state) {
    (void)state;
    const char* const none[] = {NEW_DAMPER, "aircraft.hook.damper.friction=0 N"};
    const char* const viscous[] = {"aircraft.hook.damper={type: viscous, air_area: 4000 mm^2, "
                                   "precharge: 55 bar, air_volume: 6 L, damping: 0 N s/m}"};
    const char* const some[] = {NEW_DAMPER};
    bt_study a = accepted(none, 2), b = accepted(viscous, 1), c = accepted(some, 1);
    const uint64_t hash = land(&a.model).state_hash;
    assert_int_equal(hash, land(&b.model).state_hash);
    assert_int_not_equal(hash, land(&c.model).state_hash);
    bt_study_destroy(&a);
    bt_study_destroy(&b);
    bt_study_destroy(&c);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_study_names_it_sets_it_and_echoes_it),
        cmocka_unit_test(its_keys_vary_and_can_be_swept),
        cmocka_unit_test(errors_tell_its_keys_and_ranges),
        cmocka_unit_test(the_reference_of_keys_tells_it),
        cmocka_unit_test(a_landing_hangs_on_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
