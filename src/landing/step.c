/// One step of a landing [Peng2023 Sec. 2].
#include "landing/parts.h"

#include "elements/strut.h"
#include "elements/wheel.h"
#include "landing/ship.h"
#include "mechanics/vec.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void bt_landing_fail(bt_landing_state* s, const char* element, const char* quantity,
                     double time_s) {
    bt_landing_result* result = &s->result;
    s->phase = BT_PHASE_FAILED;
    result->failed_time_s = time_s;
    snprintf(result->failed_element, sizeof result->failed_element, "%s", element);
    snprintf(result->failed_quantity, sizeof result->failed_quantity, "%s", quantity);
}

/* ---- where the parts are ---- */

static void follow_body(const bt_state* state, int body, bt_moving_body* part) {
    const double* q = state->q + 7 * body;
    const double* v = state->v + 6 * body;
    memcpy(part->position_m, q, sizeof part->position_m);
    memcpy(part->velocity_mps, v, sizeof part->velocity_mps);
    memcpy(part->acceleration_mps2, state->a + 6 * body, sizeof part->acceleration_mps2);
    memcpy(part->rotation, state->rotation + 9 * body, sizeof part->rotation);
    bt_rotate(part->rotation, v + 3, part->spin_radps);
    memset(part->impulse_Ns, 0, sizeof part->impulse_Ns);
    memset(part->moment_Nms, 0, sizeof part->moment_Nms);
}

static int body_of(int part) {
    return part == BT_PART_HOOK ? BT_BODY_HOOK : BT_BODY_NOSE_WHEEL + part;
}

void bt_landing_follow_parts(const bt_landing_model* m, bt_landing_state* s) {
    for (int k = 0; k < BT_PART_COUNT; ++k)
        follow_body(&s->airframe, body_of(k), &s->part[k]);
    for (int k = 0; k < m->wire_count; ++k)
        bt_wire_follow(&m->wire[k], &s->wire[k], s->part);
}

/* ---- how long the step may be ---- */

/// The longest step at which the oil damping of the unsprung masses is stable: 0.8 of
/// m / (dF_h/ds'), dF_h/ds' = 2 F_h / s'. A rebound valve asks for it when a wheel leaves the deck.
static double damped_step(const bt_landing_model* m, const bt_landing_state* s) {
    const bt_airframe* f = &m->airframe;
    double step_s = INFINITY;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const double stroke = bt_landing_output(m, s, f->strut[leg], BT_STRUT_STROKE);
        const double rate = bt_landing_output(m, s, f->strut[leg], BT_STRUT_RATE);
        const double oil_N = bt_oleo_oil_force(&f->oleo[leg], stroke, rate);
        if (oil_N != 0)
            step_s = fmin(step_s, 0.4 * f->leg[leg].stroke_kg * rate / oil_N);
    }
    return step_s;
}

/// The airframe's step: fine around an impact of the shoe on the deck and while the hook is close
/// to a cable, half the coarse one while the shoe slides or hops by less than a millimetre.
static double wanted_step(const bt_landing_model* m, const bt_landing_state* s) {
    static const double impact_mps = 0.5, steps_ahead = 4;
    const bt_solver_params* solver = &m->params.landing.solver;
    const double ahead_s = steps_ahead * solver->airframe_step_s;
    const double speed = fabs(bt_landing_output(m, s, m->airframe.shoe, BT_SHOE_RATE));
    const bool at_deck =
        bt_landing_output(m, s, m->airframe.shoe, BT_SHOE_HEIGHT) < ahead_s * speed;
    double clearance_m = INFINITY;
    for (int k = 0; k < m->wire_count; ++k)
        clearance_m = fmin(clearance_m, s->wire[k].clearance_m[BT_PART_HOOK]);
    const bool at_cable = clearance_m < ahead_s * fabs(s->airframe.v[6 * BT_BODY_HOOK]);
    if (at_cable || (at_deck && speed > impact_mps))
        return fmin(solver->contact_step_s, solver->airframe_step_s);
    return at_deck ? 0.5 * solver->airframe_step_s : solver->airframe_step_s;
}

/// The glide ends with a step, at time 0.
static double choose_step(const bt_landing_model* m, const bt_landing_state* s) {
    const double step_s = fmin(wanted_step(m, s), damped_step(m, s));
    const double left_s = -s->airframe.time_s;
    return s->phase == BT_PHASE_GLIDE ? left_s / ceil(left_s / step_s) : step_s;
}

