#include "campaign/ledger.h"

#include "base/directory.h"
#include "base/units.h"

#include <errno.h>
#include <math.h>
#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { APPLICATION_ID = 0x424f4c54 /* "BOLT" */, FORMAT_VERSION = 1, BUSY_WAIT_MS = 60000 };

typedef enum column_kind {
    COLUMN_REAL,
    COLUMN_INT,
    COLUMN_INT64,
    COLUMN_BOOL,
    COLUMN_TEXT
} column_kind;

/// What a run keeps of its result, after run, inputs, status, outcome and mode. wall_s is last: it
/// differs from run to run and is no part of the ledger's hash.
typedef struct column {
    const char* name;
    column_kind kind;
    size_t offset;
} column;

#define AT(member) offsetof(bt_landing_result, member)
static const column columns[] = {
    {"retained", COLUMN_BOOL, AT(retained)},
    {"margin_m", COLUMN_REAL, AT(margin_m)},
    {"throat_force_peak_N", COLUMN_REAL, AT(throat_force_peak_N)},
    {"time_of_contact_s", COLUMN_REAL, AT(time_of_contact_s)},
    {"bounce_count", COLUMN_INT, AT(bounce_count)},
    {"bounce_height_m", COLUMN_REAL, AT(bounces[0].height_m)},
    {"bounce_distance_m", COLUMN_REAL, AT(bounces[0].distance_m)},
    {"bounce_impact_force_N", COLUMN_REAL, AT(bounces[0].impact_force_N)},
    {"bounce_complete", COLUMN_BOOL, AT(bounces[0].complete)},
    {"hook_deck_force_peak_N", COLUMN_REAL, AT(hook_deck_force_peak_N)},
    {"strut_stroke_max_nose_m", COLUMN_REAL, AT(strut_stroke_max_m[BT_LEG_NOSE])},
    {"strut_stroke_max_left_m", COLUMN_REAL, AT(strut_stroke_max_m[BT_LEG_LEFT])},
    {"strut_stroke_max_right_m", COLUMN_REAL, AT(strut_stroke_max_m[BT_LEG_RIGHT])},
    {"tyre_force_max_nose_N", COLUMN_REAL, AT(tyre_force_max_N[BT_LEG_NOSE])},
    {"tyre_force_max_left_N", COLUMN_REAL, AT(tyre_force_max_N[BT_LEG_LEFT])},
    {"tyre_force_max_right_N", COLUMN_REAL, AT(tyre_force_max_N[BT_LEG_RIGHT])},
    {"cable_tension_max_N", COLUMN_REAL, AT(cable_tension_max_N)},
    {"steps", COLUMN_INT64, AT(steps)},
    {"cable_steps", COLUMN_INT64, AT(cable_steps)},
    {"end_time_s", COLUMN_REAL, AT(end_time_s)},
    {"failed_element", COLUMN_TEXT, AT(failed_element)},
    {"failed_quantity", COLUMN_TEXT, AT(failed_quantity)},
    {"failed_time_s", COLUMN_REAL, AT(failed_time_s)},
    {"state_hash", COLUMN_INT64, AT(state_hash)},
    {"wall_s", COLUMN_REAL, AT(wall_s)},
};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0], HASHED_COUNT = COLUMN_COUNT - 1 };
enum { FAILED_TEXT_SIZE = sizeof((bt_landing_result*)0)->failed_element };
_Static_assert(sizeof((bt_landing_result*)0)->failed_quantity == FAILED_TEXT_SIZE,
               "both texts of a failed run have one size");

struct bt_ledger {
    sqlite3* db;
    sqlite3_stmt* insert;
    char path[BT_FILE_PATH_MAX];
    const bt_study* study;
    bt_axes axes;
    bool in_transaction;
};

static bt_where here(const bt_ledger* ledger) {
    return (bt_where){.file = ledger->path};
}

