/// The reliability of every condition, for programs.
#ifndef BT_REPORT_RELIABILITY_REPORT_H
#define BT_REPORT_RELIABILITY_REPORT_H

#include "reliability/reliability.h"
#include "report/json.h"

/// One JSON object: `conditions`, one object each, and `overall`, the study as it stands.
void bt_reliability_write_json(bt_json* json, const bt_reliability_result* result);

#endif
