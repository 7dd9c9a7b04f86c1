#include "bolter/rig.h"

#include "api/case.h"
#include "base/units.h"

#include <string.h>

static void show_line(void* user, const bt_rig_sample* sample) {
    const bt_rig_def* def = user;
    const bt_rig_line line = {
        .time_s = sample->time_s,
        .count = sample->count,
        .names = sample->names,
        .values = sample->values,
    };
    def->watch(def->user, &line);
}

static bool find_rig(const bt_case* c, const char* name, bt_rig_kind* kind) {
    bt_diag diag = bt_case_diag(c);
    for (int k = 0; name && k < BT_RIG_COUNT; ++k)
        if (strcmp(name, bt_rig_keys[k]) == 0) {
            *kind = (bt_rig_kind)k;
            if (c->study.rig_inputs[k].given)
                return true;
            bt_diag_add(&diag, BT_ERROR, (bt_where){.file = c->name},
                        "rigs.%s: missing; the study does not describe this test", name);
            return false;
        }
    bt_diag_add(&diag, BT_ERROR, BT_NOWHERE,
                "\"%s\" is none of nose_drop, main_drop, hook_rebound, nose_static, main_static",
                name ? name : "");
    return false;
}

bt_status bt_case_rig(bt_case* opened, const bt_rig_def* def, bt_rig_metric* metrics, int room,
                      int* count) {
    bt_rig_def wanted;
    bt_rig_kind kind;
    bt_rig_result result;
    *count = 0;
    if (!BT_DEF_COPY(wanted, def) || !find_rig(opened, wanted.rig, &kind))
        return BT_ERR_ARG;
    bt_diag diag = bt_case_diag(opened);
    BT_TRY(bt_rig_run(kind, &opened->study.model.aircraft, &opened->study.rigs, &result,
                      wanted.watch ? show_line : NULL, &wanted, &diag));
    *count = result.metric_count;
    for (int i = 0; i < room && i < result.metric_count; ++i) {
        const bt_metric* m = &result.metrics[i];
        metrics[i] = (bt_rig_metric){
            .name = m->name,
            .unit = bt_unit_text(*m->unit ? m->unit : "1"),
            .value = m->value,
            .reference = m->reference,
            .error_percent = m->error_percent,
            .accepted = m->accepted,
        };
    }
    return BT_OK;
}
