/// Figures as text.
#define _GNU_SOURCE
#include "near.h"

#include "report/figure_text.h"

enum { TEXT_SIZE = 8192 };

static void print(const bt_figure* figure, char text[TEXT_SIZE]) {
    FILE* out = fmemopen(text, TEXT_SIZE, "w");
    assert_non_null(out);
    bt_figure_print(figure, out);
    fputc('\0', out);
    fclose(out);
}

/// A rising straight line: one mark in every column, none above the one to its right.
static void a_line_is_followed(void** state) {
    (void)state;
    const double x[] = {0, 4}, y[] = {10, 20};
    const bt_series series = {.label = "rise", .count = 2, .x = x, .y = y};
    const bt_figure figure = {
        .title = "line", .x_label = "x", .y_label = "y", .series_count = 1, .series = &series};
    char text[TEXT_SIZE] = "";
    print(&figure, text);
    char* line = strchr(text, '\n') + 1;
    int height[BT_FIGURE_TEXT_WIDTH], marks = 0;
    for (int i = 0; i < BT_FIGURE_TEXT_HEIGHT; ++i, line = strchr(line, '\n') + 1)
        for (int k = 0; line[11 + k] != '\n'; ++k)
            if (line[11 + k] == '*') {
                height[k] = BT_FIGURE_TEXT_HEIGHT - i;
                ++marks;
            }
    assert_int_equal(marks, BT_FIGURE_TEXT_WIDTH);
    for (int k = 1; k < BT_FIGURE_TEXT_WIDTH; ++k)
        assert_true(height[k] >= height[k - 1] && height[k] <= height[k - 1] + 1);
    assert_int_equal(strncmp(text, "line\n       20 |", 16), 0);
    assert_non_null(strstr(text, "       10 |*"));
    assert_non_null(strstr(text, "* rise\n"));
}

/// What a study is called cannot move the cursor or colour the terminal; gaps stay gaps.
static void titles_are_no_commands(void** state) {
    (void)state;
    const double x[] = {0, 1, 2}, y[] = {1, NAN, 3};
    const bt_series series = {.style = BT_SERIES_POINTS, .count = 3, .x = x, .y = y};
    const bt_figure figure = {.title = "\033[2J\rname",
                              .x_label = "x",
                              .y_label = "y\a",
                              .series_count = 1,
                              .series = &series};
    char text[TEXT_SIZE] = "";
    print(&figure, text);
    for (const char* c = text; *c; ++c)
        assert_true(*c == '\n' || (unsigned char)*c >= ' ');
    int marks = 0;
    for (const char* c = text; (c = strchr(c, '*')); ++c)
        ++marks;
    assert_int_equal(marks, 2);
}

static void nothing_is_drawn_of_nothing(void** state) {
    (void)state;
    const bt_figure figure = {.title = "empty"};
    char text[TEXT_SIZE] = "";
    print(&figure, text);
    assert_string_equal(text, "");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_line_is_followed),
        cmocka_unit_test(titles_are_no_commands),
        cmocka_unit_test(nothing_is_drawn_of_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
