#include "pipeline/pipeline.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/// Of selection and training: raise it when the same landings and settings give another model.
static const char algorithm[] = "fit 3";

/// What a fit depends on, as a text: algorithm, landings and settings.
static bt_status fit_key(bt_study_directory* directory, char* text, size_t size) {
    uint64_t hash = 0;
    BT_TRY(bt_ledger_hash(directory->ledger, &hash, directory->diag));
    const bt_surrogate_params* p = &directory->study->surrogate;
    FILE* out = fmemopen(text, size, "w");
    if (!out)
        return BT_ERR_MEMORY;
    fprintf(out, "%s: %016" PRIx64 " features %d folds %lld holdout %a C", algorithm, hash,
            p->features, (long long)p->folds, p->holdout);
    for (int i = 0; i < p->C.count; ++i)
        fprintf(out, " %a", p->C.value[i]);
    fprintf(out, " gamma");
    for (int i = 0; i < p->gamma.count; ++i)
        fprintf(out, " %a", p->gamma.value[i]);
    return fclose(out) == 0 ? BT_OK : BT_ERR_INTERNAL;
}

/// The model on disk, if it is the one that the landings and settings give.
static bool load_current(bt_study_directory* directory, const char* key, const char* path,
                         bt_surrogate* surrogate) {
    char* stored = bt_ledger_remark(directory->ledger, "fit");
    const bool same = stored && strcmp(stored, key) == 0;
    free(stored);
    return same && bt_surrogate_load(path, surrogate, NULL) == BT_OK;
}

/// The landings with their features, as a training set.
static bt_status extend(const bt_study* study, const bt_labels* labels, const bt_axes* axes,
                        bt_training_set* set, double** x) {
    const bt_features features = bt_features_of(study, axes->input, axes->count);
    const int dims = axes->count + features.count;
    *x = malloc(((size_t)labels->count * (size_t)dims + 1) * sizeof **x);
    if (!*x)
        return BT_ERR_MEMORY;
    bt_features_extend(&features, labels->x, labels->count, *x);
    *set = (bt_training_set){.dims = dims, .count = labels->count, .x = *x, .label = labels->label};
    return BT_OK;
}

static bt_status train(bt_study_directory* directory, const char* path, bt_surrogate* surrogate) {
    const bt_study* study = directory->study;
    const bt_axes axes = bt_design_axes(study);
    bt_labels labels;
    bt_training_set set;
    double* x = NULL;
    BT_TRY(bt_labels_read(directory->ledger, axes.count, &labels, directory->diag));
    bt_status status = extend(study, &labels, &axes, &set, &x);
    if (status == BT_OK)
        status = bt_surrogate_train(&set, &study->surrogate, (uint64_t)study->campaign.seed,
                                    (int)study->campaign.threads, surrogate, NULL, directory->diag);
    free(x);
    bt_labels_destroy(&labels);
    if (status != BT_OK)
        return status;
    bt_surrogate_name(surrogate, study, axes.input, axes.count);
    surrogate->study_hash = study->hash;
    status = bt_surrogate_save(surrogate, path, directory->diag);
    if (status != BT_OK)
        bt_surrogate_destroy(surrogate);
    return status;
}

bt_status bt_stage_fit(bt_study_directory* directory, bool again, bt_surrogate* surrogate,
                       bool* fresh) {
    char path[BT_FILE_PATH_MAX], key[4096] = "";
    BT_TRY(bt_study_directory_file(directory, "surrogate.model", path));
    BT_TRY(fit_key(directory, key, sizeof key));
    const bool stale = again || !load_current(directory, key, path, surrogate);
    if (fresh)
        *fresh = stale;
    if (!stale)
        return BT_OK;
    BT_TRY(train(directory, path, surrogate));
    const bt_status status = bt_ledger_set_remark(directory->ledger, "fit", key, directory->diag);
    if (status != BT_OK)
        bt_surrogate_destroy(surrogate);
    return status;
}
