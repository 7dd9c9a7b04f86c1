#include "near.h"

#include "base/rng.h"
#include "folder.h"
#include "messages.h"
#include "surrogate/predictor.h"

#include <inttypes.h>
#include <libsvm/svm.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static char folder[FOLDER_SIZE];

static int make_folder(void** state) {
    (void)state;
    return folder_make(folder);
}

static int remove_folder(void** state) {
    (void)state;
    return rmdir(folder);
}

/// Points of a box, labelled by a curved band, the share `noise` of the labels turned round.
typedef struct sample {
    double* x;
    int* label;
    bt_training_set set;
} sample;

static int band(const double* x) {
    const double height = x[1] - 0.6 * sin(2 * x[0]);
    return height > -0.5 && height < 0.7 ? 1 : -1;
}

static sample make_sample(int n, int dims, double noise, uint64_t seed) {
    sample s = {
        malloc((size_t)n * (size_t)dims * sizeof(double)), malloc((size_t)n * sizeof(int)), {0}};
    for (int i = 0; i < n; ++i) {
        double inner[BT_INPUT_MAX];
        for (int k = 0; k < dims; ++k) {
            inner[k] = 4 * bt_rng_uniform(seed, (uint64_t)i, (uint32_t)k) - 2;
            s.x[i * dims + k] = 10 * (k + 1) + inner[k] * pow(10, k - 1); // scales far apart
        }
        s.label[i] = band(inner);
        if (bt_rng_uniform(seed, (uint64_t)i, 77) < noise)
            s.label[i] = -s.label[i];
    }
    s.set = (bt_training_set){dims, n, s.x, s.label};
    return s;
}

static void free_sample(sample* s) {
    free(s->x);
    free(s->label);
}

static bt_surrogate_params params_of(double C, double gamma) {
    bt_surrogate_params p = {.folds = 5, .holdout = 0.2};
    if (C > 0) {
        p.C = (bt_list){1, {C}};
        p.gamma = (bt_list){1, {gamma}};
    }
    return p;
}

static bt_surrogate train(const bt_training_set* set, const bt_surrogate_params* params) {
    bt_surrogate s;
    assert_int_equal(bt_surrogate_train(set, params, 1, 2, &s, NULL, NULL), BT_OK);
    return s;
}

/// Eqs. 19, 20: two points, one of each kind: f(z) = +-1 at them gives alpha = 1 / (1 - exp(-4
/// gamma)). LIBSVM keeps kernel values in single precision, hence the tolerance.
static void eq19_two_points_have_the_closed_form_solution(void** state) {
    (void)state;
    const double x[] = {5, 9};
    const int label[] = {-1, 1};
    const bt_training_set set = {1, 2, x, label};
    const bt_surrogate_params params = params_of(1e3, 0.4);
    bt_surrogate s = train(&set, &params);
    const double alpha = 1 / (1 - exp(-4 * 0.4));
    assert_int_equal(s.sv_count, 2);
    BT_ASSERT_NEAR(s.coef[0], alpha, 1e-7, 0);
    BT_ASSERT_NEAR(s.coef[1], -alpha, 1e-7, 0);
    BT_ASSERT_NEAR(s.rho, 0, 0, 1e-12);
    for (int i = 0; i < 2; ++i)
        BT_ASSERT_NEAR(bt_surrogate_decision(&s, &x[i]), label[i], 1e-7, 0);
    const double middle = 7;
    BT_ASSERT_NEAR(bt_surrogate_decision(&s, &middle), 0, 0, 1e-12);
    bt_surrogate_destroy(&s);
}

/// The conditions that make a machine the optimum of Eq. 19: 0 < alpha <= C, sum y alpha = 0,
/// y f = 1 on free vectors, y f <= 1 on bounded ones, y f >= 1 elsewhere, to LIBSVM's tolerance.
static void eq19_trained_classifier_satisfies_the_optimality_conditions(void** state) {
    (void)state;
    sample data = make_sample(600, 3, 0.05, 2);
    bt_surrogate_params params = params_of(10, 0.5);
    params.holdout = 1e-9; // nothing is held out: every landing must satisfy them
    bt_surrogate s = train(&data.set, &params);
    assert_int_equal(s.scores.train_count, 600);
    double sum = 0;
    for (int i = 0; i < s.sv_count; ++i) {
        assert_true(fabs(s.coef[i]) > 0 && fabs(s.coef[i]) <= s.C);
        sum += s.coef[i];
        const int y = s.coef[i] > 0 ? 1 : -1;
        double x[3];
        for (int k = 0; k < 3; ++k)
            x[k] = s.centre[k] + s.scale[k] * s.sv[3 * i + k];
        const double margin = y * bt_surrogate_decision(&s, x);
        if (fabs(s.coef[i]) < s.C)
            BT_ASSERT_NEAR(margin, 1, 0, 2e-3);
        else
            assert_true(margin <= 1 + 2e-3);
    }
    BT_ASSERT_NEAR(sum, 0, 0, 1e-9);
    int inside = 0;
    for (int i = 0; i < 600; ++i)
        inside += data.label[i] * bt_surrogate_decision(&s, data.x + 3 * i) < 1 - 2e-3;
    assert_true(inside <= s.sv_count); // only support vectors lie within the margin
    bt_surrogate_destroy(&s);
    free_sample(&data);
}

