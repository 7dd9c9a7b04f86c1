#include "bolter/landing.h"

#include "api/case.h"
#include "campaign/executor.h"

#include <math.h>
#include <stdio.h>

enum { COLUMN_MAX = 256 };

typedef struct batch {
    bt_batch_def def;
    bt_input inputs[BT_INPUT_MAX];
    bt_axes axes;
    const bt_result_column* columns[COLUMN_MAX];
    double* values;
    int64_t next, done;
    atomic_int stop;
} batch;

static bool next_row(void* user, bt_job* job) {
    batch* b = user;
    if (b->next == b->def.count)
        return false;
    job->run = b->next++;
    memcpy(job->x, b->def.points + job->run * b->def.path_count,
           (size_t)b->def.path_count * sizeof *job->x);
    return true;
}

static bt_status take_row(void* user, const bt_job* job, const bt_landing_result* result) {
    batch* b = user;
    double* row = b->values + job->run * b->def.column_count;
    for (int c = 0; c < b->def.column_count; ++c)
        row[c] = bt_case_column_value(b->columns[c], result);
    ++b->done;
    return BT_OK;
}

static bt_status pulse(void* user) {
    batch* b = user;
    if (b->def.progress && !b->def.progress(b->def.user, b->done, b->def.count))
        atomic_store(&b->stop, 1);
    return BT_OK;
}

/// Finds the keys and columns by their names; what is unknown is said.
static bt_status find_names(const bt_case* opened, batch* b, bt_diag* diag) {
    if (b->def.path_count > BT_INPUT_MAX || b->def.column_count > COLUMN_MAX ||
        b->def.path_count < 0 || b->def.column_count < 0) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "at most %d paths and %d columns are possible",
                    BT_INPUT_MAX, COLUMN_MAX);
        return BT_ERR_ARG;
    }
    for (int i = 0; i < b->def.path_count; ++i) {
        bt_input* input = &b->inputs[i];
        input->field = bt_case_number(opened, b->def.paths[i], &input->offset, diag);
        if (!input->field)
            return BT_ERR_ARG;
        snprintf(input->path, sizeof input->path, "%s", b->def.paths[i]);
        b->axes.input[b->axes.count++] = i;
    }
    for (int c = 0; c < b->def.column_count; ++c)
        if (!(b->columns[c] = bt_case_column(b->def.columns[c]))) {
            bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s: no such number among the results",
                        b->def.columns[c]);
            return BT_ERR_ARG;
        }
    return BT_OK;
}

bt_status bt_case_land_batch(bt_case* opened, const bt_batch_def* def, double* values) {
    bt_diag diag = bt_case_diag(opened);
    batch b = {.values = values};
    if (!BT_DEF_COPY(b.def, def))
        return BT_ERR_ARG;
    BT_TRY(find_names(opened, &b, &diag));
    BT_TRY(bt_group_check(&bt_model_group, &opened->study.model, "", &diag));
    for (int64_t i = 0; i < b.def.count * b.def.column_count; ++i)
        values[i] = NAN;
    const bt_executor executor = {
        .model = &opened->study.model,
        .inputs = b.inputs,
        .axes = &b.axes,
        .threads = b.def.threads,
        .stop = &b.stop,
        .source = next_row,
        .sink = take_row,
        .pulse = pulse,
        .user = &b,
    };
    return bt_executor_run(&executor, &diag);
}
