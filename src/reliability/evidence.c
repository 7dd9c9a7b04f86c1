#include "reliability/evidence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bt_status bt_evidence_create(int dims, int room, bt_evidence* evidence) {
    const size_t n = (size_t)room + 1;
    *evidence = (bt_evidence){.dims = dims, .room = (int)n};
    evidence->x = calloc(n * (size_t)(dims + 1), sizeof *evidence->x);
    evidence->label = calloc(n, sizeof *evidence->label);
    evidence->log_density = calloc(n, sizeof *evidence->log_density);
    if (evidence->x && evidence->label && evidence->log_density)
        return BT_OK;
    bt_evidence_destroy(evidence);
    return BT_ERR_MEMORY;
}

typedef struct reading {
    bt_evidence* evidence;
    const bt_design* design;
    int64_t before;
    const bt_event* events;
    int event_count;
} reading;

static bool take(void* user, const bt_ledger_row* row) {
    const reading* r = user;
    bt_evidence* e = r->evidence;
    if (row->run >= r->before)
        return false;
    memcpy(e->x + (size_t)e->count * (size_t)e->dims, row->x, (size_t)e->dims * sizeof *e->x);
    e->label[e->count] =
        (int8_t)(row->result.outcome == BT_FAILED ? -1 : row->result.outcome == BT_ENGAGED);
    for (int k = 0; k < r->event_count; ++k)
        e->event[(size_t)k * (size_t)e->room + (size_t)e->count] =
            (int8_t)bt_event_holds(&r->events[k], &row->result);
    e->log_density[e->count++] =
        isnan(row->log_density) ? bt_design_log_density(r->design, row->x) : row->log_density;
    return true;
}

bt_status bt_evidence_read(bt_ledger* ledger, const bt_study* study, int64_t before,
                           const bt_event* events, int count, bt_evidence* evidence,
                           bt_diag* diag) {
    bt_ledger_counts counts;
    bt_design* design;
    *evidence = (bt_evidence){0};
    BT_TRY(bt_ledger_count(ledger, &counts, diag));
    BT_TRY(bt_design_create(study, &design, diag));
    bt_status status =
        bt_evidence_create(bt_design_get_axes(design)->count, (int)counts.runs, evidence);
    if (status == BT_OK && count > 0) {
        evidence->event = calloc((size_t)count * (size_t)evidence->room, 1);
        status = evidence->event ? BT_OK : BT_ERR_MEMORY;
    }
    if (status == BT_OK) {
        reading r = {evidence, design, before, events, count};
        status = bt_ledger_walk(ledger, take, &r, diag);
    }
    if (status != BT_OK)
        bt_evidence_destroy(evidence);
    bt_design_destroy(design);
    return status;
}

bt_evidence bt_evidence_of_event(const bt_evidence* evidence, int event) {
    bt_evidence e = *evidence;
    e.label = evidence->event + (size_t)event * (size_t)evidence->room;
    e.event = NULL;
    return e;
}

void bt_evidence_destroy(bt_evidence* evidence) {
    free(evidence->x);
    free(evidence->label);
    free(evidence->event);
    free(evidence->log_density);
    *evidence = (bt_evidence){0};
}
