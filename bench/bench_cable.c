/// The cable's kernel per segment and step, beside MuJoCo on the same chain (free bodies, the same
/// bushings and deck contact written by hand, as its users would); step, wave error, equilibrium.
#include "bench.h"

#include "cable/cable.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef BT_HAVE_MUJOCO
#include <mujoco/mujoco.h>
#endif

enum { SEGMENTS = 200, REPEATS = 20, STEPS = 500 };
enum { KERNEL_TARGET_NS = 18, EQUILIBRIUM_TARGET_MS = 5 };

static const double LENGTH_M = 0.05;

typedef struct rope {
    bt_arena arena;
    bt_cable_model model;
    bt_cable_state state;
} rope;

static void rope_open(rope* r, bt_cable_def* def) {
    if (bt_arena_create(&r->arena, bt_cable_memory(def->count, 1)) != BT_OK ||
        bt_cable_model_init(&r->model, def, &r->arena, NULL) != BT_OK ||
        bt_cable_state_init(&r->model, &r->state, &r->arena) != BT_OK)
        abort();
}

/// The chain that both engines step: 200 pieces of the arresting cable with free ends, starting on
/// the deck with a pluck, so that joints, dampers, contact and friction all work.
static void chain_open(rope* r, bt_kernel_level level) {
    static double unused[BT_CABLE_SEGMENTS_MAX], length[SEGMENTS];
    bt_cable_params params;
    bt_cable_def def;
    bt_group_set_defaults(&bt_cable_group, &params);
    bt_cable_def_init(&def, &params, 9.80665, unused);
    for (int i = 0; i < SEGMENTS; ++i)
        length[i] = LENGTH_M;
    def.count = SEGMENTS;
    def.length_m = length;
    def.level = level;
    def.support_y_m.count = 0;
    for (int k = 0; k < 2; ++k)
        def.end[k] = (bt_cable_end){.anchor_m = {0, k * SEGMENTS * LENGTH_M, 0.0182}};
    rope_open(r, &def);
    for (int i = 0; i < SEGMENTS; ++i) {
        r->state.vz[i] = 2 * sin(0.05 * i);
        r->state.vx[i] = cos(0.03 * i);
    }
}

static const double CHAIN_STEP_S = 1e-5;

static double time_chain(rope* r) {
    double best = INFINITY;
    for (int k = 0; k < REPEATS; ++k) {
        const double start = bench_now_s();
        for (int j = 0; j < STEPS; ++j)
            bt_cable_step(&r->model, &r->state, CHAIN_STEP_S);
        best = fmin(best, bench_now_s() - start);
    }
    bench_keep(r->state.block);
    return 1e9 * best / STEPS / SEGMENTS;
}

#ifdef BT_HAVE_MUJOCO
/// What the callback needs: MuJoCo's callbacks carry no user data.
static const bt_cable_model* peer_model;

typedef struct piece {
    double x[3], e[4], v[3], w[3], t[3];
} piece;

