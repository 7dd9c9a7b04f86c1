#include "pipeline/sensitivity.h"

#include "base/units.h"
#include "pipeline/likely_ranges.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- what is to be moved ----------------------------------------------------------------------

/// Reads "LOW..HIGH", each with its unit.
static bt_status read_range(const bt_field* field, const char* text, bt_sensitivity_key* key,
                            char* why, size_t size) {
    char low[64], reason[256] = "write LOW..HIGH";
    const char* dots = strstr(text, "..");
    const char* unit = field->unit[0] ? field->unit : "1";
    const size_t length = dots ? (size_t)(dots - text) : 0;
    bool good = dots && length < sizeof low;
    if (good) {
        memcpy(low, text, length);
        low[length] = 0;
        good = bt_unit_parse(low, unit, &key->end[0], reason, sizeof reason) == BT_OK &&
               bt_unit_parse(dots + 2, unit, &key->end[1], reason, sizeof reason) == BT_OK;
    }
    if (good && !(key->end[0] < key->end[1])) {
        good = false;
        snprintf(reason, sizeof reason, "the first is not below the second");
    }
    if (!good)
        snprintf(why, size, "%s=%s: %s", key->path, text, reason);
    return good ? BT_OK : BT_ERR_ARG;
}

/// The ends of a key's range: as typed, else the likely one, else a share of its value.
static bt_status find_ends(const bt_sensitivity* s, const bt_field* field, const char* typed,
                           bt_sensitivity_key* key, char* why, size_t size) {
    if (typed)
        return read_range(field, typed, key, why, size);
    const bt_likely_range* likely = bt_likely_range_find(key->path);
    key->end[0] = likely ? likely->low : (1 - s->change) * key->value;
    key->end[1] = likely ? likely->high : (1 + s->change) * key->value;
    if (key->end[0] != key->end[1])
        return BT_OK;
    snprintf(why, size, "\"%s\" is 0, of which there is no share; write %s=LOW..HIGH", key->path,
             key->path);
    return BT_ERR_ARG;
}

/// A random input has no value of its own to be changed: it is drawn, unless it is held.
static bool is_drawn(const bt_sensitivity* s, const char* path) {
    if (s->distance_count > 0 && strcmp(path, "landing.distance") == 0)
        return false;
    for (int k = 0; k < s->study->input_count; ++k)
        if (s->study->inputs[k].random && strcmp(s->study->inputs[k].path, path) == 0)
            return true;
    return false;
}

/// Adds one key, PATH or PATH=LOW..HIGH.
static bt_status add_key(bt_sensitivity* s, const char* text, size_t length, char* why,
                         size_t size) {
    bt_sensitivity_key* key = &s->keys[s->key_count];
    char typed[BT_PATH_MAX + 128];
    size_t offset;
    if (s->key_count == BT_SENSITIVITY_KEYS_MAX || length >= sizeof typed) {
        snprintf(why, size, "at most %d keys", BT_SENSITIVITY_KEYS_MAX);
        return BT_ERR_ARG;
    }
    memcpy(typed, text, length);
    typed[length] = 0;
    char* range = strchr(typed, '=');
    if (range)
        *range++ = 0;
    snprintf(key->path, sizeof key->path, "%.*s", (int)sizeof key->path - 1, typed);
    const bt_field* field = bt_params_find(&bt_model_group, &s->study->model, key->path, &offset);
    const bool number = field && (field->kind == BT_FIELD_REAL || field->kind == BT_FIELD_PLAIN);
    if (!number || is_drawn(s, key->path)) {
        snprintf(why, size,
                 number ? "\"%s\" is drawn from its distribution; `bolter reliability` shows what "
                          "moving it does"
                        : "\"%s\" is no number of the model; see bolter keys",
                 key->path);
        return BT_ERR_ARG;
    }
    key->value = bt_field_get(field, &s->study->model, offset);
    key->unit = field->unit[0] ? bt_unit_text(field->unit) : "";
    BT_TRY(find_ends(s, field, range, key, why, size));
    ++s->key_count;
    return BT_OK;
}

/// The likely ranges of keys that the model has and that are not drawn.
static bt_status add_likely(bt_sensitivity* s, char* why, size_t size) {
    for (const bt_likely_range* range = bt_likely_ranges; range->path; ++range)
        if (bt_params_find(&bt_model_group, &s->study->model, range->path, NULL) &&
            !is_drawn(s, range->path))
            BT_TRY(add_key(s, range->path, strlen(range->path), why, size));
    return BT_OK;
}

bt_status bt_sensitivity_add_keys(bt_sensitivity* s, const char* list, char* why, size_t size) {
    if (!list)
        return add_likely(s, why, size);
    for (const char* at = list; *at; at += strcspn(at, ","), at += *at == ',')
        BT_TRY(add_key(s, at, strcspn(at, ","), why, size));
    return BT_OK;
}

bt_status bt_sensitivity_add_distances(bt_sensitivity* s, const char* list, char* why,
                                       size_t size) {
    for (const char* at = list; at && *at; at += strcspn(at, ","), at += *at == ',') {
        char text[64];
        if (s->distance_count == BT_SENSITIVITY_DISTANCES_MAX) {
            snprintf(why, size, "at most %d distances", BT_SENSITIVITY_DISTANCES_MAX);
            return BT_ERR_ARG;
        }
        const size_t length = strcspn(at, ",");
        snprintf(text, sizeof text, "%.*s", (int)(length < sizeof text ? length : sizeof text - 1),
                 at);
        if (bt_unit_parse(text, "m", &s->distance_m[s->distance_count], why, size) != BT_OK)
            return BT_ERR_ARG;
        ++s->distance_count;
    }
    if (!list || s->distance_count > 0)
        return BT_OK;
    snprintf(why, size, "no distance; write 2 m,5.5 m");
    return BT_ERR_ARG;
}

