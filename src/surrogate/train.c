#include "base/tasks.h"
#include "surrogate/loss.h"
#include "surrogate/predictor.h"
#include "surrogate/relevance.h"

#include "base/rng.h"

#include <libsvm/svm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

// Streams of the keyed random numbers that training draws from, apart from a run's own variables.
enum { STREAM_HOLDOUT = 0x53500001u };

// The rounds of model selection: on how many landings, and how many cells go on to the next.
enum { ROUNDS = 3, FINALISTS = 3 };
static const int round_size[ROUNDS] = {2000, 6000, 16000};

// LIBSVM's stopping tolerance: on the slopes of the dual, where the margin is 1. While cells are
// only compared a tenth of a margin does: it moves the share of right answers by a tenth of its
// standard error and saves nine tenths of the time at large C.
static const double compare_tolerance = 0.1, final_tolerance = 1e-3;

// Where the weights of the inputs are compared: wide and stiff, so that a narrow band is followed
// by the weights and not by a narrow kernel.
static const double probe_C = 1000, probe_gamma = 0.1;

// The weights are compared with so many times the folds of the grid: the more a fold learns from,
// the finer the structure that it can see, as the machine in the end will.
enum { weight_folds = 2 };

// A row of the grid is left when a step gained less than this share of the loss (loss.h).
static const double little = 0.01;

// LIBSVM gives up after 10^7 iterations (and says so where nobody should print). A fold that takes
// more than this many is too hard: the next round's landings, or the final tolerance, would bring
// it near to that.
static const long most_iterations = 1000000;
static const double libsvm_iterations = 1e7;

static const double default_C[] = {1, 10, 100, 1e3, 1e4, 1e5};
static const double default_gamma[] = {0.1, 0.3, 1, 3, 10};

/// Everything a training owns.
typedef struct trainer {
    const bt_training_set* set;
    const bt_surrogate_params* params;
    int threads, dims, folds;
    struct svm_node* nodes; ///< [count * (dims + 1)] standardised
    double* z;              ///< [count * dims] the same, dense
    int* list;              ///< indices of the training landings: +1 first, each class shuffled
    int train[2];           ///< how many of class +1, -1
    int* holdout;
    int holdout_count;
    bt_grid* grid;
    int rows, columns;   ///< gammas, Cs
    bt_grid_point probe; ///< where the weights of the inputs are compared
    // of the round
    int cell[BT_GRID_MAX], cells, share[2]; ///< cells to try, landings of each class
    struct answers* answers;                ///< [cells * folds]
} trainer;

/// How a machine answered landings that it had not learnt from.
typedef struct answers {
    int correct;
    double loss; ///< sum (loss.h); INFINITY: the machine took too many iterations
} answers;

static double now_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

// How many iterations this thread's last training took. LIBSVM tells it in its messages only, and
// their receiver is given nothing but the text.
static _Thread_local long iterations;

static void listen(const char* text) {
    const char* count = strstr(text, "#iter = ");
    if (count)
        iterations = strtol(count + strlen("#iter = "), NULL, 10);
}

/* ---- the split ---- */

typedef struct keyed {
    uint64_t key;
    int index;
} keyed;

static int compare_keyed(const void* a, const void* b) {
    const keyed *x = a, *y = b;
    if (x->key != y->key)
        return x->key < y->key ? -1 : 1;
    return (x->index > y->index) - (x->index < y->index);
}

/// Shuffles each class by key; its first landings are held out, the others learnt from.
static bt_status split(trainer* t, uint64_t seed) {
    const bt_training_set* set = t->set;
    keyed* draw = malloc((size_t)set->count * sizeof *draw);
    if (!draw)
        return BT_ERR_MEMORY;
    int listed = 0;
    for (int class = 0; class < 2; ++class) {
        int n = 0;
        for (int i = 0; i < set->count; ++i)
            if ((set->label[i] > 0) == (class == 0))
                draw[n++] = (keyed){bt_rng_bits(seed, (uint64_t)i, STREAM_HOLDOUT), i};
        qsort(draw, (size_t)n, sizeof *draw, compare_keyed);
        int held = (int)floor(t->params->holdout * n + 0.5);
        if (held >= n)
            held = n > 0 ? n - 1 : 0;
        for (int i = 0; i < n; ++i) {
            if (i < held)
                t->holdout[t->holdout_count++] = draw[i].index;
            else
                t->list[listed++] = draw[i].index;
        }
        t->train[class] = n - held;
    }
    free(draw);
    return BT_OK;
}

