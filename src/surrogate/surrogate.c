#include "surrogate/surrogate.h"

#include <math.h>
#include <stdlib.h>

void bt_surrogate_destroy(bt_surrogate* surrogate) {
    if (!surrogate)
        return;
    free(surrogate->sv);
    free(surrogate->coef);
    surrogate->sv = surrogate->coef = NULL;
    surrogate->sv_count = 0;
}

double bt_surrogate_decision(const bt_surrogate* surrogate, const double* x) {
    const int dims = surrogate->dims;
    double z[BT_INPUT_MAX], f = 0;
    for (int k = 0; k < dims; ++k)
        z[k] = (x[k] - surrogate->centre[k]) / surrogate->scale[k];
    for (int i = 0; i < surrogate->sv_count; ++i) {
        double square = 0;
        for (int k = 0; k < dims; ++k) {
            const double apart = z[k] - surrogate->sv[i * dims + k];
            square += apart * apart;
        }
        f += surrogate->coef[i] * exp(-surrogate->gamma * square);
    }
    return f - surrogate->rho;
}

static double share(int part, int whole) {
    return whole > 0 ? (double)part / whole : NAN;
}

double bt_surrogate_train_accuracy(const bt_surrogate_scores* scores) {
    return share(scores->train_correct, scores->train_count);
}

double bt_surrogate_holdout_accuracy(const bt_surrogate_scores* scores) {
    return share(scores->holdout_correct, scores->holdout_count);
}
