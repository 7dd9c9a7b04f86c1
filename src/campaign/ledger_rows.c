#include "campaign/ledger_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// --- writing --------------------------------------------------------------------------------

/// The text is consumed.
static bt_status prepare(bt_ledger* ledger, sqlite3_str* text, const char* what,
                         sqlite3_stmt** statement, bt_diag* diag) {
    char* sql = sqlite3_str_finish(text);
    if (!sql)
        return BT_ERR_MEMORY;
    const int code =
        sqlite3_prepare_v3(ledger->db, sql, -1, SQLITE_PREPARE_PERSISTENT, statement, NULL);
    sqlite3_free(sql);
    return code == SQLITE_OK ? BT_OK : bt_ledger_sql_error(ledger, what, diag);
}

static bt_status prepare_insert(bt_ledger* ledger, bt_diag* diag) {
    sqlite3_str* text = sqlite3_str_new(ledger->db);
    int count = 3;
    sqlite3_str_appendall(text, "INSERT INTO runs(run, log_density, status");
    for (int i = 0; i < ledger->axes.count; ++i, ++count)
        sqlite3_str_appendf(text, ", \"%w\"", bt_ledger_axis(ledger, i));
    for (int i = 0; i < bt_result_column_count; ++i)
        if (bt_ledger_keeps(&bt_result_columns[i])) {
            sqlite3_str_appendf(text, ", %s", bt_result_columns[i].name);
            ++count;
        }
    sqlite3_str_appendall(text, ") VALUES (?");
    while (--count > 0)
        sqlite3_str_appendall(text, ", ?");
    sqlite3_str_appendall(text, ")");
    return prepare(ledger, text, "cannot write", &ledger->insert, diag);
}

static int bind_text(sqlite3_stmt* s, int at, const char* text) {
    return *text ? sqlite3_bind_text(s, at, text, -1, SQLITE_TRANSIENT) : sqlite3_bind_null(s, at);
}

static int bind_remarks(sqlite3_stmt* s, int at, const bt_remarks* remarks) {
    char text[BT_REMARKS_TEXT_SIZE];
    bt_remarks_print(remarks, text, sizeof text);
    return bind_text(s, at, text);
}

/// Of a landing or of a contact. A NaN is stored as NULL; a failed run has neither outcome nor
/// mode.
static int bind_column(sqlite3_stmt* s, int at, const bt_result_column* c, const void* from) {
    const char* member = (const char*)from + c->offset;
    switch (c->kind) {
    case BT_RESULT_OUTCOME:
        return *(const bt_outcome*)member == BT_FAILED
                   ? sqlite3_bind_null(s, at)
                   : sqlite3_bind_text(s, at, bt_outcome_name(*(const bt_outcome*)member), -1,
                                       SQLITE_STATIC);
    case BT_RESULT_MODE:
        return *(const bt_mode*)member == BT_MODE_NONE
                   ? sqlite3_bind_null(s, at)
                   : sqlite3_bind_text(s, at, bt_mode_name(*(const bt_mode*)member), -1,
                                       SQLITE_STATIC);
    case BT_RESULT_FLAG:
        return sqlite3_bind_int(s, at, *(const bool*)member);
    case BT_RESULT_INT:
        return sqlite3_bind_int(s, at, *(const int*)member);
    case BT_RESULT_COUNT:
    case BT_RESULT_HASH:
        return sqlite3_bind_int64(s, at, *(const int64_t*)member);
    case BT_RESULT_REAL:
        return sqlite3_bind_double(s, at, *(const double*)member);
    case BT_RESULT_TEXT:
        return bind_text(s, at, member);
    case BT_RESULT_REMARKS:
        return bind_remarks(s, at, (const bt_remarks*)member);
    }
    return SQLITE_MISUSE;
}

