/// Joints as constraint equations: residual phi(q), Jacobian G with G v = d phi / dt, and
/// gamma = -(dG/dt) v, so that G a = gamma. Velocities: centre of mass in the world, angular
/// velocity in the body frame (system.h).
///
/// Every kind is put together from groups of rows. With P = x + A s the joint point of a body,
/// d = P_b - P_a, u the axis, p and q two directions fixed in a and perpendicular to the axis:
///   point     d = 0                          3 rows, world frame
///   slide     p . d = q . d = 0              2 rows
///   normal    u_a . d = 0                    1 row
///   parallel  p . u_b = q . u_b = 0          2 rows
///   cross     u_a . u_b = 0                  1 row
///   lock      2 A_b vec(e_rel) = 0           3 rows, world frame; e_rel = (e_a e_ab)^-1 e_b
///   distance  (d . d - l^2) / (2 l) = 0      1 row
#ifndef BT_MECHANICS_JOINT_H
#define BT_MECHANICS_JOINT_H

#include "mechanics/system.h"

enum { BT_JOINT_ROWS_MAX = 6 };

typedef struct bt_joint {
    char* name;
    bt_joint_kind kind;
    int body_a, body_b;
    int row, row_count; ///< first row among all constraints, how many
    double point_a[3], point_b[3];
    double axis_a[3], axis_b[3];
    double side_a[2][3]; ///< p and q: unit, perpendicular to axis_a and to each other
    double attitude_ab[4];
    double length_m;
    double
        row_scale[BT_JOINT_ROWS_MAX]; ///< residuals are judged by: m (size of the joint) or 1 rad
} bt_joint;

/// Rows of a kind; 0 when the kind does not exist.
int bt_joint_row_count(bt_joint_kind kind);

/// How many of the rows, from the first, are lengths; the others are angles.
int bt_joint_length_rows(bt_joint_kind kind);

/// "revolute", ...
const char* bt_joint_kind_name(bt_joint_kind kind);

bool bt_joint_has_axis(bt_joint_kind kind);

/// True when the kind aligns axis_a with axis_b.
bool bt_joint_aligns_axes(bt_joint_kind kind);

/// True when the kind holds the relative attitude.
bool bt_joint_locks(bt_joint_kind kind);

/// phi [row_count], m or rad; q [7 n], rotation [9 n].
void bt_joint_residual(const bt_joint* joint, const double* q, const double* rotation, double* phi);

/// ga, gb [row_count x 6] row-major, all entries written (also for the ground, where they are the
/// ones a body resting in the world frame would have).
void bt_joint_jacobian(const bt_joint* joint, const double* q, const double* rotation, double* ga,
                       double* gb);

/// gamma [row_count], m/s2 or rad/s2.
void bt_joint_gamma(const bt_joint* joint, const double* q, const double* rotation, const double* v,
                    double* gamma);

/// Two unit directions perpendicular to the unit axis and to each other.
void bt_joint_sides(const double axis[3], double side[2][3]);

#endif
