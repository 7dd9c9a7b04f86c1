/// What the runs of a ledger add up to, kept beside them so that counting and fingerprinting read
/// one row instead of all.
///
/// The table `totals` is brought up to date in the transaction that adds runs. Rows that others
/// change by SQL are noticed by triggers: an insertion is `pending` until the ledger counts it
/// itself, an update or a deletion makes the totals unknown. Unknown totals are added up again.
#include "campaign/ledger_parts.h"

#include "base/hash.h"

#include <math.h>
#include <string.h>

// --- the hash of a run ------------------------------------------------------------------------

static uint64_t hash_text(uint64_t hash, const char* text) {
    return bt_hash_bytes(hash, text, strlen(text));
}

/// As the file keeps it: one NaN (NULL), one zero.
static uint64_t hash_real(uint64_t hash, double value) {
    const double kept = isnan(value) ? NAN : value + 0.0;
    return bt_hash_bytes(hash, &kept, sizeof kept);
}

static uint64_t hash_remarks(uint64_t hash, const bt_remarks* remarks) {
    char text[BT_REMARKS_TEXT_SIZE];
    bt_remarks_print(remarks, text, sizeof text);
    return hash_text(hash, text);
}

/// Of a landing or of a contact.
static uint64_t hash_column(uint64_t hash, const bt_result_column* c, const void* from) {
    const char* member = (const char*)from + c->offset;
    switch (c->kind) {
    case BT_RESULT_MODE:
        if (*(const bt_mode*)member == BT_MODE_NONE)
            return hash; // kept as NULL
        return bt_hash_bytes(hash, member, sizeof(int));
    case BT_RESULT_OUTCOME:
    case BT_RESULT_INT:
        return bt_hash_bytes(hash, member, sizeof(int));
    case BT_RESULT_FLAG:
        return bt_hash_bytes(hash, member, sizeof(bool));
    case BT_RESULT_COUNT:
    case BT_RESULT_HASH:
        return bt_hash_bytes(hash, member, sizeof(int64_t));
    case BT_RESULT_REAL:
        return hash_real(hash, *(const double*)member);
    case BT_RESULT_TEXT:
        return hash_text(hash, member);
    case BT_RESULT_REMARKS:
        return hash_remarks(hash, (const bt_remarks*)member);
    }
    return hash;
}

/// Spreads a hash over all its bits before it is added to others (MurmurHash3's finaliser).
static uint64_t spread(uint64_t h) {
    h ^= h >> 33;
    h *= UINT64_C(0xff51afd7ed558ccd);
    h ^= h >> 33;
    h *= UINT64_C(0xc4ceb9fe1a85ec53);
    return h ^ h >> 33;
}

uint64_t bt_ledger_hash_run(const bt_ledger* ledger, int64_t run, const double* x,
                            double log_density, const bt_landing_result* result) {
    uint64_t hash = bt_hash_bytes(BT_HASH_START, &run, sizeof run);
    for (int i = 0; i < ledger->axes.count; ++i)
        hash = hash_real(hash, x[i]);
    if (!isnan(log_density))
        hash = hash_real(hash, log_density);
    for (int i = 0; i < bt_result_column_count; ++i) {
        const bt_result_column* c = &bt_result_columns[i];
        if (bt_ledger_keeps(c) && c->offset != offsetof(bt_landing_result, wall_s))
            hash = hash_column(hash, c, result);
    }
    for (int k = 0; k < result->contact_count; ++k)
        for (int i = 0; i < bt_contact_column_count; ++i)
            hash = hash_column(hash, &bt_contact_columns[i], &result->contacts[k]);
    return spread(hash);
}

// --- adding up --------------------------------------------------------------------------------

void bt_ledger_count_run(bt_ledger* ledger, int64_t run, const double* x, double log_density,
                         const bt_landing_result* result) {
    bt_ledger_totals* t = &ledger->totals;
    ++t->counts.runs;
    t->counts.engaged += result->outcome == BT_ENGAGED;
    t->counts.missed += result->outcome == BT_MISSED;
    t->counts.failed += result->outcome == BT_FAILED;
    t->hash += bt_ledger_hash_run(ledger, run, x, log_density, result);
}

