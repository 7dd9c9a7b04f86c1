/// Whole landings of the reference study, over its input distributions, on one core.
#include "bench.h"

#include "base/rng.h"
#include "study/study.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { LANDINGS = 200 };

/// Seconds of this core's work, whatever else the machine is doing.
static double core_s(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/// The i-th landing drawn from the study's distributions, limits of the keys kept.
static bt_model_params draw(const bt_study* study, uint64_t i) {
    bt_model_params model = study->model;
    for (int k = 0; k < study->input_count; ++k) {
        const bt_input* input = &study->inputs[k];
        if (!input->random)
            continue;
        const double u = bt_rng_uniform(12345, i, (uint32_t)k);
        double x = bt_distribution_quantile(&input->distribution, u);
        x = x < input->field->least ? input->field->least : x;
        x = x > input->field->greatest ? input->field->greatest : x;
        bt_field_set(input->field, &model, input->offset, x);
    }
    return model;
}

void bench_landing(void) {
    static bt_study study;
    bt_lander* lander = NULL;
    if (bt_study_read("studies/reference/study.yaml", NULL, 0, &study, NULL) != BT_OK ||
        bt_lander_create(&lander) != BT_OK) {
        puts("landing: the reference study cannot be read from here");
        return;
    }

    double seconds = 0, worst = 0, airframe_steps = 0, cable_steps = 0;
    for (uint64_t i = 0; i < LANDINGS; ++i) {
        const bt_model_params model = draw(&study, i);
        bt_landing_result result;
        const double begin = core_s();
        if (bt_lander_run(lander, &model, &result, NULL, NULL, NULL) != BT_OK)
            continue;
        const double took = core_s() - begin;
        seconds += took;
        worst = took > worst ? took : worst;
        airframe_steps += (double)result.steps;
        cable_steps += (double)result.cable_steps;
    }
    bench_row("landing, mean over the distributions", 1e3 * seconds / LANDINGS, "ms", NULL, 0, 28);
    bench_row("landing, longest of 200", 1e3 * worst, "ms", NULL, 0, 0);
    bench_row("  airframe steps per landing", airframe_steps / LANDINGS, "", NULL, 0, 0);
    bench_row("  cable steps per landing", cable_steps / LANDINGS, "", NULL, 0, 0);
    bench_row("  42,000 landings on 2 cores", 42000 * seconds / LANDINGS / 2 / 60, "min", NULL, 0,
              10);
    bench_row("memory of a landing in flight", (double)bt_lander_memory(lander) / 1048576, "MiB",
              NULL, 0, 1);
    bt_lander_destroy(lander);
    bt_study_destroy(&study);
}