/// What SQLite says, in the words of the person who has to act on it.
static bt_status sql_fail(const bt_ledger* ledger, const char* what, bt_diag* diag) {
    const char* hint = sqlite3_errmsg(ledger->db);
    switch (sqlite3_errcode(ledger->db)) {
    case SQLITE_NOTADB:
        hint = "this is not a bolter ledger; nothing was changed. Move it away, or use another "
               "directory with -o";
        break;
    case SQLITE_CORRUPT:
        hint = "the ledger is damaged; nothing was changed. Restore it, or move it away and run "
               "the campaign again";
        break;
    case SQLITE_FULL:
        hint = "no space left on the disk; everything committed before is kept";
        break;
    case SQLITE_IOERR:
        hint = "the disk refused to read or write (full, or failing); everything committed before "
               "is kept";
        break;
    case SQLITE_READONLY:
        hint = "the ledger cannot be written (read-only file or directory)";
        break;
    case SQLITE_CANTOPEN:
        hint = "cannot be opened (does it exist, and may you read and write it?)";
        break;
    case SQLITE_BUSY:
        hint = "another program keeps the ledger locked";
        break;
    default:
        break;
    }
    bt_diag_add(diag, BT_ERROR, here(ledger), "%s: %s", what, hint);
    return BT_ERR_IO;
}

static bt_status execute(bt_ledger* ledger, const char* sql, const char* what, bt_diag* diag) {
    if (sqlite3_exec(ledger->db, sql, NULL, NULL, NULL) != SQLITE_OK)
        return sql_fail(ledger, what, diag);
    return BT_OK;
}

/// The first column of the first row, as a number.
static bt_status ask(bt_ledger* ledger, const char* sql, int64_t* answer, bt_diag* diag) {
    sqlite3_stmt* statement = NULL;
    if (sqlite3_prepare_v2(ledger->db, sql, -1, &statement, NULL) != SQLITE_OK)
        return sql_fail(ledger, "cannot read", diag);
    const int code = sqlite3_step(statement);
    if (code == SQLITE_ROW)
        *answer = sqlite3_column_int64(statement, 0);
    const bt_status status = code == SQLITE_ROW ? BT_OK : sql_fail(ledger, "cannot read", diag);
    sqlite3_finalize(statement);
    return status;
}