/// A LIBSVM model with the same vectors, for LIBSVM's own prediction.
typedef struct reference {
    struct svm_model model;
    struct svm_node *nodes, **rows;
    double* coefs[1];
    int labels[2], counts[2];
} reference;

static void make_reference(const bt_surrogate* s, reference* r) {
    const int dims = s->dims;
    *r = (reference){.labels = {1, -1}};
    r->nodes = malloc((size_t)s->sv_count * (size_t)(dims + 1) * sizeof *r->nodes);
    r->rows = malloc((size_t)s->sv_count * sizeof *r->rows);
    for (int i = 0; i < s->sv_count; ++i) {
        r->rows[i] = r->nodes + i * (dims + 1);
        for (int k = 0; k < dims; ++k)
            r->rows[i][k] = (struct svm_node){k + 1, s->sv[i * dims + k]};
        r->rows[i][dims].index = -1;
        ++r->counts[s->coef[i] < 0];
    }
    r->coefs[0] = s->coef;
    r->model = (struct svm_model){
        .param = {.svm_type = C_SVC, .kernel_type = RBF, .gamma = s->gamma},
        .nr_class = 2,
        .l = s->sv_count,
        .SV = r->rows,
        .sv_coef = r->coefs,
        .rho = (double*)&s->rho,
        .label = r->labels,
        .nSV = r->counts,
    };
}

static void labels_equal_libsvm_on_a_hundred_thousand_points(void** state) {
    (void)state;
    sample data = make_sample(1500, 4, 0.01, 3);
    const bt_surrogate_params params = params_of(1e4, 1);
    bt_surrogate s = train(&data.set, &params);
    reference r;
    make_reference(&s, &r);
    enum { N = 100000 };
    sample fresh = make_sample(N, 4, 0, 4);
    int8_t* label = malloc(N);
    bt_predictor* p;
    assert_int_equal(bt_predictor_create(&s, bt_isa_best(), &p), BT_OK);
    bt_predictor_label(p, fresh.x, N, label, NULL);
    for (int i = 0; i < N; ++i) {
        struct svm_node node[5];
        for (int k = 0; k < 4; ++k)
            node[k] = (struct svm_node){k + 1, (fresh.x[4 * i + k] - s.centre[k]) / s.scale[k]};
        node[4].index = -1;
        double value;
        const double answer = svm_predict_values(&r.model, node, &value);
        assert_int_equal(label[i], (int)answer);
        if (i < 2000) { // the definition, to the last bit
            const double ours = bt_surrogate_decision(&s, fresh.x + 4 * i);
            assert_memory_equal(&ours, &value, sizeof value);
        }
    }
    bt_predictor_destroy(p);
    free(label);
    free(r.nodes);
    free(r.rows);
    free_sample(&fresh);
    bt_surrogate_destroy(&s);
    free_sample(&data);
}

