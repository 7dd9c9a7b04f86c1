#include "pipeline/sweep.h"

#include "base/text.h"
#include "base/units.h"
#include "campaign/executor.h"
#include "landing/view.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- key and values ---------------------------------------------------------------------------

static bool is_number(const bt_field* field) {
    return field->kind == BT_FIELD_REAL || field->kind == BT_FIELD_PLAIN ||
           field->kind == BT_FIELD_COUNT;
}

static bool look_at_path(void* user, const bt_field* field, const char* path, size_t offset) {
    (void)offset;
    if (is_number(field))
        bt_text_look(user, path);
    return true;
}

bt_status bt_sweep_find(const bt_model_params* model, const char* key, const bt_field** field,
                        size_t* offset, bt_diag* diag) {
    *field = bt_params_find(&bt_model_group, model, key, offset);
    if (*field && is_number(*field))
        return BT_OK;
    if (*field) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s: a key that holds one number is wanted", key);
        return BT_ERR_INPUT;
    }
    bt_text_nearest nearest = bt_text_search(key);
    bt_params_walk(&bt_model_group, model, look_at_path, &nearest);
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s: unknown key; did you mean \"%s\"?", key,
                nearest.name);
    return BT_ERR_INPUT;
}

static bt_status read_value(const bt_field* field, const char* key, const char* text, double* value,
                            bt_diag* diag) {
    char why[256], least[64], greatest[64];
    const char* token = field->kind == BT_FIELD_REAL ? field->unit : "1";
    if (bt_unit_parse(text, token, value, why, sizeof why) != BT_OK) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s: %s", key, why);
        return BT_ERR_INPUT;
    }
    if (*value >= field->least && *value <= field->greatest)
        return BT_OK;
    const char* unit = "";
    bt_unit_print_as(field->least, text, least, sizeof least, &unit);
    bt_unit_print_as(field->greatest, text, greatest, sizeof greatest, &unit);
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s: %s is outside %s .. %s %s", key, text, least,
                greatest, unit);
    return BT_ERR_INPUT;
}

/// Copies the text up to the next comma without its blanks; returns what follows the comma, or
/// NULL when there is none.
static const char* next_item(const char* text, char* item, size_t size) {
    while (isspace((unsigned char)*text))
        ++text;
    const char* end = text + strcspn(text, ",");
    const char* after = *end ? end + 1 : NULL;
    while (end > text && isspace((unsigned char)end[-1]))
        --end;
    snprintf(item, size, "%.*s", (int)(end - text), text);
    return after;
}

bt_status bt_sweep_values(const bt_field* field, const char* key, const char* text, double* values,
                          int* count, bt_diag* diag) {
    char item[128];
    bt_status status = BT_OK;
    *count = 0;
    while (text) {
        text = next_item(text, item, sizeof item);
        if (*count == BT_SWEEP_VALUES_MAX) {
            bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s: more than %d values", key,
                        BT_SWEEP_VALUES_MAX);
            return BT_ERR_INPUT;
        }
        if (read_value(field, key, item, &values[*count], diag) == BT_OK)
            ++*count;
        else
            status = BT_ERR_INPUT;
    }
    return status;
}

// --- path -------------------------------------------------------------------------------------

/// Follows the head of one landing's hook.
typedef struct follower {
    bt_hook_path* path;
    bool touched;
    double start_m;
    bool full; ///< out of memory
} follower;

static bool grow(bt_hook_path* path) {
    if (path->count < path->room)
        return true;
    const int room = path->room ? 2 * path->room : 1024;
    double* travelled = realloc(path->travelled_m, (size_t)room * sizeof *travelled);
    if (travelled)
        path->travelled_m = travelled;
    double* height = realloc(path->height_m, (size_t)room * sizeof *height);
    if (height)
        path->height_m = height;
    if (!travelled || !height)
        return false;
    path->room = room;
    return true;
}

static void follow(void* user, const bt_landing_view* view) {
    follower* f = user;
    const double x = view->hook_shoe_m[0];
    if (!f->touched && view->hook_deck_force_N > 0) {
        f->touched = true;
        f->start_m = x;
    }
    if (!f->touched || f->full)
        return;
    bt_hook_path* path = f->path;
    if (!grow(path)) {
        f->full = true;
        return;
    }
    path->travelled_m[path->count] = x - f->start_m;
    path->height_m[path->count++] = view->hook_height_m;
}

// --- landings ---------------------------------------------------------------------------------

/// A sweep on its way through the executor.
typedef struct work {
    bt_sweep* sweep;
    follower* followers; ///< [sweep->count]
    int next;
} work;

static bool give(void* user, bt_job* job) {
    work* w = user;
    if (w->next == w->sweep->count)
        return false;
    job->run = w->next++;
    job->x[0] = w->sweep->rows[job->run].value;
    return true;
}

static void* follower_of(void* user, const bt_job* job) {
    const work* w = user;
    return &w->followers[job->run];
}

static bt_status take(void* user, const bt_job* job, const bt_landing_result* result) {
    const work* w = user;
    w->sweep->rows[job->run].result = *result;
    return w->followers[job->run].full ? BT_ERR_MEMORY : BT_OK;
}

static bt_status run_rows(const bt_model_params* model, size_t offset, int threads,
                          const atomic_int* stop, work* w, bt_diag* diag) {
    const bt_axes axes = {.count = 1};
    const bt_input input = {.field = w->sweep->field, .offset = offset};
    const bt_executor executor = {.model = model,
                                  .inputs = &input,
                                  .axes = &axes,
                                  .threads = threads,
                                  .stop = stop,
                                  .source = give,
                                  .sink = take,
                                  .observer = follow,
                                  .observed = follower_of,
                                  .user = w};
    return bt_executor_run(&executor, diag);
}

bt_status bt_sweep_run(const bt_model_params* model, const char* key, const double* values,
                       int count, int threads, const atomic_int* stop, bt_sweep* sweep,
                       bt_diag* diag) {
    *sweep = (bt_sweep){.count = count};
    size_t offset;
    if (count < 1 || count > BT_SWEEP_VALUES_MAX)
        return BT_ERR_ARG;
    BT_TRY(bt_sweep_find(model, key, &sweep->field, &offset, diag));
    sweep->rows = calloc((size_t)count, sizeof *sweep->rows);
    work w = {.sweep = sweep, .followers = calloc((size_t)count, sizeof *w.followers)};
    bt_status status = sweep->rows && w.followers ? BT_OK : BT_ERR_MEMORY;
    for (int i = 0; i < count && status == BT_OK; ++i) {
        sweep->rows[i].value = values[i];
        w.followers[i].path = &sweep->rows[i].path;
    }
    if (status == BT_OK)
        status = run_rows(model, offset, threads, stop, &w, diag);
    free(w.followers);
    if (status != BT_OK)
        bt_sweep_destroy(sweep);
    return status;
}

void bt_sweep_destroy(bt_sweep* sweep) {
    for (int i = 0; sweep->rows && i < sweep->count; ++i) {
        free(sweep->rows[i].path.travelled_m);
        free(sweep->rows[i].path.height_m);
    }
    free(sweep->rows);
    *sweep = (bt_sweep){0};
}
