/// What -o means, for every verb alike: by suffix a file, else a directory.
#ifndef BT_CLI_OUTPUT_H
#define BT_CLI_OUTPUT_H

#include "cli/cli.h"
#include "report/table.h"

#include <stdbool.h>

/// The kinds of output, as bits: a verb's row names those that it can write.
enum {
    BT_OUTPUT_NONE = 0,
    BT_OUTPUT_HISTORIES = 1, ///< FILE.h5
    BT_OUTPUT_TABLE = 2,     ///< FILE.csv
    BT_OUTPUT_VALUES = 4,    ///< FILE.yaml
    BT_OUTPUT_DIRECTORY = 8,
    BT_OUTPUT_PAGE = 16,     ///< FILE.html
    BT_OUTPUT_PARAVIEW = 32, ///< FILE.pvd
    BT_OUTPUT_CAPSULE = 64,  ///< FILE.bolter
};

/// The kind of what -o names: a directory that is there, or whose name ends in "/" or has no
/// suffix, is a directory; .h5, .csv, .yaml, .html, .pvd and .bolter are
/// files. 0: no -o, or none of these.
int bt_output_kind(const char* output);

/// Refuses what the verb cannot write (naming what it can), and a file that the command reads.
BT_CHECKED bt_status bt_output_check(const bt_command* command, int accepted);

/// Refuses a file that the command's study was read from.
BT_CHECKED bt_status bt_output_spare(const bt_command* command, const bt_study* study);

/// FILE of -o, or DIRECTORY/NAME (made when it is not there), into BT_FILE_PATH_MAX bytes.
BT_CHECKED bt_status bt_output_path(const bt_command* command, const char* name, char* path,
                                    bt_diag* diag);

/// Writes the table to FILE.csv of -o, when that is what -o names.
BT_CHECKED bt_status bt_output_table(const bt_command* command, const bt_report_table* table,
                                     bt_diag* diag);

#endif
