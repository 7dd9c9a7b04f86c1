// The typed reader on a small table of its own: every kind of value, every message with its place.
#include "near.h"

#include "messages.h"
#include "study/reader.h"

#include <stdlib.h>

static const char* const colour_names[] = {"red", "green", "blue", NULL};

// clang-format off
#define BT_PART_FIELDS(F)                                                                          \
    F(REAL, length, m, REQUIRED, 2, 0.5, 3, "", "length of the part")                              \
    F(PLAIN, ratio, _, OPTIONAL, 0.5, 0, 1, "", "ratio")
BT_DECLARE_GROUP(part, BT_PART_FIELDS)

#define BT_WHOLE_FIELDS(F)                                                                         \
    F(REAL, tilt, rad, OPTIONAL, 0, -1, 1, "", "tilt")                                             \
    F(COUNT, number, _, OPTIONAL, 4, 1, 10, "", "number")                                          \
    F(FLAG, on, _, OPTIONAL, 1, 0, 1, "", "switch")                                                \
    F(CHOICE, colour, colour_names, OPTIONAL, 1, 0, 0, "", "colour")                               \
    F(LIST, widths, m, OPTIONAL, 0, 0, 5, "", "widths")                                            \
    F(LIST, weights, 1, OPTIONAL, 0, 0, 0, "", "weights")                                          \
    F(TABLE, curve, m__m2, OPTIONAL, 0, 0, 0, "", "curve")                                         \
    F(GROUP, left, part, REQUIRED, 0, 0, 0, "", "the left part")                                   \
    F(GROUP, right, part, OPTIONAL, 0, 0, 0, "", "the right part")
BT_DECLARE_GROUP(whole, BT_WHOLE_FIELDS)
// clang-format on

#define ROW(kind, name, ...) BT_ROW_##kind(bt_part_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(part, BT_PART_FIELDS, ROW, NULL, "a part")
#undef ROW

static void check_whole(const void* params, const char* path, bt_diag* diag) {
    const bt_whole_params* p = params;
    if (p->left.length_m > p->right.length_m)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s.left.length: longer than the right one", path);
    if (p->number == 9)
        bt_diag_add(diag, BT_WARNING, BT_NOWHERE, "%s.number: nine is much", path);
    if (p->number == 8)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s.right.ratio: eight is too many", path);
}

#define ROW(kind, name, ...) BT_ROW_##kind(bt_whole_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(whole, BT_WHOLE_FIELDS, ROW, check_whole, "a whole")
#undef ROW

/// Reads a text; gives the messages.
static bt_whole_params read(const char* text, size_t size, messages* m) {
    *m = (messages){""};
    bt_whole_params params;
    bt_group_set_defaults(&bt_whole_group, &params);
    bt_reader reader = {0};
    bt_document document = {0};
    bt_diag collected = bt_reader_diag(&reader);
    bt_node* root;
    const bt_status status =
        bt_document_parse(&document, text, size, (bt_where){"a.yaml", 1, 1}, &root, &collected);
    if (status == BT_OK && root)
        bt_reader_group(&reader, &bt_whole_group, &params, "w", root, NULL);
    const int errors = reader.errors;
    bt_diag diag = {.sink = messages_add, .user = m};
    bt_reader_flush(&reader, &diag);
    assert_int_equal(diag.errors, errors);
    bt_document_destroy(&document);
    return params;
}

static void assert_says(const char* text, const char* want) {
    messages m;
    read(text, strlen(text), &m);
    assert_string_equal(m.text, want);
}

/// A complete text with one line of its own in line 1.
static void assert_line_says(const char* line, const char* want) {
    char text[4096];
    snprintf(text, sizeof text, "%s\nleft: {length: 1 m}\n", line);
    assert_says(text, want);
}

