/// Where a landing begins: aircraft on its glide, wires at rest.
#include "landing/parts.h"

#include "landing/ship.h"

#include "mechanics/vec.h"

#include <math.h>
#include <string.h>

/// When, on the glide, a part whose lowest point is `lowest_m` at time 0 and that reaches
/// `reach_m` fore and aft comes up to a wire at `wire_m`; 0 when it does so later, or leaves it
/// again higher than `top_m`.
static double comes_to_cable_s(const bt_landing_params* p, const double lowest_m[3], double wire_m,
                               double reach_m, double top_m) {
    const double ahead_m = wire_m - lowest_m[0];
    const double enters_s = (ahead_m - reach_m) / p->horizontal_speed_mps;
    const double leaves_s = (ahead_m + reach_m) / p->horizontal_speed_mps;
    const double leaves_at_m = lowest_m[2] - fmin(leaves_s, 0) * p->sink_speed_mps;
    return enters_s < 0 && leaves_at_m < top_m ? enters_s : 0;
}

/// The wire that D is measured to.
static const bt_wire* target_of(const bt_landing_model* m) {
    const bt_wire* wire = m->wire;
    while (wire->number != m->params.landing.distance_to)
        ++wire;
    return wire;
}

/// Where the glide meets the deck at time 0: the shift that puts the lowest part on the deck and
/// the named part at its distance before the wire.
static void touchdown_shift(const bt_landing_model* m, const bt_glide* glide, double shift[3]) {
    const bt_landing_params* p = &m->params.landing;
    double lowest = glide->hook_m[2];
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        lowest = fmin(lowest, glide->tyre_m[leg][2]);
    const double wheels_x = 0.5 * (glide->tyre_m[BT_LEG_LEFT][0] + glide->tyre_m[BT_LEG_RIGHT][0]);
    const double from = p->distance_from == BT_DISTANCE_FROM_HOOK ? glide->hook_m[0] : wheels_x;
    shift[0] = target_of(m)->position_m - p->distance_m - from;
    shift[1] = 0;
    shift[2] = -lowest;
}

/// When the run must have begun for what comes up to one wire. The hook's way over the wire that D
/// is measured to is seen from however high: it gives the margin; over the others, and of the
/// tyres, where it can touch them. `glide` is at time 0.
static double begins_before_wire_s(const bt_landing_model* m, const bt_glide* glide,
                                   const bt_wire* wire) {
    static const double hook_reach_m = 0.5, tyre_margin_m = 0.05, above_cable_m = 0.1;
    const bt_landing_params* p = &m->params.landing;
    const bt_cable_params* cable = &m->params.deck.cable;
    const double height_m = wire->cable->def.support.height_m;
    const double top_m =
        fmax(height_m, cable->sheaves.height_m) + cable->diameter_m + above_cable_m;
    double begin_s = comes_to_cable_s(p, glide->hook_m, wire->position_m, hook_reach_m,
                                      wire == target_of(m) ? INFINITY : top_m);
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const double reach_m = m->airframe.tyre[leg].radius + tyre_margin_m;
        begin_s = fmin(begin_s,
                       comes_to_cable_s(p, glide->tyre_m[leg], wire->position_m, reach_m, top_m));
    }
    return begin_s;
}

/// When the run begins: before the first touch, and before anything comes up to a wire. `glide` is
/// moved to where it is at time 0.
static double begins_s(const bt_landing_model* m, bt_glide* glide, const double shift[3]) {
    static const double before_touch_s = 1e-3;
    double begin_s = -before_touch_s;
    bt_add_scaled(glide->hook_m, 1, shift);
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        bt_add_scaled(glide->tyre_m[leg], 1, shift);
    for (int k = 0; k < m->wire_count; ++k)
        begin_s = fmin(begin_s, begins_before_wire_s(m, glide, &m->wire[k]));
    return begin_s;
}

/// From the wire that D is measured to to the last one.
static double beyond_m(const bt_landing_model* m) {
    double last_m = 0;
    for (int k = 0; k < m->wire_count; ++k)
        last_m = fmax(last_m, m->wire[k].position_m);
    return last_m - target_of(m)->position_m;
}

/// What the hook crossed, high above, before the run began; an aircraft that rolls in has not met
/// the wires behind it.
static void cross_wires_before(const bt_landing_model* m, bt_landing_state* s) {
    const bt_landing_params* p = &m->params.landing;
    bt_landing_follow_parts(m, s);
    for (int k = 0; k < m->wire_count; ++k)
        if (&m->wire[k] == target_of(m))
            continue;
        else if (p->start != BT_START_GLIDE)
            bt_wire_leave_behind(&s->wire[k]);
        else
            bt_wire_crossed_before(&s->wire[k], s->airframe.time_s, p->horizontal_speed_mps,
                                   p->sink_speed_mps);
}

