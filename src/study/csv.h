/// A table of numbers from a CSV file as a spreadsheet or a logger writes it: columns with their
/// units in the header, in brackets or parentheses,
///
///     time [s], stroke [mm]               Time (s);Stroke (mm);Load cell (kN)
///     0, 0                                0,0000;-0,12;0,004
///     0.01, 58.2                          0,0001;-0,12;0,004
///
/// The delimiter is a semicolon, a tabulator or a comma, as the header has it; with the first two,
/// numbers may have a decimal comma. Lines that begin with # are comments.
#ifndef BT_STUDY_CSV_H
#define BT_STUDY_CSV_H

#include "base/diag.h"

#include <stdbool.h>
#include <stddef.h>

enum { BT_CSV_COLUMNS_MAX = 64, BT_CSV_NAME_MAX = 128, BT_CSV_UNIT_MAX = 32 };

typedef struct bt_csv_heading {
    char name[BT_CSV_NAME_MAX], unit[BT_CSV_UNIT_MAX];
    bt_where place;
} bt_csv_heading;

/// A place in the text while it is read, and how the text is written.
typedef struct bt_csv {
    const char *at, *line_start;
    bt_where where;
    char delimiter;
    int count; ///< columns
    bt_csv_heading columns[BT_CSV_COLUMNS_MAX];
} bt_csv;

/// Reads the header. The text and `file`, its name in messages, are the caller's and must live as
/// long. BT_ERR_INPUT, said in diag: no header, or too many columns; `example` says what one would
/// be.
BT_CHECKED bt_status bt_csv_begin(bt_csv* csv, const char* text, const char* file,
                                  const char* example, bt_diag* diag);

/// Goes to the next line that holds something; false at the end of the text.
bool bt_csv_next(bt_csv* csv);
bt_where bt_csv_place(const bt_csv* csv);

/// Reads some cells of a row, the others may hold anything. BT_ERR_INPUT with its place: a cell
/// that is no number, a row that ends before or is longer than the header.
///
/// @param chosen  [count] columns
/// @param names   [count] what they are called in messages
/// @param number  [count] as written
/// @param place   [count]; may be NULL
BT_CHECKED bt_status bt_csv_row(bt_csv* csv, const int* chosen, const char* const* names, int count,
                                double* number, bt_where* place, bt_diag* diag);

/// Whether a heading is what is meant: its name, or name and unit as in the file. Cases count as
/// equal.
bool bt_csv_is_named(const bt_csv_heading* heading, const char* wanted);

/// The names of all columns, with commas between.
void bt_csv_list(const bt_csv* csv, char* list, size_t size);

#endif
