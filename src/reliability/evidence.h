/// Landings as evidence for every condition: their points, outcomes, and the density that each was
/// drawn with.
#ifndef BT_RELIABILITY_EVIDENCE_H
#define BT_RELIABILITY_EVIDENCE_H

#include "campaign/campaign.h"
#include "reliability/event.h"

/// Landings in order of run number, failed ones included.
typedef struct bt_evidence {
    int count, dims;
    double* x;     ///< [count * dims] row-major, SI
    int8_t* label; ///< [count] 1 engaged, 0 missed, -1 failed (no outcome)
    int room;      ///< landings that there is room for
    int8_t* event; ///< [events * room] what the landings say of each event, in its indicator's
                   ///< values; NULL: none was asked for
    double* log_density; ///< [count] of the distribution that the point was drawn from
} bt_evidence;

/// Room for `room` landings; none yet. BT_ERR_MEMORY. bt_evidence_destroy gives it back.
BT_CHECKED bt_status bt_evidence_create(int dims, int room, bt_evidence* evidence);
/// The landings of a ledger with run numbers below `before`. Densities that the ledger does not
/// have are those of the design. BT_ERR_MEMORY, BT_ERR_IO.
/// @param events  [count] to be looked for in them; NULL: none
BT_CHECKED bt_status bt_evidence_read(bt_ledger* ledger, const bt_study* study, int64_t before,
                                      const bt_event* events, int count, bt_evidence* evidence,
                                      bt_diag* diag);

/// The same landings with an event in the place of engagement: labels 1 it happened, 0 it did not.
/// Borrowed: not to be destroyed.
bt_evidence bt_evidence_of_event(const bt_evidence* evidence, int event);
void bt_evidence_destroy(bt_evidence* evidence);

#endif
