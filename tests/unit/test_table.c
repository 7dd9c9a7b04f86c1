/// Tables as data: the same cells as text, Markdown, CSV and JSON.
#define _GNU_SOURCE
#include "near.h"

#include "report/table.h"

#include <math.h>
#include <stdlib.h>

static const bt_column columns[] = {
    {.name = "path", .head = "key", .unit = ""},
    {.name = "height_m", .head = "height", .unit = "mm", .scale = 1e3, .decimals = 1},
    {.name = "share",
     .head = "engaged",
     .unit = "%",
     .scale = 100,
     .decimals = 1,
     .interval = true},
    {.name = "runs", .head = "runs", .unit = ""},
    {.name = "met", .head = NULL, .unit = "", .flag = true},
};

static bt_report_table* make(void) {
    bt_report_table* table = bt_report_table_create("Title", columns, 5);
    bt_report_table_row(table);
    bt_report_table_text(table, "a, \"b\"");
    bt_report_table_number(table, 0.0123);
    bt_report_table_interval(table, 0.5, &(bt_interval){0.4, 0.6});
    bt_report_table_count(table, 1234567);
    bt_report_table_flag(table, true);
    bt_report_table_row(table);
    bt_report_table_text(table, "c");
    bt_report_table_said(table, NAN, "refused");
    bt_report_table_row(table); // the rest of the row is empty
    bt_report_table_remark(table, "%d rows", 2);
    return table;
}

static void check(bt_status (*write)(const bt_report_table*, FILE*), const char* want) {
    char* text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    bt_report_table* table = make();
    assert_int_equal(write(table, out), BT_OK);
    bt_report_table_destroy(table);
    fclose(out);
    assert_string_equal(text, want);
    free(text);
}

static void people_read_aligned_columns_in_their_units(void** state) {
    (void)state;
    check(bt_report_table_print, "Title\n"
                                 "key     height, mm         engaged, %       runs\n"
                                 "a, \"b\"        12.3  50.0 [40.0, 60.0]  1,234,567\n"
                                 "c          refused                  -          -\n"
                                 "2 rows\n");
}

static void markdown_holds_what_people_read(void** state) {
    (void)state;
    check(bt_report_table_markdown, "Title\n\n"
                                    "| key | height, mm | engaged, % | runs |\n"
                                    "| --- | --- | --- | --- |\n"
                                    "| a, \"b\" | 12.3 | 50.0 [40.0, 60.0] | 1,234,567 |\n"
                                    "| c | refused | - | - |\n\n"
                                    "2 rows\n");
}

static void csv_holds_si_values_limits_and_quotes(void** state) {
    (void)state;
    check(bt_report_table_csv, "path,height_m,share,share_least,share_greatest,runs,met\n"
                               "\"a, \"\"b\"\"\",0.0123,0.5,0.4,0.6,1234567,true\n"
                               "c,,,,,,\n");
}

static bt_status as_json(const bt_report_table* table, FILE* out) {
    bt_json json = {.out = out};
    return bt_report_table_json(table, &json, NULL);
}

static void json_holds_one_object_per_row(void** state) {
    (void)state;
    check(as_json, "[\n  {\n    \"path\": \"a, \\\"b\\\"\",\n    \"height_m\": 0.0123,\n"
                   "    \"share\": 0.5,\n    \"share_ci95\": [\n      0.4,\n      0.6\n    ],\n"
                   "    \"runs\": 1234567,\n    \"met\": true\n  },\n  {\n    \"path\": \"c\",\n"
                   "    \"height_m\": null,\n    \"share\": null,\n    \"share_ci95\": [\n"
                   "      null,\n      null\n    ],\n    \"runs\": null,\n    \"met\": null\n"
                   "  }\n]\n");
}

static void a_share_near_one_is_shown_with_the_digits_that_its_interval_needs(void** state) {
    (void)state;
    assert_int_equal(bt_interval_decimals(0.99991, &(bt_interval){0.99983, 0.99996}, 4), 6);
    assert_int_equal(bt_interval_decimals(1, &(bt_interval){0.9999963, 1}, 4), 7);
    assert_int_equal(bt_interval_decimals(0.5, &(bt_interval){0.3, 0.7}, 4), 4);
    assert_int_equal(bt_interval_decimals(0.5, &(bt_interval){0.5, 0.5}, 1), 1);
    assert_int_equal(bt_interval_decimals(1, &(bt_interval){1 - 1e-15, 1}, 4), 9);
}

static void a_table_that_was_not_made_says_so(void** state) {
    (void)state;
    bt_report_table_row(NULL);
    bt_report_table_number(NULL, 1);
    assert_int_equal(bt_report_table_print(NULL, stdout), BT_ERR_MEMORY);
    bt_report_table* table = bt_report_table_create(NULL, columns, 5);
    bt_report_table_text(table, "half a row");
    assert_int_equal(bt_report_table_csv(table, stdout), BT_ERR_MEMORY);
    bt_report_table_destroy(table);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(people_read_aligned_columns_in_their_units),
        cmocka_unit_test(markdown_holds_what_people_read),
        cmocka_unit_test(csv_holds_si_values_limits_and_quotes),
        cmocka_unit_test(json_holds_one_object_per_row),
        cmocka_unit_test(a_share_near_one_is_shown_with_the_digits_that_its_interval_needs),
        cmocka_unit_test(a_table_that_was_not_made_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
