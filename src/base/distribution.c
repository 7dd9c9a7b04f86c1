#include "base/distribution.h"

#include "base/families.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stddef.h>

#define NAME(NAME, name) #name,
const char* const bt_distribution_names[] = {BT_DISTRIBUTIONS(NAME)(const char*) 0};

#define FAMILY(NAME, name) [BT_##NAME] = &bt_family_##name,
static const bt_family* const families[BT_DISTRIBUTION_KINDS] = {BT_DISTRIBUTIONS(FAMILY)};

const char* const* bt_distribution_parameters(bt_distribution_kind kind) {
    return families[kind]->parameters;
}

static bool is_finite(const bt_distribution* d) {
    const bool one_sided = d->kind == BT_TRUNCATED_NORMAL && (isinf(d->lower) || isinf(d->upper));
    const double values[] = {
        d->mean,  d->sd,   one_sided ? 0 : d->lower, one_sided ? 0 : d->upper, d->mode,
        d->scale, d->shape};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; ++i)
        if (!isfinite(values[i]))
            return false;
    return true;
}

const char* bt_distribution_check(const bt_distribution* d) {
    return is_finite(d) ? families[d->kind]->check(d) : "a parameter is not finite";
}

double bt_distribution_quantile(const bt_distribution* d, double u) {
    return families[d->kind]->quantile(d, u);
}

double bt_distribution_cdf(const bt_distribution* d, double x) {
    return families[d->kind]->cdf(d, x);
}

double bt_distribution_log_density(const bt_distribution* d, double x) {
    return families[d->kind]->log_density(d, x);
}

double bt_distribution_mean(const bt_distribution* d) {
    return families[d->kind]->mean(d);
}

bool bt_distribution_has_atoms(const bt_distribution* d) {
    return d->kind == BT_CONSTANT || d->kind == BT_DISCRETE ||
           (d->kind == BT_EMPIRICAL && !bt_sample_is_smooth(d->sample));
}

double bt_distribution_score(const bt_distribution* d, double x) {
    double log_mean, log_sd;
    switch (d->kind) {
    case BT_NORMAL:
        return (x - d->mean) / d->sd;
    case BT_LOGNORMAL:
        bt_lognormal_logs(d, &log_mean, &log_sd);
        return (log(x) - log_mean) / log_sd;
    default:
        return gsl_cdf_ugaussian_Pinv(fmin(fmax(bt_distribution_cdf(d, x), 0x1p-53), 1 - 0x1p-53));
    }
}

double bt_distribution_at_score(const bt_distribution* d, double score) {
    double log_mean, log_sd;
    switch (d->kind) {
    case BT_NORMAL:
        return d->mean + d->sd * score;
    case BT_LOGNORMAL:
        bt_lognormal_logs(d, &log_mean, &log_sd);
        return exp(log_mean + log_sd * score);
    default:
        return bt_distribution_quantile(
            d, fmin(fmax(gsl_cdf_ugaussian_P(score), 0x1p-53), 1 - 0x1p-53));
    }
}

bt_distribution bt_distribution_moved(const bt_distribution* d, double mean) {
    bt_distribution moved = *d;
    const bt_family_move move = families[d->kind]->move;
    if (move == BT_MOVE_ALONE) {
        moved.mean = mean;
        return moved;
    }
    const double now = bt_distribution_mean(d), by = mean - now;
    if (move == BT_MOVE_SCALE) {
        moved.lower = d->lower * (mean / now);
        moved.upper = d->upper * (mean / now);
        return moved;
    }
    moved.mean = move == BT_MOVE_MEAN ? mean : d->mean + by;
    moved.lower += by;
    moved.upper += by;
    moved.mode += by;
    return moved;
}
