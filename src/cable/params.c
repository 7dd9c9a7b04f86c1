/// The cable's keys: what can be said of them before a cable is built.
#include "cable/mesh.h"

#include <math.h>

#define MESH_ROW(kind, name, ...) BT_ROW_##kind(bt_cable_mesh_params, name, __VA_ARGS__)
#define SUPPORTS_ROW(kind, name, ...) BT_ROW_##kind(bt_cable_supports_params, name, __VA_ARGS__)
#define DECK_ROW(kind, name, ...) BT_ROW_##kind(bt_cable_deck_params, name, __VA_ARGS__)
#define SHEAVES_ROW(kind, name, ...) BT_ROW_##kind(bt_cable_sheaves_params, name, __VA_ARGS__)
#define CABLE_ROW(kind, name, ...) BT_ROW_##kind(bt_cable_params, name, __VA_ARGS__)

static void check_mesh(const void* params, const char* path, bt_diag* diag) {
    const bt_cable_mesh_params* p = params;
    if (p->medium_half_width_m < p->fine_half_width_m)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.medium_half_width: %g m lies inside the fine part; at least %g m", path,
                    p->medium_half_width_m, p->fine_half_width_m);
    if (p->medium_length_m < p->fine_length_m)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.medium_length: %g m is finer than the fine part; at least %g m", path,
                    p->medium_length_m, p->fine_length_m);
    if (p->coarse_length_m < p->medium_length_m)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.coarse_length: %g m is finer than the medium part; at least %g m", path,
                    p->coarse_length_m, p->medium_length_m);
}

BT_DEFINE_GROUP(cable_mesh, BT_CABLE_MESH_FIELDS, MESH_ROW, check_mesh,
                "segment lengths along the cable, symmetric about the middle")
BT_DEFINE_GROUP(cable_supports, BT_CABLE_SUPPORTS_FIELDS, SUPPORTS_ROW, NULL,
                "wire supports: leaf springs that hold the cable above the deck")
BT_DEFINE_GROUP(cable_deck, BT_CABLE_DECK_FIELDS, DECK_ROW, NULL, "cable on deck")
BT_DEFINE_GROUP(cable_sheaves, BT_CABLE_SHEAVES_FIELDS, SHEAVES_ROW, NULL,
                "deck sheaves and the purchase cable behind them")

static void check_cable(const void* params, const char* path, bt_diag* diag) {
    const bt_cable_params* p = params;
    const bt_cable_supports_params* s = &p->supports;
    if (!(p->span_m >= 2 * s->first_m + 0.6)) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.span: %g m does not reach past the first supports at +-%g m; at least %g m",
                    path, p->span_m, s->first_m, 2 * s->first_m + 0.6);
        return;
    }
    const int count = 2 * bt_cable_mesh_half(&p->mesh, 0.5 * p->span_m, NULL);
    if (count < 4 || count > BT_CABLE_SEGMENTS_MAX)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.mesh: gives %d segments or more; between 4 and %d are possible (coarser "
                    "lengths or narrower parts)",
                    path, count, (int)BT_CABLE_SEGMENTS_MAX);
    if (!(p->sheaves.height_m >= 0.5 * p->diameter_m))
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.sheaves.height: %g m puts the cable inside the deck; at least %g m (half "
                    "its diameter)",
                    path, p->sheaves.height_m, 0.5 * p->diameter_m);
    /* the heaviest bay carries its own weight; a support carries half of its two bays */
    const double weight = p->mass_kgpm * 9.80665;
    bt_list y;
    bt_cable_place_supports(p, &y);
    const double bay = y.count > 2 ? s->spacing_m : 0.5 * p->span_m - s->first_m;
    const double sink = weight * (s->first_m + 0.5 * bay) / s->stiffness_Npm;
    const double clear = s->height_m - sink;
    const double sag = weight * 4 * s->first_m * s->first_m / (8 * p->pretension_N);
    if (!(clear > 0))
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.supports.stiffness: %g N/m lets the cable's weight press the supports to "
                    "the deck; above %g N/m",
                    path, s->stiffness_Npm, weight * (s->first_m + 0.5 * bay) / s->height_m);
    else if (!(sag < clear))
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.pretension: at %g N the cable sags %g m between the first supports and "
                    "starts inside the deck; above %g N, or supports above %g m",
                    path, p->pretension_N, sag, p->pretension_N * sag / clear, sag + sink);
    /* straight from the sheave to the unloaded support next but one: it must press on the outermost
     */
    const double edge = 0.5 * p->span_m - y.value[y.count - 1];
    const double centre = s->height_m + 0.5 * p->diameter_m;
    const double pull = p->pretension_N * (p->sheaves.height_m - centre) / edge;
    const double share = 0.5 * weight * (edge + (y.count > 2 ? s->spacing_m : 2 * s->first_m));
    if (!(pull < share))
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.sheaves.height: from %g m the cable starts above its outermost supports; "
                    "below %g m, or a smaller pretension",
                    path, p->sheaves.height_m, centre + share * edge / p->pretension_N);
}

BT_DEFINE_GROUP(cable, BT_CABLE_FIELDS, CABLE_ROW, check_cable,
                "the arresting cable and what holds it")