static void training_learns_a_curved_band_and_the_holdout_says_so(void** state) {
    (void)state;
    sample data = make_sample(2000, 2, 0, 5), fresh = make_sample(20000, 2, 0, 6);
    const bt_surrogate_params params = params_of(0, 0);
    bt_grid* grid = malloc(sizeof *grid);
    bt_surrogate s;
    assert_int_equal(bt_surrogate_train(&data.set, &params, 1, 2, &s, grid, NULL), BT_OK);
    assert_int_equal(s.scores.train_count, 1600);
    assert_int_equal(s.scores.holdout_count, 400);
    assert_true(bt_surrogate_train_accuracy(&s.scores) > 0.985);
    assert_true(bt_surrogate_holdout_accuracy(&s.scores) > 0.97);
    int right = 0;
    for (int i = 0; i < 20000; ++i)
        right += (bt_surrogate_decision(&s, fresh.x + 2 * i) > 0) == (fresh.label[i] > 0);
    // fresh points agree with the hold-out's interval (99.9 % of it, to be no coin toss)
    const bt_interval wide =
        bt_clopper_pearson(s.scores.holdout_correct, s.scores.holdout_count, 0.999);
    assert_true(right / 20000.0 > wide.least && right / 20000.0 < wide.greatest);
    // the grid is whole: six penalties times five widths, and the chosen one among the tried
    assert_int_equal(grid->count, 30);
    const bt_grid_point* best = &grid->point[grid->best];
    assert_true(best->trained_on > 0 && best->C == s.C && best->gamma == s.gamma);
    assert_true((double)best->correct / best->trained_on > 0.97);
    int confusion = 0;
    for (int i = 0; i < 4; ++i)
        confusion += s.scores.confusion[i / 2][i % 2];
    assert_int_equal(confusion, 400);
    assert_int_equal(s.scores.confusion[0][0] + s.scores.confusion[1][1], s.scores.holdout_correct);
    free(grid);
    bt_surrogate_destroy(&s);
    free_sample(&data);
    free_sample(&fresh);
}

/// A fit with what a selection chose is the classifier that both together train; without a hold-out
/// it learns from every landing and has no share of right answers on others.
static void a_refit_costs_a_fit_and_gives_the_same_classifier(void** state) {
    (void)state;
    sample data = make_sample(600, 2, 0, 5);
    const bt_surrogate_params params = params_of(0, 0);
    bt_surrogate whole, again, all;
    bt_hyperparameters chosen;
    assert_int_equal(bt_surrogate_train(&data.set, &params, 1, 2, &whole, NULL, NULL), BT_OK);
    assert_int_equal(
        bt_surrogate_select(&data.set, &params, params.holdout, 1, 2, &chosen, NULL, NULL), BT_OK);
    assert_int_equal(bt_surrogate_fit(&data.set, &chosen, params.holdout, 1, &again, NULL), BT_OK);
    assert_int_equal(whole.sv_count, again.sv_count);
    assert_memory_equal(whole.coef, again.coef, (size_t)whole.sv_count * sizeof *whole.coef);
    assert_memory_equal(whole.scale, again.scale, sizeof whole.scale);
    assert_int_equal(whole.scores.holdout_correct, again.scores.holdout_correct);
    assert_int_equal(bt_surrogate_fit(&data.set, &chosen, 0, 1, &all, NULL), BT_OK);
    assert_int_equal(all.scores.train_count, 600);
    assert_int_equal(all.scores.holdout_count, 0);
    assert_true(isnan(bt_surrogate_holdout_accuracy(&all.scores)));
    bt_surrogate_destroy(&whole);
    bt_surrogate_destroy(&again);
    bt_surrogate_destroy(&all);
    free_sample(&data);
}

/// One landing, or one miss among many: what the hold-out cannot tell is said.
static void a_holdout_without_a_class_is_said(void** state) {
    (void)state;
    sample data = make_sample(300, 2, 0, 5);
    for (int i = 0; i < 300; ++i)
        data.label[i] = i ? 1 : -1;
    const bt_surrogate_params params = params_of(10, 1);
    messages said = {{0}};
    bt_diag diag = {messages_add, &said, 0, 0};
    bt_surrogate s;
    assert_int_equal(bt_surrogate_train(&data.set, &params, 1, 1, &s, NULL, &diag), BT_OK);
    assert_non_null(strstr(said.text, "no missed landing is among the 60 held out"));
    bt_surrogate_destroy(&s);
    bt_training_set one = data.set;
    one.count = 1;
    assert_int_equal(bt_surrogate_train(&one, &params, 1, 1, &s, NULL, &diag), BT_OK);
    assert_non_null(strstr(said.text, "too few to hold any out"));
    bt_surrogate_destroy(&s);
    free_sample(&data);
}

/// Labels by the toss of a coin can be learnt by heart, not learnt: only the hold-out shows it.
static void holdout_of_coin_tosses_is_one_half_however_well_they_are_remembered(void** state) {
    (void)state;
    sample data = make_sample(1000, 2, 0.5, 7);
    const bt_surrogate_params params = params_of(1e4, 300);
    bt_surrogate s = train(&data.set, &params);
    assert_true(bt_surrogate_train_accuracy(&s.scores) > 0.95);
    const bt_interval wide =
        bt_clopper_pearson(s.scores.holdout_correct, s.scores.holdout_count, 0.999);
    assert_true(wide.least < 0.5 && 0.5 < wide.greatest);
    bt_surrogate_destroy(&s);
    free_sample(&data);
}

