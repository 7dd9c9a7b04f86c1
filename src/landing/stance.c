#include "landing/stance.h"

#include "elements/hook_damper_element.h"
#include "elements/strut.h"
#include "elements/wheel.h"
#include "mechanics/vec.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const char* const gear_keys[BT_LEG_COUNT] = {"nose_gear", "main_gear", "main_gear"};

/* ---- placing ---- */

/// A part of the hook in the fuselage's axes, from its centre of mass.
static void place_shank(const bt_airframe* f, double turned_m, double centre_m, double root_rad,
                        double angle_rad, double local[3], double e[4]) {
    const double along = centre_m - turned_m;
    local[0] = f->pivot_m[0] - turned_m * cos(root_rad) - along * cos(angle_rad);
    local[1] = 0;
    local[2] = f->pivot_m[2] - turned_m * sin(root_rad) - along * sin(angle_rad);
    bt_add_scaled(local, -1, f->fuselage_m);
    const double attitude[4] = {cos(0.5 * angle_rad), 0, -sin(0.5 * angle_rad), 0};
    memcpy(e, attitude, sizeof attitude);
}

/// Moves a piston or arm, or a wheel, from where it hangs to where it is at the stance's stroke.
static void place_on_leg(const bt_airframe* f, const bt_stance* s, int leg, bool piston,
                         double local[3], double e[4]) {
    bt_leg_place hangs, stands;
    bt_leg_at(&f->leg[leg], f->stroke_m[leg], &hangs);
    bt_leg_at(&f->leg[leg], s->stroke_m[leg], &stands);
    bt_add_scaled(local, 1, piston ? stands.piston_m : stands.axle_m);
    bt_add_scaled(local, -1, piston ? hangs.piston_m : hangs.axle_m);
    if (piston)
        memcpy(e, stands.attitude, sizeof stands.attitude);
}

/// A body's place and attitude in the fuselage's axes.
static void place_in_fuselage(const bt_airframe* f, const bt_state* hanging, const bt_stance* s,
                              int body, double local[3], double e[4]) {
    const double* from = hanging->q + 7 * body;
    if (body == BT_BODY_HOOK) {
        place_shank(f, f->shank.joint_m, f->shank.head.centre_m, s->hook_rad, s->head_rad, local,
                    e);
        return;
    }
    if (body >= BT_BODY_COUNT) {
        place_shank(f, 0, f->shank.root.centre_m, s->hook_rad, s->hook_rad, local, e);
        return;
    }
    memcpy(local, from, 3 * sizeof *local);
    memcpy(e, from + 3, 4 * sizeof *e);
    bt_add_scaled(local, -1, hanging->q + 7 * BT_BODY_FUSELAGE);
    if (body != BT_BODY_FUSELAGE) {
        const int leg = (body - BT_BODY_NOSE_PISTON) % BT_LEG_COUNT;
        place_on_leg(f, s, leg, body < BT_BODY_NOSE_WHEEL, local, e);
    }
}

void bt_stance_place(const bt_airframe* f, const bt_landing_params* landing,
                     const bt_state* hanging, const bt_stance* s, bt_state* state,
                     bt_glide* glide) {
    const double turn[4] = {cos(0.5 * s->pitch_rad), 0, -sin(0.5 * s->pitch_rad), 0};
    double a[9], local[3], e[4];
    bt_rotation_from_euler(turn, a);
    for (int body = 0; body < f->body_count; ++body) {
        double *q = state->q + 7 * body, *v = state->v + 6 * body;
        place_in_fuselage(f, hanging, s, body, local, e);
        bt_rotate(a, local, q);
        q[1] += landing->off_centre_m;
        q[2] += s->height_m;
        bt_euler_multiply(turn, e, q + 3);
        bt_rotation_from_euler(q + 3, state->rotation + 9 * body);
        memset(v, 0, 6 * sizeof *v);
        v[0] = landing->horizontal_speed_mps;
    }
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const bt_tyre* tyre = &f->tyre[leg];
        const double* q = state->q + 7 * (BT_BODY_NOSE_WHEEL + leg);
        state->v[6 * (BT_BODY_NOSE_WHEEL + leg) + 4] =
            landing->horizontal_speed_mps / bt_tyre_rolling_radius(tyre, tyre->radius - q[2]);
        memcpy(glide->tyre_m[leg], q, sizeof glide->tyre_m[leg]);
        glide->tyre_m[leg][2] -= tyre->radius;
    }
    const bt_motion motion = {.q = state->q, .v = state->v, .rotation = state->rotation};
    bt_shoe_lowest(&f->shoe_contact, &motion, BT_BODY_HOOK, glide->hook_m);
}

