/// Numbers for the page in few bytes: base64 of little-endian binary, as web/src/data.js reads it.
#ifndef BT_REPORT_PACKED_H
#define BT_REPORT_PACKED_H

#include "report/json.h"

#include <stddef.h>

/// 32-bit floats, as one string. What is not finite is NaN.
void bt_json_floats(bt_json* json, const char* key, const double* values, size_t count);

/// 16-bit steps between the least and the greatest value: {"width", "least", "greatest", "steps"}.
/// The error is at most half a step, (greatest - least) / 131070. Values must be finite.
/// @param width  values per row, for the reader
void bt_json_steps(bt_json* json, const char* key, int width, const float* values, size_t count);

#endif
