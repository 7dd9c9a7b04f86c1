#include "near.h"

#include "base/fields.h"

#include <stdio.h>

// a table with every kind of row
static const char* const colour_names[] = {"red", "green", NULL};

// clang-format off
#define BT_PART_FIELDS(F)                                                                          \
    F(REAL, length, m, REQUIRED, 2, 0.5, 3, "Eq. 1", "L: length")                                  \
    F(PLAIN, ratio, _, OPTIONAL, 0.5, 0, 1, "", "ratio [assumed]")
BT_DECLARE_GROUP(part, BT_PART_FIELDS)

#define BT_WHOLE_FIELDS(F)                                                                         \
    F(COUNT, number, _, OPTIONAL, 4, 1, 10, "", "number")                                          \
    F(FLAG, on, _, OPTIONAL, 1, 0, 1, "", "switch")                                                \
    F(CHOICE, colour, colour_names, OPTIONAL, 1, 0, 0, "", "colour")                               \
    F(LIST, widths, m, OPTIONAL, 0, 0, 5, "", "widths")                                            \
    F(TABLE, curve, m__m2, OPTIONAL, 0, 0, 0, "", "curve")                                         \
    F(GROUP, left, part, REQUIRED, 0, 0, 0, "", "left part")                                       \
    F(GROUP, right, part, REQUIRED, 0, 0, 0, "", "right part")
BT_DECLARE_GROUP(whole, BT_WHOLE_FIELDS)

#define ROW(kind, name, ...) BT_ROW_##kind(bt_part_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(part, BT_PART_FIELDS, ROW, NULL, "a part")
#undef ROW
// clang-format on

static void check_whole(const void* params, const char* path, bt_diag* diag) {
    const bt_whole_params* p = params;
    if (p->left.length_m > p->right.length_m)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s.left.length: longer than the right one", path);
}

#define ROW(kind, name, ...) BT_ROW_##kind(bt_whole_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(whole, BT_WHOLE_FIELDS, ROW, check_whole, "a whole")
#undef ROW

// a variant of two types that share a key at different places

// clang-format off
#define BT_ROUND_FIELDS(F)                                                                         \
    F(REAL, radius, m, REQUIRED, 1, 0.5, 3, "", "radius")
BT_DECLARE_GROUP(round, BT_ROUND_FIELDS)
#define BT_OBLONG_FIELDS(F)                                                                        \
    F(REAL, length, m, REQUIRED, 2, 0.5, 3, "", "length")                                          \
    F(REAL, radius, m, OPTIONAL, 0.25, 0, 3, "", "radius of the corners")
BT_DECLARE_GROUP(oblong, BT_OBLONG_FIELDS)
#define ROW(kind, name, ...) BT_ROW_##kind(bt_round_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(round, BT_ROUND_FIELDS, ROW, NULL, "round")
#undef ROW
#define ROW(kind, name, ...) BT_ROW_##kind(bt_oblong_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(oblong, BT_OBLONG_FIELDS, ROW, NULL, "oblong")
#undef ROW
// clang-format on

BT_DECLARE_VARIANT(shape, 64)
static const bt_group* const shape_groups[] = {&bt_round_group, &bt_oblong_group};
static const char* const shape_names[] = {"round", "oblong", NULL};
const bt_variant bt_shape_types = BT_VARIANT(shape_groups, shape_names, 64, "kind of shape");

// clang-format off
#define BT_PLATE_FIELDS(F)                                                                         \
    F(VARIANT, shape, shape, REQUIRED, 0, 0, 0, "", "its outline")                                 \
    F(REAL, thickness, m, REQUIRED, 0.1, 0.01, 1, "", "thickness")
BT_DECLARE_GROUP(plate, BT_PLATE_FIELDS)
#define ROW(kind, name, ...) BT_ROW_##kind(bt_plate_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(plate, BT_PLATE_FIELDS, ROW, NULL, "a plate")
#undef ROW
// clang-format on

typedef struct messages {
    char text[2048];
} messages;

static void collect(void* user, bt_severity severity, bt_where where, const char* text) {
    (void)severity, (void)where;
    messages* m = user;
    strncat(m->text, text, sizeof m->text - strlen(m->text) - 1);
    strncat(m->text, "\n", sizeof m->text - strlen(m->text) - 1);
}

static bt_whole_params defaults(void) {
    bt_whole_params p;
    memset(&p, 0xff, sizeof p);
    bt_group_set_defaults(&bt_whole_group, &p);
    return p;
}

