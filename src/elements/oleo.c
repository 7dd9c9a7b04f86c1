#include "elements/oleo.h"

#include "elements/check.h"
#include "elements/friction.h"
#include "elements/gas.h"
#include "elements/orifice.h"

#include <math.h>

const char* const bt_orifice_law_names[] = {"smooth", "linear", "stepped", NULL};
const char* const bt_spring_names[] = {"gas", "points", NULL};

static void check_points(const bt_oleo_params* p, const char* path, bt_diag* diag) {
    const bt_curve_rule rule = {2, "m", "N", true};
    char fault[160];
    bt_table rows = p->spring_points;
    if (rows.count > 0 && rows.y[0] == 0)
        rows.y[0] = 1e-300; // a spring may begin without a preload
    if (bt_curve_fault(&rows, &rule, fault, sizeof fault))
        bt_key_error(diag, path, "spring_points", "%s", fault);
    else if (rows.x[0] != 0)
        bt_key_error(diag, path, "spring_points",
                     "begins at %g m; its first row must be at stroke 0 (the preload)", rows.x[0]);
}

static bool lacks(double value, const char* key, const char* path, bt_diag* diag) {
    if (value > 0)
        return false;
    bt_key_error(diag, path, key, "needed above 0 where spring is gas");
    return true;
}

static void check_gas(const bt_oleo_params* p, const char* path, bt_diag* diag) {
    const bool no_area = lacks(p->air_area_m2, "air_area", path, diag);
    const bool no_pressure = lacks(p->precharge_Pa, "precharge", path, diag);
    const bool no_volume = lacks(p->air_volume_m3, "air_volume", path, diag);
    if (no_area || no_pressure || no_volume)
        return;
    const double swept = p->air_area_m2 * p->stroke_max_m;
    const bool two = p->high_precharge_Pa > 0 || p->high_volume_m3 > 0;
    const double volume = p->air_volume_m3 + (two ? p->high_volume_m3 : 0);
    bt_gas_check(p->precharge_Pa, p->ambient_Pa, volume, swept, path, diag);
    if (!two)
        return;
    if (p->high_volume_m3 <= 0)
        bt_key_error(diag, path, "high_volume", "needed where high_precharge is given");
    if (p->high_precharge_Pa <= p->precharge_Pa)
        bt_key_error(diag, path, "high_precharge", "%g Pa is not above the precharge of %g Pa",
                     p->high_precharge_Pa, p->precharge_Pa);
    if (p->high_exponent > 0 && p->high_exponent < 1)
        bt_key_error(diag, path, "high_exponent", "%g is outside 1 .. 1.7 (0: gas_exponent)",
                     p->high_exponent);
}

static void check_orifices(const bt_oleo_params* p, const char* path, bt_diag* diag) {
    if (p->oil_area_m2 > 0 && p->orifice_table.count > 0) {
        const bt_curve_rule rule = {2, "m", "m^2", false};
        char fault[160];
        if (bt_curve_fault(&p->orifice_table, &rule, fault, sizeof fault))
            bt_key_error(diag, path, "orifice_table", "%s", fault);
        if (p->orifice_area_m2 > 0)
            bt_key_error(diag, path, "orifice_area",
                         "orifice_table is given too; give one of them");
    } else if (p->oil_area_m2 > 0 && p->orifice_area_m2 <= 0) {
        bt_key_error(diag, path, "orifice_area", "needed where orifice_table is not given");
    }
    if (p->side_area_m2 > 0 && p->side_orifice_compression_m2 <= 0 &&
        p->side_orifice_extension_m2 <= 0)
        bt_key_error(diag, path, "side_area",
                     "needs side_orifice_extension or side_orifice_compression above 0 (a "
                     "direction that is left out flows freely)");
}

static void check_oleo(const void* params, const char* path, bt_diag* diag) {
    const bt_oleo_params* p = params;
    (p->spring == BT_SPRING_POINTS ? check_points : check_gas)(p, path, diag);
    check_orifices(p, path, diag);
    if (p->bearing_coefficient > 0 && p->side_load_ratio > 0 &&
        p->axle_distance_m <= p->stroke_max_m)
        bt_key_error(diag, path, "axle_distance",
                     "%g m is not above stroke_max, so that the axle would pass the lower bearing",
                     p->axle_distance_m);
}

// clang-format off
#define ROW(kind, name, ...) BT_ROW_##kind(bt_oleo_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(oleo, BT_OLEO_FIELDS, ROW, check_oleo, "oleo-pneumatic shock strut")
// clang-format on

