/// An empty folder of its own for a test's files.
#ifndef BT_TESTS_FOLDER_H
#define BT_TESTS_FOLDER_H

#include <stdio.h>
#include <stdlib.h>

enum { FOLDER_SIZE = 256 };

/// Makes the folder in TMPDIR, or where the system keeps such files, and writes its name to `path`.
/// Returns 0, or -1 when it cannot be made. The test removes it.
static inline int folder_make(char path[FOLDER_SIZE]) {
    const char* base = getenv("TMPDIR");
    const int length =
        snprintf(path, FOLDER_SIZE, "%s/bolter-XXXXXX", base && *base ? base : P_tmpdir);
    return length < FOLDER_SIZE && mkdtemp(path) ? 0 : -1;
}

#endif
