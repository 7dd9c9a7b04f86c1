#include "calibration/evaluate.h"
#include "calibration/identify.h"

#include <gsl/gsl_qrng.h>
#include <math.h>
#include <nlopt.h>
#include <stdlib.h>
#include <string.h>

/// Width of a finite difference, of a parameter's range.
static const double difference_width = 0.005;

/// Everything of one fit.
typedef struct search {
    const bt_calibration* c;
    int n, m; ///< parameters, rows
    const atomic_int* stop;
    bt_diag* diag;
    double u[BT_PARAMETER_MAX]; ///< the best so far
    double cost;
    double *rows, *trial, *shifted; ///< [m], [m], [n][m]
    double* jacobian;               ///< [m][n]
    double* weight;                 ///< [m]
    bool* one_sided;                ///< [m]
    double got[BT_TARGET_MAX];
    int steps, evaluations;
    bool converged;
} search;

// --- cost -------------------------------------------------------------------------------------

static double range(const bt_parameter* p) {
    return p->upper - p->lower;
}

/// Belief about one parameter, (p - start) / spread, and its slope over u.
static double belief(const bt_parameter* p, double u, double* slope) {
    *slope = p->spread > 0 ? range(p) / p->spread : 0;
    return *slope * (u - (p->start - p->lower) / range(p));
}

static double cost_of(const search* s, const double* u, const double* rows) {
    double sum = 0, slope;
    for (int i = 0; i < s->m; ++i) {
        const double r = s->one_sided[i] ? fmax(0, rows[i]) : rows[i];
        if (isnan(rows[i]))
            return INFINITY;
        sum += s->weight[i] * r * r;
    }
    for (int k = 0; k < s->n; ++k) {
        const double b = belief(&s->c->parameters[k], u[k], &slope);
        sum += b * b;
    }
    return 0.5 * sum;
}

/// The cost of the linearised model at u + step, and its gradient over the step (NLopt's shape).
static double linear_cost(unsigned n, const double* step, double* gradient, void* user) {
    const search* s = user;
    double sum = 0, slope;
    for (unsigned k = 0; gradient && k < n; ++k)
        gradient[k] = 0;
    for (int i = 0; i < s->m; ++i) {
        const double* j = s->jacobian + (size_t)i * n;
        double r = s->rows[i];
        for (unsigned k = 0; k < n; ++k)
            r += j[k] * step[k];
        if (s->one_sided[i] && r < 0)
            continue;
        sum += s->weight[i] * r * r;
        for (unsigned k = 0; gradient && k < n; ++k)
            gradient[k] += s->weight[i] * r * j[k];
    }
    for (unsigned k = 0; k < n; ++k) {
        const double b = belief(&s->c->parameters[k], s->u[k] + step[k], &slope);
        sum += b * b;
        if (gradient)
            gradient[k] += b * slope;
    }
    return 0.5 * sum;
}

// --- steps ------------------------------------------------------------------------------------

static bt_status evaluate(search* s, const double* u, int points, double* rows, double* got,
                          bt_diag* diag) {
    s->evaluations += points;
    return bt_calibration_evaluate(s->c, u, points, s->stop, rows, got, diag);
}

/// Slopes of all rows by differences towards the inside of the bounds.
static bt_status find_jacobian(search* s) {
    const int n = s->n;
    double u[BT_PARAMETER_MAX * BT_PARAMETER_MAX], width[BT_PARAMETER_MAX];
    for (int k = 0; k < n; ++k) {
        memcpy(u + k * n, s->u, (size_t)n * sizeof *u);
        width[k] = s->u[k] + difference_width <= 1 ? difference_width : -difference_width;
        u[k * n + k] += width[k];
    }
    BT_TRY(evaluate(s, u, n, s->shifted, NULL, NULL));
    for (int i = 0; i < s->m; ++i)
        for (int k = 0; k < n; ++k) {
            const double change = s->shifted[(size_t)k * (size_t)s->m + (size_t)i] - s->rows[i];
            s->jacobian[i * n + k] = isfinite(change) ? change / width[k] : 0;
        }
    return BT_OK;
}

