#include "reliability/event_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LABELS_MAX = 1000000 }; ///< samples that are kept for the zones

/// What the estimates of one event are made with.
typedef struct family {
    const bt_study* study;
    const bt_pool_rows* rows;
    bt_evidence evidence; ///< labels of the event
    const bt_judged* judged;
    const bt_zones* zones;
    int distance; ///< of the evidence's variables
    int threads;
    double* weight; ///< [landings] scratch
} family;

static bt_event_estimate take(const bt_pooled* pooled, double classifier) {
    return (bt_event_estimate){.probability = pooled->value,
                               .ci95 = pooled->ci95,
                               .sampling = pooled->sampling,
                               .unseen = pooled->unseen,
                               .classifier = classifier};
}

static int judged_count(const bt_judged* j) {
    return j->rounds ? j->begin[j->rounds] - j->begin[0] : 0;
}

/// Without classifiers the landings alone say it; too few for those.
static bt_event_estimate estimate(const family* f, const double* weight, const bt_cut* cut,
                                  int64_t hits, int64_t samples) {
    const bool judged = judged_count(f->judged) > 0;
    const bt_pooled pooled =
        judged ? bt_pooled_estimate(&f->evidence, f->judged->engaged, weight, cut, hits, samples)
               : bt_reweighted_estimate(&f->evidence, weight, cut);
    return take(&pooled, judged ? (double)hits / (double)samples : NAN);
}

static bt_status fill_condition(const family* f, int component, bt_event_estimate* out) {
    const bt_sampler sampler = bt_reliability_sampler(f->study, component - 1);
    const int64_t samples = f->study->reliability.samples;
    int64_t hits = 0;
    if (judged_count(f->judged) > 0)
        BT_TRY(bt_judged_sample(f->judged, &sampler, samples, f->threads, NULL, &hits));
    *out = estimate(f, bt_pool_rows_weight(f->rows, component), &f->rows->cut[component], hits,
                    samples);
    return BT_OK;
}

/* ---- zones ---- */

static bt_interval divided(bt_interval i, double by) {
    return (bt_interval){fmin(1, i.least / by), fmin(1, i.greatest / by)};
}

/// P(event | zone) from P(event and zone).
static void condition_on_zone(bt_event_estimate* e, double share) {
    if (!(share > 0)) {
        *e = (bt_event_estimate){NAN, {0, 1}, NAN, NAN, NAN};
        return;
    }
    e->probability = fmin(1, e->probability / share);
    e->ci95 = divided(e->ci95, share);
    e->sampling /= share;
    e->unseen /= share;
    e->classifier = fmin(1, e->classifier / share); // its share is sampled, that of the zone exact
}

static void fill_zone(const family* f, int zone, int64_t hits, int64_t samples,
                      bt_event_estimate* out) {
    bt_evidence within = f->evidence;
    const double* weight = bt_pool_rows_weight(f->rows, 0);
    for (int i = 0; i < within.count; ++i) {
        const double d = within.x[(size_t)i * (size_t)within.dims + (size_t)f->distance];
        f->weight[i] = bt_zones_find(f->zones, d) == zone ? weight[i] : 0;
    }
    *out = estimate(f, f->weight, &f->rows->cut[0], hits, samples);
    condition_on_zone(out, f->zones->share[zone]);
}

static void count_hits(const bt_zones* zones, const bt_sampler* sampler, const bt_pool* pool,
                       int64_t hits[BT_ZONE_MAX]) {
    double x[BT_INPUT_MAX];
    for (int i = 0; i < pool->count; ++i) {
        if (pool->label[i] <= 0)
            continue;
        bt_sampler_draw(sampler, (uint64_t)i, 1, x);
        ++hits[bt_zones_find(zones, x[zones->input])];
    }
}

static bt_status fill_zones(const family* f, bt_event_estimate* zone) {
    const bt_sampler sampler = bt_reliability_sampler(f->study, -1);
    const int64_t wanted = f->study->reliability.samples;
    bt_pool pool = {.count = (int)(wanted < LABELS_MAX ? wanted : LABELS_MAX)};
    int64_t all, hits[BT_ZONE_MAX] = {0};
    if (f->zones->count == 0)
        return BT_OK;
    pool.label = calloc((size_t)pool.count, sizeof *pool.label);
    bt_status status = pool.label ? BT_OK : BT_ERR_MEMORY;
    if (status == BT_OK && judged_count(f->judged) > 0)
        status = bt_judged_sample(f->judged, &sampler, pool.count, f->threads, &pool, &all);
    if (status == BT_OK)
        count_hits(f->zones, &sampler, &pool, hits);
    for (int k = 0; k < f->zones->count && status == BT_OK; ++k)
        fill_zone(f, k, hits[k], pool.count, &zone[k]);
    free(pool.label);
    return status;
}

