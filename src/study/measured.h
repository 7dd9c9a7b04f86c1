/// A measured curve from a CSV file: two columns with their units in the header,
///
///     time [s], stroke [mm]
///     0, 0
///     0.01, 58.2
///
/// Lines that begin with # are comments.
#ifndef BT_STUDY_MEASURED_H
#define BT_STUDY_MEASURED_H

#include "base/diag.h"

enum { BT_MEASURED_NAME_MAX = 64, BT_MEASURED_ROWS_MAX = 10000 };

typedef struct bt_measured {
    char x_name[BT_MEASURED_NAME_MAX], x_unit[32];
    char y_name[BT_MEASURED_NAME_MAX], y_unit[32];
    int count;
    double *x, *y;    ///< [count] as written; SI once bt_measured_bind was called; x increases
    const char* file; ///< its name, for messages; the caller's
    bt_where x_place, y_place; ///< of the two names in the header
    int x_column, y_column;    ///< columns of the history they are compared with
    char y_token[24];          ///< unit token of y once bound
} bt_measured;

/// Reads the file. BT_ERR_INPUT: wrong columns, text where a number is wanted, x that does not
/// increase, each with its place; BT_ERR_IO; BT_ERR_MEMORY. On BT_OK: bt_measured_destroy. `path`
/// is the name in messages and must live as long as they and the curve's use do.
BT_CHECKED bt_status bt_measured_read(const char* path, bt_measured** measured, bt_diag* diag);
void bt_measured_destroy(bt_measured* measured); ///< accepts NULL

/// Finds the two columns among the names of a history ("time_s", "stroke_m": name and unit token)
/// and turns the numbers into SI. BT_ERR_INPUT, said in diag with the names there are, or the unit
/// that would be right.
BT_CHECKED bt_status bt_measured_bind(bt_measured* measured, const char* const* names, int count,
                                      bt_diag* diag);

#endif
