#include "elements/hook_damper.h"

#define BT_HOOK_DAMPER(name)                                                                       \
    extern const bt_group bt_hook_damper_##name##_group;                                           \
    extern const bt_hook_damper_type bt_hook_damper_##name;
#include "elements/hook_dampers.def"
#undef BT_HOOK_DAMPER

#define BT_HOOK_DAMPER(name) &bt_hook_damper_##name##_group,
static const bt_group* const groups[] = {
#include "elements/hook_dampers.def"
};
#undef BT_HOOK_DAMPER

#define BT_HOOK_DAMPER(name) &bt_hook_damper_##name,
static const bt_hook_damper_type* const types[] = {
#include "elements/hook_dampers.def"
};
#undef BT_HOOK_DAMPER

#define BT_HOOK_DAMPER(name) #name,
static const char* const names[] = {
#include "elements/hook_dampers.def"
    NULL};
#undef BT_HOOK_DAMPER

const bt_variant bt_hook_damper_types =
    BT_VARIANT(groups, names, BT_HOOK_DAMPER_PARAMS_SIZE, "law of the damper");

void bt_hook_damper_prepare(const bt_hook_damper_variant* params, bt_hook_damper* damper) {
    *damper = (bt_hook_damper){.type = types[params->type]};
    damper->type->prepare(params->params, damper->data);
}

double bt_hook_damper_force(const bt_hook_damper* damper, double stroke_m, double rate_mps) {
    return damper->type->force(damper->data, stroke_m, rate_mps);
}

double bt_hook_damper_energy(const bt_hook_damper* damper, double stroke_m) {
    return damper->type->energy(damper->data, stroke_m);
}

double bt_hook_damper_step_limit(const bt_hook_damper* damper, double mass_kg) {
    return damper->type->step_limit(damper->data, mass_kg);
}

bt_law bt_hook_damper_law(const bt_hook_damper* damper, double stroke_m, const char** what) {
    return damper->type->law ? damper->type->law(damper->data, stroke_m, what) : BT_LAW_HOLDS;
}

bt_law bt_hook_damper_gas_law(const bt_gas_spring* gas, const bt_stops* stops, double stroke_m,
                              const char** what) {
    if (!(stroke_m > stops->stroke_max))
        return BT_LAW_HOLDS;
    const bool left = isfinite(bt_gas_spring_force(gas, stroke_m));
    *what = left ? "hook damper bottomed" : "no gas volume in the hook damper";
    return left ? BT_LAW_AT_LIMIT : BT_LAW_LEFT;
}