static void every_kind_of_value_is_read(void** state) {
    (void)state;
    const char* text = "tilt: 45 deg\n"
                       "number: 7\n"
                       "on: false\n"
                       "colour: blue\n"
                       "widths: [1 m, 20 cm, \"3 m\"]\n"
                       "weights: [0.1, 1e6]\n"
                       "curve:\n"
                       "  - [0 mm, 375 mm^2]\n"
                       "  - [90 mm, 3 cm^2]\n"
                       "left: {length: 80 cm, ratio: 0.25}\n";
    messages m;
    const bt_whole_params p = read(text, strlen(text), &m);
    assert_string_equal(m.text, "");
    assert_true(p.tilt_rad == M_PI / 4 && p.number == 7 && !p.on && p.colour == 2);
    assert_true(p.widths.count == 3 && p.widths.value[1] == 0.2 && p.widths.value[2] == 3);
    assert_true(p.weights.count == 2 && p.weights.value[1] == 1e6);
    assert_true(p.curve.count == 2 && p.curve.x[1] == 0.09 && p.curve.y[0] == 375e-6);
    assert_true(p.curve.y[1] == 3e-4);
    assert_true(p.left.length_m == 0.8 && p.left.ratio == 0.25);
    assert_true(p.right.length_m == 2 && p.right.ratio == 0.5); // optional: defaults
}

static void json_is_yaml(void** state) {
    (void)state;
    assert_says("{\"number\": 3, \"left\": {\"length\": \"1 m\"}}", "");
}

static void a_byte_order_mark_and_windows_lines_are_no_mistake(void** state) {
    (void)state;
    assert_says("\xef\xbb\xbfnumber: 3\r\nleft: {length: 1 m}\r\n", "");
    assert_says("\xef\xbb\xbfnumbr: 3\r\nleft: {length: 1 m}\r\n",
                "a.yaml:1:1: error: w.numbr: unknown key; did you mean \"number\"?\n");
}

static void unknown_keys_get_the_nearest_right_one(void** state) {
    (void)state;
    assert_line_says("tlit: 1 deg",
                     "a.yaml:1:1: error: w.tlit: unknown key; did you mean \"tilt\"?\n");
    assert_line_says("zzzzzz: 1 deg",
                     "a.yaml:1:1: error: w.zzzzzz: unknown key; known here: tilt, number, on, "
                     "colour, widths, weights, curve, left, right\n");
    assert_line_says("<<: {number: 3}", // no merge keys either
                     "a.yaml:1:1: error: w.<<: unknown key; known here: tilt, number, on, "
                     "colour, widths, weights, curve, left, right\n");
}

static void a_misspelt_key_is_one_error_not_two(void** state) {
    (void)state;
    assert_says("left: {lenght: 1 m}\n",
                "a.yaml:1:8: error: w.left.lenght: unknown key; did you mean \"length\"?\n");
}

static void keys_given_twice(void** state) {
    (void)state;
    assert_says("number: 3\nleft: {length: 1 m}\nnumber: 4\n",
                "a.yaml:3:1: error: w.number: given twice; first in line 1\n");
    assert_says("left:\n  length: 1 m\n  length: 2 m\n",
                "a.yaml:3:3: error: w.left.length: given twice; first in line 2\n");
}

static void missing_keys_and_groups(void** state) {
    (void)state;
    assert_says("number: 3\n", "a.yaml:1:1: error: w.left: missing; wanted: the left part\n");
    assert_says("number: 3\nleft: {ratio: 1}\n", "a.yaml:2:1: error: w.left.length: missing; "
                                                 "wanted: length of the part, in m\n");
    // an optional group that is there must be complete
    assert_line_says("right: {}", "a.yaml:1:1: error: w.right.length: missing; wanted: length of "
                                  "the part, in m\n");
}

static void wrong_dimension_and_missing_unit(void** state) {
    (void)state;
    assert_line_says("tilt: 3 m", "a.yaml:1:7: error: w.tilt: \"3 m\" has a unit of another "
                                  "dimension; use deg, rad or mrad\n");
    assert_line_says("tilt: 0.3",
                     "a.yaml:1:7: error: w.tilt: \"0.3\" has no unit; use deg, rad or mrad\n");
    assert_line_says("tilt: 3 grad", "a.yaml:1:7: error: w.tilt: \"3 grad\" has no known unit; "
                                     "use deg, rad or mrad\n");
    assert_line_says("tilt: 3,6 deg",
                     "a.yaml:1:7: error: w.tilt: \"3,6 deg\" is not a number: write the decimal "
                     "point as \".\"; use deg, rad or mrad\n");
    assert_says("left: {length: 1 m, ratio: 0.5 m}\n",
                "a.yaml:1:28: error: w.left.ratio: \"0.5 m\" is wanted without a unit; use a "
                "plain number\n");
}

