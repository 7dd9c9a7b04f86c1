/// The ledger of a campaign: one SQLite file, one row per run, open to anyone's SQL.
///
/// Tables: meta (key, value), inputs (idx, path, unit), runs (run, one column per input named by
/// its path, log_density, status, then the columns of landing/result.h), contacts (run, then
/// bt_contact_columns: one row per landing and wire that its hook met), totals (what the runs add
/// up to). Views of runs: landings (all but the failed), misses, failed. SI throughout. A run
/// that diverged has status 'failed' and no outcome: it can never be taken for a label. Columns
/// that a user adds are left alone.
#ifndef BT_CAMPAIGN_LEDGER_H
#define BT_CAMPAIGN_LEDGER_H

#include "campaign/design.h"

#define BT_LEDGER_NAME "campaign.sqlite"

typedef struct bt_ledger bt_ledger;

typedef enum bt_ledger_access {
    BT_LEDGER_READ,   ///< must exist
    BT_LEDGER_WRITE,  ///< must exist
    BT_LEDGER_CREATE, ///< for writing; made when it does not exist
} bt_ledger_access;

/// Opens the ledger of a study at a path.
///
/// Refused with BT_ERR_IO, said in diag, nothing changed: a file that is not a bolter ledger,
/// a damaged one (large files are not read for that: damage shows where it is met), one of another
/// format, one that cannot be read or written; and a ledger of
/// another study (the first key that differs is named). What a writer that was killed left behind
/// is rolled back first, also for reading. Columns of results that this version has and the file
/// has not are added when it is opened for writing, and read as empty when it is not.
BT_CHECKED bt_status bt_ledger_open(const char* path, const bt_study* study, bt_ledger_access how,
                                    bt_ledger** ledger, bt_diag* diag);

/// Rolls back what was not committed; accepts NULL.
void bt_ledger_close(bt_ledger* ledger);

/// Adds a run inside the current transaction (opened when there is none). x [axes.count], SI.
/// log_density: natural logarithm of the density that the point was drawn with, per SI unit of
/// every axis; NAN (NULL in the file) where it is not known.
/// On BT_ERR_IO (disk full, said in diag) the transaction is rolled back: what was committed
/// before stays.
BT_CHECKED bt_status bt_ledger_add(bt_ledger* ledger, int64_t run, const double* x,
                                   double log_density, const bt_landing_result* result,
                                   bt_diag* diag);

/// Commits what was added since the last commit.
BT_CHECKED bt_status bt_ledger_commit(bt_ledger* ledger, bt_diag* diag);

typedef struct bt_ledger_counts {
    int64_t runs, engaged, missed, failed;
} bt_ledger_counts;

/// Read from one row: the time does not grow with the ledger, unless somebody changed its runs by
/// SQL; then they are counted once.
BT_CHECKED bt_status bt_ledger_count(bt_ledger* ledger, bt_ledger_counts* counts, bt_diag* diag);

/// One run as it stands in the ledger. Of the bounces only the first is kept
/// (result.bounces[0] when result.bounce_count > 0).
typedef struct bt_ledger_row {
    int64_t run;
    double x[BT_INPUT_MAX]; ///< in the order of the design's axes
    double log_density;     ///< that it was drawn with; NAN where it is not known
    bt_landing_result result;
} bt_ledger_row;

/// Calls visit for every run in order of run number; stops when it returns false.
typedef bool bt_ledger_visit(void* user, const bt_ledger_row* row);
BT_CHECKED bt_status bt_ledger_walk(bt_ledger* ledger, bt_ledger_visit* visit, void* user,
                                    bt_diag* diag);

/// The same for the run's number and outcome alone (BT_FAILED: it has none); far faster.
typedef void bt_ledger_glance(void* user, int64_t run, bt_outcome outcome);
BT_CHECKED bt_status bt_ledger_scan(bt_ledger* ledger, bt_ledger_glance* visit, void* user,
                                    bt_diag* diag);

/// The greatest run; -1 when there is none.
BT_CHECKED bt_status bt_ledger_last_run(bt_ledger* ledger, int64_t* run, bt_diag* diag);

/// One run. BT_ERR_ARG when the ledger does not have it.
BT_CHECKED bt_status bt_ledger_get(bt_ledger* ledger, int64_t run, bt_ledger_row* row,
                                   bt_diag* diag);

/// Hash of everything the runs say but for the wall-clock times: equal for two ledgers with the
/// same bits, whatever the order or the interruptions they grew by. As fast as bt_ledger_count.
BT_CHECKED bt_status bt_ledger_hash(bt_ledger* ledger, uint64_t* hash, bt_diag* diag);

/// Adds the runs of another ledger of the same study (a shard); committed as a whole or not at
/// all. A run that both have must be the same to the bit (BT_ERR_INPUT otherwise).
/// So is a ledger that another version or instruction set computed: it would differ there.
BT_CHECKED bt_status bt_ledger_merge(bt_ledger* ledger, const char* path, int64_t* added,
                                     bt_diag* diag);

/// A remark that later work keeps with the ledger (which fit is up to date), by key; committed at
/// once. Returns a text to be freed, NULL when there is none.
char* bt_ledger_remark(const bt_ledger* ledger, const char* key);
BT_CHECKED bt_status bt_ledger_set_remark(bt_ledger* ledger, const char* key, const char* text,
                                          bt_diag* diag);

#endif
