#include "calibration/simulated_case.h"

#include "landing/view.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// --- metrics ----------------------------------------------------------------------------------

static const bt_metric_name landing_metrics[] = {
    {"bounce_height", "m"},
    {"bounce_distance", "m"},
    {"impact_force", "N"},
    {"second_bounce_height", "m"},
    {"hook_deck_force_peak", "N"},
    {"strut_stroke_max_nose", "m"},
    {"strut_stroke_max_left", "m"},
    {"strut_stroke_max_right", "m"},
    {"tyre_force_max_nose", "N"},
    {"tyre_force_max_left", "N"},
    {"tyre_force_max_right", "N"},
    {"cable_tension_max", "N"},
    {"throat_force_peak", "N"},
    {"margin", "m"},
    {NULL, NULL},
};
static const bt_metric_name drop_metrics[] = {
    {"stroke_max", "m"},     {"sinkage_max", "m"},     {"tyre_compression_max", "m"},
    {"tyre_force_max", "N"}, {"strut_force_max", "N"}, {"drag_force_max", "N"},
    {"efficiency", "1"},     {"spin_up_time", "s"},    {"strut_energy", "J"},
    {"tyre_energy", "J"},    {"tyre_efficiency", "1"}, {NULL, NULL},
};
static const bt_metric_name static_metrics[] = {
    {"load_extended", "N"}, {"load_compressed", "N"}, {"energy", "J"}, {"hysteresis", "J"},
    {NULL, NULL},
};
static const bt_metric_name rebound_metrics[] = {
    {"rebound_height", "m"},    {"bounce_distance", "m"}, {"impact_force", "N"},
    {"damper_stroke_max", "m"}, {"restitution", "1"},     {NULL, NULL},
};

const bt_metric_name* bt_simulated_case_metrics(bt_simulated_case_kind kind) {
    static const bt_metric_name* const metrics[BT_CASE_KINDS] = {landing_metrics, drop_metrics,
                                                                 drop_metrics,    rebound_metrics,
                                                                 static_metrics,  static_metrics};
    return metrics[kind];
}

const char* bt_simulated_case_prefix(bt_simulated_case_kind kind) {
    static const char* const prefixes[] = {
        "", "nose_drop.", "main_drop.", "hook_rebound.", "nose_static.", "main_static."};
    return prefixes[kind];
}

bt_parameter_set_part bt_simulated_case_part(bt_simulated_case_kind kind) {
    static const bt_parameter_set_part parts[BT_CASE_KINDS] = {
        BT_PART_LANDING, BT_PART_NOSE_GEAR, BT_PART_MAIN_GEAR,
        BT_PART_HOOK,    BT_PART_NOSE_GEAR, BT_PART_MAIN_GEAR};
    return parts[kind];
}

/// In the order of landing_metrics.
static void landing_values(const bt_landing_result* r, double* metric) {
    const bool first = r->bounce_count > 0 && r->bounces[0].complete;
    const bool second = r->bounce_count > 1;
    const double values[] = {
        first ? r->bounces[0].height_m : NAN,
        first ? r->bounces[0].distance_m : NAN,
        first ? r->bounces[0].impact_force_N : NAN,
        second ? r->bounces[1].height_m : NAN,
        r->hook_deck_force_peak_N,
        r->strut_stroke_max_m[BT_LEG_NOSE],
        r->strut_stroke_max_m[BT_LEG_LEFT],
        r->strut_stroke_max_m[BT_LEG_RIGHT],
        r->tyre_force_max_N[BT_LEG_NOSE],
        r->tyre_force_max_N[BT_LEG_LEFT],
        r->tyre_force_max_N[BT_LEG_RIGHT],
        r->cable_tension_max_N,
        r->throat_force_peak_N,
        r->margin_m,
    };
    memcpy(metric, values, sizeof values);
}

/// A rig names its metrics "stroke_max_m".
static void rig_values(const bt_metric_name* names, const bt_rig_result* r, double* metric) {
    for (int i = 0; names[i].name; ++i) {
        const size_t length = strlen(names[i].name);
        for (int k = 0; k < r->metric_count; ++k) {
            const char* full = r->metrics[k].name;
            if (strncmp(full, names[i].name, length) == 0 &&
                (full[length] == '\0' || strcmp(full + length + 1, names[i].token) == 0))
                metric[i] = r->metrics[k].value;
        }
    }
}

// --- histories --------------------------------------------------------------------------------

static const char* const landing_columns[] = {
    "time_s",
    "travelled_m", // of the hook, from its first contact with the deck on
    "hook_height_m",
    "hook_angle_rad",
    "hook_deck_force_N",
    "hook_damper_force_N",
    "nose_stroke_m",
    "left_stroke_m",
    "right_stroke_m",
    "nose_tyre_force_N",
    "left_tyre_force_N",
    "right_tyre_force_N",
};
enum { LANDING_COLUMN_COUNT = sizeof landing_columns / sizeof landing_columns[0] };

