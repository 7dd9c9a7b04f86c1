/// What a study says of the rigs beyond their tables: measured curves, and files that describe no
/// more than a rig needs.
#ifndef BT_STUDY_RIG_INPUTS_H
#define BT_STUDY_RIG_INPUTS_H

#include "study/files.h"
#include "study/reader.h"
#include "study/study.h"

/// Takes `reference.curve` of every rig out of the tree into study->rig_inputs. The files are not
/// opened.
void bt_rig_inputs_take(bt_reader* reader, const bt_study_files* files, bt_node* root,
                        bt_study* study);

/// Reads one curve: the name of a file, or a mapping with `file`, `x`, one `y` and `offset`. The
/// texts of *columns belong to `names`. False: neither; what is wrong with a mapping was reported.
bool bt_curve_take(bt_reader* reader, bt_document* names, const bt_node* node, const char* key,
                   const bt_node** file, bt_measured_columns* columns);

/// Whether a tree describes rigs and no landing.
bool bt_rig_inputs_alone(const bt_node* root);

/// Reads the parts of the aircraft that the rigs of such a tree test; what places them on an
/// aircraft is put at the origin where it is missing, and what the tests do not use (gas of a
/// spring given by points; wheel and oil of a strut on the press) need not be given.
void bt_rig_inputs_read_parts(bt_reader* reader, bt_document* document, bt_node* root,
                              bt_study* study);

/// What rig and aircraft must agree on: the drop mass exceeds the unsprung mass, and a press leaves
/// the gas some room.
void bt_rig_inputs_check(bt_reader* reader, const bt_node* root, const bt_study* study);

#endif
