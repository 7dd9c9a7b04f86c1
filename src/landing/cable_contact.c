#include "landing/cable_contact.h"

#include "elements/wheel.h"
#include "mechanics/vec.h"

#include <string.h>

void bt_moving_body_to(bt_moving_body* body, double after_s) {
    for (int i = 0; i < 3; ++i) {
        body->now_mps[i] = body->velocity_mps[i] + after_s * body->acceleration_mps2[i];
        body->now_m[i] =
            body->position_m[i] + after_s * 0.5 * (body->velocity_mps[i] + body->now_mps[i]);
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double column[3] = {body->rotation[axis], body->rotation[3 + axis],
                                  body->rotation[6 + axis]};
        double turned[3];
        bt_cross(body->spin_radps, column, turned);
        for (int i = 0; i < 3; ++i)
            body->now_rotation[3 * i + axis] = column[i] + after_s * turned[i];
    }
}

/// A force on the body at a world point, for the duration of one cable step.
static void push_body(bt_moving_body* body, const double force_N[3], const double point_m[3],
                      double step_s) {
    const double arm[3] = {point_m[0] - body->now_m[0], point_m[1] - body->now_m[1],
                           point_m[2] - body->now_m[2]};
    double torque[3];
    bt_cross(arm, force_N, torque);
    bt_add_scaled(body->impulse_Ns, step_s, force_N);
    bt_add_scaled(body->moment_Nms, step_s, torque);
}

/// Velocity of the body's material at a world point.
static void body_velocity(const bt_moving_body* body, const double point_m[3],
                          double velocity_mps[3]) {
    const double arm[3] = {point_m[0] - body->now_m[0], point_m[1] - body->now_m[1],
                           point_m[2] - body->now_m[2]};
    bt_cross(body->spin_radps, arm, velocity_mps);
    bt_add_scaled(velocity_mps, 1, body->now_mps);
}

/// The piece of one segment that lies within a band across some axis: its middle, motion, length.
typedef struct slice {
    double position_m[3], velocity_mps[3];
    double length_m;
} slice;

/// Cuts segment i with the band |s - 0| <= half_width, s = (p - centre) . axis. False: no overlap.
static bool cut_segment(const bt_cable_model* model, const bt_cable_state* cable, int i,
                        const double centre[3], const double axis[3], double half_width,
                        slice* piece) {
    const double p[3] = {cable->x[i], cable->y[i], cable->z[i]};
    const double t[3] = {cable->tx[i], cable->ty[i], cable->tz[i]};
    const double offset[3] = {p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]};
    const double s = bt_dot(offset, axis), along = bt_dot(t, axis);
    const double half = model->half_m[i];
    const double low = fmax(s - half * along, -half_width);
    const double high = fmin(s + half * along, half_width);
    if (!(high > low))
        return false;

    const double shift = (0.5 * (low + high) - s) / along;
    const double arm[3] = {shift * t[0], shift * t[1], shift * t[2]};
    const double spin[3] = {cable->wx[i], cable->wy[i], cable->wz[i]};
    double turning[3];
    bt_cross(spin, arm, turning);
    *piece = (slice){.position_m = {p[0] + arm[0], p[1] + arm[1], p[2] + arm[2]},
                     .velocity_mps = {cable->vx[i] + turning[0], cable->vy[i] + turning[1],
                                      cable->vz[i] + turning[2]},
                     .length_m = (high - low) / along};
    return true;
}

/// Notes that the body slides over the rope at a point that it presses with load_N.
static void note_slide(bt_slides* slides, const bt_cable_model* model, bt_cable_state* cable,
                       int segment, const double point[3], const double normal[3], double limit_N,
                       double slip_speed_mps, bt_moving_body* body, double step_s) {
    if (!(limit_N > 0))
        return;
    if (slides->count == BT_SLIDES_MAX)
        bt_slides_resolve(slides, model, cable, step_s);
    bt_cable_slide* slide = &slides->at[slides->count];
    slides->body[slides->count++] = body;
    *slide =
        (bt_cable_slide){.segment = segment, .limit_N = limit_N, .slip_speed_mps = slip_speed_mps};
    memcpy(slide->point_m, point, sizeof slide->point_m);
    memcpy(slide->normal, normal, sizeof slide->normal);
    body_velocity(body, point, slide->other_mps);
}

void bt_slides_resolve(bt_slides* slides, const bt_cable_model* model, bt_cable_state* cable,
                       double step_s) {
    bt_cable_slides(model, cable, step_s, slides->at, slides->count);
    for (int k = 0; k < slides->count; ++k) {
        const double* f = slides->at[k].force_N;
        push_body(slides->body[k], (double[]){-f[0], -f[1], -f[2]}, slides->at[k].point_m, step_s);
    }
    slides->resolved = slides->count;
    slides->count = 0;
}

