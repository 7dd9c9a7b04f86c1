#include "elements/stops.h"

#include <math.h>

double bt_stops_force(const bt_stops* stops, double stroke_m, double rate_mps) {
    const double k = stops->stiffness, c = stops->damping;
    if (stroke_m < 0)
        return fmin(k * stroke_m + c * rate_mps, 0);
    if (stroke_m > stops->stroke_max)
        return fmax(k * (stroke_m - stops->stroke_max) + c * rate_mps, 0);
    return 0;
}

double bt_stops_energy(const bt_stops* stops, double stroke_m) {
    const double beyond = stroke_m < 0 ? stroke_m : fmax(stroke_m - stops->stroke_max, 0);
    return 0.5 * stops->stiffness * beyond * beyond;
}
