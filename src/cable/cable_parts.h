/// What the files of this folder share; for this folder only.
#ifndef BT_CABLE_CABLE_PARTS_H
#define BT_CABLE_CABLE_PARTS_H

#include "cable/cable_kernel.h"

enum { BT_CABLE_STATE_ARRAYS = 42 }; ///< arrays of a state, one double per segment each

/// An end of the rope, and where it stands beside its anchor.
typedef struct bt_cable_end_point {
    int segment, joint;
    double sign;     ///< -1 at segment 0, +1 at the last segment
    double arm[3];   ///< from the segment's centre to its end
    double gap[3];   ///< from the anchor to the end of the segment
    double speed[3]; ///< rate of gap
    double axis[3], spin[3];
} bt_cable_end_point;

bt_cable_end_point bt_cable_end_point_of(const bt_cable_model* model, const bt_cable_state* state,
                                         int side);

/// Where the rope passes y: the lines of two neighbouring segments, shared.
typedef struct bt_cable_passage {
    int segment;        ///< the first of the two; -1 beyond the outermost centres
    double share[2];    ///< shares of the two segments, together 1
    double point[2][3]; ///< each segment's line at y
    double rate[2][3];  ///< velocity of the material point there
} bt_cable_passage;

bt_cable_passage bt_cable_pass(const bt_cable_model* model, const bt_cable_state* state, double y_m,
                               int hint);

/// The first of the two neighbouring segments whose centres lie around y; -1 beyond them all.
/// `hint` is where to look first, or -1.
int bt_cable_bracket(const bt_cable_model* model, const bt_cable_state* state, double y_m,
                     int hint);

/// Whether the frame has no acceleration but upward and does not turn: the kernel alone sees to it.
bool bt_cable_frame_is_still(const bt_cable_state* state);

/// Force and torque of the frame on a segment, but its acceleration along z, which the kernel adds.
void bt_cable_frame_load(const bt_cable_model* model, const bt_cable_state* state, int segment,
                         double kick_s, double force_N[3], double torque_Nm[3]);

/// The state with the loads of the frame added to those of the caller, in the arrays `net`; weight
/// along z is left to the kernel. kick_s: the time over which velocities will change.
void bt_cable_add_frame(const bt_cable_model* model, bt_cable_state* state, double kick_s,
                        bt_cable_state* loaded);

/// Centrifugal potential of a segment, J.
double bt_cable_centrifugal(const bt_cable_model* model, const bt_cable_state* state, int segment);

/// Resultant forces and torques of all segments, into `net`: for equilibrium and audit.
void bt_cable_balance(const bt_cable_model* model, bt_cable_state* state);

#endif
