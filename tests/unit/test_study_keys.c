// What the tables say of themselves.
#include "near.h"

#include "base/units.h"
#include "messages.h"
#include "study/study.h"

#include <stdlib.h>

typedef struct collected {
    char* text;
    size_t size;
} collected;

static void append(void* user, const char* text) {
    collected* c = user;
    const size_t n = strlen(text);
    c->text = realloc(c->text, c->size + n + 1);
    assert_non_null(c->text);
    memcpy(c->text + c->size, text, n + 1);
    c->size += n;
}

static bool unit_is_known(void* user, const bt_field* field, const char* path, size_t offset) {
    (void)offset;
    char token[32];
    ++*(int*)user;
    if (field->kind == BT_FIELD_REAL || field->kind == BT_FIELD_LIST) {
        if (!bt_unit_text(field->unit))
            fail_msg("%s: unit token %s is not in units.c", path, field->unit);
    } else if (field->kind == BT_FIELD_TABLE) {
        const char* middle = strstr(field->unit, "__");
        assert_non_null(middle);
        snprintf(token, sizeof token, "%.*s", (int)(middle - field->unit), field->unit);
        if (!bt_unit_text(token) || !bt_unit_text(middle + 2))
            fail_msg("%s: unit tokens %s are not in units.c", path, field->unit);
    }
    return true;
}

static void every_unit_of_every_table_is_known(void** state) {
    (void)state;
    int count = 0;
    bt_group_walk(&bt_model_group, unit_is_known, &count);
    assert_true(count > 100);
    bt_group_walk(&bt_campaign_group, unit_is_known, &count);
    bt_group_walk(&bt_surrogate_group, unit_is_known, &count);
    bt_group_walk(&bt_reliability_group, unit_is_known, &count);
    bt_group_walk(&bt_rigs_group, unit_is_known, &count);
}

static bool row_is_sound(void* user, const bt_field* field, const char* path, size_t offset) {
    (void)user, (void)offset;
    const bool number = field->kind == BT_FIELD_REAL || field->kind == BT_FIELD_PLAIN ||
                        field->kind == BT_FIELD_COUNT;
    if (number && !(field->least < field->greatest && field->fallback >= field->least &&
                    field->fallback <= field->greatest))
        fail_msg("%s: fallback %g is outside %g .. %g", path, field->fallback, field->least,
                 field->greatest);
    if (*field->text == '\0' || field->text[strlen(field->text) - 1] == '.')
        fail_msg("%s: a meaning is wanted, without a full stop", path);
    return true;
}

static void every_row_has_a_meaning_and_a_fallback_inside_its_range(void** state) {
    (void)state;
    bt_group_walk(&bt_model_group, row_is_sound, NULL);
    bt_group_walk(&bt_campaign_group, row_is_sound, NULL);
    bt_group_walk(&bt_surrogate_group, row_is_sound, NULL);
    bt_group_walk(&bt_reliability_group, row_is_sound, NULL);
    bt_group_walk(&bt_rigs_group, row_is_sound, NULL);
}

static bool key_is_told(void* user, const bt_field* field, const char* path, size_t offset) {
    (void)offset;
    char row[128];
    snprintf(row, sizeof row, "\n| %s ", field->name);
    if (!strstr((const char*)user, row))
        fail_msg("%s is not in the reference", path);
    return true;
}

static void the_reference_tells_every_key(void** state) {
    (void)state;
    collected c = {0};
    bt_study_keys(append, &c);
    bt_group_walk(&bt_model_group, key_is_told, c.text);
    bt_group_walk(&bt_campaign_group, key_is_told, c.text);
    bt_group_walk(&bt_surrogate_group, key_is_told, c.text);
    bt_group_walk(&bt_reliability_group, key_is_told, c.text);
    bt_group_walk(&bt_rigs_group, key_is_told, c.text);
    static const char* const parts[] = {"\n## aircraft.nose_gear.oleo, aircraft.main_gear.oleo\n",
                                        "\n## uncertainty\n",
                                        "\n| weibull          | scale, shape, lower |\n",
                                        "`bounds`",
                                        "`levels`",
                                        "`conditions`",
                                        "required"};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i)
        if (!strstr(c.text, parts[i]))
            fail_msg("%s is not in the reference", parts[i]);
    free(c.text);
}

static bool is_in_text(void* user, const bt_field* field, const char* path, size_t offset) {
    (void)offset;
    char row[128];
    snprintf(row, sizeof row, " %s:", field->name);
    if (!strstr((const char*)user, row))
        fail_msg("%s is not among the defaults", path);
    return true;
}

static void the_defaults_are_a_study_that_reads(void** state) {
    (void)state;
    collected c = {0};
    bt_study_defaults(append, &c);
    bt_group_walk(&bt_model_group, is_in_text, c.text);
    messages m = {""};
    bt_diag diag = {.sink = messages_add, .user = &m};
    bt_study s;
    if (bt_study_read_text("defaults.yaml", c.text, c.size, NULL, 0, &s, &diag) != BT_OK)
        fail_msg("%s", m.text);
    bt_landing_params landing;
    bt_group_set_defaults(&bt_landing_group, &landing);
    assert_memory_equal(&landing, &s.model.landing, sizeof landing);
    bt_campaign_params campaign;
    bt_group_set_defaults(&bt_campaign_group, &campaign);
    assert_memory_equal(&campaign, &s.campaign, sizeof campaign);
    bt_study_destroy(&s);
    free(c.text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_unit_of_every_table_is_known),
        cmocka_unit_test(every_row_has_a_meaning_and_a_fallback_inside_its_range),
        cmocka_unit_test(the_reference_tells_every_key),
        cmocka_unit_test(the_defaults_are_a_study_that_reads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
