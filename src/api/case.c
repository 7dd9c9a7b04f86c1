#include "bolter/bolter.h"

#include "study/study.h"

#include <stdio.h>
#include <stdlib.h>

struct bt_case {
    bt_study study;
    bt_lander* lander;
    bt_message* message;
    void* user;
};

/// Diagnostics reach the caller as finished lines.
static void deliver(void* user, bt_severity severity, bt_where where, const char* text) {
    const bt_case* opened = user;
    char line[2048];
    if (!opened->message)
        return;
    bt_diag_format(line, sizeof line, severity, where, text);
    opened->message(opened->user, line);
}

bt_status bt_case_open(const char* path, const char* const* sets, int set_count,
                       bt_message* message, void* user, bt_case** opened) {
    *opened = NULL;
    bt_case* c = calloc(1, sizeof *c);
    if (!c)
        return BT_ERR_MEMORY;
    c->message = message;
    c->user = user;
    bt_diag diag = {.sink = deliver, .user = c};
    bt_status status = bt_study_read(path, sets, set_count, &c->study, &diag);
    if (status != BT_OK) {
        free(c);
        return status;
    }
    status = bt_lander_create(&c->lander);
    if (status != BT_OK) {
        bt_case_close(c);
        return status;
    }
    *opened = c;
    return BT_OK;
}

void bt_case_close(bt_case* opened) {
    if (!opened)
        return;
    bt_lander_destroy(opened->lander);
    bt_study_destroy(&opened->study);
    free(opened);
}

/// A numeric key by its path; NULL when there is none.
static const bt_field* number(const char* path, size_t* offset) {
    const bt_field* field = bt_group_find(&bt_model_group, path, offset);
    if (!field || (field->kind != BT_FIELD_REAL && field->kind != BT_FIELD_PLAIN &&
                   field->kind != BT_FIELD_COUNT))
        return NULL;
    return field;
}

bt_status bt_case_set(bt_case* opened, const char* path, double value) {
    size_t offset;
    const bt_field* field = number(path, &offset);
    if (!field || !(value >= field->least && value <= field->greatest))
        return BT_ERR_ARG;
    bt_field_set(field, &opened->study.model, offset, value);
    return BT_OK;
}

bt_status bt_case_get(const bt_case* opened, const char* path, double* value) {
    size_t offset;
    const bt_field* field = number(path, &offset);
    if (!field)
        return BT_ERR_ARG;
    *value = bt_field_get(field, &opened->study.model, offset);
    return BT_OK;
}

bt_status bt_case_land(bt_case* opened, bt_landing_report* report) {
    bt_diag diag = {.sink = deliver, .user = opened};
    bt_landing_result result;
    *report = (bt_landing_report){0};
    BT_TRY(bt_group_check(&bt_model_group, &opened->study.model, "", &diag));
    BT_TRY(bt_lander_run(opened->lander, &opened->study.model, &result, NULL, NULL, &diag));

    report->failed = result.outcome == BT_FAILED;
    report->engaged = result.outcome == BT_ENGAGED;
    report->retained = result.retained;
    snprintf(report->mode, sizeof report->mode, "%s", bt_mode_name(result.mode));
    report->margin_m = result.margin_m;
    report->throat_force_peak_N = result.throat_force_peak_N;
    report->hook_deck_force_peak_N = result.hook_deck_force_peak_N;
    report->cable_tension_peak_N = result.cable_tension_max_N;
    report->bounces = result.bounce_count;
    if (result.bounce_count > 0) {
        report->first_bounce_height_m = result.bounces[0].height_m;
        report->first_bounce_distance_m = result.bounces[0].distance_m;
    }
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        report->strut_stroke_max_m[leg] = result.strut_stroke_max_m[leg];
        report->tyre_force_max_N[leg] = result.tyre_force_max_N[leg];
    }
    report->state_hash = result.state_hash;
    if (report->failed)
        snprintf(report->failure, sizeof report->failure, "%s: %s at %g s", result.failed_element,
                 result.failed_quantity, result.failed_time_s);
    return BT_OK;
}
