#include "pipeline/pipeline.h"

#include "reliability/rounds.h"
#include "reliability/stop.h"

#include <stdlib.h>

/* ---- rounds of a campaign ---- */

/// What the rounds of a study need.
typedef struct campaign_rounds {
    const bt_study* study;
    bt_axes axes;
    bt_features features;
    bt_rounds rounds;
    bt_mixture* mixture;
    bt_design* design;
    bt_widths widths;
    bt_surrogate classifier; ///< of the round that begins at `trained`; 0: none yet
    int trained;
    int8_t* said; ///< [judged] what the classifiers of the rounds say
    int judged;
} campaign_rounds;

static bt_status rounds_create(const bt_study* study, campaign_rounds* r, bt_diag* diag) {
    *r = (campaign_rounds){.study = study, .axes = bt_design_axes(study)};
    r->features = bt_features_of(study, r->axes.input, r->axes.count);
    r->rounds = (bt_rounds){.features = &r->features,
                            .params = &study->surrogate,
                            .seed = (uint64_t)study->campaign.seed,
                            .threads = (int)study->campaign.threads};
    BT_TRY(bt_mixture_create(study, &r->mixture, diag));
    BT_TRY(bt_design_create(study, &r->design, diag));
    return bt_widths_create(study, r->mixture, r->design, 1 - study->campaign.unsure, &r->widths);
}

static void rounds_destroy(campaign_rounds* r) {
    bt_surrogate_destroy(&r->classifier);
    bt_design_destroy(r->design);
    bt_widths_destroy(&r->widths);
    free(r->said);
    free(r->mixture);
}

static int64_t round_end(void* user, int64_t begin) {
    (void)user;
    return bt_round_end(begin);
}

/// The classifier of the round that begins at `begin`, kept until another is asked for.
static bt_status classifier_of(campaign_rounds* r, const bt_evidence* e, int begin) {
    if (r->trained == begin)
        return BT_OK;
    bt_surrogate_destroy(&r->classifier);
    r->classifier = (bt_surrogate){0};
    r->trained = 0;
    BT_TRY(bt_rounds_classifier(&r->rounds, e, begin, &r->classifier, NULL));
    r->trained = begin;
    return BT_OK;
}

static bt_status draw_round(void* user, bt_ledger* ledger, int64_t begin, int64_t n, double* x,
                            double* log_density, bt_diag* diag) {
    campaign_rounds* r = user;
    bt_evidence evidence;
    BT_TRY(bt_evidence_read(ledger, r->study, begin, NULL, 0, &evidence, diag));
    bt_status status = classifier_of(r, &evidence, (int)begin);
    if (status == BT_OK)
        status = bt_rounds_draw(&r->rounds, r->mixture, &r->classifier, (int)begin, (int)n,
                                r->study->campaign.unsure, x, log_density);
    bt_evidence_destroy(&evidence);
    return status;
}

/// Has the landings of every round that was not judged yet judged by its classifier.
static bt_status judge_rounds(campaign_rounds* r, const bt_evidence* e) {
    int8_t* said = realloc(r->said, (size_t)e->count + 1);
    if (!said)
        return BT_ERR_MEMORY;
    r->said = said;
    const int first = (int)bt_round_end(0);
    for (int i = r->judged; i < first && i < e->count; ++i)
        r->said[i] = -1;
    for (int begin = r->judged > first ? r->judged : first; begin < e->count; begin = r->judged) {
        const int64_t whole = bt_round_end(begin);
        const int end = whole < e->count ? (int)whole : e->count;
        BT_TRY(classifier_of(r, e, begin));
        BT_TRY(bt_rounds_predict(&r->rounds, &r->classifier, e->x + (size_t)begin * (size_t)e->dims,
                                 end - begin, r->said + begin, NULL));
        r->judged = end;
    }
    return BT_OK;
}

/// Whether every condition is as narrow as the study asks, with the landings before `end`.
static bt_status enough(void* user, bt_ledger* ledger, int64_t end, bool* yes, bt_diag* diag) {
    campaign_rounds* r = user;
    bt_evidence evidence;
    BT_TRY(bt_evidence_read(ledger, r->study, end, NULL, 0, &evidence, diag));
    double* weight =
        malloc(((size_t)evidence.count + 1) * (size_t)r->mixture->components * sizeof *weight);
    bt_status status = weight ? judge_rounds(r, &evidence) : BT_ERR_MEMORY;
    if (status == BT_OK) {
        bt_pooled_weigh(r->mixture, &evidence, weight);
        const bt_width width =
            bt_width_after(&r->widths, &evidence, r->said, weight, evidence.count);
        *yes = bt_stop_reached(r->study, &width);
    }
    free(weight);
    bt_evidence_destroy(&evidence);
    return status;
}

bt_status bt_stage_campaign(bt_study_directory* directory, const bt_campaign_options* options,
                            bt_campaign_progress* progress) {
    const bt_study* study = directory->study;
    *progress = (bt_campaign_progress){0};
    BT_TRY(bt_stop_check(study, directory->diag));
    const bool unsure = study->campaign.unsure > 0;
    if (study->campaign.design != BT_DESIGN_CONDITIONS || (!unsure && !bt_stop_wanted(study)))
        return bt_campaign_run(study, directory->ledger, options, progress, directory->diag);
    campaign_rounds own;
    bt_status status = rounds_create(study, &own, directory->diag);
    const bt_campaign_rounds rounds = {.end = round_end,
                                       .draw = unsure ? draw_round : NULL,
                                       .enough = bt_stop_wanted(study) ? enough : NULL,
                                       .user = &own};
    bt_campaign_options with = *options;
    with.rounds = &rounds;
    if (status == BT_OK)
        status = bt_campaign_run(study, directory->ledger, &with, progress, directory->diag);
    rounds_destroy(&own);
    return status;
}

bt_status bt_stage_study(bt_study_directory* directory, const bt_campaign_options* campaign,
                         const bt_reliability_stage* reliability, bt_campaign_progress* progress,
                         bt_surrogate* surrogate) {
    BT_TRY(bt_stage_campaign(directory, campaign, progress));
    BT_TRY(bt_stage_fit(directory, false, surrogate, NULL));
    const bt_status status = bt_stage_reliability(directory, surrogate, reliability, NULL);
    if (status != BT_OK)
        bt_surrogate_destroy(surrogate);
    return status;
}
