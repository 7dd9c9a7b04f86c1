/// What may stand in the place of a key: what data sheets give (a bore for an area, an energy for a
/// speed), and its name in earlier versions.
#ifndef BT_STUDY_ALTERNATIVES_H
#define BT_STUDY_ALTERNATIVES_H

#include "study/reader.h"

/// Rewrites the tree of a study before it is read:
///
///     aircraft: ... X_diameter: d        X_area = pi d^2 / 4
///     rigs: ... drop_energy: W, mass: m  sink_speed = sqrt(2 W / m)
///
///     reliability: truth_runs: n         high_fidelity_runs: n, its name since 0.2.0
///
/// A key and its alternative both given, and a value that is no length or energy, are errors.
void bt_alternatives_apply(bt_reader* reader, bt_document* document, const bt_node* root);

#endif
