#include "pipeline/verify.h"

#include "campaign/executor.h"
#include "campaign/ledger_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bt_status bt_run_repeat(const bt_study* study, const bt_ledger_row* row, const atomic_int* stop,
                        bt_model_params* model, bt_landing_result* result,
                        bt_landing_observer* observer, void* user) {
    const bt_axes axes = bt_design_axes(study);
    bt_lander* lander = NULL;
    BT_TRY(bt_lander_create(&lander));
    bt_lander_obey(lander, stop);
    *model = study->model;
    const bt_status status =
        bt_landing_at(lander, model, study->inputs, &axes, row->x, result, observer, user);
    bt_lander_destroy(lander);
    return status;
}

bool bt_run_is_same(const bt_ledger* ledger, const bt_ledger_row* row,
                    const bt_landing_result* result) {
    return bt_ledger_hash_run(ledger, row->run, row->x, row->log_density, result) ==
           bt_ledger_hash_run(ledger, row->run, row->x, row->log_density, &row->result);
}

static void compare(const bt_ledger* ledger, const bt_ledger_row* row,
                    const bt_landing_result* result, bt_verification* v) {
    ++v->repeated;
    if (bt_run_is_same(ledger, row, result)) {
        ++v->same;
        return;
    }
    if (v->first_other < 0)
        v->first_other = row->run;
    v->other_outcome += result->outcome != row->result.outcome;
    const double change = fabs(result->margin_m - row->result.margin_m);
    if (change > v->margin_change_m) // false for NAN: one of them has no margin
        v->margin_change_m = change;
}

/// A walk through the ledger: the k-th of `count` runs to repeat is row floor(k (runs - 1) / (count
/// - 1)), counted in order of run number.
typedef struct walk {
    const bt_study* study;
    const bt_ledger* ledger;
    const atomic_int* stop;
    int64_t row, count;
    bt_model_params model; ///< as the run of the row landed
    bt_status status;
    bt_verification* result;
} walk;

static bool visit(void* user, const bt_ledger_row* row) {
    walk* w = user;
    bt_verification* v = w->result;
    const int64_t wanted = w->count > 1 ? v->repeated * (v->runs - 1) / (w->count - 1) : 0;
    if (w->row++ != wanted)
        return true;
    bt_landing_result again;
    w->status = bt_run_repeat(w->study, row, w->stop, &w->model, &again, NULL, NULL);
    if (w->status == BT_OK)
        compare(w->ledger, row, &again, v);
    return w->status == BT_OK && v->repeated < w->count;
}

static void say_makers(const bt_ledger* ledger, bt_verification* v) {
    char* maker = bt_ledger_remark(ledger, "made_by");
    snprintf(v->made_by, sizeof v->made_by, "%s", maker ? maker : "unknown");
    free(maker);
    bt_ledger_maker(v->here, sizeof v->here);
}

bt_status bt_ledger_verify(const bt_study* study, bt_ledger* ledger, int64_t count,
                           const atomic_int* stop, bt_verification* result, bt_diag* diag) {
    bt_ledger_counts counts;
    *result = (bt_verification){.first_other = -1};
    say_makers(ledger, result);
    BT_TRY(bt_ledger_count(ledger, &counts, diag));
    if (counts.runs == 0) {
        bt_diag_add(diag, BT_ERROR, bt_ledger_place(ledger), "has no run to repeat");
        return BT_ERR_INPUT;
    }
    result->runs = counts.runs;
    walk w = {.study = study,
              .ledger = ledger,
              .stop = stop,
              .count = count < counts.runs ? count : counts.runs,
              .result = result};
    BT_TRY(bt_ledger_walk(ledger, visit, &w, diag));
    return w.status;
}
