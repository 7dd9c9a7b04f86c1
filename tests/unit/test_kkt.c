/// The block factorisation against dense elimination with pivoting, and what its order promises.
#include "near.h"

#include "mechanics/kkt.h"

#include <stdlib.h>

enum { BODIES_MAX = 12, ROWS_MAX = 80, ORDER_MAX = 6 * BODIES_MAX + ROWS_MAX };

/// Reproducible numbers in -1 .. 1.
static double next(unsigned* seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / (double)(1u << 23) - 1;
}

typedef struct trial {
    bt_kkt kkt;
    double ga[6 * ROWS_MAX], gb[6 * ROWS_MAX];
    double* factor;
} trial;

static void fill(trial* t, int bodies, const bt_kkt_joint* joints, int count, unsigned seed) {
    assert_int_equal(bt_kkt_create(&t->kkt, bodies, joints, count), BT_OK);
    for (int b = 0; b < bodies; ++b) {
        const double xy = 0.1 * next(&seed), xz = 0.1 * next(&seed), yz = 0.1 * next(&seed);
        const double inertia[9] = {1.5 + next(&seed), xy, xz, xy, 2, yz, xz, yz, 2.5};
        bt_kkt_set_mass(&t->kkt, b, 3 + 2 * next(&seed), inertia);
    }
    for (int i = 0; i < 6 * t->kkt.constraint_count; ++i) {
        t->ga[i] = next(&seed);
        t->gb[i] = next(&seed);
    }
    t->factor = malloc(sizeof(double) * (size_t)t->kkt.factor_size);
    assert_non_null(t->factor);
}

static void drop(trial* t) {
    free(t->factor);
    bt_kkt_destroy(&t->kkt);
}

static void dense(const trial* t, const bt_kkt_joint* joints, double* k) {
    const int n = t->kkt.order, top = 6 * t->kkt.body_count;
    memset(k, 0, sizeof(double) * (size_t)(n * n));
    for (int b = 0; b < t->kkt.body_count; ++b)
        for (int i = 0; i < 36; ++i)
            k[(6 * b + i / 6) * n + 6 * b + i % 6] = t->kkt.mass[36 * b + i];
    for (int j = 0; j < t->kkt.joint_count; ++j)
        for (int r = joints[j].row; r < joints[j].row + joints[j].row_count; ++r) {
            k[(top + r) * n + top + r] = -t->kkt.epsilon[r];
            for (int c = 0; c < 6; ++c) {
                const int a = 6 * joints[j].body_a + c, b = 6 * joints[j].body_b + c;
                if (joints[j].body_a >= 0)
                    k[(top + r) * n + a] = k[a * n + top + r] = t->ga[6 * r + c];
                if (joints[j].body_b >= 0)
                    k[(top + r) * n + b] = k[b * n + top + r] = t->gb[6 * r + c];
            }
        }
}

/// Solves by Gaussian elimination with row pivoting, in place.
static void eliminate(double* k, double* x, int n) {
    for (int c = 0; c < n; ++c) {
        int pivot = c;
        for (int r = c + 1; r < n; ++r)
            if (fabs(k[r * n + c]) > fabs(k[pivot * n + c]))
                pivot = r;
        for (int i = 0; i < n; ++i) {
            const double swap = k[c * n + i];
            k[c * n + i] = k[pivot * n + i];
            k[pivot * n + i] = swap;
        }
        const double swap = x[c];
        x[c] = x[pivot];
        x[pivot] = swap;
        for (int r = c + 1; r < n; ++r) {
            const double share = k[r * n + c] / k[c * n + c];
            for (int i = c; i < n; ++i)
                k[r * n + i] -= share * k[c * n + i];
            x[r] -= share * x[c];
        }
    }
    for (int r = n - 1; r >= 0; --r) {
        for (int i = r + 1; i < n; ++i)
            x[r] -= k[r * n + i] * x[i];
        x[r] /= k[r * n + r];
    }
}

static void assert_solves(const trial* t, const bt_kkt_joint* joints) {
    static double k[ORDER_MAX * ORDER_MAX];
    double want[ORDER_MAX], got[ORDER_MAX], size = 0;
    const int n = t->kkt.order;
    for (int i = 0; i < n; ++i)
        want[i] = got[i] = sin(i + 1.0);
    dense(t, joints, k);
    eliminate(k, want, n);
    assert_int_equal(bt_kkt_factor(&t->kkt, t->ga, t->gb, t->factor), -1);
    bt_kkt_solve(&t->kkt, t->factor, got);
    for (int i = 0; i < n; ++i)
        size = fmax(size, fabs(want[i]));
    for (int i = 0; i < n; ++i)
        BT_ASSERT_NEAR(got[i], want[i], 0, 1e-10 * size);
}

/// Every joint size, on a tree with a branch, hung on the ground or free.
static void tree_factors_without_fill(void** state) {
    (void)state;
    for (int rows = 1; rows <= 6; ++rows)
        for (int ground = 0; ground < 2; ++ground) {
            const bt_kkt_joint joints[6] = {
                {0, 1, 0, rows},         {2, 1, rows, 5},
                {2, 3, rows + 5, rows},  {1, 4, 2 * rows + 5, 3},
                {5, 4, 2 * rows + 8, 4}, {ground ? -1 : 5, ground ? 3 : 6, 2 * rows + 12, rows}};
            trial t;
            fill(&t, 7, joints, 6, 7u + (unsigned)rows);
            assert_int_equal(t.kkt.fill_blocks, 0);
            assert_int_equal(t.kkt.loop_joint_count, 0);
            assert_solves(&t, joints);
            drop(&t);
        }
}

