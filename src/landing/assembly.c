/// The model of a landing: airframe, wires, and their static equilibrium.
#include "landing/parts.h"

#include "landing/ship.h"
#include "landing/wires.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// What a model may hold beside airframe and cables: the assembled state.
static const size_t arena_size = 32 * 1024;

bt_status bt_landing_model_create(bt_landing_model** model) {
    *model = calloc(1, sizeof **model);
    if (!*model)
        return BT_ERR_MEMORY;
    const bt_status status = bt_arena_create(&(*model)->arena, arena_size);
    if (status != BT_OK) {
        free(*model);
        *model = NULL;
    }
    return status;
}

void bt_landing_model_destroy(bt_landing_model* model) {
    if (!model)
        return;
    if (model->has_airframe)
        bt_airframe_destroy(&model->airframe);
    bt_arena_destroy(&model->arena);
    bt_arena_destroy(&model->wire_arena);
    free(model);
}

size_t bt_landing_model_memory(const bt_landing_model* model) {
    return sizeof *model + model->arena.size + model->wire_arena.size;
}

/// Builds the airframe unless the last one is the same.
static bt_status prepare_airframe(bt_landing_model* m, const bt_model_params* p, bt_diag* diag) {
    if (m->has_airframe && memcmp(&m->params.aircraft, &p->aircraft, sizeof p->aircraft) == 0 &&
        m->params.deck.gravity_mps2 == p->deck.gravity_mps2 &&
        m->params.deck.cable.diameter_m == p->deck.cable.diameter_m)
        return BT_OK;
    if (m->has_airframe)
        bt_airframe_destroy(&m->airframe);
    m->has_airframe = m->has_cable = false;
    ++m->built;
    bt_arena_reset(&m->arena, 0);
    BT_TRY(bt_airframe_build(&p->aircraft, p->deck.gravity_mps2, 0.5 * p->deck.cable.diameter_m,
                             &m->airframe, diag));
    m->has_airframe = true;
    BT_TRY(bt_state_create(m->airframe.system, &m->arena, &m->hanging));
    return BT_OK;
}

static bt_status refuse_mesh(int count, bt_diag* diag) {
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                "deck.cable.mesh: %d segments need more than the memory of one landing; coarser "
                "segments or a smaller fine_half_width would do",
                count);
    return BT_ERR_INPUT;
}

/// Whether the wires are those of the last call: how the ship moves matters by what presses them
/// down alone.
static bool same_wires(const bt_landing_model* m, const bt_model_params* p, double pressing_mps2) {
    bt_deck_params last = m->params.deck;
    last.motion = p->deck.motion;
    return m->has_cable && m->pressing_mps2 == pressing_mps2 &&
           memcmp(&last, &p->deck, sizeof last) == 0;
}

/// Room for so many cables and their resting shapes; the block grows and never shrinks.
static bt_status reserve(bt_arena* arena, size_t size) {
    bt_arena_reset(arena, 0);
    if (arena->size >= size)
        return BT_OK;
    bt_arena_destroy(arena);
    return bt_arena_create(arena, size);
}

/// The first wire with the same cable; `wire` itself when there is none before it.
static int like(const bt_deck_params* deck, int wire) {
    bt_cable_params mine, other;
    bt_wires_cable(deck, wire, &mine);
    for (int k = 0; k < wire; ++k) {
        bt_wires_cable(deck, k, &other);
        if (mine.pretension_N == other.pretension_N &&
            mine.supports.height_m == other.supports.height_m)
            return k;
    }
    return wire;
}

static bt_status build_cable(bt_landing_model* m, const bt_cable_params* p, double gravity_mps2,
                             int at, bt_diag* diag) {
    bt_cable_def def;
    bt_cable_def_init(&def, p, gravity_mps2, m->segment_m);
    def.level = m->kernel;
    BT_TRY(bt_cable_model_init(&m->cable[at], &def, &m->wire_arena, diag));
    BT_TRY(bt_cable_state_init(&m->cable[at], &m->resting[at], &m->wire_arena));
    return bt_cable_equilibrium(&m->cable[at], &m->resting[at], NULL, diag);
}

