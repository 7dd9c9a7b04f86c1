/// The paragraph of a paper that says how a study's numbers came about.
#ifndef BT_REPORT_METHODS_H
#define BT_REPORT_METHODS_H

#include "campaign/ledger.h"

#include <stdio.h>

/// Writes it as Markdown: model, inputs with their distributions, design, counts, classifier,
/// reliability, intervals, how to repeat it. `version` is the program's ("0.2.0").
void bt_methods_write(FILE* out, const bt_study* study, const bt_ledger_counts* counts,
                      uint64_t content_hash, const char* version);

#endif
