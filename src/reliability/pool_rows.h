/// The pooled estimates in the rows of the reliability table.
#ifndef BT_RELIABILITY_POOL_ROWS_H
#define BT_RELIABILITY_POOL_ROWS_H

#include "reliability/reliability.h"

/// Weights and samples of every condition, kept for the differences.
typedef struct bt_pool_rows {
    const bt_judged* judged;
    double* weight;     ///< [components * count], not cut
    bt_weight_law* law; ///< of the row in work
    bt_cut cut[BT_COMPONENT_MAX];
    int64_t hits[BT_COMPONENT_MAX], samples;
} bt_pool_rows;

/// @param conditions  components of the mixture
BT_CHECKED bt_status bt_pool_rows_create(const bt_judged* judged, int conditions,
                                         bt_pool_rows** made);
void bt_pool_rows_destroy(bt_pool_rows* rows);

/// [landings of the evidence] the weights of a component, not cut.
const double* bt_pool_rows_weight(const bt_pool_rows* rows, int component);

/// Fills the pooled numbers of a row: the reweighted ones, and the corrected ones unless the
/// condition lies beyond the design and has fresh runs of its own. Component 0 is the study as it
/// stands, component c + 1 its condition c.
BT_CHECKED bt_status bt_pool_rows_fill(bt_pool_rows* rows, int component, const bt_sampler* sampler,
                                       int64_t samples, int threads, bt_reliability_row* row);

/// The differences between neighbouring conditions of one input.
void bt_pool_rows_differ(const bt_pool_rows* rows, const bt_study* study,
                         bt_reliability_result* result);

/// Fills the half-widths after every round; those after the last are the rows' own. BT_ERR_MEMORY.
BT_CHECKED bt_status bt_pool_rows_converge(const bt_pool_rows* rows, const bt_study* study,
                                           bt_reliability_result* result);

/// Writes down what the reader of the table must know.
void bt_reliability_note(bt_reliability_result* result, const char* text);

/// Writes down where columns disagree and where the surrogate cannot carry the number.
void bt_reliability_warn(const bt_surrogate* surrogate, bt_reliability_result* result);

#endif
