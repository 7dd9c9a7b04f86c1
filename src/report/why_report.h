/// Why a landing ended as it did, for people and for programs: its timeline and its nearest flips.
#ifndef BT_REPORT_WHY_REPORT_H
#define BT_REPORT_WHY_REPORT_H

#include "pipeline/flip.h"
#include "report/timeline.h"

#include <stdio.h>

typedef struct bt_why {
    const bt_study* study;
    int64_t run;                     ///< number in the ledger; -1: the study's own landing
    const double* x;                 ///< inputs in the order of the design's axes, SI
    const bt_landing_result* result; ///< of the landing
    const bt_timeline* timeline;
    const bt_flips* flips;
} bt_why;

/// BT_ERR_MEMORY; errors of writing stay with the file.
BT_CHECKED bt_status bt_why_print(const bt_why* why, FILE* out);
BT_CHECKED bt_status bt_why_json(const bt_why* why, FILE* out);

#endif
