/// The deck under one segment of cable: spring, damper and friction, as the kernel and what needs
/// to know its forces beforehand compute them.
#ifndef BT_CABLE_DECK_H
#define BT_CABLE_DECK_H

#include "cable/cable.h"

#include <math.h>

typedef struct deck_law {
    double radius, stiffness, damping, friction, slip2;
} deck_law;

static inline deck_law deck_law_of(const bt_cable_model* model) {
    const bt_cable_deck_params* p = &model->def.deck_contact;
    const double on = model->def.deck ? 1 : 0;
    return (deck_law){model->radius_m, on * p->stiffness_Npm2, on * model->contact_damping_Npm2ps,
                      p->friction, p->slip_speed_mps * p->slip_speed_mps};
}

/// Spring and damper under half a segment, never pulling.
static inline double deck_normal(deck_law law, double length, double z, double vz) {
    const double depth = law.radius - z;
    const double force = length * (law.stiffness * depth - law.damping * vz);
    const double pushing = force > 0 ? force : 0;
    return depth > 0 ? pushing : 0;
}

typedef struct deck_push {
    double normal; ///< N, up
    double moment; ///< N m: (normal force times distance along the axis), of both points
} deck_push;

/// The deck under the two Gauss points of a segment: a tilted one lands on its lower end.
static inline deck_push deck_under(deck_law law, double half, double z, double tz, double vz,
                                   double tilt_rate) {
    const double arm = 0.57735026918962576 * half;
    const double rise = arm * tz, rate = arm * tilt_rate;
    const double before = deck_normal(law, half, z - rise, vz - rate);
    const double after = deck_normal(law, half, z + rise, vz + rate);
    return (deck_push){before + after, arm * (after - before)};
}

/// Friction of the deck over the sliding velocity (sx, sy), N s/m: implicit in what it does itself
/// to the slip during the kick, so that it cannot turn it over.
static inline double deck_drag(deck_law law, double normal, double sx, double sy,
                               double kick_per_mass) {
    const double limit = law.friction * normal;
    return limit / (sqrt(sx * sx + sy * sy + law.slip2) + limit * kick_per_mass);
}

#endif
