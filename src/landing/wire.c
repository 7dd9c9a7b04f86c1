#include "landing/wire.h"

#include "mechanics/vec.h"

#include <math.h>
#include <string.h>

void bt_wire_contacts(const bt_airframe* airframe, const bt_model_params* params,
                      bt_wire_state* state) {
    const bt_cable_params* cable = &params->deck.cable;
    const bt_hook_cable_params* contact = &params->aircraft.hook.cable_contact;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        state->wheel[leg] = (bt_wheel_contact){.tyre = &airframe->tyre[leg],
                                               .width_m = airframe->tyre_width_m[leg],
                                               .friction = cable->wheel_friction,
                                               .slip_speed_mps = contact->slip_speed_mps,
                                               .hint = -1};
    state->hook = (bt_hook_contact){.profile = &airframe->profile,
                                    .stiffness = contact->stiffness_Npm2,
                                    .damping = 2 * contact->damping_ratio *
                                               sqrt(contact->stiffness_Npm2 * cable->mass_kgpm),
                                    .friction = contact->friction,
                                    .slip_speed_mps = contact->slip_speed_mps,
                                    .hint = -1};
    memcpy(state->hook.shoe_m, airframe->shoe_m, sizeof airframe->shoe_m);
}

void bt_wire_start(const bt_wire* wire, bt_wire_state* state) {
    bt_cable_state_copy(wire->cable, &state->cable, wire->resting);
    bt_meeting_start(&state->meeting);
    state->meeting.wire = wire->number;
    state->awake = state->loaded = state->left = false;
}

/// The part in the wire's own frame, without impulses.
static bt_moving_body seen_from_wire(const bt_wire* wire, const bt_moving_body* part) {
    bt_moving_body seen = *part;
    seen.position_m[0] -= wire->position_m;
    memset(seen.impulse_Ns, 0, sizeof seen.impulse_Ns);
    memset(seen.moment_Nms, 0, sizeof seen.moment_Nms);
    bt_moving_body_to(&seen, 0);
    return seen;
}

void bt_wire_follow(const bt_wire* wire, bt_wire_state* s,
                    const bt_moving_body part[BT_PART_COUNT]) {
    if (s->left)
        return;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const bt_moving_body wheel = seen_from_wire(wire, &part[leg]);
        s->clearance_m[leg] = bt_wheel_clearance(&s->wheel[leg], wire->cable, &s->cable, &wheel);
    }
    const bt_moving_body hook = seen_from_wire(wire, &part[BT_PART_HOOK]);
    s->clearance_m[BT_PART_HOOK] = bt_hook_clearance(&s->hook, wire->cable, &s->cable, &hook);
}

/// What touches the cable in one of its own steps, `after_s` into the airframe step.
static void touch(const bt_wire* wire, bt_wire_state* s, bt_moving_body part[BT_PART_COUNT],
                  bt_slides* slides, double time_s, double after_s, double sub_s,
                  bool touched_deck) {
    // tyres on the cable [Peng2023 Eqs. 6, 7]
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        if (!s->clearer[leg]) {
            bt_moving_body_to(&part[leg], after_s);
            bt_wheel_contact_press(&s->wheel[leg], wire->cable, &s->cable, &part[leg], slides,
                                   sub_s);
        }
    // hook on cable, and what the limit state sees of it [Peng2023 Eq. 18]
    if (!s->clearer[BT_PART_HOOK]) {
        bt_moving_body_to(&part[BT_PART_HOOK], after_s);
        bt_hook_contact_press(&s->hook, wire->cable, &s->cable, &part[BT_PART_HOOK], slides, sub_s);
        bt_meeting_see(&s->meeting, &s->hook, time_s + after_s, touched_deck);
    }
    bt_slides_resolve(slides, wire->cable, &s->cable, sub_s);
}

/// The rest of a cable step; with the works of what touches it, by the mean of the velocities
/// before and after, when somebody looks.
static void advance(const bt_wire* wire, bt_wire_state* s, const bt_slides* slides, bt_works* works,
                    double sub_s) {
    const bt_cable_model* model = wire->cable;
    bt_cable_state* cable = &s->cable;
    if (!works || !s->loaded) {
        bt_cable_advance(model, cable, sub_s);
        return;
    }
    const double half_s = 0.25 * (cable->scalars->last_step_s + sub_s);
    double on_cable = bt_cable_load_power(model, cable);
    double friction = bt_cable_slides_power(cable, slides->at, slides->resolved);
    bt_cable_advance(model, cable, sub_s);
    on_cable += bt_cable_load_power(model, cable);
    friction += bt_cable_slides_power(cable, slides->at, slides->resolved);
    works->on_cable += half_s * on_cable;
    works->friction += half_s * friction;
    if (slides->resolved > 0)
        works->friction_most = fmax(works->friction_most, half_s * friction);
}

