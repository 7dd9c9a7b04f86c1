#include "reliability/pool_rows.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A condition of which more than this share lies where the design drew nothing is left to its own
// fresh landings, when there are any.
static const double cut_limit = 0.002;

/* ---- rows ---- */

static int judged_count(const bt_judged* j) {
    return j->rounds ? j->begin[j->rounds] - j->begin[0] : 0;
}

bt_status bt_pool_rows_create(const bt_judged* judged, int conditions, bt_pool_rows** made) {
    bt_pool_rows* p = *made = calloc(1, sizeof *p);
    const size_t n = (size_t)judged->evidence->count + 1;
    if (!p)
        return BT_ERR_MEMORY;
    p->judged = judged;
    p->weight = malloc((size_t)conditions * n * sizeof *p->weight);
    p->law = malloc(sizeof *p->law);
    if (p->weight && p->law) {
        bt_pooled_weigh(judged->mixture, judged->evidence, p->weight);
        return BT_OK;
    }
    bt_pool_rows_destroy(p);
    *made = NULL;
    return BT_ERR_MEMORY;
}

void bt_pool_rows_destroy(bt_pool_rows* rows) {
    if (!rows)
        return;
    free(rows->weight);
    free(rows->law);
    free(rows);
}

const double* bt_pool_rows_weight(const bt_pool_rows* p, int component) {
    return p->weight + (size_t)component * (size_t)p->judged->evidence->count;
}

/// Whether the landings, and not the condition's fresh runs, give the corrected number: decided by
/// the design alone, never by what came out.
static bool carries(const bt_cut* cut, const bt_reliability_row* row) {
    return row->high_fidelity_runs == 0 || cut->cut <= cut_limit;
}

bt_status bt_pool_rows_fill(bt_pool_rows* p, int component, const bt_sampler* sampler,
                            int64_t samples, int threads, bt_reliability_row* row) {
    const bt_judged* j = p->judged;
    const bt_evidence* e = j->evidence;
    const int judged = judged_count(j), all = e->count;
    bt_cut* cut = &p->cut[component];
    const double* weight = bt_pool_rows_weight(p, component);
    if (all == 0)
        return BT_OK;
    bt_pooled_law(j->mixture, j->design, component, j->least, sampler->seed, p->law);
    *cut = bt_pooled_cut(p->law, judged ? judged : all, j->tail);
    const bt_pooled plain = bt_reweighted_estimate(e, weight, cut);
    row->reweighted = plain.value;
    row->reweighted_ci95 = plain.ci95;
    row->effective_landings = plain.effective;
    bt_pooled pooled = plain;
    if (judged) {
        BT_TRY(bt_judged_sample(j, sampler, samples, threads, NULL, &p->hits[component]));
        p->samples = samples;
        pooled = bt_pooled_estimate(e, j->engaged, weight, cut, p->hits[component], samples);
    }
    if (!carries(cut, row))
        return BT_OK;
    row->corrected = pooled.value;
    row->corrected_ci95 = pooled.ci95;
    row->corrected_sampling = pooled.sampling;
    row->corrected_unseen = pooled.unseen;
    row->landings = judged ? judged : all;
    row->pooled = true;
    return BT_OK;
}

/* ---- differences ---- */

/// The limits of a difference of two shares of samples.
static bt_interval apart(const bt_pool_rows* p, int to, int from) {
    const bt_interval a = bt_clopper_pearson(p->hits[to], p->samples, 1 - 2 * p->judged->tail),
                      b = bt_clopper_pearson(p->hits[from], p->samples, 1 - 2 * p->judged->tail);
    const double ma = (double)p->hits[to] / (double)p->samples,
                 mb = (double)p->hits[from] / (double)p->samples;
    return (bt_interval){ma - mb - hypot(ma - a.least, b.greatest - mb),
                         ma - mb + hypot(a.greatest - ma, mb - b.least)};
}

void bt_pool_rows_differ(const bt_pool_rows* p, const bt_study* study,
                         bt_reliability_result* result) {
    const bt_judged* j = p->judged;
    if (!judged_count(j))
        return;
    for (int to = 1; to < study->condition_count; ++to) {
        const int from = to - 1;
        if (study->conditions[to].input != study->conditions[from].input ||
            !result->condition[to].pooled || !result->condition[from].pooled)
            continue;
        const double means = (double)(p->hits[to + 1] - p->hits[from + 1]) / (double)p->samples;
        const bt_pooled d =
            bt_pooled_difference(j->evidence, j->engaged, bt_pool_rows_weight(p, to + 1),
                                 bt_pool_rows_weight(p, from + 1), &p->cut[to + 1],
                                 &p->cut[from + 1], means, apart(p, to + 1, from + 1));
        result->difference[result->difference_count++] =
            (bt_reliability_difference){from, to, d.value, d.ci95};
    }
}

