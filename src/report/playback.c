#include "report/playback.h"

#include "report/packed.h"
#include "report/playback_geometry.h"
#include "report/playback_record.h"
#include "report/timeline.h"

#include <math.h>
#include <stdlib.h>

enum { Q_SIZE = BT_PLAYBACK_Q };

#define AT(member) (offsetof(bt_landing_view, member) / sizeof(double))
#define WHEEL(leg, axis) (7 * (BT_BODY_NOSE_WHEEL + (leg)) + (axis))

/// Where a curve comes from.
typedef enum source { IN_VIEW, IN_Q, ON_HOOK, MADE } source;

/// In the order of bt_playback_curve: name in the page, place in its source.
static const struct {
    const char* name;
    source from;
    size_t at; ///< double in the view, in q, in the cable's wrench on the hook
} curves[BT_CURVE_COUNT] = {
    {"lip_x_m", IN_VIEW, AT(hook_lip_m)},
    {"lip_y_m", IN_VIEW, AT(hook_lip_m) + 1},
    {"lip_z_m", IN_VIEW, AT(hook_lip_m) + 2},
    {"hook_height_m", IN_VIEW, AT(hook_height_m)},
    {"hook_deck_N", IN_VIEW, AT(hook_deck_force_N)},
    {"cable_height_m", MADE, 0},
    {"cable_ahead_m", MADE, 0},
    {"cable_tension_N", MADE, 0},
    {"cable_hook_x_N", ON_HOOK, 0},
    {"cable_hook_y_N", ON_HOOK, 1},
    {"cable_hook_z_N", ON_HOOK, 2},
    {"tyre_nose_N", IN_VIEW, AT(tyre_force_N)},
    {"tyre_left_N", IN_VIEW, AT(tyre_force_N) + 1},
    {"tyre_right_N", IN_VIEW, AT(tyre_force_N) + 2},
    {"tyre_cable_nose_N", IN_VIEW, AT(tyre_cable_force_N)},
    {"tyre_cable_left_N", IN_VIEW, AT(tyre_cable_force_N) + 1},
    {"tyre_cable_right_N", IN_VIEW, AT(tyre_cable_force_N) + 2},
    {"strut_nose_N", IN_VIEW, AT(strut_force_N)},
    {"strut_left_N", IN_VIEW, AT(strut_force_N) + 1},
    {"strut_right_N", IN_VIEW, AT(strut_force_N) + 2},
    {"wheel_nose_x_m", IN_Q, WHEEL(BT_LEG_NOSE, 0)},
    {"wheel_left_x_m", IN_Q, WHEEL(BT_LEG_LEFT, 0)},
    {"wheel_right_x_m", IN_Q, WHEEL(BT_LEG_RIGHT, 0)},
    {"wheel_nose_y_m", IN_Q, WHEEL(BT_LEG_NOSE, 1)},
    {"wheel_left_y_m", IN_Q, WHEEL(BT_LEG_LEFT, 1)},
    {"wheel_right_y_m", IN_Q, WHEEL(BT_LEG_RIGHT, 1)},
};

bt_status bt_playback_create(int rows_most, int nodes_most, bt_playback** playback) {
    *playback = calloc(1, sizeof **playback);
    if (!*playback)
        return BT_ERR_MEMORY;
    (*playback)->rows_most = rows_most;
    (*playback)->nodes_most = nodes_most;
    (*playback)->awake_s = INFINITY;
    return BT_OK;
}

void bt_playback_destroy(bt_playback* p) {
    if (!p)
        return;
    free(p->time_s);
    free(p->q);
    free(p->cable);
    free(p->tension);
    free(p->curve);
    free(p);
}

// --- observing --------------------------------------------------------------------------------

/// How far apart the drawn points of the cable may lie: near where the hook comes as the model's
/// segments, under the wheels three times that, further apart towards the sheaves.
static double spacing_m(const bt_landing_view* view, double y) {
    const double hook = fabs(y - view->hook_lip_m[1]);
    double wheel = INFINITY;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        wheel = fmin(wheel, fabs(y - view->q[WHEEL(leg, 1)]));
    if (hook < 0.25)
        return 0.05;
    if (wheel < 0.4)
        return 0.15;
    return fmin(2, 0.2 + 0.06 * (hook - 0.25));
}

static int choose_nodes(const bt_landing_view* view, double scale, int* node, int most) {
    int count = 0;
    double last = -INFINITY;
    for (int i = 0; i < view->cable_count; ++i) {
        const double y = view->cable_y[i];
        const bool due = y - last >= scale * spacing_m(view, y) - 1e-6;
        if (!due && i != view->cable_count - 1)
            continue;
        if (count < most)
            node[count] = i;
        ++count;
        last = y;
    }
    return count;
}

