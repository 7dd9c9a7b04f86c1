#include "reference.h"

#include "elements/hook_damper_element.h"
#include "elements/strut.h"
#include "landing/airframe.h"
#include "mechanics/vec.h"

/// An airframe with a state, in the glide of a landing.
typedef struct rig {
    bt_model_params model;
    bt_airframe airframe;
    bt_arena arena;
    bt_state hanging, state;
    bt_glide glide;
} rig;

/// High above the deck; what the aircraft's centre of gravity was placed at is kept in glide.
static const double up_m = 10;

static void place(rig* r) {
    const double up[3] = {0, 0, up_m};
    bt_failure failure;
    bt_airframe_place(&r->airframe, &r->model.landing, &r->hanging, &r->state, &r->glide);
    bt_airframe_move(&r->airframe, up, &r->state);
    assert_int_equal(bt_system_evaluate(r->airframe.system, &r->state, &failure), BT_OK);
}

static void rig_open(rig* r, bt_model_params model) {
    r->model = model;
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    if (bt_airframe_build(&model.aircraft, model.deck.gravity_mps2,
                          0.5 * model.deck.cable.diameter_m, &r->airframe, &diag) != BT_OK)
        fail_msg("refused: %s", kept.text);
    assert_int_equal(bt_arena_create(&r->arena, 4 * bt_state_size(r->airframe.system)), BT_OK);
    assert_int_equal(bt_state_create(r->airframe.system, &r->arena, &r->hanging), BT_OK);
    assert_int_equal(bt_state_create(r->airframe.system, &r->arena, &r->state), BT_OK);
    place(r);
}

static void rig_close(rig* r) {
    bt_airframe_destroy(&r->airframe);
    bt_arena_destroy(&r->arena);
}

/// Gives the whole aircraft, as it hangs, a rigid rotation about its centre of gravity.
static void spin_rigidly(rig* r, const double spin[3]) {
    bt_state_copy(r->airframe.system, &r->state, &r->hanging);
    for (int body = 0; body < r->airframe.body_count; ++body) {
        double* v = r->state.v + 6 * body;
        bt_cross(spin, r->state.q + 7 * body, v);
        bt_unrotate(r->state.rotation + 9 * body, spin, v + 3);
    }
}

static void check_mass_and_inertia(double shank_Nm2) {
    rig r;
    bt_model_params model = REFERENCE("aircraft.inertia_xz=3440 kg m^2");
    model.aircraft.hook.shank_bending_stiffness_Nm2 = shank_Nm2;
    rig_open(&r, model);
    const bt_aircraft_params* p = &r.model.aircraft;
    bt_audit audit;
    // momentum at a uniform velocity is mass times velocity
    bt_system_audit(r.airframe.system, &r.state, &audit);
    BT_ASSERT_NEAR(audit.momentum_Ns[0], p->mass_kg * r.model.landing.horizontal_speed_mps, 1e-13,
                   0);
    BT_ASSERT_NEAR(audit.momentum_Ns[2], -p->mass_kg * r.model.landing.sink_speed_mps, 1e-13, 0);
    // angular momentum of a rigid rotation is the inertia tensor's column; no linear momentum: the
    // origin is the centre of gravity
    const double inertia[9] = {p->inertia_xx_kgm2, 0, p->inertia_xz_kgm2, 0, p->inertia_yy_kgm2, 0,
                               p->inertia_xz_kgm2, 0, p->inertia_zz_kgm2};
    for (int axis = 0; axis < 3; ++axis) {
        const double spin[3] = {axis == 0, axis == 1, axis == 2};
        spin_rigidly(&r, spin);
        bt_system_audit(r.airframe.system, &r.state, &audit);
        for (int i = 0; i < 3; ++i) {
            BT_ASSERT_NEAR(audit.momentum_Ns[i], 0, 0, 1e-9 * p->mass_kg);
            BT_ASSERT_NEAR(audit.angular_momentum_Nms[i], inertia[3 * axis + i], 1e-12, 1e-6);
        }
        BT_ASSERT_NEAR(audit.velocity_residual, 0, 0, 1e-12);
    }
    rig_close(&r);
}

