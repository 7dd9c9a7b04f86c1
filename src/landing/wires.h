/// Where the wires of a deck lie and what each is like. Wire 1 is the first that a landing meets;
/// the origin of the landing's frame is where its cable rests.
#ifndef BT_LANDING_WIRES_H
#define BT_LANDING_WIRES_H

#include "landing/params.h"

/// How many wires the deck has.
int bt_wires_count(const bt_deck_params* deck);

/// Place of a wire, from 0 on, forward of the first, m.
double bt_wires_position(const bt_deck_params* deck, int wire);

/// The cable of a wire, from 0 on: deck.cable with what deck.wires says of this one.
void bt_wires_cable(const bt_deck_params* deck, int wire, bt_cable_params* cable);

/// The least distance between two wires: that of the parts of a hook's head, which must not meet
/// two at once, and of the mesh, m.
double bt_wires_least_spacing(const bt_model_params* model);

/// What the ranges cannot say: order, spacing, lists that fit, a named wire that is there, memory.
/// Adds its errors to diag.
void bt_wires_check(const bt_model_params* model, const char* path, bt_diag* diag);

#endif
