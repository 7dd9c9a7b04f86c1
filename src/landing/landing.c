#include "landing/landing.h"

#include "base/clock.h"
#include "base/hash.h"
#include "elements/hook_damper_element.h"
#include "elements/strut.h"
#include "elements/wheel.h"
#include "landing/airframe.h"
#include "landing/cable_contact.h"
#include "landing/outcome.h"
#include "mechanics/vec.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Memory of one landing in flight: state and scratch of the airframe, model and states of the
/// cable.
static const size_t arena_size = 900 * 1024;

struct bt_lander {
    bt_arena arena;
    const atomic_int* stop; ///< may be NULL
    size_t airframe_mark;   ///< of the arena: what follows belongs to the cable
    bt_model_params built;  ///< what airframe and cable, where there are any, were built from
    bool has_airframe, has_cable;

    bt_airframe airframe;
    bt_state hanging, state;
    bt_cable_model cable_model;
    bt_cable_state resting, cable;
    double segment_m[BT_CABLE_SEGMENTS_MAX];
};

/// Works at the contacts of wheels and hook with the cable, J.
typedef struct works {
    double on_cable, friction,
        friction_most; ///< so far; of friction in one cable step, the largest
} works;

/// One run: what changes while a landing is computed, beside the states.
typedef struct run {
    bt_lander* lander;
    const bt_model_params* params;
    bt_landing_result* result;
    bt_tracker tracker;
    bt_moving_body wheel[BT_LEG_COUNT], hook;
    bt_wheel_contact wheel_contact[BT_LEG_COUNT];
    bt_hook_contact hook_contact;
    bt_slides slides;
    double clearance_m[BT_LEG_COUNT + 1]; ///< of wheels and hook from the cable; last: the hook
    double tension_N[BT_CABLE_SEGMENTS_MAX];
    bool observed; ///< somebody looks: the works are worth their time
    works works;
    bool awake;     ///< the cable has left its equilibrium
    bool loaded;    ///< wheels or hook have put loads on the cable
    bool hook_near; ///< the hook may have touched the cable in this step
    bt_failure failure;
} run;

bt_status bt_lander_create(bt_lander** lander) {
    *lander = calloc(1, sizeof **lander);
    if (!*lander)
        return BT_ERR_MEMORY;
    const bt_status status = bt_arena_create(&(*lander)->arena, arena_size);
    if (status != BT_OK) {
        free(*lander);
        *lander = NULL;
    }
    return status;
}

void bt_lander_destroy(bt_lander* lander) {
    if (!lander)
        return;
    if (lander->has_airframe)
        bt_airframe_destroy(&lander->airframe);
    bt_arena_destroy(&lander->arena);
    free(lander);
}

void bt_lander_obey(bt_lander* lander, const atomic_int* stop) {
    lander->stop = stop;
}

static bool stopped(const bt_lander* l) {
    return l->stop && atomic_load_explicit(l->stop, memory_order_relaxed) != 0;
}

size_t bt_lander_memory(const bt_lander* lander) {
    return sizeof *lander + lander->arena.size;
}

/// Builds the airframe unless the last run's is the same.
static bt_status prepare_airframe(bt_lander* l, const bt_model_params* p, bt_diag* diag) {
    if (l->has_airframe && memcmp(&l->built.aircraft, &p->aircraft, sizeof p->aircraft) == 0 &&
        l->built.deck.gravity_mps2 == p->deck.gravity_mps2 &&
        l->built.deck.cable.diameter_m == p->deck.cable.diameter_m)
        return BT_OK;
    if (l->has_airframe)
        bt_airframe_destroy(&l->airframe);
    l->has_airframe = l->has_cable = false;
    bt_arena_reset(&l->arena, 0);
    BT_TRY(bt_airframe_build(&p->aircraft, p->deck.gravity_mps2, 0.5 * p->deck.cable.diameter_m,
                             &l->airframe, diag));
    l->has_airframe = true;
    BT_TRY(bt_state_create(l->airframe.system, &l->arena, &l->hanging));
    BT_TRY(bt_state_create(l->airframe.system, &l->arena, &l->state));
    l->airframe_mark = l->arena.used;
    return BT_OK;
}

