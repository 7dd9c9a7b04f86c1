#include "near.h"

#include "base/rng.h"
#include "surrogate/predictor.h"

#include <stdlib.h>

/// A machine made up from keyed random numbers: nothing is trained, every shape can be had.
static bt_surrogate random_machine(int dims, int vectors, double gamma, double largest,
                                   uint64_t seed) {
    bt_surrogate s = {.dims = dims, .gamma = gamma, .sv_count = vectors, .rho = 0.3};
    s.sv = malloc(((size_t)vectors * (size_t)dims + 1) * sizeof *s.sv);
    s.coef = malloc(((size_t)vectors + 1) * sizeof *s.coef);
    for (int i = 0; i < vectors; ++i) {
        const double u = bt_rng_uniform(seed, (uint64_t)i, 100);
        s.coef[i] = (i < vectors / 2 ? 1 : -1) * largest * u;
        for (int k = 0; k < dims; ++k)
            s.sv[i * dims + k] = 4 * bt_rng_uniform(seed, (uint64_t)i, (uint32_t)k) - 2;
    }
    for (int k = 0; k < dims; ++k) {
        s.centre[k] = 3 + k;
        s.scale[k] = 0.5 + k;
    }
    return s;
}

static double* random_points(const bt_surrogate* s, int n, double reach, uint64_t seed) {
    double* x = malloc((size_t)n * (size_t)s->dims * sizeof *x);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < s->dims; ++k)
            x[i * s->dims + k] =
                s->centre[k] +
                s->scale[k] * reach * (2 * bt_rng_uniform(seed, (uint64_t)i, (uint32_t)k) - 1);
    return x;
}

static void check_labels(const bt_surrogate* s, const double* x, int n) {
    int8_t* label = malloc((size_t)n);
    for (int level = 0; level <= (int)bt_isa_best(); ++level) {
        bt_predictor* p;
        assert_int_equal(bt_predictor_create(s, (bt_isa_level)level, &p), BT_OK);
        bt_predictor_label(p, x, n, label, NULL);
        for (int i = 0; i < n; ++i)
            assert_int_equal(label[i], bt_surrogate_decision(s, x + i * s->dims) > 0 ? 1 : -1);
        bt_predictor_destroy(p);
    }
    free(label);
}

static void labels_equal_the_double_definition_for_every_dimension(void** state) {
    (void)state;
    for (int dims = 1; dims <= BT_INPUT_MAX; dims += dims < 8 ? 1 : 6) {
        bt_surrogate s = random_machine(dims, 37 + dims, 1.0 / dims, 10, 1);
        double* x = random_points(&s, 1003, 2.5, 2);
        check_labels(&s, x, 1003);
        free(x);
        bt_surrogate_destroy(&s);
    }
}

static void labels_equal_the_double_definition_for_every_stiffness(void** state) {
    (void)state;
    for (double largest = 1e-3; largest < 1e9; largest *= 1000)
        for (double gamma = 1e-3; gamma < 1e3; gamma *= 30) {
            bt_surrogate s = random_machine(4, 200, gamma, largest, 3);
            double* x = random_points(&s, 1000, 3, 4);
            check_labels(&s, x, 1000);
            free(x);
            bt_surrogate_destroy(&s);
        }
}

static void points_on_the_boundary_are_decided_by_the_definition(void** state) {
    (void)state;
    bt_surrogate s = random_machine(2, 60, 0.7, 1e4, 5);
    int count = 0;
    double x[2 * 4000];
    // Bisection between points of different label ends within one last place of the boundary.
    for (int i = 0; i < 2000; ++i) {
        double* ends = random_points(&s, 2, 2, (uint64_t)(10 + i));
        double *a = ends, *b = ends + 2;
        if ((bt_surrogate_decision(&s, a) > 0) != (bt_surrogate_decision(&s, b) > 0)) {
            for (int step = 0; step < 60; ++step) {
                const double middle[2] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
                const int same =
                    (bt_surrogate_decision(&s, middle) > 0) == (bt_surrogate_decision(&s, a) > 0);
                memcpy(same ? a : b, middle, sizeof middle);
            }
            memcpy(x + 2 * count, ends, 4 * sizeof *x);
            count += 2;
        }
        free(ends);
    }
    assert_true(count > 400);
    check_labels(&s, x, count);
    bt_predictor* p;
    int64_t ways[3];
    assert_int_equal(bt_predictor_create(&s, bt_isa_best(), &p), BT_OK);
    bt_predictor_count(p, x, count, ways);
    assert_true(ways[0] == 0 && ways[2] > count / 2); // float never, the definition mostly
    bt_predictor_destroy(p);
    bt_surrogate_destroy(&s);
}

