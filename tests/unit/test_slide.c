/// Friction of bodies on the cable: what it takes away in one step, seen from the motion before and
/// after.
#include "cable/slide.h"
#include "mechanics/vec.h"
#include "verify/test_cable_case.h"

enum { COUNT = 20, MOST = 4 };
static const double step_s = 1.2e-5;

/// Repeatable numbers in -1 .. 1.
static double noise(unsigned* seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(int)*seed / 2147483648.0;
}

/// A rope that lies on a deck, pressed into it here and there, stretched, bent, and in motion.
static void stir(rope* r, unsigned seed) {
    bt_cable_def def = rope_def(COUNT, 1);
    def.gravity_mps2 = 9.80665;
    def.deck = true;
    def.deck_contact = (bt_cable_deck_params){
        .stiffness_Npm2 = 5e8, .restitution = 0.3, .friction = 0.3, .slip_speed_mps = 0.1};
    def.end[0].anchor_m[2] = def.end[1].anchor_m[2] = 0.01825;
    rope_open(r, &def, 1);
    bt_cable_state* s = &r->state;
    for (int i = 0; i < COUNT; ++i) {
        s->x[i] += 1e-5 * noise(&seed);
        s->y[i] += 1e-5 * noise(&seed);
        s->z[i] += 1e-5 * noise(&seed);
        s->vx[i] = 2 * noise(&seed);
        s->vy[i] = 0.3 * noise(&seed);
        s->vz[i] = noise(&seed);
        const double a = r->model.inverse_tilt[i], spin = a + r->model.inverse_spin[i];
        s->wx[i] = 5 * noise(&seed);
        s->wy[i] = 80 * noise(&seed);
        s->wz[i] = 5 * noise(&seed);
        s->hx[i] = s->wx[i] / a;
        s->hy[i] = s->wy[i] / spin;
        s->hz[i] = s->wz[i] / a;
    }
    s->scalars->last_step_s = step_s;
}

/// A contact at a random place of the segment's surface.
static bt_cable_slide contact(const rope* r, int segment, unsigned* seed) {
    const double angle = 3.2 * noise(seed), c = cos(angle), s = sin(angle);
    return (bt_cable_slide){
        .segment = segment,
        .point_m = {r->state.x[segment] - r->model.radius_m * c,
                    r->state.y[segment] + r->model.half_m[segment] * noise(seed),
                    r->state.z[segment] - r->model.radius_m * s},
        .normal = {c, 0, s},
        .other_mps = {2 * noise(seed), noise(seed), 2 * noise(seed)},
        .limit_N = exp(6 + 5 * noise(seed)),
        .slip_speed_mps = exp(-3 + 3 * noise(seed)),
    };
}

/// Slip at a contact with the state's velocities.
static void slip_now(const bt_cable_state* s, const bt_cable_slide* c, const double centre[3],
                     double slip[3]) {
    const int i = c->segment;
    const double arm[3] = {c->point_m[0] - centre[0], c->point_m[1] - centre[1],
                           c->point_m[2] - centre[2]};
    bt_cross((double[]){s->wx[i], s->wy[i], s->wz[i]}, arm, slip);
    bt_add_scaled(slip, 1, (double[]){s->vx[i], s->vy[i], s->vz[i]});
    bt_add_scaled(slip, -1, c->other_mps);
    bt_add_scaled(slip, -bt_dot(slip, c->normal), c->normal);
}

/// One step with `count` contacts on segment 7 and one on segment 12; what it returns, and the work
/// found from the slips before and after.
static void step(unsigned seed, int count, double* returned_J, double* found_J, double* least_N) {
    rope r;
    stir(&r, seed);
    bt_cable_slide slides[MOST + 1];
    double centre[MOST + 1][3], before[MOST + 1][3];
    for (int k = 0; k <= count; ++k) {
        const int i = k == 1 ? 12 : 7;
        slides[k] = contact(&r, i, &seed);
        memcpy(centre[k], (double[]){r.state.x[i], r.state.y[i], r.state.z[i]}, sizeof centre[k]);
        slip_now(&r.state, &slides[k], centre[k], before[k]);
    }
    bt_cable_clear_loads(&r.model, &r.state);
    bt_cable_forces(&r.model, &r.state);
    *returned_J = bt_cable_slides(&r.model, &r.state, step_s, slides, count + 1);
    bt_cable_advance(&r.model, &r.state, step_s);
    *found_J = 0;
    *least_N = INFINITY;
    for (int k = 0; k <= count; ++k) {
        double after[3];
        slip_now(&r.state, &slides[k], centre[k], after);
        bt_add_scaled(after, 1, before[k]);
        *found_J += 0.5 * step_s * bt_dot(slides[k].force_N, after);
        *least_N = fmin(*least_N, bt_norm(slides[k].force_N));
        assert_true(bt_norm(slides[k].force_N) <= slides[k].limit_N * (1 + 1e-12));
        assert_true(fabs(bt_dot(slides[k].force_N, slides[k].normal)) <
                    1e-12 * slides[k].limit_N + 1e-12);
    }
    rope_close(&r);
}

