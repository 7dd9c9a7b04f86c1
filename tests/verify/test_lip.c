/// The lip criterion: a piece of rope that is held back by a steady force is pushed slowly by the
/// hook's head. It is scooped when its centre lies above the lip's and goes under when it lies
/// below, with or without friction: it rolls. And the impact of a rope that slides on the lip.
#include "reference.h"

#include "landing/cable_contact.h"
#include "mechanics/vec.h"
#include "tables.h"
#include "test_cable_case.h"

static const double level = 52 * 3.14159265358979323846 / 180;

static const double radius_m = 0.01825, slip_mps = 1e-3, step_s = 1e-5;
enum { steps = 200000 };

typedef enum where { UNDER = -1, HELD = 0, SCOOPED = 1 } where;

/// The head with its shoe level; its lowest point hook_m above the deck.
static bt_moving_body hook_over(const bt_hook_contact* contact, double x, double hook_m) {
    const double c = cos(level), s = sin(level);
    bt_moving_body hook = {.rotation = {c, 0, -s, 0, 1, 0, s, 0, c}};
    double arm[3];
    bt_rotate(hook.rotation, contact->shoe_m, arm);
    hook.position_m[0] = x - arm[0];
    hook.position_m[2] = hook_m + contact->profile->shoe_radius - arm[2];
    bt_moving_body_to(&hook, 0);
    return hook;
}

/// World point of the lip's centre.
static void lip_centre(const bt_hook_contact* contact, const bt_moving_body* hook, double at[3]) {
    const double local[3] = {contact->shoe_m[0] + contact->profile->lip[0], 0,
                             contact->profile->lip[1]};
    bt_rotate(hook->rotation, local, at);
    bt_add_scaled(at, 1, hook->position_m);
}

/// A piece of rope does not tilt here, the rest of the rope is long and holds it; but it spins.
static void hold_axis(rope* r) {
    for (int i = 0; i < r->model.count; ++i) {
        bt_cable_state* s = &r->state;
        s->hx[i] = s->hz[i] = s->wx[i] = s->wz[i] = 0;
        const double size = hypot(s->e0[i], s->e2[i]);
        s->e0[i] /= size;
        s->e2[i] /= size;
        s->e1[i] = s->e3[i] = s->tx[i] = s->tz[i] = 0;
        s->ty[i] = 1;
    }
}

/// One step of rope and hook.
static void step(rope* r, bt_hook_contact* contact, bt_moving_body* hook) {
    static bt_slides slides;
    bt_cable_forces(&r->model, &r->state);
    bt_hook_contact_press(contact, &r->model, &r->state, hook, &slides, step_s);
    bt_slides_resolve(&slides, &r->model, &r->state, step_s);
    bt_cable_advance(&r->model, &r->state, step_s);
    hold_axis(r);
}

/// Two pieces of rope, 0.1 m together, around y = 0.
static void lay(rope* r, double x_m, double z_m) {
    bt_cable_def def = rope_def(2, 0.1);
    for (int k = 0; k < 2; ++k) {
        def.end[k].anchor_m[0] = x_m;
        def.end[k].anchor_m[1] = k ? 0.05 : -0.05;
        def.end[k].anchor_m[2] = z_m;
    }
    rope_open(r, &def, 0.1);
}

/// Pushes a rope whose centre is cable_m above the deck with a hook whose lowest point is hook_m
/// above it.
static where push(const bt_hook_profile_params* head, double friction, double hook_m,
                  double cable_m) {
    static const double hold_N = 2, drag = 2, speed = 0.02;
    bt_profile profile;
    assert_int_equal(bt_profile_build(head, 2.352, 0.01825, "head", &profile, NULL), BT_OK);
    rope r;
    lay(&r, 0, cable_m);
    bt_hook_contact contact = {.profile = &profile,
                               .shoe_m = {-1.059, 0, 0},
                               .stiffness = 5e8,
                               .damping = 2e4,
                               .friction = friction,
                               .slip_speed_mps = slip_mps,
                               .hint = -1};
    bt_moving_body hook = hook_over(&contact, 0, hook_m);
    // the lip close behind the rope
    double lip[3];
    lip_centre(&contact, &hook, lip);
    const double rise = lip[2] - cable_m;
    const double reach = profile.lip_radius + radius_m;
    const double behind = fabs(rise) < reach ? sqrt(reach * reach - rise * rise) : 0;
    hook = hook_over(&contact, -behind - 1e-5 - lip[0], hook_m);
    hook.velocity_mps[0] = speed;

    where end = HELD;
    for (int k = 0; k < steps && end == HELD; ++k) {
        bt_moving_body_to(&hook, k * step_s);
        bt_cable_clear_loads(&r.model, &r.state);
        for (int i = 0; i < 2; ++i) {
            const double at[3] = {r.state.x[i], r.state.y[i], r.state.z[i]};
            const double force[3] = {-0.5 * (hold_N + drag * r.state.vx[i]), 0,
                                     -0.5 * drag * r.state.vz[i]};
            bt_cable_add_load(&r.state, i, force, at);
        }
        step(&r, &contact, &hook);
        const double above = r.state.z[0] - contact.lip_m[2];
        end = above > 0.9 * reach ? SCOOPED : above < -0.9 * reach ? UNDER : HELD;
    }
    rope_close(&r);
    return end;
}

