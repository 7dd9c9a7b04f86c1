/// The carcass over a rope against the obstacle problem it solves, solved on a grid; its limits;
/// and the tyre that has one.
#include "elements/carcass.h"

#include "elements/tyre.h"
#include "near.h"

static const double ROPE_M = 0.0175; ///< radius

static bt_tyre tyre_with(double bridging_m) {
    bt_tyre_params p;
    bt_tyre t;
    bt_group_set_defaults(&bt_tyre_group, &p);
    p.bridging_length_m = bridging_m;
    bt_tyre_prepare(&p, &t);
    return t;
}

static double together(double radius_m) {
    return 1 / (1 / tyre_with(0).radius + 1 / radius_m);
}

/* ---- on a grid: the lowest string above an obstacle ---- */

enum { CELLS = 4000 };
static const double HALF_M = 0.8;

typedef struct grid {
    double ground[CELLS + 1], w[CELLS + 1], cell_m;
} grid;

/// Projected successive over-relaxation of w - lambda^2 w'' >= 0, w >= ground; w' = 0 at the ends.
static void settle(grid* g, double lambda) {
    const double share = lambda * lambda / (g->cell_m * g->cell_m);
    for (int i = 0; i <= CELLS; ++i)
        g->w[i] = fmax(g->ground[i], 0);
    for (int sweep = 0; sweep < 40000; ++sweep) {
        double moved = 0;
        for (int i = 0; i <= CELLS; ++i) {
            const double beside = g->w[i ? i - 1 : 1] + g->w[i < CELLS ? i + 1 : CELLS - 1];
            const double free = share * beside / (1 + 2 * share);
            const double next = fmax(g->ground[i], g->w[i] + 1.98 * (free - g->w[i]));
            moved = fmax(moved, fabs(next - g->w[i]));
            g->w[i] = next;
        }
        if (moved < 1e-12)
            break;
    }
}

/// Area over a level within `half` of the middle.
static double area_over(const grid* g, double level, double half) {
    double area = 0;
    for (int i = 0; i <= CELLS; ++i) {
        const double s = i * g->cell_m - HALF_M;
        if (fabs(s) <= half)
            area += (g->w[i] - level) * g->cell_m;
    }
    return area;
}

static grid over_rope(double rho, double depth, double level) {
    grid g = {.cell_m = 2 * HALF_M / CELLS};
    for (int i = 0; i <= CELLS; ++i) {
        const double s = i * g.cell_m - HALF_M;
        const double rope = fabs(s) < rho ? depth - rho + sqrt(rho * rho - s * s) : 0;
        g.ground[i] = fmax(rope, level);
    }
    return g;
}

static void the_string_over_a_rope_is_the_lowest_one_above_it(void** state) {
    (void)state;
    static const struct {
        double lambda, depth, level;
    } cases[] = {{0.05, 0.02, 0},    {0.10, 0.02, 0},     {0.05, 0.06, 0},    {0.02, 0.01, 0},
                 {0.05, 0.04, 0.02}, {0.10, 0.075, 0.04}, {0.03, 0.012, 0.01}};
    const double rho = together(ROPE_M);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const double level = cases[k].level;
        static grid g;
        g = over_rope(rho, cases[k].depth, level);
        settle(&g, cases[k].lambda);
        const bt_bridge b = bt_carcass_over_cylinder(cases[k].lambda, rho, cases[k].depth, level);
        BT_ASSERT_NEAR(b.above_m2, area_over(&g, level, HALF_M), 5e-3, 0);
        // the rope carries the area up to where the string lies on the level again
        double flat_m = 0;
        while (flat_m < HALF_M && g.w[(int)((HALF_M + flat_m) / g.cell_m)] > level + 1e-7)
            flat_m += g.cell_m;
        BT_ASSERT_NEAR(b.carried_m2, area_over(&g, 0, flat_m), 1e-2, 0);
    }
}