static void start(bt_playback* p, const bt_landing_view* view) {
    double scale = view->cable_count <= p->nodes_most ? 0 : 1;
    do {
        p->nodes = choose_nodes(view, scale, p->node, p->nodes_most);
        scale *= 1.1;
    } while (p->nodes > p->nodes_most);
}

static bool resize(void** data, size_t size) {
    void* moved = realloc(*data, size);
    if (moved)
        *data = moved;
    return moved != NULL;
}

static bool grow(bt_playback* p) {
    if (p->count < p->room)
        return true;
    const size_t room = p->room ? 2 * p->room : 1024, nodes = (size_t)p->nodes;
    if (!resize((void**)&p->time_s, room * sizeof *p->time_s) ||
        !resize((void**)&p->q, room * Q_SIZE * sizeof *p->q) ||
        !resize((void**)&p->cable, (room * 3 * nodes + 1) * sizeof *p->cable) ||
        !resize((void**)&p->tension, (room * nodes + 1) * sizeof *p->tension) ||
        !resize((void**)&p->curve, room * BT_CURVE_COUNT * sizeof *p->curve))
        return false;
    p->room = room;
    return true;
}

/// Tension at a segment: the larger of its two neighbours', which is what pulls at it.
static double tension_at(const bt_landing_view* view, int segment) {
    const int last = view->cable_count - 2;
    const double before = view->cable_tension_N[segment > 0 ? segment - 1 : 0];
    return fmax(before, view->cable_tension_N[segment < last ? segment : last]);
}

static void keep_cable(bt_playback* p, const bt_landing_view* view) {
    float* at = p->cable + p->count * 3 * (size_t)p->nodes;
    float* tension = p->tension + p->count * (size_t)p->nodes;
    for (int i = 0; i < p->nodes; ++i) {
        const int segment = p->node[i];
        *at++ = (float)view->cable_x[segment];
        *at++ = (float)view->cable_y[segment];
        *at++ = (float)view->cable_z[segment];
        *tension++ = (float)tension_at(view, segment);
    }
}

/// The cable where the hook's plane cuts it, and its largest tension.
static void keep_made(const bt_landing_view* view, float* curve) {
    double most = 0;
    for (int i = 0; i + 1 < view->cable_count; ++i)
        most = fmax(most, view->cable_tension_N[i]);
    curve[BT_CURVE_CABLE_TENSION] = (float)most;
    curve[BT_CURVE_CABLE_HEIGHT] = curve[BT_CURVE_CABLE_AHEAD] = 0;
    const double y = view->hook_lip_m[1];
    for (int i = 0; i + 1 < view->cable_count; ++i) {
        const double y0 = view->cable_y[i], y1 = view->cable_y[i + 1];
        if (y < y0 || y >= y1)
            continue;
        const double share = (y - y0) / (y1 - y0);
        curve[BT_CURVE_CABLE_HEIGHT] =
            (float)(view->cable_z[i] + share * (view->cable_z[i + 1] - view->cable_z[i]));
        curve[BT_CURVE_CABLE_AHEAD] = (float)(view->cable_x[i] - view->hook_lip_m[0] +
                                              share * (view->cable_x[i + 1] - view->cable_x[i]));
        return;
    }
}

static void keep_curves(const bt_landing_view* view, float* curve) {
    const double* in_view = (const double*)(const void*)view;
    for (int i = 0; i < BT_CURVE_COUNT; ++i)
        switch (curves[i].from) {
        case IN_VIEW:
            curve[i] = (float)in_view[curves[i].at];
            break;
        case IN_Q:
            curve[i] = (float)view->q[curves[i].at];
            break;
        case ON_HOOK:
            curve[i] =
                (float)(view->cable_wrench ? view->cable_wrench[6 * BT_BODY_HOOK + curves[i].at]
                                           : 0);
            break;
        case MADE:
            break;
        }
    keep_made(view, curve);
}

void bt_playback_observe(void* user, const bt_landing_view* view) {
    bt_playback* p = user;
    if (p->out_of_memory)
        return;
    if (p->count == 0)
        start(p, view);
    if (!grow(p)) {
        p->out_of_memory = true;
        return;
    }
    if (view->cable_awake)
        p->awake_s = fmin(p->awake_s, view->time_s);
    p->time_s[p->count] = view->time_s;
    for (size_t i = 0; i < Q_SIZE; ++i)
        p->q[p->count * Q_SIZE + i] = (float)view->q[i];
    keep_cable(p, view);
    keep_curves(view, p->curve + p->count * BT_CURVE_COUNT);
    ++p->count;
}

