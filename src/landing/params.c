#include "landing/params.h"

#include "landing/landing.h"
#include "landing/lift.h"
#include "landing/profile.h"
#include "landing/shank.h"
#include "landing/ship.h"
#include "landing/stable_step.h"
#include "landing/wires.h"

#include <stdio.h>

const char* const bt_distance_from_names[] = {"hook", "main_wheels", NULL};
const char* const bt_start_names[] = {"glide", "rolling", NULL};
const char* const bt_lift_law_names[] = {"constant", "aerodynamic", NULL};

#define ROW(kind, name, ...) BT_ROW_##kind(bt_hook_profile_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(hook_profile, BT_HOOK_PROFILE_FIELDS, ROW, NULL,
                "the head's outline in its plane of symmetry")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_hook_cable_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(hook_cable, BT_HOOK_CABLE_FIELDS, ROW, NULL, "contact of hook and cable")
#undef ROW

static void check_hook(const void* params, const char* path, bt_diag* diag) {
    const bt_hook_params* hook = params;
    const double about_centre =
        hook->inertia_kgm2 - hook->mass_kg * hook->mass_centre_m * hook->mass_centre_m;
    if (!(about_centre > 0))
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.inertia: %g kg m^2 about the pivot is not above mass mass_centre^2 = %g "
                    "kg m^2",
                    path, hook->inertia_kgm2,
                    hook->mass_kg * hook->mass_centre_m * hook->mass_centre_m);
    bt_shank shank;
    bt_shank_prepare(hook, &shank);
    if (about_centre > 0 && !bt_shank_is_sound(&shank))
        bt_diag_add(
            diag, BT_ERROR, BT_NOWHERE,
            "%s.shank_bending_stiffness: length, damper_lever, mass, mass_centre and inertia "
            "leave no mass to one of the two parts of the shank, joined %g m from the pivot",
            path, shank.joint_m);
    const double weight_Nm = 9.81 * shank.head.mass_kg * (shank.head.centre_m - shank.joint_m);
    if (shank.bends && weight_Nm > 0.1 * shank.stiffness_Nmprad)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.shank_bending_stiffness: %g N m^2 bends by more than 0.1 rad under the "
                    "hook's own weight; 0 is a rigid shank",
                    path, hook->shank_bending_stiffness_Nm2);
}

#define ROW(kind, name, ...) BT_ROW_##kind(bt_hook_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(hook, BT_HOOK_FIELDS, ROW, check_hook, "the arresting hook and what holds it")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_tail_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(tail, BT_TAIL_FIELDS, ROW, NULL, "a point of the fuselage that must clear the deck")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_aircraft_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(aircraft, BT_AIRCRAFT_FIELDS, ROW, NULL, "the aircraft")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_heave_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(heave, BT_HEAVE_FIELDS, ROW, NULL, "heave of the deck")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_sway_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(sway, BT_SWAY_FIELDS, ROW, NULL, "pitch or roll of the ship")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_motion_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(motion, BT_MOTION_FIELDS, ROW, NULL, "how the ship moves during the landing")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_wires_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(wires, BT_WIRES_FIELDS, ROW, NULL, "the wires of the deck")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_deck_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(deck, BT_DECK_FIELDS, ROW, NULL, "the deck and its cable")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_solver_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(solver, BT_SOLVER_FIELDS, ROW, NULL, "steps and limits of the computation")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_lift_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(lift, BT_LIFT_FIELDS, ROW, NULL, "lift after touchdown")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_landing_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(landing, BT_LANDING_FIELDS, ROW, NULL, "how the aircraft comes down")
#undef ROW

/// A step above the stable one does not follow what happens, even when nothing diverges.
static void check_steps(const bt_model_params* model, const char* path, bt_diag* diag) {
    bt_stable_step steps[BT_STABLE_STEP_MAX];
    const int count = bt_airframe_stable_steps(model, steps);
    for (int i = 0; i < count; ++i)
        if (steps[i].used_s > steps[i].stable_s)
            bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                        "%s%s%s: %.4g us is above the stable step of %s; at most %.4g us", path,
                        *path ? "." : "", steps[i].setting, 1e6 * steps[i].used_s, steps[i].element,
                        1e6 * steps[i].stable_s);
}

/// A landing has its memory from the start; a mesh must fit into it.
static void check_mesh_size(const bt_cable_params* cable, const char* path, bt_diag* diag) {
    double length_m[BT_CABLE_SEGMENTS_MAX];
    bt_cable_def def;
    bt_cable_def_init(&def, cable, 0, length_m);
    if (def.count > BT_LANDING_SEGMENTS_MAX)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s%sdeck.cable.mesh: gives %d segments, a landing has room for %d; segments "
                    "%.2g times as long or narrower parts would do",
                    path, *path ? "." : "", def.count, (int)BT_LANDING_SEGMENTS_MAX,
                    0.05 + (double)def.count / BT_LANDING_SEGMENTS_MAX);
}

/// An aircraft that rolls in goes straight along the deck.
static void check_rolling(const bt_landing_params* landing, const char* path, bt_diag* diag) {
    const char* askew = landing->yaw_rad != 0 ? "yaw" : landing->drift_mps != 0 ? "drift" : NULL;
    if (landing->start == BT_START_ROLLING && askew)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s%slanding.%s: an aircraft that stands and rolls in does not slide; 0 would "
                    "do, or landing.start: glide",
                    path, *path ? "." : "", askew);
}

/// What only the parts together can say: the cable must fit the hook, the steps the parts.
static void check_model(const void* params, const char* path, bt_diag* diag) {
    const bt_model_params* model = params;
    const bt_hook_params* hook = &model->aircraft.hook;
    bt_profile profile;
    char place[128];
    if (!diag)
        return;
    snprintf(place, sizeof place, "%s%saircraft.hook.profile", path, *path ? "." : "");
    // its errors are in diag; the outline itself is not wanted here
    (void)!bt_profile_build(&hook->profile, hook->length_m, 0.5 * model->deck.cable.diameter_m,
                            place, &profile, diag);

    check_steps(model, path, diag);
    check_mesh_size(&model->deck.cable, path, diag);
    if (model->landing.start == BT_START_GLIDE)
        bt_lift_check(&model->landing, path, diag);
    check_rolling(&model->landing, path, diag);
    bt_ship_check(model, path, diag);
    bt_wires_check(model, path, diag);

    const bt_gear_params* gear = &model->aircraft.main_gear;
    const double track_m = 2 * gear->half_track_m + gear->tyre.width_m * (double)gear->tyre.tyres;
    if (model->deck.cable.span_m <= track_m)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s%sdeck.cable.span: %g m is less than the main wheels' track; more than %g m "
                    "would do",
                    path, *path ? "." : "", model->deck.cable.span_m, track_m);
}

#define ROW(kind, name, ...) BT_ROW_##kind(bt_model_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(model, BT_MODEL_FIELDS, ROW, check_model, "everything a landing depends on")
#undef ROW
