/// The cable seen from a frame that accelerates or turns, beside what an inertial frame tells of
/// it.
#include "test_cable_case.h"

#include "mechanics/vec.h"

static const double spin[3] = {0.6, -0.9, 1.3};

static void place_of(const rope* r, int i, double at[3]) {
    at[0] = r->state.x[i];
    at[1] = r->state.y[i];
    at[2] = r->state.z[i];
}

static void a_free_rope_falls_as_one(void** state) {
    (void)state;
    static const double g[3] = {0.8, -0.5, -11};
    bt_cable_def def = rope_def(20, 4);
    rope r;
    rope_open(&r, &def, 4);
    memcpy(r.state.scalars->frame.gravity_mps2, g, sizeof g);
    double start[20][3], at[3];
    for (int i = 0; i < 20; ++i)
        place_of(&r, i, start[i]);
    rope_run(&r, 1000, 2e-5);
    for (int i = 0; i < 20; ++i) {
        place_of(&r, i, at);
        for (int k = 0; k < 3; ++k)
            BT_ASSERT_NEAR(at[k] - start[i][k], 0.5 * g[k] * 0.02 * 0.02, 0, 1e-13);
    }
    rope_close(&r);
}

/// Lays the rope at rest in the inertial frame: seen from the one that turns it turns back.
static void rest_in_the_inertial_frame(rope* r) {
    bt_cable_state* s = &r->state;
    memcpy(s->scalars->frame.spin_radps, spin, sizeof spin);
    for (int i = 0; i < r->model.count; ++i) {
        double at[3], carried[3];
        place_of(r, i, at);
        bt_cross(spin, at, carried);
        s->vx[i] = -carried[0];
        s->vy[i] = -carried[1];
        s->vz[i] = -carried[2];
        s->wx[i] = -spin[0];
        s->wy[i] = -spin[1];
        s->wz[i] = -spin[2];
        const double across = 1 / r->model.inverse_tilt[i]; // the rope lies along y
        s->hx[i] = -across * spin[0];
        s->hy[i] = -spin[1] / (r->model.inverse_spin[i] + r->model.inverse_tilt[i]);
        s->hz[i] = -across * spin[2];
    }
}

/// Largest distance of a segment's place (m) or axis from the closed form after half a second.
static double error_after(rope* r, int steps) {
    double start[20][3], most = 0;
    for (int i = 0; i < 20; ++i)
        place_of(r, i, start[i]);
    rest_in_the_inertial_frame(r);
    rope_run(r, steps, 0.5 / steps);
    const double back[3] = {-0.5 * spin[0], -0.5 * spin[1], -0.5 * spin[2]};
    double e[4], a[9];
    bt_euler_from_vector(back, e);
    bt_rotation_from_euler(e, a);
    for (int i = 0; i < 20; ++i) {
        double at[3], want[3];
        place_of(r, i, at);
        bt_rotate(a, start[i], want);
        for (int k = 0; k < 3; ++k)
            most = fmax(most, fabs(at[k] - want[k]));
        const double axis[3] = {r->state.tx[i], r->state.ty[i], r->state.tz[i]};
        for (int k = 0; k < 3; ++k)
            most = fmax(most, fabs(axis[k] - a[3 * k + 1]));
    }
    return most;
}

static void a_rope_at_rest_turns_back_in_a_frame_that_turns(void** state) {
    (void)state;
    double error[2];
    for (int k = 0; k < 2; ++k) {
        bt_cable_def def = rope_def(20, 4);
        rope r;
        rope_open(&r, &def, 4);
        error[k] = error_after(&r, 12500 << k);
        bt_cable_energy energy;
        bt_cable_audit(&r.model, &r.state, &energy);
        // kinetic energy as seen and centrifugal potential: together the energy at rest
        assert_true(energy.kinetic_J > 50);
        BT_ASSERT_NEAR(energy.kinetic_J + energy.gravity_J + energy.elastic_J, 0, 0,
                       1e-8 * energy.kinetic_J);
        rope_close(&r);
    }
    assert_true(error[0] < 2e-9);
    BT_ASSERT_NEAR(error[0] / error[1], 4, 0.1, 0);
}

/// A rope that whirls about its pinned end carries the centrifugal force of all that lies beyond.
static void a_whirling_rope_pulls_by_what_lies_beyond(void** state) {
    (void)state;
    enum { COUNT = 20 };
    const double turning = 20;
    bt_cable_def def = rope_def(COUNT, 10);
    def.end[0].kind = BT_CABLE_PINNED;
    rope r;
    rope_open(&r, &def, 10);
    r.state.scalars->frame.spin_radps[0] = turning;
    assert_int_equal(bt_cable_equilibrium(&r.model, &r.state, NULL, NULL), BT_OK);
    double beyond = 0;
    for (int j = COUNT - 1; j >= 0; --j) {
        beyond += r.model.mass_kg[j] * turning * turning * r.state.y[j];
        BT_ASSERT_NEAR(bt_cable_tension(&r.model, &r.state, j), beyond, 0, 1e-3);
    }
    // of the whole: mass per length times W^2 L^2 / 2, a little more because the rope stretches
    BT_ASSERT_NEAR(beyond, 0.5 * 5.536 * 400 * 100, 3e-3, 0);
    rope_close(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_free_rope_falls_as_one),
        cmocka_unit_test(a_rope_at_rest_turns_back_in_a_frame_that_turns),
        cmocka_unit_test(a_whirling_rope_pulls_by_what_lies_beyond),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