/// Centre, scale and box of the training landings.
static void measure(const trainer* t, bt_surrogate* out) {
    const bt_training_set* set = t->set;
    const int n = t->train[0] + t->train[1], dims = t->dims;
    for (int k = 0; k < dims; ++k) {
        double sum = 0, square = 0, least = INFINITY, greatest = -INFINITY;
        for (int i = 0; i < n; ++i) {
            const double x = set->x[(size_t)t->list[i] * (size_t)dims + (size_t)k];
            sum += x;
            least = fmin(least, x);
            greatest = fmax(greatest, x);
        }
        const double centre = sum / n;
        for (int i = 0; i < n; ++i) {
            const double x = set->x[(size_t)t->list[i] * (size_t)dims + (size_t)k] - centre;
            square += x * x;
        }
        const double deviation = sqrt(square / n);
        out->centre[k] = centre;
        // An input that never varied says nothing; it must not be blown up.
        out->scale[k] = greatest > least && deviation > 0 ? deviation : 1;
        out->weight[k] = 1;
        out->least[k] = least;
        out->greatest[k] = greatest;
    }
}

/// z of every landing.
static void standardise(trainer* t, const bt_surrogate* out) {
    const bt_training_set* set = t->set;
    const int dims = t->dims;
    for (int i = 0; i < set->count; ++i) {
        struct svm_node* node = t->nodes + (size_t)i * (size_t)(dims + 1);
        for (int k = 0; k < dims; ++k) {
            const size_t at = (size_t)i * (size_t)dims + (size_t)k;
            t->z[at] = (set->x[at] - out->centre[k]) / out->scale[k];
            node[k] = (struct svm_node){k + 1, t->z[at]};
        }
        node[dims].index = -1;
    }
}

/* ---- one support-vector machine ---- */

/// Copies what LIBSVM found. Landings of class +1 come first in every problem, so that its first
/// label is +1 and its decision value needs no change of sign.
static bt_status take_model(const struct svm_model* model, int dims, bt_surrogate* out) {
    out->rho = model->rho[0];
    out->sv_count = model->l;
    out->sv = malloc(((size_t)model->l * (size_t)dims + 1) * sizeof *out->sv);
    out->coef = malloc(((size_t)model->l + 1) * sizeof *out->coef);
    if (!out->sv || !out->coef)
        return BT_ERR_MEMORY;
    for (int i = 0; i < model->l; ++i) {
        out->coef[i] = model->sv_coef[0][i];
        for (int k = 0; k < dims; ++k)
            out->sv[i * dims + k] = model->SV[i][k].value;
    }
    return BT_OK;
}

/// Trains on n landings. On BT_OK out->sv and out->coef are the caller's.
static bt_status fit_one(const trainer* t, const int* list, int n, double C, double gamma,
                         double tolerance, bt_surrogate* out) {
    out->dims = t->dims;
    out->C = C;
    out->gamma = gamma;
    int engaged = 0;
    for (int i = 0; i < n; ++i)
        engaged += t->set->label[list[i]] > 0;
    out->constant = engaged == 0 || engaged == n;
    iterations = 0;
    if (out->constant) {
        out->rho = engaged ? -1 : 1;
        out->sv_count = 0;
        return BT_OK;
    }
    struct svm_parameter param = {.svm_type = C_SVC,
                                  .kernel_type = RBF,
                                  .gamma = gamma,
                                  .C = C,
                                  .cache_size = 200,
                                  .eps = tolerance,
                                  .shrinking = 1};
    struct svm_problem problem = {.l = n};
    problem.y = malloc((size_t)n * sizeof *problem.y);
    problem.x = malloc((size_t)n * sizeof *problem.x);
    bt_status status = BT_ERR_MEMORY;
    if (problem.y && problem.x) {
        for (int i = 0; i < n; ++i) {
            problem.y[i] = t->set->label[list[i]];
            problem.x[i] = t->nodes + (size_t)list[i] * (size_t)(t->dims + 1);
        }
        struct svm_model* model = svm_train(&problem, &param);
        status = take_model(model, t->dims, out);
        svm_free_and_destroy_model(&model);
    }
    free(problem.y);
    free(problem.x);
    return status;
}

