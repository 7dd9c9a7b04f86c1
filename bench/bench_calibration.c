/// A calibration of six parameters against ten targets, on all cores.
#include "bench.h"

#include "calibration/calibration.h"

#include <stdio.h>

void bench_calibration(void) {
    static bt_study study;
    static bt_calibration calibration;
    static bt_fit fit;
    if (bt_study_read("studies/reference/study.yaml", NULL, 0, &study, NULL) != BT_OK) {
        puts("calibration: the reference study cannot be read from here");
        return;
    }
    if (bt_calibration_read("bench/calibration.yaml", &study, &calibration, NULL) == BT_OK) {
        const double begin = bench_now_s();
        if (bt_calibration_fit(&calibration, &fit, NULL, NULL, NULL, NULL) == BT_OK) {
            int met = 0;
            for (int i = 0; i < calibration.target_count; ++i)
                met += fit.targets[i].met;
            bench_row("calibration, 6 parameters and 10 targets, all cores", bench_now_s() - begin,
                      "s", NULL, 0, 60);
            printf("    %d of %d targets met, %d runs of the model\n", met,
                   calibration.target_count, fit.landings);
        }
        bt_calibration_destroy(&calibration);
    }
    bt_study_destroy(&study);
}