/// Builds the cable and finds its equilibrium unless the last run's is the same.
static bt_status prepare_cable(bt_lander* l, const bt_model_params* p, bt_diag* diag) {
    if (l->has_cable && memcmp(&l->built.deck, &p->deck, sizeof p->deck) == 0)
        return BT_OK;
    l->has_cable = false;
    bt_arena_reset(&l->arena, l->airframe_mark);
    bt_cable_def def;
    bt_cable_def_init(&def, &p->deck.cable, p->deck.gravity_mps2, l->segment_m);
    if (bt_cable_memory(def.count, 2) > l->arena.size - l->arena.used) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "deck.cable.mesh: %d segments need more than the memory of one landing; "
                    "coarser segments or a smaller fine_half_width would do",
                    def.count);
        return BT_ERR_INPUT;
    }
    BT_TRY(bt_cable_model_init(&l->cable_model, &def, &l->arena, diag));
    BT_TRY(bt_cable_state_init(&l->cable_model, &l->resting, &l->arena));
    BT_TRY(bt_cable_state_init(&l->cable_model, &l->cable, &l->arena));
    BT_TRY(bt_cable_equilibrium(&l->cable_model, &l->resting, NULL, diag));
    l->has_cable = true;
    return BT_OK;
}

/// What the wheels and the hook bring to the cable.
static void prepare_contacts(run* r) {
    bt_lander* l = r->lander;
    const bt_cable_params* cable = &r->params->deck.cable;
    const bt_hook_cable_params* contact = &r->params->aircraft.hook.cable_contact;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        l->airframe.tyre[leg].strips = (int)r->params->landing.solver.tyre_strips;
        r->wheel_contact[leg] = (bt_wheel_contact){.tyre = &l->airframe.tyre[leg],
                                                   .width_m = l->airframe.tyre_width_m[leg],
                                                   .friction = cable->wheel_friction,
                                                   .slip_speed_mps = contact->slip_speed_mps,
                                                   .hint = -1};
    }
    r->hook_contact = (bt_hook_contact){.profile = &l->airframe.profile,
                                        .stiffness = contact->stiffness_Npm2,
                                        .damping = 2 * contact->damping_ratio *
                                                   sqrt(contact->stiffness_Npm2 * cable->mass_kgpm),
                                        .friction = contact->friction,
                                        .slip_speed_mps = contact->slip_speed_mps,
                                        .hint = -1};
    memcpy(r->hook_contact.shoe_m, l->airframe.shoe_m, sizeof l->airframe.shoe_m);
}

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
    bt_moving_body_to(part, 0);
}

static void follow_bodies(run* r) {
    const bt_lander* l = r->lander;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        follow_body(&l->state, BT_BODY_NOSE_WHEEL + leg, &r->wheel[leg]);
        r->clearance_m[leg] =
            bt_wheel_clearance(&r->wheel_contact[leg], &l->cable_model, &l->cable, &r->wheel[leg]);
    }
    follow_body(&l->state, BT_BODY_HOOK, &r->hook);
    r->clearance_m[BT_LEG_COUNT] =
        bt_hook_clearance(&r->hook_contact, &l->cable_model, &l->cable, &r->hook);
}

/// When, on the glide, a part whose lowest point is `lowest_m` at time 0 and that reaches
/// `reach_m` fore and aft comes up to the cable; 0 when it does so later, or leaves it again
/// higher than `top_m`.
static double comes_to_cable_s(const bt_landing_params* p, const double lowest_m[3], double reach_m,
                               double top_m) {
    const double enters_s = (-reach_m - lowest_m[0]) / p->horizontal_speed_mps;
    const double leaves_s = (reach_m - lowest_m[0]) / p->horizontal_speed_mps;
    const double leaves_at_m = lowest_m[2] - fmin(leaves_s, 0) * p->sink_speed_mps;
    return enters_s < 0 && leaves_at_m < top_m ? enters_s : 0;
}