/// Right answers among n landings in standardised coordinates.
static bt_status count_correct(const trainer* t, const bt_surrogate* machine, const int* list,
                               int n, int confusion[2][2]) {
    bt_predictor* predictor;
    BT_TRY(bt_predictor_create(machine, bt_isa_best(), &predictor));
    memset(confusion, 0, sizeof(int[2][2]));
    for (int i = 0; i < n; ++i) {
        int8_t label;
        bt_predictor_label(predictor, t->z + (size_t)list[i] * (size_t)t->dims, 1, &label, NULL);
        ++confusion[t->set->label[list[i]] > 0][label > 0];
    }
    bt_predictor_destroy(predictor);
    return BT_OK;
}

/// The same machine for points that are standardised already.
static bt_surrogate bare(const bt_surrogate* machine) {
    bt_surrogate copy = *machine;
    for (int k = 0; k < copy.dims; ++k) {
        copy.centre[k] = 0;
        copy.scale[k] = 1;
    }
    return copy;
}

/* ---- model selection ---- */

/// Asks the machine (by its definition, so that no instruction set shows) about n landings.
static bt_status ask(const trainer* t, const bt_surrogate* machine, const int* list, int n,
                     answers* out) {
    double* agreement = malloc((size_t)n * sizeof *agreement);
    if (!agreement)
        return BT_ERR_MEMORY;
    *out = (answers){0};
    for (int i = 0; i < n; ++i) {
        const double f = bt_surrogate_decision(machine, t->z + (size_t)list[i] * (size_t)t->dims);
        agreement[i] = t->set->label[list[i]] * f;
        out->correct += (f > 0) == (t->set->label[list[i]] > 0);
    }
    out->loss = bt_score_loss(agreement, n);
    free(agreement);
    return BT_OK;
}

/// One fold of one cell: trains on the other folds, asks about this one. The i-th landing of each
/// class belongs to fold i modulo the number of folds.
static bt_status run_fold(const trainer* t, const bt_grid_point* cell, int fold, answers* out) {
    const int folds = t->folds, total = t->share[0] + t->share[1];
    int* learn = malloc(2 * ((size_t)total + 1) * sizeof *learn);
    if (!learn)
        return BT_ERR_MEMORY;
    int *test = learn + total + 1, learn_count = 0, test_count = 0;
    for (int class = 0; class < 2; ++class)
        for (int i = 0; i < t->share[class]; ++i) {
            const int index = t->list[(class ? t->train[0] : 0) + i];
            if (i % folds == fold)
                test[test_count++] = index;
            else
                learn[learn_count++] = index;
        }
    bt_surrogate machine = {0};
    bt_status status = BT_OK;
    *out = (answers){0};
    if (learn_count > 0 && test_count > 0) {
        status = fit_one(t, learn, learn_count, cell->C, cell->gamma, compare_tolerance, &machine);
        const bool hard = iterations > most_iterations;
        if (status == BT_OK) {
            const bt_surrogate standard = bare(&machine);
            status = ask(t, &standard, test, test_count, out);
        }
        if (hard)
            out->loss = INFINITY;
    }
    bt_surrogate_destroy(&machine);
    free(learn);
    return status;
}