/// The best step of the linearised model within the bounds and within `radius` of each parameter.
static bt_status best_step(const search* s, double radius, double* step, double* predicted) {
    double least[BT_PARAMETER_MAX], most[BT_PARAMETER_MAX];
    nlopt_opt opt = nlopt_create(NLOPT_LD_SLSQP, (unsigned)s->n);
    if (!opt)
        return BT_ERR_MEMORY;
    for (int k = 0; k < s->n; ++k) {
        least[k] = fmax(-s->u[k], -radius);
        most[k] = fmin(1 - s->u[k], radius);
        step[k] = 0;
    }
    nlopt_set_min_objective(opt, linear_cost, (void*)s);
    nlopt_set_lower_bounds(opt, least);
    nlopt_set_upper_bounds(opt, most);
    nlopt_set_ftol_rel(opt, 1e-12);
    nlopt_set_xtol_rel(opt, 1e-10);
    nlopt_set_maxeval(opt, 500);
    const nlopt_result result = nlopt_optimize(opt, step, predicted);
    nlopt_destroy(opt);
    if (result == NLOPT_OUT_OF_MEMORY)
        return BT_ERR_MEMORY;
    // its best point so far is a step even where rounding stopped it
    *predicted = linear_cost((unsigned)s->n, step, NULL, (void*)s);
    return BT_OK;
}

/// One improvement from the present Jacobian: shrinks the radius until the cost falls.
/// *moved: how far, in the largest parameter; 0 when there is nothing more to gain.
static bt_status improve(search* s, double* radius, double* moved) {
    static const double least_radius = 1e-4, least_gain = 1e-3;
    double step[BT_PARAMETER_MAX], u[BT_PARAMETER_MAX], predicted;
    for (*moved = 0; *radius > least_radius;) {
        BT_TRY(best_step(s, *radius, step, &predicted));
        if (!(s->cost - predicted > least_gain * s->cost))
            return BT_OK;
        double length = 0;
        for (int k = 0; k < s->n; ++k) {
            u[k] = fmin(1, fmax(0, s->u[k] + step[k]));
            length = fmax(length, fabs(step[k]));
        }
        double got[BT_TARGET_MAX];
        BT_TRY(evaluate(s, u, 1, s->trial, got, NULL));
        const double cost = cost_of(s, u, s->trial);
        const double share = (s->cost - cost) / (s->cost - predicted);
        *radius = share > 0.75 ? fmin(1, 2 * *radius) : share < 0.25 ? 0.25 * length : *radius;
        if (!(share > 0.01))
            continue;
        s->cost = cost;
        *moved = length;
        memcpy(s->u, u, sizeof s->u);
        memcpy(s->got, got, sizeof s->got);
        memcpy(s->rows, s->trial, (size_t)s->m * sizeof *s->rows);
        return BT_OK;
    }
    return BT_OK;
}

/// Gauss-Newton with a trust region from s->u, whose rows and cost are known.
static bt_status descend(search* s, bt_fit_progress* progress, void* user) {
    static const double first_radius = 0.25, small_move = 1e-3, small_cost = 1e-6;
    double radius = first_radius, moved = 1;
    s->converged = false;
    for (int step = 0; step < s->c->steps && !s->converged; ++step) {
        BT_TRY(find_jacobian(s));
        BT_TRY(improve(s, &radius, &moved));
        s->converged = moved < small_move || s->cost < small_cost;
        s->steps += moved > 0;
        if (progress)
            progress(user, s->steps, s->cost);
    }
    return BT_OK;
}

// --- starts -----------------------------------------------------------------------------------

/// Targets without a value where the fit begins: nothing can be said about them.
static bt_status check_start(const search* s) {
    if (isfinite(s->cost))
        return BT_OK;
    for (int i = 0; i < s->c->target_count; ++i) {
        const bt_target* t = &s->c->targets[i];
        for (int k = 0; k < t->row_count; ++k)
            if (isnan(s->rows[t->first_row + k])) {
                bt_diag_add(s->diag, BT_ERROR, t->where,
                            "%s: the model gives no value for it with the parameters at their "
                            "start (the run failed, ended too early, or had no bounce)",
                            t->name);
                break;
            }
    }
    return BT_ERR_INPUT;
}

static bt_status begin_at(search* s, const double* u, bt_diag* diag) {
    memcpy(s->u, u, (size_t)s->n * sizeof *u);
    BT_TRY(evaluate(s, s->u, 1, s->rows, s->got, diag));
    s->cost = cost_of(s, s->u, s->rows);
    return BT_OK;
}

