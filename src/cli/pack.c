#define _GNU_SOURCE /* asprintf */
#include "campaign/capsule.h"
#include "cli/chain.h"
#include "cli/output.h"
#include "cli/version.h"
#include "report/methods.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { FILES_MAX = 256 };

typedef struct parcel {
    bt_chain* chain;
    int count;
    bt_capsule_file files[FILES_MAX];
} parcel;

static void parcel_destroy(parcel* p) {
    for (int i = 0; i < p->count; ++i) {
        free(p->files[i].name);
        free(p->files[i].data);
    }
}

/// Takes `data` over, also when it fails.
static bt_status add(parcel* p, const char* name, char* data, size_t size) {
    char* copy = strdup(name);
    if (!copy || p->count == FILES_MAX) {
        free(copy);
        free(data);
        if (copy)
            bt_say_error(p->chain->command, "more than %d files in figures", FILES_MAX);
        return copy ? BT_ERR_ARG : BT_ERR_MEMORY;
    }
    p->files[p->count++] = (bt_capsule_file){.name = copy, .data = data, .size = size};
    return BT_OK;
}

/// A file of the study directory, where it is there.
static bt_status add_file(parcel* p, const char* name) {
    char path[BT_FILE_PATH_MAX], *data = NULL;
    size_t size = 0;
    struct stat info;
    BT_TRY(bt_study_directory_file(&p->chain->directory, name, path));
    if (stat(path, &info) != 0 || !S_ISREG(info.st_mode))
        return BT_OK;
    BT_TRY(bt_file_read(path, &data, &size, &p->chain->diag));
    return add(p, name, data, size);
}

static bt_status add_figures(parcel* p) {
    char path[BT_FILE_PATH_MAX];
    struct dirent** entries = NULL;
    bt_status status = bt_study_directory_file(&p->chain->directory, "figures", path);
    const int count = status == BT_OK ? scandir(path, &entries, NULL, alphasort) : 0;
    for (int i = 0; i < count; ++i) {
        char name[sizeof entries[i]->d_name + 16];
        snprintf(name, sizeof name, "figures/%s", entries[i]->d_name);
        if (status == BT_OK && entries[i]->d_name[0] != '.')
            status = add_file(p, name);
        free(entries[i]);
    }
    free(entries);
    return status;
}

static bt_status write_methods(FILE* out, bt_chain* chain) {
    bt_ledger_counts counts;
    uint64_t hash = 0;
    BT_TRY(bt_ledger_count(chain->ledger, &counts, &chain->diag));
    BT_TRY(bt_ledger_hash(chain->ledger, &hash, &chain->diag));
    bt_methods_write(out, &chain->study, &counts, hash, BT_VERSION);
    return BT_OK;
}

static bt_status write_versions(FILE* out, bt_chain* chain) {
    (void)chain;
    bt_version_print(out, true);
    return BT_OK;
}

static bt_status add_written(parcel* p, const char* name, bt_status (*write)(FILE*, bt_chain*)) {
    char* text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    if (!out)
        return BT_ERR_MEMORY;
    bt_status status = write(out, p->chain);
    if (fclose(out) != 0 && status == BT_OK)
        status = BT_ERR_MEMORY;
    if (status == BT_OK)
        return add(p, name, text, size);
    free(text);
    return status;
}

static bt_status fill(parcel* p) {
    static const char* const kept[] = {"surrogate.model", "reliability.json", "reliability.txt",
                                       "reliability.csv", "report.html"};
    const char* text = p->chain->study.text;
    char* copy = strdup(text);
    if (!copy)
        return BT_ERR_MEMORY;
    BT_TRY(add(p, "study.yaml", copy, strlen(text)));
    BT_TRY(add_written(p, "methods.md", write_methods));
    BT_TRY(add_written(p, "versions.txt", write_versions));
    for (size_t i = 0; i < sizeof kept / sizeof kept[0]; ++i)
        BT_TRY(add_file(p, kept[i]));
    return add_figures(p);
}

static void print_packed(const parcel* p, const char* path) {
    size_t bytes = 0;
    for (int i = 0; i < p->count; ++i) {
        printf("%10zu  %s\n", p->files[i].size, p->files[i].name);
        bytes += p->files[i].size;
    }
    printf("%10zu  bytes in %d files, with the ledger in %s\n", bytes, p->count, path);
}

static void json_packed(const parcel* p, const char* path) {
    bt_json json = {.out = stdout};
    bt_json_begin_object(&json, NULL);
    bt_json_string(&json, "capsule", path);
    bt_json_begin_array(&json, "files");
    for (int i = 0; i < p->count; ++i)
        bt_json_string(&json, NULL, p->files[i].name);
    bt_json_end_array(&json);
    bt_json_end_object(&json);
}

static bt_status pack(bt_chain* chain) {
    const bt_command* command = chain->command;
    parcel* p = calloc(1, sizeof *p);
    char* beside = NULL;
    const bool named = bt_output_kind(command->output) == BT_OUTPUT_CAPSULE;
    bt_status status = p && (named || asprintf(&beside, "%s.bolter", chain->study.directory) >= 0)
                           ? BT_OK
                           : BT_ERR_MEMORY;
    const char* path = named ? command->output : beside;
    if (status == BT_OK) {
        p->chain = chain;
        status = fill(p);
    }
    if (status == BT_OK)
        status = bt_capsule_write(chain->ledger, path, p->files, p->count, &chain->diag);
    if (status == BT_OK && command->json)
        json_packed(p, path);
    else if (status == BT_OK)
        print_packed(p, path);
    if (p)
        parcel_destroy(p);
    free(p);
    free(beside);
    return status;
}

static bt_status run_pack(const bt_command* command) {
    bt_chain chain;
    bt_status status = bt_chain_open(command, BT_LEDGER_WRITE, &chain);
    if (status == BT_OK)
        status = pack(&chain);
    bt_chain_close(&chain);
    return status;
}

const bt_verb bt_verb_pack = {
    .name = "pack",
    .summary = "put a study with all its results into one file",
    .arguments = "STUDY.yaml",
    .text = "Writes STUDY.bolter (or -o FILE.bolter): the ledger, and in it study.yaml with every "
            "key, methods.md (how the numbers came about, for a paper), versions.txt, "
            "surrogate.model, reliability.*, report.html and figures/, as far as they are there. "
            "The file is an SQLite database: its landings are open to SQL, and `sqlite3 FILE -Ax' "
            "unpacks its files. bolter verify repeats landings of it.",
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_DIRECTORY | BT_OUTPUT_CAPSULE,
    .run = run_pack,
};