static void the_string_over_a_flat_floor_is_the_lowest_one_above_it(void** state) {
    (void)state;
    const double big = tyre_with(0).radius, lambda = 0.05, d = 0.03;
    static grid g;
    g.cell_m = 2 * HALF_M / CELLS;
    for (int i = 0; i <= CELLS; ++i) {
        const double s = i * g.cell_m - HALF_M;
        g.ground[i] = d - s * s / (2 * big);
    }
    settle(&g, lambda);
    const double parabola = 4.0 / 3 * d * sqrt(2 * big * d);
    BT_ASSERT_NEAR(bt_carcass_beside_patch(lambda, big, d), area_over(&g, 0, HALF_M) - parabola,
                   2e-3, 0);
    for (double s = 0; s < 0.4; s += 0.05)
        BT_ASSERT_NEAR(bt_carcass_on_floor(lambda, big, d, s),
                       g.w[(int)lround((HALF_M + s) / g.cell_m)], 1e-2, 1e-6);
}

/* ---- limits ---- */

static void loose_strips_are_the_limit_of_a_short_string(void** state) {
    (void)state;
    const bt_tyre loose = tyre_with(0), taut = tyre_with(1e-8);
    for (double height = 0.40; height < 0.5; height += 0.011)
        for (double u = -0.12; u < 0.13; u += 0.04) {
            const bt_bump rope = {
                .kind = BT_BUMP_CIRCLE, .u_m = u, .w_m = ROPE_M - height, .size_m = ROPE_M};
            bt_envelope a, b;
            bt_tyre_envelope(&loose, height, &rope, 1, &a);
            bt_tyre_envelope(&taut, height, &rope, 1, &b);
            BT_ASSERT_NEAR(b.deflection_m, a.deflection_m, 1e-5, 1e-9);
            BT_ASSERT_NEAR(b.ground.area_m2, a.ground.area_m2, 1e-5, 1e-8);
            BT_ASSERT_NEAR(b.bump[0].area_m2, a.bump[0].area_m2, 1e-5, 1e-8);
        }
}

static void a_flat_deck_does_not_feel_the_carcass(void** state) {
    (void)state;
    const bt_tyre loose = tyre_with(0), taut = tyre_with(0.1);
    const bt_bump away = {.kind = BT_BUMP_CIRCLE, .u_m = 0.45, .w_m = -0.3, .size_m = ROPE_M};
    for (double height = 0.35; height < 0.5; height += 0.01)
        for (int bumps = 0; bumps < 2; ++bumps) {
            bt_envelope a, b;
            bt_tyre_envelope(&loose, height, &away, bumps, &a);
            bt_tyre_envelope(&taut, height, &away, bumps, &b);
            assert_true(a.deflection_m == b.deflection_m);
            BT_ASSERT_NEAR(a.deflection_m, fmax(loose.radius - height, 0), 1e-14, 0);
        }
}

/// The equivalent deflection undoes the area of a flat patch.
static void area_and_deflection_are_inverse(void** state) {
    (void)state;
    const double big = 0.47;
    for (double lambda = 0; lambda < 0.3; lambda += 0.04)
        for (double d = 1e-6; d < 0.2; d *= 3) {
            const double area =
                bt_tyre_segment_area(big, d) + bt_carcass_beside_patch(lambda, big, d);
            BT_ASSERT_NEAR(bt_carcass_equivalent_deflection(lambda, big, area), d, 1e-10, 0);
        }
    assert_true(bt_carcass_equivalent_deflection(0.05, big, 0) == 0);
}

/// A long string makes no difference between a thin rope and a floor: w = d exp(-s / lambda) over
/// both, as long as sqrt(2 R d) << lambda.
static void a_shallow_rope_under_a_long_string_is_a_floor(void** state) {
    (void)state;
    const bt_tyre taut = tyre_with(0.3);
    const double depth = 2e-5;
    const bt_bump rope = {
        .kind = BT_BUMP_CIRCLE, .u_m = 0, .w_m = -(taut.radius + ROPE_M - depth), .size_m = ROPE_M};
    bt_envelope e;
    bt_tyre_envelope(&taut, 0.9, &rope, 1, &e);
    BT_ASSERT_NEAR(e.deflection_m, depth, 2e-3, 0);
}

/* ---- the rope under a tyre off the deck ---- */

/// Force on the wheel from a rope at (u, w) off the deck, all of the width.
static void push(const bt_tyre* t, double u, double w, double force[2]) {
    const bt_bump rope = {.kind = BT_BUMP_CIRCLE, .u_m = u, .w_m = w, .size_m = ROPE_M};
    bt_envelope e;
    bt_tyre_envelope(t, 2 * t->radius, &rope, 1, &e);
    const double load = bt_tyre_load(t, e.deflection_m);
    force[0] = load * e.bump[0].g_u;
    force[1] = load * e.bump[0].g_w;
}

