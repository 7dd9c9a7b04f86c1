/// Lists of values as people type them on the command line.
#ifndef BT_CLI_VALUES_H
#define BT_CLI_VALUES_H

#include "base/status.h"

#include <stddef.h>

/// Writes a list out with a unit at every value: "0, 4, 8 deg" is "0 deg, 4 deg, 8 deg" (a value
/// without a unit takes that of the next one that has it), and a range of the form
///
///     FROM..TO UNIT            nine values, the ends among them
///     FROM..TO UNIT in N       N values, N >= 2
///     FROM..TO UNIT by STEP    FROM, FROM + STEP, ... up to TO; STEP in the same unit
///
/// is its values. Any other text is left as it is.
///
/// @return BT_OK; BT_ERR_INPUT with the reason in `why`: a range without an end, a step that does
///         not lead there, more than 64 values
BT_CHECKED bt_status bt_values_expand(const char* text, char* list, size_t size, char* why,
                                      size_t why_size);

#endif
