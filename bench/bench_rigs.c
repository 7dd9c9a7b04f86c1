/// One run of each rig on the reference aircraft.
#include "bench.h"

#include "study/study.h"

#include <math.h>
#include <stdio.h>

enum { REPEATS = 30 };
static const double target_ms = 5;

static double time_rig(bt_rig_kind kind, const bt_study* study) {
    double best = INFINITY;
    for (int i = 0; i < REPEATS; ++i) {
        bt_rig_result result;
        const double start = bench_now_s();
        if (bt_rig_run(kind, &study->model.aircraft, &study->rigs, &result, NULL, NULL, NULL) !=
            BT_OK)
            return NAN;
        best = fmin(best, bench_now_s() - start);
        bench_keep(&result);
    }
    return best;
}

void bench_rigs(void) {
    bt_study study;
    if (bt_study_read("studies/reference/study.yaml", NULL, 0, &study, NULL) != BT_OK) {
        printf("studies/reference/study.yaml cannot be read: run from the project's directory\n");
        return;
    }
    for (int kind = 0; kind < BT_RIG_COUNT; ++kind) {
        char name[64];
        snprintf(name, sizeof name, "rig %s, one run", bt_rig_keys[kind]);
        bench_row(name, 1e3 * time_rig((bt_rig_kind)kind, &study), "ms", NULL, 0, target_ms);
    }
    bt_study_destroy(&study);
}