/// A share of turned labels is a ceiling for any surrogate.
static void label_noise_limits_the_holdout_accuracy(void** state) {
    (void)state;
    sample data = make_sample(1000, 2, 0.1, 8);
    const bt_surrogate_params params = params_of(0, 0);
    bt_surrogate s = train(&data.set, &params);
    const bt_interval wide =
        bt_clopper_pearson(s.scores.holdout_correct, s.scores.holdout_count, 0.999);
    assert_true(wide.least < 0.9 && wide.greatest > 0.87);
    bt_surrogate_destroy(&s);
    free_sample(&data);
}

static void assert_same_surrogate(const bt_surrogate* a, const bt_surrogate* b) {
    assert_int_equal(a->dims, b->dims);
    assert_int_equal(a->sv_count, b->sv_count);
    assert_int_equal(a->constant, b->constant);
    assert_true(a->study_hash == b->study_hash && a->training_hash == b->training_hash);
    const size_t inputs = (size_t)a->dims * sizeof(double);
    assert_memory_equal(a->path, b->path, sizeof a->path);
    assert_memory_equal(a->centre, b->centre, inputs);
    assert_memory_equal(a->scale, b->scale, inputs);
    assert_memory_equal(a->weight, b->weight, inputs);
    assert_memory_equal(a->least, b->least, inputs);
    assert_memory_equal(a->greatest, b->greatest, inputs);
    assert_memory_equal(&a->C, &b->C, sizeof a->C);
    assert_memory_equal(&a->gamma, &b->gamma, sizeof a->gamma);
    assert_memory_equal(&a->rho, &b->rho, sizeof a->rho);
    if (a->sv_count) {
        assert_memory_equal(a->sv, b->sv, (size_t)a->sv_count * inputs);
        assert_memory_equal(a->coef, b->coef, (size_t)a->sv_count * sizeof(double));
    }
    bt_surrogate_scores x = a->scores, y = b->scores;
    x.seconds = y.seconds = 0;
    assert_memory_equal(&x, &y, sizeof x);
}

static void training_gives_the_same_bits_for_1_2_and_3_threads(void** state) {
    (void)state;
    sample data = make_sample(400, 3, 0.03, 9);
    const bt_surrogate_params params = params_of(0, 0);
    bt_grid* grids = calloc(3, sizeof *grids);
    bt_surrogate s[3];
    for (int i = 0; i < 3; ++i)
        assert_int_equal(bt_surrogate_train(&data.set, &params, 5, i + 1, &s[i], &grids[i], NULL),
                         BT_OK);
    for (int i = 1; i < 3; ++i) {
        assert_same_surrogate(&s[0], &s[i]);
        assert_int_equal(grids[0].best, grids[i].best);
        assert_memory_equal(grids[0].point, grids[i].point,
                            (size_t)grids[0].count * sizeof *grids[0].point);
    }
    for (int i = 0; i < 3; ++i)
        bt_surrogate_destroy(&s[i]);
    free(grids);
    free_sample(&data);
}

static void landings_of_one_kind_give_a_constant_surrogate(void** state) {
    (void)state;
    for (int kind = -1; kind <= 1; kind += 2) {
        sample data = make_sample(50, 2, 0, 10);
        for (int i = 0; i < 50; ++i)
            data.label[i] = kind;
        const bt_surrogate_params params = params_of(0, 0);
        bt_diag diag = {0};
        bt_surrogate s;
        assert_int_equal(bt_surrogate_train(&data.set, &params, 1, 1, &s, NULL, &diag), BT_OK);
        assert_int_equal(diag.warnings, 1);
        assert_true(s.constant && s.sv_count == 0);
        assert_true(bt_surrogate_decision(&s, data.x) == kind);
        assert_true(bt_surrogate_holdout_accuracy(&s.scores) == 1);
        bt_surrogate_destroy(&s);
        free_sample(&data);
    }
}

static void one_landing_of_the_other_kind_is_trained_on(void** state) {
    (void)state;
    sample data = make_sample(60, 2, 0, 11);
    for (int i = 0; i < 60; ++i)
        data.label[i] = i == 17 ? 1 : -1;
    const bt_surrogate_params params = params_of(1e3, 10);
    bt_surrogate s = train(&data.set, &params);
    assert_false(s.constant);
    assert_true(bt_surrogate_decision(&s, data.x + 2 * 17) > 0);
    bt_surrogate_destroy(&s);
    free_sample(&data);
}

