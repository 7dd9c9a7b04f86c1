#include "surrogate/features.h"

#include <math.h>
#include <string.h>

const char* const bt_feature_names[] = {"feature.wheels_over_cable", NULL};

static int place_of(const bt_study* study, const int* inputs, int dims, const char* path) {
    for (int k = 0; k < dims; ++k)
        if (!strcmp(study->inputs[inputs[k]].path, path))
            return k;
    return -1;
}

bt_features bt_features_of(const bt_study* study, const int* inputs, int dims) {
    const bt_aircraft_params* a = &study->model.aircraft;
    const bt_landing_params* l = &study->model.landing;
    const bt_hook_params* h = &a->hook;
    const double hook_m[2] = {h->pivot_x_m - h->length_m * cos(h->down_stop_rad),
                              h->pivot_z_m - h->length_m * sin(h->down_stop_rad) -
                                  h->profile.shoe_radius_m};
    bt_features f = {
        .dims = dims,
        .sink_speed = place_of(study, inputs, dims, "landing.sink_speed"),
        .horizontal_speed = place_of(study, inputs, dims, "landing.horizontal_speed"),
        .pitch = place_of(study, inputs, dims, "landing.pitch"),
        .distance = place_of(study, inputs, dims, "landing.distance"),
        .fixed = {l->sink_speed_mps, l->horizontal_speed_mps, l->pitch_rad, l->distance_m},
        .wheel_m = {a->main_gear.station_m - hook_m[0], a->main_gear.underside_m - hook_m[1]},
        .tyre_radius_m = a->main_gear.tyre.radius_m,
        .from_wheels = l->distance_from != BT_DISTANCE_FROM_HOOK};
    const bool varies =
        f.sink_speed >= 0 || f.horizontal_speed >= 0 || f.pitch >= 0 || f.distance >= 0;
    const bool room = dims + BT_FEATURES <= BT_INPUT_MAX;
    f.count = study->surrogate.features && varies && room ? BT_FEATURES : 0;
    return f;
}

static double pick(const bt_features* f, const double* x, int place, int which) {
    return place >= 0 ? x[place] : f->fixed[which];
}

static double wheels_over_cable(const bt_features* f, const double* x) {
    const double sink_mps = pick(f, x, f->sink_speed, 0),
                 speed_mps = pick(f, x, f->horizontal_speed, 1),
                 pitch_rad = pick(f, x, f->pitch, 2), distance_m = pick(f, x, f->distance, 3);
    const double c = cos(pitch_rad), s = sin(pitch_rad);
    const double height_m = f->wheel_m[0] * s + f->wheel_m[1] * c,
                 ahead_m = f->wheel_m[0] * c - f->wheel_m[1] * s;
    const double way_m = f->from_wheels ? distance_m : distance_m - ahead_m;
    const double over_m = height_m - sink_mps * way_m / fmax(speed_mps, 1e-3);
    return fmin(fmax(over_m, -0.5 * f->tyre_radius_m), f->tyre_radius_m);
}

void bt_features_extend(const bt_features* f, const double* x, int n, double* extended) {
    for (int i = 0; i < n; ++i) {
        double* to = extended + (size_t)i * (size_t)(f->dims + f->count);
        memcpy(to, x + (size_t)i * (size_t)f->dims, (size_t)f->dims * sizeof *to);
        if (f->count)
            to[f->dims] = wheels_over_cable(f, to);
    }
}
