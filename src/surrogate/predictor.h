/// The surrogate made fast: labels for millions of points.
#ifndef BT_SURROGATE_PREDICTOR_H
#define BT_SURROGATE_PREDICTOR_H

#include "surrogate/surrogate.h"

typedef enum bt_isa_level { BT_ISA_V1, BT_ISA_V3, BT_ISA_V4, BT_ISA_LEVELS } bt_isa_level;

/// The highest level (x86-64-v1, -v3, -v4) that this machine runs and this build holds.
bt_isa_level bt_isa_best(void);

/// A surrogate laid out for the vector units; constant after creation, shared by any number of
/// threads. Independent of the surrogate it came from only as to the copies: the surrogate must
/// outlive it.
typedef struct bt_predictor bt_predictor;

/// @param level  at most bt_isa_best(); the level decides the last bits of `decision`, never a
/// label
BT_CHECKED bt_status bt_predictor_create(const bt_surrogate* surrogate, bt_isa_level level,
                                         bt_predictor** predictor);
void bt_predictor_destroy(bt_predictor* predictor);

/// Labels n points, equal to the sign of bt_surrogate_decision for every one of them: sums in float
/// with a bound on their error; where |f| is within the bound, again in double with its bound;
/// where it is within that, bt_surrogate_decision itself.
///
/// With S+ and S- the sums of the positive and the negative terms and A the sum of all |coef|:
///   |f_computed - f| <= eps_Y (S+ + S-) + A eps_Y 2^-Y + ...       (docs/theory/surrogate.md)
/// where eps_Y bounds the relative error of a term whose exponent is at most Y.
///
/// @param x         [n * dims] row-major, SI, finite
/// @param label     [n] +1 or -1
/// @param decision  [n] f, as exactly as the label needed it; may be NULL
void bt_predictor_label(const bt_predictor* predictor, const double* x, int n, int8_t* label,
                        float* decision);

/// How many of n points each of the three ways decided: float, double, plain. For benchmarks.
void bt_predictor_count(const bt_predictor* predictor, const double* x, int n, int64_t count[3]);

#endif
