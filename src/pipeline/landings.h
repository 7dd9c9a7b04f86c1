/// The landings of a ledger, column by column, each with its weight under the study's own
/// distributions: what atlas and report page look at.
#ifndef BT_PIPELINE_LANDINGS_H
#define BT_PIPELINE_LANDINGS_H

#include "campaign/ledger.h"

typedef struct bt_landings {
    bt_axes axes;
    int count, room;
    int64_t* run;
    double* x;        ///< [count * axes.count] SI
    double* margin_m; ///< NAN where there is none
    double* weight;   ///< [count] density of the study as it stands over the density that the
                      ///< landing was drawn with; 1 where that is not known
    uint8_t* mode;    ///< bt_mode
    uint8_t* outcome; ///< bt_outcome
    uint8_t* bounced; ///< 1: the hook had ended its first bounce on the deck
    bool weighted;    ///< false: the design is no sample of the study's distributions; all weigh 1
} bt_landings;

/// Reads a ledger in the order of run numbers. On BT_OK the caller gives them back. BT_ERR_IO
/// (said in diag), BT_ERR_MEMORY.
BT_CHECKED bt_status bt_landings_read(const bt_study* study, bt_ledger* ledger,
                                      bt_landings* landings, bt_diag* diag);
void bt_landings_destroy(bt_landings* landings); ///< accepts one that is all zero

/// An input of one landing, SI.
static inline double bt_landings_x(const bt_landings* l, int landing, int axis) {
    return l->x[(size_t)landing * (size_t)l->axes.count + (size_t)axis];
}

#endif
