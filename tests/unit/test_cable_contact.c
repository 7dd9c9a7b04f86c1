#include "reference.h"

#include "landing/cable_contact.h"
#include "mechanics/vec.h"
#include "verify/test_cable_case.h"

/// A rope along y, 4 m long, its middle at the origin's x and a given height, at rest and straight,
/// with segments of 50 mm unless told otherwise.
static void lay(rope* r, int count, double length_m, double z_m) {
    bt_cable_def def = rope_def(count, length_m);
    def.end[0].anchor_m[1] = -0.5 * length_m;
    def.end[1].anchor_m[1] = 0.5 * length_m;
    def.end[0].anchor_m[2] = def.end[1].anchor_m[2] = z_m;
    rope_open(r, &def, length_m);
    bt_cable_clear_loads(&r->model, &r->state);
}

static bt_moving_body body_at(double x, double y, double z) {
    bt_moving_body body = {.position_m = {x, y, z}, .rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    bt_moving_body_to(&body, 0);
    return body;
}

/// Rotation by an angle about x after one about z: camber and yaw.
static void turn(bt_moving_body* body, double camber, double yaw) {
    const double c = cos(camber), s = sin(camber), cy = cos(yaw), sy = sin(yaw);
    const double rotation[9] = {cy, -sy * c, sy * s, sy, cy * c, -cy * s, 0, s, c};
    memcpy(body->rotation, rotation, sizeof rotation);
    bt_moving_body_to(body, 0);
}

/// The hook's body turned so that its shoe is level: shank 52 degrees below the horizontal.
static void hang(bt_moving_body* hook, double angle) {
    const double c = cos(angle), s = sin(angle);
    const double rotation[9] = {c, 0, -s, 0, 1, 0, s, 0, c};
    memcpy(hook->rotation, rotation, sizeof rotation);
    bt_moving_body_to(hook, 0);
}

/// Impulse and moment about the origin that the rope gets from the loads in its state.
static void rope_gets(const rope* r, double step_s, double impulse[3], double moment[3]) {
    const bt_cable_state* s = &r->state;
    for (int k = 0; k < 3; ++k)
        impulse[k] = moment[k] = 0;
    for (int i = 0; i < r->model.count; ++i) {
        const double p[3] = {s->x[i], s->y[i], s->z[i]}, f[3] = {s->fx[i], s->fy[i], s->fz[i]};
        const double m[3] = {s->mx[i], s->my[i], s->mz[i]};
        double turning[3];
        bt_cross(p, f, turning);
        for (int k = 0; k < 3; ++k) {
            impulse[k] += step_s * f[k];
            moment[k] += step_s * (turning[k] + m[k]);
        }
    }
}

static void assert_opposite(const rope* r, const bt_moving_body* body, double step_s) {
    double impulse[3], moment[3], about[3];
    rope_gets(r, step_s, impulse, moment);
    bt_cross(body->now_m, body->impulse_Ns, about);
    const double size = bt_norm(impulse), turning = bt_norm(moment) + size;
    assert_true(size > 0);
    for (int k = 0; k < 3; ++k) {
        BT_ASSERT_NEAR(body->impulse_Ns[k] + impulse[k], 0, 0, 1e-13 * size);
        BT_ASSERT_NEAR(body->moment_Nms[k] + about[k] + moment[k], 0, 0, 1e-13 * turning);
    }
}

/// Gives every segment a motion of its own, so that damping and friction act.
static void stir(rope* r) {
    for (int i = 0; i < r->model.count; ++i) {
        r->state.vx[i] = -3 + 0.7 * sin(i);
        r->state.vy[i] = 0.5 * cos(2 * i);
        r->state.vz[i] = -1 + 0.4 * sin(3 * i);
        r->state.wx[i] = 2 * sin(i);
        r->state.wz[i] = -1.5;
    }
}

/* ---- wheel ---- */

static bt_tyre main_tyre(void) {
    const bt_model_params model = reference_model(NULL, 0);
    bt_tyre tyre;
    bt_tyre_prepare(&model.aircraft.main_gear.tyre, &tyre);
    return tyre;
}

static bt_wheel_contact wheel_contact(const bt_tyre* tyre) {
    return (bt_wheel_contact){
        .tyre = tyre, .width_m = 0.292, .friction = 0.2, .slip_speed_mps = 0.2, .hint = -1};
}

static const double step_s = 1e-5;

/// What a wheel, or the hook, gives the rope at rest where it is: pressure and friction.
static void press_wheel(bt_wheel_contact* contact, rope* r, bt_moving_body* wheel) {
    bt_slides slides = {.count = 0};
    bt_wheel_contact_press(contact, &r->model, &r->state, wheel, &slides, step_s);
    bt_slides_resolve(&slides, &r->model, &r->state, step_s);
}

static void press_hook(bt_hook_contact* contact, rope* r, bt_moving_body* hook) {
    bt_slides slides = {.count = 0};
    bt_hook_contact_press(contact, &r->model, &r->state, hook, &slides, step_s);
    bt_slides_resolve(&slides, &r->model, &r->state, step_s);
}

static void a_wheel_and_the_cable_push_equally_and_oppositely(void** state) {
    (void)state;
    const bt_tyre tyre = main_tyre();
    static const double camber[] = {0, 0.1, -0.08}, yaw[] = {0, -0.06, 0.1};
    for (int k = 0; k < 3; ++k) {
        rope r;
        lay(&r, 80, 4, 1.0); // far above the deck, so that the deck has no part in it
        stir(&r);
        bt_wheel_contact contact = wheel_contact(&tyre);
        bt_moving_body wheel = body_at(-0.1, 0.317, 1.0 + tyre.radius - 0.04);
        wheel.velocity_mps[0] = 47.5;
        wheel.velocity_mps[2] = -3;
        wheel.spin_radps[1] = 60;
        turn(&wheel, camber[k], yaw[k]);
        press_wheel(&contact, &r, &wheel);
        assert_true(contact.normal_N > 0);
        assert_opposite(&r, &wheel, step_s);
        rope_close(&r);
    }
}

/// On the deck the wheel feels both: what the cable gives it, and what the deck gives more or less
/// than it would without the cable.
static void deck_and_cable_together_carry_the_load_of_the_curve(void** state) {
    (void)state;
    const bt_tyre tyre = main_tyre();
    for (double height = tyre.radius - 0.06; height < tyre.radius + 0.03; height += 0.01) {
        rope r;
        lay(&r, 80, 4, 0.01825);
        bt_wheel_contact contact = wheel_contact(&tyre);
        contact.friction = 0;
        bt_moving_body wheel = body_at(0, 0.2, height);
        press_wheel(&contact, &r, &wheel);

        const bt_bump bump = {
            .kind = BT_BUMP_CIRCLE, .u_m = 0, .w_m = 0.01825 - height, .size_m = r.model.radius_m};
        bt_envelope envelope;
        bt_tyre_envelope(&tyre, height, &bump, 1, &envelope);
        const double load = bt_tyre_load(&tyre, envelope.deflection_m);
        const double bare = bt_tyre_load(&tyre, fmax(0, tyre.radius - height));
        const double share = envelope.bump[0].area_m2 / envelope.all.area_m2;
        const double up = share * envelope.bump[0].g_w + (1 - share);
        BT_ASSERT_NEAR(bare + wheel.impulse_Ns[2] / step_s, load * up, 1e-12, 1e-9);
        BT_ASSERT_NEAR(contact.normal_N, load * share, 1e-12, 0);
        // straight under the axle nothing pushes fore or aft
        BT_ASSERT_NEAR(wheel.impulse_Ns[0] / step_s, 0, 0, 1e-9 * load);
        rope_close(&r);
    }
}

static void a_bump_ahead_of_the_axle_holds_the_wheel_back(void** state) {
    (void)state;
    const bt_tyre tyre = main_tyre();
    for (int side = -1; side <= 1; side += 2) {
        rope r;
        lay(&r, 80, 4, 0.05);
        bt_wheel_contact contact = wheel_contact(&tyre);
        contact.friction = 0;
        bt_moving_body wheel = body_at(-0.15 * side, 0, tyre.radius);
        press_wheel(&contact, &r, &wheel);
        assert_true(side * wheel.impulse_Ns[0] < 0);
        assert_true(wheel.impulse_Ns[2] > 0);
        rope_close(&r);
    }
}

/// Slices tile the width: on a straight rope the force does not know where the joints are.
static void the_wheels_force_is_the_same_wherever_the_joints_lie(void** state) {
    (void)state;
    const bt_tyre tyre = main_tyre();
    static const int counts[] = {27, 80, 333};
    double first = 0;
    for (int k = 0; k < 3; ++k) {
        rope r;
        lay(&r, counts[k], 4, 0.03);
        for (double y = -0.4; y < 0.4; y += 0.0371) {
            bt_wheel_contact contact = wheel_contact(&tyre);
            bt_moving_body wheel = body_at(-0.1, y, tyre.radius - 0.01);
            bt_cable_clear_loads(&r.model, &r.state);
            press_wheel(&contact, &r, &wheel);
            if (first == 0)
                first = contact.normal_N;
            BT_ASSERT_NEAR(contact.normal_N, first, 1e-12, 0);
        }
        rope_close(&r);
    }
    assert_true(first > 1e3);
}

/// A locked wheel drags with mu times what it presses, on segments as fine as one likes: beyond
/// BT_SLIDES_MAX slices they are resolved in groups.
static void a_locked_wheel_drags_the_rope_with_coulombs_force(void** state) {
    (void)state;
    const bt_tyre tyre = main_tyre();
    static const int counts[] = {80, 800, BT_CABLE_SEGMENTS_MAX};
    assert_true(0.292 / 4 * BT_CABLE_SEGMENTS_MAX > BT_SLIDES_MAX);
    for (int k = 0; k < 3; ++k) {
        rope r;
        lay(&r, counts[k], 4, 0.05);
        bt_wheel_contact contact = wheel_contact(&tyre);
        bt_moving_body wheel = body_at(0, 0.1, tyre.radius + 0.03);
        wheel.velocity_mps[0] = 47.5;
        bt_moving_body_to(&wheel, 0);
        press_wheel(&contact, &r, &wheel);
        // A segment that the tyre covers in part is pressed off its middle, turns within the step
        // and slides sideways: of segments of 50 mm by 8.2e-5 of the slip, with 0.32 of the
        // pressure on them. That much of the friction points sideways, and 0.32 * 8.2e-5^2 / 2 =
        // 1.1e-9 is lacking in the direction of travel.
        double friction_N = 0;
        for (int i = 0; i < r.model.count; ++i)
            friction_N += hypot(r.state.fx[i], r.state.fy[i]);
        BT_ASSERT_NEAR(friction_N, 0.2 * contact.normal_N, 1e-14, 0);
        BT_ASSERT_NEAR(wheel.impulse_Ns[0] / step_s, -0.2 * contact.normal_N, 1.2e-9, 0);
        assert_opposite(&r, &wheel, step_s);
        rope_close(&r);
    }
}

/* ---- hook ---- */

static bt_profile head(void) {
    const bt_model_params model = reference_model(NULL, 0);
    bt_profile profile;
    assert_int_equal(bt_profile_build(&model.aircraft.hook.profile, model.aircraft.hook.length_m,
                                      0.5 * model.deck.cable.diameter_m, "hook", &profile, NULL),
                     BT_OK);
    return profile;
}

static const double level = 52 * 3.14159265358979323846 / 180;

static bt_hook_contact hook_contact(const bt_profile* profile) {
    return (bt_hook_contact){.profile = profile,
                             .shoe_m = {-1.059, 0, 0},
                             .stiffness = 5e8,
                             .damping = 2e4,
                             .friction = 0.2,
                             .slip_speed_mps = 0.2,
                             .hint = -1};
}

/// Puts the hook's body so that a point of the head's frame lies at a world point.
static bt_moving_body hook_at(const bt_hook_contact* contact, double u, double w, double x,
                              double y, double z, double yaw) {
    bt_moving_body hook = body_at(0, 0, 0);
    hang(&hook, level);
    const double c = cos(yaw), s = sin(yaw);
    const double about_z[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
    double rotation[9] = {0};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                rotation[3 * i + j] += about_z[3 * i + k] * hook.rotation[3 * k + j];
    memcpy(hook.rotation, rotation, sizeof rotation);
    const double local[3] = {contact->shoe_m[0] + u, 0, contact->shoe_m[2] + w};
    double arm[3];
    bt_rotate(rotation, local, arm);
    hook.position_m[0] = x - arm[0];
    hook.position_m[1] = y - arm[1];
    hook.position_m[2] = z - arm[2];
    bt_moving_body_to(&hook, 0);
    return hook;
}

/// The rope pressed into the lip from ahead by a depth: the lip's centre that far behind it.
static bt_moving_body hook_behind(const bt_hook_contact* contact, double depth, double y, double z,
                                  double yaw) {
    const bt_profile* p = contact->profile;
    return hook_at(contact, p->lip[0], p->lip[1], -(p->lip_radius + 0.01825 - depth), y, z, yaw);
}

static void the_hook_and_the_cable_push_equally_and_oppositely(void** state) {
    (void)state;
    const bt_profile profile = head();
    for (double yaw = -0.2; yaw <= 0.21; yaw += 0.1) {
        rope r;
        lay(&r, 80, 4, 0.075);
        stir(&r);
        bt_hook_contact contact = hook_contact(&profile);
        bt_moving_body hook = hook_behind(&contact, 2e-3, 0.21, 0.077, yaw);
        hook.velocity_mps[0] = 47.5;
        hook.velocity_mps[2] = 1;
        hook.spin_radps[1] = -3;
        bt_moving_body_to(&hook, 0);
        press_hook(&contact, &r, &hook);
        assert_opposite(&r, &hook, step_s);
        rope_close(&r);
    }
}

static void stiffness_times_depth_times_width(void** state) {
    (void)state;
    const bt_profile profile = head();
    static const int counts[] = {27, 80, 333};
    for (int k = 0; k < 3; ++k) {
        rope r;
        lay(&r, counts[k], 4, 0.075);
        for (double y = -0.4; y < 0.4; y += 0.0371) {
            bt_hook_contact contact = hook_contact(&profile);
            contact.friction = contact.damping = 0;
            bt_moving_body hook = hook_behind(&contact, 2e-3, y, 0.075, 0);
            bt_cable_clear_loads(&r.model, &r.state);
            press_hook(&contact, &r, &hook);
            const double want = 5e8 * 2e-3 * 2 * profile.half_width;
            BT_ASSERT_NEAR(contact.zone_force_N[BT_ZONE_POINT], want, 1e-11, 0);
            BT_ASSERT_NEAR(hook.impulse_Ns[0] / step_s, -want, 1e-11, 0);
            BT_ASSERT_NEAR(hook.impulse_Ns[2] / step_s, 0, 0, 1e-9 * want);
            BT_ASSERT_NEAR(contact.lip_m[0], -(profile.lip_radius + 0.01825 - 2e-3), 1e-12, 0);
            BT_ASSERT_NEAR(contact.cable_m[2], 0.075, 1e-12, 0);
        }
        rope_close(&r);
    }
}

static void friction_is_its_share_of_the_normal_force_and_against_the_sliding(void** state) {
    (void)state;
    const bt_profile profile = head();
    for (int side = -1; side <= 1; side += 2) {
        rope r;
        lay(&r, 80, 4, 0.075);
        bt_hook_contact contact = hook_contact(&profile);
        contact.damping = 0;
        bt_moving_body hook = hook_behind(&contact, 2e-3, 0, 0.075, 0);
        hook.velocity_mps[2] = 5.0 * side;
        bt_moving_body_to(&hook, 0);
        press_hook(&contact, &r, &hook);
        const double normal = contact.zone_force_N[BT_ZONE_POINT];
        // at 25 times the slip speed the regularised friction is within 0.1 % of Coulomb's
        BT_ASSERT_NEAR(hook.impulse_Ns[2] / step_s, -0.2 * normal * side, 1e-3, 0);
        rope_close(&r);
    }
}

static void damping_never_pulls(void** state) {
    (void)state;
    const bt_profile profile = head();
    rope r;
    lay(&r, 80, 4, 0.075);
    bt_hook_contact contact = hook_contact(&profile);
    bt_moving_body hook = hook_behind(&contact, 2e-3, 0, 0.075, 0);
    hook.velocity_mps[0] = -100; // tears away
    bt_moving_body_to(&hook, 0);
    press_hook(&contact, &r, &hook);
    assert_true(bt_norm(hook.impulse_Ns) == 0);
    hook.velocity_mps[0] = 100;
    bt_moving_body_to(&hook, 0);
    press_hook(&contact, &r, &hook);
    BT_ASSERT_NEAR(contact.zone_force_N[BT_ZONE_POINT],
                   (5e8 * 2e-3 + 2e4 * 100) * 2 * profile.half_width, 1e-10, 0);
    rope_close(&r);
}

/// A kinked rope: when the hook slides sideways over its joints, no force jumps.
static void moving_sideways_over_joints_changes_the_force_gradually(void** state) {
    (void)state;
    const bt_profile profile = head();
    rope r;
    lay(&r, 80, 4, 0.075);
    for (int i = 0; i < r.model.count; ++i) // a zigzag of 1 mm, joint by joint
        r.state.x[i] += i % 2 ? 5e-4 : -5e-4;
    double before[3] = {0};
    double largest = 0, mean = 0;
    const double dy = 1e-5;
    for (int k = 0; k <= 10000; ++k) {
        bt_hook_contact contact = hook_contact(&profile);
        contact.damping = 0;
        bt_moving_body hook = hook_behind(&contact, 3e-3, -0.05 + k * dy, 0.076, 0.03);
        bt_cable_clear_loads(&r.model, &r.state);
        press_hook(&contact, &r, &hook);
        for (int i = 0; k > 0 && i < 3; ++i)
            largest = fmax(largest, fabs(hook.impulse_Ns[i] - before[i]) / step_s);
        memcpy(before, hook.impulse_Ns, sizeof before);
        mean += bt_norm(before) / step_s / 10001;
    }
    // a slice that leaves on one side and one that enters on the other: at most twice the force
    // per metre times the distance moved
    assert_true(mean > 1e5);
    assert_true(largest < 2 * (5e8 * 4e-3) * 1.05 * dy);
    rope_close(&r);
}

static void the_zone_is_the_part_that_touches(void** state) {
    (void)state;
    const bt_profile p = head();
    const double reach = 0.01825 - 2e-3, throat_radius = 0.0195;
    const struct {
        bt_zone zone;
        double u, w; ///< where the rope's centre lies in the head's frame
    } cases[] = {
        {BT_ZONE_SHOE, 0, p.shoe_radius + reach},
        {BT_ZONE_SHOE, -(p.shoe_radius + reach), 0},
        {BT_ZONE_POINT, p.lip[0], p.lip[1] - p.lip_radius - reach},
        {BT_ZONE_THROAT, p.throat[0] - (throat_radius - reach), p.throat[1]},
        {BT_ZONE_ARM, 0.4, -p.arm_radius - reach},
        {BT_ZONE_ARM, 0.4, p.arm_radius + reach},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        rope r;
        lay(&r, 80, 4, 0.5);
        bt_hook_contact contact = hook_contact(&p);
        bt_moving_body hook = hook_at(&contact, cases[k].u, cases[k].w, 0, 0.1, 0.5, 0);
        press_hook(&contact, &r, &hook);
        for (int zone = 0; zone < BT_ZONE_COUNT; ++zone)
            if (zone == (int)cases[k].zone)
                BT_ASSERT_NEAR(contact.zone_force_N[zone], 5e8 * 2e-3 * 2 * p.half_width, 1e-9, 0);
            else
                assert_true(contact.zone_force_N[zone] == 0);
        rope_close(&r);
    }
}

/* ---- what decides whether they are looked at ---- */

static void nothing_pushes_while_clearance_is_positive(void** state) {
    (void)state;
    const bt_profile profile = head();
    const bt_tyre tyre = main_tyre();
    rope r;
    lay(&r, 80, 4, 0.3);
    for (double gap = -3e-3; gap <= 0.3; gap += 1e-3) {
        bt_hook_contact contact = hook_contact(&profile);
        bt_moving_body hook = hook_behind(&contact, -gap, 0, 0.3, 0);
        const double clearance = bt_hook_clearance(&contact, &r.model, &r.state, &hook);
        if (gap < 0.1)
            BT_ASSERT_NEAR(clearance, gap, 0, 1e-12);
        bt_cable_clear_loads(&r.model, &r.state);
        press_hook(&contact, &r, &hook);
        assert_int_equal(bt_norm(hook.impulse_Ns) > 0, clearance < 0);

        bt_wheel_contact tread = wheel_contact(&tyre);
        bt_moving_body wheel = body_at(0, 0, 0.3 + 0.01825 + tyre.radius + gap);
        BT_ASSERT_NEAR(bt_wheel_clearance(&tread, &r.model, &r.state, &wheel), gap, 0, 1e-12);
        press_wheel(&tread, &r, &wheel);
        // in the last micrometre the narrow strips see nothing yet
        if (fabs(gap) > 1e-6)
            assert_int_equal(bt_norm(wheel.impulse_Ns) > 0, gap < 0);
    }
    bt_wheel_contact tread = wheel_contact(&tyre);
    const bt_moving_body beyond = body_at(0, 9, 0.4);
    assert_true(isinf(bt_wheel_clearance(&tread, &r.model, &r.state, &beyond)));
    rope_close(&r);
}

static void a_moving_body_follows_its_acceleration_and_spin(void** state) {
    (void)state;
    bt_moving_body body = body_at(1, 2, 3);
    memcpy(body.velocity_mps, (double[]){4, 5, 6}, sizeof body.velocity_mps);
    memcpy(body.acceleration_mps2, (double[]){-7, 8, 9}, sizeof body.acceleration_mps2);
    memcpy(body.spin_radps, (double[]){0, 0, 2}, sizeof body.spin_radps);
    bt_moving_body_to(&body, 0.01);
    BT_ASSERT_NEAR(body.now_m[0], 1 + 0.04 - 0.5 * 7e-4, 1e-15, 0);
    BT_ASSERT_NEAR(body.now_mps[1], 5.08, 1e-15, 0);
    BT_ASSERT_NEAR(body.now_rotation[3], 0.02, 1e-15, 0); // the x axis turns toward y
    bt_moving_body_to(&body, 0);
    BT_ASSERT_NEAR(body.now_m[2], 3, 0, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_wheel_and_the_cable_push_equally_and_oppositely),
        cmocka_unit_test(deck_and_cable_together_carry_the_load_of_the_curve),
        cmocka_unit_test(a_bump_ahead_of_the_axle_holds_the_wheel_back),
        cmocka_unit_test(the_wheels_force_is_the_same_wherever_the_joints_lie),
        cmocka_unit_test(a_locked_wheel_drags_the_rope_with_coulombs_force),
        cmocka_unit_test(the_hook_and_the_cable_push_equally_and_oppositely),
        cmocka_unit_test(stiffness_times_depth_times_width),
        cmocka_unit_test(friction_is_its_share_of_the_normal_force_and_against_the_sliding),
        cmocka_unit_test(damping_never_pulls),
        cmocka_unit_test(moving_sideways_over_joints_changes_the_force_gradually),
        cmocka_unit_test(the_zone_is_the_part_that_touches),
        cmocka_unit_test(nothing_pushes_while_clearance_is_positive),
        cmocka_unit_test(a_moving_body_follows_its_acceleration_and_spin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
