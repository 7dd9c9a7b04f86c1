// Coverage of the pooled intervals: whole campaigns of adaptive rounds in synthetic worlds whose
// probabilities are known, again and again with other seeds. An interval of 95 % must not miss
// more often than a binomial of 5 % would with probability 1e-3.
#include "near.h"

#include "base/rng.h"
#include "reliability/pooled.h"
#include "reliability/rounds.h"
#include "reliability/stop.h"
#include "surrogate/predictor.h"

#include <gsl/gsl_cdf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CONDITIONS = 5, LANDINGS = 768, REPEATS = 20, SAMPLES = 20000, TRUTH = 200000 };

typedef int outcome(const double* x, int dims);

typedef struct world {
    const char* name;
    int dims;
    outcome* engaged;
    double reach;  ///< how far the conditions move the first input, in its deviations
    double unsure; ///< share of a round where the classifier is unsure
    int kind;      ///< distribution of the inputs
    int landings;
    double half_width; ///< stops after the first round where all conditions are so narrow; 0: never
} world;

/* ---- outcomes: functions of standard normal inputs, or of uniforms that were made so ---- */

static int half_space(const double* x, int dims) {
    double sum = 0;
    for (int k = 0; k < dims; ++k)
        sum += x[k] / sqrt(dims);
    return sum < 1.2;
}
static int rare(const double* x, int dims) {
    double sum = 0;
    for (int k = 0; k < dims; ++k)
        sum += x[k] / sqrt(dims);
    return sum < 2.8;
}
static int band(const double* x, int dims) {
    (void)dims;
    return fabs(x[1] - 0.6 * sin(2 * x[0])) > 0.25;
}
static int thin_band(const double* x, int dims) {
    (void)dims;
    return fabs(x[0] + 0.5 * x[1] - 1.6) > 0.03;
}
static int pocket(const double* x, int dims) {
    (void)dims;
    return hypot(x[0] - 1.9, x[1] + 1.3) > 0.25 && half_space(x, 2);
}
static int small_pockets(const double* x, int dims) {
    (void)dims;
    const double u = x[0] - floor(x[0]) - 0.5, v = x[1] - floor(x[1]) - 0.5;
    return hypot(u, v) > 0.12;
}
static int dust(const double* x, int dims) {
    double sum = 0;
    for (int k = 0; k < dims; ++k)
        sum += (k + 1) * x[k];
    return bt_rng_uniform(5, (uint64_t)llround(sum * 1e6), 9) > 0.02; // two in a hundred, anywhere
}
static int noisy_edge(const double* x, int dims) {
    double sum = 0;
    for (int k = 0; k < dims; ++k)
        sum += x[k] / sqrt(dims);
    const double u = bt_rng_uniform(6, (uint64_t)llround(fabs(sum) * 1e9), 9);
    return sum + 0.4 * (u - 0.5) < 1.1;
}
static int ball(const double* x, int dims) {
    double square = 0;
    for (int k = 0; k < dims; ++k)
        square += x[k] * x[k];
    return square < dims + 1.8 * sqrt(2.0 * dims);
}
static int always(const double* x, int dims) {
    (void)x;
    (void)dims;
    return 1;
}
static int nearly_never(const double* x, int dims) {
    return !rare(x, dims);
}
static int steps(const double* x, int dims) {
    (void)dims;
    return ((int)floor(2 * x[0]) & 3) != 3 || x[1] > 0.5;
}

static const world worlds[] = {
    {"half space, one input", 1, half_space, 2, 0.3, 0, LANDINGS, 0},
    {"half space, two inputs", 2, half_space, 2, 0.3, 0, LANDINGS, 0},
    {"half space, no rounds", 2, half_space, 2, 0, 0, LANDINGS, 0},
    {"half space, mostly unsure", 2, half_space, 2, 0.7, 0, LANDINGS, 0},
    {"half space, six inputs", 6, half_space, 2, 0.3, 0, LANDINGS, 0},
    {"half space, twelve inputs", 12, half_space, 1.5, 0.3, 0, 512, 0},
    {"rare misses, two inputs", 2, rare, 1, 0.3, 0, LANDINGS, 0},
    {"rare misses, four inputs", 4, rare, 1, 0.3, 0, LANDINGS, 0},
    {"curved band", 2, band, 2, 0.3, 0, LANDINGS, 0},
    {"thin oblique band", 2, thin_band, 2, 0.3, 0, LANDINGS, 0},
    {"thin oblique band, few", 2, thin_band, 2, 0.3, 0, 256, 0},
    {"a pocket in the tail", 2, pocket, 2, 0.3, 0, LANDINGS, 0},
    {"a pocket, few landings", 2, pocket, 2, 0.3, 0, 256, 0},
    {"many small pockets", 2, small_pockets, 2, 0.3, 0, LANDINGS, 0},
    {"many small pockets, half unsure", 2, small_pockets, 2, 0.5, 0, LANDINGS, 0},
    {"misses like dust", 2, dust, 2, 0.3, 0, LANDINGS, 0},
    {"misses like dust, half unsure", 3, dust, 2, 0.5, 0, LANDINGS, 0},
    {"noisy edge", 2, noisy_edge, 2, 0.3, 0, LANDINGS, 0},
    {"ball, four inputs", 4, ball, 1, 0.3, 0, LANDINGS, 0},
    {"always engaged", 2, always, 2, 0.3, 0, 256, 0},
    {"nearly never engaged", 2, nearly_never, 1, 0.3, 0, LANDINGS, 0},
    {"steps", 2, steps, 2, 0.3, 0, LANDINGS, 0},
    {"far conditions", 2, half_space, 4, 0.3, 0, LANDINGS, 0},
    {"lognormal inputs", 2, half_space, 1, 0.3, 1, LANDINGS, 0},
    {"uniform inputs", 2, band, 0.5, 0.3, 2, LANDINGS, 0},
    {"correlated inputs", 3, half_space, 2, 0.3, 3, LANDINGS, 0},
    {"half space, stopped at 0.04", 2, half_space, 2, 0.3, 0, LANDINGS, 0.04},
    {"pocket, stopped at 0.05", 2, pocket, 2, 0.3, 0, LANDINGS, 0.05},
    {"dust, stopped at 0.08", 2, dust, 2, 0.3, 0, LANDINGS, 0.08},
    {"thin band, stopped at 0.06", 2, thin_band, 2, 0.3, 0, LANDINGS, 0.06},
};

