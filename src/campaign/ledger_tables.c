#include "campaign/ledger_parts.h"

#include "base/units.h"

#include <string.h>

/// Columns beside the axes that no table of results has.
static const char log_density[] = "log_density";

const char* bt_ledger_axis(const bt_ledger* ledger, int axis) {
    return ledger->study->inputs[ledger->axes.input[axis]].path;
}

static const char* sql_type(bt_result_kind kind) {
    switch (kind) {
    case BT_RESULT_REAL:
        return "REAL";
    case BT_RESULT_OUTCOME:
    case BT_RESULT_MODE:
    case BT_RESULT_TEXT:
    case BT_RESULT_REMARKS:
        return "TEXT";
    default:
        return "INTEGER";
    }
}

static void append_inputs(bt_ledger* ledger, sqlite3_str* text) {
    sqlite3_str_appendall(text,
                          "CREATE TABLE inputs(idx INTEGER PRIMARY KEY, path TEXT, unit TEXT);");
    for (int i = 0; i < ledger->axes.count; ++i) {
        const bt_input* input = &ledger->study->inputs[ledger->axes.input[i]];
        sqlite3_str_appendf(text, "INSERT INTO inputs VALUES (%d, %Q, %Q);", i, input->path,
                            bt_unit_text(input->field->unit[0] ? input->field->unit : "1"));
    }
}

static void append_runs(bt_ledger* ledger, sqlite3_str* text) {
    sqlite3_str_appendall(text, "CREATE TABLE runs(run INTEGER PRIMARY KEY");
    for (int i = 0; i < ledger->axes.count; ++i)
        sqlite3_str_appendf(text, ", \"%w\" REAL", bt_ledger_axis(ledger, i));
    sqlite3_str_appendf(text, ", %s REAL, status TEXT NOT NULL", log_density);
    for (int i = 0; i < bt_result_column_count; ++i)
        if (bt_ledger_keeps(&bt_result_columns[i]))
            sqlite3_str_appendf(text, ", %s %s", bt_result_columns[i].name,
                                sql_type(bt_result_columns[i].kind));
    sqlite3_str_appendall(text, ");");
}

/// One row per landing and wire that its hook met.
static void append_contacts(sqlite3_str* text) {
    sqlite3_str_appendall(text, "CREATE TABLE IF NOT EXISTS contacts(run INTEGER");
    for (int i = 0; i < bt_contact_column_count; ++i)
        sqlite3_str_appendf(text, ", %s %s", bt_contact_columns[i].name,
                            sql_type(bt_contact_columns[i].kind));
    sqlite3_str_appendall(text, ", PRIMARY KEY(run, wire)) WITHOUT ROWID;");
}

bt_status bt_ledger_make_tables(bt_ledger* ledger, bt_diag* diag) {
    sqlite3_str* text = sqlite3_str_new(ledger->db);
    sqlite3_str_appendall(text, "CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL);");
    append_inputs(ledger, text);
    append_runs(ledger, text);
    append_contacts(text);
    sqlite3_str_appendall(text,
                          "CREATE VIEW landings AS SELECT * FROM runs WHERE status = 'done';"
                          "CREATE VIEW misses AS SELECT * FROM runs WHERE outcome = 'missed';"
                          "CREATE VIEW failed AS SELECT * FROM runs WHERE status = 'failed';");
    BT_TRY(bt_ledger_execute_text(ledger, text, diag));
    return bt_ledger_make_totals(ledger, diag);
}

/// Whether the table of runs has a column.
static bt_status has_column(bt_ledger* ledger, const char* name, bool* has, bt_diag* diag) {
    char* sql =
        sqlite3_mprintf("SELECT count(*) FROM pragma_table_info('runs') WHERE name = %Q", name);
    int64_t count = 0;
    if (!sql)
        return BT_ERR_MEMORY;
    const bt_status status = bt_ledger_integer(ledger, sql, &count, diag);
    sqlite3_free(sql);
    *has = count > 0;
    return status;
}

/// Appends a column to a SELECT: itself, or nothing in its place in a file that was written before
/// there was such a column.
static bt_status append_column(bt_ledger* ledger, sqlite3_str* select, const char* name,
                               const char* type, bool writing, bt_diag* diag) {
    bool has = false;
    BT_TRY(has_column(ledger, name, &has, diag));
    if (!has && writing) {
        sqlite3_str* add = sqlite3_str_new(ledger->db);
        sqlite3_str_appendf(add, "ALTER TABLE runs ADD COLUMN %s %s", name, type);
        BT_TRY(bt_ledger_execute_text(ledger, add, diag));
    }
    sqlite3_str_appendf(select, ", %s%s", has || writing ? "" : "NULL AS ", name);
    return BT_OK;
}

static bt_status append_columns(bt_ledger* ledger, sqlite3_str* select, bool writing,
                                bt_diag* diag) {
    sqlite3_str_appendall(select, "SELECT run");
    for (int i = 0; i < ledger->axes.count; ++i)
        sqlite3_str_appendf(select, ", \"%w\"", bt_ledger_axis(ledger, i));
    BT_TRY(append_column(ledger, select, log_density, "REAL", writing, diag));
    for (int i = 0; i < bt_result_column_count; ++i)
        if (bt_ledger_keeps(&bt_result_columns[i]))
            BT_TRY(append_column(ledger, select, bt_result_columns[i].name,
                                 sql_type(bt_result_columns[i].kind), writing, diag));
    sqlite3_str_appendall(select, " FROM runs");
    return BT_OK;
}

static bt_status find_contacts(bt_ledger* ledger, bool writing, bt_diag* diag) {
    int64_t count = 0;
    if (writing) {
        sqlite3_str* text = sqlite3_str_new(ledger->db);
        append_contacts(text);
        BT_TRY(bt_ledger_execute_text(ledger, text, diag));
    }
    BT_TRY(bt_ledger_integer(ledger, "SELECT count(*) FROM pragma_table_info('contacts')", &count,
                             diag));
    ledger->has_contacts = count > 0;
    return BT_OK;
}

bt_status bt_ledger_bind_columns(bt_ledger* ledger, bool writing, bt_diag* diag) {
    BT_TRY(find_contacts(ledger, writing, diag));
    sqlite3_str* select = sqlite3_str_new(ledger->db);
    const bt_status status = append_columns(ledger, select, writing, diag);
    ledger->select = sqlite3_str_finish(select);
    if (status != BT_OK)
        return status;
    return ledger->select ? BT_OK : BT_ERR_MEMORY;
}
