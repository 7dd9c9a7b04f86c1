#include "report/page_parts.h"

#include <math.h>
#include <stdlib.h>

/// Misses of one mode, in or after the first bounce, sorted out: grouped along the input whose
/// distribution among them differs most from that among all landings, cut where a part of its range
/// holds few of them.
enum { BINS = 16 };

static double coordinate(const bt_page_landings* l, int landing, int axis) {
    return l->x[(size_t)landing * (size_t)l->axes.count + (size_t)axis];
}

static int by_value(const void* a, const void* b) {
    const double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

/// One axis of some landings in rising order.
static void sorted(const bt_page_landings* l, const int* member, int count, int axis, double* out) {
    for (int i = 0; i < count; ++i)
        out[i] = coordinate(l, member ? member[i] : i, axis);
    qsort(out, (size_t)count, sizeof *out, by_value);
}

/// Largest distance between two distribution functions (Kolmogorov and Smirnov).
static double distance(const double* a, int n, const double* b, int m) {
    double most = 0;
    for (int i = 0, j = 0; i < n; ++i) {
        while (j < m && b[j] <= a[i])
            ++j;
        most = fmax(most, fabs((double)(i + 1) / n - (double)j / m));
        most = fmax(most, fabs((double)i / n - (double)j / m));
    }
    return most;
}

/// Memory for sorting: all landings, those of a mode, and indices.
typedef struct scratch {
    double *all, *some;
    int *member, *part;
} scratch;

static int telling_axis(const bt_page_landings* l, const scratch* s, int count) {
    int best = 0;
    double most = -1;
    for (int axis = 0; axis < l->axes.count; ++axis) {
        sorted(l, NULL, l->count, axis, s->all);
        sorted(l, s->member, count, axis, s->some);
        const double apart = distance(s->some, count, s->all, l->count);
        if (apart > most) {
            most = apart;
            best = axis;
        }
    }
    return best;
}

/// The member nearest to the middle of its group, every input measured by its range.
static int typical(const bt_page_landings* l, const scratch* s, const int* member, int count) {
    double middle[BT_INPUT_MAX], range[BT_INPUT_MAX], least = INFINITY;
    int best = member[0];
    for (int axis = 0; axis < l->axes.count; ++axis) {
        sorted(l, member, count, axis, s->some);
        middle[axis] = s->some[count / 2];
        sorted(l, NULL, l->count, axis, s->all);
        range[axis] = fmax(s->all[l->count - 1] - s->all[0], 1e-300);
    }
    for (int i = 0; i < count; ++i) {
        double sum = 0;
        for (int axis = 0; axis < l->axes.count; ++axis)
            sum += pow((coordinate(l, member[i], axis) - middle[axis]) / range[axis], 2);
        if (sum < least) {
            least = sum;
            best = member[i];
        }
    }
    return best;
}

static void add_group(bt_page* page, const scratch* s, const bt_miss_group* kind, int axis,
                      int count) {
    const bt_page_landings* l = &page->landings;
    if (count == 0 || page->group_count == BT_MISS_GROUP_MAX)
        return;
    bt_miss_group* g = &page->group[page->group_count++];
    *g = *kind;
    g->axis = axis;
    g->count = count;
    g->typical = typical(l, s, s->part, count);
    sorted(l, s->part, count, axis, s->some);
    g->least = s->some[count / 20];
    g->greatest = s->some[count - 1 - count / 20];
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

static void group_kind(bt_page* page, const scratch* s, const bt_miss_group* kind, int count) {
    const bt_page_landings* l = &page->landings;
    const int axis = telling_axis(l, s, count);
    sorted(l, NULL, l->count, axis, s->all);
    const double from = s->all[0], width = fmax(s->all[l->count - 1] - from, 1e-300) / BINS;
    int bin[BINS] = {0}, begin = 0;
    for (int i = 0; i < count; ++i) {
        const int k = (int)((coordinate(l, s->member[i], axis) - from) / width);
        ++bin[k < BINS ? k : BINS - 1];
    }
    while (begin < BINS) {
        const int cut = valley(bin, begin, BINS - 1);
        const int end = cut < 0 ? BINS : cut;
        int part = 0;
        for (int i = 0; i < count; ++i) {
            const double at = (coordinate(l, s->member[i], axis) - from) / width;
            if ((at >= begin || begin == 0) && (at < end || end == BINS))
                s->part[part++] = s->member[i];
        }
        add_group(page, s, kind, axis, part);
        begin = end;
    }
}

static int larger_first(const void* a, const void* b) {
    return ((const bt_miss_group*)b)->count - ((const bt_miss_group*)a)->count;
}

static void find_kind(bt_page* page, const scratch* s, const bt_miss_group* kind) {
    const bt_page_landings* l = &page->landings;
    int count = 0;
    for (int i = 0; i < l->count; ++i)
        if (l->outcome[i] == BT_MISSED && l->mode[i] == kind->mode &&
            l->bounced[i] == kind->bounced)
            s->member[count++] = i;
    if (count > 0)
        group_kind(page, s, kind, count);
}

static void find(bt_page* page, const scratch* s) {
    for (int mode = 0; mode < BT_MODE_COUNT; ++mode)
        for (int bounced = 0; bounced < 2; ++bounced)
            find_kind(page, s, &(bt_miss_group){.mode = (bt_mode)mode, .bounced = bounced});
    qsort(page->group, (size_t)page->group_count, sizeof page->group[0], larger_first);
}

bt_status bt_page_atlas_find(bt_page* page) {
    const size_t n = (size_t)page->landings.count + 1;
    const scratch s = {malloc(n * sizeof *s.all), malloc(n * sizeof *s.some),
                       malloc(n * sizeof *s.member), malloc(n * sizeof *s.part)};
    const bool there = s.all && s.some && s.member && s.part;
    if (there && page->landings.count > 0)
        find(page, &s);
    free(s.all);
    free(s.some);
    free(s.member);
    free(s.part);
    return there ? BT_OK : BT_ERR_MEMORY;
}

void bt_page_atlas_write(bt_page* page) {
    const bt_page_landings* l = &page->landings;
    int missed = 0;
    for (int i = 0; i < page->group_count; ++i)
        missed += page->group[i].count;
    bt_json_begin_array(page->json, "atlas");
    for (int i = 0; i < page->group_count; ++i) {
        const bt_miss_group* g = &page->group[i];
        const bt_input* input = &page->subject->study->inputs[l->axes.input[g->axis]];
        char label[BT_PATH_MAX], region[BT_PATH_MAX + 64];
        double factor;
        const char* unit = bt_display_unit(input->field, &factor);
        bt_display_label(input->path, label, sizeof label);
        snprintf(region, sizeof region, "%s; %s %.3g to %.3g %s",
                 g->bounced ? "after the first bounce" : "in or before the first bounce", label,
                 factor * g->least, factor * g->greatest, unit);
        bt_json_begin_object(page->json, NULL);
        bt_json_string(page->json, "mode", bt_mode_name(g->mode));
        bt_json_string(page->json, "region", region);
        bt_json_integer(page->json, "count", g->count);
        bt_json_number(page->json, "share", (double)g->count / missed);
        bt_json_integer(page->json, "run", l->run[g->typical]);
        bt_json_end_object(page->json);
    }
    bt_json_end_array(page->json);
}
