#include "rigs/rig.h"

#include <math.h>

static void check_drop(const void* params, const char* path, bt_diag* diag) {
    const bt_drop_params* p = params;
    if (p->drop_height_m > 0 && p->sink_speed_mps > 0)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.drop_height: sink_speed is given too; give one of them", path);
}

// clang-format off
#define ROW(kind, name, ...) BT_ROW_##kind(bt_drop_reference_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(drop_reference, BT_DROP_REFERENCE_FIELDS, ROW, NULL, "what a drop test measured")
#undef ROW
#define ROW(kind, name, ...) BT_ROW_##kind(bt_drop_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(drop, BT_DROP_FIELDS, ROW, check_drop, "drop test of one leg")
#undef ROW
#define ROW(kind, name, ...) BT_ROW_##kind(bt_rebound_reference_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(rebound_reference, BT_REBOUND_REFERENCE_FIELDS, ROW, NULL, "what a rebound test measured")
#undef ROW
#define ROW(kind, name, ...) BT_ROW_##kind(bt_rebound_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(rebound, BT_REBOUND_FIELDS, ROW, NULL, "rebound test of the hook")
#undef ROW
#define ROW(kind, name, ...) BT_ROW_##kind(bt_static_reference_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(static_reference, BT_STATIC_REFERENCE_FIELDS, ROW, NULL, "what a static test measured")
#undef ROW
#define ROW(kind, name, ...) BT_ROW_##kind(bt_static_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(static, BT_STATIC_FIELDS, ROW, NULL, "static load over stroke of one leg")
#undef ROW
#define ROW(kind, name, ...) BT_ROW_##kind(bt_rigs_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(rigs, BT_RIGS_FIELDS, ROW, NULL, "verification rigs")
#undef ROW
// clang-format on

const char* const bt_rig_keys[] = {"nose_drop",   "main_drop",   "hook_rebound",
                                   "nose_static", "main_static", NULL};

bool bt_rig_is_nose(bt_rig_kind kind) {
    return kind == BT_RIG_NOSE_DROP || kind == BT_RIG_NOSE_STATIC;
}

const char* const* bt_rig_channels(bt_rig_kind kind, int* count) {
    if (kind == BT_RIG_HOOK_REBOUND) {
        *count = BT_REBOUND_CHANNELS;
        return bt_rebound_channels;
    }
    const bool drop = kind == BT_RIG_NOSE_DROP || kind == BT_RIG_MAIN_DROP;
    *count = drop ? BT_DROP_CHANNELS : BT_STATIC_CHANNELS;
    return drop ? bt_drop_channels : bt_static_channels;
}

bt_status bt_rig_run(bt_rig_kind kind, const bt_aircraft_params* aircraft,
                     const bt_rigs_params* rigs, bt_rig_result* result, bt_rig_observer* observer,
                     void* user, bt_diag* diag) {
    if (kind == BT_RIG_HOOK_REBOUND)
        return bt_rig_run_rebound(&aircraft->hook, &rigs->hook_rebound, result, observer, user,
                                  diag);
    const bool nose = bt_rig_is_nose(kind);
    const bt_gear_params* gear = nose ? &aircraft->nose_gear : &aircraft->main_gear;
    if (kind == BT_RIG_NOSE_STATIC || kind == BT_RIG_MAIN_STATIC)
        return bt_rig_run_static(gear, nose ? &rigs->nose_static : &rigs->main_static, result,
                                 observer, user, diag);
    return bt_rig_run_drop(gear, nose ? &rigs->nose_drop : &rigs->main_drop, result, observer, user,
                           diag);
}

bt_status bt_rig_open(bt_rig* rig, bt_rig_observer* observer, void* user, bt_diag* diag) {
    *rig = (bt_rig){.observer = observer, .user = user, .diag = diag};
    return bt_system_create(&rig->system);
}

void bt_rig_close(bt_rig* rig) {
    bt_arena_destroy(&rig->arena);
    bt_system_destroy(rig->system);
}

bt_status bt_rig_start(bt_rig* rig, double gravity_mps2) {
    const double gravity[3] = {0, 0, -gravity_mps2};
    bt_system_set_gravity(rig->system, gravity);
    BT_TRY(bt_system_assemble(rig->system, rig->diag));
    BT_TRY(bt_arena_create(&rig->arena, bt_state_size(rig->system) + 64));
    return bt_state_create(rig->system, &rig->arena, &rig->state);
}

static bt_status report(const bt_rig* rig, bt_status status, const bt_failure* failure) {
    if (status == BT_ERR_NUMERIC)
        bt_diag_add(rig->diag, BT_ERROR, BT_NOWHERE,
                    "%s of %s diverged at %.6g s; a shorter step may do", failure->quantity,
                    failure->where, failure->time_s);
    return status;
}

bt_status bt_rig_step(bt_rig* rig, double step_s) {
    bt_failure failure = {"the rig", "motion", rig->state.time_s};
    return report(
        rig, bt_system_step(rig->system, &rig->state, step_s, BT_INTEGRATOR_SECOND_ORDER, &failure),
        &failure);
}

bt_status bt_rig_evaluate(bt_rig* rig) {
    bt_failure failure = {"the rig", "motion", rig->state.time_s};
    return report(rig, bt_system_evaluate(rig->system, &rig->state, &failure), &failure);
}

const double* bt_rig_output(const bt_rig* rig, int element) {
    return bt_system_element_output(rig->system, &rig->state, element);
}

void bt_rig_show_at(const bt_rig* rig, double time_s, int count, const char* const* names,
                    const double* values) {
    if (!rig->observer)
        return;
    const bt_rig_sample sample = {time_s, count, names, values};
    rig->observer(rig->user, &sample);
}

void bt_rig_show(const bt_rig* rig, int count, const char* const* names, const double* values) {
    bt_rig_show_at(rig, rig->state.time_s, count, names, values);
}

void bt_rig_add(bt_rig_result* result, const char* name, const char* unit, double value,
                double reference, double tolerance) {
    bt_metric* m = &result->metrics[result->metric_count++];
    *m = (bt_metric){name, unit, value, NAN, NAN, NAN, true};
    if (!(reference > 0))
        return;
    m->tolerance = tolerance;
    m->reference = reference;
    m->error_percent = 100 * (value - reference) / reference;
    m->accepted = fabs(m->error_percent) <= 100 * tolerance;
}
