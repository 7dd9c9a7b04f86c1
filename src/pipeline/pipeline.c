#include "pipeline/pipeline.h"

#include "reliability/rounds.h"

#include <stdlib.h>

/* ---- rounds of a campaign ---- */

/// What the rounds of a study need.
typedef struct campaign_rounds {
    const bt_study* study;
    bt_axes axes;
    bt_features features;
    bt_rounds rounds;
    bt_mixture* mixture;
} campaign_rounds;

static bt_status rounds_create(const bt_study* study, campaign_rounds* r, bt_diag* diag) {
    *r = (campaign_rounds){.study = study, .axes = bt_design_axes(study)};
    r->features = bt_features_of(study, r->axes.input, r->axes.count);
    r->rounds = (bt_rounds){.features = &r->features,
                            .params = &study->surrogate,
                            .seed = (uint64_t)study->campaign.seed,
                            .threads = (int)study->campaign.threads};
    return bt_mixture_create(study, &r->mixture, diag);
}

static int64_t round_end(void* user, int64_t begin) {
    (void)user;
    return bt_round_end(begin);
}

static bt_status draw_round(void* user, bt_ledger* ledger, int64_t begin, int64_t n, double* x,
                            double* log_density, bt_diag* diag) {
    campaign_rounds* r = user;
    bt_evidence evidence;
    bt_surrogate classifier = {0};
    BT_TRY(bt_evidence_read(ledger, r->study, begin, NULL, 0, &evidence, diag));
    bt_status status = bt_rounds_classifier(&r->rounds, &evidence, (int)begin, &classifier, NULL);
    if (status == BT_OK)
        status = bt_rounds_draw(&r->rounds, r->mixture, &classifier, (int)begin, (int)n,
                                r->study->campaign.unsure, x, log_density);
    bt_surrogate_destroy(&classifier);
    bt_evidence_destroy(&evidence);
    return status;
}

bt_status bt_stage_campaign(bt_study_directory* directory, const bt_campaign_options* options,
                            bt_campaign_progress* progress) {
    const bt_study* study = directory->study;
    if (study->campaign.design != BT_DESIGN_CONDITIONS || !(study->campaign.unsure > 0))
        return bt_campaign_run(study, directory->ledger, options, progress, directory->diag);
    campaign_rounds own;
    BT_TRY(rounds_create(study, &own, directory->diag));
    const bt_campaign_rounds rounds = {.end = round_end, .draw = draw_round, .user = &own};
    bt_campaign_options with = *options;
    with.rounds = &rounds;
    const bt_status status =
        bt_campaign_run(study, directory->ledger, &with, progress, directory->diag);
    free(own.mixture);
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
