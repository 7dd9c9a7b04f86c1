#include "campaign/ledger_parts.h"

#include <stdlib.h>
#include <string.h>

typedef struct merging {
    bt_ledger* into;
    bt_diag* diag;
    bt_status status;
    int64_t added;
} merging;

static bt_status compare_rows(const merging* m, const bt_ledger_row* mine,
                              const bt_ledger_row* theirs) {
    if (bt_ledger_hash_run(m->into, mine->run, mine->x, mine->log_density, &mine->result) ==
        bt_ledger_hash_run(m->into, theirs->run, theirs->x, theirs->log_density, &theirs->result))
        return BT_OK;
    bt_diag_add(m->diag, BT_ERROR, bt_ledger_place(m->into),
                "run %lld differs between the two ledgers (another machine or version?); nothing "
                "was merged",
                (long long)mine->run);
    return BT_ERR_INPUT;
}

/// A run that both have is the exception: only then it is looked up.
static bool merge_row(void* user, const bt_ledger_row* row) {
    merging* m = user;
    bt_ledger_row mine;
    m->status =
        bt_ledger_add_new(m->into, row->run, row->x, row->log_density, &row->result, m->diag);
    m->added += m->status == BT_OK;
    if (m->status == BT_ERR_ARG) {
        m->status = bt_ledger_get(m->into, row->run, &mine, m->diag);
        if (m->status == BT_OK)
            m->status = compare_rows(m, &mine, row);
    }
    return m->status == BT_OK;
}

/// Shards that other versions or processors computed do not belong together. An empty ledger, made
/// for them on whatever machine, becomes one of theirs. Ledgers of early 0.2.0 do not say.
static bt_status agree_on_maker(bt_ledger* into, const bt_ledger* from, bt_diag* diag) {
    bt_ledger_counts counts;
    BT_TRY(bt_ledger_count(into, &counts, diag));
    char* mine = bt_ledger_remark(into, "made_by");
    char* theirs = bt_ledger_remark(from, "made_by");
    bt_status status = BT_OK;
    if (mine && theirs && strcmp(mine, theirs) != 0) {
        if (counts.runs == 0)
            status = bt_ledger_set_remark(into, "made_by", theirs, diag);
        else {
            bt_diag_add(diag, BT_ERROR, bt_ledger_place(from),
                        "was computed by %s, the ledger it is to be merged into by %s: the last "
                        "bits of their landings differ. Nothing was merged",
                        theirs, mine);
            status = BT_ERR_INPUT;
        }
    }
    free(mine);
    free(theirs);
    return status;
}

bt_status bt_ledger_merge(bt_ledger* ledger, const char* path, int64_t* added, bt_diag* diag) {
    BT_TRY(bt_ledger_commit(ledger, diag));
    bt_ledger* other = NULL;
    BT_TRY(bt_ledger_open(path, ledger->study, BT_LEDGER_READ, &other, diag));
    merging m = {.into = ledger, .diag = diag};
    bt_status status = agree_on_maker(ledger, other, diag);
    if (status == BT_OK)
        status = bt_ledger_walk(other, merge_row, &m, diag);
    bt_ledger_close(other);
    if (status == BT_OK)
        status = m.status;
    if (status == BT_OK)
        status = bt_ledger_commit(ledger, diag);
    else if (ledger->in_transaction)
        bt_ledger_roll_back(ledger);
    if (status == BT_OK)
        *added = m.added;
    return status;
}
