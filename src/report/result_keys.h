/// The reference of what a landing gives: results, modes, remarks, histories, from the tables of
/// landing/result.h and landing/view.h.
#ifndef BT_REPORT_RESULT_KEYS_H
#define BT_REPORT_RESULT_KEYS_H

#include "base/status.h"

#include <stdio.h>

/// As Markdown (docs/results.md). BT_ERR_MEMORY.
BT_CHECKED bt_status bt_result_keys_markdown(FILE* out);

/// As one JSON object: `results`, `modes`, `remarks`, `histories`, arrays of rows. BT_ERR_MEMORY.
BT_CHECKED bt_status bt_result_keys_json(FILE* out);

#endif