/// Takes the aircraft, which touches the deck at time 0 after a shift, to an earlier time: it has
/// come straight and without turning, the deck has not.
static void go_back(const bt_landing_model* m, const double shift[3], double time_s,
                    bt_state* state) {
    const bt_motion_params* motion = &m->params.deck.motion;
    bt_ship now, touchdown;
    double turned[4];
    bt_ship_at(motion, time_s, &now);
    bt_ship_at(motion, 0, &touchdown);
    bt_ship_turned(motion, time_s, turned);
    for (int body = 0; body < m->airframe.body_count; ++body) {
        double *q = state->q + 7 * body, *v = state->v + 6 * body, way[3], place[3], carried[3],
               e[4];
        for (int i = 0; i < 3; ++i) { // relative to the origin at touchdown; absolute
            way[i] = v[i] + touchdown.velocity_mps[i];
            place[i] = q[i] + shift[i] + time_s * way[i] - now.shift_m[i];
        }
        bt_unrotate(now.turn, place, q);
        bt_euler_relative(turned, q + 3, e);
        memcpy(q + 3, e, sizeof e);
        bt_rotation_from_euler(q + 3, state->rotation + 9 * body);
        bt_unrotate(now.turn, way, v);
        bt_cross(now.spin_radps, q, carried);
        bt_add_scaled(v, -1, now.velocity_mps);
        bt_add_scaled(v, -1, carried);
        bt_unrotate(state->rotation + 9 * body, now.spin_radps, v + 3);
        for (int i = 0; i < 3; ++i)
            v[3 + i] *= -1;
    }
}

/// A wire that would come to lie elsewhere than where it sleeps, by more than the margin's own
/// scatter, is awake from the start.
static bool sleeps(const bt_landing_model* m, double begins_s) {
    static const double tolerance_m = 1e-4;
    const bt_landing_params* p = &m->params.landing;
    const double lasts_s = (fabs(p->distance_m) + 10 + beyond_m(m)) / p->horizontal_speed_mps;
    return !m->moves || bt_ship_sleeping_error(&m->params.deck.motion, &m->params.deck.cable,
                                               begins_s, lasts_s) <= tolerance_m;
}

/// The aircraft on its glide, the named part `distance` before the named wire when the first part
/// touches the deck at time 0. Going back along the glide is exact, since nothing touches anything
/// there and gravity is what lift carries (bt_landing_step), so that distance and sinking speed are
/// those asked for at that touch. Returns the time at which the run begins.
static double glide_in(const bt_landing_model* m, bt_landing_state* s) {
    const bt_landing_params* p = &m->params.landing;
    bt_glide glide;
    double shift[3];
    bt_airframe_place(&m->airframe, p, &m->hanging, &s->airframe, &glide);
    touchdown_shift(m, &glide, shift);
    const double begin_s = begins_s(m, &glide, shift);
    const double back[3] = {shift[0] + begin_s * p->horizontal_speed_mps,
                            shift[1] + begin_s * p->drift_mps,
                            shift[2] - begin_s * p->sink_speed_mps};
    if (m->moves)
        go_back(m, shift, begin_s, &s->airframe);
    else
        bt_airframe_move(&m->airframe, back, &s->airframe);
    return begin_s;
}

/// The aircraft standing on its struts, the named part `distance` before the wire at time 0.
static void roll_in(const bt_landing_model* m, bt_landing_state* s) {
    const bt_landing_params* p = &m->params.landing;
    bt_glide glide;
    double shift[3];
    bt_state_copy(m->airframe.system, &s->airframe, &m->hanging);
    bt_stance_place(&m->airframe, p, &m->hanging, &m->stance, &s->airframe, &glide);
    touchdown_shift(m, &glide, shift);
    shift[2] = 0;
    bt_airframe_move(&m->airframe, shift, &s->airframe);
}

/// The wires rest, the first at x = 0; the aircraft is where it begins.
bool bt_landing_start(const bt_landing_model* m, bt_landing_state* s) {
    static const double time_allowed = 4; // of what the way past the wire takes at full speed
    const bt_landing_params* p = &m->params.landing;
    const bool glides = p->start == BT_START_GLIDE;
    double begin_s = 0;
    if (glides)
        begin_s = glide_in(m, s);
    else
        roll_in(m, s);
    s->airframe.time_s = begin_s;
    s->airframe.steps = 0;

    for (int k = 0; k < m->wire_count; ++k) {
        bt_wire_contacts(&m->airframe, &m->params, &s->wire[k]);
        bt_wire_start(&m->wire[k], &s->wire[k]);
        s->wire[k].awake = !sleeps(m, begin_s);
    }
    memset(&s->slides, 0, sizeof s->slides);
    s->observed = false;
    s->works = (bt_works){.friction_most = -INFINITY};
    s->hops = (bt_hops){0};
    s->result = (bt_landing_result){.margin_m = NAN, .time_of_contact_s = NAN};
    s->result.shank_bends = m->airframe.shank.bends;
    s->phase = BT_PHASE_ROLL;
    if (glides &&
        m->params.aircraft.lift_ratio != 1) { // until the first touch nothing but the glide
        s->phase = BT_PHASE_GLIDE;
        s->airframe.frame.gravity_mps2[2] *= m->params.aircraft.lift_ratio;
    }
    if (m->moves)
        bt_landing_move_deck(m, s, 0);
    s->end_by_s = time_allowed * (fabs(p->distance_m) + 10 + beyond_m(m)) / p->horizontal_speed_mps;
    bt_failure failure = {0};
    if (bt_system_project(m->airframe.system, &s->airframe, &failure) != BT_OK ||
        bt_system_evaluate(m->airframe.system, &s->airframe, &failure) != BT_OK)
        bt_landing_fail(s, failure.where, failure.quantity, failure.time_s);
    else
        cross_wires_before(m, s);
    return !bt_phase_is_over(s->phase);
}