/* ---- widths ---- */

enum { WIDTHS_FROM = 256 }; // landings: below, no interval says anything

/// The last half-widths, as the rows have them.
static void close_curve(const bt_reliability_result* r, bt_width* last) {
    double half[BT_CONDITION_MAX];
    for (int c = 0; c < r->condition_count; ++c)
        half[c] = bt_interval_half(&r->condition[c].corrected_ci95);
    *last = bt_width_over(bt_interval_half(&r->overall.corrected_ci95), half, r->condition_count,
                          last->landings, last->cov);
}

bt_status bt_pool_rows_converge(const bt_pool_rows* p, const bt_study* study,
                                bt_reliability_result* result) {
    const bt_judged* j = p->judged;
    const int count = j->evidence->count;
    bt_widths widths;
    if (!judged_count(j) || !result->overall.pooled)
        return BT_OK;
    BT_TRY(bt_widths_create(study, j->mixture, j->design, j->least, &widths));
    int n = WIDTHS_FROM < count ? WIDTHS_FROM : count;
    while (result->width_count < BT_ROUNDS_MAX) {
        result->width[result->width_count++] =
            bt_width_after(&widths, j->evidence, j->said, p->weight, n);
        if (n == count)
            break;
        const int64_t end = bt_round_end(n);
        n = end < count ? (int)end : count;
    }
    close_curve(result, &result->width[result->width_count - 1]);
    bt_widths_destroy(&widths);
    return BT_OK;
}

/* ---- what the reader must know ---- */

void bt_reliability_note(bt_reliability_result* r, const char* text) {
    if (r->warning_count < BT_WARNING_MAX)
        snprintf(r->warning[r->warning_count++], BT_WARNING_SIZE, "%s", text);
}

static bool overlap(const bt_interval* a, const bt_interval* b) {
    return a->least <= b->greatest && b->least <= a->greatest;
}

/// What the rows that a test picks have in common: how many, and the first.
typedef bool row_test(const bt_reliability_row* row, double error);

static bool surrogate_beyond(const bt_reliability_row* row, double error) {
    (void)error;
    return !isnan(row->corrected) && !overlap(&row->surrogate_ci95, &row->corrected_ci95);
}
static bool columns_apart(const bt_reliability_row* row, double error) {
    (void)error;
    return row->pooled && !isnan(row->reweighted) &&
           !overlap(&row->reweighted_ci95, &row->corrected_ci95);
}
static bool error_exceeds(const bt_reliability_row* row, double error) {
    return error > 1 - row->surrogate || error > row->surrogate;
}
static bool mostly_unknown(const bt_reliability_row* row, double error) {
    (void)error;
    return isnan(row->corrected);
}

static int count_rows(const bt_reliability_result* r, row_test* test, double error) {
    int count = test(&r->overall, error);
    for (int i = 0; i < r->condition_count; ++i)
        count += test(&r->condition[i], error);
    return count;
}

void bt_reliability_warn(const bt_surrogate* surrogate, bt_reliability_result* r) {
    char text[BT_WARNING_SIZE];
    const bt_surrogate_scores* s = &surrogate->scores;
    const int rows = r->condition_count + 1;
    const double error = s->holdout_count > 0
                             ? (double)(s->holdout_count - s->holdout_correct) / s->holdout_count
                             : 1;
    int n = count_rows(r, mostly_unknown, error);
    if (n) {
        snprintf(text, sizeof text,
                 "%d of %d rows have no corrected number: nothing but the surrogate is behind them",
                 n, rows);
        bt_reliability_note(r, text);
    }
    n = count_rows(r, error_exceeds, error);
    if (n) {
        if (s->holdout_count > 0)
            snprintf(text, sizeof text,
                     "the surrogate errs on %.2f %% of held-out landings, more than the rarer "
                     "outcome has in %d of %d rows: it cannot carry those numbers, the corrected "
                     "ones can",
                     100 * error, n, rows);
        else
            snprintf(text, sizeof text,
                     "the surrogate's error is not known: no landing was held out");
        bt_reliability_note(r, text);
    }
    n = count_rows(r, surrogate_beyond, error);
    if (n) {
        snprintf(text, sizeof text,
                 "the surrogate alone disagrees with the corrected number in %d of %d rows (their "
                 "intervals do not meet)",
                 n, rows);
        bt_reliability_note(r, text);
    }
    n = count_rows(r, columns_apart, error);
    if (n) {
        snprintf(text, sizeof text,
                 "reweighted and corrected numbers disagree in %d of %d rows: with 95 %% intervals "
                 "that is rare; look for a change of the model between landings",
                 n, rows);
        bt_reliability_note(r, text);
    }
}
