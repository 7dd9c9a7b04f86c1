#include "calibration/evaluate.h"

#include "base/threads.h"
#include "calibration/simulated_case.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

bool bt_target_is_one_sided(const bt_target* target) {
    return target->kind == BT_TARGET_AT_MOST || target->kind == BT_TARGET_AT_LEAST ||
           target->kind == BT_TARGET_INCREASING || target->kind == BT_TARGET_DECREASING;
}

/// What one thread needs for its runs.
typedef struct scratch {
    bt_lander* lander;
    bt_parameter_set set;
} scratch;

/// What the threads share: each run writes what is its own.
typedef struct shared {
    const bt_calibration* calibration;
    const double* u;
    int run_count;  ///< points times simulated cases
    double* metric; ///< [run_count][BT_CASE_METRIC_MAX]
    double* rows;   ///< rows of curves receive what the model did
    const atomic_int* stop;
    scratch* scratch; ///< [threads]
    pthread_mutex_t lock;
    bt_diag* diag; ///< used under the lock
} shared;

static void report(void* user, bt_severity severity, bt_where where, const char* text) {
    shared* s = user;
    pthread_mutex_lock(&s->lock);
    bt_diag_add(s->diag, severity, where, "%s", text);
    pthread_mutex_unlock(&s->lock);
}

// --- one run ----------------------------------------------------------------------------------

/// The base with the parameters of a point and the overrides of a simulated case.
static void prepare(const bt_calibration* c, const double* u, const bt_simulated_case* simulated,
                    bt_parameter_set* set) {
    *set = c->base;
    for (int i = 0; i < c->parameter_count; ++i) {
        const bt_parameter* p = &c->parameters[i];
        bt_field_set(p->field, set, p->offset, p->lower + u[i] * (p->upper - p->lower));
    }
    for (int i = 0; i < simulated->override_count; ++i)
        bt_field_set(simulated->overrides[i].field, set, simulated->overrides[i].offset,
                     simulated->overrides[i].value);
}

/// The curves that are measured on a simulated case, with the rows their values go to.
static int find_curves(const bt_calibration* c, int index, double* rows, bt_followed* followed) {
    int count = 0;
    for (int i = 0; i < c->target_count; ++i) {
        const bt_target* target = &c->targets[i];
        if (target->kind == BT_TARGET_CURVE && target->cases[0] == index)
            followed[count++] = (bt_followed){target->measured, rows + target->first_row};
    }
    return count;
}

static bt_status run_one(void* user, int run, int worker) {
    shared* s = user;
    if (s->stop && atomic_load(s->stop) != 0)
        return BT_ERR_INTERRUPTED;
    const bt_calibration* c = s->calibration;
    const int point = run / c->case_count, index = run % c->case_count;
    const bt_simulated_case* simulated = &c->cases[index];
    bt_diag diag = {.sink = report, .user = s};
    bt_parameter_set* set = &s->scratch[worker].set;
    bt_followed followed[BT_TARGET_MAX];
    double* metric = s->metric + (size_t)run * BT_CASE_METRIC_MAX;
    const int count =
        find_curves(c, index, s->rows + (size_t)point * (size_t)c->row_count, followed);
    prepare(c, s->u + (size_t)point * (size_t)c->parameter_count, simulated, set);
    bt_status status = bt_parameter_set_check(set, bt_simulated_case_part(simulated->kind), &diag);
    if (status == BT_OK)
        status = bt_simulated_case_run(s->scratch[worker].lander, simulated->kind, set, metric,
                                       followed, count, &diag);
    if (status != BT_ERR_INPUT)
        return status;
    // parameters that do not go together: no value, like a run that diverged
    bt_simulated_case_void(metric, followed, count);
    return BT_OK;
}

