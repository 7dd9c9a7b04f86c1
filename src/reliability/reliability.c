#include "reliability/event_rows.h"

#include "reliability/stop.h"

#include "base/clock.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { POOL_MAX = 1000000 };

/* ---- one condition ---- */

/// Makes the planned high-fidelity runs and counts them into their strata.
static bt_status run_high_fidelity(const bt_sampler* sampler, const bt_pool* pool, bt_check* check,
                                   bt_high_fidelity_batch* high_fidelity, void* user) {
    const size_t n = (size_t)check->picked_count, dims = (size_t)sampler->dims;
    double* x = malloc((n * dims + 1) * sizeof *x);
    int* label = malloc((n + 1) * sizeof *label);
    bt_status status = x && label ? BT_OK : BT_ERR_MEMORY;
    for (size_t i = 0; i < n && status == BT_OK; ++i)
        bt_sampler_draw(sampler, (uint64_t)check->picked[i], 1, x + i * dims);
    if (status == BT_OK)
        status = high_fidelity(user, x, check->picked_count, label);
    for (size_t i = 0; i < n && status == BT_OK; ++i) {
        const int8_t said = pool->label[check->picked[i]];
        bt_stratum* s =
            &check->stratum[bt_check_stratum(check, said, pool->decision[check->picked[i]])];
        ++s->runs;
        s->failed += label[i] < 0;
        s->disagreed += label[i] >= 0 && label[i] != (said > 0);
    }
    free(x);
    free(label);
    return status;
}

static void fill_from_tally(bt_reliability_row* row, const bt_tally* t) {
    const double n = (double)t->samples;
    row->samples = t->samples;
    row->engaged = t->engaged;
    row->surrogate = (double)t->engaged / n;
    row->surrogate_ci95 = bt_clopper_pearson(t->engaged, t->samples, 0.95);
    row->outside_share = (double)t->outside / n;
    row->outside_ci95 = bt_clopper_pearson(t->outside, t->samples, 0.95);
    row->outside_missed = (double)(t->engaged - t->outside_engaged) / n;
    row->outside_engaged = (double)(t->engaged - t->outside_engaged + t->outside) / n;
}

static void fill_from_check(bt_reliability_row* row, const bt_check* check) {
    memcpy(row->stratum, check->stratum, sizeof row->stratum);
    for (int k = 0; k < BT_STRATA; ++k) {
        row->high_fidelity_runs += check->stratum[k].runs;
        row->high_fidelity_failed += check->stratum[k].failed;
        row->disagreements += check->stratum[k].disagreed;
    }
    const bt_check_result r = bt_check_estimate(check->stratum);
    row->disagreement = r.disagreement;
    row->disagreement_ci95 = r.disagreement_ci95;
    row->landings = row->high_fidelity_runs;
    row->corrected = r.corrected;
    row->corrected_ci95 = r.corrected_ci95;
    row->corrected_sampling = 0.5 * (r.corrected_ci95.greatest - r.corrected_ci95.least);
}

/// Everything but the name of the condition.
static void clear_row(bt_reliability_row* row) {
    const bt_reliability_row before = *row;
    memset(row, 0, sizeof *row);
    memcpy(row->parameter, before.parameter, sizeof row->parameter);
    row->unit = before.unit;
    row->value = before.value;
    row->disagreement = row->corrected = row->reweighted = NAN;
    row->corrected_sampling = row->corrected_unseen = row->effective_landings = NAN;
    row->reweighted_ci95 = (bt_interval){NAN, NAN};
    row->disagreement_ci95 = row->corrected_ci95 = (bt_interval){NAN, NAN};
}