// --- which rows are written -------------------------------------------------------------------

/// When the lip came closest to the cable's place, s.
static double meeting_s(const bt_playback* p) {
    size_t best = 0;
    for (size_t i = 0; i < p->count; ++i)
        if (fabsf(p->curve[i * BT_CURVE_COUNT + BT_CURVE_CABLE_AHEAD]) <
            fabsf(p->curve[best * BT_CURVE_COUNT + BT_CURVE_CABLE_AHEAD]))
            best = i;
    return p->time_s[best];
}

static size_t choose_rows(const bt_playback* p, double scale, double meeting, size_t* row) {
    size_t count = 0;
    double last = -INFINITY;
    for (size_t i = 0; i < p->count; ++i) {
        const double t = p->time_s[i];
        const double apart = fabs(t - meeting) < 0.012 ? 2.5e-4 : t >= p->awake_s ? 1e-3 : 2e-3;
        if (t - last < scale * apart - 1e-9 && i != p->count - 1)
            continue;
        row[count++] = i;
        last = t;
    }
    return count;
}

size_t bt_playback_choose_rows(const bt_playback* p, size_t* row) {
    const double meeting = meeting_s(p);
    double scale = 1;
    size_t rows;
    do {
        rows = choose_rows(p, scale, meeting, row);
        scale *= 1.05;
    } while (rows > (size_t)p->rows_most && scale < 1e9);
    return rows;
}

// --- JSON -------------------------------------------------------------------------------------

/// What is being written: chosen rows of a record.
typedef struct writer {
    bt_json* json;
    const bt_playback* p;
    const size_t* row;
    size_t rows;
    float* values; ///< room for any matrix
} writer;

/// Columns [first, first + some) of every group of `stride` in rows of `width`.
static void put_matrix(const writer* w, const char* key, const float* data, size_t width,
                       size_t stride, size_t first, size_t some) {
    size_t count = 0;
    for (size_t i = 0; i < w->rows; ++i)
        for (size_t group = 0; group < width / stride; ++group)
            for (size_t k = first; k < first + some; ++k)
                w->values[count++] = data[w->row[i] * width + group * stride + k];
    bt_json_steps(w->json, key, (int)(width / stride * some), w->values, count);
}

static void put_bodies(const writer* w) {
    bt_json_begin_object(w->json, "bodies");
    bt_json_begin_array(w->json, "names");
    for (int body = 0; body < BT_BODY_COUNT; ++body)
        bt_json_string(w->json, NULL, bt_body_names[body]);
    bt_json_end_array(w->json);
    put_matrix(w, "position", w->p->q, Q_SIZE, 7, 0, 3);
    put_matrix(w, "attitude", w->p->q, Q_SIZE, 7, 3, 4);
    bt_json_end_object(w->json);
}

static void put_cable(const writer* w) {
    const size_t nodes = (size_t)w->p->nodes;
    bt_json_begin_object(w->json, "cable");
    bt_json_integer(w->json, "nodes", w->p->nodes);
    put_matrix(w, "position", w->p->cable, 3 * nodes, 3 * nodes, 0, 3 * nodes);
    put_matrix(w, "tension", w->p->tension, nodes, nodes, 0, nodes);
    bt_json_end_object(w->json);
}

static void put_curves(const writer* w) {
    bt_json_begin_object(w->json, "curves");
    for (size_t i = 0; i < BT_CURVE_COUNT; ++i)
        put_matrix(w, curves[i].name, w->p->curve, BT_CURVE_COUNT, BT_CURVE_COUNT, i, 1);
    bt_json_end_object(w->json);
}

/// An arrow's largest length, m, for the largest of a curve's values.
static double scale_of(const bt_playback* p, int first, int count, double length_m) {
    double most = 1;
    for (size_t i = 0; i < p->count; ++i) {
        double sum = 0;
        for (int k = 0; k < count; ++k) {
            const double value = (double)p->curve[i * BT_CURVE_COUNT + (size_t)(first + k)];
            sum += value * value;
        }
        most = fmax(most, sqrt(sum));
    }
    return length_m / most;
}

static void put_force(bt_json* json, const char* curve, const char* x, const char* y,
                      double scale) {
    bt_json_begin_object(json, NULL);
    bt_json_string(json, "curve", curve);
    bt_json_string(json, "x", x);
    bt_json_string(json, "y", y);
    bt_json_rounded(json, "metres_per_newton", scale, 4);
    bt_json_end_object(json);
}

