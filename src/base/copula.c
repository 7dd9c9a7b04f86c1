#include "base/copula.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

typedef double matrix[BT_COPULA_MAX][BT_COPULA_MAX];

/// Cholesky's factor of a symmetric matrix: how many rows of it there are before the matrix is no
/// longer positive definite.
static int factorise(matrix r, int n, matrix l) {
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j) {
            double sum = r[i][j];
            for (int k = 0; k < j; ++k)
                sum -= l[i][k] * l[j][k];
            if (i == j && !(sum > 1e-12))
                return i;
            l[i][j] = i == j ? sqrt(sum) : sum / l[j][j];
        }
    return n;
}

/// (L L')^-1 - I, column by column.
static void invert(matrix l, int n, matrix excess) {
    for (int c = 0; c < n; ++c) {
        double y[BT_COPULA_MAX] = {0};
        for (int i = 0; i < n; ++i) {
            double sum = i == c;
            for (int k = 0; k < i; ++k)
                sum -= l[i][k] * y[k];
            y[i] = sum / l[i][i];
        }
        for (int i = n - 1; i >= 0; --i) {
            double sum = y[i];
            for (int k = i + 1; k < n; ++k)
                sum -= l[k][i] * y[k];
            y[i] = sum / l[i][i];
        }
        for (int i = 0; i < n; ++i)
            excess[i][c] = y[i] - (i == c);
    }
}

/// The last pair of a variable with one before it.
static int last_pair_of(const bt_correlation* pairs, int count, int variable) {
    int last = 0;
    for (int p = 0; p < count; ++p) {
        const int a = pairs[p].first, b = pairs[p].second;
        if ((a > b ? a : b) == variable)
            last = p;
    }
    return last;
}

int bt_copula_make(const bt_correlation* pairs, int count, int dims, bt_copula* copula) {
    matrix r = {{0}};
    memset(copula, 0, sizeof *copula);
    if (count == 0)
        return 0;
    for (int i = 0; i < dims; ++i)
        r[i][i] = 1;
    for (int p = 0; p < count; ++p) {
        const int i = pairs[p].first, j = pairs[p].second;
        r[i][j] = r[j][i] = 2 * sin(M_PI / 6 * pairs[p].rank);
        copula->bound[i] = copula->bound[j] = true;
    }
    const int rows = factorise(r, dims, copula->root);
    if (rows < dims)
        return last_pair_of(pairs, count, rows);
    copula->dims = dims;
    for (int i = 0; i < dims; ++i)
        copula->log_root_det += log(copula->root[i][i]);
    invert(copula->root, dims, copula->excess);
    return count;
}

void bt_copula_bind(const bt_copula* copula, double* u) {
    double g[BT_COPULA_MAX];
    for (int i = 0; i < copula->dims; ++i)
        g[i] = copula->bound[i] ? gsl_cdf_ugaussian_Pinv(u[i]) : 0;
    for (int i = 1; i < copula->dims; ++i) {
        double z = 0;
        for (int k = 0; k <= i; ++k)
            z += copula->root[i][k] * g[k];
        if (copula->bound[i] && copula->root[i][i] < 1)
            u[i] = fmin(fmax(gsl_cdf_ugaussian_P(z), 0x1p-53), 1 - 0x1p-53);
    }
}

double bt_copula_log_density(const bt_copula* copula, const double* z) {
    double form = 0;
    for (int i = 0; i < copula->dims; ++i)
        for (int k = 0; k < copula->dims; ++k)
            if (copula->bound[i] && copula->bound[k])
                form += z[i] * copula->excess[i][k] * z[k];
    return -copula->log_root_det - 0.5 * form;
}
