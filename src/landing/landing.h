/// One landing: from the glide to the wire caught or missed  [Peng2023 Sec. 2, Eq. 18].
#ifndef BT_LANDING_LANDING_H
#define BT_LANDING_LANDING_H

#include "landing/params.h"
#include "landing/result.h"

/// A distance to the cable at which the hook ends its first bounces long before anything meets the
/// cable, m.
#define BT_CLEAR_DISTANCE_M 14.0

enum { BT_LANDING_SEGMENTS_MAX = 1000 }; ///< of cable; what the memory of one landing has room for

/// A worker that runs landings one after another, with its own memory (at most 1 MB). One per
/// thread; runs share nothing.
typedef struct bt_lander bt_lander;
BT_CHECKED bt_status bt_lander_create(bt_lander** lander);
void bt_lander_destroy(bt_lander* lander);

/// Bytes that a lander holds, all in all.
size_t bt_lander_memory(const bt_lander* lander);

struct bt_landing_view; ///< landing/view.h: what an observer may look at

/// Called at the start, after every airframe step, and at the end.
typedef void bt_landing_observer(void* user, const struct bt_landing_view* view);

/// Runs one landing. The parameters must have passed bt_group_check(&bt_model_group, ...).
/// A run that diverges is a result (BT_FAILED), not an error. observer may be NULL.
/// Returns BT_OK, BT_ERR_INPUT (what the parameters describe cannot be assembled; said in diag),
/// BT_ERR_MEMORY.
BT_CHECKED bt_status bt_lander_run(bt_lander* lander, const bt_model_params* params,
                                   bt_landing_result* result, bt_landing_observer* observer,
                                   void* user, bt_diag* diag);

#endif
