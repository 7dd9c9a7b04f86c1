/// Values of discrete and empirical inputs.
#ifndef BT_STUDY_SAMPLES_H
#define BT_STUDY_SAMPLES_H

#include "study/files.h"

/// Reads the sample of an input whose distribution is discrete or empirical,
///
///     {distribution: discrete, values: [2 m, 4 m], probabilities: [0.3, 0.7]}
///     {distribution: empirical, file: gusts.csv, column: Sink speed, bandwidth: auto}
///     {distribution: empirical, values: [3.1 m/s, 3.4 m/s, 2.9 m/s]}
///
/// into input->distribution, and sets its mean. A file has one value per row and the unit in the
/// heading; the column may be left out when there is only one. Errors are reported.
void bt_sample_read(bt_reader* reader, const bt_study_files* files, bt_study* study,
                    bt_input* input, const bt_node* node, const char* path);

#endif
