/// What the rigs have in common.
#ifndef BT_RIGS_RIG_H
#define BT_RIGS_RIG_H

#include "mechanics/system.h"
#include "rigs/rigs.h"

extern const char* const bt_drop_channels[];
extern const char* const bt_rebound_channels[];
extern const char* const bt_static_channels[];
enum { BT_DROP_CHANNELS = 8, BT_REBOUND_CHANNELS = 6, BT_STATIC_CHANNELS = 3 };

/// A system in motion with the memory of its state.
typedef struct bt_rig {
    bt_system* system;
    bt_arena arena;
    bt_state state;
    bt_rig_observer* observer;
    void* user;
    bt_diag* diag;
} bt_rig;

/// An empty system. Release with bt_rig_close, also after an error.
BT_CHECKED bt_status bt_rig_open(bt_rig* rig, bt_rig_observer* observer, void* user, bt_diag* diag);
void bt_rig_close(bt_rig* rig);

/// Assembles the system and lays out its state.
BT_CHECKED bt_status bt_rig_start(bt_rig* rig, double gravity_mps2);

/// One step; a divergence is said in diag with element, quantity and time.
BT_CHECKED bt_status bt_rig_step(bt_rig* rig, double step_s);

/// Outputs of the present state, in place.
BT_CHECKED bt_status bt_rig_evaluate(bt_rig* rig);

const double* bt_rig_output(const bt_rig* rig, int element);

/// Hands a line of the histories to the observer, if there is one.
void bt_rig_show(const bt_rig* rig, int count, const char* const* names, const double* values);

/// The same at a time of the caller's.
void bt_rig_show_at(const bt_rig* rig, double time_s, int count, const char* const* names,
                    const double* values);

/// Adds a metric with its reference (0: none) and the error that is accepted.
void bt_rig_add(bt_rig_result* result, const char* name, const char* unit, double value,
                double reference, double tolerance);

#endif
