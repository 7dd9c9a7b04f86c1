#include "base/threads.h"
#include "surrogate/loss.h"
#include "surrogate/relevance.h"
#include "surrogate/training.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The rounds of model selection: on how many landings, and how many grid points go on to the next.
enum { ROUNDS = 3, FINALISTS = 3 };
static const int round_size[ROUNDS] = {2000, 6000, 16000};

// LIBSVM's stopping tolerance on the slopes of the dual, where the margin is 1. While grid points
// are only compared a tenth of a margin does: it moves the share of right answers by a tenth of its
// standard error and saves nine tenths of the time at large C.
static const double compare_tolerance = 0.1;

// Where the weights of the inputs are compared: wide and stiff, so that a narrow band is followed
// by the weights and not by a narrow kernel. The nearest values of the grid are taken.
static const double probe_C = 1000, probe_gamma = 0.1;

// The weights are compared with so many times the folds of the grid: the more a fold learns from,
// the finer the structure that it can see, as the classifier in the end will.
enum { weight_folds = 2 };

// A row of the grid is left when a step gained less than this share of the loss (loss.h).
static const double little = 0.01;

// A fold that takes more iterations than this is too hard: the next round's landings, or the final
// tolerance, would bring it near to LIBSVM's limit.
static const long most_iterations = 1000000;

static const double default_C[] = {1, 10, 100, 1e3, 1e4, 1e5};
static const double default_gamma[] = {0.1, 0.3, 1, 3, 10};

/// How a classifier did on landings that it had not learnt from.
typedef struct scores {
    int correct;
    double loss; ///< sum (loss.h); INFINITY: the training took too many iterations
} scores;

typedef struct selection {
    bt_training data;
    int threads, folds;
    bt_grid* grid;
    int rows, columns;   ///< gammas, Cs
    bt_grid_point probe; ///< where the weights of the inputs are compared
    // of the round
    int point[BT_GRID_MAX], points, share[2]; ///< grid points to try, landings of each class
    scores* scores;                           ///< [points * folds]
} selection;

/* ---- cross-validation ---- */

/// Scores the classifier (by its definition, so that no instruction set shows) on n landings.
static bt_status predict(const bt_training* t, const bt_surrogate* classifier, const int* list,
                         int n, scores* out) {
    double* margin = malloc((size_t)n * sizeof *margin);
    if (!margin)
        return BT_ERR_MEMORY;
    *out = (scores){0};
    for (int i = 0; i < n; ++i) {
        const double f =
            bt_surrogate_decision(classifier, t->z + (size_t)list[i] * (size_t)t->dims);
        margin[i] = t->set->label[list[i]] * f;
        out->correct += (f > 0) == (t->set->label[list[i]] > 0);
    }
    out->loss = bt_score_loss(margin, n);
    free(margin);
    return BT_OK;
}

/// One fold of one grid point: trains on the other folds, predicts this one. The i-th landing of
/// each class belongs to fold i modulo the number of folds.
static bt_status run_fold(const selection* s, const bt_grid_point* point, int fold, scores* out) {
    const bt_training* t = &s->data;
    const int folds = s->folds, total = s->share[0] + s->share[1];
    int* learn = malloc(2 * ((size_t)total + 1) * sizeof *learn);
    if (!learn)
        return BT_ERR_MEMORY;
    int *test = learn + total + 1, learn_count = 0, test_count = 0;
    for (int class = 0; class < 2; ++class)
        for (int i = 0; i < s->share[class]; ++i) {
            const int index = t->list[(class ? t->train[0] : 0) + i];
            if (i % folds == fold)
                test[test_count++] = index;
            else
                learn[learn_count++] = index;
        }
    bt_surrogate classifier = {0};
    bt_svm_effort effort;
    bt_status status = BT_OK;
    *out = (scores){0};
    if (learn_count > 0 && test_count > 0) {
        status = bt_svm_train(t, learn, learn_count, point->C, point->gamma, compare_tolerance,
                              &classifier, &effort);
        if (status == BT_OK)
            status = predict(t, &classifier, test, test_count, out);
        if (status == BT_OK && effort.iterations > most_iterations)
            out->loss = INFINITY;
    }
    bt_surrogate_destroy(&classifier);
    free(learn);
    return status;
}

static void score_point(selection* s, int point, const scores* of_fold) {
    bt_grid_point* p = &s->grid->point[point];
    p->correct = 0;
    p->loss = 0;
    for (int fold = 0; fold < s->folds; ++fold) {
        p->correct += of_fold[fold].correct;
        p->loss += of_fold[fold].loss;
    }
    p->trained_on = s->share[0] + s->share[1];
    p->loss /= p->trained_on;
    ++p->round;
}

