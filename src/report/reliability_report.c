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
    bt_json_number(json, "corrected", row->corrected);
    write_interval(json, "corrected_ci95", &row->corrected_ci95);
    bt_json_number(json, "corrected_sampling", row->corrected_sampling);
    bt_json_number(json, "corrected_unseen", row->corrected_unseen);
    bt_json_integer(json, "landings", row->landings);
    bt_json_number(json, "reweighted", row->reweighted);
    write_interval(json, "reweighted_ci95", &row->reweighted_ci95);
    bt_json_number(json, "effective_landings", row->effective_landings);
    bt_json_number(json, "surrogate", row->surrogate);
    write_interval(json, "surrogate_ci95", &row->surrogate_ci95);
    bt_json_integer(json, "samples", row->samples);
    bt_json_integer(json, "high_fidelity_runs", row->high_fidelity_runs);
    bt_json_integer(json, "high_fidelity_failed", row->high_fidelity_failed);
    bt_json_integer(json, "disagreements", row->disagreements);
    bt_json_number(json, "disagreement", row->disagreement);
    write_interval(json, "disagreement_ci95", &row->disagreement_ci95);
    bt_json_number(json, "outside_share", row->outside_share);
    bt_json_number(json, "outside_missed", row->outside_missed);
    bt_json_number(json, "outside_engaged", row->outside_engaged);
    bt_json_number(json, "seconds", row->seconds);
    bt_json_end_object(json);
}

static void write_difference(bt_json* json, const bt_reliability_result* result,
                             const bt_reliability_difference* d) {
    bt_json_begin_object(json, NULL);
    bt_json_string(json, "parameter", result->condition[d->to].parameter);
    bt_json_number(json, "from", result->condition[d->from].value);
    bt_json_number(json, "to", result->condition[d->to].value);
    bt_json_number(json, "difference", d->difference);
    write_interval(json, "ci95", &d->ci95);
    bt_json_end_object(json);
}

static void write_classifier(bt_json* json, const bt_reliability_classifier* c) {
    bt_json_begin_object(json, "classifier");
    bt_json_number(json, "holdout_accuracy", c->holdout_accuracy);
    bt_json_integer(json, "holdout_n", c->holdout_count);
    bt_json_bool(json, "features", c->features);
    bt_json_number(json, "C", c->C);
    bt_json_number(json, "gamma", c->gamma);
    bt_json_integer(json, "support_vectors", c->support_vectors);
    bt_json_end_object(json);
}

static void write_widths(bt_json* json, const bt_reliability_result* result) {
    bt_json_begin_array(json, "convergence");
    for (int i = 0; i < result->width_count; ++i) {
        const bt_width* w = &result->width[i];
        bt_json_begin_object(json, NULL);
        bt_json_integer(json, "landings", w->landings);
        bt_json_number(json, "overall", w->overall);
        bt_json_number(json, "median", w->median);
        bt_json_number(json, "largest", w->largest);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}

void bt_reliability_write_json(bt_json* json, const bt_reliability_result* result) {
    bt_json_begin_object(json, NULL);
    bt_json_begin_array(json, "conditions");
    for (int i = 0; i < result->condition_count; ++i)
        write_row(json, NULL, &result->condition[i]);
    bt_json_end_array(json);
    write_row(json, "overall", &result->overall);
    bt_json_begin_array(json, "differences");
    for (int i = 0; i < result->difference_count; ++i)
        write_difference(json, result, &result->difference[i]);
    bt_json_end_array(json);
    if (result->event_count > 0)
        bt_reliability_write_events(json, result);
    write_widths(json, result);
    bt_json_integer(json, "landings", result->landings);
    write_classifier(json, &result->classifier);
    bt_json_begin_array(json, "warnings");
    for (int i = 0; i < result->warning_count; ++i)
        bt_json_string(json, NULL, result->warning[i]);
    bt_json_end_array(json);
    bt_json_number(json, "seconds", result->seconds);
    bt_json_end_object(json);
}