/* ---- a first guess by moments, and what cannot stand ---- */

/// A search: everything it looks at.
typedef struct search {
    const bt_airframe* f;
    const bt_model_params* params;
    const bt_state* hanging;
    bt_state state;  ///< scratch
    double hook_rad; ///< where the hook was last
    double depth_m;  ///< of the shoe in the deck, as guessed
    bt_diag* diag;
} search;

static bt_status refuse_tail(const search* s, double nose_m, double main_m) {
    const bool tail = main_m >= 0;
    bt_diag_add(s->diag, BT_ERROR, BT_NOWHERE,
                "aircraft.%s.station: %g m: the aircraft tips on its %s and cannot stand for "
                "landing.start: rolling; %s 0 m, the centre of gravity, would do",
                gear_keys[tail ? BT_LEG_LEFT : BT_LEG_NOSE], tail ? main_m : nose_m,
                tail ? "tail" : "nose", tail ? "less than" : "more than");
    return BT_ERR_INPUT;
}

static bt_status refuse_lift(const search* s, double most) {
    bt_diag_add(s->diag, BT_ERROR, BT_NOWHERE,
                "aircraft.lift_ratio: %g leaves the wheels nothing to carry, so that the aircraft "
                "does not stand for landing.start: rolling; at most %.2g would do",
                s->params->aircraft.lift_ratio, most);
    return BT_ERR_INPUT;
}

static bt_status refuse_strut(const search* s, int leg, double needed_N, double most_N) {
    const bt_oleo* oleo = &s->f->oleo[leg];
    const double area = oleo->air_area, over_Pa = oleo->ambient;
    const double factor = oleo->by_points || !(area > 0)
                              ? needed_N / most_N
                              : (needed_N / area + over_Pa) / (most_N / area + over_Pa);
    bt_diag_add(s->diag, BT_ERROR, BT_NOWHERE,
                "aircraft.%s.oleo.%s: the strut bottoms under %.4g kN and the aircraft does not "
                "stand for landing.start: rolling; %.3g times as much would do",
                gear_keys[leg], oleo->by_points ? "spring_points" : "precharge", 1e-3 * needed_N,
                1.05 * factor);
    return BT_ERR_INPUT;
}

static bt_status refuse_tyre(const search* s, int leg, double load_N, const char* what) {
    bt_diag_add(s->diag, BT_ERROR, BT_NOWHERE,
                "aircraft.%s.tyre: %s under %.4g kN at rest, so that the aircraft does not stand "
                "for landing.start: rolling; twice the pressure or load would do",
                gear_keys[leg], what, 1e-3 * load_N);
    return BT_ERR_INPUT;
}

static double bisect(double low, double high, double wanted, double (*value)(const void*, double),
                     const void* of) {
    for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        *(value(of, middle) < wanted ? &low : &high) = middle;
    }
    return 0.5 * (low + high);
}

/// A leg that stands: what its axle holds up at a stroke.
typedef struct standing_leg {
    const bt_leg* leg;
    const bt_oleo* oleo;
} standing_leg;

static double carried(const void* standing, double stroke_m) {
    const standing_leg* s = standing;
    return bt_oleo_force(s->oleo, stroke_m, 0) / bt_leg_load_ratio(s->leg, stroke_m);
}

static double tyre_load(const void* tyre, double deflection_m) {
    return bt_tyre_load(tyre, deflection_m);
}

/// Stroke and height of the axle under a load. The law of a tyre is asked where it stands.
static bt_status load_leg(const search* s, int leg, double load_N, double effective_mps2,
                          double* stroke_m, double* axle_m) {
    const bt_oleo* oleo = &s->f->oleo[leg];
    const bt_gear_params* gear =
        leg == BT_LEG_NOSE ? &s->params->aircraft.nose_gear : &s->params->aircraft.main_gear;
    const double most_m = gear->oleo.stroke_max_m;
    const standing_leg standing = {&s->f->leg[leg], oleo};
    const double carried_N = load_N - effective_mps2 * s->f->leg[leg].unsprung_kg;
    const double most_N = carried(&standing, most_m);
    const char* what = "";
    if (carried_N >= most_N)
        return refuse_strut(s, leg, carried_N, most_N);
    *stroke_m = bisect(-0.1, most_m, carried_N, carried, &standing);
    const double deflection_m =
        bisect(0, 2 * s->f->tyre[leg].radius, load_N, tyre_load, &s->f->tyre[leg]);
    *axle_m = s->f->tyre[leg].radius - deflection_m;
    return bt_tyre_law(&s->f->tyre[leg], deflection_m, &what) == BT_LAW_HOLDS
               ? BT_OK
               : refuse_tyre(s, leg, load_N, what);
}

