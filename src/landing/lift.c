#include "landing/lift.h"

#include "landing/ship.h"
#include "mechanics/vec.h"

#include <math.h>
#include <string.h>

void bt_lift_init(bt_lift* lift, double touchdown_N, const double point_m[3]) {
    *lift = (bt_lift){.touchdown_N = touchdown_N, .law = {.dump_share = 1, .dump_duration_s = 1}};
    memcpy(lift->point_m, point_m, sizeof lift->point_m);
}

double bt_lift_touchdown_angle(const bt_landing_params* landing, double pitch_rad) {
    return pitch_rad +
           atan2(landing->sink_speed_mps, landing->horizontal_speed_mps + landing->lift.wind_mps);
}

void bt_lift_prepare(bt_lift* lift, const bt_model_params* params, double pitch_rad) {
    const bt_landing_params* p = &params->landing;
    const double along_mps = p->horizontal_speed_mps + p->lift.wind_mps;
    const double sink_mps = p->start == BT_START_GLIDE ? p->sink_speed_mps : 0;
    lift->law = p->lift;
    lift->motion = params->deck.motion;
    lift->moves = bt_ship_accelerates(&lift->motion) || lift->motion.heave.velocity_mps != 0;
    lift->rolling = p->start == BT_START_ROLLING;
    lift->speed2_m2ps2 = along_mps * along_mps + sink_mps * sink_mps;
    lift->angle_rad = bt_lift_touchdown_angle(p, pitch_rad) - p->lift.zero_lift_angle_rad;
}

bool bt_lift_check(const bt_landing_params* landing, const char* path, bt_diag* diag) {
    static const double least_rad = 0.02;
    const double angle_rad = bt_lift_touchdown_angle(landing, landing->pitch_rad);
    if (landing->lift.law != BT_LIFT_AERODYNAMIC ||
        angle_rad - landing->lift.zero_lift_angle_rad >= least_rad)
        return true;
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                "%s%slanding.lift.zero_lift_angle: %.4g rad, the angle of attack at touchdown is "
                "%.4g rad and carries nothing; at most %.4g rad would do",
                path, *path ? "." : "", landing->lift.zero_lift_angle_rad, angle_rad,
                angle_rad - least_rad);
    return false;
}

/// The fuselage's way through the air, in deck axes.
static void way_through_air(const bt_lift* lift, const bt_motion* motion, int body, double way[3]) {
    memcpy(way, motion->v + 6 * body, 3 * sizeof *way);
    way[0] += lift->law.wind_mps;
    if (!lift->moves || lift->rolling)
        return;
    bt_ship ship;
    double carried[3];
    bt_ship_at(&lift->motion, motion->time_s, &ship);
    bt_cross(ship.spin_radps, motion->q + 7 * body, carried);
    bt_add_scaled(way, 1, ship.velocity_mps);
    bt_add_scaled(way, 1, carried);
}

static double aerodynamic(const bt_lift* lift, const bt_motion* motion, int body) {
    double way[3];
    way_through_air(lift, motion, body, way);
    const double nose_up = asin(motion->rotation[9 * body + 6]);
    const double angle = nose_up - atan2(way[2], way[0]) - lift->law.zero_lift_angle_rad;
    return (way[0] * way[0] + way[2] * way[2]) / lift->speed2_m2ps2 * (angle / lift->angle_rad);
}

double bt_lift_factor(const bt_lift* lift, const bt_motion* motion, int body) {
    const bt_lift_params* law = &lift->law;
    if (motion->time_s <= 0)
        return 1;
    const double factor = law->law == BT_LIFT_AERODYNAMIC ? aerodynamic(lift, motion, body) : 1;
    const double since = (motion->time_s - law->dump_after_s) / law->dump_duration_s;
    return factor * (1 - (1 - law->dump_share) * fmin(1, fmax(0, since)));
}

static const bt_lift* lift_of(const bt_element* element) {
    return ((const bt_lift_element*)element->data)->lift;
}

static void force(const bt_element* element, const bt_motion* motion, double* wrench,
                  double* output) {
    const bt_lift* lift = lift_of(element);
    const int body = element->body_b;
    double point[3], push[3] = {0, 0, lift->touchdown_N * bt_lift_factor(lift, motion, body)};
    output[0] = push[2];
    if (lift->moves) {
        bt_ship ship;
        bt_ship_at(&lift->motion, motion->time_s, &ship);
        for (int i = 0; i < 3; ++i)
            push[i] = output[0] * ship.up[i];
    }
    bt_point_position(motion, body, lift->point_m, point);
    bt_wrench_add(motion, body, point, push, wrench);
}

static double energy(const bt_element* element, const bt_motion* motion) {
    const bt_lift* lift = lift_of(element);
    if (lift->law.law != BT_LIFT_CONSTANT || lift->law.dump_share != 1)
        return 0;
    bt_ship ship = {.up = {0, 0, 1}};
    double point[3];
    if (lift->moves)
        bt_ship_at(&lift->motion, motion->time_s, &ship);
    bt_point_position(motion, element->body_b, lift->point_m, point);
    return -lift->touchdown_N * bt_dot(ship.up, point);
}

static const char* const output_names[] = {"lift_N"};

const bt_element_type bt_lift_type = {
    .name = "lift",
    .data_size = sizeof(bt_lift_element),
    .output_count = 1,
    .output_names = output_names,
    .force = force,
    .energy = energy,
};
