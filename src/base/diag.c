#include "base/diag.h"

#include <stdio.h>

void bt_diag_add(bt_diag* diag, bt_severity severity, bt_where where, const char* format, ...) {
    if (!diag)
        return;
    if (severity == BT_ERROR)
        ++diag->errors;
    else if (severity == BT_WARNING)
        ++diag->warnings;
    if (!diag->sink)
        return;

    char text[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    diag->sink(diag->user, severity, where, text);
}

int bt_diag_format(char* buffer, unsigned long size, bt_severity severity, bt_where where,
                   const char* text) {
    static const char* const name[] = {"note", "warning", "error"};
    if (!where.file)
        return snprintf(buffer, size, "%s: %s", name[severity], text);
    if (where.line <= 0)
        return snprintf(buffer, size, "%s: %s: %s", where.file, name[severity], text);
    return snprintf(buffer, size, "%s:%d:%d: %s: %s", where.file, where.line, where.column,
                    name[severity], text);
}
