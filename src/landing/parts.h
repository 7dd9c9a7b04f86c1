/// Inside of a landing's model and state; for the files of this folder only.
#ifndef BT_LANDING_PARTS_H
#define BT_LANDING_PARTS_H

#include "landing/airframe.h"
#include "landing/model.h"
#include "landing/stance.h"
#include "landing/wire.h"

_Static_assert((int)BT_CONTACT_MAX == (int)BT_WIRE_MAX,
               "a result has room for a meeting with every wire");

struct bt_landing_model {
    bt_model_params params; ///< what the parts, where there are any, were built from; of the
                            ///< landing the velocities as the deck sees them
    bool has_airframe, has_cable;
    bt_kernel_level kernel; ///< of the cables
    uint64_t built;      ///< changes with every rebuilding of a part: states before it do not fit
    bt_arena arena;      ///< of the airframe
    bt_arena wire_arena; ///< of the cables and their resting shapes
    bt_airframe airframe;
    bt_state hanging;                  ///< as assembled
    bt_cable_model cable[BT_WIRE_MAX]; ///< those that differ
    bt_cable_state resting[BT_WIRE_MAX];
    bool keeps_wires; ///< computes every wire to the end: to show that dropping them loses nothing
    int wire_count;
    bt_wire wire[BT_WIRE_MAX];
    double segment_m[BT_CABLE_SEGMENTS_MAX];
    bt_stance stance;     ///< of an aircraft that rolls in
    double pressing_mps2; ///< normal to the deck, in which the wires rest
    bool moves;           ///< the deck's frame is not that of a deck at rest
};

typedef enum bt_landing_phase {
    BT_PHASE_GLIDE, ///< before the first contact with the deck, where lift is not the weight
    BT_PHASE_ROLL,  ///< after it
    BT_PHASE_CAUGHT,
    BT_PHASE_PASSED,
    BT_PHASE_STOPPED,
    BT_PHASE_FAILED,
} bt_landing_phase;

struct bt_landing_state {
    uint64_t built; ///< of the model
    size_t size;    ///< of the block, this struct included
    bt_state airframe;
    bt_wire_state wire[BT_WIRE_MAX];
    bt_landing_phase phase;
    double end_by_s; ///< the landing is over by then, whatever happens
    bt_hops hops;
    bt_moving_body part[BT_PART_COUNT]; ///< as the wires meet them
    bt_landing_result result;           ///< of what has been seen so far
    bool observed;                      ///< somebody looks: the works are worth their time
    bt_works works;
    bt_slides slides;  ///< scratch, but for its work
    double* tension_N; ///< scratch for observers
};

static inline bool bt_phase_is_over(bt_landing_phase phase) {
    return phase > BT_PHASE_ROLL;
}

/// An output of an element of the airframe at the last evaluation.
static inline double bt_landing_output(const bt_landing_model* model, const bt_landing_state* state,
                                       int element, int index) {
    return bt_system_element_output(model->airframe.system, &state->airframe, element)[index];
}

/// Sets the frames of airframe and wires where the deck moves: at the end of a step of step_s that
/// begins now, and now.
void bt_landing_move_deck(const bt_landing_model* model, bt_landing_state* state, double step_s);

/// Takes over where wheels and hook are, and their clearances from the wires.
void bt_landing_follow_parts(const bt_landing_model* model, bt_landing_state* state);

/// The landing has failed in an element, by a quantity, at a time.
void bt_landing_fail(bt_landing_state* state, const char* element, const char* quantity,
                     double time_s);

#endif