static int bind_row(const bt_ledger* ledger, int64_t run, const double* x, double log_density,
                    const bt_landing_result* result) {
    sqlite3_stmt* s = ledger->insert;
    int at = 1;
    int code = sqlite3_bind_int64(s, at++, run);
    code |= sqlite3_bind_double(s, at++, log_density);
    code |= sqlite3_bind_text(s, at++, result->outcome == BT_FAILED ? "failed" : "done", -1,
                              SQLITE_STATIC);
    for (int i = 0; i < ledger->axes.count; ++i)
        code |= sqlite3_bind_double(s, at++, x[i]);
    for (int i = 0; i < bt_result_column_count; ++i)
        if (bt_ledger_keeps(&bt_result_columns[i]))
            code |= bind_column(s, at++, &bt_result_columns[i], result);
    return code;
}

static bt_status prepare_insert_contact(bt_ledger* ledger, bt_diag* diag) {
    sqlite3_str* text = sqlite3_str_new(ledger->db);
    sqlite3_str_appendall(text, "INSERT OR REPLACE INTO contacts(run");
    for (int i = 0; i < bt_contact_column_count; ++i)
        sqlite3_str_appendf(text, ", %s", bt_contact_columns[i].name);
    sqlite3_str_appendall(text, ") VALUES (?");
    for (int i = 0; i < bt_contact_column_count; ++i)
        sqlite3_str_appendall(text, ", ?");
    sqlite3_str_appendall(text, ")");
    return prepare(ledger, text, "cannot write", &ledger->insert_contact, diag);
}

static bool add_contact(const bt_ledger* ledger, int64_t run, const bt_contact* contact) {
    sqlite3_stmt* s = ledger->insert_contact;
    sqlite3_reset(s);
    int code = sqlite3_bind_int64(s, 1, run);
    for (int i = 0; i < bt_contact_column_count; ++i)
        code |= bind_column(s, 2 + i, &bt_contact_columns[i], contact);
    return code == SQLITE_OK && sqlite3_step(s) == SQLITE_DONE;
}

static bool add_contacts(const bt_ledger* ledger, int64_t run, const bt_landing_result* result) {
    bool added = true;
    for (int k = 0; k < result->contact_count && added; ++k)
        added = add_contact(ledger, run, &result->contacts[k]);
    return added;
}

/// Takes the right to write, and what the runs add up to so far.
static bt_status begin(bt_ledger* ledger, bt_diag* diag) {
    if (ledger->in_transaction)
        return BT_OK;
    BT_TRY(bt_ledger_execute(ledger, "BEGIN IMMEDIATE", "cannot write", diag));
    const bt_status status = bt_ledger_load_totals(ledger, diag);
    if (status == BT_OK)
        ledger->in_transaction = true;
    else
        bt_ledger_roll_back(ledger);
    return status;
}

/// Adds a row; what SQLite says of it.
static int insert_row(bt_ledger* ledger, int64_t run, const double* x, double log_density,
                      const bt_landing_result* result) {
    sqlite3_reset(ledger->insert);
    const int code = bind_row(ledger, run, x, log_density, result);
    return code == SQLITE_OK ? sqlite3_step(ledger->insert) : code;
}

static bt_status add(bt_ledger* ledger, bool known_is_error, int64_t run, const double* x,
                     double log_density, const bt_landing_result* result, bt_diag* diag) {
    if (!ledger->insert) {
        BT_TRY(prepare_insert(ledger, diag));
        BT_TRY(prepare_insert_contact(ledger, diag));
    }
    BT_TRY(begin(ledger, diag));
    bt_status status = BT_OK;
    const bool added = insert_row(ledger, run, x, log_density, result) == SQLITE_DONE;
    if (added && add_contacts(ledger, run, result))
        bt_ledger_count_run(ledger, run, x, log_density, result);
    else if (!added && sqlite3_extended_errcode(ledger->db) == SQLITE_CONSTRAINT_PRIMARYKEY &&
             !known_is_error)
        status = BT_ERR_ARG;
    else
        status = bt_ledger_sql_error(ledger, "cannot write", diag);
    sqlite3_reset(ledger->insert);
    sqlite3_reset(ledger->insert_contact);
    if (status == BT_ERR_IO)
        bt_ledger_roll_back(ledger);
    return status;
}

