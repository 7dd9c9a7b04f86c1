#include "base/distribution.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <math.h>

const char* const bt_distribution_names[] = {
    "normal",  "truncated_normal", "lognormal",   "uniform",  "triangular",
    "weibull", "gumbel",           "exponential", "constant", (const char*)0};

static const double EULER_GAMMA = 0.57721566490153286061;

const char* const* bt_distribution_parameters(bt_distribution_kind kind) {
    static const char* const parameters[BT_DISTRIBUTION_KINDS][5] = {
        [BT_NORMAL] = {"mean", "sd"},
        [BT_TRUNCATED_NORMAL] = {"mean", "sd", "lower", "upper"},
        [BT_LOGNORMAL] = {"mean", "sd"},
        [BT_UNIFORM] = {"lower", "upper"},
        [BT_TRIANGULAR] = {"lower", "mode", "upper"},
        [BT_WEIBULL] = {"scale", "shape", "lower"},
        [BT_GUMBEL] = {"mode", "scale"},
        [BT_EXPONENTIAL] = {"mean", "lower"},
        [BT_CONSTANT] = {"mean"},
    };
    return parameters[kind];
}

/// The share of the parent normal between the bounds, without cancellation in either tail.
static double truncated_share(const bt_distribution* d) {
    const double a = (d->lower - d->mean) / d->sd, b = (d->upper - d->mean) / d->sd;
    return a > 0 ? gsl_cdf_ugaussian_Q(a) - gsl_cdf_ugaussian_Q(b)
                 : gsl_cdf_ugaussian_P(b) - gsl_cdf_ugaussian_P(a);
}

static const char* check_finite(const bt_distribution* d) {
    const bool one_sided = d->kind == BT_TRUNCATED_NORMAL && (isinf(d->lower) || isinf(d->upper));
    const double values[] = {
        d->mean,  d->sd,   one_sided ? 0 : d->lower, one_sided ? 0 : d->upper, d->mode,
        d->scale, d->shape};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; ++i)
        if (!isfinite(values[i]))
            return "a parameter is not finite";
    return NULL;
}

const char* bt_distribution_check(const bt_distribution* d) {
    if (check_finite(d))
        return check_finite(d);
    switch (d->kind) {
    case BT_NORMAL:
        return d->sd > 0 ? NULL : "sd must be positive";
    case BT_TRUNCATED_NORMAL:
        if (!(d->sd > 0))
            return "sd must be positive";
        if (!(d->lower < d->upper))
            return "lower must be below upper";
        if (isinf(d->lower) && isinf(d->upper))
            return "lower or upper is missing; one of them is needed";
        return truncated_share(d) > 1e-290 ? NULL : "the bounds leave nothing of the normal";
    case BT_LOGNORMAL:
        if (!(d->mean > 0))
            return "mean must be positive";
        return d->sd > 0 ? NULL : "sd must be positive";
    case BT_UNIFORM:
        return d->lower < d->upper ? NULL : "lower must be below upper";
    case BT_TRIANGULAR:
        if (!(d->lower < d->upper))
            return "lower must be below upper";
        return d->lower <= d->mode && d->mode <= d->upper ? NULL
                                                          : "mode must lie in lower .. upper";
    case BT_WEIBULL:
        if (!(d->scale > 0))
            return "scale must be positive";
        return d->shape > 0 ? NULL : "shape must be positive";
    case BT_GUMBEL:
        return d->scale > 0 ? NULL : "scale must be positive";
    case BT_EXPONENTIAL:
        return d->lower < d->mean ? NULL : "mean must be above lower";
    case BT_CONSTANT:
        return NULL;
    case BT_DISTRIBUTION_KINDS:
        break;
    }
    return "unknown distribution";
}

static double truncated_quantile(const bt_distribution* d, double u) {
    const double a = (d->lower - d->mean) / d->sd, b = (d->upper - d->mean) / d->sd;
    double z;
    if (a > 0) { // upper tail: count from above, where the digits are
        const double qa = gsl_cdf_ugaussian_Q(a), qb = gsl_cdf_ugaussian_Q(b);
        z = gsl_cdf_ugaussian_Qinv(qa - u * (qa - qb));
    } else {
        const double pa = gsl_cdf_ugaussian_P(a), pb = gsl_cdf_ugaussian_P(b);
        z = gsl_cdf_ugaussian_Pinv(pa + u * (pb - pa));
    }
    return fmin(fmax(d->mean + d->sd * z, d->lower), d->upper);
}