static void score_cell(trainer* t, int cell, const answers* of_fold) {
    bt_grid_point* c = &t->grid->cell[cell];
    c->correct = 0;
    c->loss = 0;
    for (int fold = 0; fold < t->folds; ++fold) {
        c->correct += of_fold[fold].correct;
        c->loss += of_fold[fold].loss;
    }
    c->trained_on = t->share[0] + t->share[1];
    c->loss /= c->trained_on;
    ++c->round;
}

/// Loss of always naming the share of each class.
static double ignorance(const trainer* t) {
    const double p = (double)t->share[0] / (t->share[0] + t->share[1]);
    return p > 0 && p < 1 ? -p * log(p) - (1 - p) * log1p(-p) : 0;
}

/// First round, one task per gamma: C rises until a step gained next to nothing, once the row has
/// learnt anything at all, or until it is too hard.
static bt_status run_row(void* user, int row, int worker) {
    (void)worker;
    trainer* t = user;
    const int folds = t->folds;
    answers* of_fold = calloc((size_t)folds, sizeof *of_fold);
    bt_status status = of_fold ? BT_OK : BT_ERR_MEMORY;
    const double learnt = (1 - little) * ignorance(t);
    double best = INFINITY;
    bool idle = false;
    for (int column = 0; column < t->columns && !idle && status == BT_OK; ++column) {
        const int cell = row * t->columns + column;
        memset(of_fold, 0, (size_t)folds * sizeof *of_fold);
        bool hard = false;
        for (int fold = 0; fold < folds && status == BT_OK && !hard; ++fold) {
            status = run_fold(t, &t->grid->cell[cell], fold, &of_fold[fold]);
            hard = isinf(of_fold[fold].loss);
        }
        score_cell(t, cell, of_fold);
        const double loss = t->grid->cell[cell].loss;
        idle = hard || (loss > (1 - little) * best && best < learnt);
        best = fmin(best, loss);
    }
    free(of_fold);
    return status;
}

/// Later rounds, one task per cell and fold.
static bt_status run_cell_fold(void* user, int task, int worker) {
    (void)worker;
    trainer* t = user;
    const int folds = t->folds;
    return run_fold(t, &t->grid->cell[t->cell[task / folds]], task % folds, &t->answers[task]);
}

/// Better: not too hard, tried in a later round, less loss, then the smoother machine.
static bool cell_before(const bt_grid_point* a, const bt_grid_point* b) {
    if (isinf(a->loss) != isinf(b->loss))
        return isinf(b->loss);
    if (a->round != b->round)
        return a->round > b->round;
    if (a->loss != b->loss)
        return a->loss < b->loss;
    if (a->C != b->C)
        return a->C < b->C;
    return a->gamma < b->gamma;
}

/// The best `wanted` cells of those tried in the last round, best first, into t->cell.
static void pick_cells(trainer* t, int round, int wanted) {
    t->cells = 0;
    for (int i = 0; i < t->grid->count; ++i) {
        if (t->grid->cell[i].round < round)
            continue;
        int at = t->cells < wanted ? t->cells++ : wanted;
        while (at > 0 && cell_before(&t->grid->cell[i], &t->grid->cell[t->cell[at - 1]])) {
            if (at < wanted)
                t->cell[at] = t->cell[at - 1];
            --at;
        }
        if (at < wanted)
            t->cell[at] = i;
    }
}

/// Takes at most `size` landings for the round, both classes in their proportion, each class with
/// at least two per fold as far as it has them; all of them when hardly more are left over. Returns
/// false when that is not much more than before.
static bool size_round(trainer* t, int size) {
    const int total = t->train[0] + t->train[1], before = t->share[0] + t->share[1];
    for (int class = 0; class < 2; ++class) {
        int share =
            total <= size ? t->train[class] : (int)((double)size * t->train[class] / total + 0.5);
        const int least = 2 * t->folds;
        share = share < least ? least : share;
        t->share[class] = share < t->train[class] ? share : t->train[class];
    }
    return t->share[0] + t->share[1] > before + before / 2;
}

