#include "landing/wires.h"

#include "landing/landing.h"

#include <math.h>
#include <stdio.h>

int bt_wires_count(const bt_deck_params* deck) {
    const bt_wires_params* w = &deck->wires;
    return w->positions.count > 0 ? w->positions.count : (int)w->number;
}

double bt_wires_position(const bt_deck_params* deck, int wire) {
    const bt_wires_params* w = &deck->wires;
    return w->positions.count > 0 ? w->positions.value[wire] - w->positions.value[0]
                                  : wire * w->spacing_m;
}

void bt_wires_cable(const bt_deck_params* deck, int wire, bt_cable_params* cable) {
    const bt_wires_params* w = &deck->wires;
    *cable = deck->cable;
    if (wire < w->pretensions.count)
        cable->pretension_N = w->pretensions.value[wire];
    if (wire < w->support_heights.count)
        cable->supports.height_m = w->support_heights.value[wire];
}

double bt_wires_least_spacing(const bt_model_params* model) {
    const bt_hook_profile_params* head = &model->aircraft.hook.profile;
    const double hook_m = head->shoe_radius_m + head->point_ahead_m + head->lip_radius_m +
                          2 * head->arm_radius_m + 2 * model->deck.cable.diameter_m;
    return fmax(hook_m, 2 * model->deck.cable.mesh.fine_length_m);
}

/// Errors with the key in front.
typedef struct checking {
    const bt_model_params* model;
    const char* path;
    bt_diag* diag;
} checking;

static const char* dot(const checking* c) {
    return *c->path ? "." : "";
}

static void check_count(const checking* c) {
    const bt_wires_params* w = &c->model->deck.wires;
    const int count = bt_wires_count(&c->model->deck);
    if (count > BT_WIRE_MAX)
        bt_diag_add(c->diag, BT_ERROR, BT_NOWHERE,
                    "%s%sdeck.wires.positions: %d wires; at most %d would do", c->path, dot(c),
                    count, (int)BT_WIRE_MAX);
    if (w->number != 1 && w->number != count)
        bt_diag_add(c->diag, BT_ERROR, BT_NOWHERE,
                    "%s%sdeck.wires.positions: lists %d wires, deck.wires.number says %d; one of "
                    "the two would do",
                    c->path, dot(c), count, (int)w->number);
}

static void check_list(const checking* c, const bt_list* list, const char* name) {
    const int count = bt_wires_count(&c->model->deck);
    if (list->count != 0 && list->count != count)
        bt_diag_add(c->diag, BT_ERROR, BT_NOWHERE,
                    "%s%sdeck.wires.%s: %d values for %d wires; %d values, one a wire, or none "
                    "would do",
                    c->path, dot(c), name, list->count, count, count);
}

static void check_spacing(const checking* c) {
    const bt_wires_params* w = &c->model->deck.wires;
    const double least_m = bt_wires_least_spacing(c->model);
    const char* key = w->positions.count > 0 ? "positions" : "spacing";
    for (int k = 1; k < bt_wires_count(&c->model->deck); ++k) {
        const double gap_m =
            bt_wires_position(&c->model->deck, k) - bt_wires_position(&c->model->deck, k - 1);
        if (gap_m < 0)
            bt_diag_add(c->diag, BT_ERROR, BT_NOWHERE,
                        "%s%sdeck.wires.positions: %g m after %g m is out of order; the order in "
                        "which a landing meets the wires, lowest x first, would do",
                        c->path, dot(c), w->positions.value[k], w->positions.value[k - 1]);
        else if (gap_m < least_m)
            bt_diag_add(c->diag, BT_ERROR, BT_NOWHERE,
                        "%s%sdeck.wires.%s: wires %d and %d lie %g m apart, within reach of one "
                        "hook's head or of the mesh; at least %.3g m would do",
                        c->path, dot(c), key, k, k + 1, gap_m, least_m);
        if (gap_m < least_m && w->positions.count == 0)
            break; // they are all alike
    }
}

static void check_distance(const checking* c) {
    const int count = bt_wires_count(&c->model->deck);
    const int64_t to = c->model->landing.distance_to;
    if (to > count)
        bt_diag_add(c->diag, BT_ERROR, BT_NOWHERE,
                    "%s%slanding.distance_to: there is no wire %lld; 1 .. %d (deck.wires) would do",
                    c->path, dot(c), (long long)to, count);
}

static void check_memory(const checking* c) {
    double length_m[BT_CABLE_SEGMENTS_MAX];
    bt_cable_def def;
    const int count = bt_wires_count(&c->model->deck);
    if (count == 1)
        return;
    bt_cable_def_init(&def, &c->model->deck.cable, 0, length_m);
    if (count * def.count > BT_DECK_SEGMENTS_MAX)
        bt_diag_add(c->diag, BT_ERROR, BT_NOWHERE,
                    "%s%sdeck.wires: %d wires of %d segments are more than the %d that a landing "
                    "has room for; segments (deck.cable.mesh) %.2g times as long would do",
                    c->path, dot(c), count, def.count, (int)BT_DECK_SEGMENTS_MAX,
                    0.05 + (double)(count * def.count) / BT_DECK_SEGMENTS_MAX);
}

void bt_wires_check(const bt_model_params* model, const char* path, bt_diag* diag) {
    const checking c = {model, path, diag};
    check_count(&c);
    check_list(&c, &model->deck.wires.pretensions, "pretensions");
    check_list(&c, &model->deck.wires.support_heights, "support_heights");
    check_spacing(&c);
    check_distance(&c);
    check_memory(&c);
}
