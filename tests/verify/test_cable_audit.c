/// What the cable must keep: energy, momentum, symmetry, bits; and the order of its step.
#include "test_cable_case.h"

#include <stdio.h>

#define PI 3.14159265358979323846

/// Repeatable numbers in -1 .. 1.
static double noise(unsigned* seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(int)*seed / 2147483648.0;
}

/// A free flying rope: bent into an arc, twisted, moving and tumbling with random velocities.
static void throw_rope(rope* r, double speed) {
    bt_cable_state* s = &r->state;
    unsigned seed = 1;
    for (int i = 0; i < r->model.count; ++i) {
        const double u = r->model.rest_y_m[i];
        rope_turn(r, i, 0.5 * sin(u), 0.2 * cos(u), 0.3 * sin(2 * u));
        if (i > 0) { /* joined end to end */
            const double hi = r->model.half_m[i - 1], hj = r->model.half_m[i];
            s->x[i] = s->x[i - 1] + hi * s->tx[i - 1] + hj * s->tx[i];
            s->y[i] = s->y[i - 1] + hi * s->ty[i - 1] + hj * s->ty[i];
            s->z[i] = s->z[i - 1] + hi * s->tz[i - 1] + hj * s->tz[i];
        }
        s->vx[i] = speed * (sin(u) + 0.2 * noise(&seed));
        s->vy[i] = speed * 0.2 * noise(&seed);
        s->vz[i] = speed * (cos(2 * u) + 0.2 * noise(&seed));
        s->hx[i] = 0.02 * noise(&seed);
        s->hy[i] = 0.002 * noise(&seed);
        s->hz[i] = 0.02 * noise(&seed);
    }
}

static double total(const bt_cable_energy* e) {
    return e->kinetic_J + e->elastic_J + e->gravity_J;
}

static void undamped_free_rope_keeps_its_energy(void** state) {
    (void)state;
    double drift[2];
    for (int k = 0; k < 2; ++k) {
        bt_cable_def def = rope_def(80, 4);
        rope r;
        rope_open(&r, &def, 4);
        throw_rope(&r, 5);
        const double step = (k ? 0.25 : 0.5) * r.model.stable_step_s;
        rope_run(&r, 1, step);
        bt_cable_energy e;
        bt_cable_audit(&r.model, &r.state, &e);
        const double start = total(&e);
        double most = 0, least = 0, last = 0;
        for (int j = 0; j < 400 * (1 + k); ++j) {
            rope_run(&r, 100, step);
            bt_cable_audit(&r.model, &r.state, &e);
            last = total(&e) / start - 1;
            most = fmax(most, last);
            least = fmin(least, last);
        }
        drift[k] = most - least;
        print_message("energy over %d steps: within %.3g .. %.3g, at the end %.3g\n",
                      40000 * (1 + k), least, most, last);
        rope_close(&r);
    }
    assert_true(drift[0] < 5e-3);
    assert_true(drift[1] < 0.4 * drift[0]); /* the error of the step, not of the forces */
}

static void undamped_energy_is_bounded_at_the_stable_step(void** state) {
    (void)state;
    bt_cable_def def = rope_def(80, 4);
    rope r;
    rope_open(&r, &def, 4);
    throw_rope(&r, 0.05);
    rope_run(&r, 1, r.model.stable_step_s);
    bt_cable_energy e;
    bt_cable_audit(&r.model, &r.state, &e);
    const double start = total(&e);
    for (int j = 0; j < 100; ++j)
        rope_run(&r, 1000, 0.99 * r.model.stable_step_s);
    bt_cable_audit(&r.model, &r.state, &e);
    print_message("at 0.99 of the stable step: energy ratio %.4g after 1e5 steps\n",
                  total(&e) / start);
    assert_true(bt_cable_is_finite(&r.model, &r.state));
    assert_true(total(&e) < 2 * start);
    rope_close(&r);
}