void bt_landing_move_deck(const bt_landing_model* m, bt_landing_state* s, double step_s) {
    const bt_motion_params* motion = &m->params.deck.motion;
    const double g = m->params.deck.gravity_mps2, now_s = s->airframe.time_s;
    const double carried = s->phase == BT_PHASE_GLIDE ? m->params.aircraft.lift_ratio : 1;
    bt_frame wires;
    bt_ship_frame(motion, g, carried, now_s + step_s, &s->airframe.frame);
    bt_ship_frame(motion, g, 1, now_s, &wires);
    for (int k = 0; k < m->wire_count; ++k)
        bt_ship_frame_ahead(&wires, m->wire[k].position_m, &s->wire[k].cable.scalars->frame);
}

/// From the first touch on all of the weight acts.
static bool end_glide(const bt_landing_model* m, bt_landing_state* s, bt_failure* failure) {
    if (s->phase != BT_PHASE_GLIDE || s->airframe.time_s < 0)
        return true;
    s->phase = BT_PHASE_ROLL;
    s->airframe.frame = m->hanging.frame;
    if (m->moves)
        bt_landing_move_deck(m, s, 0);
    return bt_system_evaluate(m->airframe.system, &s->airframe, failure) == BT_OK;
}

/* ---- the wires ---- */

/// Mean wrench of the airframe step on one body.
static void apply_reaction(const bt_moving_body* part, double step_s, double* applied) {
    double torque[3];
    bt_unrotate(part->rotation, part->moment_Nms, torque);
    for (int i = 0; i < 3; ++i) {
        applied[i] = part->impulse_Ns[i] / step_s;
        applied[3 + i] = torque[i] / step_s;
    }
}

static void step_wires(const bt_landing_model* m, bt_landing_state* s, double step_s) {
    const bt_landing_params* p = &m->params.landing;
    const double reach_m = 2 * step_s * p->horizontal_speed_mps + 0.01;
    memset(s->airframe.applied, 0, 6 * BT_BODY_COUNT * sizeof *s->airframe.applied);
    bool met[BT_PART_COUNT] = {false};
    for (int k = 0; k < m->wire_count; ++k) {
        const bt_wire* wire = &m->wire[k];
        s->result.cable_steps += bt_wire_step(
            wire, &s->wire[k], s->part, &s->slides, s->observed ? &s->works : NULL,
            s->airframe.time_s, step_s, p->solver.cable_courant * wire->cable->stable_step_s,
            reach_m, s->hops.touched);
        for (int part = 0; part < BT_PART_COUNT; ++part)
            met[part] |= !s->wire[k].clearer[part];
    }
    for (int part = 0; part < BT_PART_COUNT; ++part)
        if (met[part])
            apply_reaction(&s->part[part], step_s, s->airframe.applied + 6 * body_of(part));
}

/* ---- what has been seen ---- */

static bool on_wire(const bt_landing_model* m, const bt_landing_state* s) {
    for (int k = 0; k < m->wire_count; ++k)
        if (!isnan(s->wire[k].meeting.first_contact_s))
            return true;
    return false;
}

/// After an airframe step: what the wheels, struts, the shoe and the wires have seen.
static void record(const bt_landing_model* m, bt_landing_state* s) {
    const bt_airframe* f = &m->airframe;
    bt_landing_result* result = &s->result;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const double load = bt_landing_output(m, s, f->wheel[leg], BT_WHEEL_NORMAL) +
                            s->airframe.applied[6 * body_of(leg) + 2];
        result->tyre_force_max_N[leg] = fmax(result->tyre_force_max_N[leg], load);
        result->strut_stroke_max_m[leg] =
            fmax(result->strut_stroke_max_m[leg],
                 bt_landing_output(m, s, f->strut[leg], BT_STRUT_STROKE));
    }
    bt_hops_see(&s->hops, result, bt_landing_output(m, s, f->shoe, BT_SHOE_X),
                bt_landing_output(m, s, f->shoe, BT_SHOE_HEIGHT),
                bt_landing_output(m, s, f->shoe, BT_SHOE_FORCE), on_wire(m, s));
    for (int k = 0; k < m->wire_count; ++k) {
        bt_wire_record(&m->wire[k], &s->wire[k], s->airframe.time_s, s->hops.touched);
        bt_wire_pass(&s->wire[k], m->params.landing.solver.past_cable_m);
    }
}