static void values_that_are_not_finite(void** state) {
    (void)state;
    assert_line_says("tilt: 1e999 deg", "a.yaml:1:7: error: w.tilt: \"1e999 deg\" is not a finite "
                                        "number; use deg, rad or mrad\n");
    assert_line_says("tilt: .nan", "a.yaml:1:7: error: w.tilt: \".nan\" is not a finite number; "
                                   "use deg, rad or mrad\n");
    assert_line_says("weights: [1, inf]",
                     "a.yaml:1:14: error: w.weights: \"inf\" is not a finite number; use a plain "
                     "number\n");
}

static void values_out_of_range_in_the_unit_typed(void** state) {
    (void)state;
    assert_line_says("tilt: 90 deg",
                     "a.yaml:1:7: error: w.tilt: 90 deg is outside -57.2958 .. 57.2958 deg\n");
    assert_line_says("number: 11", "a.yaml:1:9: error: w.number: 11 is outside 1 .. 10\n");
    assert_line_says("widths: [1 m, 600 cm]",
                     "a.yaml:1:15: error: w.widths: 600 cm is outside 0 .. 500 cm\n");
    assert_says("left: {length: 400 mm, ratio: -1}\n",
                "a.yaml:1:16: error: w.left.length: 400 mm is outside 500 .. 3000 mm\n"
                "a.yaml:1:31: error: w.left.ratio: -1 is outside 0 .. 1\n");
}

static void wrong_kinds_of_node(void** state) {
    (void)state;
    assert_line_says("tilt: [1 deg]",
                     "a.yaml:1:7: error: w.tilt: a value is wanted here, not a sequence\n");
    assert_line_says("number: {a: 1}",
                     "a.yaml:1:9: error: w.number: a whole number is wanted here, not a mapping\n");
    assert_line_says("on: []",
                     "a.yaml:1:5: error: w.on: true or false is wanted here, not a sequence\n");
    assert_line_says("colour: {}",
                     "a.yaml:1:9: error: w.colour: a name is wanted here, not a mapping\n");
    assert_line_says("widths: 1 m", "a.yaml:1:9: error: w.widths: a sequence is wanted here, not a "
                                    "value, as in [1, 2, 5]\n");
    assert_line_says("curve: 300 mm^2",
                     "a.yaml:1:8: error: w.curve: a sequence of rows is wanted here, not a value, "
                     "as in [1 m, 2 m^2]\n");
    assert_line_says("curve: [1 m, 2 m^2]",
                     "a.yaml:1:9: error: w.curve: a row of two values is wanted here, not a value, "
                     "as in [1 m, 2 m^2]\n"
                     "a.yaml:1:14: error: w.curve: a row of two values is wanted here, not a "
                     "value, as in [1 m, 2 m^2]\n");
    assert_line_says("curve: [[1 m]]", "a.yaml:1:9: error: w.curve: a row has two values, as in "
                                       "[1 m, 2 m^2]; this has 1\n");
    assert_says("left: 1 m\n",
                "a.yaml:1:7: error: w.left: a mapping of keys is wanted here, not a value\n");
    assert_says("left:\n",
                "a.yaml:1:6: error: w.left: a mapping of keys is wanted here, not nothing\n");
    assert_says("[1, 2]\n",
                "a.yaml:1:1: error: w: a mapping of keys is wanted here, not a sequence\n");
}

static void values_of_the_wrong_form(void** state) {
    (void)state;
    assert_line_says("number: 2.5", "a.yaml:1:9: error: w.number: \"2.5\" is not a whole number; "
                                    "write it as 42000\n");
    assert_line_says("number: 42,000",
                     "a.yaml:1:9: error: w.number: \"42,000\" is not a whole number; write it as "
                     "42000\n");
    assert_line_says("number:", "a.yaml:1:8: error: w.number: \"\" is not a whole number; write it "
                                "as 42000\n");
    assert_line_says("on: yes", "a.yaml:1:5: error: w.on: \"yes\" is neither true nor false\n");
    assert_line_says("colour: gren",
                     "a.yaml:1:9: error: w.colour: \"gren\" is none of red, green, blue; did you "
                     "mean \"green\"?\n");
    assert_line_says("colour: 7", "a.yaml:1:9: error: w.colour: \"7\" is none of red, green, "
                                  "blue\n");
    assert_line_says("tilt:", "a.yaml:1:6: error: w.tilt: \"\" is not a number; use deg, rad or "
                              "mrad\n");
}

