#include "pipeline/rig_stage.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- measured curves --------------------------------------------------------------------------

/// Where a curve is named, and who is told about it.
typedef struct naming {
    bt_where where;
    bt_diag* diag;
} naming;

/// What is wrong with a whole file is said where the study names it, the rest at its place there.
static void place(void* user, bt_severity severity, bt_where where, const char* text) {
    const naming* n = user;
    if (where.line > 0)
        bt_diag_add(n->diag, severity, where, "%s", text);
    else
        bt_diag_add(n->diag, severity, n->where, "curve: \"%s\": %s", where.file, text);
}

static bt_status read_curve(const bt_rig_input* input, int i, const bt_rig_record* names,
                            bt_rig_curves* curves, bt_diag* diag) {
    bt_measured* measured = NULL;
    naming named = {input->curves[i].where, diag};
    bt_diag placing = {.sink = place, .user = &named};
    bt_status status =
        bt_measured_read(input->curves[i].path, &input->curves[i].columns, &measured, &placing);
    if (status != BT_OK)
        return status;
    status = bt_measured_bind(measured, names->names, names->column_count, diag);
    if (status != BT_OK)
        bt_measured_destroy(measured);
    else
        curves->measured[curves->count++] = measured;
    return status;
}

bt_status bt_rig_curves_read(const bt_study* study, bt_rig_kind kind, bt_rig_curves* curves,
                             bt_diag* diag) {
    const bt_rig_input* input = &study->rig_inputs[kind];
    bt_rig_record names;
    bt_status worst = BT_OK;
    *curves = (bt_rig_curves){0};
    bt_rig_record_start(&names, kind);
    for (int i = 0; i < input->curve_count; ++i) {
        const bt_status status = read_curve(input, i, &names, curves, diag);
        worst = worst == BT_OK ? status : worst;
    }
    if (worst != BT_OK)
        bt_rig_curves_destroy(curves);
    return worst;
}

void bt_rig_curves_destroy(bt_rig_curves* curves) {
    for (int i = 0; i < curves->count; ++i)
        bt_measured_destroy(curves->measured[i]);
    curves->count = 0;
}

// --- one test ---------------------------------------------------------------------------------

static bt_status run_rig(const bt_study* study, bt_rig_kind kind, bt_rig_test* test,
                         bt_diag* diag) {
    bt_rig_record_start(&test->record, kind);
    const bt_status status = bt_rig_run(kind, &study->model.aircraft, &study->rigs, &test->result,
                                        bt_rig_record_observe, &test->record, diag);
    if (status == BT_OK && test->record.out_of_memory)
        return BT_ERR_MEMORY;
    return status == BT_ERR_NUMERIC ? BT_ERR_FAILED_RUNS : status;
}

bt_status bt_stage_rig(const bt_study* study, bt_rig_kind kind, bt_rig_test* test, bt_diag* diag) {
    *test = (bt_rig_test){0};
    if (!study->rig_inputs[kind].given) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "rigs.%s: missing; the study does not describe this test", bt_rig_keys[kind]);
        return BT_ERR_INPUT;
    }
    BT_TRY(bt_rig_curves_read(study, kind, &test->curves, diag));
    const bt_status status = run_rig(study, kind, test, diag);
    if (status != BT_OK)
        bt_rig_test_destroy(test);
    return status;
}

void bt_rig_test_destroy(bt_rig_test* test) {
    bt_rig_record_destroy(&test->record);
    bt_rig_curves_destroy(&test->curves);
}

// --- one key over values ----------------------------------------------------------------------

/// One row; `sets` has room for one more.
static bt_status run_row(const char* path, const char** sets, int set_count,
                         const bt_rig_sweep* sweep, bt_rig_sweep_row* row, bt_diag* diag) {
    char set[512];
    bt_study study;
    snprintf(set, sizeof set, "%s=%s", sweep->key, row->value);
    sets[set_count] = set;
    BT_TRY(bt_study_read_rigs(path, sets, set_count + 1, &study, diag));
    const bt_status status = run_rig(&study, sweep->kind, &row->test, diag);
    bt_study_destroy(&study);
    return status;
}

static bt_status run_rows(const char* path, const char** sets, int set_count, const char* values,
                          bt_rig_sweep* sweep, bt_diag* diag) {
    for (const char* item = values; item;) {
        item += strspn(item, " ");
        const size_t length = strcspn(item, ",");
        if (sweep->count == BT_RIG_SWEEP_MAX) {
            bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s: more than %d values", sweep->key,
                        BT_RIG_SWEEP_MAX);
            return BT_ERR_INPUT;
        }
        bt_rig_sweep_row* row = &sweep->rows[sweep->count++];
        snprintf(row->value, sizeof row->value, "%.*s", (int)length, item);
        BT_TRY(run_row(path, sets, set_count, sweep, row, diag));
        item = item[length] ? item + length + 1 : NULL;
    }
    return BT_OK;
}

bt_status bt_stage_rig_sweep(const char* path, const char* const* sets, int set_count,
                             bt_rig_kind kind, const char* key, const char* values,
                             bt_rig_sweep* sweep, bt_diag* diag) {
    *sweep = (bt_rig_sweep){.kind = kind, .key = key};
    const char** all = calloc((size_t)set_count + 1, sizeof *all);
    sweep->rows = calloc(BT_RIG_SWEEP_MAX, sizeof *sweep->rows);
    bt_status status = all && sweep->rows ? BT_OK : BT_ERR_MEMORY;
    for (int i = 0; i < set_count && status == BT_OK; ++i)
        all[i] = sets[i];
    if (status == BT_OK)
        status = run_rows(path, all, set_count, values, sweep, diag);
    free(all);
    if (status != BT_OK)
        bt_rig_sweep_destroy(sweep);
    return status;
}

void bt_rig_sweep_destroy(bt_rig_sweep* sweep) {
    for (int i = 0; i < sweep->count; ++i)
        bt_rig_test_destroy(&sweep->rows[i].test);
    free(sweep->rows);
    *sweep = (bt_rig_sweep){0};
}
