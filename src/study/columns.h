/// Columns of a CSV file as values of the model's keys.
#ifndef BT_STUDY_COLUMNS_H
#define BT_STUDY_COLUMNS_H

#include "base/fields.h"
#include "study/csv.h"
#include "study/reader.h"

/// Whether the unit of a heading is one of the key's; reports when it is missing or wrong.
bool bt_column_has_unit(bt_reader* reader, const bt_field* field, const bt_csv_heading* heading);

/// The SI value of a cell of that column; reports, at the cell, what the key does not allow.
bool bt_column_value(bt_reader* reader, const bt_field* field, const bt_csv_heading* heading,
                     double number, bt_where place, double* value);

#endif
