#include "pipeline/landings.h"

#include "reliability/judged.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool resize(void** data, size_t size) {
    void* moved = realloc(*data, size);
    if (moved)
        *data = moved;
    return moved != NULL;
}

static bool grow(bt_landings* l) {
    if (l->count < l->room)
        return true;
    const size_t room = l->room ? 2 * (size_t)l->room : 4096;
    const size_t dims = (size_t)(l->axes.count > 0 ? l->axes.count : 1);
    if (!resize((void**)&l->run, room * sizeof *l->run) ||
        !resize((void**)&l->x, room * dims * sizeof *l->x) ||
        !resize((void**)&l->margin_m, room * sizeof *l->margin_m) ||
        !resize((void**)&l->weight, room * sizeof *l->weight) || !resize((void**)&l->mode, room) ||
        !resize((void**)&l->outcome, room) || !resize((void**)&l->bounced, room))
        return false;
    l->room = (int)room;
    return true;
}

typedef struct reading {
    bt_landings* landings;
    const bt_design* design;   ///< NULL: landings are not weighed
    const bt_mixture* mixture; ///< its component 0 is the study as it stands
    bool out_of_memory;
} reading;

static double weight_of(const reading* r, const bt_ledger_row* row) {
    double log_p[BT_COMPONENT_MAX];
    if (!r->design)
        return 1;
    bt_mixture_log_density(r->mixture, row->x, log_p);
    const double log_q =
        isnan(row->log_density) ? bt_design_log_density(r->design, row->x) : row->log_density;
    return exp(log_p[0] - log_q);
}

static bool take(void* user, const bt_ledger_row* row) {
    reading* r = user;
    bt_landings* l = r->landings;
    if (!grow(l)) {
        r->out_of_memory = true;
        return false;
    }
    const int i = l->count++;
    l->run[i] = row->run;
    memcpy(l->x + (size_t)i * (size_t)l->axes.count, row->x, (size_t)l->axes.count * sizeof *l->x);
    l->margin_m[i] = row->result.margin_m;
    l->weight[i] = weight_of(r, row);
    l->mode[i] = (uint8_t)row->result.mode;
    l->outcome[i] = (uint8_t)row->result.outcome;
    l->bounced[i] = row->result.bounce_count > 0 && row->result.bounces[0].complete;
    return true;
}

bt_status bt_landings_read(const bt_study* study, bt_ledger* ledger, bt_landings* landings,
                           bt_diag* diag) {
    *landings = (bt_landings){.axes = bt_design_axes(study), .weighted = bt_judged_possible(study)};
    bt_design* design = NULL;
    bt_mixture* mixture = NULL;
    bt_status status = BT_OK;
    if (landings->weighted)
        status = bt_design_create(study, &design, diag);
    if (status == BT_OK && landings->weighted)
        status = bt_mixture_create(study, &mixture, diag);
    reading r = {.landings = landings, .design = design, .mixture = mixture};
    if (status == BT_OK)
        status = bt_ledger_walk(ledger, take, &r, diag);
    if (r.out_of_memory)
        status = BT_ERR_MEMORY;
    bt_design_destroy(design);
    free(mixture);
    if (status != BT_OK)
        bt_landings_destroy(landings);
    return status;
}

void bt_landings_destroy(bt_landings* l) {
    free(l->run);
    free(l->x);
    free(l->margin_m);
    free(l->weight);
    free(l->mode);
    free(l->outcome);
    free(l->bounced);
    *l = (bt_landings){0};
}