static void control_characters_do_not_reach_the_message(void** state) {
    (void)state;
    assert_line_says("colour: \"a\\nb\"",
                     "a.yaml:1:9: error: w.colour: \"a?b\" is none of red, green, blue\n");
}

static void lists_have_a_greatest_length(void** state) {
    (void)state;
    char line[512] = "weights: [1";
    for (int i = 1; i < BT_LIST_MAX + 1; ++i)
        strcat(line, ",1");
    strcat(line, "]");
    assert_line_says(line, "a.yaml:1:10: error: w.weights: 33 entries; at most 32 are possible\n");
}

static void anchors_aliases_and_tags_are_refused(void** state) {
    (void)state;
    assert_says("left: &a {length: 1 m}\nright: *a\n",
                "a.yaml:1:7: error: anchors (&a) are not accepted; write the value where it is "
                "needed\n"
                "a.yaml:2:8: error: aliases (*a) are not accepted; write the value where it is "
                "needed\n");
    assert_line_says("number: !!int 3", "a.yaml:1:9: error: tags (tag:yaml.org,2002:int) are not "
                                        "accepted; the key decides what its value is\n");
}

static void broken_yaml_is_placed(void** state) {
    (void)state;
    assert_says("left: {length: 1 m\nnumber: 3\n",
                "a.yaml:2:7: error: not valid YAML: did not find expected ',' or '}' while parsing "
                "a flow mapping\n");
    assert_says("left:\n\tlength: 1 m\n",
                "a.yaml:2:1: error: not valid YAML: found character that cannot start any token "
                "while scanning for the next token; indent with blanks, not tabs\n");
    assert_says("number: 3\n---\nnumber: 3\n",
                "a.yaml:2:1: error: one document per file; a second begins here\n");
    assert_says("? [a, b]\n: 1\n", "a.yaml:1:3: error: a key must be a plain text\n");
    assert_says("number: \xff\n",
                "a.yaml: error: not a text in UTF-8: invalid leading UTF-8 octet at byte 8\n");
    assert_line_says("number: \"3\\0\"", "a.yaml:1:9: error: a value contains a zero byte\n");
    messages m;
    read("number: 3\0", 10, &m);
    assert_string_equal(m.text,
                        "a.yaml: error: not a text in UTF-8: control characters are not allowed at "
                        "byte 9\n");
}

static void size_and_depth_are_bounded(void** state) {
    (void)state;
    char* text = malloc(BT_DOCUMENT_SIZE_MAX + 2);
    assert_non_null(text);
    memset(text, ' ', BT_DOCUMENT_SIZE_MAX + 1);
    messages m;
    read(text, BT_DOCUMENT_SIZE_MAX + 1, &m);
    assert_string_equal(m.text, "a.yaml: error: larger than 1048576 bytes\n");
    read(text, BT_DOCUMENT_SIZE_MAX, &m); // nothing but blanks
    assert_string_equal(m.text, "");

    char deep[64] = "";
    for (int i = 0; i < BT_DOCUMENT_DEPTH_MAX + 1; ++i)
        strcat(deep, "[");
    assert_says(deep, "a.yaml:1:17: error: nested deeper than any study needs\n");

    strcpy(text, "widths: [");
    for (int i = 0; i < 10001; ++i)
        memcpy(text + 9 + 2 * i, "1,", 3);
    assert_says(text, "a.yaml:1:20010: error: more than 10000 entries in one place\n");

    // 40 mappings of 600 keys each: 48,000 nodes
    char* end = text;
    for (int k = 0; k < 40; ++k) {
        end += sprintf(end, "k%d: {", k);
        for (int i = 0; i < 600; ++i)
            end += sprintf(end, "a%d: 1, ", i);
        end += sprintf(end, "}\n");
    }
    read(text, (size_t)(end - text), &m);
    assert_non_null(strstr(m.text, ": error: too many values for a study\n"));
    free(text);
}

