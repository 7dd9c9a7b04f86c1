#include "report/page_parts.h"

#include "campaign/executor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PICKS = 10, GROUPS = 6 };

/// A landing of the ledger to look at.
typedef struct pick {
    int landing; ///< index; -1: the study's own
    char name[96];
} pick;

typedef struct picks {
    int count;
    pick at[PICKS];
} picks;

static void add(picks* p, int landing, const char* name) {
    for (int i = 0; i < p->count; ++i)
        if (p->at[i].landing == landing)
            return;
    if (p->count == PICKS)
        return;
    p->at[p->count].landing = landing;
    snprintf(p->at[p->count++].name, sizeof p->at[0].name, "%s", name);
}

/// The landing of an outcome whose margin is nearest to a value; -1 when there is none.
static int nearest(const bt_landings* l, bt_outcome outcome, double margin_m) {
    int best = -1;
    for (int i = 0; i < l->count; ++i)
        if (l->outcome[i] == outcome && isfinite(l->margin_m[i]) &&
            (best < 0 || fabs(l->margin_m[i] - margin_m) < fabs(l->margin_m[best] - margin_m)))
            best = i;
    return best;
}

static int by_value(const void* a, const void* b) {
    const double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

/// The landing of a mode whose margin is in the middle of that mode's; -1 when there is none.
static int middle_of(const bt_landings* l, bt_mode mode, double* scratch) {
    int count = 0;
    for (int i = 0; i < l->count; ++i)
        if (l->mode[i] == mode && isfinite(l->margin_m[i]))
            scratch[count++] = l->margin_m[i];
    if (count == 0)
        return -1;
    qsort(scratch, (size_t)count, sizeof *scratch, by_value);
    for (int i = 0; i < l->count; ++i)
        if (l->mode[i] == mode && l->margin_m[i] == scratch[count / 2])
            return i;
    return -1;
}

static void choose(const bt_page* page, picks* p, double* scratch) {
    const bt_landings* l = &page->landings;
    for (int i = 0; i < page->atlas.count && i < GROUPS; ++i) {
        char name[96];
        snprintf(name, sizeof name, "typical miss %d", i + 1);
        add(p, page->atlas.group[i].typical, name);
    }
    const int miss = nearest(l, BT_MISSED, 0), caught = nearest(l, BT_ENGAGED, 0);
    if (miss >= 0)
        add(p, miss, "missed by the least");
    if (caught >= 0)
        add(p, caught, "caught by the least");
    const int direct = middle_of(l, BT_MODE_DIRECT, scratch);
    const int arm = middle_of(l, BT_MODE_ARM, scratch);
    if (direct >= 0)
        add(p, direct, "typical catch, straight");
    if (arm >= 0)
        add(p, arm, "typical catch, by the arm");
}

static bt_status run_playback(const bt_page* page, bt_lander* lander, bt_model_params* model,
                              const pick* chosen, bt_playback* playback,
                              bt_landing_result* result) {
    const bt_landings* l = &page->landings;
    if (chosen->landing < 0)
        return bt_landing_try(lander, model, result, bt_playback_observe, playback);
    const double* x = l->x + (size_t)chosen->landing * (size_t)l->axes.count;
    return bt_landing_at(lander, model, page->subject->study->inputs, &l->axes, x, result,
                         bt_playback_observe, playback);
}

static bt_status record(bt_page* page, bt_lander* lander, const pick* chosen,
                        bt_model_params* model) {
    bt_playback* playback = NULL;
    bt_landing_result result;
    *model = page->subject->study->model;
    BT_TRY(bt_playback_create(BT_PLAYBACK_ROWS_AMONG, BT_PLAYBACK_NODES, &playback));
    bt_status status = run_playback(page, lander, model, chosen, playback, &result);
    const int64_t number = chosen->landing < 0 ? -1 : page->landings.run[chosen->landing];
    if (status == BT_OK)
        status = bt_playback_write(page->json, playback, number, chosen->name, model, &result,
                                   page->diag);
    bt_playback_destroy(playback);
    return status;
}

static bt_status record_all(bt_page* page, const picks* p) {
    bt_lander* lander = NULL;
    bt_model_params* model = malloc(sizeof *model);
    bt_status status = model ? bt_lander_create(&lander) : BT_ERR_MEMORY;
    if (status == BT_OK && page->subject->stop)
        bt_lander_obey(lander, page->subject->stop);
    bt_json_begin_array(page->json, "playback");
    for (int i = 0; i < p->count && status == BT_OK; ++i)
        status = record(page, lander, &p->at[i], model);
    bt_json_end_array(page->json);
    bt_lander_destroy(lander);
    free(model);
    return status;
}

bt_status bt_page_playback_write(bt_page* page) {
    picks p = {0};
    double* scratch = malloc((size_t)(page->landings.count + 1) * sizeof *scratch);
    if (!scratch)
        return BT_ERR_MEMORY;
    choose(page, &p, scratch);
    free(scratch);
    add(&p, -1, "the study's own landing");
    return record_all(page, &p);
}
