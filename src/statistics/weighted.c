#include "statistics/weighted.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdbool.h>

/// The x that a chi-square variable exceeds with probability `above`, or stays below with 1 -
/// above: by bisection of the cumulative probability, whose inverse in GSL fails for 1e5 degrees.
static double chi_square(double below, double above, double degrees) {
    double low = 0, high = degrees + 20 * sqrt(2 * degrees) + 100;
    for (int i = 0; i < 200 && high - low > 1e-13 * high; ++i) {
        const double middle = 0.5 * (low + high);
        const bool less = above < below ? gsl_cdf_chisq_Q(middle, degrees) > above
                                        : gsl_cdf_chisq_P(middle, degrees) < below;
        if (less)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

double bt_weighted_lower(const bt_weighted_count* count, double tail) {
    const double y = count->sum, v = count->square;
    return y > 0 ? v / (2 * y) * chi_square(tail, 1 - tail, 2 * y * y / v) : 0;
}

double bt_weighted_upper(const bt_weighted_count* count, double tail) {
    const double w = count->greatest, y = count->sum + w, v = count->square + w * w;
    return y > 0 ? v / (2 * y) * chi_square(1 - tail, tail, 2 * y * y / v) : 0;
}