/// Eqs. 13, 15, 17.
static void damped_energy_never_rises(void** state) {
    (void)state;
    bt_cable_def def = rope_def(80, 4);
    def.axial_damping_Ns = 80;
    def.bending_damping_Nm2s = 0.03;
    def.twist_damping_Nm2s = 0.03;
    rope r;
    rope_open(&r, &def, 4);
    throw_rope(&r, 5);
    const double step = 0.3 * r.model.stable_step_s;
    rope_run(&r, 1, step);
    bt_cable_energy e;
    bt_cable_audit(&r.model, &r.state, &e);
    const double start = total(&e);
    double before = start;
    for (int j = 0; j < 2000; ++j) {
        rope_run(&r, 20, step);
        bt_cable_audit(&r.model, &r.state, &e);
        assert_true(total(&e) <= before + 1e-5 * start);
        before = total(&e);
    }
    assert_true(before < 0.999 * start);
    rope_close(&r);
}

static void free_rope_keeps_linear_and_angular_momentum(void** state) {
    (void)state;
    for (int level = BT_KERNEL_V1; level <= BT_KERNEL_V4; ++level) {
        bt_cable_def def = rope_def(80, 4);
        def.level = (bt_kernel_level)level;
        def.axial_damping_Ns = 80;
        def.bending_damping_Nm2s = 0.03;
        def.twist_damping_Nm2s = 0.03;
        def.compression_ratio = 0.01;
        rope r;
        rope_open(&r, &def, 4);
        throw_rope(&r, 5);
        bt_cable_energy before, after;
        bt_cable_audit(&r.model, &r.state, &before);
        rope_run(&r, 10000, 0.9 * r.model.stable_step_s);
        bt_cable_audit(&r.model, &r.state, &after);
        double scale = 4 * 5.536 * 5;
        for (int k = 0; k < 3; ++k) {
            BT_ASSERT_NEAR(after.momentum_kgmps[k], before.momentum_kgmps[k], 0, 1e-10 * scale);
            BT_ASSERT_NEAR(after.angular_momentum_Nms[k], before.angular_momentum_Nms[k], 0,
                           1e-10 * scale * 4);
        }
        rope_close(&r);
    }
}

static void momentum_grows_by_the_external_impulse(void** state) {
    (void)state;
    bt_cable_def def = rope_def(80, 4);
    def.axial_damping_Ns = 80;
    rope r;
    rope_open(&r, &def, 4);
    const double step = 0.9 * r.model.stable_step_s, force[3] = {300, -200, 500};
    const double point[3] = {0.02, 1.23, -0.01};
    bt_cable_energy before, after;
    bt_cable_audit(&r.model, &r.state, &before);
    double turn[3] = {0, 0, 0}, impulse = 0;
    for (int k = 0; k < 2000; ++k) {
        /* a load on segment 24, at a point that moves with it */
        const double at[3] = {r.state.x[24] + point[0], r.state.y[24] + 0.005,
                              r.state.z[24] + point[2]};
        const double kick = k ? step : 0.5 * step;
        turn[0] += kick * (at[1] * force[2] - at[2] * force[1]);
        turn[1] += kick * (at[2] * force[0] - at[0] * force[2]);
        turn[2] += kick * (at[0] * force[1] - at[1] * force[0]);
        impulse += kick;
        bt_cable_clear_loads(&r.model, &r.state);
        bt_cable_add_load(&r.state, 24, force, at);
        rope_run(&r, 1, step);
    }
    bt_cable_clear_loads(&r.model, &r.state);
    bt_cable_audit(&r.model, &r.state, &after);
    for (int k = 0; k < 3; ++k) {
        BT_ASSERT_NEAR(after.momentum_kgmps[k], impulse * force[k], 1e-10, 1e-10);
        BT_ASSERT_NEAR(after.angular_momentum_Nms[k], turn[k], 1e-9, 1e-9);
    }
    rope_close(&r);
}

/// Height of a plucked, bent, undamped wire at one time.
static double plucked(double step) {
    bt_cable_def def = rope_def(60, 3);
    def.end[0].kind = def.end[1].kind = BT_CABLE_PINNED;
    def.end[1].anchor_m[1] = 3 * (1 + 5e-4);
    rope r;
    rope_open(&r, &def, 3);
    for (int i = 0; i < 60; ++i) {
        const double k = PI / 3, y = r.model.rest_y_m[i];
        r.state.vz[i] = 2 * sin(k * y) + sin(2 * k * y);
        const double slope = 2 * k * cos(k * y) + 2 * k * cos(2 * k * y);
        r.state.hx[i] = slope / r.model.inverse_tilt[i];
    }
    rope_run(&r, (int)lround(0.0128 / step), step);
    const double z = r.state.z[20];
    rope_close(&r);
    return z;
}

