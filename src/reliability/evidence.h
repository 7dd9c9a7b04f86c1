/// Landings as evidence for every condition: their points, outcomes, and the density that each was
/// drawn with.
#ifndef BT_RELIABILITY_EVIDENCE_H
#define BT_RELIABILITY_EVIDENCE_H

#include "campaign/campaign.h"

/// Landings in order of run number, failed ones included.
typedef struct bt_evidence {
    int count, dims;
    double* x;           ///< [count * dims] row-major, SI
    int8_t* label;       ///< [count] 1 engaged, 0 missed, -1 failed (no outcome)
    double* log_density; ///< [count] of the distribution that the point was drawn from
} bt_evidence;

/// Room for `room` landings; none yet. BT_ERR_MEMORY. bt_evidence_destroy gives it back.
BT_CHECKED bt_status bt_evidence_create(int dims, int room, bt_evidence* evidence);
/// The landings of a ledger with run numbers below `before`. Densities that the ledger does not
/// have are those of the design. BT_ERR_MEMORY, BT_ERR_IO.
BT_CHECKED bt_status bt_evidence_read(bt_ledger* ledger, const bt_study* study, int64_t before,
                                      bt_evidence* evidence, bt_diag* diag);
void bt_evidence_destroy(bt_evidence* evidence);

#endif