/// The stance without a hook: loads by moments about the centre of gravity.
static bt_status guess_legs(const search* s, double effective_mps2, bt_stance* stance) {
    const bt_airframe* f = s->f;
    const double nose_m = f->axle_m[BT_LEG_NOSE][0], main_m = f->axle_m[BT_LEG_LEFT][0];
    if (!(main_m < 0 && nose_m > 0))
        return refuse_tail(s, nose_m, main_m);
    const double weight_N = s->params->aircraft.mass_kg * effective_mps2 - f->lift.touchdown_N;
    if (!(weight_N > 0))
        return refuse_lift(s, 0.9);
    const double nose_N = weight_N * -main_m / (nose_m - main_m);
    const double load_N[] = {nose_N, 0.5 * (weight_N - nose_N)};
    double above_m[2]; // the centre of gravity above the deck, seen from each leg
    for (int leg = BT_LEG_NOSE; leg <= BT_LEG_LEFT; ++leg) {
        double axle_m = 0;
        BT_TRY(load_leg(s, leg, load_N[leg], effective_mps2, &stance->stroke_m[leg], &axle_m));
        bt_leg_place place;
        bt_leg_at(&f->leg[leg], stance->stroke_m[leg], &place);
        above_m[leg] = axle_m - f->axle_m[leg][2] - place.axle_m[2];
    }
    stance->stroke_m[BT_LEG_RIGHT] = stance->stroke_m[BT_LEG_LEFT];
    const double slope = (above_m[BT_LEG_NOSE] - above_m[BT_LEG_LEFT]) / (nose_m - main_m);
    stance->pitch_rad = atan(slope);
    stance->height_m =
        above_m[BT_LEG_LEFT] - slope * main_m + f->fuselage_m[2] + slope * f->fuselage_m[0];
    return BT_OK;
}

/// Lowest point of the hook at a shank angle; its head bent away by bend_rad.
static double hook_height(search* s, bt_stance* stance, double angle_rad, double bend_rad) {
    bt_glide glide;
    stance->hook_rad = angle_rad;
    stance->head_rad = angle_rad + bend_rad;
    bt_stance_place(s->f, &s->params->landing, s->hanging, stance, &s->state, &glide);
    return glide.hook_m[2];
}

/// Turns the hook until it is depth_m in the deck, from where it was last.
static void lower_hook(search* s, bt_stance* stance, double depth_m, double bend_rad) {
    const double length_m = s->params->aircraft.hook.length_m;
    double angle_rad = s->hook_rad;
    for (int i = 0; i < 30; ++i) {
        const double left_m = hook_height(s, stance, angle_rad, bend_rad) + depth_m;
        if (fabs(left_m) < 1e-15)
            break;
        angle_rad += left_m / (length_m * fmax(0.1, cos(angle_rad + stance->pitch_rad)));
    }
    s->hook_rad = angle_rad;
}

/// The hook just in the deck.
static bt_status guess_hook(search* s, bt_stance* stance) {
    static const double depth_m = 1e-4, range_rad = 1.5;
    const double hanging_rad = s->f->hook_angle_rad;
    const double above_m = hook_height(s, stance, hanging_rad, 0);
    double low = hanging_rad - range_rad, high = hanging_rad;
    if (above_m > -2 * depth_m) {
        bt_diag_add(s->diag, BT_ERROR, BT_NOWHERE,
                    "aircraft.hook.length: %g m: the hook hangs %.3g mm above the deck where the "
                    "aircraft stands for landing.start: rolling; at least %.4g m would do",
                    s->params->aircraft.hook.length_m, 1e3 * above_m,
                    s->params->aircraft.hook.length_m +
                        (above_m + 0.01) / fmax(0.1, sin(hanging_rad + stance->pitch_rad)));
        return BT_ERR_INPUT;
    }
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        *(hook_height(s, stance, middle, 0) > -depth_m ? &low : &high) = middle;
    }
    s->hook_rad = 0.5 * (low + high);
    s->depth_m = depth_m;
    return BT_OK;
}

/* ---- Newton's method on the accelerations ---- */

enum { UNKNOWNS = 6 };

