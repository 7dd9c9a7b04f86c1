/// Stops at both ends of a stroke  [Peng2023 Eq. 5].
#ifndef BT_ELEMENTS_STOPS_H
#define BT_ELEMENTS_STOPS_H

/// Springs (and dampers) beyond both ends of 0 .. stroke_max.
typedef struct bt_stops {
    double stroke_max, stiffness, damping;
} bt_stops;

/// Structural limit, N.
///
///     F_l = k_l s (s < 0);  0 (0 <= s <= s_max);  k_l (s - s_max) (s > s_max)    [Peng2023 Eq. 5]
///
/// With damping c s' is added outside the stroke, never so much that a stop pulls.
double bt_stops_force(const bt_stops* stops, double stroke_m, double rate_mps);

/// Energy of the springs, J.
double bt_stops_energy(const bt_stops* stops, double stroke_m);

#endif
