#include "landing/ship.h"

#include "mechanics/vec.h"

#include <math.h>
#include <string.h>

/// One coordinate with its two derivatives.
typedef struct course {
    double value, rate, acceleration;
} course;

/// Adds amplitude sin(2 pi t / period + phase).
static void add_wave(double amplitude, double period_s, double phase_rad, double time_s,
                     course* c) {
    const double omega = 2 * M_PI / period_s, angle = omega * time_s + phase_rad;
    c->value += amplitude * sin(angle);
    c->rate += amplitude * omega * cos(angle);
    c->acceleration -= amplitude * omega * omega * sin(angle);
}

static course heave_at(const bt_heave_params* p, double t) {
    course c = {(p->velocity_mps + 0.5 * p->acceleration_mps2 * t) * t,
                p->velocity_mps + p->acceleration_mps2 * t, p->acceleration_mps2};
    if (p->amplitude_m != 0)
        add_wave(p->amplitude_m, p->period_s, p->phase_rad, t, &c);
    return c;
}

static course turn_at(const bt_sway_params* p, double t) {
    course c = {p->angle_rad + (p->rate_radps + 0.5 * p->acceleration_radps2 * t) * t,
                p->rate_radps + p->acceleration_radps2 * t, p->acceleration_radps2};
    if (p->amplitude_rad != 0)
        add_wave(p->amplitude_rad, p->period_s, p->phase_rad, t, &c);
    return c;
}

/// Deck axes to level ones: the turn by the vector (roll, -pitch, 0).
static void attitude_of(const double turn_rad[3], double a[9]) {
    double e[4];
    bt_euler_from_vector(turn_rad, e);
    bt_rotation_from_euler(e, a);
}

void bt_ship_turned(const bt_motion_params* motion, double t, double turned[4]) {
    double e[2][4];
    for (int k = 0; k < 2; ++k) {
        const double at_s = k ? t : 0;
        const double f[3] = {turn_at(&motion->roll, at_s).value,
                             -turn_at(&motion->pitch, at_s).value, 0};
        bt_euler_from_vector(f, e[k]);
    }
    bt_euler_relative(e[0], e[1], turned);
}

/// x - f x x / 2
static void in_deck_axes(const double f[3], const double x[3], double seen[3]) {
    bt_cross(f, x, seen);
    for (int i = 0; i < 3; ++i)
        seen[i] = x[i] - 0.5 * seen[i];
}

/// Origin's place from the centre of turning, in level axes, less heave.
static void place_of(const double a[9], const double centre[3], double place[3]) {
    bt_rotate(a, centre, place);
    for (int i = 0; i < 3; ++i)
        place[i] = -place[i];
}

void bt_ship_at(const bt_motion_params* motion, double t, bt_ship* ship) {
    const course heave = heave_at(&motion->heave, t), start = heave_at(&motion->heave, 0);
    const course roll = turn_at(&motion->roll, t), pitch = turn_at(&motion->pitch, t);
    const double f[3] = {roll.value, -pitch.value, 0};
    const double rate[3] = {roll.rate, -pitch.rate, 0};
    const double change[3] = {roll.acceleration, -pitch.acceleration, 0};
    const double f0[3] = {turn_at(&motion->roll, 0).value, -turn_at(&motion->pitch, 0).value, 0};
    const double centre[3] = {motion->centre_ahead_m, 0, -motion->centre_below_m};
    double now[9], first[9], carried[3], euler[3], centripetal[3], place[3], place0[3];
    attitude_of(f, now);
    attitude_of(f0, first);
    in_deck_axes(f, rate, ship->spin_radps);
    in_deck_axes(f, change, ship->spin_rate_radps2);
    bt_cross(ship->spin_radps, centre, carried);
    bt_cross(ship->spin_radps, carried, centripetal);
    bt_cross(ship->spin_rate_radps2, centre, euler);
    for (int i = 0; i < 3; ++i) {
        ship->up[i] = now[6 + i];
        ship->velocity_mps[i] = heave.rate * ship->up[i] - carried[i];
        ship->acceleration_mps2[i] = heave.acceleration * ship->up[i] - euler[i] - centripetal[i];
        for (int j = 0; j < 3; ++j)
            ship->turn[3 * i + j] =
                first[i] * now[j] + first[3 + i] * now[3 + j] + first[6 + i] * now[6 + j];
    }
    place_of(now, centre, place);
    place_of(first, centre, place0);
    for (int i = 0; i < 3; ++i)
        place[i] -= place0[i];
    place[2] += heave.value - start.value;
    bt_unrotate(first, place, ship->shift_m);
}

static bool turns(const bt_sway_params* p) {
    return p->angle_rad != 0 || p->rate_radps != 0 || p->acceleration_radps2 != 0 ||
           p->amplitude_rad != 0;
}

bool bt_ship_accelerates(const bt_motion_params* motion) {
    return motion->heave.acceleration_mps2 != 0 || motion->heave.amplitude_m != 0 ||
           turns(&motion->pitch) || turns(&motion->roll);
}

void bt_ship_frame(const bt_motion_params* motion, double gravity_mps2, double carried,
                   double time_s, bt_frame* frame) {
    bt_ship ship;
    bt_ship_at(motion, time_s, &ship);
    for (int i = 0; i < 3; ++i)
        frame->gravity_mps2[i] = -carried * gravity_mps2 * ship.up[i] - ship.acceleration_mps2[i];
    memcpy(frame->spin_radps, ship.spin_radps, sizeof frame->spin_radps);
    memcpy(frame->spin_rate_radps2, ship.spin_rate_radps2, sizeof frame->spin_rate_radps2);
}