/// The depth of the shoe in the deck stands for the hook's angle: its contact is by far the
/// stiffest part, and so no other unknown disturbs it.
static void read_unknowns(const search* s, const bt_stance* stance, double x[UNKNOWNS]) {
    const double now[UNKNOWNS] = {stance->height_m,
                                  stance->pitch_rad,
                                  stance->stroke_m[BT_LEG_NOSE],
                                  stance->stroke_m[BT_LEG_LEFT],
                                  s->depth_m,
                                  0};
    memcpy(x, now, sizeof now);
}

static void write_unknowns(search* s, const double x[UNKNOWNS], bt_stance* stance) {
    stance->height_m = x[0];
    stance->pitch_rad = x[1];
    stance->stroke_m[BT_LEG_NOSE] = x[2];
    stance->stroke_m[BT_LEG_LEFT] = stance->stroke_m[BT_LEG_RIGHT] = x[3];
    lower_hook(s, stance, x[4], x[5]);
}

/// Of the piston upward, or of the arm's turning, a metre from its pivot.
static double leg_residual(const bt_airframe* f, int leg, const double* a) {
    return a[6 * (BT_BODY_NOSE_PISTON + leg) + (f->leg[leg].levered ? 4 : 2)];
}

/// Accelerations of fuselage, pistons and hook that equilibrium has none of, as m/s2. False when
/// they cannot be computed.
static bool residual(search* s, const double x[UNKNOWNS], double r[UNKNOWNS]) {
    bt_stance stance = {0};
    write_unknowns(s, x, &stance);
    if (bt_system_evaluate(s->f->system, &s->state, NULL) != BT_OK)
        return false;
    const double* a = s->state.a;
    r[0] = a[6 * BT_BODY_FUSELAGE + 2];
    r[1] = a[6 * BT_BODY_FUSELAGE + 4];
    r[2] = leg_residual(s->f, BT_LEG_NOSE, a);
    r[3] = leg_residual(s->f, BT_LEG_LEFT, a);
    r[4] = a[6 * (s->f->shank.bends ? BT_BODY_COUNT : BT_BODY_HOOK) + 4];
    r[5] = s->f->shank.bends ? a[6 * BT_BODY_HOOK + 4] : 0;
    for (int k = 0; k < UNKNOWNS; ++k)
        if (!isfinite(r[k]))
            return false;
    return true;
}

static double largest(const double r[UNKNOWNS]) {
    double most = 0;
    for (int k = 0; k < UNKNOWNS; ++k)
        most = fmax(most, fabs(r[k]));
    return most;
}

/// Solves J d = r in place by elimination with row exchanges.
static bool eliminate(int n, double j[UNKNOWNS][UNKNOWNS], double r[UNKNOWNS]) {
    for (int k = 0; k < n; ++k) {
        int best = k;
        for (int i = k + 1; i < n; ++i)
            if (fabs(j[i][k]) > fabs(j[best][k]))
                best = i;
        if (!(fabs(j[best][k]) > DBL_MIN))
            return false;
        for (int c = 0; c < n; ++c) {
            const double swap = j[k][c];
            j[k][c] = j[best][c];
            j[best][c] = swap;
        }
        const double swap = r[k];
        r[k] = r[best];
        r[best] = swap;
        for (int i = 0; i < n; ++i) {
            const double factor = i == k ? 0 : j[i][k] / j[k][k];
            for (int c = k; c < n; ++c)
                j[i][c] -= factor * j[k][c];
            r[i] -= factor * r[k];
        }
    }
    for (int k = 0; k < n; ++k)
        r[k] /= j[k][k];
    return true;
}

static bool slopes(search* s, int n, const double x[UNKNOWNS], double j[UNKNOWNS][UNKNOWNS]) {
    static const double h = 1e-7;
    double ahead[UNKNOWNS], behind[UNKNOWNS], moved[UNKNOWNS];
    for (int c = 0; c < n; ++c) {
        memcpy(moved, x, sizeof moved);
        moved[c] = x[c] + h;
        if (!residual(s, moved, ahead))
            return false;
        moved[c] = x[c] - h;
        if (!residual(s, moved, behind))
            return false;
        for (int i = 0; i < n; ++i)
            j[i][c] = (ahead[i] - behind[i]) / (2 * h);
    }
    return true;
}