/// A value of the table meta, to be freed; NULL when there is none.
static char* meta_get(const bt_ledger* ledger, const char* key) {
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

static bt_status meta_set(bt_ledger* ledger, const char* key, const char* value, bt_diag* diag) {
    sqlite3_stmt* statement = NULL;
    bt_status status = BT_OK;
    if (sqlite3_prepare_v2(ledger->db, "INSERT OR REPLACE INTO meta VALUES (?, ?)", -1, &statement,
                           NULL) != SQLITE_OK ||
        sqlite3_bind_text(statement, 1, key, -1, SQLITE_STATIC) != SQLITE_OK ||
        sqlite3_bind_text(statement, 2, value, -1, SQLITE_STATIC) != SQLITE_OK ||
        sqlite3_step(statement) != SQLITE_DONE)
        status = sql_fail(ledger, "cannot write", diag);
    sqlite3_finalize(statement);
    return status;
}

static const bt_input* axis_input(const bt_ledger* ledger, int axis) {
    return &ledger->study->inputs[ledger->axes.input[axis]];
}

static const char* sql_type(column_kind kind) {
    switch (kind) {
    case COLUMN_REAL:
        return "REAL";
    case COLUMN_TEXT:
        return "TEXT";
    default:
        return "INTEGER";
    }
}

/// Runs a statement that is put together in memory; the text is consumed.
static bt_status execute_text(bt_ledger* ledger, sqlite3_str* text, bt_diag* diag) {
    char* sql = sqlite3_str_finish(text);
    if (!sql)
        return BT_ERR_MEMORY;
    const bt_status status = execute(ledger, sql, "cannot write", diag);
    sqlite3_free(sql);
    return status;
}

static bt_status create_tables(bt_ledger* ledger, bt_diag* diag) {
    sqlite3_str* text = sqlite3_str_new(ledger->db);
    sqlite3_str_appendf(text,
                        "PRAGMA application_id = %d; PRAGMA user_version = %d;"
                        "CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL);"
                        "CREATE TABLE inputs(idx INTEGER PRIMARY KEY, path TEXT, unit TEXT);",
                        APPLICATION_ID, FORMAT_VERSION);
    for (int i = 0; i < ledger->axes.count; ++i) {
        const bt_input* input = axis_input(ledger, i);
        sqlite3_str_appendf(text, "INSERT INTO inputs VALUES (%d, %Q, %Q);", i, input->path,
                            bt_unit_text(input->field->unit[0] ? input->field->unit : "1"));
    }
    sqlite3_str_appendall(text, "CREATE TABLE runs(run INTEGER PRIMARY KEY");
    for (int i = 0; i < ledger->axes.count; ++i)
        sqlite3_str_appendf(text, ", \"%w\" REAL", axis_input(ledger, i)->path);
    sqlite3_str_appendall(text, ", status TEXT NOT NULL, outcome TEXT, mode TEXT");
    for (int i = 0; i < COLUMN_COUNT; ++i)
        sqlite3_str_appendf(text, ", %s %s", columns[i].name, sql_type(columns[i].kind));
    sqlite3_str_appendall(text, ");");
    return execute_text(ledger, text, diag);
}

/// A new ledger appears complete or not at all.
static bt_status create(bt_ledger* ledger, const char* identity, bt_diag* diag) {
    BT_TRY(execute(ledger, "BEGIN IMMEDIATE", "cannot write", diag));
    bt_status status = create_tables(ledger, diag);
    if (status == BT_OK)
        status = meta_set(ledger, "identity", identity, diag);
    if (status == BT_OK)
        status = meta_set(ledger, "study", ledger->study->text ? ledger->study->text : "", diag);
    if (status == BT_OK)
        status = execute(ledger, "COMMIT", "cannot write", diag);
    if (status != BT_OK)
        sqlite3_exec(ledger->db, "ROLLBACK", NULL, NULL, NULL);
    return status;
}

/// Names the first line in which two identities differ.
static bt_status say_other_study(const bt_ledger* ledger, const char* stored, const char* wanted,
                                 bt_diag* diag) {
    while (*stored && *wanted) {
        const size_t n = strcspn(stored, "\n"), m = strcspn(wanted, "\n");
        if (n != m || strncmp(stored, wanted, n) != 0) {
            bt_diag_add(diag, BT_ERROR, here(ledger),
                        "the ledger belongs to another study: it has \"%.*s\", this study has "
                        "\"%.*s\" (SI). Use another directory with -o, or move the ledger away",
                        (int)n, stored, (int)m, wanted);
            return BT_ERR_IO;
        }
        stored += n + (stored[n] == '\n');
        wanted += m + (wanted[m] == '\n');
    }
    bt_diag_add(diag, BT_ERROR, here(ledger),
                "the ledger belongs to a study with more or fewer keys. Use another directory with "
                "-o, or move the ledger away");
    return BT_ERR_IO;
}

static bt_status check_identity(const bt_ledger* ledger, const char* identity, bt_diag* diag) {
    char* stored = meta_get(ledger, "identity");
    if (!stored) {
        bt_diag_add(diag, BT_ERROR, here(ledger),
                    "the ledger is damaged: it does not say which study it belongs to");
        return BT_ERR_IO;
    }
    const bt_status status =
        strcmp(stored, identity) == 0 ? BT_OK : say_other_study(ledger, stored, identity, diag);
    free(stored);
    return status;
}

/// One row of text, "ok" when SQLite finds the file whole.
static bt_status check_pages(bt_ledger* ledger, bt_diag* diag) {
    sqlite3_stmt* statement = NULL;
    bool whole = false;
    if (sqlite3_prepare_v2(ledger->db, "PRAGMA quick_check(1)", -1, &statement, NULL) ==
            SQLITE_OK &&
        sqlite3_step(statement) == SQLITE_ROW)
        whole = strcmp((const char*)sqlite3_column_text(statement, 0), "ok") == 0;
    sqlite3_finalize(statement);
    if (whole)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, here(ledger),
                "the ledger is damaged; nothing was changed. Restore it, or move it away and run "
                "the campaign again");
    return BT_ERR_IO;
}

