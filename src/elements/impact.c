#include "elements/impact.h"

#include "elements/check.h"
#include "elements/friction.h"

#include <math.h>

const char* const bt_stiffness_from_names[] = {"given", "bodies", NULL};
const char* const bt_dissipation_law_names[] = {
    "coefficient", "met", "hunt_crossley", "lankarani_nikravesh", "flores", "herbert_mcwhannell",
    "lee_wang",    NULL};

static bt_hertz_body first_body(const bt_impact_params* p) {
    return (bt_hertz_body){p->first_modulus_Pa, p->first_poisson, p->first_radius_m,
                           p->first_cross_radius_m};
}

static bt_hertz_body second_body(const bt_impact_params* p) {
    return (bt_hertz_body){p->second_modulus_Pa, p->second_poisson, p->second_radius_m,
                           p->second_cross_radius_m};
}

static void check_impact(const void* params, const char* path, bt_diag* diag) {
    const bt_impact_params* p = params;
    const bt_hertz_body first = first_body(p), second = second_body(p);
    bt_hertz hertz;
    if (p->stiffness_from == BT_STIFFNESS_BODIES &&
        bt_hertz_contact(&first, &second, p->crossing_angle_rad, &hertz) != BT_OK)
        bt_key_error(diag, path, "first_radius", "bodies with these radii do not touch in a point");
}

// clang-format off
#define ROW(kind, name, ...) BT_ROW_##kind(bt_impact_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(impact, BT_IMPACT_FIELDS, ROW, check_impact, "impact of two solid bodies")
// clang-format on

/// Complete elliptic integrals K and D = (K - E) / k^2 with k^2 = 1 - q^2, 0 < q <= 1, by the
/// arithmetic-geometric mean, without cancellation.
static void elliptic(double q, double* k_integral, double* d_integral) {
    double a = (1 + q) / 2, b = sqrt(q);
    double c2 = (1 - q) / (4 * (1 + q)); // (c_1 / c_0)^2 of the mean's differences c_n
    const double c0 = (1 - q) * (1 + q);
    double sum = 0.5, weight = 1;
    for (int i = 0; i < 40 && c2 > 0; ++i) {
        const double before = sum;
        sum += weight * c2;
        weight *= 2;
        const double mean = (a + b) / 2;
        b = sqrt(a * b);
        a = mean;
        c2 = c2 * c2 * c0 / (16 * a * a); // c_(n+1) = c_n^2 / (4 a_(n+1))
        if (sum == before)
            break;
    }
    *k_integral = acos(-1.0) / (a + b);
    *d_integral = *k_integral * sum;
}

/// R_large / R_small of a contact ellipse with half axes a / b = 1 / q.
static double curvature_ratio(double q) {
    double k, d;
    elliptic(q, &k, &d);
    return (k - d) / (d * q * q);
}

/// The inverse by bisection: a/b lies between the root of the ratio and the ratio.
static double axis_ratio(double ratio) {
    double low = 0.5 * log(ratio), high = log(ratio);
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        if (curvature_ratio(exp(-middle)) < ratio)
            low = middle;
        else
            high = middle;
    }
    return exp(0.5 * (low + high));
}

static double curvature(double radius_m) {
    return radius_m == 0 ? 0 : 1 / radius_m;
}

bt_status bt_hertz_contact(const bt_hertz_body* first, const bt_hertz_body* second,
                           double crossing_angle_rad, bt_hertz* out) {
    const double c1 = curvature(first->radius_m), c1x = curvature(first->cross_radius_m);
    const double c2 = curvature(second->radius_m), c2x = curvature(second->cross_radius_m);
    const double d1 = c1 - c1x, d2 = c2 - c2x;
    const double sum = c1 + c1x + c2 + c2x;
    const double square = d1 * d1 + d2 * d2 + 2 * d1 * d2 * cos(2 * crossing_angle_rad);
    const double difference = sqrt(fmax(square, 0));
    const double least = 0.5 * (sum - difference), most = 0.5 * (sum + difference);
    if (!(least > 1e-9 * most))
        return BT_ERR_ARG;
    out->radius_large = 1 / least;
    out->radius_small = 1 / most;
    out->axis_ratio = axis_ratio(most / least);
    const double flexibility = (1 - first->poisson * first->poisson) / first->modulus_Pa +
                               (1 - second->poisson * second->poisson) / second->modulus_Pa;
    double k, d;
    elliptic(1 / out->axis_ratio, &k, &d);
    out->stiffness = 2 * acos(-1.0) / (3 * flexibility) * sqrt(2 * d / (least * k * k * k));
    return BT_OK;
}