static void cross(const double a[3], const double b[3], double c[3]) {
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// One joint, Eqs. 11-17: force and torques of the bushing between two pieces.
static void peer_joint(const bt_cable_def* def, double half, const piece* a, const piece* b,
                       double force[3], double on_a[3], double on_b[3]) {
    const double ks = def->shear_ratio * def->axial_stiffness_N;
    const double cs = def->shear_ratio * def->axial_damping_Ns;
    double d[3], r[3], q[3], wa[3], wb[3], s[3], c[3], moment[3];
    for (int k = 0; k < 3; ++k) {
        d[k] = b->x[k] - half * b->t[k] - a->x[k] - half * a->t[k];
        r[k] = half * a->t[k] + 0.5 * d[k];
        q[k] = half * b->t[k] + 0.5 * d[k];
        s[k] = a->t[k] + b->t[k];
    }
    cross(a->w, r, wa);
    cross(b->w, q, wb);
    const double ss = dot(s, s), ds = dot(d, s) / ss;
    double u[3];
    for (int k = 0; k < 3; ++k)
        u[k] = b->v[k] - a->v[k] - wa[k] - wb[k];
    const double us = dot(u, s) / ss, side = ds > 0 ? 1 : def->compression_ratio;
    const double along =
        side * (def->axial_stiffness_N * ds + def->axial_damping_Ns * us) - (ks * ds + cs * us);
    const double* e = a->e;
    const double* f = b->e;
    c[0] = e[0] * f[1] - f[0] * e[1] + e[2] * f[3] - e[3] * f[2];
    c[1] = e[0] * f[2] - f[0] * e[2] + e[3] * f[1] - e[1] * f[3];
    c[2] = e[0] * f[3] - f[0] * e[3] + e[1] * f[2] - e[2] * f[1];
    const double w[3] = {b->w[0] - a->w[0], b->w[1] - a->w[1], b->w[2] - a->w[2]};
    const double turn = ((def->twist_stiffness_Nm2 - def->bending_stiffness_Nm2) * 2 * dot(c, s) +
                         (def->twist_damping_Nm2s - def->bending_damping_Nm2s) * dot(w, s)) /
                        ss;
    for (int k = 0; k < 3; ++k) {
        force[k] = (along * s[k] + ks * d[k] + cs * u[k]) / (2 * half);
        moment[k] = (turn * s[k] + 2 * def->bending_stiffness_Nm2 * c[k] +
                     def->bending_damping_Nm2s * w[k]) /
                    (2 * half);
    }
    cross(r, force, on_a);
    cross(q, force, on_b);
    for (int k = 0; k < 3; ++k) {
        on_a[k] += moment[k];
        on_b[k] -= moment[k];
    }
}

/// Deck under the middle of a piece: spring, damper and friction.
static void peer_deck(const bt_cable_model* model, const piece* p, double force[3],
                      double torque[3]) {
    const bt_cable_deck_params* deck = &model->def.deck_contact;
    const double radius = model->radius_m, depth = radius - p->x[2];
    const double normal =
        LENGTH_M * (deck->stiffness_Npm2 * depth - model->contact_damping_Npm2ps * p->v[2]);
    if (!(depth > 0 && normal > 0))
        return;
    const double sx = p->v[0] - p->w[1] * radius, sy = p->v[1] + p->w[0] * radius;
    const double drag = deck->friction * normal /
                        sqrt(sx * sx + sy * sy + deck->slip_speed_mps * deck->slip_speed_mps);
    force[0] -= drag * sx;
    force[1] -= drag * sy;
    force[2] += normal;
    torque[0] -= radius * drag * sy;
    torque[1] += radius * drag * sx;
}

static void peer_forces(const mjModel* m, mjData* d) {
    const bt_cable_model* model = peer_model;
    static piece pieces[SEGMENTS];
    static double total[SEGMENTS][6];
    memset(total, 0, sizeof total);
    for (int i = 0; i < SEGMENTS; ++i) {
        piece* p = &pieces[i];
        const double* matrix = d->xmat + 9 * (i + 1);
        memcpy(p->x, d->qpos + 7 * i, 3 * sizeof(double));
        memcpy(p->e, d->qpos + 7 * i + 3, 4 * sizeof(double));
        memcpy(p->v, d->qvel + 6 * i, 3 * sizeof(double));
        mju_rotVecMat(p->w, d->qvel + 6 * i + 3, matrix);
        for (int k = 0; k < 3; ++k)
            p->t[k] = matrix[3 * k + 1];
        peer_deck(model, p, total[i], total[i] + 3);
    }
    for (int j = 1; j < SEGMENTS; ++j) {
        double force[3], on_a[3], on_b[3];
        peer_joint(&model->def, 0.5 * LENGTH_M, &pieces[j - 1], &pieces[j], force, on_a, on_b);
        for (int k = 0; k < 3; ++k) {
            total[j - 1][k] += force[k];
            total[j][k] -= force[k];
            total[j - 1][3 + k] += on_a[k];
            total[j][3 + k] += on_b[k];
        }
    }
    for (int i = 0; i < SEGMENTS; ++i) { /* free joints: force in the world, torque in the body */
        memcpy(d->qfrc_passive + 6 * i, total[i], 3 * sizeof(double));
        mju_rotVecMatT(d->qfrc_passive + 6 * i + 3, total[i] + 3, d->xmat + 9 * (i + 1));
    }
    (void)m;
}

static mjModel* peer_build(const rope* r) {
    enum { SIZE = SEGMENTS * 256 + 1024 };
    char* text = malloc(SIZE);
    mjVFS* files = malloc(sizeof *files);
    if (!text || !files)
        abort();
    int used = snprintf(text, SIZE,
                        "<mujoco><option timestep=\"%.17g\" gravity=\"0 0 -9.80665\">"
                        "<flag contact=\"disable\"/></option><worldbody>",
                        CHAIN_STEP_S);
    for (int i = 0; i < SEGMENTS; ++i)
        used += snprintf(text + used, (size_t)(SIZE - used),
                         "<body pos=\"0 %.17g 0.0182\"><freejoint/><inertial pos=\"0 0 0\" "
                         "mass=\"%.17g\" diaginertia=\"%.17g %.17g %.17g\"/></body>",
                         r->state.y[i], r->model.mass_kg[i], 1 / r->model.inverse_tilt[i],
                         1 / (r->model.inverse_spin[i] + r->model.inverse_tilt[i]),
                         1 / r->model.inverse_tilt[i]);
    used += snprintf(text + used, (size_t)(SIZE - used), "</worldbody></mujoco>");
    mj_defaultVFS(files);
    char why[500] = "";
    if (mj_makeEmptyFileVFS(files, "chain.xml", used) != 0)
        abort();
    memcpy(files->filedata[0], text, (size_t)used);
    mjModel* m = mj_loadXML("chain.xml", files, why, sizeof why);
    if (!m)
        fprintf(stderr, "MuJoCo refuses the chain: %s\n", why);
    mj_deleteVFS(files);
    free(files);
    free(text);
    return m;
}

/// Nanoseconds per segment and step; NAN when the two engines' chains do not move alike.
static double time_mujoco(void) {
    rope own;
    chain_open(&own, BT_KERNEL_BEST);
    mjModel* m = peer_build(&own);
    if (!m)
        return NAN;
    mjData* d = mj_makeData(m);
    peer_model = &own.model;
    mjcb_passive = peer_forces;
    for (int i = 0; i < SEGMENTS; ++i) {
        d->qvel[6 * i] = own.state.vx[i];
        d->qvel[6 * i + 2] = own.state.vz[i];
    }
    double best = INFINITY, apart = 0;
    for (int k = 0; k < 5; ++k) {
        const double start = bench_now_s();
        for (int j = 0; j < 100; ++j)
            mj_step(m, d);
        best = fmin(best, bench_now_s() - start);
    }
    for (int j = 0; j < 500; ++j)
        bt_cable_step(&own.model, &own.state, CHAIN_STEP_S);
    for (int i = 0; i < SEGMENTS; ++i)
        apart = fmax(apart,
                     hypot(d->qpos[7 * i] - own.state.x[i], d->qpos[7 * i + 2] - own.state.z[i]));
    printf("  (MuJoCo's chain and ours are %.2g m apart after 5 ms and up to 10 mm of motion)\n",
           apart);
    mjcb_passive = NULL;
    mj_deleteData(d);
    mj_deleteModel(m);
    bt_arena_destroy(&own.arena);
    return apart < 2e-4 ? 1e9 * best / 100 / SEGMENTS : NAN;
}
#endif

/// Position of an axial front after 10 ms, from the height of its middle.
static double front_after(double step_s, double* stable_s, double* courant_s) {
    enum { COUNT = 800 };
    static double length[COUNT];
    bt_cable_params params;
    static double unused[BT_CABLE_SEGMENTS_MAX];
    bt_cable_def def;
    bt_group_set_defaults(&bt_cable_group, &params);
    bt_cable_def_init(&def, &params, 0, unused);
    for (int i = 0; i < COUNT; ++i)
        length[i] = LENGTH_M;
    def.count = COUNT;
    def.length_m = length;
    def.deck = false;
    def.support_y_m.count = 0;
    for (int k = 0; k < 2; ++k)
        def.end[k] =
            (bt_cable_end){.kind = BT_CABLE_PINNED, .anchor_m = {0, k * COUNT * LENGTH_M, 0}};
    rope r;
    rope_open(&r, &def);
    *stable_s = r.model.stable_step_s;
    *courant_s = LENGTH_M / sqrt(def.axial_stiffness_N / def.mass_kgpm);
    const int steps = (int)lround(0.010 / (step_s > 0 ? step_s : 0.9 * *stable_s));
    r.state.scalars->anchor_velocity_mps[0][1] = -1;
    for (int j = 0; j < steps; ++j) {
        bt_cable_step(&r.model, &r.state, 0.010 / steps);
        r.state.scalars->anchor_m[0][1] -= 0.010 / steps;
    }
    const double level = 0.5 * sqrt(def.axial_stiffness_N * def.mass_kgpm);
    double at = NAN;
    for (int j = COUNT - 1; j > 1; --j) {
        const double inner = bt_cable_tension(&r.model, &r.state, j - 1);
        const double outer = bt_cable_tension(&r.model, &r.state, j);
        if (inner > level && outer <= level) {
            at = LENGTH_M * (j - (level - outer) / (inner - outer));
            break;
        }
    }
    bt_arena_destroy(&r.arena);
    return at;
}

static double time_equilibrium(void) {
    static double length[BT_CABLE_SEGMENTS_MAX];
    bt_cable_params params;
    bt_cable_def def;
    bt_group_set_defaults(&bt_cable_group, &params);
    bt_cable_def_init(&def, &params, 9.80665, length);
    rope r;
    rope_open(&r, &def);
    double best = INFINITY;
    for (int k = 0; k < REPEATS; ++k) {
        bt_cable_place(&r.model, &r.state);
        const double start = bench_now_s();
        if (bt_cable_equilibrium(&r.model, &r.state, NULL, NULL) != BT_OK)
            abort();
        best = fmin(best, bench_now_s() - start);
    }
    bt_arena_destroy(&r.arena);
    return best;
}

void bench_cable(void) {
    double peer = NAN;
    const char* peer_name = NULL;
#ifdef BT_HAVE_MUJOCO
    peer = time_mujoco();
    peer_name = isnan(peer) ? NULL : "MuJoCo";
#endif
    const char* last = "";
    for (int level = BT_KERNEL_V1; level <= BT_KERNEL_V4; ++level) {
        rope r;
        chain_open(&r, (bt_kernel_level)level);
        if (strcmp(last, r.model.kernel.name) != 0) { /* a level that this machine has */
            char name[80];
            snprintf(name, sizeof name, "cable, per segment and step, kernel %s, deck contact",
                     r.model.kernel.name);
            bench_row(name, time_chain(&r), "ns", peer_name, peer,
                      level == BT_KERNEL_V1 ? 0 : KERNEL_TARGET_NS);
        }
        last = r.model.kernel.name;
        bt_arena_destroy(&r.arena);
    }
    double stable, courant;
    const double fine = front_after(1e-6, &stable, &courant);
    const double usual = front_after(0, &stable, &courant);
    bench_row("cable, Courant step over stable step, 0.05 m", courant / stable, "", NULL, 0,
              1 / 0.9);
    bench_row("cable, axial wave, error against a 1 us step", 100 * fabs(usual / fine - 1), "%",
              NULL, 0, 0.1);
    bench_row("cable, static equilibrium", 1e3 * time_equilibrium(), "ms", NULL, 0,
              EQUILIBRIUM_TARGET_MS);
}
