#include "pipeline/flip.h"

#include "reliability/classifier.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SCAN = 8, BISECTIONS = 9, ASKED = 128 };
static const double BEYOND = 1.25, BEYOND_SD = 0.25; ///< of where the surrogate changes its answer

/// One input, changed one way. Places are distances from the landing, in standard deviations.
typedef struct direction {
    bt_flip flip;
    double sign, sd;   ///< sd: SI
    double from, far;  ///< the part that is scanned
    double same;       ///< farthest place before the flip with the landing's outcome
    bool asked[SCAN];  ///< landings of a scan that have another outcome
    bt_flip met[SCAN]; ///< what they ended as
} direction;

/// A landing to be run: a place of a direction.
typedef struct place {
    int direction, index;
    double at;
} place;

typedef struct search {
    const bt_flip_search* given;
    bt_axes axes;
    int count;
    direction direction[BT_FLIP_MAX];
    int place_count, next;
    place place[BT_FLIP_MAX * SCAN];
    int landings;
} search;

// --- lengths ------------------------------------------------------------------------------------

/// Standard deviation of a distribution, from its quantiles at the middles of equal parts.
static double spread(const bt_distribution* d) {
    enum { PARTS = 2048 };
    if (d->kind == BT_NORMAL || d->kind == BT_LOGNORMAL)
        return d->sd;
    double mean = 0, squares = 0;
    for (int i = 0; i < PARTS; ++i)
        mean += bt_distribution_quantile(d, (i + 0.5) / PARTS) / PARTS;
    for (int i = 0; i < PARTS; ++i)
        squares += pow(bt_distribution_quantile(d, (i + 0.5) / PARTS) - mean, 2) / PARTS;
    return sqrt(squares);
}

static double length_of(const bt_input* input) {
    return input->random ? spread(&input->distribution) : (input->upper - input->lower) / sqrt(12);
}

/// How far the distribution reaches from a value inside it, in standard deviations.
static double reach(const bt_input* input, double x, double step) {
    const bt_distribution* d = &input->distribution;
    double inside = 0, outside = BT_FLIP_REACH_SD;
    if (!input->random || !isfinite(bt_distribution_log_density(d, x)) ||
        isfinite(bt_distribution_log_density(d, x + outside * step)))
        return outside;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (inside + outside);
        if (isfinite(bt_distribution_log_density(d, x + middle * step)))
            inside = middle;
        else
            outside = middle;
    }
    return inside;
}

static void add_direction(search* s, int axis, double sign) {
    const bt_input* input = &s->given->study->inputs[s->axes.input[axis]];
    const double sd = length_of(input), x = s->given->x[axis];
    if (!(sd > 0))
        return;
    const double most = reach(input, x, sign * sd);
    if (!(most > 1e-6))
        return;
    s->direction[s->count++] =
        (direction){.flip = {.axis = axis, .change_sd = NAN, .value = NAN, .reach_sd = most},
                    .sign = sign,
                    .sd = sd,
                    .far = most};
}

static double value_at(const search* s, const direction* d, double at) {
    return s->given->x[d->flip.axis] + d->sign * at * d->sd;
}

// --- what the surrogate says --------------------------------------------------------------------

/// Sets out to scan only a little beyond where the surrogate gives another outcome than the
/// landing had.
static void ask_along(const search* s, const bt_classifier* classifier, direction* d) {
    const bt_study* study = s->given->study;
    double x[ASKED * BT_INPUT_MAX];
    int8_t label[ASKED];
    float decision[ASKED];
    for (int i = 0; i < ASKED; ++i) {
        double* point = x + (size_t)i * (size_t)study->input_count;
        for (int k = 0; k < study->input_count; ++k)
            point[k] = bt_field_get(study->inputs[k].field, &study->model, study->inputs[k].offset);
        for (int k = 0; k < s->axes.count; ++k)
            point[s->axes.input[k]] = s->given->x[k];
        point[s->axes.input[d->flip.axis]] = value_at(s, d, d->flip.reach_sd * (i + 1) / ASKED);
    }
    classifier->classify(classifier->user, x, ASKED, label, decision);
    for (int i = 0; i < ASKED; ++i)
        if ((label[i] > 0) != (s->given->outcome == BT_ENGAGED)) {
            d->far = fmin(d->far, BEYOND * d->flip.reach_sd * (i + 1) / ASKED + BEYOND_SD);
            return;
        }
}

static bt_status ask(search* s, bt_diag* diag) {
    bt_surrogate_classifier* made = NULL;
    if (!s->given->surrogate)
        return BT_OK;
    BT_TRY(bt_surrogate_classifier_create(s->given->study, s->given->surrogate, &made, diag));
    const bt_classifier classifier = *bt_surrogate_classifier_get(made);
    for (int i = 0; i < s->count; ++i)
        ask_along(s, &classifier, &s->direction[i]);
    bt_surrogate_classifier_destroy(made);
    return BT_OK;
}

// --- what landings say --------------------------------------------------------------------------

static bool give(void* user, bt_job* job) {
    search* s = user;
    if (s->next == s->place_count)
        return false;
    const place* p = &s->place[s->next];
    const direction* d = &s->direction[p->direction];
    job->run = s->next++;
    memcpy(job->x, s->given->x, (size_t)s->axes.count * sizeof *job->x);
    job->x[d->flip.axis] = value_at(s, d, p->at);
    return true;
}

