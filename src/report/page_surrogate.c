#include "report/page_parts.h"

#include "base/directory.h"
#include "reliability/reliability.h"
#include "reliability/sobol_indices.h"
#include "surrogate/surrogate.h"

#include <string.h>

enum { SAMPLES = 16384, BOOTSTRAP = 100 };

static void write_interval(bt_json* json, const char* key, const bt_interval* interval) {
    bt_json_begin_array(json, key);
    bt_json_rounded(json, NULL, interval->least, 6);
    bt_json_rounded(json, NULL, interval->greatest, 6);
    bt_json_end_array(json);
}

static void write_scores(bt_json* json, const bt_surrogate* s) {
    static const char* const names[2][2] = {{"missed_missed", "missed_engaged"},
                                            {"engaged_missed", "engaged_engaged"}};
    const bt_surrogate_scores* scores = &s->scores;
    bt_json_begin_object(json, "surrogate");
    bt_json_number(json, "holdout_accuracy", bt_surrogate_holdout_accuracy(scores));
    write_interval(json, "holdout_ci95", &scores->holdout_ci95);
    bt_json_integer(json, "holdout_n", scores->holdout_count);
    bt_json_number(json, "train_accuracy", bt_surrogate_train_accuracy(scores));
    bt_json_integer(json, "support_vectors", s->sv_count);
    bt_json_number(json, "C", s->C);
    bt_json_number(json, "gamma", s->gamma);
    bt_json_begin_object(json, "confusion");
    for (int outcome = 0; outcome < 2; ++outcome)
        for (int prediction = 0; prediction < 2; ++prediction)
            bt_json_integer(json, names[outcome][prediction],
                            scores->confusion[outcome][prediction]);
    bt_json_end_object(json);
    bt_json_end_object(json);
}

static void write_indices(bt_json* json, const bt_study* study, const bt_sobol_result* r) {
    bt_json_begin_array(json, "sensitivity");
    for (int k = 0; k < r->dims; ++k) {
        if (!study->inputs[k].random)
            continue;
        bt_json_begin_object(json, NULL);
        bt_json_string(json, "path", study->inputs[k].path);
        bt_json_rounded(json, "first", r->first[k].value, 6);
        write_interval(json, "first_ci95", &r->first[k].ci95);
        bt_json_rounded(json, "total", r->total[k].value, 6);
        write_interval(json, "total_ci95", &r->total[k].ci95);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}

/// Sobol' indices of the classifier's outcomes over the study's distributions; nothing where those
/// do not vary, or where inputs are correlated and no share belongs to one of them.
static bt_status write_sensitivity(bt_page* page, const bt_surrogate* surrogate) {
    const bt_study* study = page->subject->study;
    const bt_sampler sampler = bt_reliability_sampler(study, -1);
    bt_surrogate_classifier* made = NULL;
    bt_sobol_result result;
    if (study->correlation_count > 0)
        return BT_OK;
    BT_TRY(bt_surrogate_classifier_create(study, surrogate, &made, page->diag));
    bt_classifier classifier = *bt_surrogate_classifier_get(made);
    const bt_status status = bt_sobol_indices(&sampler, bt_engaged, &classifier, SAMPLES, BOOTSTRAP,
                                              (int)study->campaign.threads, &result);
    bt_surrogate_classifier_destroy(made);
    if (status == BT_OK)
        write_indices(page->json, study, &result);
    return status == BT_ERR_NUMERIC ? BT_OK : status;
}

bt_status bt_page_surrogate_write(bt_page* page) {
    char path[BT_FILE_PATH_MAX];
    bt_surrogate surrogate;
    BT_TRY(bt_file_path(path, page->subject->study->directory, "surrogate.model"));
    if (bt_surrogate_load(path, &surrogate, NULL) != BT_OK)
        return BT_OK;
    write_scores(page->json, &surrogate);
    const bt_status status = write_sensitivity(page, &surrogate);
    bt_surrogate_destroy(&surrogate);
    return status;
}