static void step_is_of_second_order(void** state) {
    (void)state;
    const double h = 1.28e-5, fine = plucked(h / 16);
    double error[3];
    for (int k = 0; k < 3; ++k)
        error[k] = plucked(h / (1 << k)) - fine;
    print_message("error over three steps: %.4g %.4g %.4g\n", error[0], error[1], error[2]);
    assert_true(order_of(error) > 1.9 && order_of(error) < 2.2);
}

static void torsional_frequency_of_a_clamped_rod(void** state) {
    (void)state;
    /* quarter wave: f = sqrt(GJ / (mu r^2 / 2)) / 4 L; segments give 1 - (k l)^2 / 24 */
    for (int count = 20; count <= 40; count *= 2) {
        bt_cable_def def = rope_def(count, 2);
        def.end[0].kind = BT_CABLE_CLAMPED;
        rope r;
        rope_open(&r, &def, 2);
        const double polar = 5.536 * 0.01825 * 0.01825 / 2, exact = sqrt(60 / polar) / 8;
        for (int i = 0; i < count; ++i)
            r.state.hy[i] = 1e-3 * sin(PI / 4 * r.model.rest_y_m[i]) * polar * 2 / count;
        const double step = 0.02 * r.model.stable_step_s;
        double before = 0, now = 0, crossing = 0;
        for (int j = 1; crossing == 0 && j * step < 1 / exact; ++j) {
            rope_run(&r, 1, step);
            before = now;
            now = r.state.e2[count - 1];
            if (before > 0 && now <= 0)
                crossing = step * (j - 1 + before / (before - now));
        }
        BT_ASSERT_NEAR(0.5 / crossing, exact, 0.11 / (count * count), 0);
        rope_close(&r);
    }
}

/* ---- the arresting cable ---- */

static void open_cable(rope* r, bt_kernel_level level) {
    static double length[BT_CABLE_SEGMENTS_MAX];
    bt_cable_params p;
    bt_cable_def def;
    bt_group_set_defaults(&bt_cable_group, &p);
    bt_cable_def_init(&def, &p, 9.80665, length);
    def.level = level;
    assert_int_equal(bt_arena_create(&r->arena, bt_cable_memory(def.count, 2)), BT_OK);
    assert_int_equal(bt_cable_model_init(&r->model, &def, &r->arena, NULL), BT_OK);
    assert_int_equal(bt_cable_state_init(&r->model, &r->state, &r->arena), BT_OK);
    assert_int_equal(bt_cable_equilibrium(&r->model, &r->state, NULL, NULL), BT_OK);
}

/// Two wheels' worth of force on the cable at +-2.4 m for 4 ms, then free flight and deck contact.
static void beat(rope* r, double milliseconds) {
    const double step = 0.9 * r->model.stable_step_s;
    while (r->state.scalars->time_s < 1e-3 * milliseconds) {
        bt_cable_clear_loads(&r->model, &r->state);
        for (int i = 0; i < r->model.count && r->state.scalars->time_s < 4e-3; ++i)
            if (fabs(fabs(r->model.rest_y_m[i]) - 2.4) < 0.12) {
                r->state.fz[i] = -30e3 * 2 * r->model.half_m[i];
                r->state.fx[i] = 3e3 * 2 * r->model.half_m[i];
            }
        rope_run(r, 1, step);
    }
}

static void symmetric_load_keeps_the_cable_symmetric(void** state) {
    (void)state;
    for (int level = BT_KERNEL_V1; level <= BT_KERNEL_V4; ++level) {
        rope r;
        open_cable(&r, (bt_kernel_level)level);
        beat(&r, 30);
        double most = 0, height = 0;
        for (int i = 0, j = r.model.count - 1; i < j; ++i, --j) {
            most = fmax(most, fabs(r.state.x[i] - r.state.x[j]));
            most = fmax(most, fabs(r.state.y[i] + r.state.y[j]));
            most = fmax(most, fabs(r.state.z[i] - r.state.z[j]));
            height = fmax(height, r.state.z[i]);
        }
        print_message("level %s: left against right %.3g m, highest point %.3f m\n",
                      r.model.kernel.name, most, height);
        assert_true(most < 1e-9);
        rope_close(&r);
    }
}

