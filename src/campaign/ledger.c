#include "campaign/ledger_parts.h"

#include "bolter/version.h"
#include "cable/cable.h"
#include "study/identity.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { APPLICATION_ID = 0x424f4c54 /* "BOLT" */, FORMAT_VERSION = 2, BUSY_WAIT_MS = 60000 };

void bt_ledger_maker(char* text, size_t size) {
    snprintf(text, size, "bolter %d.%d.%d, kernels %s", BT_VERSION_MAJOR, BT_VERSION_MINOR,
             BT_VERSION_PATCH, bt_cable_best_level());
}

/// A new ledger appears complete or not at all.
static bt_status create(bt_ledger* ledger, const char* identity, bt_diag* diag) {
    const char* study = ledger->study->text ? ledger->study->text : "";
    char maker[BT_MAKER_SIZE];
    bt_ledger_maker(maker, sizeof maker);
    sqlite3_str* marks = sqlite3_str_new(ledger->db);
    sqlite3_str_appendf(marks, "PRAGMA application_id = %d; PRAGMA user_version = %d;",
                        APPLICATION_ID, FORMAT_VERSION);
    BT_TRY(bt_ledger_execute(ledger, "BEGIN IMMEDIATE", "cannot write", diag));
    bt_status status = bt_ledger_execute_text(ledger, marks, diag);
    if (status == BT_OK)
        status = bt_ledger_make_tables(ledger, diag);
    if (status == BT_OK)
        status = bt_ledger_set_remark(ledger, "identity", identity, diag);
    if (status == BT_OK)
        status = bt_ledger_set_remark(ledger, "study", study, diag);
    if (status == BT_OK)
        status = bt_ledger_set_remark(ledger, "made_by", maker, diag);
    if (status == BT_OK)
        status = bt_ledger_execute(ledger, "COMMIT", "cannot write", diag);
    if (status != BT_OK)
        bt_ledger_roll_back(ledger);
    return status;
}

/// The first line of one text that the other has not, with its length; NULL when it has all.
static const char* line_missing(const char* text, const char* other, size_t* length) {
    for (; *text; text += *length + (text[*length] == '\n')) {
        *length = strcspn(text, "\n");
        bool found = false;
        for (const char* line = other; *line && !found;) {
            const size_t n = strcspn(line, "\n");
            found = n == *length && strncmp(line, text, n) == 0;
            line += n + (line[n] == '\n');
        }
        if (!found)
            return text;
    }
    return NULL;
}

/// Names what the ledger's runs have and this study's would not, and the other way round.
static bt_status say_other_study(const bt_ledger* ledger, const char* stored, const char* wanted,
                                 bt_diag* diag) {
    static const char nothing[] = "nothing of the kind";
    size_t has_length = 0, wants_length = 0;
    const char* has = line_missing(stored, wanted, &has_length);
    const char* wants = line_missing(wanted, stored, &wants_length);
    bt_diag_add(diag, BT_ERROR, bt_ledger_place(ledger),
                "the ledger belongs to another study: it has \"%.*s\", this study has \"%.*s\" "
                "(SI). Use another directory with -o, or move the ledger away",
                (int)(has ? has_length : strlen(nothing)), has ? has : nothing,
                (int)(wants ? wants_length : strlen(nothing)), wants ? wants : nothing);
    return BT_ERR_IO;
}

static bt_status check_identity(const bt_ledger* ledger, const char* identity, bt_diag* diag) {
    char* stored = bt_ledger_remark(ledger, "identity");
    if (!stored) {
        bt_diag_add(diag, BT_ERROR, bt_ledger_place(ledger),
                    "the ledger is damaged: it does not say which study it belongs to");
        return BT_ERR_IO;
    }
    const bt_status status =
        strcmp(stored, identity) == 0 ? BT_OK : say_other_study(ledger, stored, identity, diag);
    free(stored);
    return status;
}

static bt_status say_damaged(const bt_ledger* ledger, bt_diag* diag) {
    bt_diag_add(diag, BT_ERROR, bt_ledger_place(ledger),
                "the ledger is damaged; nothing was changed. Restore it, or move it away and run "
                "the campaign again");
    return BT_ERR_IO;
}

/// One row of text, "ok" when SQLite finds the file whole.
static bt_status look_through(bt_ledger* ledger, bt_diag* diag) {
    sqlite3_stmt* statement = NULL;
    bool whole = false;
    if (sqlite3_prepare_v2(ledger->db, "PRAGMA quick_check(1)", -1, &statement, NULL) ==
            SQLITE_OK &&
        sqlite3_step(statement) == SQLITE_ROW)
        whole = strcmp((const char*)sqlite3_column_text(statement, 0), "ok") == 0;
    sqlite3_finalize(statement);
    return whole ? BT_OK : say_damaged(ledger, diag);
}

/// A file shorter than its own page count was cut off. A large one is not looked through: SQLite
/// says so when it meets a damaged page.
static bt_status check_pages(bt_ledger* ledger, int64_t pages, bt_diag* diag) {
    static const int64_t small_bytes = 16 << 20;
    int64_t page_bytes = 0;
    struct stat info;
    BT_TRY(bt_ledger_integer(ledger, "PRAGMA page_size", &page_bytes, diag));
    const int64_t bytes = pages * page_bytes;
    if (stat(ledger->path, &info) == 0 && info.st_size < bytes)
        return say_damaged(ledger, diag);
    return bytes <= small_bytes ? look_through(ledger, diag) : BT_OK;
}