int bt_wire_step(const bt_wire* wire, bt_wire_state* s, bt_moving_body part[BT_PART_COUNT],
                 bt_slides* slides, bt_works* works, double time_s, double step_s, double stable_s,
                 double reach_m, bool touched_deck) {
    bool any = false;
    for (int k = 0; k < BT_PART_COUNT; ++k) {
        s->clearer[k] = !(s->clearance_m[k] < reach_m);
        any |= !s->clearer[k];
    }
    s->awake |= any;
    if (!s->awake || s->left)
        return 0;

    bt_moving_body seen[BT_PART_COUNT];
    for (int k = 0; k < BT_PART_COUNT; ++k)
        seen[k] = seen_from_wire(wire, &part[k]);
    const int count = (int)ceil(step_s / stable_s);
    const double sub_s = step_s / count;
    for (int k = 0; k < count; ++k) {
        if (s->loaded)
            bt_cable_clear_loads(wire->cable, &s->cable);
        s->loaded = any;
        // joints, ends and supports of the cable [Peng2023 Eqs. 12-17]
        bt_cable_forces(wire->cable, &s->cable);
        touch(wire, s, seen, slides, time_s, k * sub_s, sub_s, touched_deck);
        advance(wire, s, slides, works, sub_s);
    }
    for (int k = 0; k < BT_PART_COUNT; ++k) {
        bt_add_scaled(part[k].impulse_Ns, 1, seen[k].impulse_Ns);
        bt_add_scaled(part[k].moment_Nms, 1, seen[k].moment_Nms);
    }
    if (s->clearer[BT_PART_HOOK])
        memset(s->hook.zone_force_N, 0, sizeof s->hook.zone_force_N);
    return count;
}

void bt_wire_record(const bt_wire* wire, bt_wire_state* s, double time_s, bool touched_deck) {
    if (s->left)
        return;
    if (s->clearer[BT_PART_HOOK])
        bt_meeting_see(&s->meeting, &s->hook, time_s, touched_deck);
    if (s->awake)
        s->meeting.tension_max_N =
            fmax(s->meeting.tension_max_N, bt_cable_tension_max(wire->cable, &s->cable));
}

void bt_wire_pass(bt_wire_state* s, double past_m) {
    const double lip_m = s->hook.lip_m[0];
    s->meeting.passed |= lip_m - s->hook.cable_m[0] >= past_m || lip_m >= BT_PAST_CABLE_MOST_M;
}

void bt_wire_crossed_before(bt_wire_state* s, double time_s, double speed_mps,
                            double sink_speed_mps) {
    const double since_s = (s->hook.lip_m[0] - s->hook.cable_m[0]) / speed_mps;
    const double lip_m = s->hook.lip_m[2] + since_s * sink_speed_mps;
    if (since_s > 0)
        bt_meeting_crossed_before(&s->meeting, time_s - since_s, s->hook.cable_m[2] - lip_m,
                                  s->hook.beside);
}

static void drop(bt_wire_state* s) {
    s->left = true;
    for (int k = 0; k < BT_PART_COUNT; ++k) {
        s->clearer[k] = true;
        s->clearance_m[k] = INFINITY;
    }
    memset(s->hook.zone_force_N, 0, sizeof s->hook.zone_force_N);
}

void bt_wire_leave_behind(bt_wire_state* s) {
    if (s->hook.lip_m[0] <= s->hook.cable_m[0])
        return;
    s->meeting.passed = true;
    drop(s);
}

void bt_wire_leave(const bt_wire* wire, bt_wire_state* s,
                   const bt_moving_body part[BT_PART_COUNT]) {
    if (s->left || !s->meeting.passed)
        return;
    double last_m = INFINITY, foremost_m = -INFINITY, fastest_mps = -INFINITY;
    for (int k = 0; k < BT_PART_COUNT; ++k)
        last_m = fmin(last_m, part[k].position_m[0] - wire->position_m);
    if (last_m < BT_WIRE_SETTLING_M)
        return;
    for (int i = 0; i < wire->cable->count; ++i) {
        foremost_m = fmax(foremost_m, s->cable.x[i]);
        fastest_mps = fmax(fastest_mps, s->cable.vx[i]);
    }
    if (last_m < foremost_m + BT_WIRE_SETTLING_M ||
        fastest_mps > 0.5 * part[BT_PART_HOOK].velocity_mps[0])
        return;
    drop(s);
}