static void same_bits_when_repeated_and_from_a_copy(void** state) {
    (void)state;
    rope a, b;
    open_cable(&a, BT_KERNEL_BEST);
    open_cable(&b, BT_KERNEL_BEST);
    bt_cable_state copy;
    assert_int_equal(bt_cable_state_init(&a.model, &copy, &a.arena), BT_OK);
    beat(&a, 5);
    bt_cable_state_copy(&a.model, &copy, &a.state);
    beat(&a, 12);
    beat(&b, 12);
    assert_memory_equal(a.state.block, b.state.block, a.state.block_size);
    bt_cable_state_copy(&a.model, &a.state, &copy);
    beat(&a, 12);
    assert_memory_equal(a.state.block, b.state.block, a.state.block_size);
    rope_close(&a);
    rope_close(&b);
}

static void kernel_levels_agree_to_rounding(void** state) {
    (void)state;
    rope a, b;
    open_cable(&a, BT_KERNEL_V1);
    for (int level = BT_KERNEL_V3; level <= BT_KERNEL_V4; ++level) {
        open_cable(&b, (bt_kernel_level)level);
        if (level == BT_KERNEL_V3)
            beat(&a, 10);
        beat(&b, 10);
        double most = 0;
        for (int i = 0; i < a.model.count; ++i)
            most =
                fmax(most, fabs(a.state.x[i] - b.state.x[i]) + fabs(a.state.y[i] - b.state.y[i]) +
                               fabs(a.state.z[i] - b.state.z[i]));
        print_message("level %s against v1 after 10 ms: %.3g m\n", b.model.kernel.name, most);
        assert_true(most < 1e-9);
        rope_close(&b);
    }
    rope_close(&a);
}

static void stable_step_is_stable_and_not_far_from_the_limit(void** state) {
    (void)state;
    for (int beyond = 0; beyond < 2; ++beyond) {
        rope r;
        open_cable(&r, BT_KERNEL_BEST);
        unsigned seed = 7;
        for (int i = 0; i < r.model.count; ++i) {
            r.state.vx[i] = 0.01 * noise(&seed);
            r.state.vy[i] = 0.01 * noise(&seed);
            r.state.vz[i] = 0.01 * noise(&seed);
        }
        rope_run(&r, 30000, (beyond ? 1.1 : 1.0) * r.model.stable_step_s);
        bool calm = bt_cable_is_finite(&r.model, &r.state);
        for (int i = 0; calm && i < r.model.count; ++i)
            calm = fabs(r.state.vy[i]) < 0.02;
        assert_true(calm == !beyond);
        double shortest = INFINITY;
        for (int i = 0; i < r.model.count; ++i)
            shortest = fmin(shortest, 2 * r.model.half_m[i]);
        const double courant = shortest / sqrt(5.1e7 / 5.536);
        if (!beyond) {
            print_message("stable step %.4g s, %.3f of the Courant step of the shortest segment\n",
                          r.model.stable_step_s, r.model.stable_step_s / courant);
            assert_true(r.model.stable_step_s > 0.9 * courant);
        }
        rope_close(&r);
    }
}