/// 20 mm deep: 0.36 MN/m on loose strips, 1.0 to 1.6 MN/m over the range of the key, never more
/// than a flat floor at the same depth.
static void the_carcass_makes_the_tyre_three_to_four_times_as_stiff_on_a_rope(void** state) {
    (void)state;
    static const double lambda[] = {0, 0.05, 0.1, 0.15},
                        at_20mm_Npm[] = {.36e6, .98e6, 1.38e6, 1.59e6};
    for (int k = 0; k < 4; ++k) {
        const bt_tyre t = tyre_with(lambda[k]);
        double force[2];
        push(&t, 0, -(t.radius + ROPE_M - 0.02), force);
        BT_ASSERT_NEAR(force[1] / 0.02, at_20mm_Npm[k], 0.02, 0);
        assert_true(force[1] < bt_tyre_load(&t, 0.02));
    }
}

/// Work around a closed path of the rope: none, and work of a way in comes back on any way out.
static void a_rope_off_the_deck_gets_its_work_back_on_any_way(void** state) {
    (void)state;
    const bt_tyre t = tyre_with(0.05);
    enum { STEPS = 4000 };
    double work = 0, put_in = 0;
    for (int i = 0; i < STEPS; ++i) {
        const double a = 2 * acos(-1.0) * (i + 0.5) / STEPS, da = 2 * acos(-1.0) / STEPS;
        const double u = 0.05 + 0.04 * sin(a), w = -(t.radius - 0.01) + 0.02 * cos(a);
        double force[2];
        push(&t, u, w, force);
        const double part = -(force[0] * 0.04 * cos(a) - force[1] * 0.02 * sin(a)) * da;
        work += part;
        put_in += fmax(part, 0);
    }
    assert_true(put_in > 100);
    BT_ASSERT_NEAR(work, 0, 0, 1e-3 * put_in);
}

/// Rope and deck together: deeper never means less, no share is negative and none jumps. Where the
/// tread comes down on the deck, the rope's share pauses.
static void the_load_grows_as_the_wheel_goes_down_on_a_rope_on_the_deck(void** state) {
    (void)state;
    const bt_tyre t = tyre_with(0.05);
    double last = -1, last_rope = -1;
    for (double height = t.radius + 2 * ROPE_M - 1e-4; height > 0.36; height -= 5e-4) {
        const bt_bump rope = {.kind = BT_BUMP_CIRCLE, .w_m = ROPE_M - height, .size_m = ROPE_M};
        bt_envelope e;
        bt_tyre_envelope(&t, height, &rope, 1, &e);
        const double load = bt_tyre_load(&t, e.deflection_m);
        assert_true(load > last);
        assert_true(e.ground.area_m2 >= 0 && e.bump[0].area_m2 >= 0);
        const double on_rope = load * e.bump[0].area_m2 / e.all.area_m2;
        assert_true(on_rope > 0.99 * last_rope);
        if (last_rope > 1e4)
            assert_true(on_rope < 1.06 * last_rope);
        BT_ASSERT_NEAR(e.ground.area_m2 + e.bump[0].area_m2, e.all.area_m2, 1e-12, 1e-15);
        assert_true(load <= bt_tyre_load(&t, t.radius + 2 * ROPE_M - height) * (1 + 1e-9));
        last = load;
        last_rope = on_rope;
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_string_over_a_rope_is_the_lowest_one_above_it),
        cmocka_unit_test(the_string_over_a_flat_floor_is_the_lowest_one_above_it),
        cmocka_unit_test(loose_strips_are_the_limit_of_a_short_string),
        cmocka_unit_test(a_flat_deck_does_not_feel_the_carcass),
        cmocka_unit_test(area_and_deflection_are_inverse),
        cmocka_unit_test(a_shallow_rope_under_a_long_string_is_a_floor),
        cmocka_unit_test(the_carcass_makes_the_tyre_three_to_four_times_as_stiff_on_a_rope),
        cmocka_unit_test(a_rope_off_the_deck_gets_its_work_back_on_any_way),
        cmocka_unit_test(the_load_grows_as_the_wheel_goes_down_on_a_rope_on_the_deck),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
