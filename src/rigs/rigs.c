#include "rigs/rig.h"

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
