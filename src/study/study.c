#include "study/study.h"

#include "study/alternatives.h"
#include "study/echo.h"
#include "study/files.h"
#include "study/identity.h"
#include "study/inputs.h"
#include "study/reader.h"
#include "study/rig_inputs.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 4096 };

static const char* const chapters[] = {"title",       "aircraft", "deck",      "landing",
                                       "uncertainty", "campaign", "surrogate", "reliability",
                                       "rigs",        NULL};

/// One reading.
typedef struct reading {
    bt_reader reader;
    bt_document document;
    bt_document names; ///< texts of `where.file`; outlive the reading
    const char* path;  ///< path of the study file
    bool files;        ///< other files may be named
    bool rigs_will_do; ///< a description of rigs is enough
    bt_node* root;
    bt_study* study;
} reading;

/// A copy of a file's name that lives as long as the study; the name itself when out of memory.
static const char* keep_name(reading* r, const char* name) {
    const bt_node* node =
        bt_document_node(&r->names, BT_NODE_SCALAR, BT_NOWHERE, name, strlen(name));
    return node ? node->text : "study";
}

// --- files ----------------------------------------------------------------------------------

/// Reads a file into memory; on failure `errno` says why.
static bt_status load(const char* path, char** data, size_t* size) {
    *data = NULL;
    FILE* in = fopen(path, "rb");
    if (!in)
        return BT_ERR_IO;
    // one byte more than is accepted tells a file that is too large
    const size_t most = (size_t)BT_DOCUMENT_SIZE_MAX + 1;
    char* text = malloc(most);
    if (!text) {
        fclose(in);
        return BT_ERR_MEMORY;
    }
    *size = fread(text, 1, most, in);
    const bool failed = ferror(in) != 0;
    const int reason = errno;
    fclose(in);
    if (failed) {
        free(text);
        errno = reason;
        return BT_ERR_IO;
    }
    *data = text;
    return BT_OK;
}

/// Parses a text; its messages are collected with all the others.
static bt_status parse(reading* r, const char* data, size_t size, bt_where where, bt_node** root) {
    bt_diag diag = bt_reader_diag(&r->reader);
    return bt_document_parse(&r->document, data, size, where, root, &diag);
}

static bt_status load_and_parse(reading* r, const char* path, bt_node** root) {
    char* data;
    size_t size = 0;
    BT_TRY(load(path, &data, &size));
    bt_study* study = r->study;
    bt_study_note_file(study, path);
    const bt_status status = parse(r, data, size, (bt_where){keep_name(r, path), 1, 1}, root);
    free(data);
    return status;
}

static bt_study_files files_of(reading* r) {
    return (bt_study_files){&r->names, r->files ? r->path : NULL};
}

/// `aircraft: aircraft.yaml`: puts what that file holds in the place of its name.
static bt_status include(reading* r, const char* chapter) {
    bt_node* node = bt_node_child(r->root, chapter);
    if (!node || node->kind != BT_NODE_SCALAR || node->refused || *node->text == '\0')
        return BT_OK;
    const bt_study_files files = files_of(r);
    const char* path = bt_study_file(&r->reader, &files, node, chapter);
    if (!path) {
        node->refused = true;
        return BT_OK;
    }
    bt_node* held = NULL;
    const bt_status status = load_and_parse(r, path, &held);
    if (status == BT_OK && held) {
        bt_node_replace(node, held);
        return BT_OK;
    }
    node->refused = true;
    if (status == BT_ERR_IO)
        bt_reader_error(&r->reader, node->where, "%s: \"%s\" cannot be read: %s", chapter, path,
                        strerror(errno));
    else if (status == BT_OK)
        bt_reader_error(&r->reader, node->where, "%s: \"%s\" is empty", chapter, path);
    return status == BT_ERR_INPUT ? BT_OK : status;
}

// --- --set ----------------------------------------------------------------------------------

