#include "report/reliability_report.h"

#include "base/units.h"

#include <math.h>
#include <string.h>

static const bt_column columns[] = {
    {.name = "event", .head = "event", .unit = ""},
    {.name = "parameter", .head = NULL, .unit = ""},
    {.name = "value", .head = NULL, .unit = ""},
    {.name = "unit", .head = NULL, .unit = ""},
    {.name = "touchdown", .head = "touchdown", .unit = ""},
    {.name = "share", .head = "share", .unit = "%", .scale = 100, .decimals = 2},
    {.name = "probability", .head = "probability", .unit = "", .decimals = 4, .interval = true},
    {.name = "sampling", .head = "sampling", .unit = "%", .scale = 100, .decimals = 2},
    {.name = "unseen", .head = "unseen", .unit = "%", .scale = 100, .decimals = 2},
    {.name = "classifier", .head = "classifier", .unit = "", .decimals = 4},
};

void bt_reliability_zone_name(const bt_zones* zones, int zone, char* name, size_t size) {
    if (zone == 0)
        snprintf(name, size, "before wire 1");
    else if (zone == zones->count - 1)
        snprintf(name, size, "beyond wire %d", zone);
    else
        snprintf(name, size, "wire %d to %d", zone, zone + 1);
}

static void add_estimate(bt_report_table* table, const bt_event_estimate* e) {
    bt_report_table_interval(table, e->probability, &e->ci95);
    bt_report_table_number(table, e->sampling);
    bt_report_table_number(table, e->unseen);
    bt_report_table_number(table, e->classifier);
}

static void add_place(bt_report_table* table, const bt_event_row* event, const char* place,
                      double share, const bt_event_estimate* e) {
    bt_report_table_row(table);
    bt_report_table_text(table, event->name);
    bt_report_table_text(table, "");
    bt_report_table_number(table, NAN);
    bt_report_table_text(table, "");
    bt_report_table_text(table, place);
    bt_report_table_number(table, share);
    add_estimate(table, e);
}

static void add_condition(bt_report_table* table, const bt_event_row* event,
                          const bt_reliability_row* row, const bt_event_estimate* e) {
    bt_report_table_row(table);
    bt_report_table_text(table, event->name);
    bt_report_table_text(table, row->parameter);
    bt_report_table_number(table, row->value);
    bt_report_table_text(table, *row->unit ? bt_unit_text(row->unit) : "");
    bt_report_table_text(table, "");
    bt_report_table_number(table, NAN);
    add_estimate(table, e);
}

static void add_zone(bt_report_table* table, const bt_reliability_result* result, int zone) {
    char name[32];
    bt_reliability_zone_name(&result->zones, zone, name, sizeof name);
    for (int k = 0; k < result->event_count; ++k)
        add_place(table, &result->event[k], name, result->zones.share[zone],
                  &result->event[k].zone[zone]);
}

static void add_remarks(bt_report_table* table, const bt_reliability_result* result) {
    for (int k = 0; k < result->event_count; ++k) {
        const bt_event_row* e = &result->event[k];
        bt_report_table_remark(table, "%s: %s", e->name, e->text);
        if (e->judged > 0)
            bt_report_table_remark(
                table, "%*s  its classifiers erred on %d of %d landings they had not seen",
                (int)strlen(e->name), "", e->disagreed, e->judged);
    }
    if (result->zones.count > 0)
        bt_report_table_remark(table, "touchdown: the place that landing.distance gives, and its "
                                      "share of the landings; below it, the probabilities given "
                                      "that place");
    bt_report_table_remark(table, "intervals: 95 %%, as in the corrected column above; by "
                                  "condition: events.csv");
}

bt_report_table* bt_reliability_event_table(const bt_reliability_result* result, bool conditions) {
    bt_report_table* table =
        bt_report_table_create(NULL, columns, (int)(sizeof columns / sizeof columns[0]));
    for (int k = 0; k < result->event_count; ++k)
        add_place(table, &result->event[k], "anywhere", 1, &result->event[k].overall);
    for (int z = 0; z < result->zones.count; ++z)
        add_zone(table, result, z);
    for (int c = 0; conditions && c < result->condition_count; ++c)
        for (int k = 0; k < result->event_count; ++k)
            add_condition(table, &result->event[k], &result->condition[c],
                          &result->event[k].condition[c]);
    add_remarks(table, result);
    return table;
}

// --- JSON -------------------------------------------------------------------------------------

static void write_estimate(bt_json* json, const char* key, const bt_event_estimate* e) {
    bt_json_begin_object(json, key);
    bt_json_number(json, "probability", e->probability);
    bt_json_begin_array(json, "ci95");
    bt_json_number(json, NULL, e->ci95.least);
    bt_json_number(json, NULL, e->ci95.greatest);
    bt_json_end_array(json);
    bt_json_number(json, "sampling", e->sampling);
    bt_json_number(json, "unseen", e->unseen);
    bt_json_number(json, "classifier", e->classifier);
    bt_json_end_object(json);
}

static void write_event(bt_json* json, const bt_reliability_result* result,
                        const bt_event_row* event) {
    bt_json_begin_object(json, NULL);
    bt_json_string(json, "name", event->name);
    bt_json_string(json, "text", event->text);
    bt_json_integer(json, "judged", event->judged);
    bt_json_integer(json, "disagreed", event->disagreed);
    write_estimate(json, "overall", &event->overall);
    bt_json_begin_array(json, "zones");
    for (int z = 0; z < result->zones.count; ++z)
        write_estimate(json, NULL, &event->zone[z]);
    bt_json_end_array(json);
    bt_json_begin_array(json, "conditions");
    for (int c = 0; c < result->condition_count; ++c)
        write_estimate(json, NULL, &event->condition[c]);
    bt_json_end_array(json);
    bt_json_end_object(json);
}

void bt_reliability_write_events(bt_json* json, const bt_reliability_result* result) {
    char name[32];
    bt_json_begin_array(json, "events");
    for (int k = 0; k < result->event_count; ++k)
        write_event(json, result, &result->event[k]);
    bt_json_end_array(json);
    bt_json_begin_array(json, "zones");
    for (int z = 0; z < result->zones.count; ++z) {
        bt_json_begin_object(json, NULL);
        bt_reliability_zone_name(&result->zones, z, name, sizeof name);
        bt_json_string(json, "name", name);
        bt_json_number(json, "nearest_m", result->zones.nearest_m[z]);
        bt_json_number(json, "share", result->zones.share[z]);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}