static bt_hook_profile_params head_with_lip(double lip_height_m) {
    bt_hook_profile_params head;
    bt_group_set_defaults(&bt_hook_profile_group, &head);
    head.lip_height_m = lip_height_m;
    if (lip_height_m > 0.031) { // keep mouth and shoe as they were
        head.point_ahead_m = 0.058;
        head.lip_radius_m = 0.012;
    }
    return head;
}

/// Half a millimetre above or below is enough, whatever the friction.
static void it_is_scooped_when_the_lip_lies_below_its_centre(void** state) {
    (void)state;
    static const double lips[] = {0.024, 0.030, 0.034}, cables[] = {0.0185, 0.050, 0.075},
                        frictions[] = {0, 0.1, 0.2, 0.4};
    for (int l = 0; l < 3; ++l)
        for (int c = 0; c < 3; ++c)
            for (int f = 0; f < 4; ++f)
                for (int side = -1; side <= 1; side += 2) {
                    const bt_hook_profile_params head = head_with_lip(lips[l]);
                    const double hook_m = cables[c] - lips[l] - side * 5e-4;
                    assert_int_equal(push(&head, frictions[f], hook_m, cables[c]),
                                     side > 0 ? SCOOPED : UNDER);
                }
}

/* ---- at landing speed ---- */

/// Drives the head level through the middle of the arresting cable at rest, its lip below the
/// cable's centre by rise_m.
static where drive(double friction, double rise_m) {
    static const double speed_mps = 47.5, far_m = 0.3;
    static double segment_m[BT_CABLE_SEGMENTS_MAX];
    static bt_slides slides;
    const bt_model_params model = reference_model(NULL, 0);
    const bt_hook_profile_params* head = &model.aircraft.hook.profile;
    bt_cable_def def;
    rope r;
    bt_cable_def_init(&def, &model.deck.cable, model.deck.gravity_mps2, segment_m);
    rope_open_mesh(&r, &def, segment_m);
    assert_int_equal(bt_cable_equilibrium(&r.model, &r.state, NULL, NULL), BT_OK);
    double middle[3];
    assert_true(bt_cable_centreline(&r.model, &r.state, 0, -1, middle, NULL, NULL) >= 0);

    bt_profile profile;
    assert_int_equal(bt_profile_build(head, 2.352, radius_m, "head", &profile, NULL), BT_OK);
    bt_hook_contact contact = {.profile = &profile,
                               .shoe_m = {-1.059, 0, 0},
                               .stiffness = 5e8,
                               .damping = 2e4,
                               .friction = friction,
                               .slip_speed_mps = 0.1,
                               .hint = -1};
    bt_moving_body hook = hook_over(&contact, 0, middle[2] - rise_m - head->lip_height_m);
    double lip[3];
    lip_centre(&contact, &hook, lip);
    BT_ASSERT_NEAR(middle[2] - lip[2], rise_m, 0, 1e-9);
    hook.position_m[0] -= lip[0] + 0.03;
    hook.velocity_mps[0] = speed_mps;

    where end = HELD;
    for (double t = 0; end == HELD; t += step_s) {
        assert_true(speed_mps * t < 10 * far_m);
        bt_moving_body_to(&hook, t);
        bt_cable_clear_loads(&r.model, &r.state);
        bt_cable_forces(&r.model, &r.state);
        bt_hook_contact_press(&contact, &r.model, &r.state, &hook, &slides, step_s);
        bt_slides_resolve(&slides, &r.model, &r.state, step_s);
        bt_cable_advance(&r.model, &r.state, step_s);
        if (contact.lip_m[0] > contact.cable_m[0])
            end = contact.cable_m[2] > contact.lip_m[2] ? SCOOPED : UNDER;
    }
    rope_close(&r);
    return end;
}