static void every_body_is_eliminated_before_the_joint_that_hangs_it(void** state) {
    (void)state;
    const bt_kkt_joint joints[4] = {{-1, 0, 0, 5}, {0, 1, 5, 5}, {1, 2, 10, 5}, {0, 3, 15, 4}};
    trial t;
    fill(&t, 4, joints, 4, 1);
    int place[8];
    for (int i = 0; i < t.kkt.node_count; ++i)
        place[t.kkt.sequence[i]] = i;
    for (int b = 0; b < 4; ++b)
        assert_true(place[4 + t.kkt.parent_joint[b]] > place[b]);
    assert_int_equal(place[4], 7); // the joint to the ground is the last
    drop(&t);
}

/// One, two and nested loops; through bodies and through the ground.
static void loops_factor(void** state) {
    (void)state;
    const bt_kkt_joint closed[8] = {{-1, 0, 0, 2}, {0, 1, 2, 3},  {1, 2, 5, 3},   {2, 0, 8, 2},
                                    {2, 3, 10, 3}, {3, 4, 13, 2}, {4, -1, 15, 1}, {4, 1, 16, 1}};
    trial t;
    fill(&t, 5, closed, 8, 3);
    assert_int_equal(t.kkt.loop_joint_count, 3);
    assert_solves(&t, closed);
    drop(&t);
    const bt_kkt_joint two_roots[3] = {{-1, 0, 0, 4}, {1, -1, 4, 3}, {0, 1, 7, 2}};
    fill(&t, 2, two_roots, 3, 5);
    assert_int_equal(t.kkt.loop_joint_count, 1);
    assert_solves(&t, two_roots);
    drop(&t);
    const bt_kkt_joint twice[3] = {{-1, 0, 0, 3}, {-1, 0, 3, 2}, {0, 1, 5, 3}};
    fill(&t, 2, twice, 3, 9);
    assert_solves(&t, twice);
    drop(&t);
}

/// The same joint twice: the second is singular, and becomes solvable with E.
static void redundant_joint_needs_the_regularisation(void** state) {
    (void)state;
    const bt_kkt_joint joints[2] = {{-1, 0, 0, 3}, {-1, 0, 3, 3}};
    trial t;
    fill(&t, 1, joints, 2, 11);
    memcpy(t.gb + 18, t.gb, 18 * sizeof(double));
    for (int r = 0; r < 6; ++r)
        t.kkt.epsilon[r] = t.kkt.closes_loop[r / 3] ? 1e-6 : 0;
    assert_int_equal(bt_kkt_factor(&t.kkt, t.ga, t.gb, t.factor), -1);
    double x[12] = {1, 2, 3, 4, 5, 6};
    bt_kkt_solve(&t.kkt, t.factor, x);
    for (int r = 0; r < 3; ++r) { // G x = 0 holds up to E lambda
        double rate = 0;
        for (int c = 0; c < 6; ++c)
            rate += t.gb[6 * r + c] * x[c];
        BT_ASSERT_NEAR(rate, 0, 0, 1e-5);
    }
    drop(&t);
}

/// A joint whose rows are all zero does not hold its body: the factorisation says which node.
static void singular_joint_is_named(void** state) {
    (void)state;
    const bt_kkt_joint joints[2] = {{-1, 0, 0, 3}, {0, 1, 3, 2}};
    trial t;
    fill(&t, 2, joints, 2, 13);
    memset(t.ga + 18, 0, 12 * sizeof(double));
    memset(t.gb + 18, 0, 12 * sizeof(double));
    assert_int_equal(bt_kkt_factor(&t.kkt, t.ga, t.gb, t.factor), 2 + 1);
    drop(&t);
}

/// Elimination is linear in the number of bodies: size of the factor of a chain.
static void chain_costs_linear_memory(void** state) {
    (void)state;
    int size[2];
    for (int k = 0; k < 2; ++k) {
        const int n = 100 << k;
        bt_kkt_joint* joints = calloc((size_t)n, sizeof *joints);
        assert_non_null(joints);
        for (int j = 0; j < n; ++j)
            joints[j] = (bt_kkt_joint){j - 1, j, 5 * j, 5};
        bt_kkt kkt;
        assert_int_equal(bt_kkt_create(&kkt, n, joints, n), BT_OK);
        assert_int_equal(kkt.fill_blocks, 0);
        size[k] = kkt.factor_size;
        bt_kkt_destroy(&kkt);
        free(joints);
    }
    assert_int_equal(size[1] - size[0], 100 * (36 + 25 + 60));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tree_factors_without_fill),
        cmocka_unit_test(every_body_is_eliminated_before_the_joint_that_hangs_it),
        cmocka_unit_test(loops_factor),
        cmocka_unit_test(redundant_joint_needs_the_regularisation),
        cmocka_unit_test(singular_joint_is_named),
        cmocka_unit_test(chain_costs_linear_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
