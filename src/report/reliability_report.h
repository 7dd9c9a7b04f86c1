/// The reliability of every condition: for people, as CSV and as JSON.
#ifndef BT_REPORT_RELIABILITY_REPORT_H
#define BT_REPORT_RELIABILITY_REPORT_H

#include "pipeline/pipeline.h"
#include "report/table.h"

/// One JSON object: `conditions`, one object each, and `overall`, the study as it stands.
void bt_reliability_write_json(bt_json* json, const bt_reliability_result* result);

/// One row per condition and one for the study as it stands, with what the columns mean below.
/// NULL when out of memory; the result must outlive it. bt_report_table_destroy.
bt_report_table* bt_reliability_table(const bt_reliability_result* result);

/// The events, for the study as it stands and by touchdown zone; `conditions`: also for every
/// condition. As bt_reliability_table.
bt_report_table* bt_reliability_event_table(const bt_reliability_result* result, bool conditions);

/// "before wire 1", "wire 2 to 3", "beyond wire 4".
void bt_reliability_zone_name(const bt_zones* zones, int zone, char* name, size_t size);

/// Arrays `events` (each with `overall`, `zones`, `conditions`) and `zones`.
void bt_reliability_write_events(bt_json* json, const bt_reliability_result* result);

/// What a study directory keeps: reliability.txt, .csv, .json; events.csv when it has events.
extern const bt_reliability_file bt_reliability_files[];

#endif
