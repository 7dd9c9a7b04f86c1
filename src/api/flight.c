#include "bolter/landing.h"

#include "api/case.h"
#include "landing/model.h"
#include "landing/view.h"

#include <stdatomic.h>
#include <stdlib.h>

/// A model and how many flights use it.
typedef struct shared_model {
    atomic_int users;
    bt_landing_model* model;
} shared_model;

struct bt_flight {
    shared_model* shared;
    bt_landing_state* state;
    bool on;
};

static void release_model(shared_model* shared) {
    if (!shared || atomic_fetch_sub(&shared->users, 1) > 1)
        return;
    bt_landing_model_destroy(shared->model);
    free(shared);
}

void bt_flight_destroy(bt_flight* flight) {
    if (!flight)
        return;
    bt_landing_state_destroy(flight->state);
    release_model(flight->shared);
    free(flight);
}

static bt_status assemble(const bt_case* opened, bt_flight* flight) {
    bt_diag diag = bt_case_diag(opened);
    BT_TRY(bt_group_check(&bt_model_group, &opened->study.model, "", &diag));
    flight->shared = calloc(1, sizeof *flight->shared);
    if (!flight->shared)
        return BT_ERR_MEMORY;
    atomic_init(&flight->shared->users, 1);
    bt_landing_model** model = &flight->shared->model;
    BT_TRY(bt_landing_model_create(model));
    BT_TRY(bt_landing_model_prepare(*model, &opened->study.model, &diag));
    BT_TRY(bt_landing_state_create(*model, &flight->state));
    flight->on = bt_landing_start(*model, flight->state);
    return BT_OK;
}

bt_status bt_flight_create(const bt_case* opened, bt_flight** created) {
    *created = NULL;
    bt_flight* flight = calloc(1, sizeof *flight);
    if (!flight)
        return BT_ERR_MEMORY;
    const bt_status status = assemble(opened, flight);
    if (status == BT_OK)
        *created = flight;
    else
        bt_flight_destroy(flight);
    return status;
}

bool bt_flight_step(bt_flight* flight) {
    if (flight->on)
        flight->on = bt_landing_step(flight->shared->model, flight->state);
    return flight->on;
}

void bt_flight_look(bt_flight* flight, bt_landing_watch* watch, void* user) {
    bt_landing_view view;
    bt_landing_observe(flight->shared->model, flight->state, !flight->on, &view);
    bt_case_show_line(&view, watch, user);
}

bt_status bt_flight_copy(const bt_flight* flight, bt_flight** copy) {
    *copy = NULL;
    bt_flight* made = calloc(1, sizeof *made);
    if (!made)
        return BT_ERR_MEMORY;
    made->shared = flight->shared;
    made->on = flight->on;
    atomic_fetch_add(&flight->shared->users, 1);
    if (bt_landing_state_create(flight->shared->model, &made->state) != BT_OK) {
        bt_flight_destroy(made);
        return BT_ERR_MEMORY;
    }
    bt_landing_state_copy(flight->shared->model, made->state, flight->state);
    *copy = made;
    return BT_OK;
}

bool bt_flight_equal(const bt_flight* a, const bt_flight* b) {
    return a->shared == b->shared && bt_landing_state_equal(a->shared->model, a->state, b->state);
}

bt_status bt_flight_report(const bt_flight* flight, bt_landing_report* report) {
    bt_landing_result result = {0};
    bt_landing_finish(flight->shared->model, flight->state, &result);
    return bt_case_report(&result, report) ? BT_OK : BT_ERR_ARG;
}
