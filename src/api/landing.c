#include "bolter/landing.h"

#include "api/case.h"
#include "base/units.h"
#include "landing/view.h"

#include <math.h>
#include <stdio.h>

/// At least as many numbers as a view has.
enum { VIEW_MAX = sizeof(bt_landing_view) / sizeof(double) };

bool bt_case_report(const bt_landing_result* result, bt_landing_report* report) {
    bt_landing_report full = {
        .size = report->size,
        .failed = result->outcome == BT_FAILED,
        .engaged = result->outcome == BT_ENGAGED,
        .retained = result->retained,
        .margin_m = result->margin_m,
        .throat_force_peak_N = result->throat_force_peak_N,
        .hook_deck_force_peak_N = result->hook_deck_force_peak_N,
        .cable_tension_max_N = result->cable_tension_max_N,
        .bounces = result->bounce_count,
        .state_hash = result->state_hash,
    };
    snprintf(full.mode, sizeof full.mode, "%s", bt_mode_name(result->mode));
    if (result->bounce_count > 0) {
        full.first_bounce_height_m = result->bounces[0].height_m;
        full.first_bounce_distance_m = result->bounces[0].distance_m;
    }
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        full.strut_stroke_max_m[leg] = result->strut_stroke_max_m[leg];
        full.tyre_force_max_N[leg] = result->tyre_force_max_N[leg];
    }
    if (full.failed)
        snprintf(full.failure, sizeof full.failure, "%s: %s at %g s", result->failed_element,
                 result->failed_quantity, result->failed_time_s);
    bt_remarks_print(&result->remarks, full.remarks, sizeof full.remarks);
    if (report->size < sizeof report->size)
        return false;
    memcpy(report, &full, report->size < sizeof full ? report->size : sizeof full);
    return true;
}

void bt_case_show_line(const bt_landing_view* view, bt_landing_watch* watch, void* user) {
    const char* names[VIEW_MAX];
    double values[VIEW_MAX];
    for (int i = 0; i < bt_view_column_count; ++i) {
        names[i] = bt_view_columns[i].name;
        values[i] = bt_view_real(&bt_view_columns[i], view);
    }
    const bt_landing_line line = {
        .time_s = view->time_s,
        .count = bt_view_column_count,
        .names = names,
        .values = values,
        .cable_count = view->cable_count,
        .cable_x_m = view->cable_x,
        .cable_y_m = view->cable_y,
        .cable_z_m = view->cable_z,
        .cable_tension_N = view->cable_tension_N,
    };
    watch(user, &line);
}

static void show_line(void* user, const bt_landing_view* view) {
    const bt_landing_def* def = user;
    bt_case_show_line(view, def->watch, def->user);
}

bt_status bt_case_land_watched(bt_case* opened, const bt_landing_def* def,
                               bt_landing_report* report) {
    bt_diag diag = bt_case_diag(opened);
    bt_landing_def wanted;
    opened->landed = false;
    if (!BT_DEF_COPY(wanted, def) || report->size < sizeof report->size)
        return BT_ERR_ARG;
    BT_TRY(bt_group_check(&bt_model_group, &opened->study.model, "", &diag));
    BT_TRY(bt_lander_run(opened->lander, &opened->study.model, &opened->last,
                         wanted.watch ? show_line : NULL, &wanted, &diag));
    opened->landed = true;
    return bt_case_report(&opened->last, report) ? BT_OK : BT_ERR_ARG;
}

bt_status bt_case_land(bt_case* opened, bt_landing_report* report) {
    const bt_landing_def def = {.size = sizeof def};
    return bt_case_land_watched(opened, &def, report);
}

void bt_results(bt_result_visit* visit, void* user) {
    for (int i = 0; i < bt_result_column_count; ++i) {
        const bt_result_column* column = &bt_result_columns[i];
        const bt_result_info info = {
            .name = column->name,
            .unit = bt_unit_text(*column->unit ? column->unit : "1"),
            .text = column->text,
        };
        if (!visit(user, &info))
            return;
    }
}

const char* bt_mode_label(int mode) {
    return mode >= 0 && mode < BT_MODE_COUNT ? bt_mode_name((bt_mode)mode) : NULL;
}

const bt_result_column* bt_case_column(const char* name) {
    for (int i = 0; i < bt_result_column_count; ++i) {
        const bt_result_kind kind = bt_result_columns[i].kind;
        const bool number =
            kind != BT_RESULT_TEXT && kind != BT_RESULT_REMARKS && kind != BT_RESULT_HASH;
        if (number && strcmp(bt_result_columns[i].name, name) == 0)
            return &bt_result_columns[i];
    }
    return NULL;
}

double bt_case_column_value(const bt_result_column* column, const bt_landing_result* result) {
    const char* member = (const char*)result + column->offset;
    switch (column->kind) {
    case BT_RESULT_REAL:
        return bt_result_real(column, result);
    case BT_RESULT_FLAG:
        return *(const bool*)member;
    case BT_RESULT_INT:
        return *(const int*)(const void*)member;
    case BT_RESULT_COUNT:
        return (double)*(const int64_t*)(const void*)member;
    case BT_RESULT_OUTCOME:
        return result->outcome == BT_FAILED ? NAN : result->outcome == BT_ENGAGED;
    case BT_RESULT_MODE:
        return result->mode;
    case BT_RESULT_TEXT:
    case BT_RESULT_REMARKS:
    case BT_RESULT_HASH:
        break;
    }
    return NAN;
}

bt_status bt_case_result(const bt_case* opened, const char* name, double* value) {
    const bt_result_column* column = bt_case_column(name);
    if (!column || !opened->landed)
        return BT_ERR_ARG;
    *value = bt_case_column_value(column, &opened->last);
    return BT_OK;
}
