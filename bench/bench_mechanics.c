/// The airframe's equations: eight bodies, seven joints, order 82. Factor and solve against
/// SuiteSparse KLU and LAPACK dsysv on the same matrix, and a whole step.
#include "bench.h"

#include "mechanics/dynamics.h"
#include "mechanics/vec.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef BT_HAVE_KLU
#include <suitesparse/klu.h>
#endif
#ifdef BT_HAVE_LAPACK
void dsysv_(const char* uplo, const int* n, const int* nrhs, double* a, const int* lda, int* ipiv,
            double* b, const int* ldb, double* work, const int* lwork, int* info);
#endif

enum { REPEATS = 200, INNER = 50 };
enum { KKT_TARGET_US = 3, STEP_TARGET_US = 7 };

/// A body of the airframe at a place in the fuselage's frame; the whole airframe is pitched, rolled
/// and yawed a little, so that no coefficient is zero by chance.
static int add_body(bt_system* s, const char* name, double mass, double jx, double jy, double jz,
                    double x, double y, double z, double spin) {
    bt_body_def body = {.name = name,
                        .mass_kg = mass,
                        .inertia_kgm2 = {jx, jy, jz},
                        .attitude = {0.99, 0.03, -0.07, 0.05},
                        .velocity_mps = {47.5, 0, -3.6},
                        .spin_radps = {0, spin, 0}};
    double rotation[9];
    bt_euler_normalise(body.attitude);
    bt_rotation_from_euler(body.attitude, rotation);
    bt_rotate(rotation, (double[3]){x, y, z}, body.position_m);
    return bt_system_add_body(s, &body);
}

static void add_leg(bt_system* s, int fuselage, double x, double y, double mass, double radius) {
    const int piston = add_body(s, "piston", mass * 0.6, 6, 6, 1, x, y, -1.4, 0);
    const int wheel =
        add_body(s, "wheel", mass * 0.4, mass * 0.1 * radius * radius, mass * 0.2 * radius * radius,
                 mass * 0.1 * radius * radius, x, y, -1.9, 47.5 / radius);
    bt_system_add_joint(s, &(bt_joint_def){.name = "strut",
                                           .kind = BT_JOINT_PRISMATIC,
                                           .body_a = fuselage,
                                           .body_b = piston,
                                           .point_a_m = {x, y, -0.5},
                                           .point_b_m = {0, 0, 0.4},
                                           .axis_a = {0, 0, 1},
                                           .axis_b = {0, 0, 1}});
    bt_system_add_joint(s, &(bt_joint_def){.name = "axle",
                                           .kind = BT_JOINT_REVOLUTE,
                                           .body_a = piston,
                                           .body_b = wheel,
                                           .point_a_m = {0, 0, -0.5},
                                           .axis_a = {0, 1, 0},
                                           .axis_b = {0, 1, 0}});
}

/// Fuselage, three legs of piston and wheel, hook on a universal joint.
static bt_system* build_airframe(void) {
    bt_system* s = NULL;
    if (bt_system_create(&s) != BT_OK)
        abort();
    const int fuselage = add_body(s, "fuselage", 22000, 9e4, 3.6e5, 4.44e5, 0, 0, 0, 0.02);
    add_leg(s, fuselage, 5.8, 0, 80, 0.28);
    add_leg(s, fuselage, -1.2, 2.45, 170, 0.38);
    add_leg(s, fuselage, -1.2, -2.45, 170, 0.38);
    const int hook = add_body(s, "hook", 107.9, 2, 47, 47, -6.4, 0, -0.8, 0.5);
    bt_system_add_joint(s, &(bt_joint_def){.name = "hook pivot",
                                           .kind = BT_JOINT_UNIVERSAL,
                                           .body_a = fuselage,
                                           .body_b = hook,
                                           .point_a_m = {-5.2, 0, -0.306},
                                           .point_b_m = {1.2, 0, 0.494},
                                           .axis_a = {0, 0, 1},
                                           .axis_b = {0, 1, 0}});
    bt_system_set_gravity(s, (double[3]){0, 0, -9.81});
    if (bt_system_assemble(s, NULL) != BT_OK)
        abort();
    return s;
}