// --- moving it --------------------------------------------------------------------------------

/// A sensitivity study on its way.
typedef struct moving {
    const bt_sensitivity* given;
    bt_study study; ///< a copy that owns nothing
    bt_noise_landing *base, *other;
} moving;

static double mean_move(const bt_noise_landing* from, const bt_noise_landing* to, int64_t count) {
    double sum = 0;
    int64_t both = 0;
    for (int64_t i = 0; i < count; ++i)
        if (isfinite(to[i].margin_m - from[i].margin_m)) {
            sum += to[i].margin_m - from[i].margin_m;
            ++both;
        }
    return both > 0 ? sum / (double)both : NAN;
}

/// Sets one number of the study's model; what it was.
static double set_key(bt_study* study, const char* path, double value) {
    size_t offset;
    const bt_field* field = bt_params_find(&bt_model_group, &study->model, path, &offset);
    const double before = bt_field_get(field, &study->model, offset);
    bt_field_set(field, &study->model, offset, value);
    return before;
}

/// Holds the distance: it is no longer drawn.
static void hold_distance(bt_study* study, double distance_m) {
    (void)set_key(study, "landing.distance", distance_m);
    for (int k = 0; k < study->input_count; ++k)
        if (strcmp(study->inputs[k].path, "landing.distance") == 0)
            study->inputs[k].random = false;
}

static bt_status run_landings(const moving* m, bt_noise_landing* landings, bt_diag* diag) {
    return bt_noise_run(&m->study, NULL, m->given->count, (int)m->study.campaign.threads,
                        m->given->stop, m->given->backend, landings, diag);
}

static bt_status move_to_end(moving* m, bt_sensitivity_effect* e, int side, bt_diag* diag) {
    const int64_t count = m->given->count;
    bt_noise_difference difference;
    e->refused[side] = bt_group_check(&bt_model_group, &m->study.model, "", NULL) != BT_OK;
    e->engaged[side] = e->margin_m[side] = NAN;
    if (e->refused[side])
        return BT_OK;
    BT_TRY(run_landings(m, m->other, diag));
    BT_TRY(bt_noise_compare(m->base, m->other, count, &difference));
    e->engaged[side] = bt_noise_engaged_share(m->other, count);
    e->margin_m[side] = mean_move(m->base, m->other, count);
    e->flips += difference.flips;
    return BT_OK;
}

static bt_status move_key(moving* m, bt_sensitivity_effect* e, bt_diag* diag) {
    bt_status status = BT_OK;
    for (int side = 0; side < 2 && status == BT_OK; ++side) {
        const double before = set_key(&m->study, e->key->path, e->key->end[side]);
        status = move_to_end(m, e, side, diag);
        (void)set_key(&m->study, e->key->path, before);
    }
    return status;
}

/// How far the key moves the share engaged, and then how many outcomes it changes.
static double strength(const bt_sensitivity_effect* e) {
    double shift = 0;
    if (!e->refused[0] && !e->refused[1])
        shift = fabs(e->engaged[1] - e->engaged[0]);
    return shift + 1e-3 * (double)e->flips;
}

static int strongest_first(const void* a, const void* b) {
    const double x = strength(a), y = strength(b);
    return (x < y) - (x > y);
}

static bt_status move_all(moving* m, bt_sensitivity_watch* watch, void* user,
                          bt_sensitivity_result* result, bt_diag* diag) {
    const bt_sensitivity* given = m->given;
    BT_TRY(run_landings(m, m->base, diag));
    BT_TRY(bt_noise_check_failed(&m->study, m->base, given->count, diag));
    result->engaged = bt_noise_engaged_share(m->base, given->count);
    for (int i = 0; i < given->key_count; ++i) {
        result->effects[i] = (bt_sensitivity_effect){.key = &given->keys[i]};
        BT_TRY(move_key(m, &result->effects[i], diag));
        result->count = i + 1;
        if (watch)
            watch(user, i + 1, given->key_count);
    }
    qsort(result->effects, (size_t)result->count, sizeof *result->effects, strongest_first);
    return BT_OK;
}

bt_status bt_stage_sensitivity(const bt_sensitivity* sensitivity, double distance_m,
                               bt_sensitivity_watch* watch, void* user,
                               bt_sensitivity_result* result, bt_diag* diag) {
    *result = (bt_sensitivity_result){.distance_m = distance_m};
    moving* m = malloc(sizeof *m);
    if (!m)
        return BT_ERR_MEMORY;
    const size_t count = (size_t)sensitivity->count;
    *m = (moving){.given = sensitivity,
                  .study = *sensitivity->study,
                  .base = calloc(count, sizeof *m->base),
                  .other = calloc(count, sizeof *m->other)};
    if (isfinite(distance_m))
        hold_distance(&m->study, distance_m);
    const bt_status status =
        m->base && m->other ? move_all(m, watch, user, result, diag) : BT_ERR_MEMORY;
    free(m->other);
    free(m->base);
    free(m);
    return status;
}