/// Newton steps, halved until they help. Contacts are stiff but smooth where the guess has put the
/// parts.
static double settle(search* s, double x[UNKNOWNS]) {
    static const double enough_mps2 = 1e-8;
    const int n = s->f->shank.bends ? UNKNOWNS : UNKNOWNS - 1;
    double r[UNKNOWNS], j[UNKNOWNS][UNKNOWNS], tried[UNKNOWNS], next[UNKNOWNS];
    double left = residual(s, x, r) ? largest(r) : INFINITY;
    for (int turn = 0; turn < 60 && left > enough_mps2 && isfinite(left); ++turn) {
        double step[UNKNOWNS], after = INFINITY;
        memcpy(step, r, sizeof step);
        if (!slopes(s, n, x, j) || !eliminate(n, j, step))
            break;
        for (double share = 1; share > 1e-6 && !(after < left); share *= 0.5) {
            for (int k = 0; k < UNKNOWNS; ++k)
                tried[k] = x[k] - (k < n ? share * step[k] : 0);
            after = residual(s, tried, next) ? largest(next) : INFINITY;
        }
        if (!(after < left))
            break;
        left = after;
        memcpy(x, tried, sizeof tried);
        memcpy(r, next, sizeof next);
    }
    residual(s, x, r); // the state's outputs are those of x
    return left;
}

/* ---- what became of it ---- */

static double output(const search* s, int element, int index) {
    return bt_system_element_output(s->f->system, &s->state, element)[index];
}

static bt_status judge(search* s, bt_stance* stance) {
    const bt_airframe* f = s->f;
    static const double settled_mps2 = 1e-4;
    const char* what = "";
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        stance->load_N[leg] = output(s, f->wheel[leg], BT_WHEEL_NORMAL);
        if (!(stance->load_N[leg] > 0))
            return refuse_lift(s, 0.9 * s->params->aircraft.lift_ratio);
        if (bt_system_element_law(f->system, &s->state, f->strut[leg], &what) != BT_LAW_HOLDS) {
            const double force_N = output(s, f->strut[leg], BT_STRUT_FORCE);
            return refuse_strut(s, leg, force_N, force_N);
        }
    }
    const double tail_m = bt_airframe_tail_height(f, &s->state);
    if (!(tail_m > 0)) {
        bt_diag_add(
            s->diag, BT_ERROR, BT_NOWHERE,
            "aircraft.tail.z: %g m: the tail lies on the deck where the aircraft stands for "
            "landing.start: rolling; above %.3g m would do",
            s->params->aircraft.tail.z_m, s->params->aircraft.tail.z_m - tail_m);
        return BT_ERR_INPUT;
    }
    stance->hook_N = output(s, f->shoe, BT_SHOE_FORCE);
    if (bt_system_element_law(f->system, &s->state, f->damper, &what) != BT_LAW_HOLDS) {
        bt_diag_add(s->diag, BT_ERROR, BT_NOWHERE,
                    "aircraft.hook.pivot_z: %g m: %s where the aircraft stands for landing.start: "
                    "rolling; a pivot %.2g m higher would do",
                    s->params->aircraft.hook.pivot_z_m, what,
                    0.2 * s->params->aircraft.hook.length_m);
        return BT_ERR_INPUT;
    }
    if (stance->left_mps2 <= settled_mps2)
        return BT_OK;
    bt_diag_add(s->diag, BT_ERROR, BT_NOWHERE,
                "landing.start: rolling: no static equilibrium was found, %.2g m/s^2 are left; "
                "glide would do",
                stance->left_mps2);
    return BT_ERR_INPUT;
}

static bt_status find(search* s, double effective_mps2, bt_stance* stance) {
    double x[UNKNOWNS];
    BT_TRY(guess_legs(s, effective_mps2, stance));
    BT_TRY(guess_hook(s, stance));
    read_unknowns(s, stance, x);
    stance->left_mps2 = settle(s, x);
    write_unknowns(s, x, stance);
    bt_stance_place(s->f, &s->params->landing, s->hanging, stance, &s->state, &stance->at);
    return judge(s, stance);
}

bt_status bt_stance_find(const bt_airframe* f, const bt_model_params* params,
                         const bt_state* hanging, const bt_frame* frame, bt_stance* stance,
                         bt_diag* diag) {
    bt_arena arena = {0};
    search s = {.f = f, .params = params, .hanging = hanging, .diag = diag};
    *stance = (bt_stance){0};
    BT_TRY(bt_arena_create(&arena, bt_state_size(f->system)));
    bt_status status = bt_state_create(f->system, &arena, &s.state);
    if (status == BT_OK) {
        s.state.frame = *frame;
        s.state.time_s = 0;
        status = find(&s, -frame->gravity_mps2[2], stance);
    }
    bt_arena_destroy(&arena);
    return status;
}
