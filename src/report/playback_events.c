#include "report/playback_events.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>

enum { EVENTS_MAX = 40 };
static const double bounce_least_m = 2e-3; ///< lower ones are chatter of the shoe on the deck

typedef struct event {
    double time_s;
    char what[96];
} event;

typedef struct event_list {
    int count;
    event at[EVENTS_MAX];
} event_list;

__attribute__((format(printf, 3, 4))) static void note(event_list* list, double time_s,
                                                       const char* format, ...) {
    if (list->count == EVENTS_MAX || !isfinite(time_s))
        return;
    va_list args;
    event* e = &list->at[list->count++];
    e->time_s = time_s;
    va_start(args, format);
    vsnprintf(e->what, sizeof e->what, format, args);
    va_end(args);
}

static double value(const bt_playback_rows* rows, size_t row, int curve) {
    return (double)rows->curve[row * BT_CURVE_COUNT + (size_t)curve];
}

/// The first time a force is there; NAN when it never is.
static double first_s(const bt_playback_rows* rows, int curve) {
    for (size_t i = 0; i < rows->count; ++i)
        if (value(rows, i, curve) > 0)
            return rows->time_s[i];
    return NAN;
}

/// Tops of the hook's way between two contacts with the deck, until it meets the cable.
static void note_bounces(event_list* list, const bt_playback_rows* rows, double until_s) {
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

static void note_wheels(event_list* list, const bt_playback_rows* rows) {
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        note(list, first_s(rows, BT_CURVE_TYRE_CABLE + leg), "%s wheel on the cable",
             bt_leg_names[leg]);
}

/// Where the lip passes under or over the cable's centre.
static void note_passage(event_list* list, const bt_playback_rows* rows) {
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
    const double x = ((const event*)a)->time_s, y = ((const event*)b)->time_s;
    return (x > y) - (x < y);
}

void bt_playback_write_events(bt_json* json, const bt_playback_rows* rows,
                              const bt_landing_result* result) {
    event_list list = {0};
    note(&list, 0, "touchdown");
    note(&list, first_s(rows, BT_CURVE_HOOK_DECK), "hook on the deck");
    note_bounces(&list, rows, result->time_of_contact_s);
    note_wheels(&list, rows);
    note_passage(&list, rows);
    note(&list, result->time_of_contact_s, "hook meets the cable");
    note(&list, rows->time_s[rows->count - 1], "%s, %s", bt_outcome_name(result->outcome),
         bt_mode_text(result->mode));
    qsort(list.at, (size_t)list.count, sizeof list.at[0], by_time);
    bt_json_begin_array(json, "events");
    for (int i = 0; i < list.count; ++i) {
        bt_json_begin_object(json, NULL);
        bt_json_rounded(json, "time_s", list.at[i].time_s, 7);
        bt_json_string(json, "what", list.at[i].what);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}