static bt_status later_round(trainer* t) {
    const int folds = t->folds;
    t->answers = calloc((size_t)(t->cells * folds), sizeof *t->answers);
    if (!t->answers)
        return BT_ERR_MEMORY;
    const bt_status status = bt_tasks_run(t->threads, t->cells * folds, run_cell_fold, t);
    for (int i = 0; i < t->cells && status == BT_OK; ++i)
        score_cell(t, t->cell[i], t->answers + i * folds);
    free(t->answers);
    t->answers = NULL;
    return status;
}

static void choose_cell(trainer* t) {
    bt_grid* grid = t->grid;
    grid->best = 0;
    for (int i = 1; i < grid->count; ++i)
        if (cell_before(&grid->cell[i], &grid->cell[grid->best]))
            grid->best = i;
}

/* ---- the weights of the inputs ---- */

/// Copies the landings of the round, weighted, into nodes and z.
static void weigh(const trainer* t, const double* weight, struct svm_node* nodes, double* z) {
    const size_t dims = (size_t)t->dims;
    for (int class = 0; class < 2; ++class)
        for (int i = 0; i < t->share[class]; ++i) {
            const size_t index = (size_t)t->list[(class ? t->train[0] : 0) + i];
            struct svm_node* node = nodes + index * (dims + 1);
            for (size_t k = 0; k < dims; ++k) {
                z[index * dims + k] = weight[k] * t->z[index * dims + k];
                node[k] = (struct svm_node){(int)k + 1, z[index * dims + k]};
            }
            node[dims].index = -1;
        }
}

static bt_status try_weights(void* user, const double* weight, int fold, double* loss) {
    trainer own = *(const trainer*)user;
    const size_t n = (size_t)own.set->count, dims = (size_t)own.dims;
    struct svm_node* nodes = malloc(n * (dims + 1) * sizeof *nodes);
    double* z = malloc(n * dims * sizeof *z);
    bt_status status = BT_ERR_MEMORY;
    if (nodes && z) {
        weigh(&own, weight, nodes, z);
        own.nodes = nodes;
        own.z = z;
        own.folds *= weight_folds;
        answers found;
        status = run_fold(&own, &own.probe, fold, &found);
        *loss = found.loss;
    }
    free(nodes);
    free(z);
    return status;
}

/// The gamma of the grid that is nearest to the probe's, by ratio.
static double probe_gamma_of(const trainer* t) {
    double nearest = t->grid->cell[0].gamma;
    for (int row = 1; row < t->rows; ++row) {
        const double gamma = t->grid->cell[row * t->columns].gamma;
        if (fabs(log(gamma / probe_gamma)) < fabs(log(nearest / probe_gamma)))
            nearest = gamma;
    }
    return nearest;
}

/// Chooses the weights and puts them into the scale.
static bt_status choose_weights(trainer* t, bt_surrogate* out) {
    bool varies[BT_INPUT_MAX];
    for (int k = 0; k < t->dims; ++k)
        varies[k] = out->greatest[k] > out->least[k];
    size_round(t, round_size[0]);
    t->probe = (bt_grid_point){.C = probe_C, .gamma = probe_gamma_of(t)};
    const bt_relevance relevance = {.dims = t->dims,
                                    .folds = weight_folds * t->folds,
                                    .varies = varies,
                                    .threads = t->threads,
                                    .trial = try_weights,
                                    .user = t};
    BT_TRY(bt_relevance_search(&relevance, out->weight));
    for (int k = 0; k < t->dims; ++k)
        out->scale[k] /= out->weight[k];
    t->share[0] = t->share[1] = 0;
    return BT_OK;
}

/* ---- the choice ---- */