/// Below these, the rest of a path is one key: campaign.bounds, then landing.sink_speed.
static bool holds_paths(const char* path, size_t length) {
    static const char* const maps[] = {"uncertainty", "campaign.bounds", "campaign.levels",
                                       "reliability.conditions"};
    for (size_t i = 0; i < sizeof maps / sizeof maps[0]; ++i)
        if (strlen(maps[i]) == length && memcmp(maps[i], path, length) == 0)
            return true;
    return false;
}

/// The child whose key is the beginning of path, up to a dot or the end; the longest wins.
static bt_node* matching_child(bt_node* node, const char* path, size_t* length) {
    bt_node* best = NULL;
    *length = 0;
    for (bt_node* child = node->first; child; child = child->next) {
        const size_t n = child->key ? strlen(child->key->text) : 0;
        if (n > *length && strncmp(child->key->text, path, n) == 0 &&
            (path[n] == '.' || path[n] == '\0')) {
            best = child;
            *length = n;
        }
    }
    return best;
}

/// Finds or makes the node that a path names. NULL: out of memory, or a value stands where a
/// group would have to be (*blocked).
static bt_node* reach(reading* r, const char* whole, bt_where where, bool* blocked) {
    bt_node* node = r->root;
    const char* path = whole;
    for (;;) {
        *blocked = node->kind != BT_NODE_MAPPING;
        if (*blocked)
            return NULL;
        size_t length;
        bt_node* child = matching_child(node, path, &length);
        if (!child) {
            const size_t before = path > whole ? (size_t)(path - whole) - 1 : 0;
            length = holds_paths(whole, before) ? strlen(path) : strcspn(path, ".");
            bt_node* key = bt_document_node(&r->document, BT_NODE_SCALAR, where, path, length);
            child = bt_document_node(&r->document, BT_NODE_MAPPING, where, "", 0);
            if (!key || !child)
                return NULL;
            bt_node_append(node, key, child);
        }
        if (path[length] == '\0')
            return child;
        node = child;
        path += length + 1;
    }
}

/// Puts a new value where an old one was, or was not.
static bt_status set_value(reading* r, const char* path, const char* value, bt_where where) {
    bt_node* given = NULL;
    const bt_status status = parse(r, value, strlen(value), where, &given);
    if (status != BT_OK)
        return status == BT_ERR_INPUT ? BT_OK : status; // already reported
    if (!given)
        given = bt_document_node(&r->document, BT_NODE_SCALAR, where, "", 0);
    bool blocked = false;
    bt_node* old = given ? reach(r, path, where, &blocked) : NULL;
    if (blocked) {
        bt_reader_error(&r->reader, where, "%s: unknown key; a value stands above it", path);
        return BT_OK;
    }
    if (!old)
        return BT_ERR_MEMORY;
    bt_node_replace(old, given);
    return BT_OK;
}

static bt_status apply_set(reading* r, const char* set) {
    char name[PATH_SIZE];
    const char* equals = strchr(set, '=');
    const int length = equals ? (int)(equals - set) : (int)strlen(set);
    snprintf(name, sizeof name, "--set %.*s", length < 512 ? length : 512, set);
    const bt_where where = {keep_name(r, name), 0, 0};
    if (!equals || equals == set || length >= 512) {
        bt_reader_error(&r->reader, where, "PATH=VALUE is wanted, as in landing.pitch='4 deg'");
        return BT_OK;
    }
    char path[512];
    snprintf(path, sizeof path, "%.*s", length, set);
    return set_value(r, path, equals + 1, where);
}

static bool is_top_level(const char* set) {
    return strcspn(set, ".") >= strcspn(set, "=");
}

static bt_status apply_sets(reading* r, const char* const* sets, int count, bool top_level) {
    for (int i = 0; i < count; ++i)
        if (is_top_level(sets[i]) == top_level)
            BT_TRY(apply_set(r, sets[i]));
    return BT_OK;
}

