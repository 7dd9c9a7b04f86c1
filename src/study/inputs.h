/// The random inputs, the axes of the design, and the conditions of a study.
#ifndef BT_STUDY_INPUTS_H
#define BT_STUDY_INPUTS_H

#include "study/files.h"
#include "study/reader.h"
#include "study/study.h"

/// Reads `uncertainty`, `campaign.bounds`, `campaign.levels` and `reliability.conditions` (each
/// may be NULL) into study->inputs, in the order of the model's tables whatever the order in the
/// file, and study->conditions. The model must have been read. Then checks that they fit together.
void bt_inputs_read(bt_reader* reader, const bt_study_files* files, bt_study* study,
                    const bt_node* uncertainty, const bt_node* bounds, const bt_node* levels,
                    const bt_node* conditions);

/// The input with the path that a key is; NULL when there is none.
bt_input* bt_inputs_find(bt_study* study, const char* path);

/// The same, added when it is new; NULL after reporting an error.
bt_input* bt_inputs_find_or_add(bt_reader* reader, bt_study* study, const bt_node* key,
                                const char* chapter);

#endif