/// Places aircraft and cable: the cable rests at x = 0, the named part of the gliding aircraft is
/// `distance` before it when the first part touches the deck at time 0. The run starts a little
/// earlier: before the first touch, before any tyre comes up to the cable, and before the hook
/// crosses it.
static void start(run* r) {
    static const double before_touch_s = 1e-3, hook_reach_m = 0.5, tyre_margin_m = 0.05,
                        above_cable_m = 0.1;
    bt_lander* l = r->lander;
    const bt_landing_params* p = &r->params->landing;
    bt_glide glide;
    bt_airframe_place(&l->airframe, p, &l->hanging, &l->state, &glide);

    double lowest = glide.hook_m[2];
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        lowest = fmin(lowest, glide.tyre_m[leg][2]);
    const double wheels_x = 0.5 * (glide.tyre_m[BT_LEG_LEFT][0] + glide.tyre_m[BT_LEG_RIGHT][0]);
    const bt_cable_params* cable = &r->params->deck.cable;
    const double top_m =
        fmax(cable->supports.height_m, cable->sheaves.height_m) + cable->diameter_m + above_cable_m;
    const double from = p->distance_from == BT_DISTANCE_FROM_HOOK ? glide.hook_m[0] : wheels_x;

    // places at time 0; going back along the glide is exact, since nothing touches anything there
    const double shift[3] = {-p->distance_m - from, 0, -lowest};
    double begin_s = -before_touch_s;
    bt_add_scaled(glide.hook_m, 1, shift);
    // the hook's way over the cable is seen from however high: it gives the margin
    begin_s = fmin(begin_s, comes_to_cable_s(p, glide.hook_m, hook_reach_m, INFINITY));
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        bt_add_scaled(glide.tyre_m[leg], 1, shift);
        const double reach_m = l->airframe.tyre[leg].radius + tyre_margin_m;
        begin_s = fmin(begin_s, comes_to_cable_s(p, glide.tyre_m[leg], reach_m, top_m));
    }
    const double back[3] = {shift[0] + begin_s * p->horizontal_speed_mps, 0,
                            shift[2] - begin_s * p->sink_speed_mps};
    bt_airframe_move(&l->airframe, back, &l->state);
    l->state.time_s = begin_s;
    l->state.steps = 0;

    bt_cable_state_copy(&l->cable_model, &l->cable, &l->resting);
    prepare_contacts(r);
    bt_tracker_start(&r->tracker, r->result);
}

/// The longest step at which the oil damping of the unsprung masses is stable: 0.8 of
/// m / (dF_h/ds'), dF_h/ds' = 2 F_h / s'. A rebound valve asks for it when a wheel leaves the deck.
static double damped_step(const run* r) {
    const bt_airframe* f = &r->lander->airframe;
    double step_s = INFINITY;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const double* strut = bt_system_element_output(f->system, &r->lander->state, f->strut[leg]);
        const double rate = strut[BT_STRUT_RATE];
        const double oil_N = bt_oleo_oil_force(&f->oleo[leg], strut[BT_STRUT_STROKE], rate);
        if (oil_N != 0)
            step_s = fmin(step_s, 0.4 * f->unsprung_kg[leg] * rate / oil_N);
    }
    return step_s;
}

/// The airframe's step: fine around an impact of the shoe on the deck and while the hook is near
/// the cable, half the coarse one while the shoe slides or hops by less than a millimetre.
static double wanted_step(const run* r) {
    static const double impact_mps = 0.5, steps_ahead = 4;
    const bt_lander* l = r->lander;
    const bt_solver_params* s = &r->params->landing.solver;
    const double ahead_s = steps_ahead * s->airframe_step_s;
    const double* shoe = bt_system_element_output(l->airframe.system, &l->state, l->airframe.shoe);
    const double speed = fabs(shoe[BT_SHOE_RATE]);
    const bool at_deck = shoe[BT_SHOE_HEIGHT] < ahead_s * speed;
    const bool at_cable =
        r->clearance_m[BT_LEG_COUNT] < ahead_s * fabs(l->state.v[6 * BT_BODY_HOOK]);
    if (at_cable || (at_deck && speed > impact_mps))
        return fmin(s->contact_step_s, s->airframe_step_s);
    return at_deck ? 0.5 * s->airframe_step_s : s->airframe_step_s;
}

static double choose_step(const run* r) {
    return fmin(wanted_step(r), damped_step(r));
}

/// Mean wrench of the airframe step on one body.
static void give_back(const bt_moving_body* part, double step_s, double* applied) {
    double torque[3];
    bt_unrotate(part->rotation, part->moment_Nms, torque);
    for (int i = 0; i < 3; ++i) {
        applied[i] = part->impulse_Ns[i] / step_s;
        applied[3 + i] = torque[i] / step_s;
    }
}

