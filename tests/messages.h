/// Collects diagnostics as the lines a person would read, for comparison with what is expected.
#ifndef BT_TESTS_MESSAGES_H
#define BT_TESTS_MESSAGES_H

#include "base/diag.h"

#include <stdio.h>
#include <string.h>

typedef struct messages {
    char text[16384];
} messages;

static inline void messages_add(void* user, bt_severity severity, bt_where where,
                                const char* text) {
    messages* m = user;
    const size_t used = strlen(m->text);
    char line[2048];
    bt_diag_format(line, sizeof line, severity, where, text);
    snprintf(m->text + used, sizeof m->text - used, "%s\n", line);
}

#endif
