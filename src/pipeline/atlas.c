#include "pipeline/atlas.h"

#include "statistics/weighted.h"

#include <math.h>
#include <stdlib.h>

enum { BINS = 16, MEDOID_MOST = 1500 };
static const double TAIL = 0.025;

/// A value and what it weighs.
typedef struct sample {
    double value, weight;
} sample;

/// Misses of one kind being sorted, and memory for it.
typedef struct sorter {
    const bt_landings* l;
    bt_atlas* atlas;
    double* all;        ///< [landings] one input in rising order
    sample* some;       ///< [landings] the same of a group
    int *member, *part; ///< [landings] indices: of a mode, of a group
    double deviation[BT_INPUT_MAX];
} sorter;

static int by_value(const void* a, const void* b) {
    const double x = *(const double*)a, y = *(const double*)b; // of a sample: its first member
    return (x > y) - (x < y);
}

static void sort_all(const sorter* s, int axis) {
    for (int i = 0; i < s->l->count; ++i)
        s->all[i] = bt_landings_x(s->l, i, axis);
    qsort(s->all, (size_t)s->l->count, sizeof *s->all, by_value);
}

static void sort_some(const sorter* s, const int* member, int count, int axis) {
    for (int i = 0; i < count; ++i)
        s->some[i] =
            (sample){bt_landings_x(s->l, member[i], axis), fmax(s->l->weight[member[i]], 1e-300)};
    qsort(s->some, (size_t)count, sizeof *s->some, by_value);
}

/// Largest distance between the distribution functions of some and of all (Kolmogorov, Smirnov).
static double distance(const sorter* s, int n) {
    const int m = s->l->count;
    double most = 0;
    for (int i = 0, j = 0; i < n; ++i) {
        while (j < m && s->all[j] <= s->some[i].value)
            ++j;
        most = fmax(most, fabs((double)(i + 1) / n - (double)j / m));
        most = fmax(most, fabs((double)i / n - (double)j / m));
    }
    return most;
}

static int telling_axis(const sorter* s, int count) {
    int best = 0;
    double most = -1;
    for (int axis = 0; axis < s->l->axes.count; ++axis) {
        sort_all(s, axis);
        sort_some(s, s->member, count, axis);
        const double apart = distance(s, count);
        if (apart > most) {
            most = apart;
            best = axis;
        }
    }
    return best;
}

/// The value of sorted samples below which a share of their weight lies.
static double quantile(const sample* sorted, int count, double share) {
    double total = 0, sum = 0;
    for (int i = 0; i < count; ++i)
        total += sorted[i].weight;
    for (int i = 0; i < count; ++i) {
        sum += sorted[i].weight;
        if (sum >= share * total)
            return sorted[i].value;
    }
    return sorted[count - 1].value;
}

// --- the typical landing ------------------------------------------------------------------------

static void find_deviations(sorter* s) {
    const int n = s->l->count;
    for (int axis = 0; axis < s->l->axes.count; ++axis) {
        double sum = 0, squares = 0;
        for (int i = 0; i < n; ++i)
            sum += bt_landings_x(s->l, i, axis) / n;
        for (int i = 0; i < n; ++i)
            squares += pow(bt_landings_x(s->l, i, axis) - sum, 2) / n;
        s->deviation[axis] = fmax(sqrt(squares), 1e-300);
    }
}

static double apart(const sorter* s, int a, int b) {
    double sum = 0;
    for (int axis = 0; axis < s->l->axes.count; ++axis)
        sum += pow(
            (bt_landings_x(s->l, a, axis) - bt_landings_x(s->l, b, axis)) / s->deviation[axis], 2);
    return sqrt(sum);
}

/// The medoid; of more than MEDOID_MOST members, that of evenly chosen ones.
static int medoid(const sorter* s, int count) {
    const int every = 1 + (count - 1) / MEDOID_MOST;
    double least = INFINITY;
    int best = s->part[0];
    for (int i = 0; i < count; i += every) {
        double sum = 0;
        for (int j = 0; j < count && sum < least; j += every)
            sum += s->l->weight[s->part[j]] * apart(s, s->part[i], s->part[j]);
        if (sum < least) {
            least = sum;
            best = s->part[i];
        }
    }
    return best;
}

// --- groups -------------------------------------------------------------------------------------

static void count_weight(bt_weighted_count* c, double v) {
    c->sum += v;
    c->square += v * v;
}

static bt_interval limits(const bt_weighted_count* c) {
    return (bt_interval){bt_weighted_lower(c, TAIL), fmin(1, bt_weighted_upper(c, TAIL))};
}

/// Labelled landings, and the greatest weight among them over their number.
static int labelled(const bt_landings* l, double* greatest) {
    int n = 0;
    double most = 0;
    for (int i = 0; i < l->count; ++i)
        if (l->outcome[i] != BT_FAILED) {
            ++n;
            most = fmax(most, l->weight[i]);
        }
    *greatest = n > 0 ? most / n : 0;
    return n;
}