bt_status bt_ledger_add(bt_ledger* ledger, int64_t run, const double* x, double log_density,
                        const bt_landing_result* result, bt_diag* diag) {
    return add(ledger, true, run, x, log_density, result, diag);
}

bt_status bt_ledger_add_new(bt_ledger* ledger, int64_t run, const double* x, double log_density,
                            const bt_landing_result* result, bt_diag* diag) {
    return add(ledger, false, run, x, log_density, result, diag);
}

bt_status bt_ledger_commit(bt_ledger* ledger, bt_diag* diag) {
    if (!ledger->in_transaction)
        return BT_OK;
    bt_status status = bt_ledger_store_totals(ledger, diag);
    if (status == BT_OK)
        status = bt_ledger_execute(ledger, "COMMIT", "cannot write", diag);
    if (status != BT_OK)
        bt_ledger_roll_back(ledger);
    ledger->in_transaction = false;
    return status;
}

// --- reading --------------------------------------------------------------------------------

static double column_real(sqlite3_stmt* s, int at) {
    return sqlite3_column_type(s, at) == SQLITE_NULL ? NAN : sqlite3_column_double(s, at);
}

static bt_outcome read_outcome(const char* text) {
    if (text && strcmp(text, bt_outcome_name(BT_ENGAGED)) == 0)
        return BT_ENGAGED;
    if (text && strcmp(text, bt_outcome_name(BT_MISSED)) == 0)
        return BT_MISSED;
    return BT_FAILED;
}

static bt_mode read_mode(const char* text) {
    for (int mode = 0; text && mode < BT_MODE_COUNT; ++mode)
        if (strcmp(text, bt_mode_name((bt_mode)mode)) == 0)
            return (bt_mode)mode;
    return BT_MODE_NONE;
}

/// Into a landing or a contact.
static void read_column(sqlite3_stmt* s, int at, const bt_result_column* c, void* into) {
    char* member = (char*)into + c->offset;
    const char* text = NULL;
    switch (c->kind) {
    case BT_RESULT_OUTCOME:
        *(bt_outcome*)member = read_outcome((const char*)sqlite3_column_text(s, at));
        break;
    case BT_RESULT_MODE:
        *(bt_mode*)member = read_mode((const char*)sqlite3_column_text(s, at));
        break;
    case BT_RESULT_FLAG:
        *(bool*)member = sqlite3_column_int(s, at) != 0;
        break;
    case BT_RESULT_INT:
        *(int*)member = sqlite3_column_int(s, at);
        break;
    case BT_RESULT_COUNT:
    case BT_RESULT_HASH:
        *(int64_t*)member = sqlite3_column_int64(s, at);
        break;
    case BT_RESULT_REAL:
        *(double*)member = column_real(s, at);
        break;
    case BT_RESULT_TEXT:
        if ((text = (const char*)sqlite3_column_text(s, at)))
            snprintf(member, BT_FAILED_TEXT_SIZE, "%s", text);
        break;
    case BT_RESULT_REMARKS:
        if ((text = (const char*)sqlite3_column_text(s, at)))
            bt_remarks_parse(text, (bt_remarks*)member);
        break;
    }
}

/// In the order of bt_ledger_bind_columns.
static void read_row(const bt_ledger* ledger, sqlite3_stmt* s, bt_ledger_row* row) {
    memset(row, 0, sizeof *row);
    int at = 0;
    row->run = sqlite3_column_int64(s, at++);
    for (int i = 0; i < ledger->axes.count; ++i)
        row->x[i] = column_real(s, at++);
    row->log_density = column_real(s, at++);
    for (int i = 0; i < bt_result_column_count; ++i)
        if (bt_ledger_keeps(&bt_result_columns[i]))
            read_column(s, at++, &bt_result_columns[i], &row->result);
}

/// The contacts of the runs that a walk visits, in their order: a second cursor, a row ahead.
static bt_status open_contacts(bt_ledger* ledger, const char* where, sqlite3_stmt** contacts,
                               bt_diag* diag) {
    sqlite3_str* text = sqlite3_str_new(ledger->db);
    sqlite3_str_appendall(text, "SELECT run");
    for (int i = 0; i < bt_contact_column_count; ++i)
        sqlite3_str_appendf(text, ", %s", bt_contact_columns[i].name);
    sqlite3_str_appendf(text, " FROM contacts %s ORDER BY run, wire", where);
    return prepare(ledger, text, "cannot read", contacts, diag);
}