static bt_status say_other_format(const bt_ledger* ledger, int64_t version, bt_diag* diag) {
    if (version == 1)
        bt_diag_add(diag, BT_ERROR, bt_ledger_place(ledger),
                    "the ledger was written by bolter 0.1 (format 1), which computes landings "
                    "otherwise (CHANGELOG.md, numbers change): the two cannot be mixed. Nothing "
                    "was changed; use another directory with -o, or move the ledger away. Bolter "
                    "0.1 and any SQLite program read it");
    else
        bt_diag_add(diag, BT_ERROR, bt_ledger_place(ledger),
                    "the ledger has format %lld, this program writes format %d; nothing was "
                    "changed. Use another directory with -o, or the version that wrote it",
                    (long long)version, FORMAT_VERSION);
    return BT_ERR_IO;
}

static bt_status check_format(bt_ledger* ledger, bt_ledger_access how, const char* identity,
                              bt_diag* diag) {
    int64_t application = 0, version = 0, pages = 0;
    BT_TRY(bt_ledger_integer(ledger, "PRAGMA page_count", &pages, diag));
    BT_TRY(bt_ledger_integer(ledger, "PRAGMA application_id", &application, diag));
    BT_TRY(bt_ledger_integer(ledger, "PRAGMA user_version", &version, diag));
    if (how != BT_LEDGER_READ && sqlite3_db_readonly(ledger->db, "main") == 1) {
        bt_diag_add(diag, BT_ERROR, bt_ledger_place(ledger),
                    "the ledger cannot be written (read-only file or directory)");
        return BT_ERR_IO;
    }
    if (pages == 0 && how == BT_LEDGER_CREATE)
        return create(ledger, identity, diag);
    if (application != APPLICATION_ID) {
        bt_diag_add(diag, BT_ERROR, bt_ledger_place(ledger),
                    "this is not a bolter ledger; nothing was changed. Move it away, or use "
                    "another directory with -o");
        return BT_ERR_IO;
    }
    if (version != FORMAT_VERSION)
        return say_other_format(ledger, version, diag);
    BT_TRY(check_pages(ledger, pages, diag));
    return check_identity(ledger, identity, diag);
}

/// Landings that this program would add differ in their last bits from those that are there.
static void warn_of_other_maker(const bt_ledger* ledger, bt_diag* diag) {
    char here[BT_MAKER_SIZE];
    char* maker = bt_ledger_remark(ledger, "made_by");
    bt_ledger_maker(here, sizeof here);
    if (maker && strcmp(maker, here) != 0)
        bt_diag_add(diag, BT_WARNING, bt_ledger_place(ledger),
                    "was begun by %s; this is %s: the last bits of new landings differ from those "
                    "that it would have computed",
                    maker, here);
    free(maker);
}

static bt_status open_checked(bt_ledger* ledger, bt_ledger_access how, bt_diag* diag) {
    if (how != BT_LEDGER_CREATE && access(ledger->path, F_OK) != 0) {
        bt_diag_add(diag, BT_ERROR, bt_ledger_place(ledger),
                    "there is no ledger yet; run the campaign first (bolter campaign)");
        return BT_ERR_IO;
    }
    /* Also for reading: what a killed writer left must be rolled back first. SQLite itself falls
       back to reading only where it may not write. */
    const int flags = SQLITE_OPEN_READWRITE | (how == BT_LEDGER_CREATE ? SQLITE_OPEN_CREATE : 0);
    if (sqlite3_open_v2(ledger->path, &ledger->db, flags, NULL) != SQLITE_OK)
        return ledger->db ? bt_ledger_sql_error(ledger, "cannot open", diag) : BT_ERR_MEMORY;
    if (how == BT_LEDGER_READ)
        BT_TRY(bt_ledger_execute(ledger, "PRAGMA query_only = 1", "cannot open", diag));
    sqlite3_busy_timeout(ledger->db, BUSY_WAIT_MS);

    char* identity = bt_study_identity(ledger->study);
    if (!identity)
        return BT_ERR_MEMORY;
    bt_status status = check_format(ledger, how, identity, diag);
    free(identity);
    if (status == BT_OK)
        status = bt_ledger_bind_columns(ledger, how != BT_LEDGER_READ, diag);
    if (status == BT_OK && how != BT_LEDGER_READ)
        status = bt_ledger_make_totals(ledger, diag);
    if (status == BT_OK && how != BT_LEDGER_READ)
        warn_of_other_maker(ledger, diag);
    return status;
}

bt_status bt_ledger_open(const char* path, const bt_study* study, bt_ledger_access how,
                         bt_ledger** ledger, bt_diag* diag) {
    bt_ledger* l = calloc(1, sizeof *l);
    if (!l)
        return BT_ERR_MEMORY;
    l->study = study;
    l->axes = bt_design_axes(study);
    bt_status status = BT_ERR_IO;
    if (strlen(path) < sizeof l->path) {
        memcpy(l->path, path, strlen(path) + 1);
        status = open_checked(l, how, diag);
    } else
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "the path of the ledger has %zu bytes: too long",
                    strlen(path));
    if (status == BT_OK)
        *ledger = l;
    else
        bt_ledger_close(l);
    return status;
}

void bt_ledger_close(bt_ledger* ledger) {
    if (!ledger)
        return;
    sqlite3_finalize(ledger->insert);
    sqlite3_finalize(ledger->insert_contact);
    sqlite3_close(ledger->db);
    sqlite3_free(ledger->select);
    free(ledger);
}
