/// The model of a landing: airframe, wires, and their static equilibrium.
#include "landing/parts.h"

#include "landing/ship.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// What a model may hold beside the airframe: assembled state, cable and its resting shape.
static const size_t arena_size = 500 * 1024;

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
    free(model);
}

size_t bt_landing_model_memory(const bt_landing_model* model) {
    return sizeof *model + model->arena.size;
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
    m->airframe_mark = m->arena.used;
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

/// Builds the wires and finds their equilibrium unless the last ones are the same.
static bt_status prepare_wires(bt_landing_model* m, const bt_model_params* p, bt_diag* diag) {
    const double pressing_mps2 = bt_ship_pressing(&p->deck.motion, p->deck.gravity_mps2);
    if (same_wires(m, p, pressing_mps2))
        return BT_OK;
    m->has_cable = false;
    m->pressing_mps2 = pressing_mps2;
    ++m->built;
    bt_arena_reset(&m->arena, m->airframe_mark);
    bt_cable_def def;
    bt_cable_def_init(&def, &p->deck.cable, pressing_mps2, m->segment_m);
    def.level = m->kernel;
    if (bt_cable_memory(def.count, 1) > m->arena.size - m->arena.used)
        return refuse_mesh(def.count, diag);
    BT_TRY(bt_cable_model_init(&m->cable, &def, &m->arena, diag));
    BT_TRY(bt_cable_state_init(&m->cable, &m->resting, &m->arena));
    BT_TRY(bt_cable_equilibrium(&m->cable, &m->resting, NULL, diag));
    m->wire_count = 1;
    m->wire[0] = (bt_wire){.position_m = 0, .cable = &m->cable, .resting = &m->resting};
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
