/// Messages of the elements' own checks, each with the full path of the key it is about.
#ifndef BT_ELEMENTS_CHECK_H
#define BT_ELEMENTS_CHECK_H

#include "base/diag.h"

/// Adds the error "path.key: text" (path may be empty).
void bt_key_error(bt_diag* diag, const char* path, const char* key, const char* format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