static bt_status run_all(shared* s) {
    const int threads = bt_thread_count(s->calibration->threads);
    s->scratch = calloc((size_t)threads, sizeof *s->scratch);
    bt_status status = s->scratch ? BT_OK : BT_ERR_MEMORY;
    for (int i = 0; i < threads && status == BT_OK; ++i) {
        status = bt_lander_create(&s->scratch[i].lander);
        if (status == BT_OK)
            bt_lander_obey(s->scratch[i].lander, s->stop);
    }
    pthread_mutex_init(&s->lock, NULL);
    if (status == BT_OK)
        status = bt_tasks_run(threads, s->run_count, run_one, s);
    pthread_mutex_destroy(&s->lock);
    for (int i = 0; s->scratch && i < threads; ++i)
        bt_lander_destroy(s->scratch[i].lander);
    free(s->scratch);
    return status;
}

// --- residuals --------------------------------------------------------------------------------

/// One residual of a trend, from two neighbours; of a constant, from the first value and this.
static double trend_row(const bt_target* t, double before, double here) {
    const double tolerance = t->relative ? t->tolerance * fabs(before) : t->tolerance;
    const double change = here - before;
    if (t->kind == BT_TARGET_CONSTANT)
        return change / tolerance;
    return 1 - (t->kind == BT_TARGET_INCREASING ? change : -change) / tolerance;
}

static double single_row(const bt_target* t, double got) {
    const double tolerance = t->relative ? t->tolerance * fabs(t->wanted) : t->tolerance;
    return (t->kind == BT_TARGET_AT_LEAST ? t->wanted - got : got - t->wanted) / tolerance;
}

/// Turns what the model did into residuals; returns the root mean square difference, SI.
static double curve_rows(const bt_target* t, double* rows) {
    double largest = 0, squares = 0;
    for (int i = 0; i < t->row_count; ++i)
        largest = fmax(largest, fabs(t->measured->y[i]));
    const double tolerance = t->relative ? t->tolerance * largest : t->tolerance;
    for (int i = 0; i < t->row_count; ++i) {
        rows[i] -= t->measured->y[i];
        squares += rows[i] * rows[i];
        rows[i] /= tolerance;
    }
    return sqrt(squares / t->row_count);
}

static double target_rows(const bt_target* t, const double* metric, double* rows) {
    if (t->kind == BT_TARGET_CURVE)
        return curve_rows(t, rows);
    double value[BT_LIST_MAX];
    for (int i = 0; i < t->case_count; ++i)
        value[i] = metric[t->cases[i] * BT_CASE_METRIC_MAX + t->metric];
    if (t->case_count == 1) {
        rows[0] = single_row(t, value[0]);
        return value[0];
    }
    for (int i = 1; i < t->case_count; ++i)
        rows[i - 1] = trend_row(t, value[t->kind == BT_TARGET_CONSTANT ? 0 : i - 1], value[i]);
    return value[t->case_count - 1];
}

static void all_rows(const shared* s, int points, double* got) {
    const bt_calibration* c = s->calibration;
    for (int p = 0; p < points; ++p) {
        const double* metric = s->metric + (size_t)p * (size_t)c->case_count * BT_CASE_METRIC_MAX;
        double* rows = s->rows + (size_t)p * (size_t)c->row_count;
        for (int i = 0; i < c->target_count; ++i) {
            const double value =
                target_rows(&c->targets[i], metric, rows + c->targets[i].first_row);
            if (got)
                got[p * c->target_count + i] = value;
        }
    }
}

bt_status bt_calibration_evaluate(const bt_calibration* calibration, const double* u, int points,
                                  const atomic_int* stop, double* rows, double* got,
                                  bt_diag* diag) {
    shared s = {.calibration = calibration,
                .u = u,
                .run_count = points * calibration->case_count,
                .rows = rows,
                .stop = stop,
                .diag = diag};
    s.metric = calloc((size_t)s.run_count, BT_CASE_METRIC_MAX * sizeof *s.metric);
    if (!s.metric)
        return BT_ERR_MEMORY;
    const bt_status status = run_all(&s);
    if (status == BT_OK)
        all_rows(&s, points, got);
    free(s.metric);
    return status;
}