/// The matrix of the present state, dense and column-major; returns its nonzeros.
static int dense_matrix(const bt_system* s, const bt_state* state, double* a) {
    const bt_work* work = bt_work_of(state);
    const int n = s->kkt.order, top = 6 * s->body_count;
    memset(a, 0, sizeof(double) * (size_t)(n * n));
    for (int b = 0; b < s->body_count; ++b)
        for (int i = 0; i < 6; ++i)
            for (int k = 0; k < 6; ++k)
                a[(6 * b + k) * n + 6 * b + i] = s->kkt.mass[36 * b + 6 * i + k];
    for (int j = 0; j < s->joint_count; ++j)
        for (int r = s->joints[j].row; r < s->joints[j].row + s->joints[j].row_count; ++r)
            for (int side = 0; side < 2; ++side) {
                const int body = side ? s->joints[j].body_b : s->joints[j].body_a;
                for (int k = 0; body >= 0 && k < 6; ++k) {
                    const double g = (side ? work->gb : work->ga)[6 * r + k];
                    a[(6 * body + k) * n + top + r] = a[(top + r) * n + 6 * body + k] = g;
                }
            }
    int nonzeros = 0;
    for (int i = 0; i < n * n; ++i)
        nonzeros += a[i] != 0;
    return nonzeros;
}

static double time_own(const bt_system* s, const bt_state* state, const double* rhs, double* x,
                       double* solve_s) {
    const bt_work* work = bt_work_of(state);
    double best = INFINITY;
    *solve_s = INFINITY;
    for (int r = 0; r < REPEATS; ++r) {
        double start = bench_now_s();
        for (int i = 0; i < INNER; ++i) {
            memcpy(x, rhs, sizeof(double) * (size_t)s->kkt.order);
            bench_keep(work->factor);
            if (bt_kkt_factor(&s->kkt, work->ga, work->gb, work->factor) >= 0)
                abort();
            bt_kkt_solve(&s->kkt, work->factor, x);
            bench_keep(x);
        }
        best = fmin(best, (bench_now_s() - start) / INNER);
        start = bench_now_s();
        for (int i = 0; i < INNER; ++i) {
            memcpy(x, rhs, sizeof(double) * (size_t)s->kkt.order);
            bt_kkt_solve(&s->kkt, work->factor, x);
            bench_keep(x);
        }
        *solve_s = fmin(*solve_s, (bench_now_s() - start) / INNER);
    }
    return best;
}

#ifdef BT_HAVE_KLU
/// Factor and solve with new pivots, and with the pivots of an earlier factorisation (*refactor_s):
/// what KLU does best for a matrix whose pattern stays.
static double time_klu(int n, int nonzeros, const double* dense, const double* rhs, double* x,
                       double* refactor_s) {
    int* first = malloc(sizeof(int) * (size_t)(n + 1));
    int* row = malloc(sizeof(int) * (size_t)nonzeros);
    double* value = malloc(sizeof(double) * (size_t)nonzeros);
    int count = 0;
    for (int c = 0; c < n; ++c) {
        first[c] = count;
        for (int r = 0; r < n; ++r)
            if (dense[c * n + r] != 0) {
                row[count] = r;
                value[count++] = dense[c * n + r];
            }
    }
    first[n] = count;
    klu_common common;
    klu_defaults(&common);
    klu_symbolic* symbolic = klu_analyze(n, first, row, &common);
    klu_numeric* numeric = klu_factor(first, row, value, symbolic, &common);
    double best = INFINITY;
    *refactor_s = INFINITY;
    for (int r = 0; r < REPEATS; ++r) {
        double start = bench_now_s();
        for (int i = 0; i < INNER; ++i) {
            memcpy(x, rhs, sizeof(double) * (size_t)n);
            klu_refactor(first, row, value, symbolic, numeric, &common);
            klu_solve(symbolic, numeric, n, 1, x, &common);
            bench_keep(x);
        }
        *refactor_s = fmin(*refactor_s, (bench_now_s() - start) / INNER);
        start = bench_now_s();
        for (int i = 0; i < INNER; ++i) {
            memcpy(x, rhs, sizeof(double) * (size_t)n);
            klu_free_numeric(&numeric, &common);
            numeric = klu_factor(first, row, value, symbolic, &common);
            klu_solve(symbolic, numeric, n, 1, x, &common);
            bench_keep(x);
        }
        best = fmin(best, (bench_now_s() - start) / INNER);
    }
    klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
    free(first);
    free(row);
    free(value);
    return best;
}
#endif