/// The rest of a cable step; with the works of what touches it, by the mean of the velocities
/// before and after, when somebody looks.
static void advance_cable(run* r, double step_s) {
    const bt_cable_model* model = &r->lander->cable_model;
    bt_cable_state* cable = &r->lander->cable;
    if (!r->observed || !r->loaded) {
        bt_cable_advance(model, cable, step_s);
        return;
    }
    const bt_slides* slides = &r->slides;
    const double half_s = 0.25 * (cable->scalars->last_step_s + step_s);
    double on_cable = bt_cable_load_power(model, cable);
    double friction = bt_cable_slides_power(cable, slides->at, slides->resolved);
    bt_cable_advance(model, cable, step_s);
    on_cable += bt_cable_load_power(model, cable);
    friction += bt_cable_slides_power(cable, slides->at, slides->resolved);
    r->works.on_cable += half_s * on_cable;
    r->works.friction += half_s * friction;
    if (slides->resolved > 0)
        r->works.friction_most = fmax(r->works.friction_most, half_s * friction);
}

/// The cable's own steps within one airframe step. It sleeps in its equilibrium until something
/// can touch it.
static void step_cable(run* r, double step_s) {
    bt_lander* l = r->lander;
    const double reach_m = 2 * step_s * r->params->landing.horizontal_speed_mps + 0.01;
    bool near[BT_LEG_COUNT + 1], any = false;
    for (int part = 0; part <= BT_LEG_COUNT; ++part)
        any |= near[part] = r->clearance_m[part] < reach_m;
    r->awake |= any;
    r->hook_near = near[BT_LEG_COUNT];
    memset(l->state.applied, 0, 6 * BT_BODY_COUNT * sizeof *l->state.applied);
    if (!r->awake)
        return;

    const double stable_s = r->params->landing.solver.cable_courant * l->cable_model.stable_step_s;
    const int count = (int)ceil(step_s / stable_s);
    const double sub_s = step_s / count;
    for (int k = 0; k < count; ++k) {
        if (r->loaded)
            bt_cable_clear_loads(&l->cable_model, &l->cable);
        r->loaded = any;
        bt_cable_forces(&l->cable_model, &l->cable);
        for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
            if (near[leg]) {
                bt_moving_body_to(&r->wheel[leg], k * sub_s);
                bt_wheel_contact_press(&r->wheel_contact[leg], &l->cable_model, &l->cable,
                                       &r->wheel[leg], &r->slides, sub_s);
            }
        if (near[BT_LEG_COUNT]) {
            bt_moving_body_to(&r->hook, k * sub_s);
            bt_hook_contact_press(&r->hook_contact, &l->cable_model, &l->cable, &r->hook,
                                  &r->slides, sub_s);
            bt_tracker_cable(&r->tracker, r->result, l->state.time_s + k * sub_s,
                             r->hook_contact.zone_force_N, r->hook_contact.lip_m,
                             r->hook_contact.cable_m);
        }
        bt_slides_resolve(&r->slides, &l->cable_model, &l->cable, sub_s);
        advance_cable(r, sub_s);
        ++r->result->cable_steps;
    }
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg)
        if (near[leg])
            give_back(&r->wheel[leg], step_s, l->state.applied + 6 * (BT_BODY_NOSE_WHEEL + leg));
    if (near[BT_LEG_COUNT])
        give_back(&r->hook, step_s, l->state.applied + 6 * BT_BODY_HOOK);
    else
        memset(r->hook_contact.zone_force_N, 0, sizeof r->hook_contact.zone_force_N);
}

static double leg_output(const run* r, int element, int index) {
    return bt_system_element_output(r->lander->airframe.system, &r->lander->state, element)[index];
}

/// After an airframe step: what the wheels, struts and the shoe have seen.
static void record(run* r) {
    const bt_lander* l = r->lander;
    const bt_airframe* f = &l->airframe;
    bt_landing_result* result = r->result;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const double load = leg_output(r, f->wheel[leg], BT_WHEEL_NORMAL) +
                            l->state.applied[6 * (BT_BODY_NOSE_WHEEL + leg) + 2];
        result->tyre_force_max_N[leg] = fmax(result->tyre_force_max_N[leg], load);
        result->strut_stroke_max_m[leg] =
            fmax(result->strut_stroke_max_m[leg], leg_output(r, f->strut[leg], BT_STRUT_STROKE));
    }
    bt_tracker_deck(&r->tracker, result, leg_output(r, f->shoe, BT_SHOE_X),
                    leg_output(r, f->shoe, BT_SHOE_HEIGHT), leg_output(r, f->shoe, BT_SHOE_FORCE));
    if (!r->hook_near)
        bt_tracker_cable(&r->tracker, result, l->state.time_s, r->hook_contact.zone_force_N,
                         r->hook_contact.lip_m, r->hook_contact.cable_m);
    if (r->awake)
        result->cable_tension_max_N =
            fmax(result->cable_tension_max_N, bt_cable_tension_max(&l->cable_model, &l->cable));
}

