#include "campaign/capsule.h"

#include "campaign/ledger_parts.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/// Every file is stored as it is: sz is the length of data.
static const char table[] =
    "CREATE TABLE sqlar(name TEXT PRIMARY KEY, mode INT, mtime INT, sz INT, data BLOB)";
enum { FILE_MODE = 0100644 };

static bt_status say(bt_diag* diag, const char* path, const char* what, const char* why) {
    bt_diag_add(diag, BT_ERROR, (bt_where){.file = path}, "%s%s%s", what, *why ? ": " : "", why);
    return BT_ERR_IO;
}

static bt_status put_files(sqlite3* db, const bt_capsule_file* files, int count) {
    sqlite3_stmt* insert = NULL;
    bool good = sqlite3_exec(db, "BEGIN", NULL, NULL, NULL) == SQLITE_OK &&
                sqlite3_exec(db, table, NULL, NULL, NULL) == SQLITE_OK &&
                sqlite3_prepare_v2(db, "INSERT INTO sqlar VALUES (?, ?, 0, ?, ?)", -1, &insert,
                                   NULL) == SQLITE_OK;
    for (int i = 0; i < count && good; ++i)
        good = sqlite3_bind_text(insert, 1, files[i].name, -1, SQLITE_STATIC) == SQLITE_OK &&
               sqlite3_bind_int(insert, 2, FILE_MODE) == SQLITE_OK &&
               sqlite3_bind_int64(insert, 3, (sqlite3_int64)files[i].size) == SQLITE_OK &&
               sqlite3_bind_blob64(insert, 4, files[i].data, files[i].size, SQLITE_STATIC) ==
                   SQLITE_OK &&
               sqlite3_step(insert) == SQLITE_DONE && sqlite3_reset(insert) == SQLITE_OK;
    sqlite3_finalize(insert);
    return good && sqlite3_exec(db, "COMMIT", NULL, NULL, NULL) == SQLITE_OK ? BT_OK : BT_ERR_IO;
}

/// A copy of the ledger, compact, with the files: whole and on the disk, or nothing.
static bt_status make(bt_ledger* ledger, const char* temporary, const char* path,
                      const bt_capsule_file* files, int count, bt_diag* diag) {
    sqlite3* db = NULL;
    char* copy = sqlite3_mprintf("VACUUM INTO %Q", temporary);
    if (!copy)
        return BT_ERR_MEMORY;
    unlink(temporary);
    bt_status status = bt_ledger_execute(ledger, copy, "cannot be copied", diag);
    sqlite3_free(copy);
    if (status != BT_OK)
        return status;
    status = sqlite3_open_v2(temporary, &db, SQLITE_OPEN_READWRITE, NULL) == SQLITE_OK
                 ? put_files(db, files, count)
                 : BT_ERR_IO;
    if (status != BT_OK)
        say(diag, path, "cannot write", db ? sqlite3_errmsg(db) : "no memory");
    sqlite3_close(db);
    return status;
}

/// "" where it is a capsule, else why it is none. `db` is the caller's to close in any case.
static const char* open_capsule(const char* path, sqlite3** db) {
    static const char is_one[] = "SELECT 1 FROM sqlar, runs, meta LIMIT 0";
    if (sqlite3_open_v2(path, db, SQLITE_OPEN_READONLY, NULL) != SQLITE_OK)
        return *db ? sqlite3_errmsg(*db) : "no memory";
    return sqlite3_exec(*db, is_one, NULL, NULL, NULL) == SQLITE_OK ? "" : sqlite3_errmsg(*db);
}

static bool may_go(const char* path) {
    struct stat info;
    sqlite3* db = NULL;
    if (stat(path, &info) != 0 || (S_ISREG(info.st_mode) && info.st_size == 0))
        return true;
    const bool capsule = S_ISREG(info.st_mode) && !*open_capsule(path, &db);
    sqlite3_close(db);
    return capsule;
}

bt_status bt_capsule_write(bt_ledger* ledger, const char* path, const bt_capsule_file* files,
                           int count, bt_diag* diag) {
    char temporary[BT_FILE_PATH_MAX];
    if (!may_go(path))
        return bt_file_refuse(path, diag);
    BT_TRY(bt_file_temporary(path, temporary, diag));
    const bt_status status = make(ledger, temporary, path, files, count, diag);
    if (status == BT_OK)
        return bt_file_finish(path, temporary, true, 0, diag);
    unlink(temporary);
    return status;
}

static bt_status copy_out(sqlite3_stmt* found, char** data, size_t* size) {
    const size_t length = (size_t)sqlite3_column_bytes(found, 0);
    const void* from = sqlite3_column_blob(found, 0);
    char* to = malloc(length + 1);
    if (!to)
        return BT_ERR_MEMORY;
    if (length)
        memcpy(to, from, length);
    to[length] = '\0';
    *data = to;
    if (size)
        *size = length;
    return BT_OK;
}

bt_status bt_capsule_read(const char* path, const char* name, char** data, size_t* size,
                          bt_diag* diag) {
    sqlite3* db = NULL;
    sqlite3_stmt* find = NULL;
    bt_status status = BT_ERR_IO;
    const char* why = open_capsule(path, &db);
    if (*why)
        say(diag, path, "this is no capsule (bolter pack writes one)", why);
    else if (sqlite3_prepare_v2(db, "SELECT data FROM sqlar WHERE name = ? AND sz = length(data)",
                                -1, &find, NULL) != SQLITE_OK ||
             sqlite3_bind_text(find, 1, name, -1, SQLITE_STATIC) != SQLITE_OK)
        say(diag, path, "cannot read", sqlite3_errmsg(db));
    else if (sqlite3_step(find) != SQLITE_ROW)
        say(diag, path, "the capsule is damaged: it lacks", name);
    else
        status = copy_out(find, data, size);
    sqlite3_finalize(find);
    sqlite3_close(db);
    return status;
}
