/// The cable under wheels: timing by d'Alembert, and the convergence of what comes back.
#include "test_cable_case.h"

/* ---- a point pressed down, stopped and held (physics data 4.5) ---- */

enum { PRESSED_COUNT = 240 };
static const double HALF_M = 6, WHEEL_M = 2.4, DEPTH_M = 5e-4, RAMP_S = 6e-3, TENSION_N = 24e3,
                    PATCH_M = 0.025; /* the pressed place reaches this far to both sides */

static double pressed_depth(double t) {
    return t <= 0       ? 0
           : t < RAMP_S ? DEPTH_M * 0.5 * (1 - cos(3.14159265358979323846 * t / RAMP_S))
                        : DEPTH_M;
}

/// Presses both wheels' places down by stiff springs.
static void press(rope* r) {
    bt_cable_state* s = &r->state;
    const double t = s->scalars->time_s, goal = -pressed_depth(t);
    const double rate = (goal + pressed_depth(t - 1e-6)) / 1e-6;
    for (int i = 0; i < r->model.count; ++i)
        if (fabs(fabs(r->model.rest_y_m[i]) - WHEEL_M) < 0.03)
            s->fz[i] = 1e7 * (goal - s->z[i]) + 2e3 * (rate - s->vz[i]);
}

static double height_at(const rope* r, double y) {
    double at[3];
    assert_true(bt_cable_centreline(&r->model, &r->state, y, -1, at, NULL, NULL) >= 0);
    return at[2];
}

/// Linear interpolation of the time at which a height passes a level.
static void note_crossing(double before, double now, double level, double t, double step,
                          double* when) {
    if (isnan(*when) && (before > level) != (now > level))
        *when = t - step * (now - level) / (now - before);
}

static void pressed_cable_sends_fronts_that_meet_and_return_by_dalembert(void** state) {
    (void)state;
    bt_cable_def def = rope_def(PRESSED_COUNT, 2 * HALF_M);
    def.bending_stiffness_Nm2 = 0;
    def.end[0].kind = def.end[1].kind = BT_CABLE_PINNED;
    def.end[0].anchor_m[1] = -HALF_M;
    def.end[1].anchor_m[1] = HALF_M;
    rope r;
    rope_open(&r, &def, 2 * HALF_M / (1 + TENSION_N / def.axial_stiffness_N));
    const double step = 0.9 * r.model.stable_step_s, speed = sqrt(TENSION_N / def.mass_kgpm);
    double middle = NAN, out = NAN, back = NAN, plateau = 0;
    int counted = 0;
    double centre_before = 0, outer_before = 0;
    while (r.state.scalars->time_s < 0.095) {
        press(&r);
        rope_run(&r, 1, step);
        const double t = r.state.scalars->time_s;
        const double centre = height_at(&r, 0), outer = height_at(&r, 4);
        note_crossing(centre_before, centre, -DEPTH_M, t, step, &middle);
        if (isnan(out))
            note_crossing(outer_before, outer, -0.5 * DEPTH_M, t, step, &out);
        else
            note_crossing(outer_before, outer, -0.5 * DEPTH_M, t, step, &back);
        if (t > 0.055) {
            plateau += centre;
            ++counted;
        }
        centre_before = centre;
        outer_before = outer;
    }
    const double start = 0.5 * RAMP_S - PATCH_M / speed;
    const double want[3] = {start + WHEEL_M / speed, start + (4 - WHEEL_M) / speed,
                            start + (HALF_M - WHEEL_M + HALF_M - 4) / speed};
    print_message(
        "fronts meet at %.5f s (%.5f), pass 4 m at %.5f (%.5f), are back at %.5f (%.5f)\n", middle,
        want[0], out, want[1], back, want[2]);
    BT_ASSERT_NEAR(middle, want[0], 3e-3, 0);
    BT_ASSERT_NEAR(out, want[1], 3e-3, 0);
    BT_ASSERT_NEAR(back, want[2], 3e-3, 0);
    /* without a deck both depressions add, and stay */
    BT_ASSERT_NEAR(plateau / counted, -2 * DEPTH_M, 3e-3, 0);
    rope_close(&r);
}