static void errors_come_in_the_order_of_the_file(void** state) {
    (void)state;
    assert_says("colour: pink\nleft: {length: 7 m}\nnumber: x\ntilt: 1\n",
                "a.yaml:1:9: error: w.colour: \"pink\" is none of red, green, blue\n"
                "a.yaml:2:16: error: w.left.length: 7 m is outside 0.5 .. 3 m\n"
                "a.yaml:3:9: error: w.number: \"x\" is not a whole number; write it as 42000\n"
                "a.yaml:4:7: error: w.tilt: \"1\" has no unit; use deg, rad or mrad\n");
}

static void twenty_errors_are_shown_and_the_rest_counted(void** state) {
    (void)state;
    char text[2048] = "left: {length: 1 m}\n";
    for (int i = 0; i < 23; ++i)
        sprintf(text + strlen(text), "%c%c: 1\n", 'q' + i % 5, 'A' + i);
    messages m;
    read(text, strlen(text), &m);
    int lines = 0;
    for (const char* c = m.text; *c; ++c)
        lines += *c == '\n';
    assert_int_equal(lines, 21);
    assert_non_null(strstr(m.text, "\nnote: 3 more errors are not shown\n"));
}

static void a_groups_own_check_is_placed_where_its_path_points(void** state) {
    (void)state;
    assert_says("number: 3\nleft:\n  length: 3 m\n",
                "a.yaml:3:11: error: w.left.length: longer than the right one\n");
    // the key is not in the file: the nearest thing that is
    assert_says("left: {length: 1 m}\nnumber: 8\nright: {length: 2 m}\n",
                "a.yaml:3:8: error: w.right.ratio: eight is too many\n");
    assert_line_says("number: 9", "a.yaml:1:9: warning: w.number: nine is much\n");
}

static void a_groups_own_check_waits_until_its_values_are_sound(void** state) {
    (void)state;
    assert_says("tilt: 7\nleft:\n  length: 3 m\n",
                "a.yaml:1:7: error: w.tilt: \"7\" has no unit; use deg, rad or mrad\n");
}

static void any_text_is_read_or_refused(void** state) {
    (void)state;
    static const char letters[] = "abcleft length number tilt 123 m deg[]{}:,-&*!|>'\"%@?#\n\n  ";
    unsigned seed = 5;
    for (int i = 0; i < 20000; ++i) {
        char text[80];
        const int length = rand_r(&seed) % (int)sizeof text;
        for (int k = 0; k < length; ++k)
            text[k] = letters[rand_r(&seed) % (int)(sizeof letters - 1)];
        messages m;
        const bt_whole_params p = read(text, (size_t)length, &m);
        assert_true(p.left.length_m >= 0.5 && p.left.length_m <= 3);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_value_is_read),
        cmocka_unit_test(json_is_yaml),
        cmocka_unit_test(a_byte_order_mark_and_windows_lines_are_no_mistake),
        cmocka_unit_test(unknown_keys_get_the_nearest_right_one),
        cmocka_unit_test(a_misspelt_key_is_one_error_not_two),
        cmocka_unit_test(keys_given_twice),
        cmocka_unit_test(missing_keys_and_groups),
        cmocka_unit_test(wrong_dimension_and_missing_unit),
        cmocka_unit_test(values_that_are_not_finite),
        cmocka_unit_test(values_out_of_range_in_the_unit_typed),
        cmocka_unit_test(wrong_kinds_of_node),
        cmocka_unit_test(values_of_the_wrong_form),
        cmocka_unit_test(control_characters_do_not_reach_the_message),
        cmocka_unit_test(lists_have_a_greatest_length),
        cmocka_unit_test(anchors_aliases_and_tags_are_refused),
        cmocka_unit_test(broken_yaml_is_placed),
        cmocka_unit_test(size_and_depth_are_bounded),
        cmocka_unit_test(errors_come_in_the_order_of_the_file),
        cmocka_unit_test(twenty_errors_are_shown_and_the_rest_counted),
        cmocka_unit_test(a_groups_own_check_is_placed_where_its_path_points),
        cmocka_unit_test(a_groups_own_check_waits_until_its_values_are_sound),
        cmocka_unit_test(any_text_is_read_or_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