/// Loss of always naming the share of each class.
static double baseline_entropy(const selection* s) {
    const double p = (double)s->share[0] / (s->share[0] + s->share[1]);
    return p > 0 && p < 1 ? -p * log(p) - (1 - p) * log1p(-p) : 0;
}

/* ---- the rounds of the grid ---- */

/// First round, one task per gamma: C rises until a step gained next to nothing, once the row has
/// learnt anything at all, or until it is too hard.
static bt_status run_row(void* user, int row, int worker) {
    (void)worker;
    selection* s = user;
    const int folds = s->folds;
    scores* of_fold = calloc((size_t)folds, sizeof *of_fold);
    bt_status status = of_fold ? BT_OK : BT_ERR_MEMORY;
    const double learnt = (1 - little) * baseline_entropy(s);
    double best = INFINITY;
    bool idle = false;
    for (int column = 0; column < s->columns && !idle && status == BT_OK; ++column) {
        const int point = row * s->columns + column;
        memset(of_fold, 0, (size_t)folds * sizeof *of_fold);
        bool hard = false;
        for (int fold = 0; fold < folds && status == BT_OK && !hard; ++fold) {
            status = run_fold(s, &s->grid->point[point], fold, &of_fold[fold]);
            hard = isinf(of_fold[fold].loss);
        }
        score_point(s, point, of_fold);
        const double loss = s->grid->point[point].loss;
        idle = hard || (loss > (1 - little) * best && best < learnt);
        best = fmin(best, loss);
    }
    free(of_fold);
    return status;
}

/// Later rounds, one task per grid point and fold.
static bt_status run_point_fold(void* user, int task, int worker) {
    (void)worker;
    selection* s = user;
    const int folds = s->folds;
    return run_fold(s, &s->grid->point[s->point[task / folds]], task % folds, &s->scores[task]);
}

