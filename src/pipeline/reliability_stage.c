#include "pipeline/pipeline.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/// Of sampling, checks and correction: raise it when the same inputs give another table.
static const char algorithm[] = "reliability 4";

/// What the table depends on, as a text (to be freed): the surrogate, the distributions, the
/// conditions, the settings, and the model that checks it.
static char* table_key(const bt_study* study, const bt_surrogate* surrogate) {
    const bt_reliability_params* p = &study->reliability;
    char* text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fprintf(out,
            "%s: campaign %016" PRIx64 " unsure %a training %016" PRIx64
            " C %a gamma %a rho %a samples %lld high_fidelity %lld others %d "
            "seed %lld half_width %a cov %a\n",
            algorithm, study->hash, study->campaign.unsure, surrogate->training_hash, surrogate->C,
            surrogate->gamma, surrogate->rho, (long long)p->samples,
            (long long)p->high_fidelity_runs, p->others, (long long)p->seed, p->half_width, p->cov);
    for (int i = 0; i < study->input_count; ++i) {
        const bt_distribution* d = &study->inputs[i].distribution;
        if (study->inputs[i].random)
            fprintf(out, "%s %d %a %a %a %a %a %a %a\n", study->inputs[i].path, d->kind, d->mean,
                    d->sd, d->lower, d->upper, d->mode, d->scale, d->shape);
        if (d->sample)
            fprintf(out, "values %016" PRIx64 "\n", bt_sample_hash(d->sample));
    }
    bt_event events[BT_EVENT_MAX];
    const int event_count = bt_events_of(study, events);
    for (int i = 0; i < event_count; ++i)
        fprintf(out, "event %s: %s\n", events[i].name, events[i].text);
    for (int i = 0; i < study->correlation_count; ++i)
        fprintf(out, "correlation %d %d %a\n", study->correlations[i].first,
                study->correlations[i].second, study->correlations[i].rank);
    for (int i = 0; i < study->condition_count; ++i)
        fprintf(out, "%d %a\n", study->conditions[i].input, study->conditions[i].mean);
    if (fclose(out) != 0) {
        free(text);
        return NULL;
    }
    return text;
}

/// The landings of the ledger as evidence; *judged NULL when the design says nothing about the
/// conditions.
static bt_status judge(bt_study_directory* directory, const bt_event* events, int count,
                       bt_evidence* evidence, bt_judged** judged) {
    const bt_study* study = directory->study;
    *judged = NULL;
    if (!bt_judged_possible(study))
        return BT_OK;
    BT_TRY(bt_evidence_read(directory->ledger, study, INT64_MAX, events, count, evidence,
                            directory->diag));
    const bt_status status = bt_judged_create(study, evidence, judged, directory->diag);
    if (status != BT_OK)
        bt_evidence_destroy(evidence);
    return status;
}

/// @param failed  receives BT_ERR_FAILED_RUNS, said in diag, when too many of its landings failed
static bt_status compute(bt_study_directory* directory, const bt_surrogate* surrogate,
                         const bt_reliability_stage* stage, bt_reliability_result* result,
                         bt_status* failed) {
    const int threads = (int)directory->study->campaign.threads;
    bt_high_fidelity* high_fidelity = NULL;
    bt_evidence evidence = {0};
    bt_judged* judged = NULL;
    bt_event events[BT_EVENT_MAX];
    const int event_count = bt_events_of(directory->study, events);
    BT_TRY(judge(directory, events, event_count, &evidence, &judged));
    bt_status status = bt_high_fidelity_create(directory->study, threads, stage->stop,
                                               stage->backend, &high_fidelity);
    const bt_reliability_options options = {.judged = judged,
                                            .events = events,
                                            .event_count = event_count,
                                            .high_fidelity = bt_high_fidelity_run,
                                            .high_fidelity_user = high_fidelity,
                                            .threads = threads,
                                            .stop = stage->stop,
                                            .watch = stage->watch,
                                            .watch_user = stage->watch_user};
    if (status == BT_OK)
        status = bt_reliability_run(directory->study, surrogate, &options, result, directory->diag);
    *failed =
        status == BT_OK ? bt_high_fidelity_check_failed(high_fidelity, directory->diag) : status;
    bt_high_fidelity_destroy(high_fidelity);
    bt_judged_destroy(judged);
    bt_evidence_destroy(&evidence);
    return status;
}

static bt_status store(bt_study_directory* directory, const bt_reliability_file* file,
                       const bt_reliability_result* result) {
    char path[BT_FILE_PATH_MAX], *text = NULL;
    size_t size = 0;
    BT_TRY(bt_study_directory_file(directory, file->name, path));
    FILE* out = open_memstream(&text, &size);
    if (!out)
        return BT_ERR_MEMORY;
    bt_status status = file->write(out, result);
    if (fclose(out) != 0 && status == BT_OK)
        status = BT_ERR_MEMORY;
    if (status == BT_OK)
        status = bt_file_write(path, text, size, directory->diag);
    free(text);
    return status;
}