static double triangular_quantile(const bt_distribution* d, double u) {
    const double width = d->upper - d->lower, rise = d->mode - d->lower;
    if (u * width < rise)
        return d->lower + sqrt(u * width * rise);
    return d->upper - sqrt((1 - u) * width * (d->upper - d->mode));
}

/// ln X is N(log_mean, log_sd^2).
static void lognormal_logs(const bt_distribution* d, double* log_mean, double* log_sd) {
    const double ratio = d->sd / d->mean;
    const double variance = log1p(ratio * ratio);
    *log_mean = log(d->mean) - variance / 2;
    *log_sd = sqrt(variance);
}

double bt_distribution_quantile(const bt_distribution* d, double u) {
    double log_mean, log_sd;
    switch (d->kind) {
    case BT_NORMAL:
        return d->mean + d->sd * gsl_cdf_ugaussian_Pinv(u);
    case BT_TRUNCATED_NORMAL:
        return truncated_quantile(d, u);
    case BT_LOGNORMAL:
        lognormal_logs(d, &log_mean, &log_sd);
        return exp(log_mean + log_sd * gsl_cdf_ugaussian_Pinv(u));
    case BT_UNIFORM:
        return d->lower + u * (d->upper - d->lower);
    case BT_TRIANGULAR:
        return triangular_quantile(d, u);
    case BT_WEIBULL:
        return d->lower + d->scale * pow(-log1p(-u), 1 / d->shape);
    case BT_GUMBEL:
        return d->mode - d->scale * log(-log(u));
    case BT_EXPONENTIAL:
        return d->lower - (d->mean - d->lower) * log1p(-u);
    case BT_CONSTANT:
        return d->mean;
    case BT_DISTRIBUTION_KINDS:
        break;
    }
    return NAN;
}

static double truncated_cdf(const bt_distribution* d, double x) {
    if (x <= d->lower)
        return 0;
    if (x >= d->upper)
        return 1;
    bt_distribution below = *d;
    below.upper = x;
    return truncated_share(&below) / truncated_share(d);
}

static double triangular_cdf(const bt_distribution* d, double x) {
    const double width = d->upper - d->lower;
    if (x <= d->lower)
        return 0;
    if (x >= d->upper)
        return 1;
    if (x < d->mode)
        return (x - d->lower) * (x - d->lower) / (width * (d->mode - d->lower));
    return 1 - (d->upper - x) * (d->upper - x) / (width * (d->upper - d->mode));
}

double bt_distribution_cdf(const bt_distribution* d, double x) {
    double log_mean, log_sd;
    switch (d->kind) {
    case BT_NORMAL:
        return gsl_cdf_ugaussian_P((x - d->mean) / d->sd);
    case BT_TRUNCATED_NORMAL:
        return truncated_cdf(d, x);
    case BT_LOGNORMAL:
        if (x <= 0)
            return 0;
        lognormal_logs(d, &log_mean, &log_sd);
        return gsl_cdf_ugaussian_P((log(x) - log_mean) / log_sd);
    case BT_UNIFORM:
        return fmin(fmax((x - d->lower) / (d->upper - d->lower), 0), 1);
    case BT_TRIANGULAR:
        return triangular_cdf(d, x);
    case BT_WEIBULL:
        return x <= d->lower ? 0 : -expm1(-pow((x - d->lower) / d->scale, d->shape));
    case BT_GUMBEL:
        return exp(-exp(-(x - d->mode) / d->scale));
    case BT_EXPONENTIAL:
        return x <= d->lower ? 0 : -expm1(-(x - d->lower) / (d->mean - d->lower));
    case BT_CONSTANT:
        return x >= d->mean;
    case BT_DISTRIBUTION_KINDS:
        break;
    }
    return NAN;
}

static const double LOG_ROOT_2PI = 0.91893853320467274178;

static double log_normal_density(double z, double sd) {
    return -0.5 * z * z - LOG_ROOT_2PI - log(sd);
}