static void put_forces(bt_json* json, const bt_playback* p) {
    const double tyres =
        fmin(scale_of(p, BT_CURVE_TYRE, 1, 2),
             fmin(scale_of(p, BT_CURVE_TYRE + 1, 1, 2), scale_of(p, BT_CURVE_TYRE + 2, 1, 2)));
    bt_json_begin_array(json, "forces");
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        put_force(json, curves[BT_CURVE_TYRE + leg].name, curves[BT_CURVE_WHEEL_X + leg].name,
                  curves[BT_CURVE_WHEEL_Y + leg].name, tyres);
    put_force(json, "hook_deck_N", "lip_x_m", "lip_y_m", scale_of(p, BT_CURVE_HOOK_DECK, 1, 0.3));
    bt_json_begin_object(json, NULL);
    bt_json_begin_array(json, "vector");
    for (int k = 0; k < 3; ++k)
        bt_json_string(json, NULL, curves[BT_CURVE_CABLE_HOOK + k].name);
    bt_json_end_array(json);
    bt_json_begin_array(json, "at");
    for (int k = 0; k < 3; ++k)
        bt_json_string(json, NULL, curves[BT_CURVE_LIP + k].name);
    bt_json_end_array(json);
    bt_json_rounded(json, "metres_per_newton", scale_of(p, BT_CURVE_CABLE_HOOK, 3, 0.4), 4);
    bt_json_end_object(json);
    bt_json_end_array(json);
}

/// What happened up to the end of the record.
static void put_events(bt_json* json, const bt_playback* p, const bt_model_params* model,
                       const bt_landing_result* result) {
    bt_timeline timeline;
    bt_timeline_make(p, model, result, &timeline);
    bt_json_begin_array(json, "events");
    for (int i = 0; i < timeline.count; ++i) {
        if (timeline.at[i].time_s > p->time_s[p->count - 1])
            continue;
        bt_json_begin_object(json, NULL);
        bt_json_rounded(json, "time_s", timeline.at[i].time_s, 7);
        bt_json_string(json, "what", timeline.at[i].what);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}

static bt_status put_geometry(bt_json* json, const bt_playback* p, const bt_model_params* model,
                              bt_diag* diag) {
    bt_airframe airframe;
    BT_TRY(bt_airframe_build(&model->aircraft, model->deck.gravity_mps2,
                             0.5 * model->deck.cable.diameter_m, &airframe, diag));
    bt_json_begin_object(json, "geometry");
    bt_geometry_write(json, &airframe, model);
    put_forces(json, p);
    bt_json_end_object(json);
    bt_airframe_destroy(&airframe);
    return BT_OK;
}

static bt_status put_rows(bt_json* json, const bt_playback* p, size_t* row, double* time,
                          float* values) {
    const writer w = {json, p, row, bt_playback_choose_rows(p, row), values};
    for (size_t i = 0; i < w.rows; ++i)
        time[i] = p->time_s[row[i]];
    bt_json_floats(json, "time", time, w.rows);
    put_bodies(&w);
    put_cable(&w);
    put_curves(&w);
    return BT_OK;
}

static bt_status put_motion(bt_json* json, const bt_playback* p) {
    const size_t cable = 3 * (size_t)p->nodes, widest = Q_SIZE > cable ? Q_SIZE : cable;
    size_t* row = malloc((p->count + 1) * sizeof *row);
    double* time = malloc((p->count + 1) * sizeof *time);
    float* values = malloc((p->count + 1) * widest * sizeof *values);
    const bt_status status =
        row && time && values ? put_rows(json, p, row, time, values) : BT_ERR_MEMORY;
    free(row);
    free(time);
    free(values);
    return status;
}

bt_status bt_playback_write(bt_json* json, const bt_playback* p, int64_t run, const char* name,
                            const bt_model_params* model, const bt_landing_result* result,
                            bt_diag* diag) {
    if (p->out_of_memory)
        return BT_ERR_MEMORY;
    if (p->count == 0)
        return BT_OK;
    bt_json_begin_object(json, NULL);
    bt_json_integer(json, "run", run);
    bt_json_string(json, "name", name);
    bt_json_string(json, "outcome", bt_outcome_name(result->outcome));
    bt_json_string(json, "mode", bt_mode_name(result->mode));
    bt_json_rounded(json, "margin_m", result->margin_m, 9);
    put_events(json, p, model, result);
    BT_TRY(put_motion(json, p));
    BT_TRY(put_geometry(json, p, model, diag));
    bt_json_end_object(json);
    return BT_OK;
}
