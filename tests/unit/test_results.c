/// The table of results: what comes from a row is there, under one name, for every row.
#define _GNU_SOURCE
#include "near.h"

#include "base/units.h"
#include "calibration/simulated_case.h"
#include "landing/result.h"
#include "report/landing_report.h"
#include "report/result_keys.h"

#include <stdio.h>
#include <stdlib.h>

static char* json_of(const bt_landing_result* result) {
    char* text = NULL;
    size_t size = 0;
    bt_json json = {.out = open_memstream(&text, &size)};
    bt_landing_write_json(&json, result);
    fclose(json.out);
    return text;
}

/// A result that has everything: bounces, a remark, a failure.
static bt_landing_result full_result(void) {
    bt_landing_result r = {.outcome = BT_ENGAGED, .mode = BT_MODE_ARM, .bounce_count = 2};
    for (int i = 0; i < 2; ++i)
        r.bounces[i] = (bt_bounce){0.1 + i, 2.5 + i, 3e5 + i, true};
    bt_remarks_note(&r.remarks, BT_REMARK_HOOK_STOP_HIT, 0.25);
    snprintf(r.failed_element, sizeof r.failed_element, "hook");
    return r;
}

/// The member of the JSON that a column stands in: "strut_stroke_max_m" of
/// "strut_stroke_max_nose_m", "bounces" of "bounce_height_m".
static void json_member(const bt_result_column* c, char* name, size_t size) {
    if (c->bounce > 0 || strcmp(c->name, "bounce_count") == 0)
        snprintf(name, size, "\"bounces\"");
    else if (strncmp(c->name, "failed_", 7) == 0)
        snprintf(name, size, "\"failed\"");
    else if (*c->part)
        snprintf(name, size, "\"%.*s_%s\"", (int)(strlen(c->quantity) - strlen(c->part) - 1),
                 c->quantity, c->unit);
    else
        snprintf(name, size, "\"%s\"", c->name);
}

static void every_row_is_in_the_json(void** state) {
    (void)state;
    const bt_landing_result r = full_result();
    char* text = json_of(&r);
    for (int i = 0; i < bt_result_column_count; ++i) {
        char name[96];
        json_member(&bt_result_columns[i], name, sizeof name);
        if (!strstr(text, name))
            fail_msg("%s is not in the JSON", name);
    }
    free(text);
}

static void every_row_has_one_name_a_known_unit_and_a_meaning(void** state) {
    (void)state;
    for (int i = 0; i < bt_result_column_count; ++i) {
        const bt_result_column* c = &bt_result_columns[i];
        assert_true(strlen(c->text) > 10);
        for (int k = 0; k < i; ++k)
            assert_string_not_equal(c->name, bt_result_columns[k].name);
        char whole[96];
        snprintf(whole, sizeof whole, *c->unit ? "%s_%s" : "%s%s", c->quantity, c->unit);
        assert_string_equal(c->name, whole);
        assert_true(!*c->unit || bt_unit_text(c->unit));
        assert_true((c->kind == BT_RESULT_REAL) == (*c->unit != '\0'));
        assert_true(c->offset < sizeof(bt_landing_result));
    }
}

/// A member that no row describes would be missing everywhere else.
static void the_rows_fill_the_struct(void** state) {
    (void)state;
    size_t bytes =
        (BT_BOUNCE_MAX - 2) * sizeof(bt_bounce) + sizeof(int) + BT_CONTACT_MAX * sizeof(bt_contact);
    for (int i = 0; i < bt_result_column_count; ++i)
        switch (bt_result_columns[i].kind) {
        case BT_RESULT_FLAG:
            bytes += sizeof(bool);
            break;
        case BT_RESULT_OUTCOME:
        case BT_RESULT_MODE:
        case BT_RESULT_INT:
            bytes += sizeof(int);
            break;
        case BT_RESULT_TEXT:
            bytes += BT_FAILED_TEXT_SIZE;
            break;
        case BT_RESULT_REMARKS:
            bytes += sizeof(bt_remarks);
            break;
        default:
            bytes += 8;
        }
    assert_true(bytes <= sizeof(bt_landing_result));
    assert_true(sizeof(bt_landing_result) - bytes < 8 * 8); // no more than padding
}

static void every_row_is_in_the_reference(void** state) {
    (void)state;
    char* text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    assert_int_equal(bt_result_keys_markdown(out), BT_OK);
    assert_int_equal(bt_result_keys_json(out), BT_OK);
    fclose(out);
    for (int i = 0; i < bt_result_column_count; ++i) {
        char row[320], member[96];
        const bt_result_column* c = &bt_result_columns[i];
        snprintf(row, sizeof row, "| %s | %s | %s |\n", c->name,
                 *c->unit ? bt_unit_text(c->unit) : "", c->text);
        snprintf(member, sizeof member, "\"name\": \"%s\"", c->name);
        if (!strstr(text, row) || !strstr(text, member))
            fail_msg("%s is not in the reference", c->name);
    }
    for (int i = 0; i < bt_contact_column_count; ++i)
        if (!strstr(text, bt_contact_columns[i].text))
            fail_msg("%s is not in the reference", bt_contact_columns[i].name);
    free(text);
}

