// What stopping at a width does to an interval, computed without sampling: a Poisson process is
// looked at at the ends of rounds (1, 3/2, 2, 3, 4, 6, ... units of time), and the first interval
// that is narrow enough is reported. The probability that it holds the rate follows from the law of
// the counts at every look.
#include "near.h"

#include "reliability/stop.h"
#include "statistics/weighted.h"

#include <gsl/gsl_randist.h>
#include <stdlib.h>
#include <string.h>

enum { COUNTS = 700, LOOKS = 18 };

typedef struct limits {
    double lower[COUNTS], upper[COUNTS];
} limits;

static void compute_limits(double tail, limits* l) {
    for (int k = 0; k < COUNTS; ++k) {
        const bt_weighted_count count = {k, k, 1};
        l->lower[k] = bt_weighted_lower(&count, tail);
        l->upper[k] = bt_weighted_upper(&count, tail);
    }
}

/// Whether the process stops after a count of k by the time t.
typedef bool stop_rule(const limits* l, int k, double t, double wanted);

static bool at_half_width(const limits* l, int k, double t, double wanted) {
    return 0.5 * (l->upper[k] - l->lower[k]) / t <= wanted;
}

/// Standard error over rate: 1 / sqrt(k).
static bool at_variation(const limits* l, int k, double t, double wanted) {
    (void)l;
    (void)t;
    return k > 0 && 1 / sqrt(k) <= wanted;
}

/// Probability that the reported interval holds the rate; the last look is reported in any case.
static double coverage(const limits* l, stop_rule* rule, double wanted, double rate) {
    double going[COUNTS] = {1}, next[COUNTS], step[COUNTS], missed = 0, before = 0;
    for (int look = 0; look < LOOKS; ++look) {
        const double t = ldexp(look % 2 ? 1.5 : 1, look / 2), mean = rate * (t - before);
        before = t;
        memset(next, 0, sizeof next);
        for (int d = 0; d < COUNTS; ++d)
            step[d] = gsl_ran_poisson_pdf((unsigned)d, mean);
        const int most = (int)fmin(COUNTS - 1, mean + 9 * sqrt(mean) + 12);
        for (int k = 0; k < COUNTS; ++k)
            for (int d = 0; going[k] > 1e-13 && d <= most && k + d < COUNTS; ++d)
                next[k + d] += going[k] * step[d];
        for (int k = 0; k < COUNTS; ++k) {
            if (!rule(l, k, t, wanted) && look + 1 < LOOKS && rate * t < 0.6 * COUNTS) {
                going[k] = next[k];
                continue;
            }
            going[k] = 0;
            if (rate * t < l->lower[k] || rate * t > l->upper[k])
                missed += next[k];
        }
    }
    return 1 - missed;
}

static double worst_coverage(double tail, stop_rule* rule, double least, double most) {
    limits* l = malloc(sizeof *l);
    compute_limits(tail, l);
    double worst = 1;
    for (double wanted = least; wanted <= most; wanted *= 1.3)
        for (double rate = 0.05; rate < 8; rate *= 1.07)
            worst = fmin(worst, coverage(l, rule, wanted, rate));
    free(l);
    return worst;
}

static double tail_of(double half_width) {
    bt_study* study = calloc(1, sizeof *study);
    study->reliability.half_width = half_width;
    const double tail = bt_stop_tail(study);
    free(study);
    return tail;
}

static void limits_stopped_at_a_width_hold_at_the_tail_taken(void** state) {
    (void)state;
    const double plain = worst_coverage(tail_of(0), at_half_width, 0.05, 2),
                 taken = worst_coverage(tail_of(0.01), at_half_width, 0.05, 2);
    print_message("stopped at a width: %.4f, at the tail taken %.4f\n", plain, taken);
    assert_true(plain < 0.945); // or nothing would be needed
    assert_true(taken >= 0.95);
}

static void limits_stopped_at_a_variation_hold_at_the_tail_taken(void** state) {
    (void)state;
    const double taken = worst_coverage(tail_of(0.01), at_variation, 0.1, 0.5);
    print_message("stopped at a variation: %.4f at the tail taken\n", taken);
    assert_true(taken >= 0.95);
}

static void a_study_that_asks_for_no_width_keeps_its_tail(void** state) {
    (void)state;
    assert_true(tail_of(0) == 0.025);
    assert_true(tail_of(0.005) < 0.025);
}

static void all_that_is_asked_for_must_be_reached(void** state) {
    (void)state;
    bt_study* study = calloc(1, sizeof *study);
    study->reliability.half_width = 0.01;
    const bt_width narrow = {1024, 0.004, 0.006, 0.009, 0.2},
                   wide = {1024, 0.004, 0.006, 0.011, 0.2}, none = {128, NAN, NAN, NAN, NAN};
    assert_true(bt_stop_reached(study, &narrow));
    assert_false(bt_stop_reached(study, &wide));
    assert_false(bt_stop_reached(study, &none));
    study->reliability.cov = 0.1;
    assert_false(bt_stop_reached(study, &narrow));
    study->reliability.cov = 0.2;
    assert_true(bt_stop_reached(study, &narrow));
    free(study);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(limits_stopped_at_a_width_hold_at_the_tail_taken),
        cmocka_unit_test(limits_stopped_at_a_variation_hold_at_the_tail_taken),
        cmocka_unit_test(a_study_that_asks_for_no_width_keeps_its_tail),
        cmocka_unit_test(all_that_is_asked_for_must_be_reached),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
