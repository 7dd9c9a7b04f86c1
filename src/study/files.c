#include "study/files.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { PATH_SIZE = 4096 };

const char* bt_study_file(bt_reader* reader, const bt_study_files* files, const bt_node* node,
                          const char* key) {
    char path[PATH_SIZE];
    if (!files->study_path) {
        bt_reader_error(reader, node->where, "%s: a file cannot be named here", key);
        return NULL;
    }
    const char* from = node->where.line > 0 ? node->where.file : files->study_path;
    const char* slash = strrchr(from, '/');
    const int folder = slash && *node->text != '/' ? (int)(slash - from) + 1 : 0;
    const int length = snprintf(path, sizeof path, "%.*s%s", folder, from, node->text);
    if (length < 0 || length >= PATH_SIZE) {
        bt_reader_error(reader, node->where, "%s: the name is too long", key);
        return NULL;
    }
    const bt_node* kept =
        bt_document_node(files->names, BT_NODE_SCALAR, BT_NOWHERE, path, (size_t)length);
    if (!kept)
        bt_reader_error(reader, node->where, "%s: %s", key, bt_status_text(BT_ERR_MEMORY));
    return kept ? kept->text : NULL;
}

static bool identify(const char* path, bt_file_identity* identity) {
    struct stat info;
    if (stat(path, &info) != 0)
        return false;
    *identity = (bt_file_identity){(uint64_t)info.st_dev, (uint64_t)info.st_ino};
    return true;
}

static bool is_file(const char* path, const bt_file_identity* wanted) {
    bt_file_identity found;
    return identify(path, &found) && found.device == wanted->device && found.inode == wanted->inode;
}

bool bt_study_reads(const bt_study* study, const char* path) {
    bt_file_identity identity;
    if (!identify(path, &identity))
        return false;
    for (int i = 0; i < study->file_count; ++i)
        if (is_file(path, &study->files[i]))
            return true;
    for (int kind = 0; kind < BT_RIG_COUNT; ++kind)
        for (int i = 0; i < study->rig_inputs[kind].curve_count; ++i)
            if (is_file(study->rig_inputs[kind].curves[i].path, &identity))
                return true;
    return false;
}

void bt_study_note_file(bt_study* study, const char* path) {
    if (study->file_count < BT_FILES_READ_MAX && identify(path, &study->files[study->file_count]))
        ++study->file_count;
}