/// Positive below the root, in e as well as in x.
static double restitution_residual(double x, double e) {
    return x * (1 + e) - log1p(x) + log1p(-e * x);
}

double bt_impact_restitution(double x) {
    if (x < 1e-5)
        return 1 - x * (2.0 / 3 - x * (4.0 / 9)); // the next term is below rounding
    double low = 0, high = fmin(1, 1 / x);
    for (int i = 0; i < 60; ++i) {
        const double e = 0.5 * (low + high);
        if (restitution_residual(x, e) > 0)
            low = e;
        else
            high = e;
    }
    return 0.5 * (low + high);
}

double bt_impact_dissipation(double restitution) {
    const double e = restitution;
    if (1 - e < 1e-5)
        return 1.5 * (1 - e) * (1 + (1 - e)); // inverse of the series above
    double low = 1.5 * (1 - e), high = 1 / e;
    for (int i = 0; i < 60; ++i) {
        const double x = 0.5 * (low + high);
        if (restitution_residual(x, e) > 0)
            low = x;
        else
            high = x;
    }
    return 0.5 * (low + high);
}

double bt_impact_law(int law, double restitution) {
    const double e = restitution;
    switch (law) {
    case BT_DISSIPATION_HUNT_CROSSLEY:
        return 1.5 * (1 - e);
    case BT_DISSIPATION_LANKARANI_NIKRAVESH:
        return 0.75 * (1 - e * e);
    case BT_DISSIPATION_FLORES:
        return 1.6 * (1 - e) / e;
    case BT_DISSIPATION_HERBERT_MCWHANNELL:
        return 6 * (1 - e) / ((2 * e - 1) * (2 * e - 1) + 3);
    case BT_DISSIPATION_LEE_WANG:
        return 0.75 * (1 - e);
    default:
        return bt_impact_dissipation(e);
    }
}

void bt_impact_prepare(const bt_impact_params* params, bt_impact* impact) {
    const bt_impact_params* p = params;
    const bt_hertz_body first = first_body(p), second = second_body(p);
    bt_hertz hertz;
    impact->stiffness = p->stiffness_Npm15;
    if (p->stiffness_from == BT_STIFFNESS_BODIES &&
        bt_hertz_contact(&first, &second, p->crossing_angle_rad, &hertz) == BT_OK)
        impact->stiffness = hertz.stiffness;
    impact->dissipation =
        p->dissipation_law == BT_DISSIPATION_COEFFICIENT
            ? p->dissipation_spm
            : bt_impact_law(p->dissipation_law, p->restitution) / p->reference_speed_mps;
    impact->friction = p->friction;
    impact->slip_speed = p->slip_speed_mps;
}

double bt_impact_force(const bt_impact* impact, double depth_m, double rate_mps) {
    if (!(depth_m > 0))
        return 0;
    const double force = impact->stiffness * depth_m * sqrt(depth_m);
    return force * fmax(1 + impact->dissipation * rate_mps, 0);
}

double bt_impact_energy(const bt_impact* impact, double depth_m) {
    return depth_m > 0 ? 0.4 * impact->stiffness * depth_m * depth_m * sqrt(depth_m) : 0;
}

void bt_impact_friction(const bt_impact* impact, double normal_N, const double velocity[3],
                        double force[3]) {
    bt_friction_force(impact->friction * normal_N, impact->slip_speed, velocity, force);
}