static bt_status check_format(bt_ledger* ledger, bt_ledger_access how, const char* identity,
                              bt_diag* diag) {
    int64_t application = 0, version = 0, pages = 0;
    BT_TRY(ask(ledger, "PRAGMA page_count", &pages, diag));
    BT_TRY(ask(ledger, "PRAGMA application_id", &application, diag));
    BT_TRY(ask(ledger, "PRAGMA user_version", &version, diag));
    if (how != BT_LEDGER_READ && sqlite3_db_readonly(ledger->db, "main") == 1) {
        bt_diag_add(diag, BT_ERROR, here(ledger),
                    "the ledger cannot be written (read-only file or directory)");
        return BT_ERR_IO;
    }
    if (pages == 0 && how == BT_LEDGER_CREATE)
        return create(ledger, identity, diag);
    if (application != APPLICATION_ID) {
        bt_diag_add(diag, BT_ERROR, here(ledger),
                    "this is not a bolter ledger; nothing was changed. Move it away, or use "
                    "another directory with -o");
        return BT_ERR_IO;
    }
    if (version != FORMAT_VERSION) {
        bt_diag_add(diag, BT_ERROR, here(ledger),
                    "the ledger has format %lld, this program writes format %d; nothing was "
                    "changed",
                    (long long)version, FORMAT_VERSION);
        return BT_ERR_IO;
    }
    BT_TRY(check_pages(ledger, diag));
    return check_identity(ledger, identity, diag);
}

static bt_status open_checked(bt_ledger* ledger, bt_ledger_access how, bt_diag* diag) {
    if (how != BT_LEDGER_CREATE && access(ledger->path, F_OK) != 0) {
        bt_diag_add(diag, BT_ERROR, here(ledger),
                    "there is no ledger yet; run the campaign first (bolter campaign)");
        return BT_ERR_IO;
    }
    const int flags =
        how == BT_LEDGER_READ ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    if (sqlite3_open_v2(ledger->path, &ledger->db, flags, NULL) != SQLITE_OK)
        return ledger->db ? sql_fail(ledger, "cannot open", diag) : BT_ERR_MEMORY;
    sqlite3_busy_timeout(ledger->db, BUSY_WAIT_MS);

    char* identity = bt_study_identity(ledger->study);
    if (!identity)
        return BT_ERR_MEMORY;
    const bt_status status = check_format(ledger, how, identity, diag);
    free(identity);
    return status;
}

bt_status bt_ledger_open(const char* path, const bt_study* study, bt_ledger_access how,
                         bt_ledger** ledger, bt_diag* diag) {
    bt_ledger* l = calloc(1, sizeof *l);
    if (!l)
        return BT_ERR_MEMORY;
    l->study = study;
    l->axes = bt_design_axes(study);
    bt_status status = strlen(path) < sizeof l->path ? BT_OK : BT_ERR_ARG;
    if (status == BT_OK) {
        memcpy(l->path, path, strlen(path) + 1);
        status = open_checked(l, how, diag);
    }
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
    sqlite3_close(ledger->db);
    free(ledger);
}

static bt_status prepare_insert(bt_ledger* ledger, bt_diag* diag) {
    sqlite3_str* text = sqlite3_str_new(ledger->db);
    sqlite3_str_appendall(text, "INSERT INTO runs VALUES (?");
    for (int i = 1; i < 1 + ledger->axes.count + 3 + COLUMN_COUNT; ++i)
        sqlite3_str_appendall(text, ", ?");
    sqlite3_str_appendall(text, ")");
    char* sql = sqlite3_str_finish(text);
    if (!sql)
        return BT_ERR_MEMORY;
    const int code = sqlite3_prepare_v2(ledger->db, sql, -1, &ledger->insert, NULL);
    sqlite3_free(sql);
    return code == SQLITE_OK ? BT_OK : sql_fail(ledger, "cannot write", diag);
}

