#include "reliability/widths.h"

#include "reliability/rounds.h"
#include "reliability/stop.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>

bt_status bt_widths_create(const bt_study* study, const bt_mixture* mixture,
                           const bt_design* design, double least, bt_widths* w) {
    *w = (bt_widths){
        .mixture = mixture, .tail = bt_stop_tail(study), .samples = study->reliability.samples};
    w->law = malloc((size_t)mixture->components * sizeof *w->law);
    if (!w->law)
        return BT_ERR_MEMORY;
    for (int c = 0; c < mixture->components; ++c)
        bt_pooled_law(mixture, design, c, least, (uint64_t)study->reliability.seed, &w->law[c]);
    return BT_OK;
}

void bt_widths_destroy(bt_widths* widths) {
    free(widths->law);
    *widths = (bt_widths){0};
}

static int compare_doubles(const void* a, const void* b) {
    const double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

/// The pooled estimate of a condition from the landings first .. n - 1, the classifiers' mean taken
/// from the landings themselves.
static bt_pooled estimate(const bt_widths* w, const bt_evidence* e, const int8_t* said,
                          const double* weight, int component, int first, int n) {
    const bt_evidence part = {.count = n - first,
                              .dims = e->dims,
                              .x = e->x + (size_t)first * (size_t)e->dims,
                              .label = e->label + first,
                              .log_density = e->log_density + first};
    const double* own = weight + (size_t)component * (size_t)e->count + first;
    const bt_cut cut = bt_pooled_cut(&w->law[component], part.count, w->tail);
    double engaged = 0, all = 0;
    for (int i = 0; i < part.count; ++i) {
        engaged += said[first + i] > 0 ? own[i] : 0;
        all += own[i];
    }
    const double mean = all > 0 ? engaged / all : 0;
    return bt_pooled_estimate(&part, said + first, own, &cut,
                              (int64_t)llround(mean * (double)w->samples), w->samples);
}

bt_width bt_width_over(double overall, double* half, int n, int64_t landings, double cov) {
    qsort(half, (size_t)n, sizeof *half, compare_doubles);
    return (bt_width){.landings = landings,
                      .overall = overall,
                      .median = n > 0 ? 0.5 * (half[(n - 1) / 2] + half[n / 2]) : overall,
                      .largest = n > 0 ? half[n - 1] : overall,
                      .cov = cov};
}

bt_width bt_width_after(const bt_widths* w, const bt_evidence* e, const int8_t* said,
                        const double* weight, int n) {
    const int first = bt_round_first(n), conditions = w->mixture->components - 1;
    if (n <= first)
        return (bt_width){n, NAN, NAN, NAN, NAN};
    const double z = gsl_cdf_ugaussian_Qinv(w->tail);
    double half[BT_COMPONENT_MAX], cov = 0;
    for (int c = 0; c <= conditions; ++c) {
        const bt_pooled p = estimate(w, e, said, weight, c, first, n);
        half[c] = bt_interval_half(&p.ci95);
        cov = fmax(cov, p.value < 1 ? p.sampling / z / (1 - p.value) : INFINITY);
    }
    return bt_width_over(half[0], half + 1, conditions, n, cov);
}
