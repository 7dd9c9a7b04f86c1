#include "calibration/simulated_case.h"

#include "landing/view.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// --- metrics ----------------------------------------------------------------------------------

static const bt_metric_name drop_metrics[] = {
    {"stroke_max", "m"},
    {"sinkage_max", "m"},
    {"tyre_compression_max", "m"},
    {"tyre_force_max", "N"},
    {"strut_force_max", "N"},
    {"drag_force_max", "N"},
    {"efficiency", "1"},
    {"spin_up_time", "s"},
    {"strut_energy", "J"},
    {"tyre_energy", "J"},
    {"tyre_efficiency", "1"},
    {"side_force_max", "N"},
    {NULL, NULL},
};
static const bt_metric_name static_metrics[] = {
    {"load_extended", "N"}, {"load_compressed", "N"}, {"energy", "J"}, {"hysteresis", "J"},
    {NULL, NULL},
};
static const bt_metric_name rebound_metrics[] = {
    {"rebound_height", "m"},    {"bounce_distance", "m"}, {"impact_force", "N"},
    {"damper_stroke_max", "m"}, {"restitution", "1"},     {NULL, NULL},
};

static const bt_metric_name* rig_metrics(bt_simulated_case_kind kind) {
    static const bt_metric_name* const metrics[BT_CASE_KINDS] = {
        NULL, drop_metrics, drop_metrics, rebound_metrics, static_metrics, static_metrics};
    return metrics[kind];
}

/// A number of a landing, but for those that tell nothing of the aircraft.
static bool is_metric(const bt_result_column* column) {
    return column->kind == BT_RESULT_REAL &&
           column->offset != offsetof(bt_landing_result, failed_time_s) &&
           column->offset != offsetof(bt_landing_result, wall_s);
}

int bt_simulated_case_metric_count(bt_simulated_case_kind kind) {
    int count = 0;
    if (kind == BT_CASE_LANDING)
        return bt_result_column_count;
    while (rig_metrics(kind)[count].name)
        ++count;
    return count;
}

bool bt_simulated_case_metric(bt_simulated_case_kind kind, int index, bt_metric_name* metric) {
    if (kind != BT_CASE_LANDING) {
        *metric = rig_metrics(kind)[index];
        return true;
    }
    const bt_result_column* column = &bt_result_columns[index];
    *metric = (bt_metric_name){column->quantity, column->unit};
    return is_metric(column);
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

static void landing_values(const bt_landing_result* result, double* metric) {
    for (int i = 0; i < bt_result_column_count; ++i)
        if (is_metric(&bt_result_columns[i]))
            metric[i] = bt_result_real(&bt_result_columns[i], result);
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

/// Columns of a landing's history: those of the view, and the way of the hook from its first
/// contact with the deck on.
static const char travelled[] = "travelled_m";
enum { LANDING_COLUMN_MAX = 96 };

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
    double values[LANDING_COLUMN_MAX];
    for (int i = 0; i < bt_view_column_count; ++i)
        values[i] = bt_view_real(&bt_view_columns[i], view);
    values[bt_view_column_count] = t->touched ? view->hook_shoe_m[0] - t->touch_m : NAN;
    track(t, values);
}

// --- runs -------------------------------------------------------------------------------------

static bt_status run_landing(bt_lander* lander, const bt_parameter_set* set, double* metric,
                             tracker* t, bt_diag* diag) {
    bt_landing_result result;
    BT_TRY(bt_lander_run(lander, &set->model, &result, t->count ? track_landing : NULL, t, diag));
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
                                const bt_parameter_set* set, double* metric,
                                const bt_followed* followed, int followed_count, bt_diag* diag) {
    tracker t = {.followed = followed, .count = followed_count};
    bt_simulated_case_void(metric, followed, followed_count);
    if (kind == BT_CASE_LANDING)
        return run_landing(lander, set, metric, &t, diag);
    bt_rig_result result;
    const bt_status status = bt_rig_run(rig_of(kind), &set->model.aircraft, &set->rigs, &result,
                                        followed_count ? track_rig : NULL, &t, diag);
    if (status == BT_OK)
        rig_values(rig_metrics(kind), &result, metric);
    return status == BT_ERR_NUMERIC ? BT_OK : status;
}

// --- columns of a curve -----------------------------------------------------------------------

/// What is followed through a run is passed once: a loop is no curve to follow.
static bt_status refuse_loop(const bt_measured* measured, bt_diag* diag) {
    if (measured->ordered)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, measured->fall_place,
                "%s goes back; a curve is followed over what "
                "never decreases",
                measured->x_name);
    return BT_ERR_INPUT;
}

static bt_status bind_landing(bt_measured* measured, bt_diag* diag) {
    const char* names[LANDING_COLUMN_MAX];
    for (int i = 0; i < bt_view_column_count; ++i)
        names[i] = bt_view_columns[i].name;
    names[bt_view_column_count] = travelled;
    return bt_measured_bind(measured, names, bt_view_column_count + 1, diag);
}

bt_status bt_simulated_case_bind(bt_simulated_case_kind kind, bt_measured* measured,
                                 bt_diag* diag) {
    BT_TRY(refuse_loop(measured, diag));
    if (kind == BT_CASE_LANDING)
        return bind_landing(measured, diag);
    const char* names[1 + BT_RIG_CHANNEL_MAX] = {"time_s"};
    int count;
    const char* const* channels = bt_rig_channels(rig_of(kind), &count);
    memcpy(names + 1, channels, (size_t)count * sizeof *names);
    return bt_measured_bind(measured, names, count + 1, diag);
}
