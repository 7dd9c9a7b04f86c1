#include "bolter/reliability.h"

#include "api/case.h"
#include "base/units.h"
#include "pipeline/pipeline.h"

#include <stdlib.h>

static void show(const bt_reliability_row* row, bt_reliability_visit* visit, void* user) {
    const bt_reliability_line line = {
        .parameter = row->parameter,
        .unit = row->unit && *row->unit ? bt_unit_text(row->unit) : "",
        .value = row->value,
        .corrected = row->corrected,
        .corrected_ci95 = {row->corrected_ci95.least, row->corrected_ci95.greatest},
        .corrected_sampling = row->corrected_sampling,
        .corrected_unseen = row->corrected_unseen,
        .reweighted = row->reweighted,
        .reweighted_ci95 = {row->reweighted_ci95.least, row->reweighted_ci95.greatest},
        .effective_landings = row->effective_landings,
        .surrogate = row->surrogate,
        .surrogate_ci95 = {row->surrogate_ci95.least, row->surrogate_ci95.greatest},
        .outside_share = row->outside_share,
        .landings = row->landings,
    };
    visit(user, &line);
}

typedef struct watching {
    const bt_reliability_def* def;
    atomic_int stop;
} watching;

static void watch(void* user, int done, int total) {
    watching* w = user;
    if (w->def->progress && !w->def->progress(w->def->user, done, total))
        atomic_store(&w->stop, 1);
}

/// The classifier and the table of an opened directory.
static bt_status compute(bt_study_directory* directory, watching* w,
                         bt_reliability_result* result) {
    static const bt_reliability_file none[] = {{0}};
    bt_surrogate surrogate;
    const bt_reliability_stage stage = {
        .files = none, .stop = &w->stop, .watch = watch, .watch_user = w, .result = result};
    BT_TRY(bt_stage_fit(directory, false, &surrogate, NULL));
    const bt_status status = bt_stage_reliability(directory, &surrogate, &stage, NULL);
    bt_surrogate_destroy(&surrogate);
    return status;
}

bt_status bt_case_reliability(bt_case* opened, const bt_reliability_def* def,
                              bt_reliability_visit* visit, void* user) {
    bt_reliability_def wanted;
    if (!BT_DEF_COPY(wanted, def))
        return BT_ERR_ARG;
    bt_reliability_result* result = calloc(1, sizeof *result);
    if (!result)
        return BT_ERR_MEMORY;
    bt_diag diag = bt_case_diag(opened);
    bt_study_directory directory;
    watching w = {.def = &wanted};
    bt_status status = bt_study_directory_open(&directory, &opened->study, BT_LEDGER_WRITE, &diag);
    if (status == BT_OK)
        status = compute(&directory, &w, result);
    bt_study_directory_close(&directory);
    for (int i = 0; status == BT_OK && i < result->warning_count; ++i)
        bt_diag_add(&diag, BT_WARNING, BT_NOWHERE, "%s", result->warning[i]);
    for (int i = 0; status == BT_OK && i < result->condition_count; ++i)
        show(&result->condition[i], visit, user);
    if (status == BT_OK)
        show(&result->overall, visit, user);
    free(result);
    return status;
}
