#include "api/case.h"

#include "base/units.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SET_SIZE = 2048 };

static void deliver(void* user, bt_severity severity, bt_where where, const char* text) {
    const bt_case* opened = user;
    char line[SET_SIZE];
    if (!opened->message)
        return;
    bt_diag_format(line, sizeof line, severity, where, text);
    opened->message(opened->user, line);
}

bt_diag bt_case_diag(const bt_case* opened) {
    return (bt_diag){.sink = deliver, .user = (void*)opened};
}

// --- opening --------------------------------------------------------------------------------

static bt_status read_source(const bt_case* c, const char* const* sets, int set_count,
                             bt_study* study) {
    bt_diag diag = bt_case_diag(c);
    switch (c->source) {
    case BT_CASE_FILE:
        return bt_study_read(c->name, sets, set_count, study, &diag);
    case BT_CASE_RIGS:
        return bt_study_read_rigs(c->name, sets, set_count, study, &diag);
    case BT_CASE_TEXT:
        break;
    }
    return bt_study_read_text(c->name, c->text, strlen(c->text), sets, set_count, study, &diag);
}

static void drop_sets(bt_case* c) {
    for (int i = 0; i < c->set_count; ++i)
        free(c->sets[i]);
    free(c->sets);
    c->sets = NULL;
    c->set_count = 0;
}

void bt_case_close(bt_case* opened) {
    if (!opened)
        return;
    bt_lander_destroy(opened->lander);
    if (opened->fitted)
        bt_surrogate_destroy(&opened->surrogate);
    bt_study_destroy(&opened->study);
    drop_sets(opened);
    free(opened->name);
    free(opened->text);
    free(opened);
}

static bt_status keep_sets(bt_case* c, const char* const* sets, int set_count) {
    c->sets = calloc((size_t)set_count + 1, sizeof *c->sets);
    if (!c->sets)
        return BT_ERR_MEMORY;
    for (int i = 0; i < set_count; ++i) {
        if (!(c->sets[i] = strdup(sets[i])))
            return BT_ERR_MEMORY;
        ++c->set_count;
    }
    return BT_OK;
}

static bt_status fill(bt_case* c, const char* name, const char* text, size_t size,
                      const char* const* sets, int set_count) {
    if (!(c->name = strdup(name)) || (text && !(c->text = strndup(text, size))))
        return BT_ERR_MEMORY;
    BT_TRY(keep_sets(c, sets, set_count));
    BT_TRY(read_source(c, sets, set_count, &c->study));
    return bt_lander_create(&c->lander);
}

static bt_status open_source(bt_case_source source, const char* name, const char* text, size_t size,
                             const char* const* sets, int set_count, bt_message* message,
                             void* user, bt_case** opened) {
    *opened = NULL;
    bt_case* c = calloc(1, sizeof *c);
    if (!c)
        return BT_ERR_MEMORY;
    c->source = source;
    c->message = message;
    c->user = user;
    const bt_status status = fill(c, name, text, size, sets, set_count);
    if (status == BT_OK)
        *opened = c;
    else
        bt_case_close(c);
    return status;
}

bt_status bt_case_open(const char* path, const char* const* sets, int set_count,
                       bt_message* message, void* user, bt_case** opened) {
    return open_source(BT_CASE_FILE, path, NULL, 0, sets, set_count, message, user, opened);
}

bt_status bt_case_open_rigs(const char* path, const char* const* sets, int set_count,
                            bt_message* message, void* user, bt_case** opened) {
    return open_source(BT_CASE_RIGS, path, NULL, 0, sets, set_count, message, user, opened);
}

bt_status bt_case_open_text(const char* name, const char* text, size_t size, bt_message* message,
                            void* user, bt_case** opened) {
    return open_source(BT_CASE_TEXT, name, text, size, NULL, 0, message, user, opened);
}

typedef struct growing {
    char* text;
    size_t size;
    bool full;
} growing;

static void append(void* user, const char* text) {
    growing* g = user;
    const size_t more = strlen(text);
    char* grown = g->full ? NULL : realloc(g->text, g->size + more + 1);
    if (!grown) {
        g->full = true;
        return;
    }
    g->text = grown;
    memcpy(g->text + g->size, text, more + 1);
    g->size += more;
}

bt_status bt_case_open_defaults(const char* name, bt_message* message, void* user,
                                bt_case** opened) {
    growing defaults = {0};
    *opened = NULL;
    bt_study_defaults(append, &defaults);
    const bt_status status = defaults.full ? BT_ERR_MEMORY
                                           : bt_case_open_text(name, defaults.text, defaults.size,
                                                               message, user, opened);
    free(defaults.text);
    return status;
}

// --- keys -----------------------------------------------------------------------------------

static bool is_number(const bt_field* field) {
    return field->kind == BT_FIELD_REAL || field->kind == BT_FIELD_PLAIN ||
           field->kind == BT_FIELD_COUNT;
}

const bt_field* bt_case_number(const bt_case* c, const char* path, size_t* offset, bt_diag* diag) {
    const bt_field* field = bt_params_find(&bt_model_group, &c->study.model, path, offset);
    if (field && is_number(field))
        return field;
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s: %s", path,
                field ? "is not a number; use bt_case_set_text" : "no such key");
    return NULL;
}