/// Shank below the fuselage axis: the angle of the hook's x axis in the fuselage's frame.
static double hook_angle(const bt_state* state) {
    const double* a = state->rotation + 9 * BT_BODY_HOOK;
    const double shank[3] = {a[0], a[3], a[6]};
    double local[3];
    bt_unrotate(state->rotation, shank, local);
    return atan2(local[2], local[0]);
}

/// Shows the present state to the observer.
static void show(run* r, bt_landing_observer* observer, void* user, bool last) {
    if (!observer)
        return;
    bt_lander* l = r->lander;
    const bt_airframe* f = &l->airframe;
    const bt_state* s = &l->state;
    bt_landing_view view = {
        .time_s = s->time_s,
        .step = s->steps,
        .last = last,
        .q = s->q,
        .v = s->v,
        .rotation = s->rotation,
        .hook_angle_rad = hook_angle(s),
        .hook_height_m = leg_output(r, f->shoe, BT_SHOE_HEIGHT),
        .hook_deck_force_N = leg_output(r, f->shoe, BT_SHOE_FORCE),
        .hook_damper_force_N = leg_output(r, f->damper, BT_HOOK_DAMPER_FORCE),
        .cable_wrench = s->applied,
        .cable_work_J = r->works.on_cable,
        .friction_J = r->works.friction,
        .friction_most_J = r->works.friction_most,
        .cable_awake = r->awake,
        .cable_count = l->cable_model.count,
        .cable_x = l->cable.x,
        .cable_y = l->cable.y,
        .cable_z = l->cable.z,
        .cable_tension_N = r->tension_N,
        .run = r,
    };
    const bt_motion motion = {.time_s = s->time_s, .q = s->q, .v = s->v, .rotation = s->rotation};
    const bt_shoe* shoe = &f->shoe_contact;
    bt_point_position(&motion, BT_BODY_HOOK, shoe->shoe_m, view.hook_shoe_m);
    bt_point_position(&motion, BT_BODY_HOOK, shoe->lip_m, view.hook_lip_m);
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        double force[3], torque[3];
        view.stroke_m[leg] = leg_output(r, f->strut[leg], BT_STRUT_STROKE);
        view.strut_force_N[leg] = leg_output(r, f->strut[leg], BT_STRUT_FORCE);
        view.tyre_deflection_m[leg] = leg_output(r, f->wheel[leg], BT_WHEEL_DEFLECTION);
        view.tyre_force_N[leg] = leg_output(r, f->wheel[leg], BT_WHEEL_NORMAL) +
                                 s->applied[6 * (BT_BODY_NOSE_WHEEL + leg) + 2];
        view.tyre_cable_force_N[leg] = r->wheel_contact[leg].normal_N;
        view.wheel_spin_radps[leg] = s->v[6 * (BT_BODY_NOSE_WHEEL + leg) + 4];
        bt_system_joint_load(f->system, s, f->strut_joint[leg], force, torque);
        const double* up = s->rotation; // third column of the fuselage
        const double along = force[0] * up[2] + force[1] * up[5] + force[2] * up[8];
        view.strut_side_force_N[leg] = sqrt(fmax(0, bt_dot(force, force) - along * along));
    }
    double torque[3];
    bt_system_joint_load(f->system, s, f->hook_joint, view.hook_pivot_force_N, torque);
    memcpy(view.zone_force_N, r->hook_contact.zone_force_N, sizeof view.zone_force_N);
    bt_audit audit;
    bt_system_audit(f->system, s, &audit);
    view.energy_J = audit.kinetic_J + audit.potential_J;
    for (int i = 1; i < l->cable_model.count; ++i)
        r->tension_N[i - 1] = bt_cable_tension(&l->cable_model, &l->cable, i);
    observer(user, &view);
}

