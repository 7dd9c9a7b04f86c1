/// What the tests of the command line share: a directory of their own, a shell, and what it said.
/// Include it first: it asks for the GNU extensions.
#ifndef BT_TESTS_CLI_FIXTURE_H
#define BT_TESTS_CLI_FIXTURE_H

#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif

#include "near.h"

#include "base/directory.h"
#include "toy_study.h"

#include <sys/wait.h>

#define REFERENCE "studies/reference/study.yaml"

typedef struct fixture {
    char* directory;
    char *out, *err; ///< of the last command
} fixture;

static inline int setup(void** state) {
    fixture* f = calloc(1, sizeof *f);
    f->directory = toy_directory();
    *state = f;
    return 0;
}

static inline int teardown(void** state) {
    fixture* f = *state;
    toy_directory_remove(f->directory);
    free(f->out);
    free(f->err);
    free(f);
    return 0;
}

static inline char* read_text(const fixture* f, const char* name) {
    char path[4096];
    char* text = NULL;
    assert_int_equal(bt_file_read(toy_path(path, f->directory, name), &text, NULL, NULL), BT_OK);
    return text;
}

/// Runs `bolter ARGUMENTS` through the shell, "%" standing for the test's directory; returns the
/// exit code.
static inline int bolter(fixture* f, const char* arguments) {
    const char* program = getenv("BOLTER");
    char* command = NULL;
    size_t size = 0;
    FILE* text = open_memstream(&command, &size);
    fprintf(text, "'%s' ", program ? program : "build/bolter");
    for (const char* c = arguments; *c; ++c)
        if (*c == '%')
            fputs(f->directory, text);
        else
            fputc(*c, text);
    fprintf(text, " >'%s/out' 2>'%s/err'", f->directory, f->directory);
    fclose(text);
    const int code = system(command);
    free(command);
    free(f->out);
    free(f->err);
    f->out = read_text(f, "out");
    f->err = read_text(f, "err");
    return WIFEXITED(code) ? WEXITSTATUS(code) : -1;
}

static inline void write_file(const fixture* f, const char* name, const char* text) {
    char path[4096];
    assert_int_equal(bt_file_write(toy_path(path, f->directory, name), text, strlen(text), NULL),
                     BT_OK);
}

static inline void assert_has(const char* text, const char* part) {
    if (!strstr(text, part))
        fail_msg("\"%s\" is not in:\n%s", part, text);
}

/// Whether a file is there; "name" is below the test's directory.
static inline bool exists(const fixture* f, const char* name) {
    char path[4096];
    return access(toy_path(path, f->directory, name), F_OK) == 0;
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

#endif
