/// The random inputs, the axes of the design, and the conditions of a study.
#ifndef BT_STUDY_INPUTS_H
#define BT_STUDY_INPUTS_H

#include "study/reader.h"
#include "study/study.h"

/// Reads `uncertainty`, `campaign.bounds`, `campaign.levels` and `reliability.conditions` (each
/// may be NULL) into study->inputs, in the order of the model's tables whatever the order in the
/// file, and study->conditions. The model must have been read. Then checks that they fit together.
void bt_inputs_read(bt_reader* reader, bt_study* study, const bt_node* uncertainty,
                    const bt_node* bounds, const bt_node* levels, const bt_node* conditions);

/// A distribution's parameter by name ("mean", "sd", ...); NULL for another name.
double* bt_distribution_parameter(bt_distribution* d, const char* name);

#endif