static bt_status renew(bt_study_directory* directory, const bt_surrogate* surrogate,
                       const bt_reliability_stage* stage, const char* key) {
    bt_reliability_result* result = calloc(1, sizeof *result);
    bt_status failed = BT_ERR_MEMORY;
    bt_status status =
        result ? compute(directory, surrogate, stage, result, &failed) : BT_ERR_MEMORY;
    for (const bt_reliability_file* f = stage->files; f->name && status == BT_OK; ++f)
        if (!f->events || result->event_count > 0)
            status = store(directory, f, result);
    if (status == BT_OK && stage->result)
        *stage->result = *result;
    if (status == BT_OK) // a table with too many failures is there to be read, but is no result
        status = failed == BT_OK
                     ? bt_ledger_set_remark(directory->ledger, "reliability", key, directory->diag)
                     : failed;
    free(result);
    return status;
}

static bool is_there(const bt_study_directory* directory, const char* name) {
    char path[BT_FILE_PATH_MAX];
    return bt_study_directory_file(directory, name, path) == BT_OK && access(path, R_OK) == 0;
}

static bool all_there(const bt_study_directory* directory, const bt_reliability_file* files) {
    bt_event events[BT_EVENT_MAX];
    const bool any =
        bt_events_of(directory->study, events) > 0 && bt_judged_possible(directory->study);
    bool whole = true;
    for (const bt_reliability_file* f = files; f->name; ++f)
        whole = whole && ((f->events && !any) || is_there(directory, f->name));
    return whole;
}

bt_status bt_stage_reliability(bt_study_directory* directory, const bt_surrogate* surrogate,
                               const bt_reliability_stage* stage, bool* fresh) {
    char* key = table_key(directory->study, surrogate);
    if (!key)
        return BT_ERR_MEMORY;
    char* stored = bt_ledger_remark(directory->ledger, "reliability");
    const bool stale = stage->again || stage->result || !stored || strcmp(stored, key) != 0 ||
                       !all_there(directory, stage->files);
    if (fresh)
        *fresh = stale;
    const bt_status status = stale ? renew(directory, surrogate, stage, key) : BT_OK;
    free(stored);
    free(key);
    return status;
}

/// Indices share out the variance of the outcomes: where the rarer outcome is rarer than the
/// surrogate's errors, they share out those.
static void warn_of_few(const bt_surrogate* surrogate, const bt_sobol_result* result, int samples,
                        bt_diag* diag) {
    enum { FEW = 100 };
    const bt_surrogate_scores* s = &surrogate->scores;
    const double rare = fmin(result->mean, 1 - result->mean);
    const double error = s->holdout_count > 0
                             ? (double)(s->holdout_count - s->holdout_correct) / s->holdout_count
                             : 1;
    if (rare * samples >= FEW && rare >= error)
        return;
    bt_diag_add(diag, BT_WARNING, BT_NOWHERE,
                "reliability: too few %s to rank the inputs: %.3g %% of the samples, and the "
                "surrogate errs on %.3g %% of held-out landings; the indices say what its errors "
                "depend on, not what the outcomes do",
                result->mean > 0.5 ? "misses" : "catches", 100 * rare, 100 * error);
}

bt_status bt_stage_indices(bt_study_directory* directory, const bt_surrogate* surrogate,
                           bt_sobol_result* result) {
    enum { SAMPLES_MAX = 200000, BOOTSTRAP = 200 };
    const bt_study* study = directory->study;
    const int64_t wanted = study->reliability.samples;
    if (study->correlation_count > 0) {
        const bt_correlation* c = &study->correlations[0];
        bt_diag_add(directory->diag, BT_ERROR, BT_NOWHERE,
                    "reliability: Sobol' indices share out a variance among independent inputs; %s "
                    "and %s are correlated, and what they do together belongs to neither",
                    study->inputs[c->first].path, study->inputs[c->second].path);
        return BT_ERR_INPUT;
    }
    const bt_sampler sampler = bt_reliability_sampler(study, -1);
    bt_surrogate_classifier* made = NULL;
    BT_TRY(bt_surrogate_classifier_create(study, surrogate, &made, directory->diag));
    bt_classifier classifier = *bt_surrogate_classifier_get(made);
    const int samples = (int)(wanted < SAMPLES_MAX ? wanted : SAMPLES_MAX);
    const bt_status status = bt_sobol_indices(&sampler, bt_engaged, &classifier, samples, BOOTSTRAP,
                                              (int)study->campaign.threads, result);
    bt_surrogate_classifier_destroy(made);
    if (status == BT_OK)
        warn_of_few(surrogate, result, samples, directory->diag);
    if (status != BT_ERR_NUMERIC)
        return status;
    bt_diag_add(directory->diag, BT_ERROR, BT_NOWHERE,
                "reliability: the surrogate's outcomes are all the same, there is no variance to "
                "share out");
    return BT_ERR_INPUT;
}
