#include "pipeline/sweep.h"

#include "base/text.h"
#include "base/units.h"
#include "campaign/executor.h"
#include "landing/view.h"

#include <ctype.h>
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- key and values ---------------------------------------------------------------------------

static bool is_number(const bt_field* field) {
    return field->kind == BT_FIELD_REAL || field->kind == BT_FIELD_PLAIN ||
           field->kind == BT_FIELD_COUNT;
}

/// The numeric key nearest to what was typed.
typedef struct nearest_key {
    const char* typed;
    char best[128];
    int distance;
} nearest_key;

static bool look_nearer(void* user, const bt_field* field, const char* path, size_t offset) {
    nearest_key* nearest = user;
    (void)offset;
    const int distance = bt_text_distance(nearest->typed, path);
    if (is_number(field) && distance < nearest->distance) {
        nearest->distance = distance;
        snprintf(nearest->best, sizeof nearest->best, "%s", path);
    }
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
    nearest_key nearest = {.typed = key, .distance = INT_MAX};
    bt_params_walk(&bt_model_group, model, look_nearer, &nearest);
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s: unknown key; did you mean \"%s\"?", key,
                nearest.best);
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

/// What the threads share: they take rows by number, and each row is written by one of them.
typedef struct shared {
    const bt_model_params* model;
    size_t offset;
    bt_sweep* sweep;
    atomic_int next;
    pthread_mutex_t lock;
    bt_status status;
    bt_diag* diag; ///< used under the lock
} shared;

/// Hands a thread's messages on, one at a time.
static void report(void* user, bt_severity severity, bt_where where, const char* text) {
    shared* s = user;
    pthread_mutex_lock(&s->lock);
    bt_diag_add(s->diag, severity, where, "%s", text);
    pthread_mutex_unlock(&s->lock);
}

static bt_status run_row(shared* s, bt_lander* lander, bt_model_params* model, bt_sweep_row* row,
                         bt_diag* diag) {
    bt_field_set(s->sweep->field, model, s->offset, row->value);
    follower f = {.path = &row->path};
    if (bt_group_check(&bt_model_group, model, "", diag) != BT_OK)
        return BT_ERR_INPUT;
    BT_TRY(bt_lander_run(lander, model, &row->result, follow, &f, diag));
    return f.full ? BT_ERR_MEMORY : BT_OK;
}

static void* work(void* argument) {
    shared* s = argument;
    bt_diag diag = {.sink = report, .user = s};
    bt_lander* lander = NULL;
    bt_model_params* model = malloc(sizeof *model);
    bt_status status = model ? bt_lander_create(&lander) : BT_ERR_MEMORY;
    if (model)
        *model = *s->model;
    while (status == BT_OK) {
        const int i = atomic_fetch_add(&s->next, 1);
        if (i >= s->sweep->count)
            break;
        status = run_row(s, lander, model, &s->sweep->rows[i], &diag);
    }
    bt_lander_destroy(lander);
    free(model);
    pthread_mutex_lock(&s->lock);
    if (s->status == BT_OK)
        s->status = status;
    pthread_mutex_unlock(&s->lock);
    return NULL;
}

/// Works on the calling thread and on as many more as asked for and possible.
static bt_status run_rows(shared* s, int threads) {
    pthread_t others[BT_SWEEP_VALUES_MAX];
    int started = 0;
    pthread_mutex_init(&s->lock, NULL);
    const int wanted = bt_thread_count(threads);
    while (started < wanted - 1 && started < s->sweep->count - 1 &&
           pthread_create(&others[started], NULL, work, s) == 0)
        ++started;
    work(s);
    for (int i = 0; i < started; ++i)
        pthread_join(others[i], NULL);
    pthread_mutex_destroy(&s->lock);
    return s->status;
}

bt_status bt_sweep_run(const bt_model_params* model, const char* key, const double* values,
                       int count, int threads, bt_sweep* sweep, bt_diag* diag) {
    *sweep = (bt_sweep){.count = count};
    shared s = {.model = model, .sweep = sweep, .diag = diag};
    if (count < 1 || count > BT_SWEEP_VALUES_MAX)
        return BT_ERR_ARG;
    BT_TRY(bt_sweep_find(model, key, &sweep->field, &s.offset, diag));
    sweep->rows = calloc((size_t)count, sizeof *sweep->rows);
    if (!sweep->rows)
        return BT_ERR_MEMORY;
    for (int i = 0; i < count; ++i)
        sweep->rows[i].value = values[i];
    const bt_status status = run_rows(&s, threads);
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