/// Whether the laws of the airframe's elements hold: at their limit a remark, beyond it a failure.
static bool laws_hold(const bt_landing_model* m, bt_landing_state* s) {
    const bt_airframe* f = &m->airframe;
    const struct {
        int element, remark;
    } parts[] = {
        {f->strut[0], BT_REMARK_STRUT_BOTTOMED_NOSE},  {f->strut[1], BT_REMARK_STRUT_BOTTOMED_LEFT},
        {f->strut[2], BT_REMARK_STRUT_BOTTOMED_RIGHT}, {f->wheel[0], BT_REMARK_TYRE_ON_RIM_NOSE},
        {f->wheel[1], BT_REMARK_TYRE_ON_RIM_LEFT},     {f->wheel[2], BT_REMARK_TYRE_ON_RIM_RIGHT},
        {f->damper, BT_REMARK_HOOK_STOP_HIT},          {f->shoe, BT_REMARK_COUNT}};
    for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k) {
        const char* what = "";
        const bt_law law = bt_system_element_law(f->system, &s->airframe, parts[k].element, &what);
        if (law == BT_LAW_LEFT) {
            bt_landing_fail(s, bt_system_element_name(f->system, parts[k].element), what,
                            s->airframe.time_s);
            return false;
        }
        if (law == BT_LAW_AT_LIMIT && parts[k].remark < BT_REMARK_COUNT)
            bt_remarks_note(&s->result.remarks, (bt_remark)parts[k].remark, s->airframe.time_s);
    }
    if (bt_airframe_tail_height(f, &s->airframe) <= 0)
        bt_remarks_note(&s->result.remarks, BT_REMARK_TAIL_CLEARANCE, s->airframe.time_s);
    return true;
}

/// Caught and held a little, past the last wire, out of its reach, or at rest before it.
static bt_landing_phase phase_of(const bt_landing_model* m, const bt_landing_state* s) {
    static const double stopped_share = 0.02; // of the landing's speed
    bool past_all = true, caught = false;
    for (int k = 0; k < m->wire_count; ++k) {
        const bt_meeting* meeting = &s->wire[k].meeting;
        caught |= bt_meeting_caught(meeting);
        past_all &= meeting->passed;
        if (s->airframe.time_s >= meeting->catch_s + m->params.landing.solver.after_catch_s)
            return BT_PHASE_CAUGHT;
    }
    if (caught)
        return s->phase;
    if (past_all)
        return BT_PHASE_PASSED;
    const double speed_mps = s->airframe.v[6 * BT_BODY_FUSELAGE];
    const bool stopped = speed_mps < stopped_share * m->params.landing.horizontal_speed_mps;
    return stopped || s->airframe.time_s > s->end_by_s ? BT_PHASE_STOPPED : s->phase;
}

static bool cables_are_finite(const bt_landing_model* m, const bt_landing_state* s) {
    for (int k = 0; k < m->wire_count; ++k)
        if (s->wire[k].awake && !s->wire[k].left &&
            !bt_cable_is_finite(m->wire[k].cable, &s->wire[k].cable))
            return false;
    return true;
}

/// The last wire is never left: with it the landing is over.
static void leave_wires(const bt_landing_model* m, bt_landing_state* s) {
    if (!bt_phase_is_over(s->phase) && !m->keeps_wires)
        for (int k = 0; k < m->wire_count; ++k)
            bt_wire_leave(&m->wire[k], &s->wire[k], s->part);
}

bool bt_landing_step(const bt_landing_model* m, bt_landing_state* s) {
    bt_failure failure = {0};
    if (bt_phase_is_over(s->phase))
        return false;
    if (!end_glide(m, s, &failure)) {
        bt_landing_fail(s, failure.where, failure.quantity, failure.time_s);
        return false;
    }
    // 1. where wheels and hook are, how far from the wires, and the step that all parts bear
    bt_landing_follow_parts(m, s);
    const double step_s = choose_step(m, s);
    if (m->moves)
        bt_landing_move_deck(m, s, step_s);
    // 2. wires: joints, tyres and hook on the cable, steps of their own
    //    [Peng2023 Eqs. 6, 7, 11-17]; the airframe gets the opposite as a mean over the step
    step_wires(m, s, step_s);
    // 3. airframe: struts [Peng2023 Eqs. 2-5], tyres on the deck [Peng2023 Eqs. 6-8], hook damper
    //    [Peng2023 Eq. 9], hook on the deck [Peng2023 Eq. 10], solved with the joints
    //    [Peng2023 Eq. 1]
    if (bt_system_step(m->airframe.system, &s->airframe, step_s, BT_INTEGRATOR_SECOND_ORDER,
                       &failure) != BT_OK)
        bt_landing_fail(s, failure.where, failure.quantity, failure.time_s);
    else if (!cables_are_finite(m, s))
        bt_landing_fail(s, "cable", "position or velocity", s->airframe.time_s);
    else if (laws_hold(m, s)) {
        // 4. bounces, loads, and the limit state of every wire [Peng2023 Eq. 18]
        record(m, s);
        s->phase = phase_of(m, s);
        leave_wires(m, s);
    }
    return !bt_phase_is_over(s->phase);
}