/// The given start, then points of Sobol's sequence; the best end counts.
static bt_status search_all(search* s, bt_fit* fit, bt_fit_progress* progress, void* user) {
    double u[BT_PARAMETER_MAX], best[BT_PARAMETER_MAX], best_cost = INFINITY;
    memcpy(best, s->u, sizeof best);
    gsl_qrng* points = gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)s->n);
    if (!points)
        return BT_ERR_MEMORY;
    bt_status status = BT_OK;
    for (int i = 0; i < s->c->starts && status == BT_OK; ++i) {
        if (i == 0)
            memcpy(u, s->u, sizeof u);
        else
            gsl_qrng_get(points, u);
        if (i > 0)
            status = begin_at(s, u, NULL);
        if (status == BT_OK && isfinite(s->cost))
            status = descend(s, progress, user);
        if (s->cost < best_cost) {
            best_cost = s->cost;
            fit->converged = s->converged;
            memcpy(best, s->u, sizeof best);
        }
    }
    gsl_qrng_free(points);
    const bt_status stopped = status;
    if (status != BT_OK && status != BT_ERR_INTERRUPTED)
        return status;
    memcpy(s->u, best, sizeof best);
    s->cost = best_cost;
    return stopped;
}

// --- result -----------------------------------------------------------------------------------

static void judge_targets(const search* s, bt_target_fit* out) {
    for (int i = 0; i < s->c->target_count; ++i) {
        const bt_target* t = &s->c->targets[i];
        double worst = 0, squares = 0;
        for (int k = 0; k < t->row_count; ++k) {
            const double row = s->rows[t->first_row + k];
            const double r = bt_target_is_one_sided(t) ? fmax(0, row) : row;
            worst = fabs(r) > fabs(worst) ? r : worst;
            squares += r * r;
        }
        out[i].got = s->got[i];
        out[i].residual = t->kind == BT_TARGET_CURVE ? sqrt(squares / t->row_count) : worst;
        // a trend allows its tolerance already; a bound is a bound
        out[i].met = fabs(out[i].residual) <= (bt_target_is_one_sided(t) ? 1e-3 : 1);
    }
}

static void store_values(const search* s, bt_fit* fit) {
    for (int k = 0; k < s->n; ++k) {
        const bt_parameter* p = &s->c->parameters[k];
        fit->value[k] = p->lower + s->u[k] * range(p);
    }
    fit->cost = s->cost;
    fit->steps = s->steps;
    fit->evaluations = s->evaluations;
    fit->landings = s->evaluations * s->c->case_count;
}

static bool allocate(search* s) {
    const size_t m = (size_t)s->m, n = (size_t)s->n;
    s->rows = calloc(m, sizeof *s->rows);
    s->trial = calloc(m, sizeof *s->trial);
    s->shifted = calloc(m * n, sizeof *s->shifted);
    s->jacobian = calloc(m * n, sizeof *s->jacobian);
    s->weight = calloc(m, sizeof *s->weight);
    s->one_sided = calloc(m, sizeof *s->one_sided);
    if (!s->rows || !s->trial || !s->shifted || !s->jacobian || !s->weight || !s->one_sided)
        return false;
    for (int i = 0; i < s->c->target_count; ++i) {
        const bt_target* t = &s->c->targets[i];
        for (int k = 0; k < t->row_count; ++k) {
            s->weight[t->first_row + k] =
                t->weight / (t->kind == BT_TARGET_CURVE ? t->row_count : 1);
            s->one_sided[t->first_row + k] = bt_target_is_one_sided(t);
        }
    }
    return true;
}

static void release(search* s) {
    free(s->rows);
    free(s->trial);
    free(s->shifted);
    free(s->jacobian);
    free(s->weight);
    free(s->one_sided);
}

/// The fit of an allocated search.
static bt_status run_fit(search* s, bt_fit* fit, bt_fit_progress* progress, void* user) {
    double u[BT_PARAMETER_MAX];
    for (int k = 0; k < s->n; ++k) {
        const bt_parameter* p = &s->c->parameters[k];
        u[k] = (p->start - p->lower) / range(p);
    }
    BT_TRY(begin_at(s, u, s->diag));
    BT_TRY(check_start(s));
    judge_targets(s, fit->before);
    fit->start_cost = s->cost;
    const bt_status found = search_all(s, fit, progress, user);
    store_values(s, fit);
    if (found != BT_OK)
        return found;
    memcpy(u, s->u, sizeof u);
    BT_TRY(begin_at(s, u, s->diag));
    BT_TRY(find_jacobian(s));
    judge_targets(s, fit->targets);
    store_values(s, fit);
    return bt_fit_identify(s->c, s->rows, s->jacobian, s->weight, fit);
}

bt_status bt_calibration_fit(const bt_calibration* calibration, bt_fit* fit, const atomic_int* stop,
                             bt_fit_progress* progress, void* user, bt_diag* diag) {
    *fit = (bt_fit){0};
    search s = {.c = calibration,
                .n = calibration->parameter_count,
                .m = calibration->row_count,
                .stop = stop,
                .diag = diag};
    const bt_status status = allocate(&s) ? run_fit(&s, fit, progress, user) : BT_ERR_MEMORY;
    release(&s);
    return status;
}