static void mass_centre_and_inertia_are_those_of_the_whole_aircraft(void** state) {
    (void)state;
    check_mass_and_inertia(0);
    check_mass_and_inertia(1e6); // with a shank in two parts
}

static void every_part_hangs_at_rest_in_the_glide(void** state) {
    (void)state;
    static const double lift[] = {1, 0.8, 1.1, 1, 1.1}, shank_Nm2[] = {0, 0, 0, 1e6, 1e5};
    for (int k = 0; k < 5; ++k) {
        rig r;
        bt_model_params model = REFERENCE("landing.pitch=0 deg");
        model.aircraft.lift_ratio = lift[k];
        model.aircraft.hook.shank_bending_stiffness_Nm2 = shank_Nm2[k];
        rig_open(&r, model);
        const double fall = (lift[k] - 1) * model.deck.gravity_mps2;
        for (int body = 0; body < r.airframe.body_count; ++body) {
            const double* a = r.state.a + 6 * body;
            // the stops are as stiff as 3e7 N/m: a nanometre off is 0.03 N
            BT_ASSERT_NEAR(a[0], 0, 0, 1e-6);
            BT_ASSERT_NEAR(a[1], 0, 0, 1e-12);
            BT_ASSERT_NEAR(a[2], fall, 0, 1e-6);
            for (int i = 3; i < 6; ++i)
                BT_ASSERT_NEAR(a[i], 0, 0, 1e-6);
        }
        rig_close(&r);
    }
}

static void struts_and_hook_hang_on_their_stops(void** state) {
    (void)state;
    rig r;
    rig_open(&r, REFERENCE("landing.pitch=0 deg"));
    const bt_hook_params* h = &r.model.aircraft.hook;
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const double* out =
            bt_system_element_output(r.airframe.system, &r.state, r.airframe.strut[leg]);
        const bt_gear_params* gear =
            leg == BT_LEG_NOSE ? &r.model.aircraft.nose_gear : &r.model.aircraft.main_gear;
        assert_true(out[BT_STRUT_STROKE] <= 0);
        BT_ASSERT_NEAR(out[BT_STRUT_FORCE],
                       -(gear->piston_mass_kg + gear->wheel_mass_kg) * r.model.deck.gravity_mps2,
                       1e-6, 0);
    }
    // a few hundredths of a degree below the stop, by the damper's stop stiffness
    assert_true(r.airframe.hook_angle_rad > h->down_stop_rad);
    assert_true(r.airframe.hook_angle_rad < h->down_stop_rad + 0.01);
    rig_close(&r);
}

/// Statics of the hook in the glide: the damper's moment about the pivot holds its weight, the
/// pivot the rest.
static void the_pivot_carries_what_statics_says(void** state) {
    (void)state;
    rig r;
    rig_open(&r, REFERENCE("landing.pitch=0 deg"));
    const bt_hook_params* h = &r.model.aircraft.hook;
    const double weight = h->mass_kg * r.model.deck.gravity_mps2;
    const double damper = bt_system_element_output(r.airframe.system, &r.state,
                                                   r.airframe.damper)[BT_HOOK_DAMPER_FORCE];
    const double angle = r.airframe.hook_angle_rad;
    // the arm hangs within 0.5 % of its value at the stop
    BT_ASSERT_NEAR(damper * h->damper_lever_m, -weight * h->mass_centre_m * cos(angle), 5e-3, 0);
    double force[3], torque[3];
    bt_system_joint_load(r.airframe.system, &r.state, r.airframe.hook_joint, force, torque);
    // the damper stands across the shank: it pulls along (sin, 0, -cos), reversed when negative
    const double along[3] = {sin(angle), 0, -cos(angle)};
    BT_ASSERT_NEAR(force[0] + damper * along[0], 0, 0, 0.02 * fabs(damper));
    BT_ASSERT_NEAR(force[1], 0, 0, 1e-9);
    BT_ASSERT_NEAR(force[2] + damper * along[2], weight, 0, 0.02 * fabs(damper));
    rig_close(&r);
}

