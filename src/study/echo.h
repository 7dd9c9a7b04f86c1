/// The study as text.
#ifndef BT_STUDY_ECHO_H
#define BT_STUDY_ECHO_H

#include "study/document.h"
#include "study/study.h"

/// The whole study as one YAML text with every key: values used, in SI, and what was typed where
/// that differs. `root` is the tree it was read from. NULL when out of memory; the caller frees.
char* bt_study_echo(const bt_study* study, const bt_node* root);

#endif
