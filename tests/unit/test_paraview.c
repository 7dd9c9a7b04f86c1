/// A landing as ParaView's files: what VTK's XML format asks of them, and that parts and cable are
/// where the landing has them.
#define _GNU_SOURCE
#include "near.h"

#include "base/directory.h"
#include "report/paraview.h"
#include "study/study.h"
#include "toy_study.h"

enum { NUMBERS_MAX = 40000 };

typedef struct fixture {
    char* directory;
    char path[4096];
    bt_study study;
} fixture;

static char* read_file(const char* directory, const char* name) {
    char path[4096], *text = NULL;
    assert_int_equal(bt_file_read(toy_path(path, directory, name), &text, NULL, NULL), BT_OK);
    return text;
}

/// The numbers of a data array, by its name.
static int numbers(const char* text, const char* name, double* values) {
    char mark[64];
    snprintf(mark, sizeof mark, "Name=\"%s\"", name);
    const char* at = strstr(text, mark);
    assert_non_null(at);
    at = strchr(at, '>') + 1;
    int count = 0;
    for (char* end; count < NUMBERS_MAX; at = end, ++count) {
        values[count] = strtod(at, &end);
        if (end == at)
            break;
    }
    assert_int_equal(strncmp(at + strspn(at, " \n"), "</DataArray>", 12), 0);
    return count;
}

static int attribute(const char* text, const char* name) {
    const char* at = strstr(text, name);
    assert_non_null(at);
    return atoi(at + strlen(name) + 2);
}

/// Offsets rise to the number of corners; corners name points that exist.
static void check_cells(const char* text, const char* name, int cells, int points) {
    static double corner[NUMBERS_MAX], offset[NUMBERS_MAX];
    const char* at = strstr(text, name);
    if (cells == 0)
        return;
    assert_non_null(at);
    const int corners = numbers(at, "connectivity", corner);
    assert_int_equal(numbers(at, "offsets", offset), cells);
    assert_int_equal((int)offset[cells - 1], corners);
    for (int i = 0; i < cells; ++i)
        assert_true(offset[i] - (i ? offset[i - 1] : 0) >= 2);
    for (int i = 0; i < corners; ++i)
        assert_in_range((int)corner[i], 0, points - 1);
}

/// Checks one .vtp and gives its points; returns how many.
static int check_piece(const char* text, double* xyz) {
    assert_int_equal(strncmp(text, "<?xml version=\"1.0\"?>\n", 22), 0);
    assert_non_null(strstr(text, "<VTKFile type=\"PolyData\""));
    assert_non_null(strstr(text, "</VTKFile>\n"));
    const int points = attribute(text, "NumberOfPoints");
    const int lines = attribute(text, "NumberOfLines"), polygons = attribute(text, "NumberOfPolys");
    assert_int_equal(numbers(strstr(text, "<Points>"), "points", xyz), 3 * points);
    check_cells(text, "<Lines>", lines, points);
    check_cells(text, "<Polys>", polygons, points);
    return points;
}

static int setup(void** state) {
    static fixture f;
    bt_lander* lander = NULL;
    bt_playback* playback = NULL;
    bt_landing_result result;
    f.directory = toy_directory();
    if (bt_study_read("studies/reference/study.yaml", NULL, 0, &f.study, NULL) != BT_OK ||
        bt_lander_create(&lander) != BT_OK ||
        bt_playback_create(12, BT_LANDING_SEGMENTS_MAX, &playback) != BT_OK ||
        bt_lander_run(lander, &f.study.model, &result, bt_playback_observe, playback, NULL) !=
            BT_OK ||
        bt_paraview_write(toy_path(f.path, f.directory, "landing.pvd"), playback, &f.study.model,
                          NULL) != BT_OK)
        return -1;
    bt_playback_destroy(playback);
    bt_lander_destroy(lander);
    *state = &f;
    return 0;
}

static int teardown(void** state) {
    fixture* f = *state;
    toy_directory_remove(f->directory);
    bt_study_destroy(&f->study);
    return 0;
}

static void collection_names_files_that_are_whole(void** state) {
    const fixture* f = *state;
    static double xyz[NUMBERS_MAX];
    char* text = read_file(f->directory, "landing.pvd");
    assert_non_null(strstr(text, "<VTKFile type=\"Collection\""));
    int files = 0;
    double last = -1;
    for (const char* at = text; (at = strstr(at, "<DataSet ")); ++files) {
        const double time = strtod(strstr(at, "timestep=\"") + 10, NULL);
        assert_true(time >= last);
        last = time;
        at = strstr(at, "file=\"") + 6;
        char name[256];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at, "\""), at);
        char* piece = read_file(f->directory, name);
        assert_true(check_piece(piece, xyz) > 3);
        free(piece);
    }
    assert_in_range(files, 3 * 8, 3 * 12);
    assert_true(last > 0.05 && last < 1);
    free(text);
}

/// Before anything meets it the cable lies straight across the deck at x = 0 under its pretension.
static void cable_begins_at_rest(void** state) {
    const fixture* f = *state;
    static double xyz[NUMBERS_MAX], tension[NUMBERS_MAX];
    const bt_cable_params* cable = &f->study.model.deck.cable;
    char* text = read_file(f->directory, "landing/cable_0000.vtp");
    const int n = check_piece(text, xyz);
    assert_int_equal(numbers(text, "tension_N", tension), n);
    assert_true(n > 200);
    for (int i = 0; i < n; ++i) {
        BT_ASSERT_NEAR(xyz[3 * i], 0, 0, 1e-4);
        assert_in_range((int)(1e3 * xyz[3 * i + 2]), 10, 130);
        BT_ASSERT_NEAR(tension[i], cable->pretension_N, 2e-3, 0);
    }
    BT_ASSERT_NEAR(xyz[3 * n - 2] - xyz[1], cable->span_m, 0, 0.4);
    free(text);
}

/// Wheels of the true size, the lowest point of tyres and hook above the deck in the glide.
static void parts_have_their_size_and_place(void** state) {
    const fixture* f = *state;
    static double xyz[NUMBERS_MAX];
    char* text = read_file(f->directory, "landing/airframe_0000.vtp");
    const int n = check_piece(text, xyz);
    double lowest = INFINITY, port = -INFINITY, starboard = INFINITY;
    for (int i = 0; i < n; ++i) {
        lowest = fmin(lowest, xyz[3 * i + 2]);
        port = fmax(port, xyz[3 * i + 1]);
        starboard = fmin(starboard, xyz[3 * i + 1]);
    }
    // the landing starts a moment before the hook, the lowest part, touches
    assert_in_range((int)(1e4 * lowest), 0, 200);
    const bt_gear_params* gear = &f->study.model.aircraft.main_gear;
    const double half = gear->half_track_m + 0.5 * gear->tyre.width_m * (double)gear->tyre.tyres;
    BT_ASSERT_NEAR(port, half, 0, 1e-4);
    BT_ASSERT_NEAR(starboard, -half, 0, 1e-4);
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(collection_names_files_that_are_whole),
        cmocka_unit_test(cable_begins_at_rest),
        cmocka_unit_test(parts_have_their_size_and_place),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
