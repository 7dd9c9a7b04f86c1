/// The chapter `uncertainty`: a distribution for each random input.
#ifndef BT_STUDY_UNCERTAINTY_H
#define BT_STUDY_UNCERTAINTY_H

#include "study/files.h"
#include "study/reader.h"
#include "study/study.h"

/// Reads the chapter into study->inputs; the model must have been read.
void bt_uncertainty_read(bt_reader* reader, const bt_study_files* files, bt_study* study,
                         const bt_node* node);

/// A distribution's parameter by name ("mean", "sd", ...); NULL for another name.
double* bt_distribution_parameter(bt_distribution* d, const char* name);

/// Whether a parameter is a number without the unit of the key.
bool bt_distribution_is_plain(const char* name);

#endif
