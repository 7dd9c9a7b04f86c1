/// Measured curves as spreadsheets and loggers write them, and the comparison of two loops.
#include "near.h"

#include "folder.h"
#include "messages.h"
#include "report/rig_loop.h"
#include "study/measured.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

typedef struct fixture {
    char folder[FOLDER_SIZE], path[FOLDER_SIZE + 16];
    messages said;
    bt_measured* m;
} fixture;

static int setup(void** state) {
    fixture* f = calloc(1, sizeof *f);
    *state = f;
    if (folder_make(f->folder) != 0)
        return -1;
    snprintf(f->path, sizeof f->path, "%s/drop.csv", f->folder);
    return 0;
}

static int teardown(void** state) {
    fixture* f = *state;
    bt_measured_destroy(f->m);
    unlink(f->path);
    rmdir(f->folder);
    free(f);
    return 0;
}

static bt_status read_file(fixture* f, const bt_measured_columns* columns) {
    bt_diag diag = {.sink = messages_add, .user = &f->said};
    bt_measured_destroy(f->m);
    f->m = NULL;
    f->said.text[0] = '\0';
    return bt_measured_read(f->path, columns, &f->m, &diag);
}

static bt_status read_text(fixture* f, const char* text, const bt_measured_columns* columns) {
    FILE* file = fopen(f->path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    return read_file(f, columns);
}

static bt_status bind(fixture* f) {
    static const char* const names[] = {"time_s", "stroke_m", "strut_force_N"};
    bt_diag diag = {.sink = messages_add, .user = &f->said};
    return bt_measured_bind(f->m, names, 3, &diag);
}

static void assert_said(const fixture* f, const char* part) {
    if (!strstr(f->said.text, part))
        fail_msg("\"%s\" is not in: %s", part, f->said.text);
}

static const bt_measured_columns load_over_time = {
    .x_heading = "Time", .x_name = "time", .y_heading = "Load cell", .y_name = "strut_force"};

static void every_way_to_write_a_table_reads_the_same(void** state) {
    fixture* f = *state;
    static const char* const texts[] = {
        "time [s], stroke [mm]\n0, 1\n0.5, 2.5\n",
        "time (s);stroke (mm)\r\n0;1\r\n0,5;2,5\r\n",
        "time [s]\tstroke [mm]\n0\t1\n0.5\t2.5\n",
        "\xef\xbb\xbf# a logger\n\"time (s)\",\"stroke (mm)\"\n\"0\",\"1\"\n\"0.5\",\"2.5\"\n",
        "Time (s);Stroke (mm);\n0;1;\n5e-1;2,5;\n",
        "time (ms);stroke (m)\n0;1e-3\n500;0,0025\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        if (read_text(f, texts[i], NULL) != BT_OK || bind(f) != BT_OK)
            fail_msg("%s: %s", texts[i], f->said.text);
        assert_int_equal(f->m->count, 2);
        assert_true(f->m->ordered);
        BT_ASSERT_NEAR(f->m->x[1], 0.5, 1e-15, 0);
        BT_ASSERT_NEAR(f->m->y[0], 1e-3, 1e-15, 0);
        BT_ASSERT_NEAR(f->m->y[1], 2.5e-3, 1e-15, 0);
    }
}

static void columns_are_chosen_by_heading_and_time_by_offset(void** state) {
    fixture* f = *state;
    bt_measured_columns columns = load_over_time;
    columns.offset = "100 ms";
    static const char text[] = "Accel (g);Time (s);Note;Load cell (kN)\n"
                               "0,1;0,1;start;-0,25\n"
                               "0,1;0,1;;0,5\n"
                               "0,1;0,3;x;1,5\n";
    assert_int_equal(read_text(f, text, &columns), BT_OK);
    assert_int_equal(bind(f), BT_OK);
    assert_int_equal(f->m->count, 3);
    assert_true(f->m->ordered); // equal times are in order
    BT_ASSERT_NEAR(f->m->x[0], 0, 0, 1e-15);
    BT_ASSERT_NEAR(f->m->x[2], 0.2, 1e-15, 0);
    BT_ASSERT_NEAR(f->m->y[0], -250, 1e-15, 0);
    BT_ASSERT_NEAR(f->m->y[2], 1500, 1e-15, 0);
    columns.x_heading = "time (s)"; // with its unit, in any case
    assert_int_equal(read_text(f, text, &columns), BT_OK);
    assert_int_equal(bind(f), BT_OK);
}

static void what_is_missing_or_wrong_is_said_with_its_place(void** state) {
    fixture* f = *state;
    bt_measured_columns columns = load_over_time;
    columns.where = (bt_where){"d.yaml", 7, 3};
    assert_int_equal(read_text(f, "Time (s);Load (kN)\n0;1\n1;2\n", &columns), BT_ERR_INPUT);
    assert_said(f, "d.yaml:7:3: error: curve: ");
    assert_said(f, "has no column \"Load cell\"; it has Time, Load");
    assert_int_equal(read_text(f, "a [s],b [m],c [N]\n0,1,2\n", NULL), BT_ERR_INPUT);
    assert_said(f, "drop.csv:1:13: error: 3 columns (a, b, c): say which are meant");
    assert_int_equal(read_text(f, "Time (s);Load cell (kN)\n0;1\n1\n", &columns), BT_ERR_INPUT);
    assert_said(f, "drop.csv:3:2: error: the row ends before strut_force");
    assert_int_equal(read_text(f, "Time (s);Load cell (kN)\n0;1\n1;1,2,3\n", &columns),
                     BT_ERR_INPUT);
    assert_said(f, "drop.csv:3:3: error: strut_force: \"1,2,3\" is not a number");
    assert_int_equal(read_text(f, "Time (s);Load cell (kN)\n0;1\n2;2\n1;3\n", &columns), BT_OK);
    assert_int_equal(bind(f), BT_ERR_INPUT);
    assert_said(f, "drop.csv:4:1: error: time goes back");
    columns.offset = "3 mm";
    assert_int_equal(read_text(f, "Time (s);Load cell (kN)\n0;1\n2;2\n", &columns), BT_OK);
    assert_int_equal(bind(f), BT_ERR_INPUT);
    assert_said(f, "d.yaml:7:3: error: curve: offset: \"3 mm\" has a unit of another dimension");
}

static void stroke_that_goes_back_is_a_loop(void** state) {
    fixture* f = *state;
    assert_int_equal(read_text(f, "stroke [m], strut_force [N]\n0, 0\n1, 5\n0.5, 2\n", NULL),
                     BT_OK);
    assert_int_equal(bind(f), BT_OK);
    assert_false(f->m->ordered);
}

static void a_million_rows_are_read(void** state) {
    fixture* f = *state;
    FILE* file = fopen(f->path, "w");
    assert_non_null(file);
    fputs("Time (s);Load cell (kN)\n", file);
    for (int i = 0; i < 1000000; ++i)
        fprintf(file, "%d,%04d;%d\n", i / 50000, i / 5 % 10000, i);
    fclose(file);
    assert_int_equal(read_file(f, &load_over_time), BT_OK);
    assert_int_equal(f->m->count, 1000000);
    assert_int_equal(bind(f), BT_OK);
    BT_ASSERT_NEAR(f->m->x[999999], 19.9999, 1e-15, 0);
    BT_ASSERT_NEAR(f->m->y[999999], 999999e3, 1e-15, 0);
}

// --- loops ----------------------------------------------------------------------------------

enum { HALF = 500 };

/// Load over stroke: in along F = k s to s = 1, out along half of it.
static double loop_stroke(int i) {
    return i <= HALF ? (double)i / HALF : 2 - (double)i / HALF;
}

static double loop_force(int i, double stiffness) {
    return (i <= HALF ? 1 : 0.5) * stiffness * loop_stroke(i);
}

static void fill_record(bt_rig_record* record, double stiffness) {
    bt_rig_record_start(record, BT_RIG_NOSE_DROP);
    record->count = 2 * HALF + 1;
    for (int c = 0; c < record->column_count; ++c) {
        record->columns[c] = calloc((size_t)record->count, sizeof(double));
        for (int i = 0; i < record->count; ++i)
            record->columns[c][i] = strcmp(record->names[c], "stroke_m") == 0 ? loop_stroke(i)
                                    : strcmp(record->names[c], "strut_force_N") == 0
                                        ? loop_force(i, stiffness)
                                        : 0;
    }
}

static int column_of(const bt_rig_record* record, const char* name) {
    int c = 0;
    while (strcmp(record->names[c], name) != 0)
        ++c;
    return c;
}

/// The area between loops of stiffness k and 1.1 k is 0.1 (k/2 + k/4), the measured work k/2; the
/// first step of the way out, which falls from k to k/2, adds 0.1 (k/2) / 2 / HALF.
static void area_between_loops_is_that_of_the_triangles(void** state) {
    (void)state;
    static double stroke[2 * HALF + 1], force[2 * HALF + 1];
    static const double stiffness[] = {1000, 1100}, wanted[] = {0, 0.15 + 0.05 / HALF};
    for (int k = 0; k < 2; ++k) {
        bt_rig_record record;
        bt_loop_score score;
        fill_record(&record, stiffness[k]);
        for (int i = 0; i < record.count; ++i) {
            stroke[i] = loop_stroke(i);
            force[i] = loop_force(i, 1000);
        }
        bt_measured m = {.count = record.count, .x = stroke, .y = force};
        m.x_column = column_of(&record, "stroke_m");
        m.y_column = column_of(&record, "strut_force_N");
        bt_measured* const curves[] = {&m};
        assert_true(bt_rig_loop_score(&record, curves, 1, &score));
        BT_ASSERT_NEAR(score.area_share, wanted[k], 1e-9, 1e-12);
        BT_ASSERT_NEAR(score.measured.energy_J, 500, 1e-12, 0);
        BT_ASSERT_NEAR(score.computed.energy_J, stiffness[k] / 2, 1e-12, 0);
        BT_ASSERT_NEAR(score.computed.efficiency, 0.5, 1e-12, 0);
        BT_ASSERT_NEAR(score.measured.stroke_max_m, 1, 1e-15, 0);
        m.x_column = column_of(&record, "sinkage_m"); // no load over stroke
        assert_false(bt_rig_loop_score(&record, curves, 1, &score));
        bt_rig_record_destroy(&record);
    }
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(every_way_to_write_a_table_reads_the_same),
        TEST(columns_are_chosen_by_heading_and_time_by_offset),
        TEST(what_is_missing_or_wrong_is_said_with_its_place),
        TEST(stroke_that_goes_back_is_a_loop),
        TEST(a_million_rows_are_read),
        cmocka_unit_test(area_between_loops_is_that_of_the_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
