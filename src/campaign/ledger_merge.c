#include "campaign/ledger_parts.h"

#include "base/hash.h"

#include <math.h>
#include <string.h>

typedef struct hashing {
    int axis_count;
    uint64_t hash;
} hashing;

static void hash_bytes(hashing* h, const void* data, size_t size) {
    h->hash = bt_hash_bytes(h->hash, data, size);
}

static void hash_remarks(hashing* h, const bt_remarks* remarks) {
    char text[BT_REMARKS_TEXT_SIZE];
    bt_remarks_print(remarks, text, sizeof text);
    hash_bytes(h, text, strlen(text));
}

static void hash_column(hashing* h, const bt_result_column* c, const bt_landing_result* result) {
    const char* member = (const char*)result + c->offset;
    switch (c->kind) {
    case BT_RESULT_OUTCOME:
    case BT_RESULT_MODE:
    case BT_RESULT_INT:
        hash_bytes(h, member, sizeof(int));
        break;
    case BT_RESULT_FLAG:
        hash_bytes(h, member, sizeof(bool));
        break;
    case BT_RESULT_COUNT:
    case BT_RESULT_HASH:
    case BT_RESULT_REAL:
        hash_bytes(h, member, sizeof(double));
        break;
    case BT_RESULT_TEXT:
        hash_bytes(h, member, strlen(member));
        break;
    case BT_RESULT_REMARKS:
        hash_remarks(h, (const bt_remarks*)member);
        break;
    }
}

/// Everything but the wall-clock time. A density that is not known adds nothing.
static bool hash_row(void* user, const bt_ledger_row* row) {
    hashing* h = user;
    hash_bytes(h, &row->run, sizeof row->run);
    hash_bytes(h, row->x, sizeof row->x[0] * (size_t)h->axis_count);
    if (!isnan(row->log_density))
        hash_bytes(h, &row->log_density, sizeof row->log_density);
    for (int i = 0; i < bt_result_column_count; ++i) {
        const bt_result_column* c = &bt_result_columns[i];
        if (bt_ledger_keeps(c) && c->offset != offsetof(bt_landing_result, wall_s))
            hash_column(h, c, &row->result);
    }
    return true;
}

bt_status bt_ledger_hash(bt_ledger* ledger, uint64_t* hash, bt_diag* diag) {
    hashing h = {.axis_count = ledger->axes.count, .hash = BT_HASH_START};
    BT_TRY(bt_ledger_walk(ledger, hash_row, &h, diag));
    *hash = h.hash;
    return BT_OK;
}

// --- merging --------------------------------------------------------------------------------

typedef struct merging {
    bt_ledger* into;
    bt_diag* diag;
    bt_status status;
    int64_t added;
} merging;

static bt_status compare_rows(const merging* m, const bt_ledger_row* mine,
                              const bt_ledger_row* theirs) {
    hashing a = {.axis_count = m->into->axes.count}, b = a;
    hash_row(&a, mine);
    hash_row(&b, theirs);
    if (a.hash == b.hash)
        return BT_OK;
    bt_diag_add(m->diag, BT_ERROR, bt_ledger_place(m->into),
                "run %lld differs between the two ledgers (another machine or version?); nothing "
                "was merged",
                (long long)mine->run);
    return BT_ERR_INPUT;
}

static bool merge_row(void* user, const bt_ledger_row* row) {
    merging* m = user;
    bt_ledger_row mine;
    m->status = bt_ledger_get(m->into, row->run, &mine, m->diag);
    if (m->status == BT_OK) {
        m->status = compare_rows(m, &mine, row);
    } else if (m->status == BT_ERR_ARG) {
        m->status =
            bt_ledger_add(m->into, row->run, row->x, row->log_density, &row->result, m->diag);
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
    else if (ledger->in_transaction)
        bt_ledger_roll_back(ledger);
    if (status == BT_OK)
        *added = m.added;
    return status;
}
