/// Training, prediction and sampling, beside LIBSVM and GSL doing the same work.
#include "bench.h"

#include "base/threads.h"
#include "reliability/monte_carlo.h"
#include "reliability/sample_kernel.h"
#include "surrogate/predictor.h"

#include "base/rng.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <libsvm/svm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { DIMS = 4, REPEATS = 5 };

/// A synthetic limit state: two curved bands in the box [-1, 1]^4, with some label noise.
static int engaged(const double* x) {
    const double first = x[3] - 0.3 * sin(2 * x[0]) - 0.25 * x[1] * x[1] + 0.1 * x[2];
    const double second = x[3] + 0.9 + 0.3 * x[0] * x[2];
    return (first > 0 && first < 1.2) || second < 0 ? -1 : 1;
}

typedef struct landings {
    double* x;
    int* label;
    bt_training_set set;
} landings;

static landings make_landings(int n, double noise) {
    landings l = {malloc((size_t)n * DIMS * sizeof(double)), malloc((size_t)n * sizeof(int)), {0}};
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < DIMS; ++k)
            l.x[i * DIMS + k] = 2 * bt_rng_uniform(1, (uint64_t)i, (uint32_t)k) - 1;
        l.label[i] = engaged(l.x + i * DIMS);
        if (bt_rng_uniform(1, (uint64_t)i, 99) < noise)
            l.label[i] = -l.label[i];
    }
    l.set = (bt_training_set){DIMS, n, l.x, l.label};
    return l;
}

static void free_landings(landings* l) {
    free(l->x);
    free(l->label);
}

static void be_quiet(const char* text) {
    (void)text;
}

static struct svm_node* make_nodes(const double* z, int n) {
    struct svm_node* nodes = malloc((size_t)n * (DIMS + 1) * sizeof *nodes);
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < DIMS; ++k)
            nodes[i * (DIMS + 1) + k] = (struct svm_node){k + 1, z[i * DIMS + k]};
        nodes[i * (DIMS + 1) + DIMS].index = -1;
    }
    return nodes;
}

/// LIBSVM alone, on the standardised landings, at the surrogate's (C, gamma).
static double time_libsvm_training(const landings* l, const bt_surrogate* s) {
    const int n = l->set.count;
    double* z = calloc((size_t)n * DIMS, sizeof *z);
    for (int i = 0; i < n * DIMS; ++i)
        z[i] = (l->x[i] - s->centre[i % DIMS]) / s->scale[i % DIMS];
    struct svm_node* nodes = make_nodes(z, n);
    struct svm_problem problem = {.l = n,
                                  .y = malloc((size_t)n * sizeof(double)),
                                  .x = malloc((size_t)n * sizeof(struct svm_node*))};
    for (int i = 0; i < n; ++i) {
        problem.y[i] = l->label[i];
        problem.x[i] = nodes + i * (DIMS + 1);
    }
    const struct svm_parameter param = {.svm_type = C_SVC,
                                        .kernel_type = RBF,
                                        .gamma = s->gamma,
                                        .C = s->C,
                                        .cache_size = 200,
                                        .eps = 1e-3,
                                        .shrinking = 1};
    svm_set_print_string_function(be_quiet);
    const double begun = bench_now_s();
    struct svm_model* model = svm_train(&problem, &param);
    const double seconds = bench_now_s() - begun;
    svm_free_and_destroy_model(&model);
    free(problem.y);
    free(problem.x);
    free(nodes);
    free(z);
    return seconds;
}