bt_status bt_reliability_condition(const bt_sampler* sampler, const bt_classifier* classifier,
                                   int64_t samples, int threads,
                                   bt_high_fidelity_batch* high_fidelity, void* high_fidelity_user,
                                   int high_fidelity_runs, double expected_error,
                                   bt_reliability_row* row) {
    const double begun_s = bt_clock_s();
    clear_row(row);
    const bool checked = high_fidelity && high_fidelity_runs > 0;
    bt_pool pool = {.count = samples < POOL_MAX ? (int)samples : POOL_MAX};
    bt_check check = {0};
    bt_tally tally;
    bt_status status = BT_OK;
    if (checked) {
        pool.label = malloc((size_t)pool.count * sizeof *pool.label);
        pool.decision = malloc((size_t)pool.count * sizeof *pool.decision);
        status = pool.label && pool.decision ? BT_OK : BT_ERR_MEMORY;
    }
    if (status == BT_OK)
        status =
            bt_monte_carlo(sampler, classifier, samples, threads, checked ? &pool : NULL, &tally);
    if (status == BT_OK)
        fill_from_tally(row, &tally);
    if (status == BT_OK && checked) {
        status = bt_check_plan(&pool, high_fidelity_runs, expected_error, sampler->seed,
                               sampler->stream, &check);
        if (status == BT_OK)
            status = run_high_fidelity(sampler, &pool, &check, high_fidelity, high_fidelity_user);
        if (status == BT_OK)
            fill_from_check(row, &check);
    }
    free(check.picked);
    free(pool.label);
    free(pool.decision);
    row->seconds = bt_clock_s() - begun_s;
    return status;
}

/* ---- the study ---- */

bt_sampler bt_reliability_sampler(const bt_study* study, int condition) {
    bt_sampler sampler = {.dims = study->input_count,
                          .copula = &study->copula,
                          .seed = (uint64_t)study->reliability.seed,
                          .stream = (uint32_t)(condition + 1)};
    const bt_condition* moved = condition >= 0 ? &study->conditions[condition] : NULL;
    for (int i = 0; i < study->input_count; ++i) {
        const bt_input* input = &study->inputs[i];
        bt_distribution d = input->distribution;
        if (!input->random)
            d = (bt_distribution){.kind = BT_CONSTANT,
                                  .mean = bt_field_get(input->field, &study->model, input->offset)};
        if (moved && moved->input == i)
            d = bt_distribution_moved(&d, moved->mean);
        else if (moved && study->reliability.others == BT_OTHERS_FROZEN)
            d = (bt_distribution){.kind = BT_CONSTANT, .mean = bt_distribution_mean(&d)};
        sampler.distribution[i] = d;
    }
    return sampler;
}

/// The hold-out error of the surrogate, never quite zero: where to look for disagreements.
static double expected_error(const bt_surrogate* surrogate) {
    const bt_surrogate_scores* s = &surrogate->scores;
    if (s->holdout_count <= 0)
        return 0.05;
    return (s->holdout_count - s->holdout_correct + 0.5) / (s->holdout_count + 1.0);
}

/// What an evaluation of a study holds on to.
typedef struct evaluation {
    const bt_study* study;
    const bt_surrogate* surrogate;
    const bt_reliability_options* options;
    bt_surrogate_classifier* classifier;
    bt_pool_rows* pool; ///< NULL: no landings
} evaluation;

static void name_row(const bt_study* study, int condition, bt_reliability_row* row) {
    row->unit = "";
    row->value = NAN;
    if (condition < 0)
        return;
    const bt_input* input = &study->inputs[study->conditions[condition].input];
    memcpy(row->parameter, input->path, sizeof row->parameter);
    row->unit = input->field->unit;
    row->value = study->conditions[condition].mean;
}

/// The row of a condition; -1 is the study as it stands.
static bt_status evaluate(const evaluation* e, int condition, bt_reliability_row* row) {
    const bt_reliability_params* params = &e->study->reliability;
    const bt_reliability_options* o = e->options;
    const int runs =
        params->high_fidelity_runs < POOL_MAX ? (int)params->high_fidelity_runs : POOL_MAX;
    const bt_sampler sampler = bt_reliability_sampler(e->study, condition);
    if (o->stop && atomic_load(o->stop))
        return BT_ERR_INTERRUPTED;
    name_row(e->study, condition, row);
    BT_TRY(bt_reliability_condition(
        &sampler, bt_surrogate_classifier_get(e->classifier), params->samples, o->threads,
        o->high_fidelity, o->high_fidelity_user, runs, expected_error(e->surrogate), row));
    return e->pool ? bt_pool_rows_fill(e->pool, condition + 1, &sampler, params->samples,
                                       o->threads, row)
                   : BT_OK;
}

