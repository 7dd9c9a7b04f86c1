#include "reliability/judged.h"

#include "reliability/stop.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool bt_judged_possible(const bt_study* study) {
    if (study->campaign.design == BT_DESIGN_FULL_FACTORIAL ||
        (study->reliability.others == BT_OTHERS_FROZEN && study->condition_count > 0))
        return false;
    const bool by_distribution = bt_design_is_random(study->campaign.design);
    int random = 0;
    for (int i = 0; i < study->input_count; ++i) {
        const bt_input* input = &study->inputs[i];
        random += input->random;
        if (!by_distribution &&
            (input->random != input->bounded || bt_distribution_has_atoms(&input->distribution)))
            return false;
    }
    return random > 0;
}

/// Keeps the classifier of a round that is judged, for the samples.
static bt_status keep(const bt_study* study, bt_judged* j, bt_surrogate* s, int begin, int end,
                      bt_diag* diag) {
    const bt_axes* axes = bt_design_get_axes(j->design);
    bt_surrogate* kept = &j->surrogate[j->rounds];
    *kept = *s;
    *s = (bt_surrogate){0};
    bt_surrogate_name(kept, study, axes->input, axes->count);
    memcpy(j->engaged + begin, j->said + begin, (size_t)(end - begin));
    j->begin[j->rounds++] = begin;
    j->begin[j->rounds] = end;
    return bt_surrogate_classifier_create(study, kept, &j->classifier[j->rounds - 1], diag);
}

/// Trains the classifier of one round and has it judge the landings begin .. end - 1.
static bt_status judge_round(const bt_study* study, bt_judged* j, bt_rounds* rounds, int begin,
                             int end, bt_diag* diag) {
    const bt_evidence* e = j->evidence;
    bt_surrogate s;
    BT_TRY(bt_rounds_classifier(rounds, e, begin, &s, diag));
    bt_status status = bt_rounds_predict(rounds, &s, e->x + (size_t)begin * (size_t)e->dims,
                                         end - begin, j->said + begin, NULL);
    if (status == BT_OK && begin >= bt_round_first(e->count))
        status = keep(study, j, &s, begin, end, diag);
    bt_surrogate_destroy(&s);
    return status;
}

static bt_status judge(const bt_study* study, bt_judged* j, bt_diag* diag) {
    const bt_axes* axes = bt_design_get_axes(j->design);
    const int count = j->evidence->count;
    j->features = bt_features_of(study, axes->input, axes->count);
    bt_rounds rounds = {.features = &j->features,
                        .params = &study->surrogate,
                        .seed = (uint64_t)study->campaign.seed,
                        .threads = (int)study->campaign.threads};
    memset(j->said, -1, (size_t)count);
    memset(j->engaged, -1, (size_t)count);
    for (int begin = (int)bt_round_end(0); begin < count && j->rounds < BT_ROUNDS_MAX;) {
        const int64_t whole = bt_round_end(begin);
        const int end = whole < count ? (int)whole : count;
        BT_TRY(judge_round(study, j, &rounds, begin, end, diag));
        begin = end;
    }
    return BT_OK;
}

bt_status bt_judged_create(const bt_study* study, const bt_evidence* evidence, bt_judged** made,
                           bt_diag* diag) {
    *made = NULL;
    bt_judged* j = calloc(1, sizeof *j);
    if (!j)
        return BT_ERR_MEMORY;
    j->evidence = evidence;
    const bool drawn = study->campaign.design == BT_DESIGN_CONDITIONS;
    j->least = drawn ? 1 - study->campaign.unsure : 1;
    j->tail = bt_stop_tail(study);
    j->said = malloc((size_t)evidence->count + 1);
    j->engaged = malloc((size_t)evidence->count + 1);
    bt_status status = j->said && j->engaged ? BT_OK : BT_ERR_MEMORY;
    if (status == BT_OK)
        status = bt_design_create(study, &j->design, diag);
    if (status == BT_OK)
        status = bt_mixture_create(study, &j->mixture, diag);
    if (status == BT_OK)
        status = judge(study, j, diag);
    if (status == BT_OK)
        *made = j;
    else
        bt_judged_destroy(j);
    return status;
}

void bt_judged_destroy(bt_judged* judged) {
    if (!judged)
        return;
    for (int i = 0; i < judged->rounds; ++i) {
        bt_surrogate_classifier_destroy(judged->classifier[i]);
        bt_surrogate_destroy(&judged->surrogate[i]);
    }
    bt_design_destroy(judged->design);
    free(judged->mixture);
    free(judged->said);
    free(judged->engaged);
    free(judged);
}

bt_status bt_judged_sample(const bt_judged* judged, const bt_sampler* sampler, int64_t samples,
                           int threads, const bt_pool* pool, int64_t* hits) {
    *hits = 0;
    const int first = judged->begin[0], all = judged->begin[judged->rounds] - first;
    for (int i = 0; i < judged->rounds; ++i) {
        const double share = (double)samples / all;
        const int64_t from = (int64_t)floor(share * (judged->begin[i] - first)),
                      to = i + 1 < judged->rounds
                               ? (int64_t)floor(share * (judged->begin[i + 1] - first))
                               : samples;
        int64_t engaged = 0;
        if (to > from)
            BT_TRY(bt_monte_carlo_range(sampler, bt_surrogate_classifier_get(judged->classifier[i]),
                                        from, to - from, threads, pool, &engaged));
        *hits += engaged;
    }
    return BT_OK;
}
