/// The HDF5 file of one landing of the reference study, read back.
#define _GNU_SOURCE
#include "near.h"

#include "base/units.h"
#include "report/history.h"
#include "toy_study.h"

#include <hdf5.h>

typedef struct fixture {
    char* directory;
    char csv[4096];
    bt_study study;
    bt_landing_result result;
    hid_t file;
} fixture;

static int setup(void** state) {
    fixture* f = calloc(1, sizeof *f);
    char path[4096];
    bt_lander* lander = NULL;
    bt_history* history = NULL;
    f->directory = toy_directory();
    toy_path(path, f->directory, "landing.h5");
    static const char* const sets[] = {"landing.sink_speed=5 m/s", "landing.distance=12 m"};
    if (bt_study_read("studies/reference/study.yaml", sets, 2, &f->study, NULL) != BT_OK ||
        bt_lander_create(&lander) != BT_OK || bt_history_create(&history) != BT_OK ||
        bt_lander_run(lander, &f->study.model, &f->result, bt_history_observe, history, NULL) !=
            BT_OK ||
        bt_history_write(history, path, &f->study, &f->result, NULL) != BT_OK ||
        bt_history_write(history, toy_path(f->csv, f->directory, "landing.csv"), &f->study,
                         &f->result, NULL) != BT_OK)
        return -1;
    bt_history_destroy(history);
    bt_lander_destroy(lander);
    f->file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    *state = f;
    return f->file < 0;
}

static int teardown(void** state) {
    fixture* f = *state;
    H5Fclose(f->file);
    toy_directory_remove(f->directory);
    bt_study_destroy(&f->study);
    free(f);
    return 0;
}

/// A dataset as numbers (to be freed), its shape in rows and columns.
static double* dataset(const fixture* f, const char* name, hsize_t shape[2]) {
    const hid_t set = H5Dopen2(f->file, name, H5P_DEFAULT);
    assert_true(set >= 0);
    const hid_t space = H5Dget_space(set);
    shape[1] = 1;
    assert_in_range(H5Sget_simple_extent_ndims(space), 1, 2);
    H5Sget_simple_extent_dims(space, shape, NULL);
    double* data = malloc(shape[0] * shape[1] * sizeof *data);
    assert_true(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
    H5Sclose(space);
    H5Dclose(set);
    return data;
}

static void assert_unit(const fixture* f, const char* name, const char* unit) {
    char text[64] = "";
    const hid_t attribute = H5Aopen_by_name(f->file, name, "unit", H5P_DEFAULT, H5P_DEFAULT);
    assert_true(attribute >= 0);
    const hid_t type = H5Aget_type(attribute);
    assert_true(H5Aread(attribute, type, text) >= 0);
    assert_string_equal(text, unit);
    H5Tclose(type);
    H5Aclose(attribute);
}

static double column_max(const double* data, const hsize_t shape[2], hsize_t column) {
    double most = -INFINITY;
    for (hsize_t i = 0; i < shape[0]; ++i)
        most = fmax(most, data[i * shape[1] + column]);
    return most;
}

static void every_dataset_has_its_unit_and_as_many_rows_as_there_are_times(void** state) {
    fixture* f = *state;
    static const char* const names[][2] = {{"time_s", "s"},
                                           {"hook/height_m", "m"},
                                           {"hook/deck_force_N", "N"},
                                           {"hook/zone_force_N", "N"},
                                           {"legs/stroke_m", "m"},
                                           {"legs/tyre_force_N", "N"},
                                           {"legs/wheel_spin_radps", "rad/s"},
                                           {"airframe/energy_J", "J"},
                                           {"bodies/fuselage/position_m", "m"},
                                           {"bodies/hook/attitude", "1"},
                                           {"bodies/hook/spin_radps", "rad/s"}};
    hsize_t times[2], shape[2];
    free(dataset(f, "time_s", times));
    assert_true(times[0] > 100);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        free(dataset(f, names[i][0], shape));
        assert_int_equal(shape[0], times[0]);
        assert_unit(f, names[i][0], names[i][1]);
    }
}

static void the_histories_agree_with_the_result(void** state) {
    fixture* f = *state;
    hsize_t shape[2];
    double* stroke = dataset(f, "legs/stroke_m", shape);
    assert_int_equal(shape[1], BT_LEG_COUNT);
    assert_true(f->result.strut_stroke_max_m[BT_LEG_LEFT] > 0.01);
    for (hsize_t leg = 0; leg < BT_LEG_COUNT; ++leg)
        BT_ASSERT_NEAR(fmax(0, column_max(stroke, shape, leg)), f->result.strut_stroke_max_m[leg],
                       1e-12, 0);
    free(stroke);
    double* force = dataset(f, "hook/deck_force_N", shape);
    BT_ASSERT_NEAR(column_max(force, shape, 0), f->result.hook_deck_force_peak_N, 1e-12, 0);
    free(force);
}

