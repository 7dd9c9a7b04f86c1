/// What may be looked at, and what became of it.
#include "landing/parts.h"

#include "base/hash.h"
#include "elements/hook_damper_element.h"
#include "elements/strut.h"
#include "elements/wheel.h"
#include "mechanics/vec.h"

#include <math.h>
#include <string.h>

/// Shank below the fuselage axis: the angle of the hook's x axis in the fuselage's frame.
static double hook_angle(const bt_state* state) {
    const double* a = state->rotation + 9 * BT_BODY_HOOK;
    const double shank[3] = {a[0], a[3], a[6]};
    double local[3];
    bt_unrotate(state->rotation, shank, local);
    return atan2(local[2], local[0]);
}

static void observe_leg(const bt_landing_model* m, const bt_landing_state* s, int leg,
                        bt_landing_view* view) {
    const bt_airframe* f = &m->airframe;
    const bt_state* a = &s->airframe;
    const int wheel = 6 * (BT_BODY_NOSE_WHEEL + leg);
    double force[3], torque[3];
    view->stroke_m[leg] = bt_landing_output(m, s, f->strut[leg], BT_STRUT_STROKE);
    view->strut_force_N[leg] = bt_landing_output(m, s, f->strut[leg], BT_STRUT_FORCE);
    view->tyre_deflection_m[leg] = bt_landing_output(m, s, f->wheel[leg], BT_WHEEL_DEFLECTION);
    view->tyre_force_N[leg] =
        bt_landing_output(m, s, f->wheel[leg], BT_WHEEL_NORMAL) + a->applied[wheel + 2];
    for (int k = 0; k < m->wire_count; ++k)
        view->tyre_cable_force_N[leg] += s->wire[k].wheel[leg].normal_N;
    view->wheel_spin_radps[leg] = a->v[wheel + 4];
    bt_system_joint_load(f->system, a, f->strut_joint[leg], force, torque);
    view->strut_side_force_N[leg] =
        bt_leg_side_force(&f->leg[leg], a->rotation + 9 * BT_BODY_FUSELAGE, force);
}

static void observe_wire(const bt_landing_model* m, bt_landing_state* s, bt_landing_view* view) {
    const bt_cable_model* cable = m->wire[0].cable;
    bt_wire_state* wire = &s->wire[0];
    for (int i = 1; i < cable->count; ++i)
        s->tension_N[i - 1] = bt_cable_tension(cable, &wire->cable, i);
    view->cable_awake = wire->awake;
    view->cable_count = cable->count;
    view->cable_x = wire->cable.x;
    view->cable_y = wire->cable.y;
    view->cable_z = wire->cable.z;
    view->cable_tension_N = s->tension_N;
    for (int k = 0; k < m->wire_count; ++k)
        for (int zone = 0; zone < BT_ZONE_COUNT; ++zone)
            view->zone_force_N[zone] += s->wire[k].hook.zone_force_N[zone];
}

void bt_landing_observe(const bt_landing_model* m, bt_landing_state* s, bool last,
                        bt_landing_view* view) {
    const bt_airframe* f = &m->airframe;
    const bt_state* a = &s->airframe;
    s->observed = true;
    *view = (bt_landing_view){
        .time_s = a->time_s,
        .step = a->steps,
        .last = last,
        .q = a->q,
        .v = a->v,
        .rotation = a->rotation,
        .hook_angle_rad = hook_angle(a),
        .hook_height_m = bt_landing_output(m, s, f->shoe, BT_SHOE_HEIGHT),
        .hook_deck_force_N = bt_landing_output(m, s, f->shoe, BT_SHOE_FORCE),
        .hook_damper_force_N = bt_landing_output(m, s, f->damper, BT_HOOK_DAMPER_FORCE),
        .cable_wrench = a->applied,
        .cable_work_J = s->works.on_cable,
        .friction_J = s->works.friction,
        .friction_most_J = s->works.friction_most,
        .model = m,
        .state = s,
    };
    const bt_motion motion = {.time_s = a->time_s, .q = a->q, .v = a->v, .rotation = a->rotation};
    double torque[3];
    bt_audit audit;
    bt_point_position(&motion, BT_BODY_HOOK, f->shoe_contact.shoe_m, view->hook_shoe_m);
    bt_point_position(&motion, BT_BODY_HOOK, f->shoe_contact.lip_m, view->hook_lip_m);
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        observe_leg(m, s, leg, view);
    observe_wire(m, s, view);
    bt_system_joint_load(f->system, a, f->hook_joint, view->hook_pivot_force_N, torque);
    bt_system_audit(f->system, a, &audit);
    view->energy_J = audit.kinetic_J + audit.potential_J;
}

double bt_landing_cable_energy(const bt_landing_view* view) {
    bt_cable_energy energy;
    double total = 0;
    for (int k = 0; k < view->model->wire_count; ++k) {
        bt_cable_audit(view->model->wire[k].cable, &view->state->wire[k].cable, &energy);
        total += energy.kinetic_J + energy.elastic_J + energy.gravity_J;
    }
    return total;
}

/// FNV-1a over the present state of airframe and cables.
static uint64_t hash_state(const bt_landing_model* m, const bt_landing_state* s) {
    uint64_t hash = BT_HASH_START;
    hash = bt_hash_bytes(hash, s->airframe.q, 7 * BT_BODY_COUNT * sizeof(double));
    hash = bt_hash_bytes(hash, s->airframe.v, 6 * BT_BODY_COUNT * sizeof(double));
    for (int k = 0; k < m->wire_count; ++k) {
        const bt_cable_state* cable = &s->wire[k].cable;
        const size_t size = (size_t)m->wire[k].cable->count * sizeof(double);
        hash = bt_hash_bytes(hash, cable->x, size);
        hash = bt_hash_bytes(hash, cable->y, size);
        hash = bt_hash_bytes(hash, cable->z, size);
    }
    return hash;
}

void bt_landing_finish(const bt_landing_model* m, const bt_landing_state* s,
                       bt_landing_result* result) {
    const bt_meeting* meetings[BT_WIRE_MAX];
    for (int k = 0; k < m->wire_count; ++k)
        meetings[k] = &s->wire[k].meeting;
    *result = s->result;
    if (s->phase == BT_PHASE_FAILED) {
        bt_outcome_gather(meetings, m->wire_count, result);
        result->outcome = BT_FAILED;
        result->mode = BT_MODE_NONE;
        result->margin_m = NAN;
    } else
        bt_outcome_finish(&s->hops, meetings, m->wire_count, s->phase == BT_PHASE_STOPPED, result);
    result->steps = s->airframe.steps;
    result->end_time_s = s->airframe.time_s;
    result->state_hash = hash_state(m, s);
}
