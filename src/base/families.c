/// Families whose quantiles have a closed form, or the library's.
#include "base/families.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <math.h>
#include <stddef.h>

static const double EULER_GAMMA = 0.57721566490153286061;
static const double LOG_ROOT_2PI = 0.91893853320467274178;

double bt_log_normal_density(double z, double sd) {
    return -0.5 * z * z - LOG_ROOT_2PI - log(sd);
}

static double mean_parameter(const bt_distribution* d) {
    return d->mean;
}

static const char* check_sd(const bt_distribution* d) {
    return d->sd > 0 ? NULL : "sd must be positive";
}

static const char* check_scale(const bt_distribution* d) {
    return d->scale > 0 ? NULL : "scale must be positive";
}

static const char* check_bounds(const bt_distribution* d) {
    return d->lower < d->upper ? NULL : "lower must be below upper";
}

// --- normal ---------------------------------------------------------------------------------

static double normal_quantile(const bt_distribution* d, double u) {
    return d->mean + d->sd * gsl_cdf_ugaussian_Pinv(u);
}

static double normal_cdf(const bt_distribution* d, double x) {
    return gsl_cdf_ugaussian_P((x - d->mean) / d->sd);
}

static double normal_log_density(const bt_distribution* d, double x) {
    return bt_log_normal_density((x - d->mean) / d->sd, d->sd);
}

const bt_family bt_family_normal = {{"mean", "sd"},     check_sd,       normal_quantile, normal_cdf,
                                    normal_log_density, mean_parameter, BT_MOVE_MEAN};

// --- truncated normal -----------------------------------------------------------------------

/// The share of the parent normal between the bounds, without cancellation in either tail.
static double truncated_share(const bt_distribution* d) {
    const double a = (d->lower - d->mean) / d->sd, b = (d->upper - d->mean) / d->sd;
    return a > 0 ? gsl_cdf_ugaussian_Q(a) - gsl_cdf_ugaussian_Q(b)
                 : gsl_cdf_ugaussian_P(b) - gsl_cdf_ugaussian_P(a);
}

