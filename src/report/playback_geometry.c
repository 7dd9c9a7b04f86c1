#include "report/playback_geometry.h"

#include <math.h>

// --- the head ---------------------------------------------------------------------------------

static void put_point(double outline[BT_OUTLINE_MAX][2], int* count, double u, double w) {
    if (*count == BT_OUTLINE_MAX)
        return;
    outline[*count][0] = u;
    outline[*count][1] = w;
    ++*count;
}

/// An arc as points; the throat's runs clockwise, as the solid lies outside of it.
static void put_arc(double outline[BT_OUTLINE_MAX][2], int* count, const bt_piece* arc) {
    enum { STEPS = 16 };
    for (int i = 0; i <= STEPS; ++i) {
        const double share = (double)(arc->convex ? i : STEPS - i) / STEPS;
        const double angle = arc->from + share * (arc->to - arc->from);
        put_point(outline, count, arc->centre[0] + arc->radius * cos(angle),
                  arc->centre[1] + arc->radius * sin(angle));
    }
}

int bt_hook_outline(const bt_profile* profile, double reach_m, double outline[BT_OUTLINE_MAX][2]) {
    int count = 0;
    for (int i = 0; i < BT_PIECE_COUNT; ++i)
        if (profile->pieces[i].arc)
            put_arc(outline, &count, &profile->pieces[i]);
    put_point(outline, &count, reach_m, -profile->arm_radius);
    put_point(outline, &count, reach_m, profile->arm_radius);
    return count;
}

bt_fuselage_sketch bt_fuselage_of(const bt_airframe* f) {
    const double radius = fmax(0.5, 0.35 * -f->axle_m[BT_LEG_LEFT][2]);
    return (bt_fuselage_sketch){
        .nose_m = f->axle_m[BT_LEG_NOSE][0] + 2.5 - f->fuselage_m[0],
        .tail_m = f->pivot_m[0] - 1.5 - f->fuselage_m[0],
        .radius_m = radius,
        .height_m = f->pivot_m[2] - f->fuselage_m[2] + radius,
    };
}

// --- JSON -------------------------------------------------------------------------------------

static void put_vector(bt_json* json, const char* key, double x, double y, double z) {
    bt_json_begin_array(json, key);
    bt_json_rounded(json, NULL, x, 6);
    bt_json_rounded(json, NULL, y, 6);
    bt_json_rounded(json, NULL, z, 6);
    bt_json_end_array(json);
}

/// A tube from the fuselage down to where the piston's head is when the strut is extended.
static void put_strut(bt_json* json, const bt_airframe* f, int leg) {
    const double* axle = f->axle_m[leg];
    const double x = axle[0] - f->fuselage_m[0], y = axle[1] - f->fuselage_m[1];
    const double low = axle[2] - f->fuselage_m[2];
    bt_json_begin_object(json, NULL);
    put_vector(json, "top", x, y, 0);
    put_vector(json, "foot", x, y, 0.45 * low);
    bt_json_end_object(json);
}

static void put_fuselage(bt_json* json, const bt_airframe* f) {
    const bt_fuselage_sketch s = bt_fuselage_of(f);
    const double length = s.nose_m - s.tail_m;
    bt_json_begin_object(json, "fuselage");
    bt_json_rounded(json, "radius_m", s.radius_m, 4);
    bt_json_rounded(json, "length_m", fmax(length - 2 * s.radius_m, s.radius_m), 6);
    bt_json_rounded(json, "middle_m", 0.5 * (s.nose_m + s.tail_m), 6);
    bt_json_rounded(json, "height_m", s.height_m, 6);
    bt_json_rounded(json, "span_m", 0.8 * length, 6);
    bt_json_rounded(json, "chord_m", 0.2 * length, 6);
    bt_json_begin_array(json, "struts");
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        put_strut(json, f, leg);
    bt_json_end_array(json);
    bt_json_end_object(json);
}

static void put_legs(bt_json* json, const bt_airframe* f) {
    bt_json_begin_array(json, "pistons");
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        bt_json_begin_object(json, NULL);
        bt_json_string(json, "body", bt_body_names[BT_BODY_NOSE_PISTON + leg]);
        put_vector(json, "top", 0, 0, -0.6 * f->axle_m[leg][2]);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
    bt_json_begin_array(json, "wheels");
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        bt_json_begin_object(json, NULL);
        bt_json_string(json, "body", bt_body_names[BT_BODY_NOSE_WHEEL + leg]);
        bt_json_rounded(json, "radius_m", f->tyre[leg].radius, 6);
        bt_json_rounded(json, "width_m", f->tyre[leg].width, 6);
        bt_json_integer(json, "tyres", llround(f->tyre[leg].tyres));
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}

static void put_hook(bt_json* json, const bt_airframe* f, const bt_hook_params* hook) {
    double outline[BT_OUTLINE_MAX][2];
    const double reach = fmin(0.4, 0.5 * hook->length_m);
    const int count = bt_hook_outline(&f->profile, reach, outline);
    bt_json_begin_object(json, "hook");
    bt_json_begin_array(json, "outline");
    for (int i = 0; i < count; ++i) {
        bt_json_begin_array(json, NULL);
        bt_json_rounded(json, NULL, outline[i][0], 5);
        bt_json_rounded(json, NULL, outline[i][1], 5);
        bt_json_end_array(json);
    }
    bt_json_end_array(json);
    bt_json_rounded(json, "width_m", 2 * f->profile.half_width, 6);
    bt_json_rounded(json, "arm_radius_m", f->profile.arm_radius, 6);
    put_vector(json, "shoe_m", f->shoe_m[0], f->shoe_m[1], f->shoe_m[2]);
    bt_json_begin_array(json, "shank");
    put_vector(json, NULL, f->shoe_m[0] + reach, 0, 0);
    put_vector(json, NULL, f->shoe_m[0] + hook->length_m, 0, 0);
    bt_json_end_array(json);
    bt_json_end_object(json);
}

static void put_deck(bt_json* json, const bt_cable_params* cable) {
    const double end = 0.5 * cable->span_m - 0.5 * cable->supports.spacing_m;
    bt_json_begin_object(json, "deck");
    bt_json_number(json, "span_m", cable->span_m);
    bt_json_begin_array(json, "supports_m");
    for (double y = cable->supports.first_m; y < end; y += cable->supports.spacing_m) {
        bt_json_rounded(json, NULL, -y, 6);
        bt_json_rounded(json, NULL, y, 6);
    }
    bt_json_end_array(json);
    bt_json_number(json, "support_height_m", cable->supports.height_m);
    bt_json_number(json, "sheave_height_m", cable->sheaves.height_m);
    bt_json_number(json, "rope_radius_m", 0.5 * cable->diameter_m);
    bt_json_end_object(json);
}

void bt_geometry_write(bt_json* json, const bt_airframe* airframe, const bt_model_params* model) {
    put_fuselage(json, airframe);
    put_legs(json, airframe);
    put_hook(json, airframe, &model->aircraft.hook);
    put_deck(json, &model->deck.cable);
}