static double triangular_log_density(const bt_distribution* d, double x) {
    if (x < d->lower || x > d->upper)
        return -INFINITY;
    const double peak = 2 / (d->upper - d->lower);
    if (x == d->mode)
        return log(peak);
    return log(x < d->mode ? peak * (x - d->lower) / (d->mode - d->lower)
                           : peak * (d->upper - x) / (d->upper - d->mode));
}

/// k / s t^(k-1) exp(-t^k), t = (x - lower) / s.
static double weibull_log_density(const bt_distribution* d, double x) {
    const double t = (x - d->lower) / d->scale;
    if (!(t > 0))
        return -INFINITY;
    return log(d->shape / d->scale) + (d->shape - 1) * log(t) - pow(t, d->shape);
}

double bt_distribution_log_density(const bt_distribution* d, double x) {
    double log_mean, log_sd, t;
    switch (d->kind) {
    case BT_NORMAL:
        return log_normal_density((x - d->mean) / d->sd, d->sd);
    case BT_TRUNCATED_NORMAL:
        return x < d->lower || x > d->upper
                   ? -INFINITY
                   : log_normal_density((x - d->mean) / d->sd, d->sd) - log(truncated_share(d));
    case BT_LOGNORMAL:
        if (x <= 0)
            return -INFINITY;
        lognormal_logs(d, &log_mean, &log_sd);
        return log_normal_density((log(x) - log_mean) / log_sd, log_sd) - log(x);
    case BT_UNIFORM:
        return x < d->lower || x > d->upper ? -INFINITY : -log(d->upper - d->lower);
    case BT_TRIANGULAR:
        return triangular_log_density(d, x);
    case BT_WEIBULL:
        return weibull_log_density(d, x);
    case BT_GUMBEL:
        t = (x - d->mode) / d->scale;
        return -t - exp(-t) - log(d->scale);
    case BT_EXPONENTIAL:
        t = (x - d->lower) / (d->mean - d->lower);
        return t < 0 ? -INFINITY : -t - log(d->mean - d->lower);
    case BT_CONSTANT:
        return x == d->mean ? 0 : -INFINITY;
    case BT_DISTRIBUTION_KINDS:
        break;
    }
    return NAN;
}

/// Mean of a truncated standard normal: (phi(a) - phi(b)) / Z; a narrow one has its middle.
static double truncated_mean(const bt_distribution* d) {
    const double a = (d->lower - d->mean) / d->sd, b = (d->upper - d->mean) / d->sd;
    if (b - a < 1e-4) // the density is 1 - m (z - m) about the middle m: off by m (b - a)^2 / 12
        return d->lower + (d->upper - d->lower) / 2;
    const double z = (gsl_ran_ugaussian_pdf(a) - gsl_ran_ugaussian_pdf(b)) / truncated_share(d);
    return fmin(fmax(d->mean + d->sd * z, d->lower), d->upper);
}

double bt_distribution_mean(const bt_distribution* d) {
    switch (d->kind) {
    case BT_NORMAL:
    case BT_LOGNORMAL:
    case BT_EXPONENTIAL:
    case BT_CONSTANT:
        return d->mean;
    case BT_TRUNCATED_NORMAL:
        return truncated_mean(d);
    case BT_UNIFORM:
        return d->lower + (d->upper - d->lower) / 2;
    case BT_TRIANGULAR:
        return (d->lower + d->mode + d->upper) / 3;
    case BT_WEIBULL:
        return d->lower + d->scale * tgamma(1 + 1 / d->shape);
    case BT_GUMBEL:
        return d->mode + EULER_GAMMA * d->scale;
    case BT_DISTRIBUTION_KINDS:
        break;
    }
    return NAN;
}

bt_distribution bt_distribution_moved(const bt_distribution* d, double mean) {
    bt_distribution moved = *d;
    if (d->kind == BT_LOGNORMAL) { // its sd is kept, its support still begins at zero
        moved.mean = mean;
        return moved;
    }
    const double by = mean - bt_distribution_mean(d);
    const bool direct = d->kind == BT_NORMAL || d->kind == BT_CONSTANT || d->kind == BT_EXPONENTIAL;
    moved.mean = direct ? mean : d->mean + by;
    moved.lower += by;
    moved.upper += by;
    moved.mode += by;
    return moved;
}
