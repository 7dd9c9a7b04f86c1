#include "landing/params.h"

#include "landing/profile.h"

#include <stdio.h>

const char* const bt_distance_from_names[] = {"hook", "main_wheels", NULL};

#define ROW(kind, name, ...) BT_ROW_##kind(bt_gear_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(gear, BT_GEAR_FIELDS, ROW, NULL, "one leg: strut, piston, wheel and tyre")
#undef ROW

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
}

#define ROW(kind, name, ...) BT_ROW_##kind(bt_hook_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(hook, BT_HOOK_FIELDS, ROW, check_hook, "the arresting hook and what holds it")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_aircraft_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(aircraft, BT_AIRCRAFT_FIELDS, ROW, NULL, "the aircraft")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_deck_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(deck, BT_DECK_FIELDS, ROW, NULL, "the deck and its cable")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_solver_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(solver, BT_SOLVER_FIELDS, ROW, NULL, "steps and limits of the computation")
#undef ROW

#define ROW(kind, name, ...) BT_ROW_##kind(bt_landing_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(landing, BT_LANDING_FIELDS, ROW, NULL, "how the aircraft comes down")
#undef ROW

/// What only the parts together can say: the cable must fit the hook.
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
