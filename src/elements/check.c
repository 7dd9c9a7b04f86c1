#include "elements/check.h"

#include <stdio.h>

void bt_key_error(bt_diag* diag, const char* path, const char* key, const char* format, ...) {
    char text[512];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s%s%s: %s", path, *path ? "." : "", key, text);
}
