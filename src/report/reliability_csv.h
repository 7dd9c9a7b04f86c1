/// The reliability table of a study directory, read back: STUDY/reliability.csv.
#ifndef BT_REPORT_RELIABILITY_CSV_H
#define BT_REPORT_RELIABILITY_CSV_H

#include "study/study.h"

/// Its columns that are read.
enum {
    BT_CURVE_VALUE,
    BT_CURVE_CORRECTED,
    BT_CURVE_LEAST,
    BT_CURVE_GREATEST,
    BT_CURVE_SURROGATE,
    BT_CURVE_COLUMNS
};

/// One input's conditions in the order of the table.
typedef struct bt_reliability_curve {
    int count;
    double at[BT_CURVE_COLUMNS][BT_CONDITION_MAX]; ///< SI, shares; NAN where a cell is empty
} bt_reliability_curve;

typedef struct bt_reliability_csv bt_reliability_csv;

/// Reads the table. *csv is NULL when there is none. BT_ERR_IO, BT_ERR_INPUT (a column is missing),
/// said in diag; BT_ERR_MEMORY.
BT_CHECKED bt_status bt_reliability_csv_read(const bt_study* study, bt_reliability_csv** csv,
                                             bt_diag* diag);
void bt_reliability_csv_destroy(bt_reliability_csv* csv); ///< accepts NULL

/// The conditions of an input ("landing.pitch"); "": the study as it stands.
void bt_reliability_csv_curve(const bt_reliability_csv* csv, const char* path,
                              bt_reliability_curve* curve);

#endif