static int bind_column(sqlite3_stmt* s, int at, const column* c, const bt_landing_result* result) {
    const char* member = (const char*)result + c->offset;
    switch (c->kind) {
    case COLUMN_REAL: /* a NaN is stored as NULL */
        return sqlite3_bind_double(s, at, *(const double*)member);
    case COLUMN_INT:
        return sqlite3_bind_int(s, at, *(const int*)member);
    case COLUMN_INT64:
        return sqlite3_bind_int64(s, at, *(const int64_t*)member);
    case COLUMN_BOOL:
        return sqlite3_bind_int(s, at, *(const bool*)member);
    case COLUMN_TEXT:
        return *member ? sqlite3_bind_text(s, at, member, -1, SQLITE_STATIC)
                       : sqlite3_bind_null(s, at);
    }
    return SQLITE_MISUSE;
}

static int bind_row(const bt_ledger* ledger, int64_t run, const double* x,
                    const bt_landing_result* result) {
    sqlite3_stmt* s = ledger->insert;
    const bool failed = result->outcome == BT_FAILED;
    int at = 1;
    int code = sqlite3_bind_int64(s, at++, run);
    for (int i = 0; i < ledger->axes.count; ++i)
        code |= sqlite3_bind_double(s, at++, x[i]);
    code |= sqlite3_bind_text(s, at++, failed ? "failed" : "done", -1, SQLITE_STATIC);
    if (!failed) {
        code |= sqlite3_bind_text(s, at, bt_outcome_name(result->outcome), -1, SQLITE_STATIC);
        code |= sqlite3_bind_text(s, at + 1, bt_mode_name(result->mode), -1, SQLITE_STATIC);
    }
    at += 2;
    for (int i = 0; i < COLUMN_COUNT; ++i)
        code |= bind_column(s, at++, &columns[i], result);
    return code;
}

bt_status bt_ledger_add(bt_ledger* ledger, int64_t run, const double* x,
                        const bt_landing_result* result, bt_diag* diag) {
    if (!ledger->insert)
        BT_TRY(prepare_insert(ledger, diag));
    if (!ledger->in_transaction)
        BT_TRY(execute(ledger, "BEGIN IMMEDIATE", "cannot write", diag));
    ledger->in_transaction = true;

    sqlite3_reset(ledger->insert);
    sqlite3_clear_bindings(ledger->insert);
    if (bind_row(ledger, run, x, result) == SQLITE_OK &&
        sqlite3_step(ledger->insert) == SQLITE_DONE) {
        sqlite3_reset(ledger->insert);
        return BT_OK;
    }
    const bt_status status = sql_fail(ledger, "cannot write", diag);
    sqlite3_reset(ledger->insert);
    sqlite3_exec(ledger->db, "ROLLBACK", NULL, NULL, NULL);
    ledger->in_transaction = false;
    return status;
}

bt_status bt_ledger_commit(bt_ledger* ledger, bt_diag* diag) {
    if (!ledger->in_transaction)
        return BT_OK;
    ledger->in_transaction = false;
    const bt_status status = execute(ledger, "COMMIT", "cannot write", diag);
    if (status != BT_OK)
        sqlite3_exec(ledger->db, "ROLLBACK", NULL, NULL, NULL);
    return status;
}

bt_status bt_ledger_count(bt_ledger* ledger, bt_ledger_counts* counts, bt_diag* diag) {
    BT_TRY(ask(ledger, "SELECT count(*) FROM runs", &counts->runs, diag));
    BT_TRY(
        ask(ledger, "SELECT count(*) FROM runs WHERE outcome = 'engaged'", &counts->engaged, diag));
    BT_TRY(
        ask(ledger, "SELECT count(*) FROM runs WHERE outcome = 'missed'", &counts->missed, diag));
    return ask(ledger, "SELECT count(*) FROM runs WHERE status = 'failed'", &counts->failed, diag);
}

static double column_real(sqlite3_stmt* s, int at) {
    return sqlite3_column_type(s, at) == SQLITE_NULL ? NAN : sqlite3_column_double(s, at);
}