/* ---- two wheels over the arresting cable ---- */

enum { SAMPLES = 300 };
static const double SAMPLE_S = 5e-4;

/* Stiff parabolas (radius 0.47 m, width 0.3 m) at +-2.445 m roll over at 47.5 m/s. Heights at y. */
static void roll_over(double scale, double y, double height[SAMPLES]) {
    static double length[BT_CABLE_SEGMENTS_MAX];
    bt_cable_params p;
    bt_cable_def def;
    bt_group_set_defaults(&bt_cable_group, &p);
    p.mesh.fine_length_m *= scale;
    p.mesh.medium_length_m *= scale;
    p.mesh.coarse_length_m *= scale;
    bt_cable_def_init(&def, &p, 9.80665, length);
    rope r;
    assert_int_equal(bt_arena_create(&r.arena, bt_cable_memory(def.count, 1)), BT_OK);
    assert_int_equal(bt_cable_model_init(&r.model, &def, &r.arena, NULL), BT_OK);
    assert_int_equal(bt_cable_state_init(&r.model, &r.state, &r.arena), BT_OK);
    assert_int_equal(bt_cable_equilibrium(&r.model, &r.state, NULL, NULL), BT_OK);
    bt_cable_state* s = &r.state;
    const double step = 0.9 * r.model.stable_step_s, radius = 0.47, reach = 0.34;
    for (int n = 0; n < SAMPLES; ++n) {
        while (s->scalars->time_s < n * SAMPLE_S) {
            const double xi = 47.5 * s->scalars->time_s - reach, tread = xi * xi / (2 * radius);
            bt_cable_clear_loads(&r.model, s);
            for (int i = 0; i < r.model.count && xi < reach; ++i) {
                const double wheel = s->y[i] < 0 ? -2.445 : 2.445, h = r.model.half_m[i];
                const double low = fmax(s->y[i] - h * s->ty[i], wheel - 0.15);
                const double high = fmin(s->y[i] + h * s->ty[i], wheel + 0.15);
                const double middle = 0.5 * (low + high);
                const double z = s->z[i] + (middle - s->y[i]) * s->tz[i] / s->ty[i];
                const double depth = fmin(z + r.model.radius_m - tread, 2 * r.model.radius_m);
                const double push = (high - low) * (2e6 * depth + 300 * s->vz[i]);
                const double force[3] = {0, 0, -push}, at[3] = {s->x[i], middle, z};
                if (high > low && depth > 0 && push > 0)
                    bt_cable_add_load(s, i, force, at);
            }
            bt_cable_step(&r.model, s, step);
        }
        height[n] = height_at(&r, y);
    }
    rope_close(&r);
}

static void what_the_hook_meets_converges_with_the_segments(void** state) {
    (void)state;
    for (double y = 0; y < 2; y += 1) {
        static double coarse[SAMPLES], usual[SAMPLES], fine[SAMPLES];
        roll_over(2, y, coarse);
        roll_over(1, y, usual);
        roll_over(0.5, y, fine);
        double rms[2] = {0, 0}, lowest = 1;
        for (int n = 0; n < SAMPLES; ++n) {
            rms[0] += pow(coarse[n] - fine[n], 2) / SAMPLES;
            rms[1] += pow(usual[n] - fine[n], 2) / SAMPLES;
            lowest = fmin(lowest, fine[n]);
        }
        print_message("height at y = %g m over 150 ms: doubled segments %.2f mm, defaults %.2f mm "
                      "from halved ones (rms); lowest %.1f mm\n",
                      y, 1e3 * sqrt(rms[0]), 1e3 * sqrt(rms[1]), 1e3 * lowest);
        assert_true(lowest < 0.03); /* it was knocked flat */
        assert_true(sqrt(rms[1]) < 1e-3);
        assert_true(rms[1] < 0.1 * rms[0]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pressed_cable_sends_fronts_that_meet_and_return_by_dalembert),
        cmocka_unit_test(what_the_hook_meets_converges_with_the_segments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
