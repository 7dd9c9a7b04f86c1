/// Landings one after another.
#include "base/clock.h"
#include "landing/landing.h"
#include "landing/model.h"
#include "landing/view.h"

#include <stdlib.h>

struct bt_lander {
    bt_landing_model* model;
    bt_landing_state* state; ///< NULL until the first run
    const atomic_int* stop;  ///< may be NULL
};

bt_status bt_lander_create(bt_lander** lander) {
    bt_lander* l = *lander = calloc(1, sizeof **lander);
    if (!l)
        return BT_ERR_MEMORY;
    const bt_status status = bt_landing_model_create(&l->model);
    if (status != BT_OK) {
        free(l);
        *lander = NULL;
    }
    return status;
}

void bt_lander_destroy(bt_lander* lander) {
    if (!lander)
        return;
    bt_landing_state_destroy(lander->state);
    bt_landing_model_destroy(lander->model);
    free(lander);
}

void bt_lander_obey(bt_lander* lander, const atomic_int* stop) {
    lander->stop = stop;
}

static bool is_stopped(const bt_lander* l) {
    return l->stop && atomic_load_explicit(l->stop, memory_order_relaxed) != 0;
}

size_t bt_lander_memory(const bt_lander* lander) {
    return sizeof *lander + bt_landing_model_memory(lander->model) +
           (lander->state ? bt_landing_state_memory(lander->state) : 0);
}

bt_status bt_lander_prepare(bt_lander* lander, const bt_model_params* params, bt_diag* diag) {
    const bt_status status = bt_landing_model_prepare(lander->model, params, diag);
    return status == BT_ERR_NUMERIC ? BT_ERR_INPUT : status; // no equilibrium: said in diag
}

/// A state for the prepared model; one that fits is used again.
static bt_status prepare_state(bt_lander* l) {
    if (l->state && bt_landing_state_fits(l->model, l->state))
        return BT_OK;
    bt_landing_state_destroy(l->state);
    return bt_landing_state_create(l->model, &l->state);
}

static void show(const bt_lander* l, bt_landing_observer* observer, void* user, bool last) {
    if (!observer)
        return;
    bt_landing_view view;
    bt_landing_observe(l->model, l->state, last, &view);
    observer(user, &view);
}

bt_status bt_lander_run(bt_lander* lander, const bt_model_params* params, bt_landing_result* result,
                        bt_landing_observer* observer, void* user, bt_diag* diag) {
    const double begin_s = bt_clock_s();
    BT_TRY(bt_lander_prepare(lander, params, diag));
    BT_TRY(prepare_state(lander));
    const bt_landing_model* model = lander->model;
    bt_landing_state* state = lander->state;
    for (bool on = bt_landing_start(model, state); on; on = bt_landing_step(model, state)) {
        if (is_stopped(lander))
            return BT_ERR_INTERRUPTED;
        show(lander, observer, user, false);
    }
    show(lander, observer, user, true);
    bt_landing_finish(model, state, result);
    result->wall_s = bt_clock_s() - begin_s;
    return BT_OK;
}