static bt_distribution input_of(int kind) {
    switch (kind) {
    case 1: // of the size of a standard normal about 2
        return (bt_distribution){.kind = BT_LOGNORMAL, .mean = 1, .sd = 0.8};
    case 2:
        return (bt_distribution){.kind = BT_UNIFORM, .lower = -2, .upper = 2};
    default:
        return (bt_distribution){.kind = BT_NORMAL, .mean = 0, .sd = 1};
    }
}

static void make_study(const world* w, bt_study* study) {
    memset(study, 0, sizeof *study);
    study->input_count = w->dims;
    study->campaign.seed = 3;
    study->campaign.unsure = w->unsure;
    study->reliability.half_width = w->half_width;
    study->reliability.samples = SAMPLES;
    for (int k = 0; k < w->dims; ++k) {
        study->inputs[k].random = true;
        study->inputs[k].distribution = input_of(w->kind);
    }
    if (w->kind == 3) {
        study->correlations[study->correlation_count++] = (bt_correlation){0, 1, 0.6};
        study->correlations[study->correlation_count++] = (bt_correlation){1, 2, -0.5};
    }
    const double mean = bt_distribution_mean(&study->inputs[0].distribution);
    for (int c = 0; c < CONDITIONS - 1; ++c)
        study->conditions[study->condition_count++] =
            (bt_condition){0, mean + w->reach * (c - 1) * (w->kind == 1 ? 0.3 : 0.75)};
}

/// Fresh points of a component, keyed.
static void draw(const bt_mixture* m, int component, uint64_t seed, int64_t i, double* x) {
    double u[BT_INPUT_MAX];
    for (int k = 0; k < m->dims; ++k)
        u[k] = bt_rng_uniform(seed, (uint64_t)i, (uint32_t)k + 0x900);
    bt_mixture_point(m, component, u, x);
}

static double truth(const world* w, const bt_mixture* m, int component) {
    double x[BT_INPUT_MAX];
    int hits = 0;
    for (int i = 0; i < TRUTH; ++i) {
        draw(m, component, 12345, i, x);
        hits += w->engaged(x, w->dims);
    }
    return (double)hits / TRUTH;
}

typedef struct tally {
    int covered[CONDITIONS], apart, reweighted, landings;
    double width[CONDITIONS];
} tally;