static bool is_landing_metric(const char* name, const char* token) {
    for (int i = 0; i < bt_simulated_case_metric_count(BT_CASE_LANDING); ++i) {
        bt_metric_name m;
        if (bt_simulated_case_metric(BT_CASE_LANDING, i, &m) && strcmp(m.name, name) == 0)
            return strcmp(m.token, token) == 0;
    }
    return false;
}

static void every_number_is_a_metric(void** state) {
    (void)state;
    assert_in_range(bt_simulated_case_metric_count(BT_CASE_LANDING), 1, BT_CASE_METRIC_MAX);
    for (int i = 0; i < bt_result_column_count; ++i) {
        const bt_result_column* c = &bt_result_columns[i];
        const bool tells = strcmp(c->name, "wall_s") != 0 && strcmp(c->name, "failed_time_s") != 0;
        assert_int_equal(is_landing_metric(c->quantity, c->unit),
                         c->kind == BT_RESULT_REAL && tells);
    }
    // names that files of 0.1 have
    assert_true(is_landing_metric("bounce_height", "m"));
    assert_true(is_landing_metric("second_bounce_height", "m"));
    assert_true(is_landing_metric("tyre_force_max_left", "N"));
    assert_true(is_landing_metric("margin", "m"));
}

static void a_bounce_that_never_was_has_no_metric(void** state) {
    (void)state;
    bt_landing_result r = full_result();
    r.bounces[1].complete = false;
    for (int i = 0; i < bt_result_column_count; ++i) {
        const bt_result_column* c = &bt_result_columns[i];
        if (strcmp(c->name, "bounce_height_m") == 0)
            BT_ASSERT_NEAR(bt_result_real(c, &r), 0.1, 0, 0);
        if (strcmp(c->name, "second_bounce_height_m") == 0)
            assert_true(isnan(bt_result_real(c, &r)));
    }
}

static void a_remark_keeps_its_first_time_and_reads_back(void** state) {
    (void)state;
    bt_remarks remarks = {0}, read;
    char text[BT_REMARKS_TEXT_SIZE];
    bt_remarks_print(&remarks, text, sizeof text);
    assert_string_equal(text, "");
    bt_remarks_note(&remarks, BT_REMARK_TAIL_CLEARANCE, 1.0 / 3);
    bt_remarks_note(&remarks, BT_REMARK_STRUT_BOTTOMED_NOSE + BT_LEG_RIGHT, -0.125);
    bt_remarks_note(&remarks, BT_REMARK_TAIL_CLEARANCE, 2);
    bt_remarks_print(&remarks, text, sizeof text);
    assert_string_equal(text,
                        "strut_bottomed right -0.125; tail_clearance fuselage 0.33333333333333331");
    bt_remarks_parse(text, &read);
    assert_memory_equal(&read, &remarks, sizeof read);
    bt_remarks_parse("of_a_later_version left 1; hook_stop_hit hook 2", &read);
    assert_int_equal(read.seen, 1 << BT_REMARK_HOOK_STOP_HIT);
}

static void all_remarks_at_once_fit_their_text(void** state) {
    (void)state;
    bt_remarks remarks = {0}, read;
    char text[BT_REMARKS_TEXT_SIZE];
    for (int i = 0; i < BT_REMARK_COUNT; ++i)
        bt_remarks_note(&remarks, (bt_remark)i, -1.0 / 3 - i);
    bt_remarks_print(&remarks, text, sizeof text);
    bt_remarks_parse(text, &read);
    assert_memory_equal(&read, &remarks, sizeof read);
}

static void every_leg_s_remarks_stand_in_the_order_of_the_legs(void** state) {
    (void)state;
    static const bt_remark first[] = {BT_REMARK_STRUT_BOTTOMED_NOSE, BT_REMARK_TYRE_ON_RIM_NOSE};
    for (size_t k = 0; k < sizeof first / sizeof first[0]; ++k)
        for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
            assert_string_equal(bt_remark_table[first[k] + (unsigned)leg].element,
                                bt_leg_names[leg]);
}

static void remarks_are_in_json_and_text(void** state) {
    (void)state;
    const bt_landing_result r = full_result();
    char* json = json_of(&r);
    assert_non_null(strstr(json, "\"what\": \"hook_stop_hit\",\n      \"element\": \"hook\",\n"
                                 "      \"time_s\": 0.25"));
    free(json);
    char* text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    bt_landing_print(out, &r);
    fclose(out);
    assert_non_null(strstr(text, "remark         hook: the hook has swung against its stop, at "
                                 "0.25 s\n"));
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_row_has_one_name_a_known_unit_and_a_meaning),
        cmocka_unit_test(the_rows_fill_the_struct),
        cmocka_unit_test(every_row_is_in_the_json),
        cmocka_unit_test(every_row_is_in_the_reference),
        cmocka_unit_test(every_number_is_a_metric),
        cmocka_unit_test(a_bounce_that_never_was_has_no_metric),
        cmocka_unit_test(a_remark_keeps_its_first_time_and_reads_back),
        cmocka_unit_test(all_remarks_at_once_fit_their_text),
        cmocka_unit_test(every_leg_s_remarks_stand_in_the_order_of_the_legs),
        cmocka_unit_test(remarks_are_in_json_and_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
