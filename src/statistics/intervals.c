#include "statistics/intervals.h"

#include <math.h>

/// The continued fraction of I_x(a, b) / (x^a (1-x)^b / (a B(a, b)))  [DLMF 8.17.22].
static double beta_fraction(double x, double a, double b) {
    const double tiny = 1e-300;
    double c = 1, d = 1 - (a + b) * x / (a + 1);
    d = 1 / (fabs(d) < tiny ? tiny : d);
    double value = d;
    for (int m = 1; m < 10000000; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        d = 1 + even * d;
        c = 1 + even / c;
        d = 1 / (fabs(d) < tiny ? tiny : d);
        c = fabs(c) < tiny ? tiny : c;
        value *= d * c;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 + odd * d;
        c = 1 + odd / c;
        d = 1 / (fabs(d) < tiny ? tiny : d);
        c = fabs(c) < tiny ? tiny : c;
        value *= d * c;
        if (fabs(d * c - 1) < 1e-15)
            break;
    }
    return value;
}

/// What Stirling's formula leaves of log Gamma(x): 1 / (12 x) - 1 / (360 x^3) + ...
static double stirling_rest(double x) {
    if (x < 10) {
        int sign;
        return lgamma_r(x, &sign) - ((x - 0.5) * log(x) - x + 0.5 * log(2 * M_PI));
    }
    const double r = 1 / (x * x);
    return (1.0 / 12 - r * (1.0 / 360 - r * (1.0 / 1260 - r * (1.0 / 1680 - r / 1188)))) / x;
}

/// log(x^a (1-x)^b / B(a, b)), written about the mean m = a / (a + b), so that counts of 10^10 do
/// not cancel:  a log(x/m) + b log((1-x)/(1-m)) + log sqrt(a b / (2 pi (a + b))) + rests.
static double log_front(double x, double a, double b) {
    const double m = a / (a + b), away = x - m;
    return a * log1p(away / m) + b * log1p(-away / (b / (a + b))) +
           0.5 * log(a / (2 * M_PI) * (b / (a + b))) + stirling_rest(a + b) - stirling_rest(a) -
           stirling_rest(b);
}

double bt_beta_cdf(double x, double a, double b) {
    if (x <= 0)
        return 0;
    if (x >= 1)
        return 1;
    const double front = exp(log_front(x, a, b));
    if (x < (a + 1) / (a + b + 2))
        return front * beta_fraction(x, a, b) / a;
    return 1 - front * beta_fraction(1 - x, b, a) / b;
}

/// The x with I_x(a, b) = p, by bisection: I is monotone, and the end is as exact as I itself.
static double beta_quantile(double p, double a, double b) {
    double low = 0, high = 1;
    for (int i = 0; i < 1100 && high - low > 1e-16 * high; ++i) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high)
            break;
        if (bt_beta_cdf(middle, a, b) < p)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

double bt_interval_half(const bt_interval* interval) {
    return 0.5 * (interval->greatest - interval->least);
}

bt_interval bt_clopper_pearson(int64_t hits, int64_t trials, double level) {
    const double tail = 0.5 * (1 - level);
    const double k = (double)hits, n = (double)trials;
    bt_interval interval = {0, 1};
    if (trials <= 0)
        return interval;
    if (hits > 0)
        interval.least = beta_quantile(tail, k, n - k + 1);
    if (hits < trials)
        interval.greatest = beta_quantile(1 - tail, k + 1, n - k);
    return interval;
}
