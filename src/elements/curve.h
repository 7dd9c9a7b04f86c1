/// Curves through the rows of a table: what a metering pin or a measured tyre is.
#ifndef BT_ELEMENTS_CURVE_H
#define BT_ELEMENTS_CURVE_H

#include "base/fields.h"

typedef enum bt_curve_law {
    BT_CURVE_SMOOTH, ///< monotone cubic: between two rows it stays between their values
    BT_CURVE_LINEAR,
    BT_CURVE_STEPPED, ///< a row holds until the next
} bt_curve_law;

enum { BT_CURVE_MAX = BT_LIST_MAX + 1 };

typedef struct bt_curve {
    bt_curve_law law;
    int count;
    double x[BT_CURVE_MAX], y[BT_CURVE_MAX];
    double slope[BT_CURVE_MAX];  ///< smooth: dy/dx at the rows
    double before[BT_CURVE_MAX]; ///< integral of y from x[0] to each row
} bt_curve;

/// Lays a curve through count rows (1 .. BT_CURVE_MAX), x strictly increasing. The smooth law takes
/// Steffen's slopes (Astron. Astrophys. 239, 443, 1990): continuous slope, extrema only at rows.
void bt_curve_make(bt_curve* curve, bt_curve_law law, int count, const double* x, const double* y);

/// Value at x; the end values hold beyond the ends.
double bt_curve_value(const bt_curve* curve, double x);

/// Slope at x, law smooth: that of the last row beyond the end, of the first before the begin.
double bt_curve_slope(const bt_curve* curve, double x);

/// Integral from the first row to x, which lies between the ends (laws smooth and linear).
double bt_curve_integral(const bt_curve* curve, double x);

/// What a table may not hold.
typedef struct bt_curve_rule {
    int least;                   ///< rows
    const char *x_unit, *y_unit; ///< for the message
    bool never_falls;            ///< y grows or stays from row to row
} bt_curve_rule;

/// Whether a table breaks a rule: too few rows, not finite, x not strictly increasing or below 0, y
/// not above 0. Says so in text, with the row (from 1) and what was read: a sentence's end.
bool bt_curve_fault(const bt_table* table, const bt_curve_rule* rule, char* text, size_t size);

#endif