/// Wires that are alike share cable and resting shape.
static bt_status build_wires(bt_landing_model* m, const bt_deck_params* deck, bt_diag* diag) {
    for (int k = 0; k < m->wire_count; ++k) {
        const int at = like(deck, k);
        bt_cable_params cable;
        bt_wires_cable(deck, k, &cable);
        if (at == k)
            BT_TRY(build_cable(m, &cable, m->pressing_mps2, k, diag));
        m->wire[k] = (bt_wire){.number = k + 1,
                               .position_m = bt_wires_position(deck, k),
                               .cable = &m->cable[at],
                               .resting = &m->resting[at]};
    }
    return BT_OK;
}

/// Builds the wires and finds their equilibrium unless the last ones are the same.
static bt_status prepare_wires(bt_landing_model* m, const bt_model_params* p, bt_diag* diag) {
    const double pressing_mps2 = bt_ship_pressing(&p->deck.motion, p->deck.gravity_mps2);
    if (same_wires(m, p, pressing_mps2))
        return BT_OK;
    m->has_cable = false;
    m->pressing_mps2 = pressing_mps2;
    ++m->built;
    bt_cable_def def;
    bt_cable_def_init(&def, &p->deck.cable, pressing_mps2, m->segment_m);
    m->wire_count = bt_wires_count(&p->deck);
    if (def.count > BT_LANDING_SEGMENTS_MAX || m->wire_count * def.count > BT_DECK_SEGMENTS_MAX)
        return refuse_mesh(def.count, diag);
    int unlike = 0;
    for (int k = 0; k < m->wire_count; ++k)
        unlike += like(&p->deck, k) == k;
    BT_TRY(reserve(&m->wire_arena, (size_t)unlike * bt_cable_memory(def.count, 1)));
    BT_TRY(build_wires(m, &p->deck, diag));
    m->has_cable = true;
    return BT_OK;
}

void bt_landing_model_use_kernel(bt_landing_model* model, bt_kernel_level level) {
    model->kernel = level;
    model->has_cable = false;
}

/// All wheels must be before the wires when a rolling aircraft begins.
static bt_status check_clear(const bt_landing_model* m, bt_diag* diag) {
    static const double margin_m = 0.1;
    const bt_landing_params* p = &m->params.landing;
    const bt_glide* at = &m->stance.at;
    const double from_m =
        p->distance_from == BT_DISTANCE_FROM_HOOK ? at->hook_m[0] : at->tyre_m[BT_LEG_LEFT][0];
    const double least_m =
        at->tyre_m[BT_LEG_NOSE][0] + m->airframe.tyre[BT_LEG_NOSE].radius + margin_m - from_m;
    if (p->distance_m >= least_m)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                "landing.distance: %g m: an aircraft that rolls in begins with all its wheels "
                "before the wire; at least %.4g m would do",
                p->distance_m, ceil(100 * least_m) / 100);
    return BT_ERR_INPUT;
}

/// How an aircraft that rolls in stands, and its lift there.
static bt_status prepare_stance(bt_landing_model* m, bt_diag* diag) {
    bt_model_params* p = &m->params;
    bt_frame frame = m->hanging.frame;
    if (m->moves)
        bt_ship_frame(&p->deck.motion, p->deck.gravity_mps2, 1, 0, &frame);
    BT_TRY(bt_stance_find(&m->airframe, p, &m->hanging, &frame, &m->stance, diag));
    p->landing.pitch_rad = m->stance.pitch_rad;
    BT_TRY(bt_lift_check(&p->landing, "", diag) ? BT_OK : BT_ERR_INPUT);
    bt_lift_prepare(&m->airframe.lift, p, m->stance.pitch_rad);
    return check_clear(m, diag);
}

bt_status bt_landing_model_prepare(bt_landing_model* model, const bt_model_params* params,
                                   bt_diag* diag) {
    BT_TRY(prepare_airframe(model, params, diag));
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        model->airframe.tyre[leg].strips = (int)params->landing.solver.tyre_strips;
    const bt_status status = prepare_wires(model, params, diag);
    model->params = *params; // also when the wires are refused: the airframe may be a new one
    model->moves = bt_ship_accelerates(&params->deck.motion);
    bt_lift_prepare(&model->airframe.lift, params, params->landing.pitch_rad);
    if (params->landing.start == BT_START_GLIDE)
        bt_ship_relative(&params->deck.motion, &model->params.landing);
    else if (status == BT_OK)
        return prepare_stance(model, diag);
    return status;
}