static const char* check_truncated(const bt_distribution* d) {
    if (!(d->sd > 0))
        return "sd must be positive";
    if (!(d->lower < d->upper))
        return "lower must be below upper";
    if (isinf(d->lower) && isinf(d->upper))
        return "lower or upper is missing; one of them is needed";
    return truncated_share(d) > 1e-290 ? NULL : "the bounds leave nothing of the normal";
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

static double truncated_cdf(const bt_distribution* d, double x) {
    if (x <= d->lower)
        return 0;
    if (x >= d->upper)
        return 1;
    bt_distribution below = *d;
    below.upper = x;
    return truncated_share(&below) / truncated_share(d);
}

static double truncated_log_density(const bt_distribution* d, double x) {
    return x < d->lower || x > d->upper
               ? -INFINITY
               : bt_log_normal_density((x - d->mean) / d->sd, d->sd) - log(truncated_share(d));
}

/// Mean of a truncated standard normal: (phi(a) - phi(b)) / Z; a narrow one has its middle.
static double truncated_mean(const bt_distribution* d) {
    const double a = (d->lower - d->mean) / d->sd, b = (d->upper - d->mean) / d->sd;
    if (b - a < 1e-4) // the density is 1 - m (z - m) about the middle m: off by m (b - a)^2 / 12
        return d->lower + (d->upper - d->lower) / 2;
    const double z = (gsl_ran_ugaussian_pdf(a) - gsl_ran_ugaussian_pdf(b)) / truncated_share(d);
    return fmin(fmax(d->mean + d->sd * z, d->lower), d->upper);
}

const bt_family bt_family_truncated_normal = {{"mean", "sd", "lower", "upper"},
                                              check_truncated,
                                              truncated_quantile,
                                              truncated_cdf,
                                              truncated_log_density,
                                              truncated_mean,
                                              BT_MOVE_ALL};

// --- lognormal ------------------------------------------------------------------------------

static const char* check_lognormal(const bt_distribution* d) {
    return d->mean > 0 ? check_sd(d) : "mean must be positive";
}

void bt_lognormal_logs(const bt_distribution* d, double* log_mean, double* log_sd) {
    const double ratio = d->sd / d->mean;
    const double variance = log1p(ratio * ratio);
    *log_mean = log(d->mean) - variance / 2;
    *log_sd = sqrt(variance);
}

static double lognormal_quantile(const bt_distribution* d, double u) {
    double log_mean, log_sd;
    bt_lognormal_logs(d, &log_mean, &log_sd);
    return exp(log_mean + log_sd * gsl_cdf_ugaussian_Pinv(u));
}

static double lognormal_cdf(const bt_distribution* d, double x) {
    double log_mean, log_sd;
    if (x <= 0)
        return 0;
    bt_lognormal_logs(d, &log_mean, &log_sd);
    return gsl_cdf_ugaussian_P((log(x) - log_mean) / log_sd);
}

static double lognormal_log_density(const bt_distribution* d, double x) {
    double log_mean, log_sd;
    if (x <= 0)
        return -INFINITY;
    bt_lognormal_logs(d, &log_mean, &log_sd);
    return bt_log_normal_density((log(x) - log_mean) / log_sd, log_sd) - log(x);
}

const bt_family bt_family_lognormal = {{"mean", "sd"}, check_lognormal,       lognormal_quantile,
                                       lognormal_cdf,  lognormal_log_density, mean_parameter,
                                       BT_MOVE_ALONE};

// --- uniform, triangular --------------------------------------------------------------------

static double uniform_quantile(const bt_distribution* d, double u) {
    return d->lower + u * (d->upper - d->lower);
}

static double uniform_cdf(const bt_distribution* d, double x) {
    return fmin(fmax((x - d->lower) / (d->upper - d->lower), 0), 1);
}

static double uniform_log_density(const bt_distribution* d, double x) {
    return x < d->lower || x > d->upper ? -INFINITY : -log(d->upper - d->lower);
}

static double uniform_mean(const bt_distribution* d) {
    return d->lower + (d->upper - d->lower) / 2;
}

const bt_family bt_family_uniform = {{"lower", "upper"}, check_bounds,        uniform_quantile,
                                     uniform_cdf,        uniform_log_density, uniform_mean,
                                     BT_MOVE_ALL};

static const char* check_triangular(const bt_distribution* d) {
    if (!(d->lower < d->upper))
        return "lower must be below upper";
    return d->lower <= d->mode && d->mode <= d->upper ? NULL : "mode must lie in lower .. upper";
}

static double triangular_quantile(const bt_distribution* d, double u) {
    const double width = d->upper - d->lower, rise = d->mode - d->lower;
    if (u * width < rise)
        return d->lower + sqrt(u * width * rise);
    return d->upper - sqrt((1 - u) * width * (d->upper - d->mode));
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

static double triangular_log_density(const bt_distribution* d, double x) {
    if (x < d->lower || x > d->upper)
        return -INFINITY;
    const double peak = 2 / (d->upper - d->lower);
    if (x == d->mode)
        return log(peak);
    return log(x < d->mode ? peak * (x - d->lower) / (d->mode - d->lower)
                           : peak * (d->upper - x) / (d->upper - d->mode));
}

static double triangular_mean(const bt_distribution* d) {
    return (d->lower + d->mode + d->upper) / 3;
}

const bt_family bt_family_triangular = {
    {"lower", "mode", "upper"}, check_triangular, triangular_quantile, triangular_cdf,
    triangular_log_density,     triangular_mean,  BT_MOVE_ALL};

// --- Weibull, Gumbel, exponential -----------------------------------------------------------

static const char* check_weibull(const bt_distribution* d) {
    if (check_scale(d))
        return check_scale(d);
    return d->shape > 0 ? NULL : "shape must be positive";
}

static double weibull_quantile(const bt_distribution* d, double u) {
    return d->lower + d->scale * pow(-log1p(-u), 1 / d->shape);
}

static double weibull_cdf(const bt_distribution* d, double x) {
    return x <= d->lower ? 0 : -expm1(-pow((x - d->lower) / d->scale, d->shape));
}

/// k / s t^(k-1) exp(-t^k), t = (x - lower) / s.
static double weibull_log_density(const bt_distribution* d, double x) {
    const double t = (x - d->lower) / d->scale;
    if (!(t > 0))
        return -INFINITY;
    return log(d->shape / d->scale) + (d->shape - 1) * log(t) - pow(t, d->shape);
}

static double weibull_mean(const bt_distribution* d) {
    return d->lower + d->scale * tgamma(1 + 1 / d->shape);
}

const bt_family bt_family_weibull = {
    {"scale", "shape", "lower"}, check_weibull, weibull_quantile, weibull_cdf,
    weibull_log_density,         weibull_mean,  BT_MOVE_ALL};

static double gumbel_quantile(const bt_distribution* d, double u) {
    return d->mode - d->scale * log(-log(u));
}

static double gumbel_cdf(const bt_distribution* d, double x) {
    return exp(-exp(-(x - d->mode) / d->scale));
}

static double gumbel_log_density(const bt_distribution* d, double x) {
    const double t = (x - d->mode) / d->scale;
    return -t - exp(-t) - log(d->scale);
}

static double gumbel_mean(const bt_distribution* d) {
    return d->mode + EULER_GAMMA * d->scale;
}

const bt_family bt_family_gumbel = {{"mode", "scale"},  check_scale, gumbel_quantile, gumbel_cdf,
                                    gumbel_log_density, gumbel_mean, BT_MOVE_ALL};

static const char* check_exponential(const bt_distribution* d) {
    return d->lower < d->mean ? NULL : "mean must be above lower";
}

static double exponential_quantile(const bt_distribution* d, double u) {
    return d->lower - (d->mean - d->lower) * log1p(-u);
}

static double exponential_cdf(const bt_distribution* d, double x) {
    return x <= d->lower ? 0 : -expm1(-(x - d->lower) / (d->mean - d->lower));
}

static double exponential_log_density(const bt_distribution* d, double x) {
    const double t = (x - d->lower) / (d->mean - d->lower);
    return t < 0 ? -INFINITY : -t - log(d->mean - d->lower);
}

const bt_family bt_family_exponential = {
    {"mean", "lower"},       check_exponential, exponential_quantile, exponential_cdf,
    exponential_log_density, mean_parameter,    BT_MOVE_MEAN};

// --- Rayleigh -------------------------------------------------------------------------------

static double rayleigh_quantile(const bt_distribution* d, double u) {
    return d->lower + d->scale * sqrt(-2 * log1p(-u));
}

static double rayleigh_cdf(const bt_distribution* d, double x) {
    const double t = (x - d->lower) / d->scale;
    return t <= 0 ? 0 : -expm1(-0.5 * t * t);
}

static double rayleigh_log_density(const bt_distribution* d, double x) {
    const double t = (x - d->lower) / d->scale;
    return t > 0 ? log(t) - 0.5 * t * t - log(d->scale) : -INFINITY;
}

static double rayleigh_mean(const bt_distribution* d) {
    return d->lower + d->scale * sqrt(M_PI_2);
}

const bt_family bt_family_rayleigh = {{"scale", "lower"}, check_scale,          rayleigh_quantile,
                                      rayleigh_cdf,       rayleigh_log_density, rayleigh_mean,
                                      BT_MOVE_ALL};

// --- logistic -------------------------------------------------------------------------------

static double logistic_scale(const bt_distribution* d) {
    return d->sd * sqrt(3) / M_PI;
}

static double logistic_quantile(const bt_distribution* d, double u) {
    return d->mean + logistic_scale(d) * (log(u) - log1p(-u));
}

static double logistic_cdf(const bt_distribution* d, double x) {
    return 1 / (1 + exp(-(x - d->mean) / logistic_scale(d)));
}

static double logistic_log_density(const bt_distribution* d, double x) {
    const double t = fabs(x - d->mean) / logistic_scale(d); // symmetric
    return -t - 2 * log1p(exp(-t)) - log(logistic_scale(d));
}

const bt_family bt_family_logistic = {
    {"mean", "sd"},       check_sd,       logistic_quantile, logistic_cdf,
    logistic_log_density, mean_parameter, BT_MOVE_MEAN};

// --- log-uniform ----------------------------------------------------------------------------

static const char* check_log_uniform(const bt_distribution* d) {
    if (!(d->lower > 0))
        return "lower must be positive";
    return check_bounds(d);
}

static double log_uniform_quantile(const bt_distribution* d, double u) {
    return fmin(fmax(d->lower * exp(u * log(d->upper / d->lower)), d->lower), d->upper);
}

static double log_uniform_cdf(const bt_distribution* d, double x) {
    return x <= d->lower ? 0 : fmin(log(x / d->lower) / log(d->upper / d->lower), 1);
}

static double log_uniform_log_density(const bt_distribution* d, double x) {
    return x < d->lower || x > d->upper ? -INFINITY : -log(x) - log(log(d->upper / d->lower));
}

static double log_uniform_mean(const bt_distribution* d) {
    return (d->upper - d->lower) / log(d->upper / d->lower);
}

const bt_family bt_family_log_uniform = {
    {"lower", "upper"},      check_log_uniform, log_uniform_quantile, log_uniform_cdf,
    log_uniform_log_density, log_uniform_mean,  BT_MOVE_SCALE};

// --- constant -------------------------------------------------------------------------------

static const char* check_nothing(const bt_distribution* d) {
    (void)d;
    return NULL;
}

static double constant_quantile(const bt_distribution* d, double u) {
    (void)u;
    return d->mean;
}

static double constant_cdf(const bt_distribution* d, double x) {
    return x >= d->mean;
}

static double constant_log_density(const bt_distribution* d, double x) {
    return x == d->mean ? 0 : -INFINITY;
}

const bt_family bt_family_constant = {{"mean"},     check_nothing,        constant_quantile,
                                      constant_cdf, constant_log_density, mean_parameter,
                                      BT_MOVE_MEAN};
