#include "calibration/identify.h"

#include "calibration/evaluate.h"

#include <gsl/gsl_linalg.h>
#include <math.h>

/// Inverse variance of a number of which only the bounds 0 and 1 are known.
static const double bounds_information = 12;

static bool is_silent(const bt_target* t, double row) {
    return bt_target_is_one_sided(t) && !(row > 0);
}

/// Of each target: the row that moves most; of a curve the root mean square of its rows.
static void find_sensitivity(const bt_calibration* c, const double* rows, const double* jacobian,
                             bt_fit* fit) {
    const int n = c->parameter_count;
    for (int i = 0; i < c->target_count; ++i)
        for (int k = 0; k < n; ++k) {
            const bt_target* t = &c->targets[i];
            double most = 0, squares = 0;
            for (int r = t->first_row; r < t->first_row + t->row_count; ++r) {
                const double slope = is_silent(t, rows[r]) ? 0 : jacobian[r * n + k];
                most = fabs(slope) > fabs(most) ? slope : most;
                squares += slope * slope;
            }
            fit->sensitivity[i][k] =
                t->kind == BT_TARGET_CURVE ? sqrt(squares / t->row_count) : most;
        }
}

/// The weighted Jacobian, with zero rows where there are fewer rows than parameters.
static gsl_matrix* make_matrix(const bt_calibration* c, const double* rows, const double* jacobian,
                               const double* weight) {
    const int n = c->parameter_count, m = c->row_count;
    gsl_matrix* a = gsl_matrix_calloc((size_t)(m > n ? m : n), (size_t)n);
    for (int i = 0; a && i < c->target_count; ++i) {
        const bt_target* t = &c->targets[i];
        for (int r = t->first_row; r < t->first_row + t->row_count; ++r)
            for (int k = 0; k < n && !is_silent(t, rows[r]); ++k)
                gsl_matrix_set(a, (size_t)r, (size_t)k, sqrt(weight[r]) * jacobian[r * n + k]);
    }
    return a;
}

/// The one criterion, for a parameter and for a combination of them alike: a standard error below
/// half of the one before any data. Where all combinations meet it, every parameter does.
static bool is_identified(double variance) {
    return sqrt(variance * bounds_information) < 0.5;
}

static void store_directions(int n, const gsl_vector* s, const gsl_matrix* v, bt_fit* fit) {
    for (int i = 0; i < n; ++i) {
        fit->singular[i] = gsl_vector_get(s, (size_t)i);
        const double information = fit->singular[i] * fit->singular[i] + bounds_information;
        fit->identified_directions += is_identified(1 / information);
        // the sign of a direction is free: its largest part is made positive
        int largest = 0;
        for (int k = 0; k < n; ++k) {
            fit->direction[i][k] = gsl_matrix_get(v, (size_t)k, (size_t)i);
            if (fabs(fit->direction[i][k]) > fabs(fit->direction[i][largest]) + 1e-12)
                largest = k;
        }
        if (fit->direction[i][largest] < 0)
            for (int k = 0; k < n; ++k)
                fit->direction[i][k] = -fit->direction[i][k];
    }
}

static double covariance(const bt_fit* fit, int n, int a, int b) {
    double sum = 0;
    for (int i = 0; i < n; ++i)
        sum += fit->direction[i][a] * fit->direction[i][b] /
               (fit->singular[i] * fit->singular[i] + bounds_information);
    return sum;
}

static void store_errors(const bt_calibration* c, bt_fit* fit) {
    const int n = c->parameter_count;
    for (int a = 0; a < n; ++a) {
        const double variance = covariance(fit, n, a, a);
        fit->standard_error[a] = sqrt(variance) * (c->parameters[a].upper - c->parameters[a].lower);
        fit->identified[a] = is_identified(variance);
        for (int b = 0; b < n; ++b)
            fit->correlation[a][b] =
                covariance(fit, n, a, b) / sqrt(variance * covariance(fit, n, b, b));
    }
}

bt_status bt_fit_identify(const bt_calibration* calibration, const double* rows,
                          const double* jacobian, const double* weight, bt_fit* fit) {
    const int n = calibration->parameter_count;
    find_sensitivity(calibration, rows, jacobian, fit);
    gsl_matrix* a = make_matrix(calibration, rows, jacobian, weight);
    gsl_matrix* v = gsl_matrix_alloc((size_t)n, (size_t)n);
    gsl_vector* s = gsl_vector_alloc((size_t)n);
    bt_status status = BT_ERR_MEMORY;
    if (a && v && s)
        status = gsl_linalg_SV_decomp_jacobi(a, v, s) == 0 ? BT_OK : BT_ERR_NUMERIC;
    if (status == BT_OK) {
        store_directions(n, s, v, fit);
        store_errors(calibration, fit);
    }
    gsl_vector_free(s);
    gsl_matrix_free(v);
    gsl_matrix_free(a);
    return status;
}
