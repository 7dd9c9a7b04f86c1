#include "elements/tyre.h"

#include "elements/check.h"

#include <math.h>

const char* const bt_tyre_law_names[] = {"smiley_horne", "points", "power", NULL};

/// Cornering constants of NASA TR R-64, type VII, over x = deflection / diameter.
static const double cornering_break = 0.0875;

static void check_points(const bt_tyre_params* p, const char* path, bt_diag* diag) {
    const bt_curve_rule rule = {1, "m", "N", true};
    char fault[160];
    if (bt_curve_fault(&p->load_points, &rule, fault, sizeof fault))
        bt_key_error(diag, path, "load_points", "%s", fault);
    else if (p->load_points.x[0] <= 0)
        bt_key_error(diag, path, "load_points", "begins at 0; the point (0, 0) is implied");
}

static void check_tyre(const void* params, const char* path, bt_diag* diag) {
    const bt_tyre_params* p = params;
    if (p->law == BT_TYRE_POINTS)
        check_points(p, path, diag);
    if (p->bottoming_deflection_m >= p->radius_m)
        bt_key_error(diag, path, "bottoming_deflection", "%g m is not below the radius",
                     p->bottoming_deflection_m);
    if (p->damping_ratio > 0 && p->damping_mass_kg <= 0)
        bt_key_error(diag, path, "damping_mass", "needed above 0 where damping_ratio is given");
    if (p->locked_friction > p->friction)
        bt_key_error(diag, path, "locked_friction", "%g is above the peak `friction` of %g",
                     p->locked_friction, p->friction);
}

// clang-format off
#define ROW(kind, name, ...) BT_ROW_##kind(bt_tyre_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(tyre, BT_TYRE_FIELDS, ROW, check_tyre, "tyres of one axle")
// clang-format on

static void prepare_points(const bt_table* table, bt_curve* curve) {
    double x[BT_CURVE_MAX] = {0}, y[BT_CURVE_MAX] = {0};
    for (int i = 0; i < table->count; ++i) {
        x[i + 1] = table->x[i];
        y[i + 1] = table->y[i];
    }
    bt_curve_make(curve, BT_CURVE_SMOOTH, table->count + 1, x, y);
}

void bt_tyre_prepare(const bt_tyre_params* params, bt_tyre* tyre) {
    const bt_tyre_params* p = params;
    const double w = p->width_m, diameter = 2 * p->radius_m;
    *tyre = (bt_tyre){
        .radius = p->radius_m,
        .width = w,
        .tyres = (double)p->tyres,
        .damping = p->damping_Npmps,
        .law = p->law,
        .scale = (p->pressure_Pa + 0.08 * p->rated_pressure_Pa) * w * sqrt(w * diameter),
        .cz = p->vertical_constant,
        .power_scale = p->power_load_N * pow(p->power_deflection_m, -p->power_exponent),
        .power = p->power_exponent,
        .bottoming = p->bottoming_deflection_m > 0 ? p->bottoming_deflection_m : INFINITY,
        .rim_stiffness = p->rim_stiffness_Npm,
        .bridging = p->bridging_length_m,
        .cornering = p->cornering_stiffness_Nprad,
        .cornering_scale = 57 * (p->pressure_Pa + 0.44 * p->rated_pressure_Pa) * w * w,
        .friction = p->friction,
        .locked_friction = p->locked_friction,
        .peak_slip = p->peak_slip,
        .slip_speed = p->slip_speed_mps,
        .critical = 2 * p->damping_ratio * sqrt(p->damping_mass_kg),
        .strips = BT_TYRE_STRIPS,
    };
    if (p->law == BT_TYRE_POINTS)
        prepare_points(&p->load_points, &tyre->points);
}

/// f of NASA TR R-64 over x = d / w, and its integral.
static double smiley_horne(double x, double cz) {
    return x < 10 * cz / 3 ? x * (0.96 + 0.216 / cz * x) : 2.4 * (x - cz);
}

static double smiley_horne_integral(double x, double cz) {
    const double limit = 10 * cz / 3;
    if (x < limit)
        return x * x * (0.48 + 0.072 / cz * x);
    return limit * limit * (0.48 + 0.072 / cz * limit) +
           1.2 * ((x - cz) * (x - cz) - (limit - cz) * (limit - cz));
}

/// Load of one tyre; the last slope of a measured curve goes on beyond its end.
static double one_load(const bt_tyre* t, double d) {
    if (t->law == BT_TYRE_SMILEY_HORNE)
        return t->scale * smiley_horne(d / t->width, t->cz);
    if (t->law == BT_TYRE_POWER)
        return t->power_scale * pow(d, t->power);
    const bt_curve* c = &t->points;
    const int last = c->count - 1;
    if (d < c->x[last])
        return bt_curve_value(c, d);
    return c->y[last] + c->slope[last] * (d - c->x[last]);
}

static double one_energy(const bt_tyre* t, double d) {
    if (t->law == BT_TYRE_SMILEY_HORNE)
        return t->scale * t->width * smiley_horne_integral(d / t->width, t->cz);
    if (t->law == BT_TYRE_POWER)
        return t->power_scale * pow(d, t->power + 1) / (t->power + 1);
    const bt_curve* c = &t->points;
    const int last = c->count - 1;
    const double beyond = d - c->x[last];
    if (beyond < 0)
        return bt_curve_integral(c, d);
    return c->before[last] + beyond * (c->y[last] + 0.5 * c->slope[last] * beyond);
}

