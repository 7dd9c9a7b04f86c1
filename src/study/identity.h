/// What the runs of a campaign depend on: the design, and every key of the model that the design
/// does not replace. Two studies with one identity have the same runs to the bit.
#ifndef BT_STUDY_IDENTITY_H
#define BT_STUDY_IDENTITY_H

#include "study/study.h"

/// One "path = value" per line, SI: how a difference between two studies is named. The own value
/// of an axis is no part of it. The caller frees it; NULL when memory is out.
char* bt_study_identity(const bt_study* study);

/// FNV-1a, 64 bits, of an identity: bt_study.hash.
uint64_t bt_study_identity_hash(const char* identity);

#endif