static void add_group(sorter* s, const bt_miss_group* kind, int axis, int count) {
    bt_atlas* a = s->atlas;
    if (count == 0 || a->count == BT_MISS_GROUP_MAX)
        return;
    bt_miss_group* g = &a->group[a->count++];
    bt_weighted_count weight = {0};
    const int n = labelled(s->l, &weight.greatest);
    *g = *kind;
    g->axis = axis;
    g->count = count;
    g->typical = medoid(s, count);
    for (int i = 0; i < count; ++i)
        count_weight(&weight, s->l->weight[s->part[i]] / n);
    g->probability = weight.sum;
    g->ci95 = limits(&weight);
    sort_some(s, s->part, count, axis);
    g->least = quantile(s->some, count, 0.05);
    g->greatest = quantile(s->some, count, 0.95);
}

/// The bin that parts the misses in two: the emptiest one between two peaks, when it holds less
/// than half of either. -1: they are one group.
static int valley(const int bin[BINS], int first, int last) {
    int best = -1;
    for (int k = first + 1; k < last; ++k) {
        int left = 0, right = 0;
        for (int i = first; i < k; ++i)
            left = bin[i] > left ? bin[i] : left;
        for (int i = k + 1; i <= last; ++i)
            right = bin[i] > right ? bin[i] : right;
        const int lower = left < right ? left : right;
        if (lower >= 8 && 2 * bin[k] < lower && (best < 0 || bin[k] < bin[best]))
            best = k;
    }
    return best;
}

static void group_kind(sorter* s, const bt_miss_group* kind, int count) {
    const bt_landings* l = s->l;
    const int axis = telling_axis(s, count);
    sort_all(s, axis);
    const double from = s->all[0], width = fmax(s->all[l->count - 1] - from, 1e-300) / BINS;
    int bin[BINS] = {0}, begin = 0;
    for (int i = 0; i < count; ++i) {
        const int k = (int)((bt_landings_x(l, s->member[i], axis) - from) / width);
        ++bin[k < BINS ? k : BINS - 1];
    }
    while (begin < BINS) {
        const int cut = valley(bin, begin, BINS - 1);
        const int end = cut < 0 ? BINS : cut;
        int part = 0;
        for (int i = 0; i < count; ++i) {
            const double at = (bt_landings_x(l, s->member[i], axis) - from) / width;
            if ((at >= begin || begin == 0) && (at < end || end == BINS))
                s->part[part++] = s->member[i];
        }
        add_group(s, kind, axis, part);
        begin = end;
    }
}

static void sort_kind(sorter* s, const bt_miss_group* kind) {
    const bt_landings* l = s->l;
    int count = 0;
    for (int i = 0; i < l->count; ++i)
        if (l->outcome[i] == BT_MISSED && l->mode[i] == kind->mode &&
            l->bounced[i] == kind->bounced)
            s->member[count++] = i;
    if (count > 0)
        group_kind(s, kind, count);
}

static int larger_first(const void* a, const void* b) {
    const double x = ((const bt_miss_group*)a)->probability,
                 y = ((const bt_miss_group*)b)->probability;
    return (x < y) - (x > y);
}

static void sort_misses(sorter* s) {
    bt_atlas* a = s->atlas;
    bt_weighted_count missed = {0};
    const int n = labelled(s->l, &missed.greatest);
    find_deviations(s);
    for (int i = 0; i < s->l->count; ++i)
        if (s->l->outcome[i] == BT_MISSED)
            count_weight(&missed, s->l->weight[i] / n);
    a->missed = missed.sum;
    a->missed_ci95 = limits(&missed);
    for (int mode = 0; mode < BT_MODE_COUNT; ++mode)
        for (int bounced = 0; bounced < 2; ++bounced)
            sort_kind(s, &(bt_miss_group){.mode = (bt_mode)mode, .bounced = bounced});
    for (int i = 0; i < a->count; ++i)
        a->group[i].share = a->missed > 0 ? a->group[i].probability / a->missed : 0;
    qsort(a->group, (size_t)a->count, sizeof a->group[0], larger_first);
}

bt_status bt_atlas_make(const bt_landings* landings, bt_atlas* atlas) {
    const size_t n = (size_t)landings->count + 1;
    sorter s = {.l = landings,
                .atlas = atlas,
                .all = malloc(n * sizeof *s.all),
                .some = malloc(n * sizeof *s.some),
                .member = malloc(n * sizeof *s.member),
                .part = malloc(n * sizeof *s.part)};
    const bool there = s.all && s.some && s.member && s.part;
    *atlas = (bt_atlas){.missed_ci95 = {0, 1}};
    if (there && landings->count > 0)
        sort_misses(&s);
    free(s.all);
    free(s.some);
    free(s.member);
    free(s.part);
    return there ? BT_OK : BT_ERR_MEMORY;
}