double bt_tyre_load(const bt_tyre* tyre, double deflection_m) {
    if (!(deflection_m > 0))
        return 0;
    const double rim = fmax(deflection_m - tyre->bottoming, 0);
    return tyre->tyres * one_load(tyre, deflection_m) + tyre->rim_stiffness * rim;
}

double bt_tyre_energy(const bt_tyre* tyre, double deflection_m) {
    if (!(deflection_m > 0))
        return 0;
    const double rim = fmax(deflection_m - tyre->bottoming, 0);
    return tyre->tyres * one_energy(tyre, deflection_m) + 0.5 * tyre->rim_stiffness * rim * rim;
}

static double one_stiffness(const bt_tyre* t, double d) {
    if (t->law == BT_TYRE_SMILEY_HORNE) {
        const double x = d / t->width;
        return t->scale / t->width * (x < 10 * t->cz / 3 ? 0.96 + 0.432 / t->cz * x : 2.4);
    }
    if (t->law == BT_TYRE_POWER)
        return t->power_scale * t->power * pow(d, t->power - 1);
    return bt_curve_slope(&t->points, d);
}

double bt_tyre_stiffness(const bt_tyre* tyre, double deflection_m) {
    if (!(deflection_m > 0))
        return 0;
    const double rim = deflection_m > tyre->bottoming ? tyre->rim_stiffness : 0;
    return tyre->tyres * one_stiffness(tyre, deflection_m) + rim;
}

bt_law bt_tyre_law(const bt_tyre* tyre, double deflection_m, const char** what) {
    const double rim = isinf(tyre->bottoming) ? tyre->width : tyre->bottoming;
    if (deflection_m >= tyre->radius) {
        *what = "axle at the deck";
        return BT_LAW_LEFT;
    }
    if (!(deflection_m > rim))
        return BT_LAW_HOLDS;
    *what = "tyre on its rim";
    return BT_LAW_AT_LIMIT;
}

double bt_tyre_normal_force(const bt_tyre* tyre, double deflection_m, double rate_mps) {
    if (!(deflection_m > 0))
        return 0;
    double damping = tyre->damping;
    if (tyre->critical > 0)
        damping += tyre->critical * sqrt(bt_tyre_stiffness(tyre, deflection_m));
    return fmax(bt_tyre_load(tyre, deflection_m) + damping * rate_mps, 0);
}

/* Longitudinal and lateral force. */

double bt_tyre_slip_friction(const bt_tyre* tyre, double slip) {
    const double k = fabs(slip);
    double mu = tyre->locked_friction;
    if (k < tyre->peak_slip) {
        const double x = k / tyre->peak_slip;
        mu = tyre->friction * 0.5 * x * (3 - x * x);
    } else if (k < 1) {
        const double t = (k - tyre->peak_slip) / (1 - tyre->peak_slip);
        mu += (tyre->friction - tyre->locked_friction) * (1 - t * t * (3 - 2 * t));
    }
    return copysign(mu, slip);
}

double bt_tyre_slip(const bt_tyre* tyre, double forward_mps, double rolling_mps) {
    const double v = tyre->slip_speed;
    return (forward_mps - rolling_mps) / sqrt(forward_mps * forward_mps + v * v);
}

double bt_tyre_cornering(const bt_tyre* tyre, double deflection_m) {
    if (tyre->cornering > 0)
        return tyre->cornering;
    const double x = fmax(deflection_m, 0) / (2 * tyre->radius);
    const double f = x <= cornering_break ? 1.2 * x - 8.8 * x * x : 0.0674 - 0.34 * x;
    return tyre->tyres * tyre->cornering_scale * fmax(f, 0);
}

double bt_tyre_lateral_force(const bt_tyre* tyre, double normal_N, double deflection_m,
                             double slip_angle_rad) {
    const double most = tyre->friction * normal_N;
    if (!(most > 0))
        return 0;
    const double phi = bt_tyre_cornering(tyre, deflection_m) * fabs(slip_angle_rad) / most;
    const double share = phi < 1.5 ? phi * (1 - 4.0 / 27 * phi * phi) : 1;
    return copysign(most * share, slip_angle_rad);
}

void bt_tyre_ground_force(const bt_tyre* tyre, double normal_N, double deflection_m,
                          double forward_mps, double lateral_mps, double rolling_mps,
                          double force[2]) {
    const double v = tyre->slip_speed;
    const double angle = atan(lateral_mps / sqrt(forward_mps * forward_mps + v * v));
    const double slip = bt_tyre_slip(tyre, forward_mps, rolling_mps);
    force[0] = -bt_tyre_slip_friction(tyre, slip) * normal_N;
    force[1] = -bt_tyre_lateral_force(tyre, normal_N, deflection_m, angle);
    const double square = force[0] * force[0] + force[1] * force[1];
    const double most = tyre->friction * normal_N;
    if (square > most * most) {
        const double scale = most / sqrt(square);
        force[0] *= scale;
        force[1] *= scale;
    }
}

double bt_tyre_rolling_radius(const bt_tyre* tyre, double deflection_m) {
    return tyre->radius - fmax(deflection_m, 0) / 3;
}

/* Enveloping contact. */
