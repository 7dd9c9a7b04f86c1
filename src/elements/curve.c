#include "elements/curve.h"

#include <math.h>
#include <stdio.h>

static double smaller_size(double a, double b) {
    return fabs(a) < fabs(b) ? a : b;
}

/// Steffen's slope at an inner row: the parabola's, limited to twice the smaller secant, and zero
/// at an extremum.
static double inner_slope(double h0, double s0, double h1, double s1) {
    if (s0 * s1 <= 0)
        return 0;
    const double parabola = (s0 * h1 + s1 * h0) / (h0 + h1);
    return smaller_size(parabola, 2 * smaller_size(s0, s1));
}

/// Slope at an end: the parabola's through the first three rows, limited to 0 .. 2 s0.
static double end_slope(double h0, double s0, double h1, double s1) {
    const double parabola = s0 * (1 + h0 / (h0 + h1)) - s1 * h0 / (h0 + h1);
    if (parabola * s0 <= 0)
        return 0;
    return smaller_size(parabola, 2 * s0);
}

static void set_slopes(bt_curve* c) {
    const int n = c->count;
    double h[BT_CURVE_MAX] = {0}, s[BT_CURVE_MAX] = {0};
    for (int i = 0; i + 1 < n; ++i) {
        h[i] = c->x[i + 1] - c->x[i];
        s[i] = (c->y[i + 1] - c->y[i]) / h[i];
    }
    if (n == 1) {
        c->slope[0] = 0;
        return;
    }
    if (n == 2) {
        c->slope[0] = c->slope[1] = s[0];
        return;
    }
    c->slope[0] = end_slope(h[0], s[0], h[1], s[1]);
    for (int i = 1; i + 1 < n; ++i)
        c->slope[i] = inner_slope(h[i - 1], s[i - 1], h[i], s[i]);
    c->slope[n - 1] = end_slope(h[n - 2], s[n - 2], h[n - 3], s[n - 3]);
}

/// Integral of the piece after row i over the share t of its width.
static double piece_integral(const bt_curve* c, int i, double t) {
    const double h = c->x[i + 1] - c->x[i];
    const double y0 = c->y[i], y1 = c->y[i + 1];
    if (c->law == BT_CURVE_STEPPED)
        return h * t * y0;
    if (c->law == BT_CURVE_LINEAR)
        return h * t * (y0 + 0.5 * t * (y1 - y0));
    const double m0 = h * c->slope[i], m1 = h * c->slope[i + 1];
    const double a = 2 * (y0 - y1) + m0 + m1, b = 3 * (y1 - y0) - 2 * m0 - m1;
    return h * t * (y0 + t * (m0 / 2 + t * (b / 3 + t * a / 4)));
}

void bt_curve_make(bt_curve* curve, bt_curve_law law, int count, const double* x, const double* y) {
    curve->law = law;
    curve->count = count;
    for (int i = 0; i < count; ++i) {
        curve->x[i] = x[i];
        curve->y[i] = y[i];
    }
    set_slopes(curve);
    curve->before[0] = 0;
    for (int i = 0; i + 1 < count; ++i)
        curve->before[i + 1] = curve->before[i] + piece_integral(curve, i, 1);
}

/// Row whose piece holds x, which lies between the ends.
static int find_piece(const bt_curve* c, double x) {
    int low = 0, high = c->count - 1;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (x >= c->x[middle])
            low = middle;
        else
            high = middle;
    }
    return low;
}

double bt_curve_value(const bt_curve* curve, double x) {
    const bt_curve* c = curve;
    if (!(x > c->x[0]))
        return c->y[0];
    if (x >= c->x[c->count - 1])
        return c->y[c->count - 1];
    const int i = find_piece(c, x);
    const double y0 = c->y[i], y1 = c->y[i + 1];
    if (c->law == BT_CURVE_STEPPED)
        return y0;
    const double h = c->x[i + 1] - c->x[i];
    const double t = (x - c->x[i]) / h;
    if (c->law == BT_CURVE_LINEAR)
        return y0 + t * (y1 - y0);
    const double m0 = h * c->slope[i], m1 = h * c->slope[i + 1];
    const double a = 2 * (y0 - y1) + m0 + m1, b = 3 * (y1 - y0) - 2 * m0 - m1;
    return y0 + t * (m0 + t * (b + t * a));
}

double bt_curve_slope(const bt_curve* curve, double x) {
    const bt_curve* c = curve;
    if (!(x > c->x[0]))
        return c->slope[0];
    if (x >= c->x[c->count - 1])
        return c->slope[c->count - 1];
    const int i = find_piece(c, x);
    const double h = c->x[i + 1] - c->x[i], t = (x - c->x[i]) / h;
    const double m0 = h * c->slope[i], m1 = h * c->slope[i + 1];
    const double a = 2 * (c->y[i] - c->y[i + 1]) + m0 + m1;
    const double b = 3 * (c->y[i + 1] - c->y[i]) - 2 * m0 - m1;
    return (m0 + t * (2 * b + 3 * t * a)) / h;
}

double bt_curve_integral(const bt_curve* curve, double x) {
    if (curve->count < 2)
        return 0;
    const int i = find_piece(curve, x);
    return curve->before[i] +
           piece_integral(curve, i, (x - curve->x[i]) / (curve->x[i + 1] - curve->x[i]));
}

/// What is wrong with one row, or false.
static bool row_fault(const bt_table* t, int i, const bt_curve_rule* rule, char* text,
                      size_t size) {
    const double x = t->x[i], y = t->y[i];
    const int row = i + 1;
    if (!isfinite(x) || !isfinite(y))
        return snprintf(text, size, "row %d holds a value that is not finite", row) > 0;
    if (x < 0)
        return snprintf(text, size, "row %d begins below 0: %g %s", row, x, rule->x_unit) > 0;
    if (i > 0 && x <= t->x[i - 1])
        return snprintf(text, size,
                        "must increase from row to row in its first column; row %d has %g %s "
                        "after %g %s",
                        row, x, rule->x_unit, t->x[i - 1], rule->x_unit) > 0;
    if (y <= 0)
        return snprintf(text, size, "must be above 0 in its second column; row %d has %g %s", row,
                        y, rule->y_unit) > 0;
    if (rule->never_falls && i > 0 && y < t->y[i - 1])
        return snprintf(text, size, "decreases, and must not; row %d has %g %s after %g %s", row, y,
                        rule->y_unit, t->y[i - 1], rule->y_unit) > 0;
    return false;
}

bool bt_curve_fault(const bt_table* table, const bt_curve_rule* rule, char* text, size_t size) {
    if (table->count < rule->least)
        return snprintf(text, size, "has %d rows; %d at least are needed", table->count,
                        rule->least) > 0;
    if (table->count > BT_LIST_MAX)
        return snprintf(text, size, "has more than %d rows", (int)BT_LIST_MAX) > 0;
    for (int i = 0; i < table->count; ++i)
        if (row_fault(table, i, rule, text, size))
            return true;
    return false;
}
