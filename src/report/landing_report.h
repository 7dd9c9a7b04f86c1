/// One landing for people and for programs.
#ifndef BT_REPORT_LANDING_REPORT_H
#define BT_REPORT_LANDING_REPORT_H

#include "landing/landing.h"
#include "report/json.h"

/// The whole result as one JSON object (key NULL) or as a member of the present one.
void bt_landing_write_json(bt_json* json, const bt_landing_result* result);

/// How long after a catch the loads are those of a real one, s: no arresting engine pays out.
#define BT_ENGAGED_LOADS_VALID_S 0.05

/// The same for people, a dozen lines.
void bt_landing_print(FILE* out, const bt_landing_result* result);

#endif