/// Those of one run. *ahead: the cursor stands on a row that was not read yet.
static int read_contacts(sqlite3_stmt* s, bool* ahead, bt_ledger_row* row) {
    int code = SQLITE_ROW;
    while (*ahead || (code = sqlite3_step(s)) == SQLITE_ROW) {
        const int64_t run = sqlite3_column_int64(s, 0);
        *ahead = run > row->run;
        if (*ahead)
            return SQLITE_ROW;
        if (run < row->run || row->result.contact_count == BT_CONTACT_MAX)
            continue;
        bt_contact* contact = &row->result.contacts[row->result.contact_count++];
        for (int i = 0; i < bt_contact_column_count; ++i)
            read_column(s, 1 + i, &bt_contact_columns[i], contact);
    }
    return code;
}

/// Walks the rows of a SELECT with `where` and order behind it, whose one parameter, if any, is a
/// run.
static bt_status walk(bt_ledger* ledger, const char* where, int64_t run, bt_ledger_visit* visit,
                      void* user, bt_diag* diag) {
    sqlite3_stmt *statement = NULL, *contacts = NULL;
    sqlite3_str* text = sqlite3_str_new(ledger->db);
    sqlite3_str_appendf(text, "%s %s ORDER BY run", ledger->select, where);
    bt_status status = prepare(ledger, text, "cannot read", &statement, diag);
    if (status == BT_OK && ledger->has_contacts)
        status = open_contacts(ledger, where, &contacts, diag);
    if (status == BT_OK && sqlite3_bind_parameter_count(statement) > 0) {
        sqlite3_bind_int64(statement, 1, run);
        if (contacts)
            sqlite3_bind_int64(contacts, 1, run);
    }
    bool more = status == BT_OK, ahead = false;
    int code = SQLITE_DONE;
    bt_ledger_row row;
    while (more && (code = sqlite3_step(statement)) == SQLITE_ROW) {
        read_row(ledger, statement, &row);
        if (contacts && (code = read_contacts(contacts, &ahead, &row)) != SQLITE_ROW &&
            code != SQLITE_DONE)
            break;
        more = visit(user, &row);
    }
    if (status == BT_OK && code != SQLITE_ROW && code != SQLITE_DONE)
        status = bt_ledger_sql_error(ledger, "cannot read", diag);
    sqlite3_finalize(statement);
    sqlite3_finalize(contacts);
    return status;
}

bt_status bt_ledger_walk(bt_ledger* ledger, bt_ledger_visit* visit, void* user, bt_diag* diag) {
    return walk(ledger, "", 0, visit, user, diag);
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
    found f = {.row = row};
    BT_TRY(walk(ledger, "WHERE run = ?", run, take_one, &f, diag));
    return f.any ? BT_OK : BT_ERR_ARG;
}

bt_status bt_ledger_scan(bt_ledger* ledger, bt_ledger_glance* visit, void* user, bt_diag* diag) {
    sqlite3_stmt* s = NULL;
    int code =
        sqlite3_prepare_v2(ledger->db, "SELECT run, outcome FROM runs ORDER BY run", -1, &s, NULL);
    while (code == SQLITE_OK || code == SQLITE_ROW) {
        code = sqlite3_step(s);
        if (code == SQLITE_ROW)
            visit(user, sqlite3_column_int64(s, 0),
                  read_outcome((const char*)sqlite3_column_text(s, 1)));
    }
    const bt_status status =
        code == SQLITE_DONE ? BT_OK : bt_ledger_sql_error(ledger, "cannot read", diag);
    sqlite3_finalize(s);
    return status;
}

bt_status bt_ledger_last_run(bt_ledger* ledger, int64_t* run, bt_diag* diag) {
    return bt_ledger_integer(ledger, "SELECT ifnull(max(run), -1) FROM runs", run, diag);
}