static void bench_training(bool noisy) {
    landings l = make_landings(10000, noisy ? 0.01 : 0);
    const bt_surrogate_params grid = {.folds = 5, .holdout = 0.2};
    bt_surrogate s;
    if (bt_surrogate_train(&l.set, &grid, 1, 0, &s, NULL, NULL) != BT_OK)
        return;
    char name[96];
    snprintf(name, sizeof name, "fit 10,000 landings%s, whole selection, all cores",
             noisy ? ", 1 % noise" : "");
    bench_row(name, s.scores.seconds, "s", NULL, 0, 60);
    const bt_surrogate_params single = {
        .folds = 2, .holdout = 1e-9, .C = {1, {s.C}}, .gamma = {1, {s.gamma}}};
    const double begun = bench_now_s();
    bt_surrogate again;
    if (bt_surrogate_train(&l.set, &single, 1, 1, &again, NULL, NULL) == BT_OK) {
        snprintf(name, sizeof name, "fit 10,000 landings%s, C %g, gamma %g, with 2-fold check",
                 noisy ? ", 1 % noise" : "", s.C, s.gamma);
        const double seconds = bench_now_s() - begun;
        bench_row(name, seconds, "s", "LIBSVM, training", time_libsvm_training(&l, &s), 0);
        bt_surrogate_destroy(&again);
    }
    bt_surrogate_destroy(&s);
    free_landings(&l);
}

/// LIBSVM's prediction by the surrogate's own vectors, points per second.
static double time_libsvm_prediction(const bt_surrogate* s, const double* x, int n) {
    struct svm_node* vectors = make_nodes(s->sv, s->sv_count);
    struct svm_node** rows = malloc((size_t)s->sv_count * sizeof *rows);
    int label[2] = {1, -1}, count[2] = {0, 0};
    for (int i = 0; i < s->sv_count; ++i) {
        rows[i] = vectors + i * (DIMS + 1);
        ++count[s->coef[i] < 0];
    }
    double rho = s->rho, *coef = s->coef;
    struct svm_model model = {.param = {.svm_type = C_SVC, .kernel_type = RBF, .gamma = s->gamma},
                              .nr_class = 2,
                              .l = s->sv_count,
                              .SV = rows,
                              .sv_coef = &coef,
                              .rho = &rho,
                              .label = label,
                              .nSV = count};
    double* z = calloc((size_t)n * DIMS, sizeof *z);
    for (int i = 0; i < n * DIMS; ++i)
        z[i] = (x[i] - s->centre[i % DIMS]) / s->scale[i % DIMS];
    struct svm_node* nodes = make_nodes(z, n);
    double sum = 0;
    const double begun = bench_now_s();
    for (int i = 0; i < n; ++i)
        sum += svm_predict(&model, nodes + i * (DIMS + 1));
    const double seconds = bench_now_s() - begun;
    bench_keep(&sum);
    free(nodes);
    free(z);
    free(rows);
    free(vectors);
    return n / seconds;
}

static double time_prediction(const bt_surrogate* s, bt_isa_level level, const double* x, int n,
                              int64_t ways[3]) {
    bt_predictor* p;
    if (bt_predictor_create(s, level, &p) != BT_OK)
        return NAN;
    int8_t* label = malloc((size_t)n);
    double best = INFINITY;
    for (int repeat = 0; repeat < REPEATS; ++repeat) {
        const double begun = bench_now_s();
        bt_predictor_label(p, x, n, label, NULL);
        best = fmin(best, bench_now_s() - begun);
        bench_keep(label);
    }
    bt_predictor_count(p, x, n, ways);
    free(label);
    bt_predictor_destroy(p);
    return n / best;
}

static void classify(void* predictor, const double* x, int n, int8_t* label, float* decision) {
    bt_predictor_label(predictor, x, n, label, decision);
}

static void bench_conditions(const bt_surrogate* s) {
    bt_predictor* p;
    if (bt_predictor_create(s, bt_isa_best(), &p) != BT_OK)
        return;
    const bt_classifier classifier = {.classify = classify, .user = p, .dims = DIMS};
    bt_sampler sampler = {.dims = DIMS, .seed = 1};
    for (int k = 0; k < DIMS; ++k)
        sampler.distribution[k] = (bt_distribution){.kind = BT_NORMAL, .mean = 0.1, .sd = 0.3};
    const double begun = bench_now_s();
    for (uint32_t condition = 0; condition < 24; ++condition) {
        bt_tally tally;
        sampler.stream = condition;
        if (bt_monte_carlo(&sampler, &classifier, 1000000, 0, NULL, &tally) != BT_OK)
            return;
        bench_keep(&tally);
    }
    char name[96];
    snprintf(name, sizeof name, "24 x 1e6 samples, %d vectors, %d threads", s->sv_count,
             bt_thread_count(0));
    bench_row(name, bench_now_s() - begun, "s", NULL, 0, 5);
    bt_predictor_destroy(p);
}

