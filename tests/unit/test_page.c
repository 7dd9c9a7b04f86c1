/// The report page's data: packed numbers, the hook's outline, texts that could be markup.
#define _GNU_SOURCE
#include "near.h"

#include "base/directory.h"
#include "landing/airframe.h"
#include "report/packed.h"
#include "report/page.h"
#include "report/page_shell.h"
#include "report/playback_geometry.h"
#include "toy_study.h"

static int digit(char c) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    return (int)(strchr(digits, c) - digits);
}

/// Base64 up to the closing quote.
static size_t decode(const char* text, uint8_t* bytes) {
    size_t count = 0;
    for (; *text != '"'; text += 4) {
        const unsigned bits = (unsigned)digit(text[0]) << 18 | (unsigned)digit(text[1]) << 12 |
                              (text[2] == '=' ? 0 : (unsigned)digit(text[2]) << 6) |
                              (text[3] == '=' ? 0 : (unsigned)digit(text[3]));
        bytes[count++] = (uint8_t)(bits >> 16);
        if (text[2] != '=')
            bytes[count++] = (uint8_t)(bits >> 8);
        if (text[3] != '=')
            bytes[count++] = (uint8_t)bits;
    }
    return count;
}

static void steps_are_within_half_a_step(void** state) {
    (void)state;
    enum { N = 1001 };
    float values[N];
    char* text = NULL;
    size_t size = 0;
    for (int i = 0; i < N; ++i)
        values[i] = (float)(-3 + 20 * sin(0.1 * i));
    FILE* out = open_memstream(&text, &size);
    bt_json json = {.out = out, .in_page = true};
    bt_json_steps(&json, NULL, 7, values, N);
    fclose(out);
    assert_non_null(strstr(text, "\"width\": 7"));
    const double least = strtod(strstr(text, "\"least\": ") + 9, NULL);
    const double greatest = strtod(strstr(text, "\"greatest\": ") + 12, NULL);
    uint8_t bytes[2 * N + 3];
    assert_int_equal(decode(strstr(text, "\"steps\": \"") + 10, bytes), 2 * N);
    const double step = (greatest - least) / 65535;
    for (int i = 0; i < N; ++i) {
        const double back = least + step * (bytes[2 * i] + 256 * bytes[2 * i + 1]);
        assert_true(fabs(back - (double)values[i]) <= 0.5001 * step);
    }
    free(text);
}

static void floats_keep_their_bits(void** state) {
    (void)state;
    const double values[] = {0.1, -1e-30, NAN, 12345.678};
    char* text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    bt_json json = {.out = out, .in_page = true};
    bt_json_floats(&json, NULL, values, 4);
    fclose(out);
    uint8_t bytes[32];
    assert_int_equal(decode(text + 1, bytes), 16);
    for (size_t i = 0; i < 4; ++i) {
        float back;
        memcpy(&back, bytes + 4 * i, sizeof back);
        assert_true(isnan(values[i]) ? isnan(back) : back == (float)values[i]);
    }
    free(text);
}

/// Every point lies on the outline that the contact laws use, and they go round once with the
/// solid to their left.
static void outline_is_the_profile(void** state) {
    (void)state;
    static bt_study study;
    assert_int_equal(bt_study_read("studies/reference/study.yaml", NULL, 0, &study, NULL), BT_OK);
    bt_airframe airframe;
    assert_int_equal(bt_airframe_build(&study.model.aircraft, 9.81, 0.018, &airframe, NULL), BT_OK);
    double outline[BT_OUTLINE_MAX][2], area = 0;
    const int count = bt_hook_outline(&airframe.profile, 0.4, outline);
    assert_in_range(count, 40, BT_OUTLINE_MAX);
    for (int i = 0; i < count; ++i) {
        const bt_nearest near = bt_profile_nearest(&airframe.profile, outline[i][0], outline[i][1]);
        assert_true(fabs(near.distance_m) < 1e-12);
        const double* next = outline[(i + 1) % count];
        area += 0.5 * (outline[i][0] * next[1] - outline[i][1] * next[0]);
    }
    // shoe of 80 mm radius, arm of 40 mm up to 400 mm, lip: about 0.035 m2
    assert_in_range((int)(1e4 * area), 250, 450);
    bt_airframe_destroy(&airframe);
    bt_study_destroy(&study);
}

static void titles_are_text(void** state) {
    (void)state;
    bt_span before, after;
    if (!bt_page_shell(&before, &after))
        skip();
    static bt_study study;
    bt_lander* lander = NULL;
    bt_playback* playback = NULL;
    bt_landing_result result;
    char path[4096], *directory = toy_directory(), *text = NULL;
    static const char* const sets[] = {"title=</script><script>alert(1)</script>"};
    assert_int_equal(bt_study_read("studies/reference/study.yaml", sets, 1, &study, NULL), BT_OK);
    assert_int_equal(bt_lander_create(&lander), BT_OK);
    assert_int_equal(bt_playback_create(BT_PLAYBACK_ROWS_ALONE, BT_PLAYBACK_NODES, &playback),
                     BT_OK);
    assert_int_equal(
        bt_lander_run(lander, &study.model, &result, bt_playback_observe, playback, NULL), BT_OK);
    const bt_page_subject subject = {&study, "study.yaml", "", NULL};
    const bt_page_landing_of of = {-1, "landing", &study.model, &result};
    toy_path(path, directory, "x.html");
    assert_int_equal(bt_page_landing(&subject, path, playback, &of, NULL), BT_OK);
    assert_int_equal(bt_page_landing(&subject, path, playback, &of, NULL), BT_OK); // again
    size_t size = 0;
    assert_int_equal(bt_file_read(path, &text, &size, NULL), BT_OK);
    assert_in_range(size - before.size - after.size, 50000, 600000);
    assert_non_null(strstr(text, "\\u003c/script>\\u003cscript>alert(1)"));
    assert_null(strstr(text, "<script>alert(1)"));
    free(text);

    assert_int_equal(bt_file_write(path, "<p>mine", 7, NULL), BT_OK);
    assert_int_equal(bt_page_landing(&subject, path, playback, &of, NULL), BT_ERR_IO);
    assert_int_equal(bt_file_read(path, &text, NULL, NULL), BT_OK);
    assert_string_equal(text, "<p>mine");
    free(text);
    bt_playback_destroy(playback);
    bt_lander_destroy(lander);
    bt_study_destroy(&study);
    toy_directory_remove(directory);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_are_within_half_a_step),
        cmocka_unit_test(floats_keep_their_bits),
        cmocka_unit_test(outline_is_the_profile),
        cmocka_unit_test(titles_are_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
