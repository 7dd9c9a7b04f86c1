#define _GNU_SOURCE
#include "near.h"

#include "report/json.h"

#include <stdlib.h>

static void check(void (*write)(bt_json*), const char* want) {
    char* text = NULL;
    size_t size = 0;
    bt_json json = {.out = open_memstream(&text, &size)};
    write(&json);
    fclose(json.out);
    assert_string_equal(text, want);
    free(text);
}

static void nested(bt_json* json) {
    bt_json_begin_object(json, NULL);
    bt_json_number(json, "a", 0.1);
    bt_json_begin_array(json, "b");
    bt_json_integer(json, NULL, -3);
    bt_json_bool(json, NULL, true);
    bt_json_begin_object(json, NULL);
    bt_json_end_object(json);
    bt_json_end_array(json);
    bt_json_string(json, "c", NULL);
    bt_json_end_object(json);
}

static void objects_and_arrays_nest(void** state) {
    (void)state;
    check(nested,
          "{\n  \"a\": 0.1,\n  \"b\": [\n    -3,\n    true,\n    {}\n  ],\n  \"c\": null\n}\n");
}

static void odd_numbers(bt_json* json) {
    bt_json_begin_array(json, NULL);
    bt_json_number(json, NULL, NAN);
    bt_json_number(json, NULL, -INFINITY);
    bt_json_number(json, NULL, 1.0 / 3);
    bt_json_end_array(json);
}

static void what_is_not_finite_is_null_and_the_rest_exact(void** state) {
    (void)state;
    check(odd_numbers, "[\n  null,\n  null,\n  0.3333333333333333\n]\n");
}

static void odd_text(bt_json* json) {
    bt_json_begin_array(json, NULL);
    bt_json_string(json, NULL, "say \"hi\" \\ \n\t\x01 \xc3\xa9");
    bt_json_end_array(json);
}

static void text_is_escaped(void** state) {
    (void)state;
    check(odd_text, "[\n  \"say \\\"hi\\\" \\\\ \\n\\u0009\\u0001 \xc3\xa9\"\n]\n");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(objects_and_arrays_nest),
        cmocka_unit_test(what_is_not_finite_is_null_and_the_rest_exact),
        cmocka_unit_test(text_is_escaped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