/// The rope flies ahead of the lip, comes back and is carried, and rolls off on the side on which
/// it was met.
static void at_landing_speed_too_the_centres_decide(void** state) {
    (void)state;
    static const double frictions[] = {0, 0.1, 0.2, 0.4};
    for (int f = 0; f < 4; ++f) {
        double under = -5e-3, scooped = 5e-3;
        while (scooped - under > 1e-5) {
            const double rise = 0.5 * (under + scooped);
            if (drive(frictions[f], rise) == SCOOPED)
                scooped = rise;
            else
                under = rise;
        }
        char text[80];
        snprintf(text, sizeof text, "height of rope over lip where it is scooped, mu %g, m",
                 frictions[f]);
        BT_VERIFY("lip criterion", text, scooped, 0, 1e-4, "level centres");
    }
}

/* ---- from sliding to rolling ---- */

/// A free rope thrown at the lip, half along it: friction stops the slip within the impact and
/// makes it roll. A solid cylinder keeps 1 / (1 + I / m r^2) = 2/3 of its speed along the surface,
/// and its spin is that speed over its radius; with a friction that the impact does not develop
/// fully it keeps more, by mu times the change of speed across.
static void thrown_along_the_lip_it_keeps_two_thirds(void** state) {
    (void)state;
    static const double frictions[] = {0, 0.02, 0.3, 1}, along = 0.3, across = 0.5;
    bt_profile profile;
    const bt_hook_profile_params head = head_with_lip(0.030);
    assert_int_equal(bt_profile_build(&head, 2.352, radius_m, "head", &profile, NULL), BT_OK);
    for (int f = 0; f < 4; ++f) {
        bt_hook_contact contact = {.profile = &profile,
                                   .shoe_m = {-1.059, 0, 0},
                                   .stiffness = 5e8,
                                   .damping = 2e4,
                                   .friction = frictions[f],
                                   .slip_speed_mps = slip_mps,
                                   .hint = -1};
        bt_moving_body hook = hook_over(&contact, 0, 0.3);
        double lip[3];
        lip_centre(&contact, &hook, lip);
        const double reach = profile.lip_radius + radius_m;
        rope r;
        lay(&r, lip[0] + reach + 1e-5, lip[2]);
        for (int i = 0; i < 2; ++i) {
            r.state.vx[i] = -across;
            r.state.vz[i] = along;
        }
        bool touched = false;
        do {
            bt_cable_clear_loads(&r.model, &r.state);
            step(&r, &contact, &hook);
            touched |= contact.zone_force_N[BT_ZONE_POINT] > 0;
        } while (!touched || contact.zone_force_N[BT_ZONE_POINT] > 0);
        // in polar coordinates about the lip's centre, at the radius of the touch
        const double x = r.state.x[0] - lip[0], z = r.state.z[0] - lip[2], apart = hypot(x, z);
        const double left = (x * r.state.vz[0] - z * r.state.vx[0]) / reach;
        const double bounced = (x * r.state.vx[0] + z * r.state.vz[0]) / apart;
        const double coulomb = along - frictions[f] * (across + bounced);
        char text[80];
        snprintf(text, sizeof text, "speed along the lip after over before, mu %g", frictions[f]);
        BT_VERIFY("rope thrown on the lip", text, left / along, fmax(coulomb / along, 2.0 / 3),
                  3e-3, "sliding or rolling cylinder");
        snprintf(text, sizeof text, "spin times radius over the speed lost, mu %g", frictions[f]);
        if (frictions[f] > 0)
            BT_VERIFY("rope thrown on the lip", text,
                      radius_m * fabs(r.state.wy[0]) / (along - left), 2, 0.03,
                      "m r^2 over I of a solid cylinder");
        rope_close(&r);
    }
}

/* ---- direct or by the arm ---- */

