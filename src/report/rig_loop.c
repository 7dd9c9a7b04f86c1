#include "report/rig_loop.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GRID = 1000 };

/// Stroke and load, row by row, borrowed.
typedef struct trace {
    const double *stroke, *force;
    int count;
} trace;

/// One way of a loop: load over a stroke that never decreases.
typedef struct branch {
    double *stroke, *force; ///< owned
    int count;
} branch;

static int deepest(const trace* t) {
    int deepest = 0;
    for (int i = 1; i < t->count; ++i)
        if (t->stroke[i] > t->stroke[deepest])
            deepest = i;
    return deepest;
}

static bt_loop summary(const trace* t) {
    const int last = deepest(t);
    bt_loop loop = {.stroke_max_m = t->stroke[last]};
    for (int i = 0; i <= last; ++i)
        loop.force_max_N = fmax(loop.force_max_N, t->force[i]);
    for (int i = 0; i < last; ++i)
        loop.energy_J += 0.5 * (t->force[i] + t->force[i + 1]) * (t->stroke[i + 1] - t->stroke[i]);
    loop.efficiency = loop.energy_J / (loop.force_max_N * loop.stroke_max_m);
    return loop;
}

/// The rows from `from` in steps of `step` to `to`, those left out that go back: what noise does to
/// a recorded stroke. False: out of memory.
static bool take_branch(const trace* t, int from, int to, int step, branch* b) {
    const size_t room = (size_t)abs(to - from) + 1;
    b->count = 0;
    b->stroke = malloc(room * sizeof *b->stroke);
    b->force = malloc(room * sizeof *b->force);
    if (!b->stroke || !b->force)
        return false;
    for (int i = from;; i += step) {
        if (b->count == 0 || t->stroke[i] > b->stroke[b->count - 1]) {
            b->stroke[b->count] = t->stroke[i];
            b->force[b->count++] = t->force[i];
        }
        if (i == to)
            return true;
    }
}

static void drop_branch(branch* b) {
    free(b->stroke);
    free(b->force);
}

/// Load at a stroke; 0 where the branch does not go.
static double load_at(const branch* b, double stroke, int* row) {
    if (stroke < b->stroke[0] || stroke > b->stroke[b->count - 1])
        return 0;
    while (*row + 2 < b->count && b->stroke[*row + 1] < stroke)
        ++*row;
    const int i = *row;
    if (b->count < 2)
        return b->force[0];
    const double share = (stroke - b->stroke[i]) / (b->stroke[i + 1] - b->stroke[i]);
    return b->force[i] + share * (b->force[i + 1] - b->force[i]);
}

/// Integral of |F_a - F_b| over the stroke that both cover from below, to where the further ends.
static double area_between(const branch* a, const branch* b) {
    const double least = fmax(a->stroke[0], b->stroke[0]);
    const double most = fmax(a->stroke[a->count - 1], b->stroke[b->count - 1]);
    int row_a = 0, row_b = 0;
    double sum = 0;
    for (int k = 0; k < GRID && most > least; ++k) {
        const double stroke = least + (k + 0.5) / GRID * (most - least);
        sum += fabs(load_at(a, stroke, &row_a) - load_at(b, stroke, &row_b));
    }
    return sum * (most - least) / GRID;
}

/// The area between one way of two loops, `in` or out; NAN when out of memory.
static double way_area(const trace* a, const trace* b, bool in) {
    branch first = {0}, second = {0};
    double area = NAN;
    const int a_deep = deepest(a), b_deep = deepest(b);
    // the way out is taken from its end, so that the stroke grows
    if (take_branch(a, in ? 0 : a->count - 1, a_deep, in ? 1 : -1, &first) &&
        take_branch(b, in ? 0 : b->count - 1, b_deep, in ? 1 : -1, &second))
        area = area_between(&first, &second);
    drop_branch(&first);
    drop_branch(&second);
    return area;
}

static bool is_channel(const bt_rig_record* record, int column, const char* name) {
    return strcmp(record->names[column], name) == 0;
}

/// The measured load over stroke among the curves.
static bool find_measured(const bt_rig_record* record, bt_measured* const* measured, int count,
                          trace* t) {
    const bt_measured *stroke = NULL, *force = NULL;
    for (int i = 0; i < count; ++i) {
        const bt_measured* m = measured[i];
        const bool load = is_channel(record, m->y_column, "strut_force_N");
        if (load && is_channel(record, m->x_column, "stroke_m")) {
            *t = (trace){m->x, m->y, m->count};
            return true;
        }
        if (is_channel(record, m->x_column, "time_s") && load)
            force = m;
        if (is_channel(record, m->x_column, "time_s") &&
            is_channel(record, m->y_column, "stroke_m"))
            stroke = m;
    }
    if (!stroke || !force || strcmp(stroke->file, force->file) != 0 ||
        stroke->count != force->count ||
        memcmp(stroke->x, force->x, (size_t)stroke->count * sizeof *stroke->x) != 0)
        return false;
    *t = (trace){stroke->y, force->y, stroke->count};
    return true;
}

static bool find_computed(const bt_rig_record* record, trace* t) {
    *t = (trace){.count = record->count};
    for (int i = 0; i < record->column_count; ++i) {
        if (is_channel(record, i, "stroke_m"))
            t->stroke = record->columns[i];
        if (is_channel(record, i, "strut_force_N"))
            t->force = record->columns[i];
    }
    return t->stroke && t->force && t->count > 1;
}

bool bt_rig_loop_score(const bt_rig_record* record, bt_measured* const* measured, int count,
                       bt_loop_score* score) {
    trace there, here;
    const bool drop = record->kind == BT_RIG_NOSE_DROP || record->kind == BT_RIG_MAIN_DROP;
    if (!drop || !find_measured(record, measured, count, &there) || !find_computed(record, &here))
        return false;
    score->measured = summary(&there);
    score->computed = summary(&here);
    const double area = way_area(&there, &here, true) + way_area(&there, &here, false);
    score->area_share = area / score->measured.energy_J;
    return isfinite(score->area_share);
}
