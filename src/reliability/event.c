#include "reliability/event.h"

#include "landing/wires.h"

#include <stdio.h>

static int engaged(const bt_event* event, const bt_landing_result* r) {
    (void)event;
    return r->outcome == BT_ENGAGED;
}

static int bolter(const bt_event* event, const bt_landing_result* r) {
    (void)event;
    return r->outcome == BT_MISSED;
}

static int wire(const bt_event* event, const bt_landing_result* r) {
    return r->outcome == BT_ENGAGED && r->wire == event->wire;
}

static int skip(const bt_event* event, const bt_landing_result* r) {
    (void)event;
    for (int i = 0; i < r->contact_count; ++i)
        if (r->contacts[i].mode == BT_MODE_BOUNCED_OVER ||
            r->contacts[i].mode == BT_MODE_RIDDEN_OVER)
            return 1;
    return 0;
}

static void add(bt_event* events, int* count, const char* name, const char* text,
                bt_event_indicator* indicator) {
    bt_event* e = &events[(*count)++];
    *e = (bt_event){.indicator = indicator};
    snprintf(e->name, sizeof e->name, "%s", name);
    snprintf(e->text, sizeof e->text, "%s", text);
}

int bt_events_of(const bt_study* study, bt_event events[BT_EVENT_MAX]) {
    const int wires = bt_wires_count(&study->model.deck);
    int count = 0;
    if (wires < 2)
        return 0;
    add(events, &count, "engaged", "the throat caught a wire", engaged);
    for (int k = 1; k <= wires; ++k) {
        char name[BT_EVENT_NAME_SIZE], text[BT_EVENT_TEXT_SIZE];
        snprintf(name, sizeof name, "wire_%d", k);
        snprintf(text, sizeof text, "the throat caught wire %d", k);
        add(events, &count, name, text, wire);
        events[count - 1].wire = k;
    }
    add(events, &count, "bolter", "the throat caught no wire", bolter);
    add(events, &count, "skip",
        "the hook bounced clear above a wire, or struck one and rode over it; the next may have "
        "held",
        skip);
    return count;
}

int bt_event_holds(const bt_event* event, const bt_landing_result* result) {
    return result->outcome == BT_FAILED ? -1 : event->indicator(event, result);
}