static bt_status select_model(trainer* t) {
    size_round(t, round_size[0]);
    if (t->grid->count > 1) {
        BT_TRY(bt_tasks_run(t->threads, t->rows, run_row, t));
        int tried = 0;
        for (int i = 0; i < t->grid->count; ++i)
            tried += t->grid->cell[i].round > 0;
        for (int round = 1; round < ROUNDS; ++round) {
            if (!size_round(t, round_size[round]))
                break;
            pick_cells(t, round, round == ROUNDS - 1 ? FINALISTS : (tried + 2) / 3);
            BT_TRY(later_round(t));
        }
    } else {
        size_round(t, round_size[ROUNDS - 1]);
        t->cell[0] = 0;
        t->cells = 1;
        BT_TRY(later_round(t));
    }
    choose_cell(t);
    return BT_OK;
}

static void lay_grid(trainer* t) {
    const bt_list *C = &t->params->C, *gamma = &t->params->gamma;
    t->columns = C->count ? C->count : (int)(sizeof default_C / sizeof *default_C);
    t->rows = gamma->count ? gamma->count : (int)(sizeof default_gamma / sizeof *default_gamma);
    *t->grid = (bt_grid){.count = t->rows * t->columns};
    for (int row = 0; row < t->rows; ++row)
        for (int column = 0; column < t->columns; ++column) {
            bt_grid_point* cell = &t->grid->cell[row * t->columns + column];
            cell->C = C->count ? C->value[column] : default_C[column];
            cell->gamma = gamma->count ? gamma->value[row] : default_gamma[row];
        }
}

/* ---- the whole ---- */

static bt_status check_set(const bt_training_set* set, bt_diag* diag) {
    if (set->count < 1) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "no landings to train on");
        return BT_ERR_ARG;
    }
    if (set->dims < 1 || set->dims > BT_INPUT_MAX) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%d inputs; a surrogate takes 1 .. %d", set->dims,
                    BT_INPUT_MAX);
        return BT_ERR_ARG;
    }
    for (int i = 0; i < set->count; ++i) {
        bool sound = set->label[i] == 1 || set->label[i] == -1;
        for (int k = 0; k < set->dims; ++k)
            sound = sound && isfinite(set->x[(size_t)i * (size_t)set->dims + (size_t)k]);
        if (!sound) {
            bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                        "training landing %d: an input is not finite, or its label is neither +1 "
                        "nor -1",
                        i);
            return BT_ERR_ARG;
        }
    }
    return BT_OK;
}

/// FNV-1a over dims, count, inputs and labels.
static uint64_t hash_set(const bt_training_set* set) {
    uint64_t hash = 0xcbf29ce484222325u;
#define MIX(data, size)                                                                            \
    for (size_t b = 0; b < (size); ++b)                                                            \
    hash = (hash ^ ((const unsigned char*)(data))[b]) * 0x100000001b3u
    MIX(&set->dims, sizeof set->dims);
    MIX(&set->count, sizeof set->count);
    MIX(set->x, (size_t)set->count * (size_t)set->dims * sizeof *set->x);
    MIX(set->label, (size_t)set->count * sizeof *set->label);
#undef MIX
    return hash;
}

static bt_status score(const trainer* t, bt_surrogate* out) {
    bt_surrogate_scores* s = &out->scores;
    const bt_surrogate standard = bare(out);
    int confusion[2][2];
    s->train_count = t->train[0] + t->train[1];
    BT_TRY(count_correct(t, &standard, t->list, s->train_count, confusion));
    s->train_correct = confusion[0][0] + confusion[1][1];
    s->holdout_count = t->holdout_count;
    BT_TRY(count_correct(t, &standard, t->holdout, t->holdout_count, s->confusion));
    s->holdout_correct = s->confusion[0][0] + s->confusion[1][1];
    s->holdout_ci95 = bt_clopper_pearson(s->holdout_correct, s->holdout_count, 0.95);
    s->cv_count = t->grid->cell[t->grid->best].trained_on;
    s->cv_correct = t->grid->cell[t->grid->best].correct;
    return BT_OK;
}

