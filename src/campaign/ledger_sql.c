#include "campaign/ledger_parts.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// SQLite's own limit of a path with its directory (unixFullPathname), the name of the journal
/// beside it included.
enum { SQLITE_PATH_MOST = 512, JOURNAL_SUFFIX = sizeof "-journal" - 1 };

/// Bytes of the path from the root on: that is what SQLite opens.
static size_t full_length(const char* path) {
    char here[PATH_MAX];
    if (path[0] == '/' || !realpath(".", here))
        return strlen(path);
    return strlen(here) + 1 + strlen(path);
}

/// Why a file that SQLite cannot open could not be opened.
static void say_cannot_open(const bt_ledger* ledger, const char* what, bt_diag* diag) {
    struct stat info;
    const size_t length = full_length(ledger->path);
    if (stat(ledger->path, &info) == 0 && S_ISDIR(info.st_mode))
        bt_diag_add(diag, BT_ERROR, bt_ledger_place(ledger),
                    "%s: this is a directory; a ledger is a file, as in %s/" BT_LEDGER_NAME, what,
                    ledger->path);
    else if (length + JOURNAL_SUFFIX > SQLITE_PATH_MOST)
        bt_diag_add(diag, BT_ERROR, bt_ledger_place(ledger),
                    "%s: the path has %zu bytes from the root on and SQLite opens %d at most; use "
                    "a shorter directory with -o",
                    what, length, (int)SQLITE_PATH_MOST - (int)JOURNAL_SUFFIX);
    else
        bt_diag_add(diag, BT_ERROR, bt_ledger_place(ledger),
                    "%s: cannot be opened (does it exist, and may you read and write it?)", what);
}

static const char* hint_of(int extended_code, const char* otherwise) {
    switch (extended_code) {
    case SQLITE_READONLY_ROLLBACK:
    case SQLITE_READONLY_RECOVERY:
    case SQLITE_READONLY_DIRECTORY:
    case SQLITE_IOERR_DELETE:
        return "a program that wrote the ledger was killed, and what it left (FILE-journal) must "
               "be rolled back, but the file or its directory is read-only; make both writable, "
               "or copy both files elsewhere";
    default:
        break;
    }
    switch (extended_code & 0xff) {
    case SQLITE_NOTADB:
        return "this is not a bolter ledger; nothing was changed. Move it away, or use another "
               "directory with -o";
    case SQLITE_CORRUPT:
        return "the ledger is damaged; nothing was changed. Restore it, or move it away and run "
               "the campaign again";
    case SQLITE_FULL:
        return "no space left on the disk; everything committed before is kept";
    case SQLITE_IOERR:
        return "the disk refused to read or write (full, or failing); everything committed before "
               "is kept";
    case SQLITE_READONLY:
        return "the ledger cannot be written (read-only file or directory)";
    case SQLITE_BUSY:
        return "another program keeps the ledger locked";
    default:
        return otherwise;
    }
}

bt_status bt_ledger_sql_error(const bt_ledger* ledger, const char* what, bt_diag* diag) {
    const int code = sqlite3_extended_errcode(ledger->db);
    if ((code & 0xff) == SQLITE_CANTOPEN)
        say_cannot_open(ledger, what, diag);
    else
        bt_diag_add(diag, BT_ERROR, bt_ledger_place(ledger), "%s: %s", what,
                    hint_of(code, sqlite3_errmsg(ledger->db)));
    return BT_ERR_IO;
}

bt_status bt_ledger_execute(bt_ledger* ledger, const char* sql, const char* what, bt_diag* diag) {
    if (sqlite3_exec(ledger->db, sql, NULL, NULL, NULL) != SQLITE_OK)
        return bt_ledger_sql_error(ledger, what, diag);
    return BT_OK;
}

bt_status bt_ledger_execute_text(bt_ledger* ledger, sqlite3_str* text, bt_diag* diag) {
    char* sql = sqlite3_str_finish(text);
    if (!sql)
        return BT_ERR_MEMORY;
    const bt_status status = bt_ledger_execute(ledger, sql, "cannot write", diag);
    sqlite3_free(sql);
    return status;
}

bt_status bt_ledger_integer(bt_ledger* ledger, const char* sql, int64_t* answer, bt_diag* diag) {
    sqlite3_stmt* statement = NULL;
    if (sqlite3_prepare_v2(ledger->db, sql, -1, &statement, NULL) != SQLITE_OK)
        return bt_ledger_sql_error(ledger, "cannot read", diag);
    const int code = sqlite3_step(statement);
    if (code == SQLITE_ROW)
        *answer = sqlite3_column_int64(statement, 0);
    const bt_status status =
        code == SQLITE_ROW ? BT_OK : bt_ledger_sql_error(ledger, "cannot read", diag);
    sqlite3_finalize(statement);
    return status;
}

void bt_ledger_roll_back(bt_ledger* ledger) {
    sqlite3_exec(ledger->db, "ROLLBACK", NULL, NULL, NULL);
    ledger->in_transaction = false;
}

// --- remarks: the table meta ----------------------------------------------------------------

char* bt_ledger_remark(const bt_ledger* ledger, const char* key) {
    sqlite3_stmt* statement = NULL;
    char* value = NULL;
    if (sqlite3_prepare_v2(ledger->db, "SELECT value FROM meta WHERE key = ?", -1, &statement,
                           NULL) == SQLITE_OK &&
        sqlite3_bind_text(statement, 1, key, -1, SQLITE_STATIC) == SQLITE_OK &&
        sqlite3_step(statement) == SQLITE_ROW && sqlite3_column_text(statement, 0))
        value = strdup((const char*)sqlite3_column_text(statement, 0));
    sqlite3_finalize(statement);
    return value;
}

bt_status bt_ledger_set_remark(bt_ledger* ledger, const char* key, const char* text,
                               bt_diag* diag) {
    BT_TRY(bt_ledger_commit(ledger, diag));
    sqlite3_stmt* statement = NULL;
    bt_status status = BT_OK;
    if (sqlite3_prepare_v2(ledger->db, "INSERT OR REPLACE INTO meta(key, value) VALUES (?, ?)", -1,
                           &statement, NULL) != SQLITE_OK ||
        sqlite3_bind_text(statement, 1, key, -1, SQLITE_STATIC) != SQLITE_OK ||
        sqlite3_bind_text(statement, 2, text, -1, SQLITE_STATIC) != SQLITE_OK ||
        sqlite3_step(statement) != SQLITE_DONE)
        status = bt_ledger_sql_error(ledger, "cannot write", diag);
    sqlite3_finalize(statement);
    return status;
}