static void an_input_that_never_varies_changes_nothing(void** state) {
    (void)state;
    sample data = make_sample(200, 3, 0, 12);
    for (int i = 0; i < 200; ++i)
        data.x[3 * i + 2] = 47.5;
    const bt_surrogate_params params = params_of(100, 1);
    bt_surrogate s = train(&data.set, &params);
    assert_true(s.centre[2] == 47.5 && s.scale[2] == 1 && s.weight[2] == 1);
    assert_true(bt_surrogate_train_accuracy(&s.scores) > 0.95);
    bt_surrogate_destroy(&s);
    free_sample(&data);
}

/// Labels that turn four times as often along the first input as along the other two.
static int ripple(const double* x) {
    return sin(6 * x[0]) + sin(1.5 * x[1]) + sin(1.5 * x[2]) > 0 ? 1 : -1;
}

static sample make_ripple(int n, uint64_t seed) {
    sample s = make_sample(n, 3, 0, seed);
    for (int i = 0; i < n; ++i) {
        double inner[3];
        for (int k = 0; k < 3; ++k)
            inner[k] = (s.x[3 * i + k] - 10 * (k + 1)) / pow(10, k - 1);
        s.label[i] = ripple(inner);
    }
    return s;
}

/// Right answers on fresh points of LIBSVM alone, with the same centre and deviation, no weights.
static int unweighted_right(const bt_surrogate* s, const sample* data, const sample* fresh,
                            double C, double gamma) {
    const int n = data->set.count, m = fresh->set.count;
    struct svm_node* nodes = malloc((size_t)(n + m) * 4 * sizeof *nodes);
    struct svm_node** rows = malloc((size_t)n * sizeof *rows);
    double* y = malloc((size_t)n * sizeof *y);
    for (int i = 0; i < n + m; ++i) {
        const double* x = i < n ? data->x + 3 * i : fresh->x + 3 * (i - n);
        for (int k = 0; k < 3; ++k)
            nodes[4 * i + k] =
                (struct svm_node){k + 1, (x[k] - s->centre[k]) / (s->scale[k] * s->weight[k])};
        nodes[4 * i + 3].index = -1;
    }
    for (int i = 0; i < n; ++i) {
        rows[i] = nodes + 4 * i;
        y[i] = data->label[i];
    }
    const struct svm_problem problem = {n, y, rows};
    const struct svm_parameter param = {.svm_type = C_SVC,
                                        .kernel_type = RBF,
                                        .gamma = gamma,
                                        .C = C,
                                        .cache_size = 100,
                                        .eps = 1e-3,
                                        .shrinking = 1};
    struct svm_model* model = svm_train(&problem, &param);
    int right = 0;
    for (int i = 0; i < m; ++i)
        right += svm_predict(model, nodes + 4 * (n + i)) == fresh->label[i];
    svm_free_and_destroy_model(&model);
    free(y);
    free(rows);
    free(nodes);
    return right;
}

static void an_input_with_finer_structure_gets_more_weight_and_accuracy_rises(void** state) {
    (void)state;
    enum { FRESH = 10000 };
    sample data = make_ripple(1000, 15), fresh = make_ripple(FRESH, 16);
    const bt_surrogate_params params = params_of(0, 0);
    bt_surrogate s = train(&data.set, &params);
    for (int k = 1; k < 3; ++k)
        assert_true(s.weight[0] >= 2 * s.weight[k]);
    int right = 0, plain = 0;
    for (int i = 0; i < FRESH; ++i)
        right += (bt_surrogate_decision(&s, fresh.x + 3 * i) > 0) == (fresh.label[i] > 0);
    // the best that the grid up to C = 1000 reaches without weights, with hindsight and with the
    // landings that were held out
    for (double C = 1; C < 2e3; C *= 10)
        for (int i = 0; i < 5; ++i) {
            static const double gamma[] = {0.1, 0.3, 1, 3, 10};
            const int now = unweighted_right(&s, &data, &fresh, C, gamma[i]);
            plain = now > plain ? now : plain;
        }
    assert_true(right > plain);
    bt_surrogate_destroy(&s);
    free_sample(&data);
    free_sample(&fresh);
}

/// Missed when x3 is low, and in a thin band oblique to all four inputs (a tenth of the landings):
/// the shape that wheels which have just pressed the cable down leave in a study.
static int oblique(const double* x, bool* in_band) {
    *in_band = x[3] > -1.2 && fabs(x[3] - 0.5 * x[0] - 0.3 * x[1] + 0.4 * x[2]) < 0.2;
    return x[3] < -1.2 || *in_band ? -1 : 1;
}