static bool count_row(void* user, const bt_ledger_row* row) {
    bt_ledger_count_run(user, row->run, row->x, row->log_density, &row->result);
    return true;
}

/// Adds up every row.
static bt_status add_up(bt_ledger* ledger, bt_diag* diag) {
    ledger->totals = (bt_ledger_totals){0};
    return bt_ledger_walk(ledger, count_row, ledger, diag);
}

/// What the file says; false when it does not know.
static bool read_totals(bt_ledger* ledger) {
    sqlite3_stmt* s = NULL;
    bt_ledger_totals* t = &ledger->totals;
    *t = (bt_ledger_totals){0};
    const bool known =
        sqlite3_prepare_v2(ledger->db,
                           "SELECT runs, engaged, missed, failed, content FROM totals "
                           "WHERE pending = 0 AND runs IS NOT NULL",
                           -1, &s, NULL) == SQLITE_OK &&
        sqlite3_step(s) == SQLITE_ROW;
    if (known) {
        t->counts = (bt_ledger_counts){sqlite3_column_int64(s, 0), sqlite3_column_int64(s, 1),
                                       sqlite3_column_int64(s, 2), sqlite3_column_int64(s, 3)};
        t->hash = (uint64_t)sqlite3_column_int64(s, 4);
    }
    sqlite3_finalize(s);
    return known;
}

bt_status bt_ledger_load_totals(bt_ledger* ledger, bt_diag* diag) {
    return read_totals(ledger) ? BT_OK : add_up(ledger, diag);
}

bt_status bt_ledger_store_totals(bt_ledger* ledger, bt_diag* diag) {
    const bt_ledger_totals* t = &ledger->totals;
    sqlite3_str* text = sqlite3_str_new(ledger->db);
    sqlite3_str_appendf(text,
                        "UPDATE totals SET pending = 0, runs = %lld, engaged = %lld, "
                        "missed = %lld, failed = %lld, content = %lld",
                        (long long)t->counts.runs, (long long)t->counts.engaged,
                        (long long)t->counts.missed, (long long)t->counts.failed,
                        (long long)t->hash);
    return bt_ledger_execute_text(ledger, text, diag);
}

bt_status bt_ledger_make_totals(bt_ledger* ledger, bt_diag* diag) {
    int64_t there = 0;
    BT_TRY(bt_ledger_integer(ledger, "SELECT count(*) FROM sqlite_master WHERE name = 'totals'",
                             &there, diag));
    if (there)
        return BT_OK;
    return bt_ledger_execute(
        ledger,
        "CREATE TABLE totals(id INTEGER PRIMARY KEY CHECK (id = 1), pending INTEGER NOT NULL,"
        " runs INTEGER, engaged INTEGER, missed INTEGER, failed INTEGER, content INTEGER);"
        "INSERT INTO totals VALUES (1, 0, NULL, NULL, NULL, NULL, NULL);"
        "CREATE TRIGGER runs_inserted AFTER INSERT ON runs"
        " BEGIN UPDATE totals SET pending = pending + 1; END;"
        "CREATE TRIGGER runs_updated AFTER UPDATE ON runs WHEN (SELECT runs FROM totals) NOT NULL"
        " BEGIN UPDATE totals SET runs = NULL; END;"
        "CREATE TRIGGER runs_deleted AFTER DELETE ON runs WHEN (SELECT runs FROM totals) NOT NULL"
        " BEGIN UPDATE totals SET runs = NULL; END;",
        "cannot write", diag);
}

// --- asking -----------------------------------------------------------------------------------

/// Those of the transaction under way are at hand.
static bt_status find_totals(bt_ledger* ledger, bt_diag* diag) {
    return ledger->in_transaction ? BT_OK : bt_ledger_load_totals(ledger, diag);
}

bt_status bt_ledger_count(bt_ledger* ledger, bt_ledger_counts* counts, bt_diag* diag) {
    BT_TRY(find_totals(ledger, diag));
    *counts = ledger->totals.counts;
    return BT_OK;
}

bt_status bt_ledger_hash(bt_ledger* ledger, uint64_t* hash, bt_diag* diag) {
    BT_TRY(find_totals(ledger, diag));
    *hash = ledger->totals.hash;
    return BT_OK;
}
