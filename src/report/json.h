/// JSON: one object, written as it is made. Numbers are exact (the fewest digits that read back to
/// the same double); what is not finite is null, as JSON has no word for it.
#ifndef BT_REPORT_JSON_H
#define BT_REPORT_JSON_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { BT_JSON_DEPTH_MAX = 16 };

/// A writer: plain data, started by {.out = file}. Write errors stay with the file (ferror).
typedef struct bt_json {
    FILE* out;    ///< the caller's
    bool in_page; ///< stands inside an HTML page: "<" is written \u003c, and no line is broken
    int depth;
    bool filled[BT_JSON_DEPTH_MAX]; ///< this level has a value already
} bt_json;

/// key is NULL inside an array and for the outermost value.
void bt_json_begin_object(bt_json* json, const char* key);
void bt_json_end_object(bt_json* json);
void bt_json_begin_array(bt_json* json, const char* key);
void bt_json_end_array(bt_json* json);
void bt_json_number(bt_json* json, const char* key, double value);
void bt_json_integer(bt_json* json, const char* key, int64_t value);
void bt_json_bool(bt_json* json, const char* key, bool value);
void bt_json_string(bt_json* json, const char* key, const char* value); ///< NULL: null

/// A number for the eye: `digits` significant digits.
void bt_json_rounded(bt_json* json, const char* key, double value, int digits);

/// A value that is JSON text already.
void bt_json_text(bt_json* json, const char* key, const char* text);

#endif