static void assert_check_says(const bt_whole_params* p, const char* want) {
    messages m = {""};
    bt_diag diag = {.sink = collect, .user = &m};
    assert_int_equal(bt_group_check(&bt_whole_group, p, "w", &diag), *want ? BT_ERR_INPUT : BT_OK);
    assert_string_equal(m.text, want);
    assert_int_equal(diag.errors > 0, *want != '\0');
}

static void defaults_come_from_the_table(void** state) {
    (void)state;
    const bt_whole_params p = defaults();
    assert_true(p.number == 4 && p.on && p.colour == 1 && p.widths.count == 0);
    assert_true(p.curve.count == 0 && p.left.length_m == 2 && p.right.ratio == 0.5);
    assert_check_says(&p, "");
}

static void a_value_outside_its_range_is_named_with_the_range(void** state) {
    (void)state;
    bt_whole_params p = defaults();
    p.number = 11;
    p.right.length_m = 0.25;
    p.left.ratio = NAN;
    p.colour = 2;
    p.widths.count = 2;
    p.widths.value[1] = 6;
    assert_check_says(&p, "w.number: 11 is outside 1 .. 10\n"
                          "w.colour: choice 2 is outside 0 .. 1\n"
                          "w.widths: 6 is outside 0 .. 5 m\n"
                          "w.left.ratio: nan is outside 0 .. 1\n"
                          "w.right.length: 0.25 is outside 0.5 .. 3 m\n");
}

static void every_value_may_be_nan_and_none_passes(void** state) {
    (void)state;
    static const char* const paths[] = {"left.length", "left.ratio", "right.length", "right.ratio"};
    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; ++i) {
        bt_whole_params p = defaults();
        size_t offset;
        const bt_field* field = bt_group_find(&bt_whole_group, paths[i], &offset);
        bt_field_set(field, &p, offset, NAN);
        assert_int_equal(bt_group_check(&bt_whole_group, &p, "w", NULL), BT_ERR_INPUT);
    }
}

static void a_groups_own_check_runs_once_the_ranges_hold(void** state) {
    (void)state;
    bt_whole_params p = defaults();
    p.left.length_m = 2.5;
    assert_check_says(&p, "w.left.length: longer than the right one\n");
    assert_int_equal(bt_group_check(&bt_whole_group, &p, "w", NULL), BT_ERR_INPUT);
    p.number = 0;
    assert_check_says(&p, "w.number: 0 is outside 1 .. 10\n");
}

static void fields_are_found_by_path(void** state) {
    (void)state;
    size_t offset = 0;
    const bt_field* f = bt_group_find(&bt_whole_group, "right.length", &offset);
    assert_non_null(f);
    assert_string_equal(f->unit, "m");
    assert_int_equal(offset, offsetof(bt_whole_params, right.length_m));
    bt_whole_params p = defaults();
    bt_field_set(f, &p, offset, 2.75);
    assert_true(p.right.length_m == 2.75 && bt_field_get(f, &p, offset) == 2.75);
    f = bt_group_find(&bt_whole_group, "number", &offset);
    bt_field_set(f, &p, offset, 7);
    assert_true(p.number == 7 && bt_field_get(f, &p, offset) == 7);
    assert_int_equal(bt_group_find(&bt_whole_group, "left", NULL)->kind, BT_FIELD_GROUP);
    static const char* const none[] = {"",         "lef",  "leftt", "left.", "left.length.x",
                                       "number.x", ".left"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; ++i)
        assert_null(bt_group_find(&bt_whole_group, none[i], NULL));
}

static bool append_path(void* user, const bt_field* field, const char* path, size_t offset) {
    size_t found;
    assert_ptr_equal(bt_group_find(&bt_whole_group, path, &found), field);
    assert_int_equal(found, offset);
    char* text = user;
    strcat(text, path);
    strcat(text, " ");
    return strcmp(path, "left.ratio") != 0;
}

static void a_walk_meets_leaves_in_table_order_and_stops_when_told(void** state) {
    (void)state;
    char text[512] = "";
    bt_group_walk(&bt_whole_group, append_path, text);
    assert_string_equal(text, "number on colour widths curve left.length left.ratio ");
}

static bt_plate_params plate(int type) {
    bt_plate_params p;
    memset(&p, 0xff, sizeof p);
    bt_group_set_defaults(&bt_plate_group, &p);
    assert_int_equal(p.shape.type, 0);
    bt_variant_set(&bt_shape_types, type, (void*)&p.shape);
    return p;
}