static void euler_parameters_stay_of_unit_length(void** state) {
    fixture* f = *state;
    hsize_t shape[2];
    double* e = dataset(f, "bodies/fuselage/attitude", shape);
    assert_int_equal(shape[1], 4);
    for (hsize_t i = 0; i < shape[0]; ++i) {
        const double* p = e + 4 * i;
        BT_ASSERT_NEAR(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3], 1, 1e-13, 0);
    }
    free(e);
}

static void the_cable_spans_the_deck_at_every_stored_time(void** state) {
    fixture* f = *state;
    hsize_t times[2], y_shape[2], tension_shape[2];
    free(dataset(f, "cable/time_s", times));
    double* y = dataset(f, "cable/y_m", y_shape);
    free(dataset(f, "cable/tension_N", tension_shape));
    assert_int_equal(y_shape[0], times[0]);
    assert_int_equal(tension_shape[0], times[0]);
    assert_int_equal(tension_shape[1], y_shape[1] - 1);
    const double half_span = 0.5 * f->study.model.deck.cable.span_m;
    for (hsize_t i = 0; i < times[0]; ++i) {
        const double* row = y + i * y_shape[1];
        assert_true(row[0] < -0.9 * half_span && row[y_shape[1] - 1] > 0.9 * half_span);
    }
    free(y);
    assert_unit(f, "cable/tension_N", "N");
}

static void every_row_of_the_view_has_a_name_a_unit_and_a_meaning(void** state) {
    (void)state;
    for (int i = 0; i < bt_view_column_count; ++i) {
        const bt_view_column* c = &bt_view_columns[i];
        char whole[96];
        snprintf(whole, sizeof whole, "%s_%s", c->quantity, c->unit);
        assert_string_equal(c->name, whole);
        assert_non_null(bt_unit_text(c->unit));
        assert_true(strlen(c->text) > 10);
        for (int k = 0; k < i; ++k)
            assert_string_not_equal(c->name, bt_view_columns[k].name);
    }
}

/// Numbers of one line.
static int read_line(FILE* file, double* value) {
    char line[4096];
    int count = 0;
    if (!fgets(line, sizeof line, file))
        return 0;
    for (char* word = strtok(line, ","); word && count < 96; word = strtok(NULL, ","))
        value[count++] = strtod(word, NULL);
    return count;
}

static int column_of(const char* name) {
    for (int i = 0; i < bt_view_column_count; ++i)
        if (strcmp(bt_view_columns[i].name, name) == 0)
            return i;
    fail_msg("no column %s", name);
    return -1;
}

/// CSV and HDF5 hold the same numbers to the bit.
static void the_csv_holds_what_the_hdf5_file_holds(void** state) {
    fixture* f = *state;
    char line[4096];
    hsize_t shape[2], legs[2];
    double *time = dataset(f, "time_s", shape), *force = dataset(f, "legs/tyre_force_N", legs);
    const int t = column_of("time_s"), left = column_of("left_tyre_force_N");
    FILE* file = fopen(f->csv, "r");
    assert_non_null(fgets(line, sizeof line, file));
    assert_int_equal(strncmp(line, "# Histories of one landing: ", 28), 0);
    assert_non_null(fgets(line, sizeof line, file));
    assert_int_equal(strncmp(line, "time [s],hook_angle [rad],", 26), 0);
    for (hsize_t row = 0; row < shape[0]; ++row) {
        double value[96];
        assert_int_equal(read_line(file, value), bt_view_column_count);
        assert_true(value[t] == time[row]);
        assert_true(value[left] == force[3 * row + 1]);
    }
    assert_null(fgets(line, sizeof line, file));
    fclose(file);
    free(time);
    free(force);
}

static void a_csv_file_of_someone_else_stays(void** state) {
    fixture* f = *state;
    char path[4096], line[64];
    bt_history* history = NULL;
    toy_path(path, f->directory, "mine.csv");
    FILE* file = fopen(path, "w");
    fputs("mine\n", file);
    fclose(file);
    assert_int_equal(bt_history_create(&history), BT_OK);
    assert_int_equal(bt_history_write(history, path, &f->study, &f->result, NULL), BT_ERR_IO);
    bt_history_destroy(history);
    file = fopen(path, "r");
    assert_string_equal(fgets(line, sizeof line, file), "mine\n");
    fclose(file);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_dataset_has_its_unit_and_as_many_rows_as_there_are_times),
        cmocka_unit_test(every_row_of_the_view_has_a_name_a_unit_and_a_meaning),
        cmocka_unit_test(the_csv_holds_what_the_hdf5_file_holds),
        cmocka_unit_test(a_csv_file_of_someone_else_stays),
        cmocka_unit_test(the_histories_agree_with_the_result),
        cmocka_unit_test(euler_parameters_stay_of_unit_length),
        cmocka_unit_test(the_cable_spans_the_deck_at_every_stored_time),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