/// Whatever joints, deck and the other contacts do meanwhile.
static void it_only_takes_energy_however_many_share_a_segment(void** state) {
    (void)state;
    for (unsigned seed = 1; seed <= 4000; ++seed) {
        double returned_J, found_J, least_N;
        step(seed, 1 + (int)(seed % MOST), &returned_J, &found_J, &least_N);
        assert_true(returned_J < 0);
        assert_true(least_N > 0);
        // the axis turns during the step; that is what they may differ by
        BT_ASSERT_NEAR(found_J, returned_J, 5e-3, 1e-9);
        assert_true(found_J < 0);
    }
}

/// A rope that rolls on what touches it does not slip there.
static void a_rolling_rope_does_not_slip(void** state) {
    (void)state;
    bt_cable_def def = rope_def(2, 0.1);
    rope r;
    rope_open(&r, &def, 0.1);
    const double spin_radps = 100, speed = r.model.radius_m * spin_radps;
    for (int i = 0; i < 2; ++i) {
        r.state.vx[i] = speed;
        r.state.wy[i] = spin_radps;
        r.state.hy[i] = spin_radps / (r.model.inverse_spin[i] + r.model.inverse_tilt[i]);
    }
    // on what lies still below, and under what moves twice as fast above
    for (int side = -1; side <= 1; side += 2) {
        bt_cable_slide slide = {.point_m = {0, r.state.y[0], side * r.model.radius_m},
                                .normal = {0, 0, 1},
                                .other_mps = {side > 0 ? 2 * speed : 0, 0, 0},
                                .limit_N = 1e4,
                                .slip_speed_mps = 0.1};
        bt_cable_forces(&r.model, &r.state);
        assert_true(fabs(bt_cable_slides(&r.model, &r.state, step_s, &slide, 1)) < 1e-20);
        BT_ASSERT_NEAR(bt_norm(slide.force_N), 0, 0, 1e-8);
    }
    rope_close(&r);
}

/// Pressed hard, it loses half its slip of a step, by the mass that answers there: across the rope
/// 1/m + r^2/I of a cylinder that may roll, along it 1/m + r^2/I of one that may tilt.
static void more_than_half_the_slip_is_never_stopped_in_a_step(void** state) {
    (void)state;
    for (int along = 0; along < 2; ++along) {
        bt_cable_def def = rope_def(2, 0.1);
        rope r;
        rope_open(&r, &def, 0.1);
        r.state.scalars->last_step_s = step_s;
        const double radius = r.model.radius_m, mass = r.model.mass_kg[0];
        const double inertia = along ? 1 / r.model.inverse_tilt[0] : 0.5 * mass * radius * radius;
        r.state.vx[0] = along ? 0 : 3;
        r.state.vy[0] = along ? 3 : 0;
        bt_cable_slide slide = {.point_m = {0, r.state.y[0], -radius},
                                .normal = {0, 0, 1},
                                .limit_N = 1e9,
                                .slip_speed_mps = 0.1};
        bt_cable_forces(&r.model, &r.state);
        bt_cable_slides(&r.model, &r.state, step_s, &slide, 1);
        const double want = 3 / (step_s * (1 / mass + radius * radius / inertia));
        BT_ASSERT_NEAR(slide.force_N[along], -want, 1e-12, 0);
        rope_close(&r);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_only_takes_energy_however_many_share_a_segment),
        cmocka_unit_test(a_rolling_rope_does_not_slip),
        cmocka_unit_test(more_than_half_the_slip_is_never_stopped_in_a_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
