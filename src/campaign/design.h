/// Designs of experiments: which inputs a run has. A point depends on the study and the run's
/// number only, never on what was computed before  [Peng2023 Sec. 5.2].
#ifndef BT_CAMPAIGN_DESIGN_H
#define BT_CAMPAIGN_DESIGN_H

#include "campaign/mixture.h"

/// The axes of a study's design: indices into study->inputs, in their order. The axes are the
/// inputs with bounds; for monte_carlo and conditions the inputs with a distribution.
typedef struct bt_axes {
    int count;
    int input[BT_INPUT_MAX];
} bt_axes;

bt_axes bt_design_axes(const bt_study* study);

/// A design in use. It may remember where it stands in a sequence, so one thread at a time.
typedef struct bt_design bt_design;

/// Prepares the design of a study; the study must outlive it. Errors, said in diag: BT_ERR_INPUT
/// (no axes, more than 40 axes for sobol, a full factorial of more than 1e9 runs), BT_ERR_MEMORY.
BT_CHECKED bt_status bt_design_create(const bt_study* study, bt_design** design, bt_diag* diag);
void bt_design_destroy(bt_design* design);

const bt_axes* bt_design_get_axes(const bt_design* design);

/// Number of runs: `samples`, but for full_factorial the product of the levels. Axes without
/// `levels` share what is missing to `samples` as equally as whole numbers allow, the first axes
/// getting the larger ones; the product is the least of that form that reaches `samples`.
int64_t bt_design_count(const bt_design* design);

/// The point of a run: x [axes.count], SI, in the order of the axes.
///
/// sobol            Sobol' sequence with a digital shift keyed by the seed (the shift keeps every
///                  property of the net); ascending run numbers cost one step each
/// latin_hypercube  x_j = (pi_j(run) + u) / samples, pi_j a keyed permutation, u uniform in (0, 1)
/// full_factorial   equally spaced levels, bounds included (a single level: the middle); the last
///                  axis turns fastest
/// monte_carlo      quantile of each distribution at a uniform number keyed by (seed, run, input)
/// conditions       a Sobol' sequence with its own shift inside each component of the mixture of
/// all
///                  conditions (mixture.h); the component whose number of runs is furthest behind
///                  its share comes next
void bt_design_point(bt_design* design, int64_t run, double* x);

/// Natural logarithm of the density that the points of the design are drawn with, at a point; NAN
/// for a full factorial, which is not drawn; -INFINITY outside the box.
double bt_design_log_density(const bt_design* design, const double* x);

/// The mixture of the design conditions; NULL for the others.
const bt_mixture* bt_design_mixture(const bt_design* design);

#endif
