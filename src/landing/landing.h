/// One landing: from the glide to the wire caught or missed  [Peng2023 Sec. 2, Eq. 18].
#ifndef BT_LANDING_LANDING_H
#define BT_LANDING_LANDING_H

#include "landing/params.h"
#include "landing/result.h"

#include <stdatomic.h>

/// A distance to the cable at which the hook ends its first bounces long before anything meets the
/// cable, m.
#define BT_CLEAR_DISTANCE_M 14.0

enum {                              ///< segments; what the memory of one landing has room for
    BT_LANDING_SEGMENTS_MAX = 1000, ///< of a wire
    BT_DECK_SEGMENTS_MAX = 2400,    ///< of all wires together
};

/// A worker that runs landings one after another, with its own memory (at most 1 MB with one wire,
/// 2 MB with several). One per thread; runs share nothing.
typedef struct bt_lander bt_lander;
BT_CHECKED bt_status bt_lander_create(bt_lander** lander);
void bt_lander_destroy(bt_lander* lander);

/// A flag that ends a run early: once it is not 0, bt_lander_run returns BT_ERR_INTERRUPTED within
/// a step. NULL, as at the start: none.
void bt_lander_obey(bt_lander* lander, const atomic_int* stop);

/// Bytes that a lander holds, all in all.
size_t bt_lander_memory(const bt_lander* lander);

struct bt_landing_view; ///< landing/view.h: what an observer may look at

/// Called at the start, after every airframe step, and at the end.
typedef void bt_landing_observer(void* user, const struct bt_landing_view* view);

/// Runs one landing. The parameters must have passed bt_group_check(&bt_model_group, ...).
/// A run that diverges is a result (BT_FAILED), not an error. observer may be NULL.
/// Returns BT_OK, BT_ERR_INPUT (what the parameters describe cannot be assembled or has no
/// equilibrium; said in diag as "key: reason"), BT_ERR_INTERRUPTED, BT_ERR_MEMORY.
BT_CHECKED bt_status bt_lander_run(bt_lander* lander, const bt_model_params* params,
                                   bt_landing_result* result, bt_landing_observer* observer,
                                   void* user, bt_diag* diag);

/// Whether a landing with these parameters could begin: builds airframe and cable and finds the
/// cable's equilibrium. Errors as bt_lander_run.
BT_CHECKED bt_status bt_lander_prepare(bt_lander* lander, const bt_model_params* params,
                                       bt_diag* diag);

#endif
