#include "near.h"

#include "base/diag.h"

#include <stdio.h>

typedef struct last_message {
    bt_severity severity;
    bt_where where;
    char text[2048];
    int count;
} last_message;

static void keep(void* user, bt_severity severity, bt_where where, const char* text) {
    last_message* m = user;
    m->severity = severity;
    m->where = where;
    snprintf(m->text, sizeof m->text, "%s", text);
    ++m->count;
}

static void messages_reach_the_sink_and_are_counted(void** state) {
    (void)state;
    last_message m = {0};
    bt_diag diag = {.sink = keep, .user = &m};
    bt_diag_add(&diag, BT_ERROR, (bt_where){"a.yaml", 3, 7}, "%s: %d", "mass", 5);
    assert_string_equal(m.text, "mass: 5");
    assert_int_equal(m.severity, BT_ERROR);
    assert_int_equal(m.where.line, 3);
    bt_diag_add(&diag, BT_WARNING, BT_NOWHERE, "careful");
    bt_diag_add(&diag, BT_NOTE, BT_NOWHERE, "by the way");
    assert_int_equal(m.count, 3);
    assert_int_equal(diag.errors, 1);
    assert_int_equal(diag.warnings, 1);
}

static void without_a_sink_messages_are_still_counted(void** state) {
    (void)state;
    bt_diag diag = {0};
    bt_diag_add(&diag, BT_ERROR, BT_NOWHERE, "x");
    assert_int_equal(diag.errors, 1);
    bt_diag_add(NULL, BT_ERROR, BT_NOWHERE, "x");
}

static void a_long_message_is_cut(void** state) {
    (void)state;
    last_message m = {0};
    bt_diag diag = {.sink = keep, .user = &m};
    bt_diag_add(&diag, BT_ERROR, BT_NOWHERE, "%*d", 5000, 1);
    assert_int_equal(strlen(m.text), 1023);
}

static void the_place_leaves_out_what_is_not_known(void** state) {
    (void)state;
    char text[128];
    bt_diag_format(text, sizeof text, BT_ERROR, (bt_where){"a.yaml", 4, 16}, "bad");
    assert_string_equal(text, "a.yaml:4:16: error: bad");
    bt_diag_format(text, sizeof text, BT_WARNING, (bt_where){"a.yaml", 0, 0}, "bad");
    assert_string_equal(text, "a.yaml: warning: bad");
    assert_int_equal(bt_diag_format(text, sizeof text, BT_NOTE, BT_NOWHERE, "bad"), 9);
    assert_string_equal(text, "note: bad");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(messages_reach_the_sink_and_are_counted),
        cmocka_unit_test(without_a_sink_messages_are_still_counted),
        cmocka_unit_test(a_long_message_is_cut),
        cmocka_unit_test(the_place_leaves_out_what_is_not_known),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