#ifdef BT_HAVE_LAPACK
static double time_lapack(int n, const double* dense, const double* rhs, double* x) {
    const int one = 1, size = 64 * n;
    double* a = malloc(sizeof(double) * (size_t)(n * n));
    double* work = malloc(sizeof(double) * (size_t)size);
    int* pivots = malloc(sizeof(int) * (size_t)n);
    double best = INFINITY;
    for (int r = 0; r < REPEATS / 10; ++r) {
        const double start = bench_now_s();
        for (int i = 0; i < INNER / 10; ++i) {
            int info = 0;
            memcpy(a, dense, sizeof(double) * (size_t)(n * n));
            memcpy(x, rhs, sizeof(double) * (size_t)n);
            dsysv_("L", &n, &one, a, &n, pivots, x, &n, work, &size, &info);
            bench_keep(x);
        }
        best = fmin(best, (bench_now_s() - start) / (INNER / 10));
    }
    free(a);
    free(work);
    free(pivots);
    return best;
}
#endif

static double time_step(const bt_system* s, bt_state* state) {
    double best = INFINITY;
    for (int r = 0; r < REPEATS; ++r) {
        const double start = bench_now_s();
        for (int i = 0; i < INNER; ++i)
            if (bt_system_step(s, state, 1e-4, BT_INTEGRATOR_SECOND_ORDER, NULL) != BT_OK)
                abort();
        best = fmin(best, (bench_now_s() - start) / INNER);
    }
    return best;
}

#if defined BT_HAVE_KLU || defined BT_HAVE_LAPACK
static double largest_difference(const double* a, const double* b, int n) {
    double worst = 0, size = 0;
    for (int i = 0; i < n; ++i) {
        worst = fmax(worst, fabs(a[i] - b[i]));
        size = fmax(size, fabs(b[i]));
    }
    return worst / size;
}

/// A row beside a peer that solves the same equations, which is checked.
static void peer_row(const char* name, double own_s, const char* peer, double peer_s,
                     const double* own, const double* x, int n) {
    bench_row(name, 1e6 * own_s, "us", peer, 1e6 * peer_s, KKT_TARGET_US);
    printf("    largest difference from its solution: %.1e, relative\n",
           largest_difference(own, x, n));
}
#endif

void bench_mechanics(void) {
    bt_system* s = build_airframe();
    bt_arena arena;
    bt_state state;
    if (bt_arena_create(&arena, bt_state_size(s)) != BT_OK ||
        bt_state_create(s, &arena, &state) != BT_OK ||
        bt_system_step(s, &state, 1e-4, BT_INTEGRATOR_SECOND_ORDER, NULL) != BT_OK)
        abort();
    const int n = s->kkt.order;
    double* dense = malloc(sizeof(double) * (size_t)(n * n));
    double* vectors = malloc(sizeof(double) * (size_t)(3 * n));
    double *rhs = vectors, *own = vectors + n, *peer = vectors + 2 * n;
    const int nonzeros = dense_matrix(s, &state, dense);
    for (int i = 0; i < n; ++i)
        rhs[i] = sin(1.0 + i);
    (void)peer; // without peers at hand
    double solve_s;
    const double own_s = time_own(s, &state, rhs, own, &solve_s);
    char name[80];
    snprintf(name, sizeof name, "airframe KKT, factor + solve (order %d, %d nonzeros)", n,
             nonzeros);
#if !defined BT_HAVE_KLU && !defined BT_HAVE_LAPACK
    bench_row(name, 1e6 * own_s, "us", NULL, 0, KKT_TARGET_US);
#endif
#ifdef BT_HAVE_KLU
    double refactor_s;
    const double klu_s = time_klu(n, nonzeros, dense, rhs, peer, &refactor_s);
    peer_row(name, own_s, "KLU factor", klu_s, own, peer, n);
    peer_row(name, own_s, "KLU refactor", refactor_s, own, peer, n);
#endif
#ifdef BT_HAVE_LAPACK
    peer_row(name, own_s, "LAPACK dsysv", time_lapack(n, dense, rhs, peer), own, peer, n);
#endif
    bench_row("airframe KKT, one more solve", 1e6 * solve_s, "us", NULL, 0, 0);
    bench_row("airframe, whole second-order step without elements", 1e6 * time_step(s, &state),
              "us", NULL, 0, STEP_TARGET_US);
    free(dense);
    free(vectors);
    bt_arena_destroy(&arena);
    bt_system_destroy(s);
}
