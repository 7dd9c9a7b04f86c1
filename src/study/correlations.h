/// Rank correlations of random inputs.
#ifndef BT_STUDY_CORRELATIONS_H
#define BT_STUDY_CORRELATIONS_H

#include "study/reader.h"
#include "study/study.h"

/// Reads `uncertainty.correlation: [[path, path, rank], ...]` into the study and makes its copula.
/// The inputs stand in their final order. Errors are reported: an input without a density, a pair
/// given twice, a rank beyond -1 .. 1, the pair with which they no longer fit together.
void bt_correlations_read(bt_reader* reader, bt_study* study, const bt_node* node);

#endif