static bt_status take(void* user, const bt_job* job, const bt_landing_result* result) {
    search* s = user;
    const place* p = &s->place[job->run];
    direction* d = &s->direction[p->direction];
    d->asked[p->index] = result->outcome != BT_FAILED && result->outcome != s->given->outcome;
    d->met[p->index] = d->flip;
    d->met[p->index].change_sd = d->sign * p->at;
    d->met[p->index].value = job->x[d->flip.axis];
    d->met[p->index].outcome = result->outcome;
    d->met[p->index].mode = result->mode;
    d->met[p->index].margin_m = result->margin_m;
    ++s->landings;
    return BT_OK;
}

static void want(search* s, int direction_index, int index, double at) {
    s->place[s->place_count++] = (place){direction_index, index, at};
}

static bt_status run(search* s, bt_diag* diag) {
    const bt_study* study = s->given->study;
    s->next = 0;
    const bt_executor executor = {.model = &study->model,
                                  .inputs = study->inputs,
                                  .axes = &s->axes,
                                  .threads = (int)study->campaign.threads,
                                  .stop = s->given->stop,
                                  .source = give,
                                  .sink = take,
                                  .user = s};
    const bt_status status = s->place_count > 0 ? bt_executor_run(&executor, diag) : BT_OK;
    s->place_count = 0;
    return status;
}

static double scan_place(const direction* d, int k) {
    return d->from + (d->far - d->from) * (k + 1) / SCAN;
}

/// Notes a landing with another outcome, and how near one with the same was.
static void found(direction* d, const bt_flip* met, double same) {
    d->flip = *met;
    d->flip.found = true;
    d->same = same;
    d->flip.width_sd = fabs(met->change_sd) - same;
}

static bt_status scan(search* s, bt_diag* diag) {
    for (int i = 0; i < s->count; ++i)
        for (int k = 0; k < SCAN && !s->direction[i].flip.found; ++k)
            want(s, i, k, scan_place(&s->direction[i], k));
    bool wanted[BT_FLIP_MAX];
    for (int i = 0; i < s->count; ++i)
        wanted[i] = !s->direction[i].flip.found;
    BT_TRY(run(s, diag));
    for (int i = 0; i < s->count; ++i) {
        direction* d = &s->direction[i];
        int k = 0;
        while (wanted[i] && k < SCAN && !d->asked[k])
            ++k;
        if (wanted[i] && k < SCAN)
            found(d, &d->met[k], k > 0 ? scan_place(d, k - 1) : d->from);
    }
    return BT_OK;
}

/// Beyond where the surrogate sent us in vain.
static bt_status scan_further(search* s, bt_diag* diag) {
    bool any = false;
    for (int i = 0; i < s->count; ++i) {
        direction* d = &s->direction[i];
        if (d->flip.found || d->far >= d->flip.reach_sd)
            continue;
        d->from = d->far;
        d->far = d->flip.reach_sd;
        any = true;
    }
    return any ? scan(s, diag) : BT_OK;
}

static bt_status bisect(search* s, bt_diag* diag) {
    for (int i = 0; i < s->count; ++i) {
        const direction* d = &s->direction[i];
        if (d->flip.found)
            want(s, i, 0, 0.5 * (d->same + fabs(d->flip.change_sd)));
    }
    BT_TRY(run(s, diag));
    for (int i = 0; i < s->count; ++i) {
        direction* d = &s->direction[i];
        if (!d->flip.found)
            continue;
        if (d->asked[0])
            found(d, &d->met[0], d->same);
        else {
            d->same = 0.5 * (d->same + fabs(d->flip.change_sd));
            d->flip.width_sd = fabs(d->flip.change_sd) - d->same;
        }
    }
    return BT_OK;
}

static int nearest_first(const void* a, const void* b) {
    const bt_flip *f = a, *g = b;
    const double x = f->found ? fabs(f->change_sd) : INFINITY,
                 y = g->found ? fabs(g->change_sd) : INFINITY;
    return x != y ? (x > y) - (x < y) : (f->axis > g->axis) - (f->axis < g->axis);
}

static bt_status find(search* s, bt_flips* flips, bt_diag* diag) {
    for (int axis = 0; axis < s->axes.count; ++axis) {
        add_direction(s, axis, -1);
        add_direction(s, axis, 1);
    }
    BT_TRY(ask(s, diag));
    BT_TRY(scan(s, diag));
    BT_TRY(scan_further(s, diag));
    for (int i = 0; i < BISECTIONS; ++i)
        BT_TRY(bisect(s, diag));
    flips->count = s->count;
    flips->landings = s->landings;
    for (int i = 0; i < s->count; ++i)
        flips->at[i] = s->direction[i].flip;
    qsort(flips->at, (size_t)flips->count, sizeof flips->at[0], nearest_first);
    return BT_OK;
}

bt_status bt_flips_find(const bt_flip_search* given, bt_flips* flips, bt_diag* diag) {
    *flips = (bt_flips){0};
    search* s = calloc(1, sizeof *s);
    if (!s)
        return BT_ERR_MEMORY;
    s->given = given;
    s->axes = bt_design_axes(given->study);
    const bt_status status = find(s, flips, diag);
    free(s);
    return status;
}