/// A rolled aircraft in the glide: each leg's slide holds the component of its weight across the
/// strut. Newton's law of piston and wheel, to rounding; and close to statics (the hook swings to
/// the side, which moves the rest a little).
static void a_rolled_leg_leans_on_its_slide(void** state) {
    (void)state;
    rig r;
    rig_open(&r, REFERENCE("landing.pitch=0 deg", "landing.roll=5 deg"));
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const bt_gear_params* gear =
            leg == BT_LEG_NOSE ? &r.model.aircraft.nose_gear : &r.model.aircraft.main_gear;
        double force[3], torque[3], local[3], need[3], need_local[3];
        bt_system_joint_load(r.airframe.system, &r.state, r.airframe.strut_joint[leg], force,
                             torque);
        bt_unrotate(r.state.rotation, force, local);
        for (int i = 0; i < 3; ++i)
            need[i] = gear->piston_mass_kg * r.state.a[6 * (BT_BODY_NOSE_PISTON + leg) + i] +
                      gear->wheel_mass_kg * r.state.a[6 * (BT_BODY_NOSE_WHEEL + leg) + i];
        const double mass = gear->piston_mass_kg + gear->wheel_mass_kg;
        need[2] += mass * r.model.deck.gravity_mps2;
        bt_unrotate(r.state.rotation, need, need_local);
        BT_ASSERT_NEAR(local[0], need_local[0], 0, 1e-8 * mass);
        BT_ASSERT_NEAR(local[1], need_local[1], 1e-9, 0);
        BT_ASSERT_NEAR(local[2], 0, 0, 1e-8 * mass); // along the strut the slide gives nothing
        // port side up: gravity has a component to starboard, the slide pushes to port
        const double weight = mass * r.model.deck.gravity_mps2;
        BT_ASSERT_NEAR(local[1], weight * sin(5 * 3.14159265358979323846 / 180), 0.02, 0);
    }
    rig_close(&r);
}

static void the_glide_has_the_attitude_and_velocity_asked_for(void** state) {
    (void)state;
    rig r;
    rig_open(&r, REFERENCE("landing.pitch=-2 deg", "landing.roll=3 deg", "landing.yaw=4 deg",
                           "landing.off_centre=1.5 m"));
    const double deg = 3.14159265358979323846 / 180;
    const double* a = r.state.rotation;
    // nose down, to port; port side up
    BT_ASSERT_NEAR(asin(a[6]), -2 * deg, 1e-12, 0);
    BT_ASSERT_NEAR(atan2(a[3], a[0]), 4 * deg, 1e-12, 0);
    BT_ASSERT_NEAR(atan2(a[7], a[8]), 3 * deg, 1e-12, 0);
    double centre[3] = {0};
    for (int body = 0; body < BT_BODY_COUNT; ++body) {
        const double* v = r.state.v + 6 * body;
        BT_ASSERT_NEAR(v[0], 47.5, 1e-14, 0);
        BT_ASSERT_NEAR(v[1], 0, 0, 1e-14);
        BT_ASSERT_NEAR(v[2], -3.6, 1e-14, 0);
    }
    // the aircraft's centre of gravity: the fuselage's centre less its offset
    for (int i = 0; i < 3; ++i) {
        centre[i] = r.state.q[i];
        for (int k = 0; k < 3; ++k)
            centre[i] -= a[3 * i + k] * r.airframe.fuselage_m[k];
    }
    BT_ASSERT_NEAR(centre[0], 0, 0, 1e-12);
    BT_ASSERT_NEAR(centre[1], 1.5, 1e-12, 0);
    BT_ASSERT_NEAR(centre[2], up_m, 1e-13, 0);
    bt_audit audit;
    bt_system_audit(r.airframe.system, &r.state, &audit);
    BT_ASSERT_NEAR(audit.position_residual, 0, 0, 1e-12);
    BT_ASSERT_NEAR(audit.velocity_residual, 0, 0, 1e-12);
    rig_close(&r);
}