static void bench_prediction(void) {
    landings l = make_landings(6000, 0.05);
    const bt_surrogate_params single = {
        .folds = 2, .holdout = 0.4, .C = {1, {10}}, .gamma = {1, {0.3}}};
    bt_surrogate s;
    if (bt_surrogate_train(&l.set, &single, 1, 0, &s, NULL, NULL) != BT_OK)
        return;
    landings points = make_landings(200000, 0);
    const double peer = time_libsvm_prediction(&s, points.x, 20000);
    for (int level = BT_ISA_V1; level <= (int)bt_isa_best(); ++level) {
        static const char* const level_name[] = {"v1", "v3", "v4"};
        int64_t ways[3];
        const int n = level == BT_ISA_V1 ? 40000 : 200000;
        const double rate = time_prediction(&s, (bt_isa_level)level, points.x, n, ways);
        char name[96];
        snprintf(name, sizeof name, "labels, %d vectors, one core, %s (%.2f %% in double)",
                 s.sv_count, level_name[level], 100.0 * (double)(ways[1] + ways[2]) / n);
        bench_row(name, rate, "points/s", "LIBSVM", peer,
                  level == (int)bt_isa_best() ? 3e6 * 800 / s.sv_count : 0);
    }
    bench_conditions(&s);
    free_landings(&points);
    bt_surrogate_destroy(&s);
    free_landings(&l);
}

static double time_gsl_normals(int n) {
    gsl_rng* rng = gsl_rng_alloc(gsl_rng_mt19937);
    double best = INFINITY;
    for (int repeat = 0; repeat < REPEATS; ++repeat) {
        double sum = 0;
        const double begun = bench_now_s();
        for (int i = 0; i < n; ++i)
            sum += gsl_ran_gaussian_ziggurat(rng, 1);
        best = fmin(best, bench_now_s() - begun);
        bench_keep(&sum);
    }
    gsl_rng_free(rng);
    return n / best;
}

static void bench_normals(void) {
    bt_sample_uniforms* uniforms = bt_sample_uniforms_v1;
    bt_sample_normals* normals = bt_sample_normals_v1;
#if defined(__x86_64__)
    if (bt_isa_best() == BT_ISA_V3) {
        uniforms = bt_sample_uniforms_v3;
        normals = bt_sample_normals_v3;
    } else if (bt_isa_best() == BT_ISA_V4) {
        uniforms = bt_sample_uniforms_v4;
        normals = bt_sample_normals_v4;
    }
#endif
    double a[BT_SAMPLE_BLOCK], b[BT_SAMPLE_BLOCK], best = INFINITY;
    const int blocks = 20000;
    for (int repeat = 0; repeat < REPEATS; ++repeat) {
        const double begun = bench_now_s();
        for (int i = 0; i < blocks; ++i) {
            uniforms(1, (uint64_t)i * BT_SAMPLE_BLOCK, 0, 0, a, b);
            normals(a);
            normals(b);
            bench_keep(a);
            bench_keep(b);
        }
        best = fmin(best, bench_now_s() - begun);
    }
    bench_row("normals, keyed by sample and variable, one core",
              2.0 * BT_SAMPLE_BLOCK * blocks / best, "1/s", "GSL ziggurat",
              time_gsl_normals(5000000), 5e8);
}

void bench_surrogate(void) {
    bench_normals();
    bench_prediction();
    bench_training(false);
    bench_training(true);
}