/// A tilted, swinging rope that bounces on a deck without loss: its energy is the same in the air
/// and while any part of it is pressed into the deck.
static void energy_on_a_deck_without_loss_is_kept(void** state) {
    (void)state;
    double drift[2];
    for (int k = 0; k < 2; ++k) {
        bt_cable_def def = rope_def(20, 2);
        def.gravity_mps2 = 9.80665;
        def.deck = true;
        def.deck_contact =
            (bt_cable_deck_params){.stiffness_Npm2 = 1e7, .restitution = 1, .slip_speed_mps = 0.1};
        def.end[0].anchor_m[2] = 0.03;
        def.end[1].anchor_m[2] = 0.23; /* one end lands first */
        rope r;
        rope_open(&r, &def, 2);
        for (int i = 0; i < 20; ++i)
            r.state.vz[i] = -2;
        const double step = (k ? 0.1 : 0.2) * r.model.stable_step_s;
        rope_run(&r, 1, step);
        bt_cable_energy e;
        bt_cable_audit(&r.model, &r.state, &e);
        const double start = total(&e);
        drift[k] = 0;
        double pressed = 0;
        while (r.state.scalars->time_s < 0.2) {
            rope_run(&r, 20, step);
            bt_cable_audit(&r.model, &r.state, &e);
            drift[k] = fmax(drift[k], fabs(total(&e) / start - 1));
            pressed = fmax(pressed, e.elastic_J / start);
        }
        assert_true(pressed > 0.05); /* the contact's energy matters */
        rope_close(&r);
    }
    print_message("energy on the deck: within %.2g, at half the step %.2g\n", drift[0], drift[1]);
    assert_true(drift[0] < 2e-3 && drift[1] < 0.5 * drift[0]);
}

/// Lengths that alternate, jump, or are random, with short ends and long ones: at the stable step
/// the energy of an undamped rope stays what it was.
static void stable_step_holds_on_uneven_meshes(void** state) {
    (void)state;
    enum { COUNT = 60, KINDS = 5 };
    for (int kind = 0; kind < KINDS; ++kind) {
        unsigned seed = 3;
        double length[COUNT], total_m = 0;
        for (int i = 0; i < COUNT; ++i) {
            length[i] = kind == 0   ? (i % 2 ? 0.05 : 0.3)
                        : kind == 1 ? (i % 2 ? 0.3 : 0.05)
                        : kind == 2 ? (i < COUNT / 2 ? 0.05 : 0.5)
                        : kind == 3 ? (i == 0 || i == COUNT - 1 ? 0.02 : 0.4)
                                    : 0.05 * pow(8, 0.5 + 0.5 * noise(&seed));
            total_m += length[i];
        }
        bt_cable_def def = rope_def(COUNT, 1);
        def.end[0].kind = def.end[1].kind = BT_CABLE_PINNED;
        def.end[1].anchor_m[1] = total_m * (1 + 5e-4);
        rope r;
        rope_open_mesh(&r, &def, length);
        for (int i = 0; i < COUNT; ++i) {
            r.state.vx[i] = 0.1 * noise(&seed);
            r.state.vy[i] = 0.1 * noise(&seed);
            r.state.vz[i] = 0.1 * noise(&seed);
        }
        bt_cable_energy e;
        rope_run(&r, 1, 0.999 * r.model.stable_step_s);
        bt_cable_audit(&r.model, &r.state, &e);
        const double start = total(&e);
        rope_run(&r, 20000, 0.999 * r.model.stable_step_s);
        bt_cable_audit(&r.model, &r.state, &e);
        assert_true(bt_cable_is_finite(&r.model, &r.state));
        // the leapfrog keeps an energy that differs from this one by the fastest modes' share,
        // which is largest where half of the rope is all of the shortest segments
        BT_ASSERT_NEAR(total(&e), start, kind == 2 ? 0.01 : 1e-4, 0);
        rope_close(&r);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(undamped_free_rope_keeps_its_energy),
        cmocka_unit_test(undamped_energy_is_bounded_at_the_stable_step),
        cmocka_unit_test(damped_energy_never_rises),
        cmocka_unit_test(free_rope_keeps_linear_and_angular_momentum),
        cmocka_unit_test(momentum_grows_by_the_external_impulse),
        cmocka_unit_test(step_is_of_second_order),
        cmocka_unit_test(torsional_frequency_of_a_clamped_rod),
        cmocka_unit_test(symmetric_load_keeps_the_cable_symmetric),
        cmocka_unit_test(same_bits_when_repeated_and_from_a_copy),
        cmocka_unit_test(kernel_levels_agree_to_rounding),
        cmocka_unit_test(stable_step_is_stable_and_not_far_from_the_limit),
        cmocka_unit_test(stable_step_holds_on_uneven_meshes),
        cmocka_unit_test(energy_on_a_deck_without_loss_is_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