static void a_variant_has_the_defaults_of_its_type(void** state) {
    (void)state;
    const bt_plate_params first = plate(0), second = plate(1);
    assert_true(((const bt_round_params*)(const void*)first.shape.params)->radius_m == 1);
    const bt_oblong_params* oblong = (const void*)second.shape.params;
    assert_true(oblong->length_m == 2 && oblong->radius_m == 0.25);
    assert_true(second.thickness_m == 0.1);
    assert_ptr_equal(bt_variant_group(&bt_shape_types, (const void*)&second.shape),
                     &bt_oblong_group);
}

/// The same path is another place for another type; without parameters the first type's.
static void a_variants_fields_are_found_by_its_type(void** state) {
    (void)state;
    bt_plate_params p = plate(1);
    size_t offset = 0, of_first = 0;
    const bt_field* f = bt_params_find(&bt_plate_group, &p, "shape.radius", &offset);
    assert_ptr_equal(f, &bt_oblong_group.fields[1]);
    bt_field_set(f, &p, offset, 0.75);
    assert_true(((const bt_oblong_params*)(const void*)p.shape.params)->radius_m == 0.75);
    assert_ptr_equal(bt_group_find(&bt_plate_group, "shape.radius", &of_first),
                     &bt_round_group.fields[0]);
    assert_int_equal(of_first + offsetof(bt_oblong_params, radius_m), offset);
    assert_non_null(bt_params_find(&bt_plate_group, &p, "shape.length", NULL));
    assert_null(bt_group_find(&bt_plate_group, "shape.length", NULL));
    f = bt_group_find(&bt_plate_group, "shape.type", &offset);
    assert_int_equal(f->kind, BT_FIELD_CHOICE);
    assert_int_equal(*(const int*)(const void*)((const char*)&p + offset), 1);
    assert_int_equal(bt_group_find(&bt_plate_group, "shape", NULL)->kind, BT_FIELD_VARIANT);
    assert_null(bt_group_find(&bt_plate_group, "shape.type.x", NULL));
    assert_null(bt_group_find(&bt_plate_group, "shape.", NULL));
}

static bool append_any_path(void* user, const bt_field* field, const char* path, size_t offset) {
    (void)field, (void)offset;
    strcat(user, path);
    strcat(user, " ");
    return true;
}

static void a_walk_meets_the_type_and_the_fields_of_it(void** state) {
    (void)state;
    const bt_plate_params p = plate(1);
    char text[512] = "";
    bt_params_walk(&bt_plate_group, &p, append_any_path, text);
    assert_string_equal(text, "shape.type shape.length shape.radius thickness ");
    *text = '\0';
    bt_group_walk(&bt_plate_group, append_any_path, text);
    assert_string_equal(text, "shape.type shape.radius thickness ");
}

static void a_variant_is_checked_by_the_table_of_its_type(void** state) {
    (void)state;
    bt_plate_params p = plate(1);
    messages m = {""};
    bt_diag diag = {.sink = collect, .user = &m};
    assert_int_equal(bt_group_check(&bt_plate_group, &p, "", &diag), BT_OK);
    ((bt_oblong_params*)(void*)p.shape.params)->length_m = NAN;
    assert_int_equal(bt_group_check(&bt_plate_group, &p, "", &diag), BT_ERR_INPUT);
    p.shape.type = 2;
    assert_int_equal(bt_group_check(&bt_plate_group, &p, "", &diag), BT_ERR_INPUT);
    assert_string_equal(m.text, "shape.length: nan is outside 0.5 .. 3 m\n"
                                "shape.type: choice 2 is outside 0 .. 1\n");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_come_from_the_table),
        cmocka_unit_test(a_value_outside_its_range_is_named_with_the_range),
        cmocka_unit_test(every_value_may_be_nan_and_none_passes),
        cmocka_unit_test(a_groups_own_check_runs_once_the_ranges_hold),
        cmocka_unit_test(fields_are_found_by_path),
        cmocka_unit_test(a_walk_meets_leaves_in_table_order_and_stops_when_told),
        cmocka_unit_test(a_variant_has_the_defaults_of_its_type),
        cmocka_unit_test(a_variants_fields_are_found_by_its_type),
        cmocka_unit_test(a_walk_meets_the_type_and_the_fields_of_it),
        cmocka_unit_test(a_variant_is_checked_by_the_table_of_its_type),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
