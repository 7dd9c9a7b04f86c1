#include "statistics/paired.h"

#include <math.h>

static const double LEVEL = 0.95;

/// Probability of `least` or fewer heads of n fair coins, twice; at most 1.
static double two_sided(int64_t least, int64_t n) {
    // P(X <= k) = I_1/2(n - k, k + 1)
    return fmin(1, 2 * bt_beta_cdf(0.5, (double)(n - least), (double)least + 1));
}

/// Two distances, put together with the correlation of what they belong to.
static double together(double a, double b, double correlation) {
    return sqrt(a * a + 2 * correlation * a * b + b * b);
}

bt_paired_difference bt_paired_compare(const bt_paired* c) {
    const int64_t n = c->both + c->first_only + c->second_only + c->neither;
    const int64_t discordant = c->first_only + c->second_only;
    if (n <= 0)
        return (bt_paired_difference){NAN, {-1, 1}, 1};
    const double first = (double)c->first_only / (double)n,
                 second = (double)c->second_only / (double)n;
    const bt_interval f = bt_clopper_pearson(c->first_only, n, LEVEL),
                      s = bt_clopper_pearson(c->second_only, n, LEVEL);
    const double value = second - first;
    const double r = first + second < 1 ? sqrt(first * second / ((1 - first) * (1 - second))) : 1;
    const int64_t fewer = c->first_only < c->second_only ? c->first_only : c->second_only;
    return (bt_paired_difference){
        .value = value,
        .ci95 = {fmax(-1, value - together(second - s.least, f.greatest - first, r)),
                 fmin(1, value + together(s.greatest - second, first - f.least, r))},
        .p_value = discordant > 0 && 2 * fewer < discordant ? two_sided(fewer, discordant) : 1,
    };
}
