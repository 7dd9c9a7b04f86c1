/// What a tyre's carcass adds to the strip model: it is a string under tension that rests on the
/// tyre's air spring, and spans the corners that a rope would press into loose strips.
///
/// In the plane of the wheel, w(s) being how far the tread is pressed in at arc s,
///
///     lambda^2 w'' - w = -q / k,     lambda = sqrt(T / k)
///
/// with T the tension of the carcass along the tread and k its foundation, both per width. Where
/// the ground touches, w is the ground; beside it the string leaves with continuous slope. An
/// integral over a part of the string shows what the ground there carries: k times the area between
/// the points of no slope around it. So the load goes with the area pressed in, as in the strip
/// model.
#ifndef BT_ELEMENTS_CARCASS_H
#define BT_ELEMENTS_CARCASS_H

/// Areas that a rope presses in, m2 per metre of width.
typedef struct bt_bridge {
    double above_m2;   ///< above the level of the tread around it
    double carried_m2; ///< what the rope carries: up to where the string has no slope
} bt_bridge;

/// The string over a cylinder that stands out of a level floor.
///
/// It leaves the cylinder where lambda tan(phi) = sqrt(w^2 - W^2), w = delta - rho (1 - cos phi),
/// and falls as W cosh to the floor, or exponentially where W = 0.
///
/// @param length_m  lambda >= 0; 0: no string, the area that the cylinder takes away itself
/// @param rho_m     radius of the cylinder against the straightened tread: 1 / rho = 1 / R + 1 / r
/// @param depth_m   delta: indentation at the cylinder's top
/// @param level_m   W >= 0: indentation of the tread around it
bt_bridge bt_carcass_over_cylinder(double length_m, double rho_m, double depth_m, double level_m);

/// Area pressed in by a flat floor beyond that of the disc itself, m2: the ends of the patch, in
/// small slopes. The patch reaches a = sqrt(lambda^2 + 2 R d) - lambda to both sides.
double bt_carcass_beside_patch(double length_m, double radius_m, double deflection_m);

/// Indentation of the tread by a flat floor at arc s from the middle, m.
double bt_carcass_on_floor(double length_m, double radius_m, double deflection_m, double arc_m);

/// Deflection on a flat floor that presses in the area (disc and ends of the patch), m.
double bt_carcass_equivalent_deflection(double length_m, double radius_m, double area_m2);

#endif
