#include "bolter/surrogate.h"

#include "api/case.h"
#include "pipeline/pipeline.h"
#include "surrogate/features.h"

static void fill(const bt_surrogate* s, bool fresh, bt_fit_report* report) {
    const bt_surrogate_scores* scores = &s->scores;
    bt_fit_report full = {
        .size = report->size,
        .trained_now = fresh,
        .train_count = scores->train_count,
        .train_correct = scores->train_correct,
        .holdout_count = scores->holdout_count,
        .holdout_correct = scores->holdout_correct,
        .holdout_ci95 = {scores->holdout_ci95.least, scores->holdout_ci95.greatest},
        .constant = s->constant,
        .C = s->C,
        .gamma = s->gamma,
        .support_vectors = s->sv_count,
        .seconds = scores->seconds,
    };
    memcpy(full.confusion, scores->confusion, sizeof full.confusion);
    memcpy(report, &full, report->size < sizeof full ? report->size : sizeof full);
}

bt_status bt_case_fit(bt_case* opened, const bt_fit_def* def, bt_fit_report* report) {
    bt_fit_def wanted;
    bt_surrogate made;
    bool fresh = false;
    if (!BT_DEF_COPY(wanted, def) || report->size < sizeof report->size)
        return BT_ERR_ARG;
    bt_diag diag = bt_case_diag(opened);
    bt_study_directory directory;
    bt_status status = bt_study_directory_open(&directory, &opened->study, BT_LEDGER_WRITE, &diag);
    if (status == BT_OK)
        status = bt_stage_fit(&directory, wanted.again, &made, &fresh);
    bt_study_directory_close(&directory);
    if (status != BT_OK)
        return status;
    if (opened->fitted)
        bt_surrogate_destroy(&opened->surrogate);
    opened->surrogate = made;
    opened->fitted = true;
    fill(&made, fresh, report);
    return BT_OK;
}

/// The features of the classifier's inputs, which are the axes of the study's design.
static bt_features features_of(const bt_case* opened) {
    const bt_axes axes = bt_design_axes(&opened->study);
    return bt_features_of(&opened->study, axes.input, axes.count);
}

int bt_case_fit_inputs(const bt_case* opened) {
    return opened->fitted ? features_of(opened).dims : 0;
}

const char* bt_case_fit_input(const bt_case* opened, int input) {
    return input >= 0 && input < bt_case_fit_inputs(opened) ? opened->surrogate.path[input] : "";
}

bt_status bt_case_predict(const bt_case* opened, const double* points, int count,
                          double* decision) {
    if (!opened->fitted)
        return BT_ERR_ARG;
    const bt_features features = features_of(opened);
    double extended[BT_INPUT_MAX];
    for (int i = 0; i < count; ++i) {
        bt_features_extend(&features, points + (size_t)i * (size_t)features.dims, 1, extended);
        decision[i] = bt_surrogate_decision(&opened->surrogate, extended);
    }
    return BT_OK;
}
