#include "pipeline/find_run.h"

#include "base/units.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// --- reading ------------------------------------------------------------------------------------

/// One "landing.pitch=3 deg" of a point.
static bt_status read_coordinate(const bt_study* study, bt_run_search* s, const char* text,
                                 char* why, size_t size) {
    char reason[256] = "is no axis of the campaign";
    const size_t length = strcspn(text, "=");
    for (int i = 0; i < s->axes.count && text[length]; ++i) {
        const bt_input* input = &study->inputs[s->axes.input[i]];
        if (strlen(input->path) != length || strncmp(input->path, text, length) != 0)
            continue;
        s->named[i] = true;
        if (bt_unit_parse(text + length + 1, *input->field->unit ? input->field->unit : "1",
                          &s->point[i], reason, sizeof reason) == BT_OK)
            return BT_OK;
        break;
    }
    snprintf(why, size, "takes limit or 'PATH=VALUE, ...': %.*s: %s", (int)length, text, reason);
    return BT_ERR_ARG;
}

bt_status bt_run_search_read(const bt_study* study, const char* text, bt_run_search* search,
                             char* why, size_t size) {
    char copy[1024], *rest = NULL;
    search->at_limit = strcmp(text, "limit") == 0;
    if (search->at_limit)
        return BT_OK;
    snprintf(copy, sizeof copy, "%s", text);
    for (char* word = strtok_r(copy, ",", &rest); word; word = strtok_r(NULL, ",", &rest))
        BT_TRY(read_coordinate(study, search, word + strspn(word, " "), why, size));
    return BT_OK;
}

// --- finding ------------------------------------------------------------------------------------

typedef struct finding {
    const bt_study* study;
    const bt_run_search* search;
    bool near; ///< more than the first is looked at
    double distance;
    bool found;
    bt_ledger_row* row;
} finding;

/// A length along an axis: its range, or else its standard deviation.
static double scale_of(const bt_input* input) {
    const double scale = input->bounded ? input->upper - input->lower : input->distribution.sd;
    return scale > 0 ? scale : 1;
}

static double distance_to(const finding* f, const bt_ledger_row* row) {
    const bt_run_search* s = f->search;
    if (s->at_limit)
        return fabs(row->result.margin_m);
    double sum = 0;
    for (int i = 0; i < s->axes.count; ++i) {
        const double d = (row->x[i] - s->point[i]) / scale_of(&f->study->inputs[s->axes.input[i]]);
        sum += s->named[i] ? d * d : 0;
    }
    return sum;
}

static bool consider(void* user, const bt_ledger_row* row) {
    finding* f = user;
    if (f->search->missed && row->result.outcome != BT_MISSED)
        return true;
    const double distance = distance_to(f, row);
    if (isfinite(distance) && (!f->found || distance < f->distance)) {
        *f->row = *row;
        f->distance = distance;
        f->found = true;
    }
    return f->near || !f->found;
}

bt_status bt_run_find(const bt_study* study, bt_ledger* ledger, const bt_run_search* search,
                      bt_ledger_row* row, bool* found, bt_diag* diag) {
    finding f = {.study = study, .search = search, .near = search->at_limit, .row = row};
    for (int i = 0; i < search->axes.count; ++i)
        f.near = f.near || search->named[i];
    const bt_status status = bt_ledger_walk(ledger, consider, &f, diag);
    *found = f.found;
    return status;
}