/// With the aircraft level the shoe is level with the main tyres' underside, as its file says, and
/// pitching by theta lowers it by the lever times the sine.
static void the_lowest_points_follow_from_the_geometry(void** state) {
    (void)state;
    for (int k = -1; k <= 2; ++k) {
        rig r;
        bt_model_params model = reference_model(NULL, 0);
        const double pitch = k * 0.05;
        model.landing.pitch_rad = pitch;
        rig_open(&r, model);
        const bt_aircraft_params* p = &model.aircraft;
        const double angle = r.airframe.hook_angle_rad;
        const double x = p->hook.pivot_x_m - p->hook.length_m * cos(angle);
        const double z = p->hook.pivot_z_m - p->hook.length_m * sin(angle);
        BT_ASSERT_NEAR(r.glide.hook_m[2],
                       x * sin(pitch) + z * cos(pitch) - p->hook.profile.shoe_radius_m, 1e-12, 0);
        BT_ASSERT_NEAR(r.glide.hook_m[0], x * cos(pitch) - z * sin(pitch), 1e-12, 0);
        const double stroke = r.airframe.stroke_m[BT_LEG_LEFT];
        const double axle = p->main_gear.underside_m + p->main_gear.tyre.radius_m + stroke;
        BT_ASSERT_NEAR(r.glide.tyre_m[BT_LEG_LEFT][2],
                       p->main_gear.station_m * sin(pitch) + axle * cos(pitch) -
                           p->main_gear.tyre.radius_m,
                       1e-12, 0);
        BT_ASSERT_NEAR(r.glide.tyre_m[BT_LEG_LEFT][1], p->main_gear.half_track_m, 1e-12, 0);
        BT_ASSERT_NEAR(r.glide.tyre_m[BT_LEG_RIGHT][1], -p->main_gear.half_track_m, 1e-12, 0);
        rig_close(&r);
    }
}

static void an_aircraft_lighter_than_its_parts_is_refused(void** state) {
    (void)state;
    bt_model_params model = reference_model(NULL, 0);
    model.aircraft.mass_kg = 300;
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    bt_airframe airframe;
    assert_int_equal(bt_airframe_build(&model.aircraft, 9.80665, 0.01825, &airframe, &diag),
                     BT_ERR_INPUT);
    assert_non_null(strstr(kept.text, "aircraft.mass: 300 kg is not more than the mass of gear"));
}

static void an_inertia_smaller_than_the_parts_is_refused(void** state) {
    (void)state;
    bt_model_params model = reference_model(NULL, 0);
    model.aircraft.inertia_xx_kgm2 = 1000; // the main legs alone have more
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    bt_airframe airframe;
    assert_int_equal(bt_airframe_build(&model.aircraft, 9.80665, 0.01825, &airframe, &diag),
                     BT_ERR_INPUT);
    assert_non_null(strstr(kept.text, "fuselage"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mass_centre_and_inertia_are_those_of_the_whole_aircraft),
        cmocka_unit_test(every_part_hangs_at_rest_in_the_glide),
        cmocka_unit_test(struts_and_hook_hang_on_their_stops),
        cmocka_unit_test(the_pivot_carries_what_statics_says),
        cmocka_unit_test(a_rolled_leg_leans_on_its_slide),
        cmocka_unit_test(the_glide_has_the_attitude_and_velocity_asked_for),
        cmocka_unit_test(the_lowest_points_follow_from_the_geometry),
        cmocka_unit_test(an_aircraft_lighter_than_its_parts_is_refused),
        cmocka_unit_test(an_inertia_smaller_than_the_parts_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