static bt_reliability_classifier describe(const bt_surrogate* s) {
    bt_reliability_classifier c = {.holdout_accuracy = bt_surrogate_holdout_accuracy(&s->scores),
                                   .holdout_count = s->scores.holdout_count,
                                   .support_vectors = s->sv_count,
                                   .C = s->C,
                                   .gamma = s->gamma};
    for (int k = 0; k < s->dims; ++k)
        c.features = c.features || strncmp(s->path[k], "feature.", 8) == 0;
    return c;
}

/// A width that was asked for and is not there: what was reached.
static void note_stop(const bt_study* study, bt_reliability_result* r) {
    char text[BT_WARNING_SIZE];
    if (!bt_stop_wanted(study))
        return;
    if (r->width_count == 0) {
        bt_reliability_note(r, "no landing was judged: the width that was asked for is not known");
        return;
    }
    const bt_width* last = &r->width[r->width_count - 1];
    if (bt_stop_reached(study, last))
        return;
    const double widest = fmax(last->largest, last->overall);
    if (study->reliability.half_width > 0 && !(widest <= study->reliability.half_width)) {
        snprintf(text, sizeof text,
                 "half-width %.3g asked for, %.3g reached with %lld landings (median %.3g); "
                 "campaign.max_landings allows no more",
                 study->reliability.half_width, widest, (long long)last->landings, last->median);
        bt_reliability_note(r, text);
    }
    if (study->reliability.cov > 0 && !(last->cov <= study->reliability.cov)) {
        snprintf(text, sizeof text,
                 "coefficient of variation %.3g asked for, %.3g reached with %lld landings; "
                 "campaign.max_landings allows no more",
                 study->reliability.cov, last->cov, (long long)last->landings);
        bt_reliability_note(r, text);
    }
}

static bt_status evaluate_all(const evaluation* e, bt_reliability_result* result, bt_diag* diag) {
    const int total = e->study->condition_count + 1;
    const bt_reliability_options* o = e->options;
    for (int c = 0; c < total; ++c) {
        const bool last = c == total - 1;
        bt_reliability_row* row = last ? &result->overall : &result->condition[c];
        BT_TRY(evaluate(e, last ? -1 : c, row));
        result->condition_count += !last;
        result->landings += row->high_fidelity_runs;
        if (o->watch)
            o->watch(o->watch_user, c + 1, total);
    }
    if (e->pool) {
        result->landings += o->judged->evidence->count;
        bt_pool_rows_differ(e->pool, e->study, result);
        BT_TRY(bt_pool_rows_converge(e->pool, e->study, result));
        BT_TRY(bt_event_rows_fill(e->study, e->pool, o->events, o->event_count, o, result, diag));
    }
    if (!e->pool && o->event_count > 0)
        bt_reliability_note(result, "the events have no numbers: landings of this design, or with "
                                    "inputs frozen, say nothing about the conditions");
    result->classifier = describe(e->surrogate);
    bt_reliability_warn(e->surrogate, result);
    note_stop(e->study, result);
    return BT_OK;
}

bt_status bt_reliability_run(const bt_study* study, const bt_surrogate* surrogate,
                             const bt_reliability_options* options, bt_reliability_result* result,
                             bt_diag* diag) {
    const double begun_s = bt_clock_s();
    memset(result, 0, sizeof *result);
    evaluation e = {.study = study, .surrogate = surrogate, .options = options};
    BT_TRY(bt_surrogate_classifier_create(study, surrogate, &e.classifier, diag));
    bt_status status = BT_OK;
    if (options->judged)
        status = bt_pool_rows_create(options->judged, study->condition_count + 1, &e.pool);
    if (status == BT_OK)
        status = evaluate_all(&e, result, diag);
    bt_pool_rows_destroy(e.pool);
    bt_surrogate_classifier_destroy(e.classifier);
    result->seconds = bt_clock_s() - begun_s;
    return status;
}
