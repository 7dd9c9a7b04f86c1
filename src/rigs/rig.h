/// What the rigs have in common.
#ifndef BT_RIGS_RIG_H
#define BT_RIGS_RIG_H

#include "mechanics/system.h"
#include "rigs/rigs.h"

extern const char* const bt_drop_channels[];
extern const char* const bt_rebound_channels[];
extern const char* const bt_static_channels[];
enum { BT_DROP_CHANNELS = 9, BT_REBOUND_CHANNELS = 6, BT_STATIC_CHANNELS = 3 };

enum { BT_RIG_BODIES_MAX = 4, BT_RIG_ELEMENTS_MAX = 6 };

/// Where the energy of a run goes, J, since bt_rig_begin.
typedef struct bt_rig_energy {
    double impact;                     ///< kinetic, at the beginning
    double weight;                     ///< work of weight and of the outside wrenches
    double taken[BT_RIG_ELEMENTS_MAX]; ///< by each element: stored or dissipated
    double power_W[BT_RIG_ELEMENTS_MAX], weight_W;
} bt_rig_energy;

/// A system in motion with the memory of its state.
typedef struct bt_rig {
    bt_system* system;
    bt_arena arena;
    bt_state state;
    bt_rig_observer* observer;
    void* user;
    bt_diag* diag;
    int body_count;
    double mass_kg[BT_RIG_BODIES_MAX], gravity_mps2;
    double frame_mps[3]; ///< velocity of the frame in which energy is counted
    bt_rig_energy energy;
    int remark_count;
    bt_rig_remark remarks[BT_RIG_REMARK_MAX];
} bt_rig;

/// An empty system. Release with bt_rig_close, also after an error.
BT_CHECKED bt_status bt_rig_open(bt_rig* rig, bt_rig_observer* observer, void* user, bt_diag* diag);
void bt_rig_close(bt_rig* rig);

/// As bt_system_add_body; at most BT_RIG_BODIES_MAX.
int bt_rig_add_body(bt_rig* rig, const bt_body_def* def);

/// Assembles the system and lays out its state.
BT_CHECKED bt_status bt_rig_start(bt_rig* rig, double gravity_mps2);

/// Evaluates the first state and begins to count energy.
BT_CHECKED bt_status bt_rig_begin(bt_rig* rig);

/// One step. A divergence, or an element outside its law, is said in diag with element, quantity
/// and time; an element at the end of its range becomes a remark.
BT_CHECKED bt_status bt_rig_step(bt_rig* rig, double step_s);

const double* bt_rig_output(const bt_rig* rig, int element);

/// Hands a line of the histories to the observer, if there is one.
void bt_rig_show(const bt_rig* rig, int count, const char* const* names, const double* values);

/// The same at a time of the caller's.
void bt_rig_show_at(const bt_rig* rig, double time_s, int count, const char* const* names,
                    const double* values);

/// Begins the result of a run: steps, end, remarks.
void bt_rig_result_begin(const bt_rig* rig, bt_rig_result* result);

/// Adds the energy balance: impact, weight, what each named element has taken, left, residual.
void bt_rig_add_energy(const bt_rig* rig, bt_rig_result* result, int count, const int* elements,
                       const char* const* names);

/// Adds a metric with its reference (0: none) and the error that is accepted.
void bt_rig_add(bt_rig_result* result, const char* name, const char* unit, double value,
                double reference, double tolerance);

#endif
