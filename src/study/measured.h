/// A measured curve: two columns of a CSV file (study/csv.h).
#ifndef BT_STUDY_MEASURED_H
#define BT_STUDY_MEASURED_H

#include "base/diag.h"

#include <stdbool.h>

enum { BT_MEASURED_NAME_MAX = 64, BT_MEASURED_ROWS_MAX = 1 << 24 };

/// Which two columns of a file are meant, and as which of a history. All NULL: the file has two,
/// and their headings are the history's names.
typedef struct bt_measured_columns {
    const char *x_heading, *y_heading; ///< headings in the file, with or without their units
    const char *x_name, *y_name;       ///< in the history, without units: "time", "strut_force"
    const char* offset; ///< with its unit: what x of the file is where the history's is 0; NULL: 0
    bt_where where;     ///< of this mapping in the study
} bt_measured_columns;

typedef struct bt_measured {
    char x_name[BT_MEASURED_NAME_MAX], x_unit[32]; ///< the history's name, the file's unit
    char y_name[BT_MEASURED_NAME_MAX], y_unit[32];
    int count;
    double *x, *y;             ///< [count] as written; SI once bt_measured_bind was called
    const char* file;          ///< its name, for messages; the caller's
    const char* offset;        ///< see bt_measured_columns
    bool ordered;              ///< x never decreases: y is a function of it, not a loop
    bt_where x_place, y_place; ///< of the two names in the header
    bt_where fall_place;       ///< where x first decreases
    bt_where offset_place;
    int x_column, y_column; ///< columns of the history they are compared with
    char y_token[24];       ///< unit token of y once bound
} bt_measured;

/// Reads two columns of the file. BT_ERR_INPUT: wrong columns, text where a number is wanted, each
/// with its place; BT_ERR_IO; BT_ERR_MEMORY. On BT_OK: bt_measured_destroy. `path` and `columns`
/// (NULL: two columns are all there are) must live as long as messages and the curve's use do.
BT_CHECKED bt_status bt_measured_read(const char* path, const bt_measured_columns* columns,
                                      bt_measured** measured, bt_diag* diag);
void bt_measured_destroy(bt_measured* measured); ///< accepts NULL

/// Finds the two columns among the names of a history ("time_s", "stroke_m": name and unit token),
/// turns the numbers into SI and takes the offset from x. BT_ERR_INPUT, said in diag with the names
/// there are, the unit that would be right, or the place where time goes back.
BT_CHECKED bt_status bt_measured_bind(bt_measured* measured, const char* const* names, int count,
                                      bt_diag* diag);

#endif