/// Weights and cell chosen by the number of right answers, equal within half a standard error, gave
/// up here: 1.6 % of the band and 89.9 % of all for this seed, 3.6 and 88.5 % for the next.
static void a_thin_oblique_band_is_seen(void** state) {
    (void)state;
    enum { N = 1000, FRESH = 20000 };
    double* x = malloc((size_t)(4 * N) * sizeof *x);
    int* label = malloc(N * sizeof *label);
    bool in_band;
    for (int i = 0; i < N; ++i) {
        for (int k = 0; k < 4; ++k)
            x[4 * i + k] = 4 * bt_rng_uniform(1, (uint64_t)i, (uint32_t)k) - 2;
        label[i] = oblique(x + 4 * i, &in_band);
    }
    const bt_training_set set = {4, N, x, label};
    const bt_surrogate_params params = params_of(0, 0);
    bt_surrogate s = train(&set, &params);
    int right = 0, band = 0, seen = 0;
    for (int i = 0; i < FRESH; ++i) {
        double point[4];
        for (int k = 0; k < 4; ++k)
            point[k] = 4 * bt_rng_uniform(2, (uint64_t)i, (uint32_t)k) - 2;
        const int truth = oblique(point, &in_band);
        const bool correct = (bt_surrogate_decision(&s, point) > 0) == (truth > 0);
        right += correct;
        band += in_band;
        seen += in_band && correct;
    }
    assert_true(seen > 0.7 * band);
    assert_true(right > 0.93 * FRESH);
    bt_surrogate_destroy(&s);
    free(x);
    free(label);
}

/// A tenth of the labels turned: at C = 3e5 a fold takes some 10^6 iterations, which is too hard.
/// The row ends there, before LIBSVM would give up and print, and another cell is chosen.
static void a_classifier_that_does_not_converge_is_not_chosen_and_nothing_is_printed(void** state) {
    (void)state;
    char path[512];
    snprintf(path, sizeof path, "%s/stderr", folder);
    fflush(stderr);
    const int kept = dup(STDERR_FILENO);
    FILE* heard = fopen(path, "w+");
    assert_non_null(heard);
    assert_true(dup2(fileno(heard), STDERR_FILENO) >= 0);
    sample data = make_sample(800, 2, 0.1, 17);
    bt_surrogate_params params = params_of(0, 0);
    params.C = (bt_list){3, {10, 3e5, 1e9}};
    params.gamma = (bt_list){1, {0.3}};
    bt_grid* grid = malloc(sizeof *grid);
    bt_surrogate s;
    const bt_status status = bt_surrogate_train(&data.set, &params, 1, 2, &s, grid, NULL);
    fflush(stderr);
    dup2(kept, STDERR_FILENO);
    close(kept);
    assert_int_equal(status, BT_OK);
    fseek(heard, 0, SEEK_END);
    assert_int_equal(ftell(heard), 0);
    fclose(heard);
    unlink(path);
    assert_true(isinf(grid->point[1].loss));
    assert_int_equal(grid->point[2].trained_on, 0);
    assert_true(grid->best == 0 && isfinite(grid->point[0].loss) && s.C == 10);
    free(grid);
    bt_surrogate_destroy(&s);
    free_sample(&data);
}

static void unsound_landings_are_refused(void** state) {
    (void)state;
    sample data = make_sample(20, 2, 0, 13);
    const bt_surrogate_params params = params_of(1, 1);
    bt_surrogate s;
    bt_training_set none = data.set;
    none.count = 0;
    assert_int_equal(bt_surrogate_train(&none, &params, 1, 1, &s, NULL, NULL), BT_ERR_ARG);
    bt_training_set wide = data.set;
    wide.dims = BT_INPUT_MAX + 1;
    assert_int_equal(bt_surrogate_train(&wide, &params, 1, 1, &s, NULL, NULL), BT_ERR_ARG);
    data.label[3] = 0; // a failed run
    bt_diag diag = {0};
    assert_int_equal(bt_surrogate_train(&data.set, &params, 1, 1, &s, NULL, &diag), BT_ERR_ARG);
    assert_int_equal(diag.errors, 1);
    data.label[3] = 1;
    data.x[7] = NAN;
    assert_int_equal(bt_surrogate_train(&data.set, &params, 1, 1, &s, NULL, NULL), BT_ERR_ARG);
    free_sample(&data);
}

/* ---- the model file ---- */

static void path_of(const char* name, char* path, size_t size) {
    snprintf(path, size, "%s/%s", folder, name);
}