static void decision_values_are_within_a_millionth_of_their_terms(void** state) {
    (void)state;
    bt_surrogate s = random_machine(4, 800, 0.5, 1, 6);
    enum { N = 2000 };
    double* x = random_points(&s, N, 2, 7);
    float decision[N];
    int8_t label[N];
    for (int level = 0; level <= (int)bt_isa_best(); ++level) {
        bt_predictor* p;
        assert_int_equal(bt_predictor_create(&s, (bt_isa_level)level, &p), BT_OK);
        bt_predictor_label(p, x, N, label, decision);
        for (int i = 0; i < N; ++i) // 800 terms of at most 1
            BT_ASSERT_NEAR(decision[i], bt_surrogate_decision(&s, x + 4 * i), 0, 800 * 1e-6);
        bt_predictor_destroy(p);
    }
    free(x);
    bt_surrogate_destroy(&s);
}

static void a_label_does_not_depend_on_its_neighbours(void** state) {
    (void)state;
    bt_surrogate s = random_machine(3, 90, 1, 50, 8);
    enum { N = 301 };
    double* x = random_points(&s, N, 2, 9);
    int8_t all[N], one;
    float decision[N], single;
    bt_predictor* p;
    assert_int_equal(bt_predictor_create(&s, bt_isa_best(), &p), BT_OK);
    bt_predictor_label(p, x, N, all, decision);
    for (int i = 0; i < N; ++i) {
        bt_predictor_label(p, x + 3 * i, 1, &one, &single);
        assert_int_equal(one, all[i]);
        assert_memory_equal(&single, &decision[i], sizeof single);
    }
    bt_predictor_destroy(p);
    free(x);
    bt_surrogate_destroy(&s);
}

static void a_constant_surrogate_always_answers_the_same(void** state) {
    (void)state;
    for (int answer = -1; answer <= 1; answer += 2) {
        bt_surrogate s = random_machine(2, 0, 1, 1, 1);
        s.rho = -answer;
        s.constant = true;
        double* x = random_points(&s, 100, 50, 1);
        int8_t label[100];
        bt_predictor* p;
        assert_int_equal(bt_predictor_create(&s, bt_isa_best(), &p), BT_OK);
        bt_predictor_label(p, x, 100, label, NULL);
        for (int i = 0; i < 100; ++i)
            assert_int_equal(label[i], answer);
        bt_predictor_destroy(p);
        free(x);
        bt_surrogate_destroy(&s);
    }
}

static void points_far_from_every_vector_get_the_sign_of_minus_rho(void** state) {
    (void)state;
    bt_surrogate s = random_machine(4, 50, 1, 1e6, 11);
    double x[3 * 4];
    for (int i = 0; i < 12; ++i)
        x[i] = i < 4 ? 1e3 : i < 8 ? -1e30 : 1e300; // beyond the range of float as well
    int8_t label[3];
    bt_predictor* p;
    assert_int_equal(bt_predictor_create(&s, bt_isa_best(), &p), BT_OK);
    bt_predictor_label(p, x, 3, label, NULL);
    for (int i = 0; i < 3; ++i)
        assert_int_equal(label[i], -1);
    bt_predictor_destroy(p);
    bt_surrogate_destroy(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(labels_equal_the_double_definition_for_every_dimension),
        cmocka_unit_test(labels_equal_the_double_definition_for_every_stiffness),
        cmocka_unit_test(points_on_the_boundary_are_decided_by_the_definition),
        cmocka_unit_test(decision_values_are_within_a_millionth_of_their_terms),
        cmocka_unit_test(a_label_does_not_depend_on_its_neighbours),
        cmocka_unit_test(a_constant_surrogate_always_answers_the_same),
        cmocka_unit_test(points_far_from_every_vector_get_the_sign_of_minus_rho),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