/// One campaign with its estimates.
static void repeat(const world* w, const bt_study* study, const bt_mixture* m,
                   const double* probability, uint64_t seed, tally* score) {
    bt_evidence e;
    assert_int_equal(bt_evidence_create(w->dims, w->landings, &e), BT_OK);
    bt_rounds rounds = {.seed = seed,
                        .threads = 1,
                        .candidates = 4096,
                        .chosen = {.C = 100, .gamma = 0.3, .cv_count = 100, .cv_correct = 96}};
    for (int k = 0; k < w->dims; ++k)
        rounds.chosen.weight[k] = 1;
    int8_t* judged = calloc((size_t)w->landings, 1);
    int64_t hits[CONDITIONS] = {0}, samples = 0;
    bt_widths widths;
    assert_int_equal(bt_widths_create(study, m, NULL, 1 - w->unsure, &widths), BT_OK);
    double* weight = malloc((size_t)m->components * (size_t)w->landings * sizeof *weight);
    for (int begin = 0; begin < w->landings;) {
        int end = (int)bt_round_end(begin);
        end = end < w->landings ? end : w->landings;
        double* x = e.x + (size_t)begin * (size_t)w->dims;
        bt_surrogate classifier = {0};
        bt_predictor* predictor = NULL;
        if (begin == 0) {
            for (int i = 0; i < end; ++i) {
                draw(m, bt_mixture_pick(m, bt_rng_uniform(seed, (uint64_t)i, 7)), seed, i,
                     x + i * w->dims);
                e.log_density[i] = bt_mixture_log_density(m, x + i * w->dims, NULL);
                judged[i] = -1;
            }
        } else {
            assert_int_equal(bt_rounds_classifier(&rounds, &e, begin, &classifier, NULL), BT_OK);
            assert_int_equal(bt_rounds_draw(&rounds, m, &classifier, begin, end - begin, w->unsure,
                                            x, e.log_density + begin),
                             BT_OK);
            assert_int_equal(bt_predictor_create(&classifier, bt_isa_best(), &predictor), BT_OK);
            bt_predictor_label(predictor, x, end - begin, judged + begin, NULL);
            for (int i = begin; i < end; ++i)
                judged[i] = judged[i] > 0;
            const int n = (int)((int64_t)SAMPLES * (end - begin) / (w->landings - 128));
            for (int c = 0; c < m->components; ++c)
                for (int i = 0; i < n; ++i) {
                    double point[BT_INPUT_MAX];
                    int8_t label;
                    draw(m, c, seed + 77, samples + i, point);
                    bt_predictor_label(predictor, point, 1, &label, NULL);
                    hits[c] += label > 0;
                }
            samples += n;
        }
        for (int i = begin; i < end; ++i)
            e.label[i] = (int8_t)w->engaged(e.x + (size_t)i * (size_t)w->dims, w->dims);
        e.count = end;
        bt_predictor_destroy(predictor);
        bt_surrogate_destroy(&classifier);
        begin = end;
        if (bt_stop_wanted(study)) {
            bt_pooled_weigh(m, &e, weight);
            const bt_width width = bt_width_after(&widths, &e, judged, weight, e.count);
            if (bt_stop_reached(study, &width))
                break;
        }
    }
    bt_pooled_weigh(m, &e, weight);
    score->landings += e.count;
    bt_cut cut[2];
    for (int c = 0; c < m->components; ++c) {
        const double* own = weight + c * e.count;
        cut[c & 1] = bt_pooled_cut(&widths.law[c], e.count - 128, bt_stop_tail(study));
        const bt_pooled p = bt_pooled_estimate(&e, judged, own, &cut[c & 1], hits[c], samples);
        score->covered[c] += p.ci95.least <= probability[c] && probability[c] <= p.ci95.greatest;
        score->width[c] += 0.5 * (p.ci95.greatest - p.ci95.least);
        const bt_pooled r = bt_reweighted_estimate(&e, own, &cut[c & 1]);
        score->reweighted += r.ci95.least <= probability[c] && probability[c] <= r.ci95.greatest;
        if (c > 0) {
            const double means = (double)(hits[c] - hits[c - 1]) / (double)samples;
            const double spread = 1.96 * sqrt(0.5 / (double)samples);
            const bt_pooled d =
                bt_pooled_difference(&e, judged, own, own - e.count, &cut[c & 1], &cut[(c - 1) & 1],
                                     means, (bt_interval){means - spread, means + spread});
            const double apart = probability[c] - probability[c - 1];
            score->apart += d.ci95.least <= apart && apart <= d.ci95.greatest;
        }
    }
    bt_widths_destroy(&widths);
    free(weight);
    free(judged);
    bt_evidence_destroy(&e);
}

/// Whether `covered` of n is no worse than 95 % would give with probability 1e-3.
static bool enough(int covered, int n) {
    return gsl_cdf_binomial_P((unsigned)covered, 0.95, (unsigned)n) > 1e-3;
}

static void pooled_intervals_cover_in_every_world(void** state) {
    (void)state;
    const int repeats = getenv("BT_REPEATS") ? atoi(getenv("BT_REPEATS")) : REPEATS;
    bt_study* study = malloc(sizeof *study);
    for (size_t i = 0; i < sizeof worlds / sizeof worlds[0]; ++i) {
        const world* w = &worlds[i];
        bt_mixture* m;
        make_study(w, study);
        assert_int_equal(bt_mixture_create(study, &m, NULL), BT_OK);
        double probability[CONDITIONS];
        for (int c = 0; c < m->components; ++c)
            probability[c] = truth(w, m, c);
        tally s = {0};
        for (int r = 0; r < repeats; ++r)
            repeat(w, study, m, probability, 1000 + (uint64_t)r, &s);
        printf("%-32s", w->name);
        for (int c = 0; c < m->components; ++c)
            printf(" %.4f %2d/%d +-%.4f", probability[c], s.covered[c], repeats,
                   s.width[c] / repeats);
        printf("  reweighted %d differences %d landings %d\n", s.reweighted, s.apart,
               s.landings / repeats);
        fflush(stdout);
        for (int c = 0; c < m->components; ++c)
            assert_true(enough(s.covered[c], repeats));
        free(m);
    }
    free(study);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pooled_intervals_cover_in_every_world),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
