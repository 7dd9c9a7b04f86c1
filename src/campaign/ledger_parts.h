/// What the sources of the ledger share: the handle, and SQL with errors that people understand.
#ifndef BT_CAMPAIGN_LEDGER_PARTS_H
#define BT_CAMPAIGN_LEDGER_PARTS_H

#include "campaign/ledger.h"

#include "base/directory.h"

#include <sqlite3.h>

/// What the runs add up to: of the file, with those of the transaction under way.
typedef struct bt_ledger_totals {
    bt_ledger_counts counts;
    uint64_t hash; ///< sum of bt_ledger_hash_run, modulo 2^64
} bt_ledger_totals;

struct bt_ledger {
    sqlite3* db;
    sqlite3_stmt* insert;
    sqlite3_stmt* insert_contact;
    bool has_contacts; ///< the table; a file that was written before there was one has none
    char* select;      ///< "SELECT ... FROM runs", every column by name; owned
    char path[BT_FILE_PATH_MAX];
    const bt_study* study;
    bt_axes axes;
    bool in_transaction;
    bt_ledger_totals totals; ///< while in_transaction
};

static inline bt_where bt_ledger_place(const bt_ledger* ledger) {
    return (bt_where){.file = ledger->path};
}

/// The path of an axis: the name of its column.
const char* bt_ledger_axis(const bt_ledger* ledger, int axis);

/// The columns of the result that the ledger keeps: all but those of the second bounce.
static inline bool bt_ledger_keeps(const bt_result_column* column) {
    return column->bounce < 2;
}

/// Reports what SQLite says of the last call, in the words of the person who has to act on it.
/// Returns BT_ERR_IO.
bt_status bt_ledger_sql_error(const bt_ledger* ledger, const char* what, bt_diag* diag);

/// Runs SQL that gives no rows; `what` begins the message ("cannot write").
BT_CHECKED bt_status bt_ledger_execute(bt_ledger* ledger, const char* sql, const char* what,
                                       bt_diag* diag);

/// The same for a text put together in memory, which is consumed.
BT_CHECKED bt_status bt_ledger_execute_text(bt_ledger* ledger, sqlite3_str* text, bt_diag* diag);

/// The first column of the first row, as a number.
BT_CHECKED bt_status bt_ledger_integer(bt_ledger* ledger, const char* sql, int64_t* answer,
                                       bt_diag* diag);

/// Drops what was not committed.
void bt_ledger_roll_back(bt_ledger* ledger);

/// Makes the tables and views of a new ledger, inside the caller's transaction.
BT_CHECKED bt_status bt_ledger_make_tables(bt_ledger* ledger, bt_diag* diag);

/// Finds which columns the table of runs has; those that this version added since are added to the
/// file when it is open for writing, and read as empty when it is not. Prepares ledger->select.
BT_CHECKED bt_status bt_ledger_bind_columns(bt_ledger* ledger, bool writing, bt_diag* diag);

/// What computes landings here: version and instruction set, on which their last bits depend. A
/// ledger keeps it as the remark "made_by".
enum { BT_MAKER_SIZE = 96 };
void bt_ledger_maker(char* text, size_t size);

/// Hash of everything a run says but its wall-clock time, as the file keeps it.
uint64_t bt_ledger_hash_run(const bt_ledger* ledger, int64_t run, const double* x,
                            double log_density, const bt_landing_result* result);

/// Adds a run to the totals in memory.
void bt_ledger_count_run(bt_ledger* ledger, int64_t run, const double* x, double log_density,
                         const bt_landing_result* result);

/// The totals of the file into ledger->totals; adds them up where the file does not know.
BT_CHECKED bt_status bt_ledger_load_totals(bt_ledger* ledger, bt_diag* diag);

/// And back, inside a transaction.
BT_CHECKED bt_status bt_ledger_store_totals(bt_ledger* ledger, bt_diag* diag);

/// Makes the table of totals and its triggers where there is none (files of early 0.2.0).
BT_CHECKED bt_status bt_ledger_make_totals(bt_ledger* ledger, bt_diag* diag);

/// Adds a run like bt_ledger_add. BT_ERR_ARG, nothing said or lost: the ledger has it already.
BT_CHECKED bt_status bt_ledger_add_new(bt_ledger* ledger, int64_t run, const double* x,
                                       double log_density, const bt_landing_result* result,
                                       bt_diag* diag);

#endif