/* ---- events ---- */

static void count_disagreements(const family* f, bt_event_row* row) {
    for (int i = 0; i < f->evidence.count; ++i) {
        const int8_t *said = &f->judged->engaged[i], *is = &f->evidence.label[i];
        const bool both = *said >= 0 && *is >= 0;
        row->judged += both;
        row->disagreed += both && *said != *is;
    }
}

static bt_status fill_event(const family* f, bt_event_row* row) {
    count_disagreements(f, row);
    for (int c = 0; c < f->study->condition_count; ++c)
        BT_TRY(fill_condition(f, c + 1, &row->condition[c]));
    BT_TRY(fill_condition(f, 0, &row->overall));
    return fill_zones(f, row->zone);
}

/// Whether two events say the same of every landing (1), or the opposite (-1); else 0.
static int relation(const bt_evidence* a, const bt_evidence* b) {
    bool same = true, opposite = true;
    for (int i = 0; i < a->count; ++i) {
        if ((a->label[i] < 0) != (b->label[i] < 0))
            return 0;
        same = same && a->label[i] == b->label[i];
        opposite = opposite && (a->label[i] < 0 || a->label[i] == 1 - b->label[i]);
    }
    return same ? 1 : opposite ? -1 : 0;
}

static bt_event_estimate opposite_of(bt_event_estimate e) {
    const bt_interval i = e.ci95;
    e.ci95 = (bt_interval){1 - i.greatest, 1 - i.least};
    e.probability = 1 - e.probability;
    e.classifier = 1 - e.classifier;
    return e;
}

/// The numbers of an event that was filled before, or of its opposite.
static void copy_numbers(const bt_event_row* from, bool opposite, bt_event_row* row) {
    bt_event_row made = *from;
    memcpy(made.name, row->name, sizeof made.name);
    memcpy(made.text, row->text, sizeof made.text);
    *row = made;
    if (!opposite)
        return;
    row->overall = opposite_of(made.overall);
    for (int c = 0; c < BT_CONDITION_MAX; ++c)
        row->condition[c] = opposite_of(made.condition[c]);
    for (int k = 0; k < BT_ZONE_MAX; ++k)
        row->zone[k] = opposite_of(made.zone[k]);
}

/// An event that is neither the same as one before nor its opposite: judges the landings anew,
/// unless the event is engagement, which the conditions' own rows have judged.
static bt_status fill_new(family* f, bt_event_row* row, bt_diag* diag) {
    const bt_judged* engaged = f->rows->judged;
    bt_judged* made = NULL;
    if (relation(engaged->evidence, &f->evidence) == 1)
        f->judged = engaged;
    else {
        BT_TRY(bt_judged_create(f->study, &f->evidence, &made, diag));
        f->judged = made;
    }
    const bt_status status = fill_event(f, row);
    bt_judged_destroy(made);
    return status;
}

static bt_status fill(family* f, int k, bt_reliability_result* result, bt_diag* diag) {
    bt_event_row* row = &result->event[k];
    f->evidence = bt_evidence_of_event(f->rows->judged->evidence, k);
    for (int i = 0; i < k; ++i) {
        const bt_evidence before = bt_evidence_of_event(f->rows->judged->evidence, i);
        const int related = relation(&before, &f->evidence);
        if (related) {
            copy_numbers(&result->event[i], related < 0, row);
            return BT_OK;
        }
    }
    return fill_new(f, row, diag);
}

static int distance_of(const bt_judged* judged, const bt_zones* zones) {
    const bt_axes* axes = bt_design_get_axes(judged->design);
    for (int i = 0; i < axes->count; ++i)
        if (axes->input[i] == zones->input)
            return i;
    return 0;
}

bt_status bt_event_rows_fill(const bt_study* study, const bt_pool_rows* rows,
                             const bt_event* events, int count,
                             const bt_reliability_options* options, bt_reliability_result* result,
                             bt_diag* diag) {
    const int landings = rows->judged->evidence->count;
    result->zones = bt_zones_of(study);
    if (landings == 0)
        return BT_OK;
    family f = {.study = study,
                .rows = rows,
                .zones = &result->zones,
                .distance = distance_of(rows->judged, &result->zones),
                .threads = options->threads,
                .weight = malloc((size_t)landings * sizeof *f.weight)};
    bt_status status = f.weight ? BT_OK : BT_ERR_MEMORY;
    for (int k = 0; k < count && status == BT_OK; ++k) {
        memcpy(result->event[k].name, events[k].name, sizeof events[k].name);
        memcpy(result->event[k].text, events[k].text, sizeof events[k].text);
        status = options->stop && atomic_load(options->stop) ? BT_ERR_INTERRUPTED
                                                             : fill(&f, k, result, diag);
        result->event_count += status == BT_OK;
    }
    free(f.weight);
    return status;
}
