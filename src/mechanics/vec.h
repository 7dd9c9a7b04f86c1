/// Small vectors and Euler parameters. All arrays are caller's; results may not alias inputs
/// unless said.
#ifndef BT_MECHANICS_VEC_H
#define BT_MECHANICS_VEC_H

#include <math.h>

static inline double bt_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double bt_norm(const double a[3]) {
    return sqrt(bt_dot(a, a));
}

static inline void bt_cross(const double a[3], const double b[3], double c[3]) {
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/// y += s x (may alias)
static inline void bt_add_scaled(double y[3], double s, const double x[3]) {
    y[0] += s * x[0];
    y[1] += s * x[1];
    y[2] += s * x[2];
}

/// A(e), row-major, body to world, of unit Euler parameters.
static inline void bt_rotation_from_euler(const double e[4], double a[9]) {
    const double w = e[0], x = e[1], y = e[2], z = e[3];
    a[0] = 1 - 2 * (y * y + z * z);
    a[1] = 2 * (x * y - w * z);
    a[2] = 2 * (x * z + w * y);
    a[3] = 2 * (x * y + w * z);
    a[4] = 1 - 2 * (x * x + z * z);
    a[5] = 2 * (y * z - w * x);
    a[6] = 2 * (x * z - w * y);
    a[7] = 2 * (y * z + w * x);
    a[8] = 1 - 2 * (x * x + y * y);
}

/// y = A x
static inline void bt_rotate(const double a[9], const double x[3], double y[3]) {
    y[0] = a[0] * x[0] + a[1] * x[1] + a[2] * x[2];
    y[1] = a[3] * x[0] + a[4] * x[1] + a[5] * x[2];
    y[2] = a[6] * x[0] + a[7] * x[1] + a[8] * x[2];
}

/// y = A^T x
static inline void bt_unrotate(const double a[9], const double x[3], double y[3]) {
    y[0] = a[0] * x[0] + a[3] * x[1] + a[6] * x[2];
    y[1] = a[1] * x[0] + a[4] * x[1] + a[7] * x[2];
    y[2] = a[2] * x[0] + a[5] * x[1] + a[8] * x[2];
}

/// c = a b, quaternion product
static inline void bt_euler_multiply(const double a[4], const double b[4], double c[4]) {
    c[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    c[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    c[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    c[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
}

/// c = conj(a) b
static inline void bt_euler_relative(const double a[4], const double b[4], double c[4]) {
    const double conjugate[4] = {a[0], -a[1], -a[2], -a[3]};
    bt_euler_multiply(conjugate, b, c);
}

static inline void bt_euler_normalise(double e[4]) {
    const double s = 1 / sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3]);
    for (int i = 0; i < 4; ++i)
        e[i] *= s;
}

/// Euler parameters of the rotation vector theta: (cos |theta|/2, sin(|theta|/2) theta/|theta|).
/// Small angles (all that a step makes) by the Taylor series to rounding: same bits everywhere.
static inline void bt_euler_from_vector(const double theta[3], double e[4]) {
    const double z = 0.25 * bt_dot(theta, theta); // (|theta|/2)^2
    double c, s;                                  // cos x, sin x / x with x = |theta|/2
    if (z < 0.0625) {
        c = 1 - z / 2 * (1 - z / 12 * (1 - z / 30 * (1 - z / 56 * (1 - z / 90 * (1 - z / 132)))));
        s = 1 - z / 6 * (1 - z / 20 * (1 - z / 42 * (1 - z / 72 * (1 - z / 110 * (1 - z / 156)))));
    } else {
        const double x = sqrt(z);
        c = cos(x);
        s = sin(x) / x;
    }
    e[0] = c;
    e[1] = 0.5 * s * theta[0];
    e[2] = 0.5 * s * theta[1];
    e[3] = 0.5 * s * theta[2];
}

#endif