static void prepare_gas(const bt_oleo_params* p, bt_oleo* o) {
    const double n = p->gas_exponent, p1 = p->precharge_Pa, p2 = p->high_precharge_Pa;
    const double c1 = p->air_volume_m3 * pow(p1, 1 / n);
    o->air_area = p->air_area_m2;
    o->precharge = p1;
    o->ambient = p->ambient_Pa;
    o->exponent = n;
    o->oil_compliance = p->oil_volume_m3 / p->oil_bulk_modulus_Pa;
    o->high_exponent = p->high_exponent > 0 ? p->high_exponent : n;
    o->stage[0] = (bt_gas_stage){c1, 0, p->air_volume_m3, p1, 0};
    o->stage[1] = o->stage[0];
    o->second_stroke = INFINITY;
    if (p->high_volume_m3 <= 0)
        return;
    o->second_stroke =
        (p->air_volume_m3 + o->oil_compliance * (p2 - p1) - c1 * pow(p2, -1 / n)) / p->air_area_m2;
    const double c2 = p->high_volume_m3 * pow(p2, 1 / o->high_exponent);
    const bool alike = o->high_exponent == n;
    o->stage[1] =
        (bt_gas_stage){alike ? c1 + c2 : c1, alike ? 0 : c2, p->air_volume_m3 + p->high_volume_m3,
                       p2, bt_gas_work(c1, n, p1, p2)};
}

static void prepare_oil(const bt_oleo_params* p, bt_oleo* o) {
    o->main_constant = bt_orifice_damping(p->oil_density_kgpm3, p->oil_area_m2, p->discharge);
    o->rebound_ratio = p->rebound_ratio;
    o->rebound_area = p->rebound_area_m2;
    if (p->oil_area_m2 <= 0) {
        const double zero = 0, one = 1; // nothing flows through it
        bt_curve_make(&o->orifice, BT_CURVE_LINEAR, 1, &zero, &one);
    } else if (p->orifice_table.count > 0) {
        bt_curve_make(&o->orifice, (bt_curve_law)p->orifice_law, p->orifice_table.count,
                      p->orifice_table.x, p->orifice_table.y);
    } else {
        const double zero = 0;
        bt_curve_make(&o->orifice, BT_CURVE_LINEAR, 1, &zero, &p->orifice_area_m2);
    }
    const double side =
        bt_orifice_damping(p->oil_density_kgpm3, p->side_area_m2, p->side_discharge);
    const double in = p->side_orifice_compression_m2, out = p->side_orifice_extension_m2;
    o->side_compression = side > 0 && in > 0 ? side / (in * in) : 0;
    o->side_extension = side > 0 && out > 0 ? side / (out * out) : 0;
}

void bt_oleo_prepare(const bt_oleo_params* params, bt_oleo* oleo) {
    const bt_oleo_params* p = params;
    *oleo = (bt_oleo){.by_points = p->spring == BT_SPRING_POINTS, .second_stroke = INFINITY};
    if (oleo->by_points)
        bt_curve_make(&oleo->spring, BT_CURVE_SMOOTH, p->spring_points.count, p->spring_points.x,
                      p->spring_points.y);
    else
        prepare_gas(p, oleo);
    prepare_oil(p, oleo);
    oleo->stops = (bt_stops){p->stroke_max_m, p->stop_stiffness_Npm, p->stop_damping_Npmps};
    oleo->seal_N = p->seal_friction_N;
    oleo->seal_coefficient = p->seal_coefficient;
    oleo->bearing = p->bearing_coefficient * p->side_load_ratio;
    oleo->axle_distance = p->axle_distance_m;
    oleo->bearing_distance = p->bearing_distance_m;
    oleo->friction_speed = p->friction_speed_mps;
    oleo->has_friction = oleo->seal_N > 0 || oleo->seal_coefficient > 0 || oleo->bearing > 0;
}

/// Pressure p at which the gas fills room + compliance (p - P_0), from a first guess. The residual
/// is increasing and concave in p, so that Newton's method converges from below.
static double soften(const bt_oleo* o, const bt_gas_stage* stage, double room, double guess) {
    const double n = o->exponent, n2 = o->high_exponent, kappa = o->oil_compliance;
    const double least = guess < o->precharge ? guess : stage->pressure;
    double p = guess;
    for (int i = 0; i < 60; ++i) {
        const double gas = stage->constant * pow(p, -1 / n);
        const double other = stage->other > 0 ? stage->other * pow(p, -1 / n2) : 0;
        const double residual = room + kappa * (p - o->precharge) - gas - other;
        double next = p - residual / (kappa + gas / (n * p) + other / (n2 * p));
        if (next < least)
            next = least;
        if (fabs(next - p) <= 1e-15 * p)
            return next;
        p = next;
    }
    return p;
}

double bt_oleo_gas_pressure(const bt_oleo* oleo, double stroke_m) {
    const bt_gas_stage* stage = &oleo->stage[stroke_m > oleo->second_stroke];
    const double room = stage->volume - oleo->air_area * stroke_m;
    if (!(room > 0))
        return INFINITY;
    if (stage->other > 0)
        return soften(oleo, stage, room, stage->pressure);
    const double p = bt_gas_pressure(&(bt_gas){stage->constant, 1, oleo->exponent}, room);
    return oleo->oil_compliance > 0 ? soften(oleo, stage, room, p) : p;
}

