/// Physics features: numbers derived from a landing's inputs and the aircraft's geometry that the
/// classifier learns from beside the inputs themselves.
///
/// Whether the main wheels come over the cable or onto it decides what the hook finds there, and
/// depends on a quotient of inputs that products and rotations of them cannot make:
///
///   height = clip(h(pitch) - V_V (D - l(pitch)) / V_E, -r / 2, r)
///
/// h: height of the main tyres' underside over the lowest point of the hook in the glide, l: how
/// far ahead of it they are, D: the hook's distance before the cable when the aircraft comes down,
/// r: the tyre's radius. Below 0 the wheels have come down before the cable. No contact is computed
/// and no number belongs to one aircraft.
#ifndef BT_SURROGATE_FEATURES_H
#define BT_SURROGATE_FEATURES_H

#include "study/study.h"

enum { BT_FEATURES = 1 };

/// Their names, as a surrogate keeps them among its paths.
extern const char* const bt_feature_names[BT_FEATURES + 1]; ///< "feature.wheels_over_cable", NULL

/// Where the inputs are found, and the geometry. Constant after creation.
typedef struct bt_features {
    int count;                                         ///< 0: switched off, or the study has none
    int dims;                                          ///< numbers of a point
    int sink_speed, horizontal_speed, pitch, distance; ///< place in a point; -1: as in `fixed`
    double fixed[4];   ///< the landing's own sink speed, speed, pitch and distance
    double wheel_m[2]; ///< main tyres' underside from the hook's lowest point, x and z, level
    double tyre_radius_m;
    bool from_wheels; ///< distance is measured from the main wheels
} bt_features;

/// Features of points whose variables are the given inputs of the study.
bt_features bt_features_of(const bt_study* study, const int* inputs, int dims);

/// Writes dims + count numbers per point: the point, then its features.
void bt_features_extend(const bt_features* features, const double* x, int n, double* extended);

#endif