/// Follows measured curves through one run by interpolation between its samples.
typedef struct tracker {
    const bt_followed* followed;
    int count;
    int next[BT_TARGET_MAX]; ///< measured points that were passed
    bool begun[BT_TARGET_MAX];
    double x[BT_TARGET_MAX], y[BT_TARGET_MAX]; ///< the sample before
    double touch_m;                            ///< landing: where the hook first touched
    bool touched;
} tracker;

static void track(tracker* t, const double* values) {
    for (int i = 0; i < t->count; ++i) {
        const bt_measured* m = t->followed[i].measured;
        const double x = values[m->x_column], y = values[m->y_column];
        if (!isfinite(x))
            continue;
        for (; t->next[i] < m->count && m->x[t->next[i]] <= x; ++t->next[i]) {
            const double share = x > t->x[i] ? (m->x[t->next[i]] - t->x[i]) / (x - t->x[i]) : 1;
            if (t->begun[i] && share >= 0)
                t->followed[i].got[t->next[i]] = t->y[i] + share * (y - t->y[i]);
            else if (m->x[t->next[i]] >= x)
                t->followed[i].got[t->next[i]] = y;
        }
        t->begun[i] = true;
        t->x[i] = x;
        t->y[i] = y;
    }
}

static void track_rig(void* user, const bt_rig_sample* sample) {
    // a rig's history begins with its time, which stands apart from the other columns
    double values[1 + BT_RIG_CHANNEL_MAX] = {sample->time_s};
    memcpy(values + 1, sample->values, (size_t)sample->count * sizeof *values);
    track(user, values);
}

static void track_landing(void* user, const bt_landing_view* view) {
    tracker* t = user;
    if (!t->touched && view->hook_deck_force_N > 0) {
        t->touched = true;
        t->touch_m = view->hook_shoe_m[0];
    }
    const double values[LANDING_COLUMN_COUNT] = {
        view->time_s,
        t->touched ? view->hook_shoe_m[0] - t->touch_m : NAN,
        view->hook_height_m,
        view->hook_angle_rad,
        view->hook_deck_force_N,
        view->hook_damper_force_N,
        view->stroke_m[BT_LEG_NOSE],
        view->stroke_m[BT_LEG_LEFT],
        view->stroke_m[BT_LEG_RIGHT],
        view->tyre_force_N[BT_LEG_NOSE],
        view->tyre_force_N[BT_LEG_LEFT],
        view->tyre_force_N[BT_LEG_RIGHT],
    };
    track(t, values);
}

// --- runs -------------------------------------------------------------------------------------

static bt_status run_landing(bt_lander* lander, const bt_parameter_set* specimen, double* metric,
                             tracker* t, bt_diag* diag) {
    bt_landing_result result;
    BT_TRY(
        bt_lander_run(lander, &specimen->model, &result, t->count ? track_landing : NULL, t, diag));
    if (result.outcome == BT_FAILED)
        bt_diag_add(diag, BT_WARNING, BT_NOWHERE, "a landing diverged: %s, %s at %.4g s",
                    result.failed_element, result.failed_quantity, result.failed_time_s);
    else
        landing_values(&result, metric);
    return BT_OK;
}

static bt_rig_kind rig_of(bt_simulated_case_kind kind) {
    return (bt_rig_kind)(BT_RIG_NOSE_DROP + (kind - BT_CASE_NOSE_DROP));
}

void bt_simulated_case_void(double* metric, const bt_followed* followed, int followed_count) {
    for (int i = 0; i < BT_CASE_METRIC_MAX; ++i)
        metric[i] = NAN;
    for (int i = 0; i < followed_count; ++i)
        for (int k = 0; k < followed[i].measured->count; ++k)
            followed[i].got[k] = NAN;
}

bt_status bt_simulated_case_run(bt_lander* lander, bt_simulated_case_kind kind,
                                const bt_parameter_set* specimen, double* metric,
                                const bt_followed* followed, int followed_count, bt_diag* diag) {
    tracker t = {.followed = followed, .count = followed_count};
    bt_simulated_case_void(metric, followed, followed_count);
    if (kind == BT_CASE_LANDING)
        return run_landing(lander, specimen, metric, &t, diag);
    bt_rig_result result;
    const bt_status status = bt_rig_run(rig_of(kind), &specimen->model.aircraft, &specimen->rigs,
                                        &result, followed_count ? track_rig : NULL, &t, diag);
    if (status == BT_OK)
        rig_values(bt_simulated_case_metrics(kind), &result, metric);
    return status == BT_ERR_NUMERIC ? BT_OK : status;
}

// --- columns of a curve -----------------------------------------------------------------------

bt_status bt_simulated_case_bind(bt_simulated_case_kind kind, bt_measured* measured,
                                 bt_diag* diag) {
    if (kind == BT_CASE_LANDING)
        return bt_measured_bind(measured, landing_columns, LANDING_COLUMN_COUNT, diag);
    const char* names[1 + BT_RIG_CHANNEL_MAX] = {"time_s"};
    int count;
    const char* const* channels = bt_rig_channels(rig_of(kind), &count);
    memcpy(names + 1, channels, (size_t)count * sizeof *names);
    return bt_measured_bind(measured, names, count + 1, diag);
}
