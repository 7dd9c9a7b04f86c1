/// `bolter noise` as a user types it.
#define _GNU_SOURCE
#include "near.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>

/// Runs `bolter noise ARGUMENTS`, output and errors together; returns the exit code.
static int noise(const char* arguments, char* text, size_t size) {
    const char* program = getenv("BOLTER");
    char command[1024];
    snprintf(command, sizeof command, "'%s' noise %s 2>&1", program ? program : "build/bolter",
             arguments);
    FILE* pipe = popen(command, "r");
    assert_non_null(pipe);
    const size_t got = fread(text, 1, size - 1, pipe);
    text[got] = '\0';
    const int status = pclose(pipe);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void assert_says(const char* text, const char* part) {
    if (!strstr(text, part))
        fail_msg("\"%s\" does not say \"%s\"", text, part);
}

static void prints_a_row_for_each_computation(void** state) {
    (void)state;
    char text[8192];
    assert_int_equal(noise("studies/reference/study.yaml --samples 2 --variants steps_doubled",
                           text, sizeof text),
                     0);
    assert_says(text, "2 landings of ");
    assert_says(text, "| as the study sets it | - | - | ");
    assert_says(text, "| airframe and contact steps doubled: the reserve | ");
    assert_null(strstr(text, "segments of the cable half as long"));
}

static void json_is_one_object_with_all_counts(void** state) {
    (void)state;
    char text[8192];
    assert_int_equal(
        noise("studies/reference/study.yaml --samples 2 --variants strips_doubled --json", text,
              sizeof text),
        0);
    assert_true(text[0] == '{');
    static const char* const keys[] = {
        "\"landings\": 2", "\"name\": \"as_set\"", "\"name\": \"strips_doubled\"",
        "\"flips\": ",     "\"wrong_side\": ",     "\"failed\": 0"};
    for (size_t k = 0; k < sizeof keys / sizeof *keys; ++k)
        assert_says(text, keys[k]);
}

static void wrong_use_is_refused(void** state) {
    (void)state;
    char text[8192];
    assert_int_equal(noise("studies/reference/study.yaml --samples 0", text, sizeof text), 2);
    assert_int_equal(
        noise("studies/reference/study.yaml --variants steps_halved,foo", text, sizeof text), 2);
    assert_says(text, "there is no \"foo\"");
    assert_int_equal(noise("no/such/file.yaml", text, sizeof text), 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(prints_a_row_for_each_computation),
        cmocka_unit_test(json_is_one_object_with_all_counts),
        cmocka_unit_test(wrong_use_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