void bt_ship_frame_ahead(const bt_frame* frame, double ahead_m, bt_frame* moved) {
    const double place[3] = {ahead_m, 0, 0}, still[3] = {0, 0, 0};
    *moved = *frame;
    bt_frame_field(frame, place, still, moved->gravity_mps2);
}

double bt_ship_pressing(const bt_motion_params* motion, double gravity_mps2) {
    if (!bt_ship_accelerates(motion))
        return gravity_mps2;
    bt_frame frame;
    bt_ship_frame(motion, gravity_mps2, 1, 0, &frame);
    return -frame.gravity_mps2[2];
}

void bt_ship_relative(const bt_motion_params* motion, bt_landing_params* landing) {
    bt_ship ship;
    bt_ship_at(motion, 0, &ship);
    landing->horizontal_speed_mps -= ship.velocity_mps[0];
    landing->drift_mps -= ship.velocity_mps[1];
    landing->sink_speed_mps += ship.velocity_mps[2];
}

double bt_ship_sleeping_error(const bt_motion_params* motion, const bt_cable_params* cable,
                              double begins_s, double lasts_s) {
    enum { POINTS = 16 };
    const double gap_m = fmax(2 * cable->supports.first_m, cable->supports.spacing_m);
    const double at_rest = bt_ship_pressing(motion, 0);
    double change = 0;
    for (int k = 0; k <= POINTS; ++k) {
        bt_frame frame;
        bt_ship_frame(motion, 0, 1, begins_s + (lasts_s - begins_s) * k / POINTS, &frame);
        change = fmax(change, fabs(-frame.gravity_mps2[2] - at_rest));
    }
    return change * cable->mass_kgpm * gap_m * gap_m / (8 * cable->pretension_N);
}

/* ---- what is refused ---- */

/// The largest angle of a turn during a landing.
static double most_of(const bt_sway_params* p) {
    return fabs(p->angle_rad) + fabs(p->rate_radps) * BT_SHIP_LASTS_S +
           0.5 * fabs(p->acceleration_radps2) * BT_SHIP_LASTS_S * BT_SHIP_LASTS_S +
           p->amplitude_rad;
}

static void check_angle(const bt_sway_params* p, const char* path, const char* name,
                        bt_diag* diag) {
    static const double most_rad = 0.15;
    const double reached = most_of(p);
    if (reached > most_rad)
        bt_diag_add(
            diag, BT_ERROR, BT_NOWHERE,
            "%s%sdeck.motion.%s: reaches %.3g rad within %g s; the deck's frame is described "
            "for small angles, at most %g rad: all of it times %.2g would do",
            path, *path ? "." : "", name, reached, BT_SHIP_LASTS_S, most_rad,
            floor(100 * most_rad / reached + 1e-9) / 100);
}

/// The largest acceleration of the origin during a landing.
static double most_acceleration(const bt_motion_params* motion) {
    enum { POINTS = 64 };
    double most = 0;
    for (int k = 0; k <= POINTS; ++k) {
        bt_ship ship;
        bt_ship_at(motion, BT_SHIP_LASTS_S * k / POINTS, &ship);
        most = fmax(most, bt_norm(ship.acceleration_mps2));
    }
    return most;
}

static void check_rolling(const bt_model_params* model, const char* path, bt_diag* diag) {
    const bt_motion_params* motion = &model->deck.motion;
    const char* turning = turns(&motion->pitch) ? "pitch" : turns(&motion->roll) ? "roll" : NULL;
    if (turning)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s%sdeck.motion.%s: an aircraft that rolls in stands at rest on a level deck; "
                    "0 would do, or landing.start: glide",
                    path, *path ? "." : "", turning);
}

void bt_ship_check(const bt_model_params* model, const char* path, bt_diag* diag) {
    static const double least_mps = 0.01, least_forward_mps = 1, gravity_share = 0.5;
    const bt_motion_params* motion = &model->deck.motion;
    const char* dot = *path ? "." : "";
    if (model->landing.start == BT_START_ROLLING)
        check_rolling(model, path, diag);
    check_angle(&motion->pitch, path, "pitch", diag);
    check_angle(&motion->roll, path, "roll", diag);
    const double most = most_acceleration(motion), g = model->deck.gravity_mps2;
    if (most > gravity_share * g)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s%sdeck.motion: the deck accelerates by %.3g m/s^2 at the wire; at most half "
                    "of gravity, %.3g m/s^2: all of it times %.2g would do",
                    path, dot, most, gravity_share * g,
                    floor(100 * gravity_share * g / most + 1e-9) / 100);
    bt_landing_params relative = model->landing;
    bt_ship_relative(motion, &relative);
    if (model->landing.start == BT_START_GLIDE && relative.sink_speed_mps < least_mps)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s%sdeck.motion.heave.velocity: the deck falls as fast as the aircraft sinks, "
                    "%.3g m/s towards it; landing.sink_speed above %.4g m/s would do",
                    path, dot, relative.sink_speed_mps,
                    model->landing.sink_speed_mps - relative.sink_speed_mps + least_mps);
    if (relative.horizontal_speed_mps < least_forward_mps)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s%sdeck.motion.pitch.rate: the deck runs away at %.3g m/s; a smaller "
                    "centre_below would do",
                    path, dot, model->landing.horizontal_speed_mps - relative.horizontal_speed_mps);
}