/// World force of one slice: on the cable the share that the cable bounds; on the wheel its
/// opposite, and the deck's share less what the bare deck would have given.
static void apply_slice(bt_wheel_contact* contact, const bt_cable_model* model,
                        bt_cable_state* cable, int segment, const slice* piece,
                        const bt_wheel_plane* plane, bt_moving_body* wheel, bt_slides* slides,
                        double step_s) {
    const double radius_m = model->radius_m;
    const bt_tyre* tyre = contact->tyre;
    const double offset[3] = {piece->position_m[0] - wheel->now_m[0],
                              piece->position_m[1] - wheel->now_m[1],
                              piece->position_m[2] - wheel->now_m[2]};
    const bt_bump rope = {.kind = BT_BUMP_CIRCLE,
                          .u_m = bt_dot(offset, plane->heading),
                          .w_m = bt_dot(offset, plane->up),
                          .size_m = radius_m};
    const double reach = tyre->radius + radius_m;
    if (rope.u_m * rope.u_m + rope.w_m * rope.w_m >= reach * reach)
        return;
    bt_envelope envelope;
    bt_tyre_envelope(tyre, plane->height_m, &rope, 1, &envelope);
    if (!(envelope.bump[0].area_m2 > 0))
        return;

    // the whole tyre's load at this deflection, shared by area; a slice is a part of the width
    const double part = piece->length_m / contact->width_m;
    const double load = part * bt_tyre_load(tyre, envelope.deflection_m);
    const double on_rope = load * envelope.bump[0].area_m2 / envelope.all.area_m2;
    const double bare = part * bt_tyre_load(tyre, fmax(0, tyre->radius - plane->height_m));
    const double deck_change = load * envelope.ground.area_m2 / envelope.all.area_m2 - bare;

    // normal force on the rope, against the tyre's inward direction there
    const double gu = envelope.bump[0].g_u, gw = envelope.bump[0].g_w, g = hypot(gu, gw);
    double inward[3], point[3], force[3];
    for (int i = 0; i < 3; ++i) {
        inward[i] = (gu * plane->heading[i] + gw * plane->up[i]) / g;
        point[i] = piece->position_m[i] + radius_m * inward[i];
        force[i] = -on_rope * g * inward[i];
    }
    bt_cable_add_load(cable, segment, force, point);
    const double reaction[3] = {-force[0], -force[1], -force[2]};
    push_body(wheel, reaction, point, step_s);
    note_slide(slides, model, cable, segment, point, inward, contact->friction * on_rope,
               contact->slip_speed_mps, wheel, step_s);
    contact->normal_N += on_rope;

    const double lift[3] = {0, 0, deck_change};
    const double under[3] = {wheel->now_m[0], wheel->now_m[1], 0};
    push_body(wheel, lift, under, step_s);
}

void bt_wheel_contact_press(bt_wheel_contact* contact, const bt_cable_model* model,
                            bt_cable_state* cable, bt_moving_body* wheel, bt_slides* slides,
                            double step_s) {
    contact->normal_N = 0;
    const double axle[3] = {wheel->now_rotation[1], wheel->now_rotation[4], wheel->now_rotation[7]};
    bt_wheel_plane plane;
    bt_wheel_plane_find(axle, wheel->now_m[2], &plane);
    const int middle = bt_cable_segment_at(model, cable, wheel->now_m[1], contact->hint);
    contact->hint = middle;
    if (middle < 0)
        return;
    const double half_width = 0.5 * contact->width_m;
    slice piece;
    for (int direction = -1; direction <= 1; direction += 2)
        for (int i = direction < 0 ? middle : middle + 1; i >= 0 && i < model->count;
             i += direction) {
            if (!cut_segment(model, cable, i, wheel->now_m, axle, half_width, &piece))
                break;
            apply_slice(contact, model, cable, i, &piece, &plane, wheel, slides, step_s);
        }
}

/// World point of the head's frame (u, w in the plane of symmetry) at the hook's present position.
static void head_to_world(const bt_hook_contact* contact, const bt_moving_body* hook, double u,
                          double w, double point[3]) {
    const double local[3] = {contact->shoe_m[0] + u, contact->shoe_m[1], contact->shoe_m[2] + w};
    bt_rotate(hook->now_rotation, local, point);
    for (int i = 0; i < 3; ++i)
        point[i] += hook->now_m[i];
}

