/// The state of a landing: one block.
#include "landing/parts.h"

#include <stdlib.h>
#include <string.h>

static size_t rounded(size_t size) {
    return (size + 63) / 64 * 64;
}

static size_t size_for(const bt_landing_model* m) {
    size_t size = rounded(sizeof(bt_landing_state)) + rounded(bt_state_size(m->airframe.system));
    for (int k = 0; k < m->wire_count; ++k)
        size += rounded(bt_cable_state_size(m->wire[k].cable)) +
                rounded(sizeof(double) * (size_t)m->wire[k].cable->count);
    return size;
}

bt_status bt_landing_state_create(const bt_landing_model* m, bt_landing_state** state) {
    const size_t size = size_for(m);
    bt_landing_state* s = *state = aligned_alloc(64, size);
    if (!s)
        return BT_ERR_MEMORY;
    memset(s, 0, size);
    s->built = m->built;
    s->size = size;
    bt_arena rest = {.base = (unsigned char*)s + rounded(sizeof *s),
                     .size = size - rounded(sizeof *s)};
    bt_status status = bt_state_create(m->airframe.system, &rest, &s->airframe);
    for (int k = 0; k < m->wire_count && status == BT_OK; ++k)
        status = bt_cable_state_init(m->wire[k].cable, &s->wire[k].cable, &rest);
    s->tension_N = BT_TAKE(&rest, double, m->wire[0].cable->count);
    if (status == BT_OK && !s->tension_N)
        status = BT_ERR_MEMORY;
    if (status == BT_OK)
        return BT_OK;
    free(s);
    *state = NULL;
    return status;
}

void bt_landing_state_destroy(bt_landing_state* state) {
    free(state);
}

size_t bt_landing_state_memory(const bt_landing_state* state) {
    return state->size;
}

bool bt_landing_state_fits(const bt_landing_model* model, const bt_landing_state* state) {
    return state->built == model->built;
}

void bt_landing_state_copy(const bt_landing_model* m, bt_landing_state* to,
                           const bt_landing_state* from) {
    if (to == from)
        return;
    const bt_landing_state own = *to; // its pointers, which lead into its own block
    *to = *from;
    to->airframe = own.airframe;
    to->tension_N = own.tension_N;
    bt_state_copy(m->airframe.system, &to->airframe, &from->airframe);
    for (int k = 0; k < m->wire_count; ++k) {
        to->wire[k].cable = own.wire[k].cable;
        bt_cable_state_copy(m->wire[k].cable, &to->wire[k].cable, &from->wire[k].cable);
    }
}

bool bt_landing_state_equal(const bt_landing_model* m, const bt_landing_state* a,
                            const bt_landing_state* b) {
    bool equal =
        a->phase == b->phase && bt_state_equal(m->airframe.system, &a->airframe, &b->airframe);
    for (int k = 0; k < m->wire_count; ++k)
        equal = equal && a->wire[k].awake == b->wire[k].awake &&
                bt_cable_state_equal(&a->wire[k].cable, &b->wire[k].cable);
    return equal;
}