static void read_column(sqlite3_stmt* s, int at, const column* c, bt_landing_result* result) {
    char* member = (char*)result + c->offset;
    switch (c->kind) {
    case COLUMN_REAL:
        *(double*)member = column_real(s, at);
        break;
    case COLUMN_INT:
        *(int*)member = sqlite3_column_int(s, at);
        break;
    case COLUMN_INT64:
        *(int64_t*)member = sqlite3_column_int64(s, at);
        break;
    case COLUMN_BOOL:
        *(bool*)member = sqlite3_column_int(s, at) != 0;
        break;
    case COLUMN_TEXT:
        if (sqlite3_column_text(s, at))
            snprintf(member, FAILED_TEXT_SIZE, "%s", (const char*)sqlite3_column_text(s, at));
        break;
    }
}

static bt_outcome read_outcome(const char* text) {
    if (text && strcmp(text, bt_outcome_name(BT_ENGAGED)) == 0)
        return BT_ENGAGED;
    if (text && strcmp(text, bt_outcome_name(BT_MISSED)) == 0)
        return BT_MISSED;
    return BT_FAILED;
}

static bt_mode read_mode(const char* text) {
    for (int mode = BT_MODE_NONE; text && mode <= BT_MODE_RIDDEN_OVER; ++mode)
        if (strcmp(text, bt_mode_name((bt_mode)mode)) == 0)
            return (bt_mode)mode;
    return BT_MODE_NONE;
}

static void read_row(const bt_ledger* ledger, sqlite3_stmt* s, bt_ledger_row* row) {
    memset(row, 0, sizeof *row);
    int at = 0;
    row->run = sqlite3_column_int64(s, at++);
    for (int i = 0; i < ledger->axes.count; ++i)
        row->x[i] = column_real(s, at++);
    ++at; /* the status repeats what the outcome says */
    row->result.outcome = read_outcome((const char*)sqlite3_column_text(s, at++));
    row->result.mode = read_mode((const char*)sqlite3_column_text(s, at++));
    for (int i = 0; i < COLUMN_COUNT; ++i)
        read_column(s, at++, &columns[i], &row->result);
}

/// Walks the rows a statement gives; the statement is consumed.
static bt_status walk(bt_ledger* ledger, sqlite3_stmt* statement, bt_ledger_visit* visit,
                      void* user, bt_diag* diag) {
    bt_ledger_row row;
    int code = SQLITE_ROW;
    bool more = true;
    while (more && (code = sqlite3_step(statement)) == SQLITE_ROW) {
        read_row(ledger, statement, &row);
        more = visit(user, &row);
    }
    const bt_status status =
        code == SQLITE_ROW || code == SQLITE_DONE ? BT_OK : sql_fail(ledger, "cannot read", diag);
    sqlite3_finalize(statement);
    return status;
}

bt_status bt_ledger_walk(bt_ledger* ledger, bt_ledger_visit* visit, void* user, bt_diag* diag) {
    sqlite3_stmt* statement = NULL;
    if (sqlite3_prepare_v2(ledger->db, "SELECT * FROM runs ORDER BY run", -1, &statement, NULL) !=
        SQLITE_OK)
        return sql_fail(ledger, "cannot read", diag);
    return walk(ledger, statement, visit, user, diag);
}

typedef struct found {
    bt_ledger_row* row;
    bool any;
} found;

static bool take_one(void* user, const bt_ledger_row* row) {
    found* f = user;
    *f->row = *row;
    f->any = true;
    return false;
}

bt_status bt_ledger_get(bt_ledger* ledger, int64_t run, bt_ledger_row* row, bt_diag* diag) {
    sqlite3_stmt* statement = NULL;
    if (sqlite3_prepare_v2(ledger->db, "SELECT * FROM runs WHERE run = ?", -1, &statement, NULL) !=
            SQLITE_OK ||
        sqlite3_bind_int64(statement, 1, run) != SQLITE_OK) {
        sqlite3_finalize(statement);
        return sql_fail(ledger, "cannot read", diag);
    }
    found f = {.row = row};
    BT_TRY(walk(ledger, statement, take_one, &f, diag));
    return f.any ? BT_OK : BT_ERR_ARG;
}