/// Remembers a text for the next reading, in place of an older one of the same path.
static bt_status remember(bt_case* c, const char* path, const char* value) {
    char text[SET_SIZE];
    const size_t length = strlen(path);
    if (snprintf(text, sizeof text, "%s=%s", path, value) >= (int)sizeof text)
        return BT_ERR_ARG;
    char* copy = strdup(text);
    if (!copy)
        return BT_ERR_MEMORY;
    for (int i = 0; i < c->set_count; ++i)
        if (strncmp(c->sets[i], path, length) == 0 && c->sets[i][length] == '=') {
            free(c->sets[i]);
            c->sets[i] = copy;
            return BT_OK;
        }
    char** grown = realloc(c->sets, ((size_t)c->set_count + 1) * sizeof *grown);
    if (!grown) {
        free(copy);
        return BT_ERR_MEMORY;
    }
    c->sets = grown;
    c->sets[c->set_count++] = copy;
    return BT_OK;
}

bt_status bt_case_set(bt_case* opened, const char* path, double value) {
    size_t offset;
    char text[128];
    bt_diag diag = bt_case_diag(opened);
    const bt_field* field = bt_case_number(opened, path, &offset, &diag);
    if (!field)
        return BT_ERR_ARG;
    if (!(value >= field->least && value <= field->greatest)) {
        bt_diag_add(&diag, BT_ERROR, BT_NOWHERE, "%s: %g is outside %g .. %g %s", path, value,
                    field->least, field->greatest, bt_unit_text(field->unit));
        return BT_ERR_ARG;
    }
    bt_unit_print(value, field->unit, text, sizeof text);
    BT_TRY(remember(opened, path, text));
    bt_field_set(field, &opened->study.model, offset, value);
    return BT_OK;
}

bt_status bt_case_get(const bt_case* opened, const char* path, double* value) {
    size_t offset;
    bt_diag diag = bt_case_diag(opened);
    const bt_field* field = bt_case_number(opened, path, &offset, &diag);
    if (!field)
        return BT_ERR_ARG;
    *value = bt_field_get(field, &opened->study.model, offset);
    return BT_OK;
}

/// The texts kept so far with one more, which replaces those of its path. Borrowed pointers.
static int with_one_more(const bt_case* c, const char* text, size_t path_length,
                         const char** sets) {
    int count = 0;
    for (int i = 0; i < c->set_count; ++i)
        if (strncmp(c->sets[i], text, path_length + 1) != 0)
            sets[count++] = c->sets[i];
    sets[count++] = text;
    return count;
}

bt_status bt_case_set_text(bt_case* opened, const char* path, const char* value) {
    char text[SET_SIZE];
    if (snprintf(text, sizeof text, "%s=%s", path, value) >= (int)sizeof text)
        return BT_ERR_ARG;
    const char** sets = calloc((size_t)opened->set_count + 1, sizeof *sets);
    if (!sets)
        return BT_ERR_MEMORY;
    bt_study read;
    const int count = with_one_more(opened, text, strlen(path), sets);
    bt_status status = read_source(opened, sets, count, &read);
    free(sets);
    if (status != BT_OK)
        return status;
    status = remember(opened, path, value);
    if (status != BT_OK) {
        bt_study_destroy(&read);
        return status;
    }
    memcpy(read.directory, opened->study.directory, sizeof read.directory);
    bt_study_destroy(&opened->study);
    opened->study = read;
    return BT_OK;
}

bt_status bt_case_set_directory(bt_case* opened, const char* path) {
    bt_study* study = &opened->study;
    if (strlen(path) >= sizeof study->directory)
        return BT_ERR_ARG;
    snprintf(study->directory, sizeof study->directory, "%s", path);
    return BT_OK;
}

const char* bt_case_title(const bt_case* opened) {
    return opened->study.title;
}

const char* bt_case_directory(const bt_case* opened) {
    return opened->study.directory;
}

const char* bt_case_text(const bt_case* opened) {
    return opened->study.text;
}

typedef struct key_visit {
    bt_key_visit* visit;
    void* user;
} key_visit;

static bool show_key(void* user, const bt_field* field, const char* path, size_t offset) {
    static const char* const kinds[] = {
        [BT_FIELD_REAL] = "number", [BT_FIELD_PLAIN] = "number",  [BT_FIELD_COUNT] = "count",
        [BT_FIELD_FLAG] = "flag",   [BT_FIELD_CHOICE] = "choice", [BT_FIELD_LIST] = "list",
        [BT_FIELD_TABLE] = "table", [BT_FIELD_GROUP] = "group",
    };
    const key_visit* v = user;
    (void)offset;
    const bt_key key = {
        .path = path,
        .unit = is_number(field) ? bt_unit_text(*field->unit ? field->unit : "1") : "",
        .kind = kinds[field->kind],
        .equation = field->equation,
        .text = field->text,
        .fallback = field->fallback,
        .least = field->least,
        .greatest = field->greatest,
    };
    return v->visit(v->user, &key);
}

void bt_keys(bt_key_visit* visit, void* user) {
    key_visit v = {visit, user};
    bt_group_walk(&bt_model_group, show_key, &v);
}