/// Better: not too hard, tried in a later round, less loss, then the smoother classifier.
static bool point_before(const bt_grid_point* a, const bt_grid_point* b) {
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

/// The best `wanted` points of those tried in the last round, best first, into s->point.
static void pick_points(selection* s, int round, int wanted) {
    s->points = 0;
    for (int i = 0; i < s->grid->count; ++i) {
        if (s->grid->point[i].round < round)
            continue;
        int at = s->points < wanted ? s->points++ : wanted;
        while (at > 0 && point_before(&s->grid->point[i], &s->grid->point[s->point[at - 1]])) {
            if (at < wanted)
                s->point[at] = s->point[at - 1];
            --at;
        }
        if (at < wanted)
            s->point[at] = i;
    }
}

/// Takes at most `size` landings for the round, both classes in their proportion, each class with
/// at least two per fold as far as it has them; all of them when hardly more are left over. Returns
/// false when that is not much more than before.
static bool size_round(selection* s, int size) {
    const int* train = s->data.train;
    const int total = train[0] + train[1], before = s->share[0] + s->share[1];
    for (int class = 0; class < 2; ++class) {
        int share = total <= size ? train[class] : (int)((double)size * train[class] / total + 0.5);
        const int least = 2 * s->folds;
        share = share < least ? least : share;
        s->share[class] = share < train[class] ? share : train[class];
    }
    return s->share[0] + s->share[1] > before + before / 2;
}

static bt_status later_round(selection* s) {
    const int folds = s->folds;
    s->scores = calloc((size_t)(s->points * folds), sizeof *s->scores);
    if (!s->scores)
        return BT_ERR_MEMORY;
    const bt_status status = bt_tasks_run(s->threads, s->points * folds, run_point_fold, s);
    for (int i = 0; i < s->points && status == BT_OK; ++i)
        score_point(s, s->point[i], s->scores + i * folds);
    free(s->scores);
    s->scores = NULL;
    return status;
}

static void choose_point(bt_grid* grid) {
    grid->best = 0;
    for (int i = 1; i < grid->count; ++i)
        if (point_before(&grid->point[i], &grid->point[grid->best]))
            grid->best = i;
}

static bt_status search_grid(selection* s) {
    size_round(s, round_size[0]);
    if (s->grid->count > 1) {
        BT_TRY(bt_tasks_run(s->threads, s->rows, run_row, s));
        int tried = 0;
        for (int i = 0; i < s->grid->count; ++i)
            tried += s->grid->point[i].round > 0;
        for (int round = 1; round < ROUNDS; ++round) {
            if (!size_round(s, round_size[round]))
                break;
            pick_points(s, round, round == ROUNDS - 1 ? FINALISTS : (tried + 2) / 3);
            BT_TRY(later_round(s));
        }
    } else {
        size_round(s, round_size[ROUNDS - 1]);
        s->point[0] = 0;
        s->points = 1;
        BT_TRY(later_round(s));
    }
    choose_point(s->grid);
    return BT_OK;
}

static void lay_grid(selection* s, const bt_surrogate_params* params) {
    const bt_list *C = &params->C, *gamma = &params->gamma;
    s->columns = C->count ? C->count : (int)(sizeof default_C / sizeof *default_C);
    s->rows = gamma->count ? gamma->count : (int)(sizeof default_gamma / sizeof *default_gamma);
    *s->grid = (bt_grid){.count = s->rows * s->columns};
    for (int row = 0; row < s->rows; ++row)
        for (int column = 0; column < s->columns; ++column) {
            bt_grid_point* point = &s->grid->point[row * s->columns + column];
            point->C = C->count ? C->value[column] : default_C[column];
            point->gamma = gamma->count ? gamma->value[row] : default_gamma[row];
        }
}

/* ---- the weights of the inputs ---- */

/// Copies the landings of the round, weighted, into nodes and z.
static void weigh(const selection* s, const double* weight, struct svm_node* nodes, double* z) {
    const bt_training* t = &s->data;
    const size_t dims = (size_t)t->dims;
    for (int class = 0; class < 2; ++class)
        for (int i = 0; i < s->share[class]; ++i) {
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
    selection own = *(const selection*)user;
    const size_t n = (size_t)own.data.set->count, dims = (size_t)own.data.dims;
    struct svm_node* nodes = malloc(n * (dims + 1) * sizeof *nodes);
    double* z = malloc(n * dims * sizeof *z);
    bt_status status = BT_ERR_MEMORY;
    if (nodes && z) {
        weigh(&own, weight, nodes, z);
        own.data.nodes = nodes;
        own.data.z = z;
        own.folds *= weight_folds;
        scores found;
        status = run_fold(&own, &own.probe, fold, &found);
        *loss = found.loss;
    }
    free(nodes);
    free(z);
    return status;
}

/// Of two values the one that is nearer to the wanted one, by ratio; the first when equal.
static double nearest(double found, double wanted, double value) {
    return fabs(log(value / wanted)) < fabs(log(found / wanted)) ? value : found;
}

static bt_grid_point place_probe(const selection* s) {
    bt_grid_point probe = s->grid->point[0];
    for (int i = 1; i < s->grid->count; ++i) {
        probe.C = nearest(probe.C, probe_C, s->grid->point[i].C);
        probe.gamma = nearest(probe.gamma, probe_gamma, s->grid->point[i].gamma);
    }
    return probe;
}

/// Chooses the weights and applies them to the landings.
static bt_status choose_weights(selection* s, double* weight) {
    bool varies[BT_INPUT_MAX];
    for (int k = 0; k < s->data.dims; ++k)
        varies[k] = s->data.greatest[k] > s->data.least[k];
    size_round(s, round_size[0]);
    s->probe = place_probe(s);
    const bt_relevance relevance = {.dims = s->data.dims,
                                    .folds = weight_folds * s->folds,
                                    .varies = varies,
                                    .threads = s->threads,
                                    .trial = try_weights,
                                    .user = s};
    BT_TRY(bt_relevance_search(&relevance, weight));
    bt_training_weigh(&s->data, weight);
    s->share[0] = s->share[1] = 0;
    return BT_OK;
}

/* ---- the whole ---- */

static bt_status select_on(selection* s, const bt_surrogate_params* params,
                           bt_hyperparameters* out) {
    lay_grid(s, params);
    for (int k = 0; k < s->data.dims; ++k)
        out->weight[k] = 1;
    if (s->data.train[0] && s->data.train[1]) {
        BT_TRY(choose_weights(s, out->weight));
        BT_TRY(search_grid(s));
    }
    const bt_grid_point* best = &s->grid->point[s->grid->best];
    out->C = best->C;
    out->gamma = best->gamma;
    out->cv_count = best->trained_on;
    out->cv_correct = best->correct;
    return BT_OK;
}

bt_status bt_surrogate_select(const bt_training_set* set, const bt_surrogate_params* params,
                              double holdout, uint64_t seed, int threads, bt_hyperparameters* out,
                              bt_grid* grid, bt_diag* diag) {
    *out = (bt_hyperparameters){0};
    selection s = {.threads = threads, .folds = (int)params->folds};
    bt_status status = bt_training_create(set, holdout, seed, &s.data, diag);
    s.grid = malloc(sizeof *s.grid);
    if (status == BT_OK)
        status = s.grid ? select_on(&s, params, out) : BT_ERR_MEMORY;
    if (status == BT_OK && grid)
        *grid = *s.grid;
    free(s.grid);
    bt_training_destroy(&s.data);
    return status;
}