/// Where a piece of rope stands in the head's frame.
static void world_to_head(const bt_hook_contact* contact, const bt_moving_body* hook,
                          const double point[3], double head[2]) {
    const double offset[3] = {point[0] - hook->now_m[0], point[1] - hook->now_m[1],
                              point[2] - hook->now_m[2]};
    double local[3];
    bt_unrotate(hook->now_rotation, offset, local);
    head[0] = local[0] - contact->shoe_m[0];
    head[1] = local[2] - contact->shoe_m[2];
}

/// Contact of one slice of rope with the outline.
static void touch_slice(bt_hook_contact* contact, const bt_cable_model* model,
                        bt_cable_state* cable, int segment, const slice* piece,
                        bt_moving_body* hook, bt_slides* slides, double step_s) {
    const double radius_m = model->radius_m;
    double head[2];
    world_to_head(contact, hook, piece->position_m, head);
    const bt_nearest near = bt_profile_nearest(contact->profile, head[0], head[1]);
    const double depth = radius_m - near.distance_m;
    if (!(depth > 0))
        return;

    // the normal in the world, the touching point, and how fast the rope leaves it
    double normal[3], point[3], leaving_mps[3];
    for (int i = 0; i < 3; ++i) {
        normal[i] = near.normal[0] * hook->now_rotation[3 * i] +
                    near.normal[1] * hook->now_rotation[3 * i + 2];
        point[i] = piece->position_m[i] - radius_m * normal[i];
    }
    body_velocity(hook, point, leaving_mps);
    for (int i = 0; i < 3; ++i)
        leaving_mps[i] = piece->velocity_mps[i] - leaving_mps[i];
    const double leaving = bt_dot(leaving_mps, normal);
    const double pressure = contact->stiffness * depth - contact->damping * leaving;
    if (!(pressure > 0))
        return;

    const double load = pressure * piece->length_m;
    double force[3], reaction[3];
    for (int i = 0; i < 3; ++i)
        reaction[i] = -(force[i] = load * normal[i]);
    bt_cable_add_load(cable, segment, force, point);
    push_body(hook, reaction, point, step_s);
    note_slide(slides, model, cable, segment, point, normal, contact->friction * load,
               contact->slip_speed_mps, hook, step_s);
    contact->zone_force_N[near.zone] += load;
}

void bt_hook_contact_press(bt_hook_contact* contact, const bt_cable_model* model,
                           bt_cable_state* cable, bt_moving_body* hook, bt_slides* slides,
                           double step_s) {
    memset(contact->zone_force_N, 0, sizeof contact->zone_force_N);
    double centre[3];
    head_to_world(contact, hook, 0, 0, centre);
    head_to_world(contact, hook, contact->profile->lip[0], contact->profile->lip[1],
                  contact->lip_m);
    const int middle =
        bt_cable_centreline(model, cable, centre[1], contact->hint, contact->cable_m, NULL, NULL);
    contact->hint = middle;
    contact->beside = middle < 0;
    if (middle < 0)
        return;

    const double axis[3] = {hook->now_rotation[1], hook->now_rotation[4], hook->now_rotation[7]};
    slice piece;
    for (int direction = -1; direction <= 1; direction += 2)
        for (int i = direction < 0 ? middle : middle + 1; i >= 0 && i < model->count;
             i += direction) {
            if (!cut_segment(model, cable, i, centre, axis, contact->profile->half_width, &piece))
                break;
            touch_slice(contact, model, cable, i, &piece, hook, slides, step_s);
        }
}

double bt_wheel_clearance(const bt_wheel_contact* contact, const bt_cable_model* model,
                          const bt_cable_state* cable, const bt_moving_body* wheel) {
    double rope[3];
    if (bt_cable_centreline(model, cable, wheel->position_m[1], contact->hint, rope, NULL, NULL) <
        0)
        return INFINITY;
    return hypot(rope[0] - wheel->position_m[0], rope[2] - wheel->position_m[2]) -
           contact->tyre->radius - model->radius_m;
}

double bt_hook_clearance(bt_hook_contact* contact, const bt_cable_model* model,
                         const bt_cable_state* cable, const bt_moving_body* hook) {
    double centre[3], head[2];
    head_to_world(contact, hook, 0, 0, centre);
    head_to_world(contact, hook, contact->profile->lip[0], contact->profile->lip[1],
                  contact->lip_m);
    contact->beside = bt_cable_centreline(model, cable, centre[1], contact->hint, contact->cable_m,
                                          NULL, NULL) < 0;
    if (contact->beside)
        return INFINITY;
    world_to_head(contact, hook, contact->cable_m, head);
    return bt_profile_nearest(contact->profile, head[0], head[1]).distance_m - model->radius_m;
}