/// What a rope touches first that comes level from ahead, `rise` above the lip, the shoe level; and
/// how far up the arm from the line opposite the lip (negative: inside the mouth).
static bt_zone first_touch(const bt_hook_profile_params* head, double rise_m, double* beyond_m) {
    bt_profile profile;
    assert_int_equal(bt_profile_build(head, 2.352, 0.01825, "head", &profile, NULL), BT_OK);
    const double c = cos(head->head_angle_rad), s = sin(head->head_angle_rad);
    const double z = profile.lip[0] * s + profile.lip[1] * c + rise_m;
    bt_nearest near = {.zone = BT_ZONE_COUNT};
    double u = 0;
    for (double x = 0.4; near.zone == BT_ZONE_COUNT && x > -0.4; x -= 1e-5) {
        u = x * c + z * s;
        const bt_nearest at = bt_profile_nearest(&profile, u, -x * s + z * c);
        if (at.distance_m < 0.01825)
            near = at;
    }
    *beyond_m = u - profile.lip[0];
    if (getenv("BT_CURVES"))
        printf("touch %.6f %.6f %.6f %s\n", (u - z * s) / c, z + profile.shoe_radius, rise_m,
               bt_zone_name(near.zone));
    return near.zone;
}

/// Points for the figure of docs/theory/hook_on_cable.md (scripts/cable_figures.sh): the outline,
/// in the deck's axes from the centre of the shoe arc, piece by piece with its zone.
static void print_outline(const bt_hook_profile_params* head) {
    bt_profile profile;
    if (!getenv("BT_CURVES") ||
        bt_profile_build(head, 0.2, 0.01825, "head", &profile, NULL) != BT_OK)
        return;
    const double c = cos(head->head_angle_rad), s = sin(head->head_angle_rad);
    for (int i = 0; i < BT_PIECE_COUNT; ++i) {
        const bt_piece* p = &profile.pieces[i];
        for (int k = 0; k <= 40; ++k) {
            const double f = k / 40.0, angle = p->from + f * (p->to - p->from);
            const double u = p->arc ? p->centre[0] + p->radius * cos(angle)
                                    : p->start[0] + f * (p->end[0] - p->start[0]);
            const double w = p->arc ? p->centre[1] + p->radius * sin(angle)
                                    : p->start[1] + f * (p->end[1] - p->start[1]);
            printf("outline %s %.6f %.6f\n", bt_zone_name(p->zone), u * c - w * s,
                   u * s + w * c + profile.shoe_radius);
        }
        printf("outline gap\n");
    }
}

/// The head of the defaults, 52 degrees below the horizontal: what comes in clear of the lip lands
/// on the arm, outside the mouth; what comes in lower meets the lip first. So its catches are by
/// the arm. A mouth that faces the cable, 25 degrees below the horizontal, lets it straight into
/// the throat.
static void a_steep_head_catches_by_the_arm_and_a_facing_one_directly(void** state) {
    (void)state;
    const bt_hook_profile_params usual = head_with_lip(0.030), *head = &usual;
    print_outline(head);
    const bt_model_params facing = REFERENCE(
        "aircraft.hook.profile.head_angle=25 deg", "aircraft.hook.profile.point_ahead=100 mm",
        "aircraft.hook.profile.lip_radius=12 mm", "aircraft.hook.profile.shoe_radius=100 mm",
        "aircraft.hook.profile.throat_radius=30 mm", "aircraft.hook.profile.throat_length=30 mm",
        "aircraft.hook.profile.lip_height=40 mm");
    const double clear = 0.01825 + head->lip_radius_m;
    double beyond = 0, least = INFINITY;
    for (double rise = 1e-3; rise < 0.08; rise += 1e-3) {
        const bt_zone zone = first_touch(head, rise, &beyond);
        assert_int_equal(zone, rise < clear ? BT_ZONE_POINT : BT_ZONE_ARM);
        if (zone == BT_ZONE_ARM)
            least = fmin(least, beyond);
    }
    BT_TABLE_ROW("hook on cable",
                 "head of the defaults: first touch up the arm from the mouth, least, m", least,
                 0.0, least, "outline: never direct without touching the lip");
    assert_true(least > 0);
    const bt_hook_profile_params* open = &facing.aircraft.hook.profile;
    const double rise = 0.01825 + open->lip_radius_m + 1e-3;
    assert_int_equal(first_touch(open, rise, &beyond), BT_ZONE_THROAT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_scooped_when_the_lip_lies_below_its_centre),
        cmocka_unit_test(at_landing_speed_too_the_centres_decide),
        cmocka_unit_test(thrown_along_the_lip_it_keeps_two_thirds),
        cmocka_unit_test(a_steep_head_catches_by_the_arm_and_a_facing_one_directly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