// --- chapters -------------------------------------------------------------------------------

static void read_title(reading* r, const bt_node* node) {
    bt_study* study = r->study;
    if (!node) {
        snprintf(study->title, sizeof study->title, "%s", r->path);
        return;
    }
    if (node->kind != BT_NODE_SCALAR)
        bt_reader_error(&r->reader, node->where, "title: a text is wanted here");
    else if (strlen(node->text) >= sizeof study->title)
        bt_reader_error(&r->reader, node->where, "title: longer than %zu bytes",
                        sizeof study->title - 1);
    else
        snprintf(study->title, sizeof study->title, "%s", node->text);
}

static void read_chapter(reading* r, const char* name, const bt_group* group, void* params,
                         const char* const* also) {
    const bt_node* node = bt_node_child(r->root, name);
    if (node)
        bt_reader_group(&r->reader, group, params, name, node, also);
}

static void read_model(reading* r) {
    bt_study* study = r->study;
    if (r->rigs_will_do && bt_rig_inputs_alone(r->root))
        bt_rig_inputs_read_parts(&r->reader, &r->document, r->root, study);
    else
        bt_reader_group(&r->reader, &bt_model_group, &study->model, "", r->root, chapters);
}

static void read_chapters(reading* r) {
    static const char* const campaign_maps[] = {"bounds", "levels", NULL};
    static const char* const reliability_maps[] = {"conditions", NULL};
    bt_study* study = r->study;
    const int before = r->reader.errors;

    bt_alternatives_apply(&r->reader, &r->document, r->root);
    read_title(r, bt_node_child(r->root, "title"));
    const bt_study_files files = files_of(r);
    bt_rig_inputs_take(&r->reader, &files, r->root, study);
    read_model(r);
    if (r->root->kind != BT_NODE_MAPPING)
        return;
    read_chapter(r, "campaign", &bt_campaign_group, &study->campaign, campaign_maps);
    read_chapter(r, "surrogate", &bt_surrogate_group, &study->surrogate, NULL);
    read_chapter(r, "reliability", &bt_reliability_group, &study->reliability, reliability_maps);
    read_chapter(r, "rigs", &bt_rigs_group, &study->rigs, NULL);

    const bt_node* campaign = bt_node_child(r->root, "campaign");
    const bt_node* reliability = bt_node_child(r->root, "reliability");
    bt_inputs_read(&r->reader, &files, study, bt_node_child(r->root, "uncertainty"),
                   bt_node_child(campaign, "bounds"), bt_node_child(campaign, "levels"),
                   bt_node_child(reliability, "conditions"));
    if (r->reader.errors == before && !study->rigs_only)
        bt_reader_check(&r->reader, &bt_model_group, &study->model, "", r->root);
    if (r->reader.errors == before)
        bt_rig_inputs_check(&r->reader, r->root, study);
}

// --- together -------------------------------------------------------------------------------

static void set_defaults(bt_study* study) {
    memset(study, 0, sizeof *study);
    bt_group_set_defaults(&bt_model_group, &study->model);
    bt_group_set_defaults(&bt_campaign_group, &study->campaign);
    bt_group_set_defaults(&bt_surrogate_group, &study->surrogate);
    bt_group_set_defaults(&bt_reliability_group, &study->reliability);
    bt_group_set_defaults(&bt_rigs_group, &study->rigs);
}

/// studies/reference/study.yaml is studied in studies/reference/study.
static void name_directory(bt_study* study, const char* path) {
    const size_t length = strlen(path);
    const char* const endings[] = {".yaml", ".yml"};
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; ++i) {
        const size_t n = strlen(endings[i]);
        if (length > n && strcmp(path + length - n, endings[i]) == 0) {
            snprintf(study->directory, sizeof study->directory, "%.*s", (int)(length - n), path);
            return;
        }
    }
    snprintf(study->directory, sizeof study->directory, "%s.study", path);
}