/// A spring given by points: its curve, and its last slope beyond.
static double points_force(const bt_oleo* o, double stroke_m) {
    const bt_curve* c = &o->spring;
    const int last = c->count - 1;
    if (!(stroke_m > c->x[last]))
        return bt_curve_value(c, stroke_m);
    return c->y[last] + c->slope[last] * (stroke_m - c->x[last]);
}

static double points_energy(const bt_oleo* o, double stroke_m) {
    const bt_curve* c = &o->spring;
    const int last = c->count - 1;
    const double beyond = stroke_m - c->x[last];
    if (stroke_m < 0)
        return c->y[0] * stroke_m;
    if (beyond < 0)
        return bt_curve_integral(c, stroke_m);
    return c->before[last] + beyond * (c->y[last] + 0.5 * c->slope[last] * beyond);
}

double bt_oleo_gas_force(const bt_oleo* oleo, double stroke_m) {
    if (oleo->by_points)
        return points_force(oleo, stroke_m);
    return oleo->air_area * (bt_oleo_gas_pressure(oleo, stroke_m) - oleo->ambient);
}

double bt_oleo_gas_energy(const bt_oleo* oleo, double stroke_m) {
    if (oleo->by_points)
        return points_energy(oleo, stroke_m);
    const bt_gas_stage* stage = &oleo->stage[stroke_m > oleo->second_stroke];
    const double p = bt_oleo_gas_pressure(oleo, stroke_m), p0 = oleo->precharge;
    const double other =
        stage->other > 0 ? bt_gas_work(stage->other, oleo->high_exponent, stage->pressure, p) : 0;
    return stage->energy + bt_gas_work(stage->constant, oleo->exponent, stage->pressure, p) +
           other + 0.5 * oleo->oil_compliance * (p - p0) * (p + p0) -
           oleo->ambient * oleo->air_area * stroke_m;
}

double bt_oleo_orifice_area(const bt_oleo* oleo, double stroke_m) {
    return bt_curve_value(&oleo->orifice, stroke_m);
}

double bt_oleo_oil_force(const bt_oleo* oleo, double stroke_m, double rate_mps) {
    double area = bt_curve_value(&oleo->orifice, stroke_m);
    double side = oleo->side_compression;
    if (rate_mps < 0) {
        area = oleo->rebound_area > 0 ? oleo->rebound_area : oleo->rebound_ratio * area;
        side = oleo->side_extension;
    }
    return (oleo->main_constant / (area * area) + side) * rate_mps * fabs(rate_mps);
}

double bt_oleo_limit_force(const bt_oleo* oleo, double stroke_m, double rate_mps) {
    return bt_stops_force(&oleo->stops, stroke_m, rate_mps);
}

double bt_oleo_friction_force(const bt_oleo* oleo, double stroke_m, double rate_mps,
                              double gas_force_N, double oil_force_N) {
    if (!oleo->has_friction)
        return 0;
    const double lever = fmax(oleo->axle_distance - stroke_m, 0);
    const double overlap = oleo->bearing_distance + fmax(stroke_m, 0);
    const double bearings = oleo->bearing * fabs(gas_force_N + oil_force_N);
    const double seals = oleo->seal_N + oleo->seal_coefficient * fabs(gas_force_N);
    return (seals + bearings * (2 * lever / overlap + 1)) *
           bt_friction_factor(rate_mps, oleo->friction_speed);
}

double bt_oleo_force(const bt_oleo* oleo, double stroke_m, double rate_mps) {
    const double gas = bt_oleo_gas_force(oleo, stroke_m);
    const double oil = bt_oleo_oil_force(oleo, stroke_m, rate_mps);
    const double limit = bt_oleo_limit_force(oleo, stroke_m, rate_mps);
    return gas + oil + limit + bt_oleo_friction_force(oleo, stroke_m, rate_mps, gas, oil);
}

bt_law bt_oleo_law(const bt_oleo* oleo, double stroke_m, const char** what) {
    if (!(stroke_m > oleo->stops.stroke_max))
        return BT_LAW_HOLDS;
    const bool gas = isfinite(bt_oleo_gas_force(oleo, stroke_m));
    *what = gas ? "strut bottomed" : "no gas volume in the strut";
    return gas ? BT_LAW_AT_LIMIT : BT_LAW_LEFT;
}

double bt_oleo_energy(const bt_oleo* oleo, double stroke_m) {
    return bt_oleo_gas_energy(oleo, stroke_m) + bt_stops_energy(&oleo->stops, stroke_m);
}

double bt_oleo_hanging_stroke(const bt_oleo* oleo, double load_N) {
    const double k = oleo->stops.stiffness;
    if (!(k > 0))
        return 0;
    // The gas is far softer than the stop: each step gains orders of magnitude.
    double stroke = 0;
    for (int i = 0; i < 40; ++i) {
        const double step = (bt_oleo_gas_force(oleo, stroke) + fmin(k * stroke, 0) + load_N) / k;
        stroke -= step;
        if (fabs(step) <= 1e-16 * fabs(stroke))
            break;
    }
    return fmin(stroke, 0);
}