double bt_landing_cable_energy(const bt_landing_view* view) {
    const run* r = view->run;
    bt_cable_energy energy;
    bt_cable_audit(&r->lander->cable_model, &r->lander->cable, &energy);
    return energy.kinetic_J + energy.elastic_J + energy.gravity_J;
}

/// The run is over: caught and held a little, past the cable, or out of reach of it.
static bool over(const run* r) {
    const bt_landing_params* p = &r->params->landing;
    const double now = r->lander->state.time_s;
    if (bt_tracker_caught(&r->tracker))
        return now >= r->tracker.catch_s + p->solver.after_catch_s;
    const double past_m = r->hook_contact.lip_m[0] - r->hook_contact.cable_m[0];
    return past_m >= p->solver.past_cable_m || r->hook_contact.lip_m[0] >= BT_PAST_CABLE_MOST_M;
}

static bool fail(run* r, const char* element, const char* quantity, double time_s) {
    bt_landing_result* result = r->result;
    result->outcome = BT_FAILED;
    result->mode = BT_MODE_NONE;
    result->margin_m = NAN;
    result->failed_time_s = time_s;
    snprintf(result->failed_element, sizeof result->failed_element, "%s", element);
    snprintf(result->failed_quantity, sizeof result->failed_quantity, "%s", quantity);
    return false;
}

/// One airframe step: the cable meets wheels and hook, then forces, KKT solve, advance, project.
static bool step(run* r) {
    bt_lander* l = r->lander;
    follow_bodies(r);
    const double step_s = choose_step(r);
    step_cable(r, step_s);
    if (bt_system_step(l->airframe.system, &l->state, step_s, BT_INTEGRATOR_SECOND_ORDER,
                       &r->failure) != BT_OK)
        return fail(r, r->failure.where, r->failure.quantity, r->failure.time_s);
    if (r->awake && !bt_cable_is_finite(&l->cable_model, &l->cable))
        return fail(r, "cable", "position or velocity", l->state.time_s);
    record(r);
    return true;
}

/// FNV-1a over the final state of airframe and cable.
static uint64_t hash_state(const bt_lander* l) {
    uint64_t hash = BT_HASH_START;
    const size_t count = (size_t)l->cable_model.count * sizeof(double);
    hash = bt_hash_bytes(hash, l->state.q, 7 * BT_BODY_COUNT * sizeof(double));
    hash = bt_hash_bytes(hash, l->state.v, 6 * BT_BODY_COUNT * sizeof(double));
    hash = bt_hash_bytes(hash, l->cable.x, count);
    hash = bt_hash_bytes(hash, l->cable.y, count);
    return bt_hash_bytes(hash, l->cable.z, count);
}

bt_status bt_lander_prepare(bt_lander* lander, const bt_model_params* params, bt_diag* diag) {
    BT_TRY(prepare_airframe(lander, params, diag));
    const bt_status status = prepare_cable(lander, params, diag);
    lander->built = *params; // also when the cable is refused: the airframe may be a new one
    return status == BT_ERR_NUMERIC ? BT_ERR_INPUT : status; // no equilibrium: said in diag
}

bt_status bt_lander_run(bt_lander* lander, const bt_model_params* params, bt_landing_result* result,
                        bt_landing_observer* observer, void* user, bt_diag* diag) {
    const double begin_s = bt_clock_s();
    BT_TRY(bt_lander_prepare(lander, params, diag));

    run r = {.lander = lander,
             .params = params,
             .result = result,
             .observed = observer != NULL,
             .works = {.friction_most = -INFINITY}};
    start(&r);
    result->shank_bends = lander->airframe.shank.bends;
    bool sound = bt_system_project(lander->airframe.system, &lander->state, &r.failure) == BT_OK &&
                 bt_system_evaluate(lander->airframe.system, &lander->state, &r.failure) == BT_OK;
    if (!sound)
        fail(&r, r.failure.where, r.failure.quantity, r.failure.time_s);
    while (sound && !over(&r)) {
        if (stopped(lander))
            return BT_ERR_INTERRUPTED;
        show(&r, observer, user, false);
        sound = step(&r);
    }
    if (sound)
        bt_tracker_finish(&r.tracker, result);
    show(&r, observer, user, true);

    result->steps = lander->state.steps;
    result->end_time_s = lander->state.time_s;
    result->state_hash = hash_state(lander);
    result->wall_s = bt_clock_s() - begin_s;
    return BT_OK;
}
