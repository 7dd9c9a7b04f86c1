#include "report/timeline.h"

#include "report/playback_record.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>

static const double bounce_least_m = 2e-3; ///< lower ones are chatter of the shoe on the deck

__attribute__((format(printf, 3, 4))) static void note(bt_timeline* list, double time_s,
                                                       const char* format, ...) {
    if (list->count == BT_TIMELINE_MOST || !isfinite(time_s))
        return;
    va_list args;
    bt_moment* e = &list->at[list->count++];
    e->time_s = time_s;
    va_start(args, format);
    vsnprintf(e->what, sizeof e->what, format, args);
    va_end(args);
}

static double value(const bt_playback* rows, size_t row, int curve) {
    return (double)rows->curve[row * BT_CURVE_COUNT + (size_t)curve];
}

/// The first time a force is there; NAN when it never is.
static double first_s(const bt_playback* rows, int curve) {
    for (size_t i = 0; i < rows->count; ++i)
        if (value(rows, i, curve) > 0)
            return rows->time_s[i];
    return NAN;
}

/// Tops of the hook's way between two contacts with the deck, until it meets the cable.
static void note_bounces(bt_timeline* list, const bt_playback* rows, double until_s) {
    size_t top = 0;
    int bounces = 0;
    bool touched = false;
    for (size_t i = 0; i < rows->count && !(rows->time_s[i] > until_s); ++i) {
        const double height = value(rows, i, BT_CURVE_HOOK_HEIGHT);
        const double highest = value(rows, top, BT_CURVE_HOOK_HEIGHT);
        const bool down = value(rows, i, BT_CURVE_HOOK_DECK) > 0;
        if (touched && down && highest > bounce_least_m)
            note(list, rows->time_s[top], "top of bounce %d, %.0f mm", ++bounces, 1e3 * highest);
        touched = touched || down;
        if (down || height > highest)
            top = i;
    }
}

static void note_wheels(bt_timeline* list, const bt_playback* rows) {
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        note(list, first_s(rows, BT_CURVE_TYRE_CABLE + leg), "%s wheel on the cable",
             bt_leg_names[leg]);
}

// --- the wave -----------------------------------------------------------------------------------

/// Speed of a transverse wave at a place along the cable, m/s.
static double wave_speed(const bt_playback* p, size_t row, double y, double mass_kgpm) {
    const float* at = p->cable + row * 3 * (size_t)p->nodes + 1; // y of every node
    const float* tension = p->tension + row * (size_t)p->nodes;
    int node = 0;
    while (node + 2 < p->nodes && (double)at[3 * (node + 1)] <= y)
        ++node;
    const double from = (double)at[3 * node], to = (double)at[3 * (node + 1)];
    const double share = fmin(fmax((y - from) / (to - from), 0), 1);
    const double pull = (double)tension[node] + share * (double)(tension[node + 1] - tension[node]);
    return sqrt(fmax(pull, 0) / mass_kgpm);
}

/// When a wave that starts at `from` has run to `turn` and on to `to`; NAN when it never does.
static double arrival_s(const bt_playback* p, size_t row, double from, double turn, double to,
                        double mass_kgpm) {
    double y = from, left = fabs(turn - from) + fabs(to - turn), speed = 0;
    bool turned = turn == from;
    for (; row < p->count; ++row) {
        const double end = turned ? to : turn;
        speed = wave_speed(p, row, y, mass_kgpm);
        if (left <= 0)
            return p->time_s[row];
        if (row + 1 == p->count)
            break;
        const double way = speed * (p->time_s[row + 1] - p->time_s[row]);
        if (way >= left)
            return p->time_s[row] + left / speed;
        const double before = fabs(end - y);
        left -= way;
        if (way < before)
            y += end > y ? way : -way;
        else {
            y = end + (to > end ? way - before : before - way);
            turned = true;
        }
    }
    return speed > 0 ? p->time_s[p->count - 1] + left / speed : NAN;
}

/// The first of the two main wheels' waves to come to the hook's line, straight and from the first
/// support.
static void note_wave(bt_timeline* list, const bt_playback* p, const bt_model_params* model) {
    const bt_tyre_params* tyre = &model->aircraft.main_gear.tyre;
    const double half = 0.5 * tyre->width_m * (double)tyre->tyres;
    const double support = model->deck.cable.supports.first_m, mass = model->deck.cable.mass_kgpm;
    double straight = NAN, back = NAN;
    for (int leg = BT_LEG_LEFT; leg <= BT_LEG_RIGHT && p->nodes > 1; ++leg) {
        size_t row = 0;
        while (row < p->count && !(value(p, row, BT_CURVE_TYRE_CABLE + leg) > 0))
            ++row;
        if (row == p->count)
            continue;
        const double wheel = value(p, row, BT_CURVE_WHEEL_Y + leg),
                     hook = value(p, row, BT_CURVE_LIP + 1);
        const double out = wheel > hook ? 1 : -1;
        const double inner = wheel - out * half, outer = wheel + out * half;
        straight = fmin(straight, arrival_s(p, row, inner, inner, hook, mass));
        if (fabs(outer) < support)
            back = fmin(back, arrival_s(p, row, outer, out * support, hook, mass));
    }
    note(list, straight, "the wheels' wave reaches the hook's line: the cable comes down");
    note(list, back, "wave back from the first support: the cable comes up");
}

/// Where the lip passes under or over the cable's centre.
static void note_passage(bt_timeline* list, const bt_playback* rows) {
    for (size_t i = 1; i < rows->count; ++i) {
        if (value(rows, i, BT_CURVE_CABLE_AHEAD) > 0 ||
            value(rows, i - 1, BT_CURVE_CABLE_AHEAD) <= 0)
            continue;
        const bool under = value(rows, i, BT_CURVE_CABLE_HEIGHT) > value(rows, i, BT_CURVE_LIP + 2);
        note(list, rows->time_s[i], "the lip passes %s the cable", under ? "under" : "over");
        return;
    }
}

static int by_time(const void* a, const void* b) {
    const double x = ((const bt_moment*)a)->time_s, y = ((const bt_moment*)b)->time_s;
    return (x > y) - (x < y);
}

void bt_timeline_make(const bt_playback* p, const bt_model_params* model,
                      const bt_landing_result* result, bt_timeline* list) {
    list->count = 0;
    if (p->count == 0)
        return;
    note(list, 0, "touchdown");
    note(list, first_s(p, BT_CURVE_HOOK_DECK), "hook on the deck");
    note_bounces(list, p, result->time_of_contact_s);
    note_wheels(list, p);
    note_wave(list, p, model);
    note_passage(list, p);
    note(list, result->time_of_contact_s, "hook meets the cable");
    note(list, p->time_s[p->count - 1], "%s, %s", bt_outcome_name(result->outcome),
         bt_mode_text(result->mode));
    qsort(list->at, (size_t)list->count, sizeof list->at[0], by_time);
}
