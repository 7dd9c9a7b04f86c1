#include "surrogate/loss.h"

#include <math.h>

static const double slope_greatest = 1000;

/// Derivative of the loss by the slope.
static double derivative(const double* margin, int n, double slope) {
    double sum = 0;
    for (int i = 0; i < n; ++i)
        sum -= margin[i] / (1 + exp(slope * margin[i]));
    return sum;
}

/// log(1 + exp(-u)) without overflow.
static double loss_of(double u) {
    return u > 0 ? log1p(exp(-u)) : log1p(exp(u)) - u;
}

double bt_score_loss(const double* margin, int n) {
    double least = 0, greatest = slope_greatest;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (least + greatest);
        if (derivative(margin, n, middle) < 0)
            least = middle;
        else
            greatest = middle;
    }
    double sum = 0;
    for (int i = 0; i < n; ++i)
        sum += loss_of(least * margin[i]);
    return sum;
}