static bt_status read_tree(reading* r, const char* const* sets, int set_count) {
    if (!r->root) {
        bt_reader_error(&r->reader, (bt_where){r->path, 0, 0}, "the study is empty");
        return BT_ERR_INPUT;
    }
    // a whole chapter may be replaced before the file it named is opened
    BT_TRY(apply_sets(r, sets, set_count, true));
    BT_TRY(include(r, "aircraft"));
    BT_TRY(include(r, "deck"));
    BT_TRY(apply_sets(r, sets, set_count, false));
    read_chapters(r);
    return r->reader.errors == 0 ? BT_OK : BT_ERR_INPUT;
}

/// Hands the messages on, and the study if there is one to be had.
static bt_status finish(reading* r, bt_status status, bt_diag* diag) {
    bt_study* study = r->study;
    if (status == BT_OK) {
        char* identity = bt_study_identity(study);
        study->hash = identity ? bt_study_identity_hash(identity) : 0;
        study->text = bt_study_echo(study, r->root);
        status = identity && study->text ? BT_OK : BT_ERR_MEMORY;
        free(identity);
    }
    bt_reader_flush(&r->reader, diag);
    if (status == BT_ERR_MEMORY)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s", bt_status_text(status));
    study->places = r->names.newest;
    bt_document_destroy(&r->document);
    if (status != BT_OK)
        bt_study_destroy(study);
    return status;
}

static reading* begin(const char* path, bt_study* study, bool files) {
    set_defaults(study);
    name_directory(study, path);
    reading* r = calloc(1, sizeof *r);
    if (!r)
        return NULL;
    r->study = study;
    r->files = files;
    r->path = keep_name(r, path);
    return r;
}

static bt_status read_file(const char* path, const char* const* sets, int set_count,
                           bool rigs_will_do, bt_study* study, bt_diag* diag) {
    reading* r = begin(path, study, true);
    if (!r)
        return BT_ERR_MEMORY;
    r->rigs_will_do = rigs_will_do;
    bt_status status = load_and_parse(r, path, &r->root);
    if (status == BT_ERR_IO)
        bt_reader_error(&r->reader, (bt_where){r->path, 0, 0}, "cannot be read: %s",
                        strerror(errno));
    if (status == BT_OK)
        status = read_tree(r, sets, set_count);
    status = finish(r, status, diag);
    free(r);
    return status;
}

bt_status bt_study_read(const char* path, const char* const* sets, int set_count, bt_study* study,
                        bt_diag* diag) {
    return read_file(path, sets, set_count, false, study, diag);
}

bt_status bt_study_read_rigs(const char* path, const char* const* sets, int set_count,
                             bt_study* study, bt_diag* diag) {
    return read_file(path, sets, set_count, true, study, diag);
}

bt_status bt_study_read_text(const char* name, const char* text, size_t size,
                             const char* const* sets, int set_count, bt_study* study,
                             bt_diag* diag) {
    reading* r = begin(name, study, false);
    if (!r)
        return BT_ERR_MEMORY;
    bt_status status = parse(r, text, size, (bt_where){r->path, 1, 1}, &r->root);
    if (status == BT_OK)
        status = read_tree(r, sets, set_count);
    status = finish(r, status, diag);
    free(r);
    return status;
}

bool bt_study_is_reference(const bt_study* study) {
    return strcmp(study->title, "Hook and cable, four random inputs") == 0;
}

void bt_study_destroy(bt_study* study) {
    free(study->text);
    study->text = NULL;
    bt_document places = {.newest = study->places};
    bt_document_destroy(&places);
    study->places = NULL;
    for (int i = 0; i < study->input_count; ++i) {
        bt_sample_destroy(study->inputs[i].distribution.sample);
        study->inputs[i].distribution.sample = NULL;
        study->inputs[i].where = BT_NOWHERE;
    }
}
