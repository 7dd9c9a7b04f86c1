/// Confidence limits for a weighted sum of rare events.
#ifndef BT_STATISTICS_WEIGHTED_H
#define BT_STATISTICS_WEIGHTED_H

/// A weighted sum of events, each of which had a small probability: theta^ = sum v_i over the
/// events that happened.
typedef struct bt_weighted_count {
    double sum;      ///< sum v_i
    double square;   ///< sum v_i^2, the estimate of the sum's variance
    double greatest; ///< the greatest v that an event could have had, seen or not
} bt_weighted_count;

/// Lower and upper limit of theta, each missed with probability `tail` at most, by the gamma
/// limits of Fay and Feuer (Statistics in Medicine 16, 1997):
///
///   lower = v / (2 y) Q(tail; 2 y^2 / v),  y = sum, v = square; 0 when nothing was seen
///   upper = v' / (2 y') Q(1 - tail; 2 y'^2 / v'),  y' = y + w, v' = v + w^2, w = greatest
///
/// Q: quantile of the chi-square distribution. With all weights equal these are the exact limits
/// of a Poisson count times the weight (3.69 w for none seen at tail 0.025), and with many events
/// the normal ones.
double bt_weighted_lower(const bt_weighted_count* count, double tail);
double bt_weighted_upper(const bt_weighted_count* count, double tail);

#endif