static char* read_whole(const char* path, size_t* size) {
    FILE* in = fopen(path, "rb");
    assert_non_null(in);
    char* text = malloc(1 << 20);
    *size = fread(text, 1, 1 << 20, in);
    fclose(in);
    return text;
}

static void write_whole(const char* path, const char* text, size_t size) {
    FILE* out = fopen(path, "wb");
    assert_non_null(out);
    assert_true(fwrite(text, 1, size, out) == size);
    fclose(out);
}

static bt_surrogate trained_with_names(void) {
    sample data = make_sample(300, 3, 0.02, 14);
    const bt_surrogate_params params = params_of(100, 1);
    bt_surrogate s = train(&data.set, &params);
    for (int k = 0; k < 3; ++k)
        snprintf(s.path[k], sizeof s.path[k], "landing.input_%d", k);
    s.study_hash = 0x0123456789abcdef;
    free_sample(&data);
    return s;
}

static void model_file_gives_every_bit_back(void** state) {
    (void)state;
    char path[512];
    path_of("surrogate.model", path, sizeof path);
    bt_surrogate s = trained_with_names(), back;
    s.centre[0] = -0.0; // a signed zero, the least and the greatest doubles
    s.least[1] = 0x1p-1074;
    s.greatest[1] = 0x1.fffffffffffffp1023;
    s.sv[0] = -0x0.0000000000123p-1022;
    assert_int_equal(bt_surrogate_save(&s, path, NULL), BT_OK);
    assert_int_equal(bt_surrogate_load(path, &back, NULL), BT_OK);
    assert_same_surrogate(&s, &back);
    assert_memory_equal(&s.scores.seconds, &back.scores.seconds, sizeof(double));
    bt_surrogate_destroy(&back);
    bt_surrogate_destroy(&s);

    bt_surrogate constant = {.dims = 1, .scale = {1}, .rho = 1, .gamma = 1, .constant = true};
    assert_int_equal(bt_surrogate_save(&constant, path, NULL), BT_OK);
    assert_int_equal(bt_surrogate_load(path, &back, NULL), BT_OK);
    assert_true(back.constant && back.sv_count == 0 && back.rho == 1);
    bt_surrogate_destroy(&back);
    unlink(path);
}

/// Files written before inputs had weights have five words after an input's name, not six.
static void model_file_without_weights_is_read_with_weights_one(void** state) {
    (void)state;
    char path[128];
    path_of("older.model", path, sizeof path);
    static const char older[] =
        "bolter surrogate 1\nstudy 0000000000000000\ntraining 0000000000000000\ninputs 1\n"
        "input - 0x0.0000000000000p-1022 0x1.0000000000000p+0 0x0.0000000000000p-1022 "
        "0x1.0000000000000p+0\nmachine constant 0x1.0000000000000p+0 0x1.0000000000000p+0 "
        "0x1.0000000000000p+0\nscores 1 1 0 0 0 0 0 0 0 0\nseconds 0x1.0000000000000p+0\n"
        "vectors 0\n";
    uint64_t hash = 0xcbf29ce484222325u; // FNV-1a
    for (const char* at = older; *at; ++at)
        hash = (hash ^ (unsigned char)*at) * 0x100000001b3u;
    char text[1024];
    const int size = snprintf(text, sizeof text, "%send %016" PRIx64 "\n", older, hash);
    write_whole(path, text, (size_t)size);
    bt_surrogate s;
    assert_int_equal(bt_surrogate_load(path, &s, NULL), BT_OK);
    assert_true(s.weight[0] == 1 && s.scale[0] == 1 && s.constant);
    bt_surrogate_destroy(&s);
    unlink(path);
}

typedef struct heard {
    char text[512];
    int line;
} heard;

static void listen(void* user, bt_severity severity, bt_where where, const char* text) {
    heard* h = user;
    assert_int_equal(severity, BT_ERROR);
    snprintf(h->text, sizeof h->text, "%s", text);
    h->line = where.line;
}

static void expect_refusal(const char* path, const char* words) {
    heard h = {"", 0};
    bt_diag diag = {listen, &h, 0, 0};
    bt_surrogate s;
    assert_int_equal(bt_surrogate_load(path, &s, &diag), BT_ERR_INPUT);
    assert_int_equal(diag.errors, 1);
    if (!strstr(h.text, words))
        fail_msg("\"%s\" does not say \"%s\"", h.text, words);
    assert_null(s.sv);
}