/// FNV-1a, 64 bits.
static void hash_bytes(uint64_t* hash, const void* data, size_t size) {
    const unsigned char* bytes = data;
    for (size_t i = 0; i < size; ++i)
        *hash = (*hash ^ bytes[i]) * 0x100000001b3u;
}

typedef struct hashing {
    const bt_ledger* ledger;
    uint64_t hash;
} hashing;

static size_t column_size(const column* c, const char* member) {
    switch (c->kind) {
    case COLUMN_INT:
        return sizeof(int);
    case COLUMN_BOOL:
        return sizeof(bool);
    case COLUMN_TEXT:
        return strlen(member);
    default:
        return sizeof(double);
    }
}

static bool hash_row(void* user, const bt_ledger_row* row) {
    hashing* h = user;
    hash_bytes(&h->hash, &row->run, sizeof row->run);
    hash_bytes(&h->hash, row->x, sizeof row->x[0] * (size_t)h->ledger->axes.count);
    hash_bytes(&h->hash, &row->result.outcome, sizeof row->result.outcome);
    hash_bytes(&h->hash, &row->result.mode, sizeof row->result.mode);
    for (int i = 0; i < HASHED_COUNT; ++i) {
        const char* member = (const char*)&row->result + columns[i].offset;
        hash_bytes(&h->hash, member, column_size(&columns[i], member));
    }
    return true;
}

bt_status bt_ledger_hash(bt_ledger* ledger, uint64_t* hash, bt_diag* diag) {
    hashing h = {.ledger = ledger, .hash = 0xcbf29ce484222325u};
    BT_TRY(bt_ledger_walk(ledger, hash_row, &h, diag));
    *hash = h.hash;
    return BT_OK;
}

char* bt_ledger_remark(const bt_ledger* ledger, const char* key) {
    return meta_get(ledger, key);
}

bt_status bt_ledger_set_remark(bt_ledger* ledger, const char* key, const char* text,
                               bt_diag* diag) {
    BT_TRY(bt_ledger_commit(ledger, diag));
    return meta_set(ledger, key, text, diag);
}

typedef struct merging {
    bt_ledger* into;
    bt_diag* diag;
    bt_status status;
    int64_t added;
} merging;

static bool merge_row(void* user, const bt_ledger_row* row) {
    merging* m = user;
    bt_ledger_row mine;
    m->status = bt_ledger_get(m->into, row->run, &mine, m->diag);
    if (m->status == BT_OK) {
        hashing a = {.ledger = m->into}, b = {.ledger = m->into};
        hash_row(&a, row);
        hash_row(&b, &mine);
        if (a.hash != b.hash) {
            bt_diag_add(m->diag, BT_ERROR, here(m->into),
                        "run %lld differs between the two ledgers (another machine or version?); "
                        "nothing was merged",
                        (long long)row->run);
            m->status = BT_ERR_INPUT;
        }
    } else if (m->status == BT_ERR_ARG) {
        m->status = bt_ledger_add(m->into, row->run, row->x, &row->result, m->diag);
        m->added += m->status == BT_OK;
    }
    return m->status == BT_OK;
}

bt_status bt_ledger_merge(bt_ledger* ledger, const char* path, int64_t* added, bt_diag* diag) {
    BT_TRY(bt_ledger_commit(ledger, diag));
    bt_ledger* other = NULL;
    BT_TRY(bt_ledger_open(path, ledger->study, BT_LEDGER_READ, &other, diag));
    merging m = {.into = ledger, .diag = diag};
    bt_status status = bt_ledger_walk(other, merge_row, &m, diag);
    bt_ledger_close(other);
    if (status == BT_OK)
        status = m.status;
    if (status == BT_OK)
        status = bt_ledger_commit(ledger, diag);
    else if (ledger->in_transaction) {
        sqlite3_exec(ledger->db, "ROLLBACK", NULL, NULL, NULL);
        ledger->in_transaction = false;
    }
    if (status == BT_OK)
        *added = m.added;
    return status;
}
