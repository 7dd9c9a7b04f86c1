/// Inputs as people call them: label and unit of a key.
#ifndef BT_REPORT_DISPLAY_H
#define BT_REPORT_DISPLAY_H

#include "base/fields.h"

/// "sink speed" of "landing.sink_speed".
void bt_display_label(const char* path, char* label, size_t size);

/// The unit that people use for a field ("deg"), and what an SI value is multiplied with.
const char* bt_display_unit(const bt_field* field, double* factor);

#endif
