/// Diagnostics: text for people, with the place it is about. The library hands every message to
/// the caller's sink; it never prints.
#ifndef BT_BASE_DIAG_H
#define BT_BASE_DIAG_H

#include "base/status.h"

#include <stdarg.h>

typedef enum bt_severity { BT_NOTE, BT_WARNING, BT_ERROR } bt_severity;

/// A place in a file. file may be NULL (no place); line 0: the whole file. Lines and columns
/// from 1.
typedef struct bt_where {
    const char* file;
    int line, column;
} bt_where;

#define BT_NOWHERE ((bt_where){0})

/// Receives one message at a time; text is valid during the call only.
typedef void bt_diag_sink(void* user, bt_severity severity, bt_where where, const char* text);

typedef struct bt_diag {
    bt_diag_sink* sink; ///< NULL: count only
    void* user;
    int errors, warnings; ///< counted even when the sink is NULL
} bt_diag;

/// Formats and delivers one message (at most 1023 bytes; longer ones are cut). diag may be NULL.
void bt_diag_add(bt_diag* diag, bt_severity severity, bt_where where, const char* format, ...)
    __attribute__((format(printf, 4, 5)));

/// "file:line:column: error: text", leaving out what is not known. Returns snprintf's count.
int bt_diag_format(char* buffer, unsigned long size, bt_severity severity, bt_where where,
                   const char* text);

#endif
