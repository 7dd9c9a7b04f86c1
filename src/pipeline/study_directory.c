#define _GNU_SOURCE /* asprintf */
#include "pipeline/study_directory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bt_status bt_study_directory_file(const bt_study_directory* directory, const char* name,
                                  char* path) {
    return bt_file_path(path, directory->study->directory, name);
}

static const char study_mark[] = "# The study as Bolter read it: every key with the value used.\n";

/// Whether a file is the one that version 0.1 wrote, without a mark.
static bool holds(const char* path, const char* text) {
    char* there = NULL;
    const bool same = bt_file_read(path, &there, NULL, NULL) == BT_OK && strcmp(there, text) == 0;
    free(there);
    return same;
}

/// study.yaml, unless that is a file that the study was read from.
static bt_status write_study(bt_study_directory* directory) {
    const bt_study* study = directory->study;
    char path[BT_FILE_PATH_MAX], *text = NULL;
    BT_TRY(bt_study_directory_file(directory, "study.yaml", path));
    if (bt_study_reads(study, path) || holds(path, study->text))
        return BT_OK;
    const int length = asprintf(&text, "%s%s", study_mark, study->text);
    if (length < 0)
        return BT_ERR_MEMORY;
    const bt_status status =
        bt_file_replace(path, text, (size_t)length, sizeof study_mark - 1, directory->diag);
    free(text);
    return status;
}

static bt_status take(bt_study_directory* directory) {
    return bt_directory_open(&directory->lock, directory->study->directory, directory->diag);
}

bt_status bt_study_directory_open(bt_study_directory* directory, const bt_study* study,
                                  bt_ledger_access how, bt_diag* diag) {
    *directory = (bt_study_directory){.study = study, .lock = {.lock = -1}, .diag = diag};
    char path[BT_FILE_PATH_MAX];
    BT_TRY(bt_study_directory_file(directory, BT_LEDGER_NAME, path));
    if (how == BT_LEDGER_CREATE)
        BT_TRY(take(directory));
    BT_TRY(bt_ledger_open(path, study, how, &directory->ledger, diag));
    if (how == BT_LEDGER_WRITE) // no directory is made where there is no ledger
        BT_TRY(take(directory));
    return how == BT_LEDGER_READ ? BT_OK : write_study(directory);
}

void bt_study_directory_close(bt_study_directory* directory) {
    bt_ledger_close(directory->ledger);
    directory->ledger = NULL;
    bt_directory_close(&directory->lock);
}
