#include "study/columns.h"

#include "base/text.h"
#include "base/units.h"

#include <stdio.h>

enum { TYPED_SIZE = 96 };

bool bt_column_has_unit(bt_reader* reader, const bt_field* field, const bt_csv_heading* heading) {
    char one[TYPED_SIZE], why[256];
    double value;
    const char* token = *field->unit ? field->unit : "1";
    snprintf(one, sizeof one, "1 %s", heading->unit);
    if (bt_unit_parse(*heading->unit ? one : "1", token, &value, why, sizeof why) == BT_OK)
        return true;
    if (!*heading->unit)
        bt_reader_error(reader, heading->place,
                        "%s: its unit is missing; write it in brackets: %s [%s]", heading->name,
                        heading->name, bt_unit_text(token));
    else
        bt_reader_error(reader, heading->place, "%s: the unit of its heading is wrong: %s",
                        heading->name, why);
    return false;
}

bool bt_column_value(bt_reader* reader, const bt_field* field, const bt_csv_heading* heading,
                     double number, bt_where place, double* value) {
    char digits[40], typed[TYPED_SIZE];
    bt_text_print_number(number, digits, sizeof digits);
    snprintf(typed, sizeof typed, "%s %s", digits, heading->unit);
    const bt_node cell = {.kind = BT_NODE_SCALAR, .where = place, .text = typed};
    return bt_reader_number(reader, field, &cell, heading->name, true, value);
}