static void model_file_that_is_foreign_or_of_another_version_is_refused(void** state) {
    (void)state;
    char path[512];
    path_of("foreign.model", path, sizeof path);
    static const char* const foreign[] = {"", "\n", "svm_type c_svc\nkernel_type rbf\n",
                                          "bolter surrogat", "BOLTER SURROGATE 1\n"};
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; ++i) {
        write_whole(path, foreign[i], strlen(foreign[i]));
        expect_refusal(path, "not a surrogate");
    }
    write_whole(path, "bolter surrogate 2\nstudy 0\n", 27);
    expect_refusal(path, "another version");
    unlink(path);
}

static void model_file_cut_anywhere_is_refused(void** state) {
    (void)state;
    char path[512];
    path_of("cut.model", path, sizeof path);
    bt_surrogate s = trained_with_names();
    assert_int_equal(bt_surrogate_save(&s, path, NULL), BT_OK);
    size_t size;
    char* text = read_whole(path, &size);
    for (size_t length = 0; length < size; length += length < size - 60 ? 97 : 1) {
        write_whole(path, text, length);
        bt_surrogate back;
        assert_int_equal(bt_surrogate_load(path, &back, NULL), BT_ERR_INPUT);
    }
    write_whole(path, text, size / 2);
    expect_refusal(path, "ends early");
    free(text);
    bt_surrogate_destroy(&s);
    unlink(path);
}

static void model_file_with_a_changed_byte_is_refused(void** state) {
    (void)state;
    char path[512];
    path_of("changed.model", path, sizeof path);
    bt_surrogate s = trained_with_names();
    assert_int_equal(bt_surrogate_save(&s, path, NULL), BT_OK);
    size_t size;
    char* text = read_whole(path, &size);
    for (size_t at = 19; at < size - 1; at += 61) {
        const char before = text[at];
        text[at] = before == '3' ? '5' : '3';
        write_whole(path, text, size);
        bt_surrogate back;
        assert_int_equal(bt_surrogate_load(path, &back, NULL), BT_ERR_INPUT);
        text[at] = before;
    }
    text[size / 2] ^= 1;
    write_whole(path, text, size);
    expect_refusal(path, "checksum");
    free(text);
    bt_surrogate_destroy(&s);
    unlink(path);
}

static void a_folder_that_is_not_there_is_an_error_in_both_directions(void** state) {
    (void)state;
    bt_surrogate s = {.dims = 1, .scale = {1}, .rho = 1, .gamma = 1, .constant = true}, back;
    char path[512];
    path_of("nowhere/surrogate.model", path, sizeof path);
    bt_diag diag = {0};
    assert_int_equal(bt_surrogate_save(&s, path, &diag), BT_ERR_IO);
    assert_int_equal(bt_surrogate_load(path, &back, &diag), BT_ERR_IO);
    assert_int_equal(diag.errors, 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eq19_two_points_have_the_closed_form_solution),
        cmocka_unit_test(eq19_trained_classifier_satisfies_the_optimality_conditions),
        cmocka_unit_test(labels_equal_libsvm_on_a_hundred_thousand_points),
        cmocka_unit_test(a_refit_costs_a_fit_and_gives_the_same_classifier),
        cmocka_unit_test(a_holdout_without_a_class_is_said),
        cmocka_unit_test(training_learns_a_curved_band_and_the_holdout_says_so),
        cmocka_unit_test(holdout_of_coin_tosses_is_one_half_however_well_they_are_remembered),
        cmocka_unit_test(label_noise_limits_the_holdout_accuracy),
        cmocka_unit_test(training_gives_the_same_bits_for_1_2_and_3_threads),
        cmocka_unit_test(landings_of_one_kind_give_a_constant_surrogate),
        cmocka_unit_test(one_landing_of_the_other_kind_is_trained_on),
        cmocka_unit_test(an_input_that_never_varies_changes_nothing),
        cmocka_unit_test(an_input_with_finer_structure_gets_more_weight_and_accuracy_rises),
        cmocka_unit_test(a_thin_oblique_band_is_seen),
        cmocka_unit_test(a_classifier_that_does_not_converge_is_not_chosen_and_nothing_is_printed),
        cmocka_unit_test(unsound_landings_are_refused),
        cmocka_unit_test(model_file_gives_every_bit_back),
        cmocka_unit_test(model_file_without_weights_is_read_with_weights_one),
        cmocka_unit_test(model_file_that_is_foreign_or_of_another_version_is_refused),
        cmocka_unit_test(model_file_cut_anywhere_is_refused),
        cmocka_unit_test(model_file_with_a_changed_byte_is_refused),
        cmocka_unit_test(a_folder_that_is_not_there_is_an_error_in_both_directions),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
