#include "report/display.h"

#include "base/units.h"

#include <stdio.h>
#include <string.h>

void bt_display_label(const char* path, char* label, size_t size) {
    const char* dot = strrchr(path, '.');
    snprintf(label, size, "%s", dot ? dot + 1 : path);
    for (char* c = label; *c; ++c)
        if (*c == '_')
            *c = ' ';
}

const char* bt_display_unit(const bt_field* field, double* factor) {
    static const double degrees = 57.29577951308232;
    *factor = 1;
    if (strcmp(field->unit, "rad") != 0)
        return field->unit[0] ? bt_unit_text(field->unit) : "";
    *factor = degrees;
    return "deg";
}
