/// Which run of a ledger is meant: by number, the first, the nearest to a point, the nearest to the
/// limit between catch and miss.
#ifndef BT_PIPELINE_FIND_RUN_H
#define BT_PIPELINE_FIND_RUN_H

#include "campaign/ledger.h"

/// What is sought. Start it with {.axes = bt_design_axes(study)}.
typedef struct bt_run_search {
    bt_axes axes;
    bool missed;                ///< of the missed ones only
    bool at_limit;              ///< the least |margin|
    bool named[BT_INPUT_MAX];   ///< axes that the point gives; none: the first run
    double point[BT_INPUT_MAX]; ///< SI
} bt_run_search;

/// Reads "limit", or a point 'landing.pitch=3 deg, landing.distance=8 m'. BT_ERR_ARG, with the
/// reason in `why`.
BT_CHECKED bt_status bt_run_search_read(const bt_study* study, const char* text,
                                        bt_run_search* search, char* why, size_t size);

/// Finds it; distances from the point are measured by the range of each axis, or else by its
/// standard deviation. *found is false when the ledger has no such run.
BT_CHECKED bt_status bt_run_find(const bt_study* study, bt_ledger* ledger,
                                 const bt_run_search* search, bt_ledger_row* row, bool* found,
                                 bt_diag* diag);

#endif