/// The chosen machine, of everything that was not held out. Should LIBSVM give up nevertheless, a
/// softer one is taken.
static bt_status fit_all(const trainer* t, bt_surrogate* out) {
    const bt_grid_point* best = &t->grid->cell[t->grid->best];
    const int n = t->train[0] + t->train[1];
    BT_TRY(fit_one(t, t->list, n, best->C, best->gamma, final_tolerance, out));
    while ((double)iterations >= fmax(libsvm_iterations, 100.0 * n)) {
        bt_surrogate_destroy(out);
        BT_TRY(fit_one(t, t->list, n, out->C / 10, best->gamma, final_tolerance, out));
    }
    return BT_OK;
}

static bt_status train_split(trainer* t, bt_surrogate* out, bt_diag* diag) {
    lay_grid(t);
    measure(t, out);
    standardise(t, out);
    if (t->train[0] && t->train[1]) {
        BT_TRY(choose_weights(t, out));
        standardise(t, out);
        BT_TRY(select_model(t));
    } else {
        bt_diag_add(diag, BT_WARNING, BT_NOWHERE,
                    "all %d landings were %s; the surrogate is constant and knows no boundary",
                    t->set->count, t->train[0] ? "engaged" : "missed");
    }
    BT_TRY(fit_all(t, out));
    return score(t, out);
}

bt_status bt_surrogate_train(const bt_training_set* set, const bt_surrogate_params* params,
                             uint64_t seed, int threads, bt_surrogate* out, bt_grid* grid,
                             bt_diag* diag) {
    *out = (bt_surrogate){0};
    BT_TRY(check_set(set, diag));
    const double begun_s = now_s();
    svm_set_print_string_function(listen);
    const size_t n = (size_t)set->count, dims = (size_t)set->dims;
    trainer t = {.set = set,
                 .params = params,
                 .threads = threads,
                 .dims = set->dims,
                 .folds = (int)params->folds};
    t.nodes = malloc(n * (dims + 1) * sizeof *t.nodes);
    t.z = malloc(n * dims * sizeof *t.z);
    t.list = malloc(n * sizeof *t.list);
    t.holdout = malloc(n * sizeof *t.holdout);
    t.grid = malloc(sizeof *t.grid);
    bt_status status = BT_ERR_MEMORY;
    if (t.nodes && t.z && t.list && t.holdout && t.grid)
        status = split(&t, seed);
    if (status == BT_OK)
        status = train_split(&t, out, diag);
    if (status == BT_OK) {
        out->training_hash = hash_set(set);
        out->scores.seconds = now_s() - begun_s;
        if (grid)
            *grid = *t.grid;
    } else {
        bt_surrogate_destroy(out);
    }
    free(t.nodes);
    free(t.z);
    free(t.list);
    free(t.holdout);
    free(t.grid);
    return status;
}

void bt_surrogate_destroy(bt_surrogate* surrogate) {
    if (!surrogate)
        return;
    free(surrogate->sv);
    free(surrogate->coef);
    surrogate->sv = surrogate->coef = NULL;
    surrogate->sv_count = 0;
}

double bt_surrogate_decision(const bt_surrogate* surrogate, const double* x) {
    const int dims = surrogate->dims;
    double z[BT_INPUT_MAX], f = 0;
    for (int k = 0; k < dims; ++k)
        z[k] = (x[k] - surrogate->centre[k]) / surrogate->scale[k];
    for (int i = 0; i < surrogate->sv_count; ++i) {
        double square = 0;
        for (int k = 0; k < dims; ++k) {
            const double apart = z[k] - surrogate->sv[i * dims + k];
            square += apart * apart;
        }
        f += surrogate->coef[i] * exp(-surrogate->gamma * square);
    }
    return f - surrogate->rho;
}

static double share(int part, int whole) {
    return whole > 0 ? (double)part / whole : NAN;
}

double bt_surrogate_train_accuracy(const bt_surrogate_scores* scores) {
    return share(scores->train_correct, scores->train_count);
}

double bt_surrogate_holdout_accuracy(const bt_surrogate_scores* scores) {
    return share(scores->holdout_correct, scores->holdout_count);
}
