/// A landing as a model, constant while it is computed, and a state, one block: created, stepped,
/// observed, copied and compared from outside.
///
///     bt_landing_model* model;
///     bt_landing_state* state;
///     bt_landing_model_create(&model);
///     bt_landing_model_prepare(model, &params, &diag);   // aircraft, wires, their equilibrium
///     bt_landing_state_create(model, &state);
///     for (bool on = bt_landing_start(model, state); on; on = bt_landing_step(model, state))
///         ;                                              // look, copy, stop here
///     bt_landing_result result;
///     bt_landing_finish(model, state, &result);
///
/// (those that return a status want it checked). Threads may share a model; a state belongs to one.
#ifndef BT_LANDING_MODEL_H
#define BT_LANDING_MODEL_H

#include "landing/landing.h"

typedef struct bt_landing_model bt_landing_model;
typedef struct bt_landing_state bt_landing_state;

BT_CHECKED bt_status bt_landing_model_create(bt_landing_model** model);
void bt_landing_model_destroy(bt_landing_model* model);
size_t bt_landing_model_memory(const bt_landing_model* model); ///< bytes held

/// Which instruction-set level of the cable's kernel the next preparation takes; BT_KERNEL_BEST
/// unless told. Levels differ in their bits, not in what they compute.
void bt_landing_model_use_kernel(bt_landing_model* model, bt_kernel_level level);

/// Builds what the parameters describe; they must have passed bt_group_check. Parts that are as at
/// the last call stay: the airframe, and the cable with its equilibrium. States of the model that
/// were created before are of no further use unless bt_landing_state_fits.
/// BT_ERR_INPUT, BT_ERR_NUMERIC (no equilibrium), both said in diag, BT_ERR_MEMORY.
BT_CHECKED bt_status bt_landing_model_prepare(bt_landing_model* model,
                                              const bt_model_params* params, bt_diag* diag);

/// A state of the prepared model, one block, to be started. BT_ERR_MEMORY.
BT_CHECKED bt_status bt_landing_state_create(const bt_landing_model* model,
                                             bt_landing_state** state);
void bt_landing_state_destroy(bt_landing_state* state);
size_t bt_landing_state_memory(const bt_landing_state* state); ///< bytes of the block

/// Whether the state was created for the model as it is now.
bool bt_landing_state_fits(const bt_landing_model* model, const bt_landing_state* state);

/// Copies everything; both fit the model.
void bt_landing_state_copy(const bt_landing_model* model, bt_landing_state* to,
                           const bt_landing_state* from);

/// Whether two states are equal to the bit in what decides how they go on: airframe and wires.
bool bt_landing_state_equal(const bt_landing_model* model, const bt_landing_state* a,
                            const bt_landing_state* b);

/// Places the aircraft on its glide and the wires at rest. False when it has failed already.
/// Allocates nothing, as what follows.
bool bt_landing_start(const bt_landing_model* model, bt_landing_state* state);

/// One airframe step, with the cables' own steps in it. False once the landing is over: caught and
/// held a little, past the wires, at rest, or failed; then nothing moves any more.
bool bt_landing_step(const bt_landing_model* model, bt_landing_state* state);

/// What may be looked at; the pointers hold until the next step. Works are counted from the first
/// look on.
void bt_landing_observe(const bt_landing_model* model, bt_landing_state* state, bool last,
                        struct bt_landing_view* view);

/// The result so far, of a landing that is over or not. wall_s is the caller's.
void bt_landing_finish(const bt_landing_model* model, const bt_landing_state* state,
                       bt_landing_result* result);

#endif
