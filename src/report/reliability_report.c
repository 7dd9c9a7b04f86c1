#include "report/reliability_report.h"

#include "base/units.h"

static void write_interval(bt_json* json, const char* key, const bt_interval* interval) {
    bt_json_begin_array(json, key);
    bt_json_number(json, NULL, interval->least);
    bt_json_number(json, NULL, interval->greatest);
    bt_json_end_array(json);
}

static void write_row(bt_json* json, const char* key, const bt_reliability_row* row) {
    bt_json_begin_object(json, key);
    if (row->parameter[0]) {
        bt_json_string(json, "parameter", row->parameter);
        bt_json_number(json, "value", row->value);
        bt_json_string(json, "unit", bt_unit_text(row->unit[0] ? row->unit : "1"));
    }
    bt_json_number(json, "surrogate", row->surrogate);
    write_interval(json, "surrogate_ci95", &row->surrogate_ci95);
    bt_json_number(json, "corrected", row->corrected);
    write_interval(json, "corrected_ci95", &row->corrected_ci95);
    bt_json_integer(json, "samples", row->samples);
    bt_json_integer(json, "truth_runs", row->truth_runs);
    bt_json_integer(json, "truth_failed", row->truth_failed);
    bt_json_integer(json, "disagreements", row->disagreements);
    bt_json_number(json, "disagreement", row->disagreement);
    write_interval(json, "disagreement_ci95", &row->disagreement_ci95);
    bt_json_number(json, "outside_share", row->outside_share);
    bt_json_number(json, "outside_missed", row->outside_missed);
    bt_json_number(json, "outside_engaged", row->outside_engaged);
    bt_json_number(json, "seconds", row->seconds);
    bt_json_end_object(json);
}

void bt_reliability_write_json(bt_json* json, const bt_reliability_result* result) {
    bt_json_begin_object(json, NULL);
    bt_json_begin_array(json, "conditions");
    for (int i = 0; i < result->condition_count; ++i)
        write_row(json, NULL, &result->condition[i]);
    bt_json_end_array(json);
    write_row(json, "overall", &result->overall);
    bt_json_number(json, "seconds", result->seconds);
    bt_json_end_object(json);
}
