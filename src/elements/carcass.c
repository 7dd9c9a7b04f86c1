#include "elements/carcass.h"

#include "elements/tyre.h"

#include <math.h>

/// Area that a cylinder takes away by itself: a segment, and the shadow behind it once it is deeper
/// than its radius.
static double shadow(double rho, double depth) {
    const double pi_2 = acos(0.0);
    if (depth <= rho)
        return bt_tyre_segment_area(rho, depth);
    return rho * (pi_2 * rho + 2 * (depth - rho));
}

/// Half the width of that shadow.
static double half_shadow(double rho, double depth) {
    return depth < rho ? sqrt(depth * (2 * rho - depth)) : rho;
}

/// Slope with which the string leaves the cylinder.
static double leaving_slope(double lambda, double rho, double depth, double level) {
    double low = 0, high = sqrt(depth * depth - level * level) / lambda, t = high;
    for (int i = 0; i < 60; ++i) {
        const double root = sqrt(1 + t * t);
        const double w = fmax(depth - rho * (1 - 1 / root), 0);
        const double rest = w * w - level * level - lambda * lambda * t * t;
        const double rate = -2 * t * (w * rho / (root * root * root) + lambda * lambda);
        *(rest > 0 ? &low : &high) = t;
        double next = t - rest / rate;
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        const double step = fabs(next - t);
        t = next;
        if (step <= 1e-7 * t) // what is left is its square
            break;
    }
    return t;
}

bt_bridge bt_carcass_over_cylinder(double length_m, double rho_m, double depth_m, double level_m) {
    const double lambda = length_m, rho = rho_m, level = level_m;
    if (!(depth_m > level))
        return (bt_bridge){0};
    if (!(lambda > 0))
        return (bt_bridge){shadow(rho, depth_m - level),
                           shadow(rho, depth_m - level) +
                               2 * level * half_shadow(rho, depth_m - level)};
    const double t = leaving_slope(lambda, rho, depth_m, level);
    const double half = rho * t / sqrt(1 + t * t);
    const double w = hypot(lambda * t, level);
    // under the cylinder up to `half`; beyond it k w = T w'' up to where the slope is 0
    const double under =
        (depth_m - rho) * half + 0.5 * rho * (half / sqrt(1 + t * t) + rho * atan(t));
    const double span = level > 0 ? lambda * acosh(w / level) : 0;
    const double carried = 2 * (under + lambda * lambda * t);
    return (bt_bridge){carried - 2 * level * (half + span), carried};
}

/// Half the patch of a flat floor.
static double half_patch(double lambda, double radius, double deflection) {
    return sqrt(lambda * lambda + 2 * radius * deflection) - lambda;
}

double bt_carcass_beside_patch(double length_m, double radius_m, double deflection_m) {
    if (!(deflection_m > 0 && length_m > 0))
        return 0;
    const double d = deflection_m, a = half_patch(length_m, radius_m, d);
    const double string =
        2 * (a * (d - a * a / (6 * radius_m)) + length_m * length_m * a / radius_m);
    return string - 4.0 / 3 * d * sqrt(2 * radius_m * d);
}

double bt_carcass_on_floor(double length_m, double radius_m, double deflection_m, double arc_m) {
    if (!(deflection_m > 0))
        return 0;
    const double s = fabs(arc_m), a = half_patch(length_m, radius_m, deflection_m);
    if (s <= a)
        return deflection_m - s * s / (2 * radius_m);
    return length_m > 0 ? length_m * a / radius_m * exp((a - s) / length_m) : 0;
}

double bt_carcass_equivalent_deflection(double length_m, double radius_m, double area_m2) {
    if (!(length_m > 0))
        return bt_tyre_equivalent_deflection(radius_m, area_m2);
    if (!(area_m2 > 0))
        return 0;
    // area(d) is convex: Newton comes down to the root from above, after one step if not at once
    double d = fmin(area_m2 / (2 * length_m), cbrt(0.5625 * area_m2 * area_m2 / (2 * radius_m)));
    for (int i = 0; i < 30; ++i) {
        const double area =
            bt_tyre_segment_area(radius_m, d) + bt_carcass_beside_patch(length_m, radius_m, d);
        const double rate = 2 * (sqrt(d * (2 * radius_m - d)) + length_m +
                                 half_patch(length_m, radius_m, d) - sqrt(2 * radius_m * d));
        const double step = (area - area_m2) / rate;
        d -= step;
        if (fabs(step) <= 1e-7 * d) // what is left is its square
            break;
    }
    return d;
}
