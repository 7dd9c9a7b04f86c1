/// Events: what a landing did or did not do, as a number 1 or 0 of its result. The reliability
/// table gives the probability of each with an interval (events.h).
#ifndef BT_RELIABILITY_EVENT_H
#define BT_RELIABILITY_EVENT_H

#include "study/study.h"

enum { BT_EVENT_MAX = 32, BT_EVENT_NAME_SIZE = 48, BT_EVENT_TEXT_SIZE = 160 };

typedef struct bt_event bt_event;

/// 1: it happened; 0: it did not; -1: the landing says nothing (it failed). Pure.
typedef int bt_event_indicator(const bt_event* event, const bt_landing_result* result);

struct bt_event {
    char name[BT_EVENT_NAME_SIZE]; ///< "wire_2"
    char text[BT_EVENT_TEXT_SIZE]; ///< meaning; with the name all that the table depends on
    bt_event_indicator* indicator;
    int64_t wire; ///< of wire_N
};

/// The events of a study; how many. A deck of several wires has
///
///   engaged  the throat caught a wire
///   wire_N   it caught wire N
///   bolter   it caught none
///   skip     the hook came to a wire that it could have caught and left it behind: it bounced
///   clear
///            above it, or struck it and rode over (whatever the next wire brought)
///
/// so that engaged is the sum of all wire_N and 1 - bolter. A deck of one wire has none: engaged is
/// the table itself.
int bt_events_of(const bt_study* study, bt_event events[BT_EVENT_MAX]);

/// The indicator's value.
int bt_event_holds(const bt_event* event, const bt_landing_result* result);

#endif
